//! The optional table `[band]`: the range of excitations that a design must serve.

use toml::de::{DeArray, DeValue};

use super::inputs::Input;
use super::list::List;
use super::quantity::{Force, Frequency, Length};
use super::reader::{Bound, Field, Reader};
use super::table::Table;
use super::{Design, PhysicalExcitation, Scales};

/// What is varied along a band.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BandOver {
    /// The excitation's frequency.
    Frequency,
    /// Its amplitude, at the case's frequency.
    Amplitude,
}

/// What the case says about its band; dimensionless.
#[derive(Debug, Clone, PartialEq)]
pub struct BandSettings {
    /// What is varied.
    pub over: BandOver,
    /// Ends, ascending: frequency ratios `Omega`, or amplitudes over the case's own.
    pub range: [f64; 2],
    /// Corners of the amplitude over the frequency: `Omega`, and amplitude over the case's own; empty
    /// where it is the case's everywhere.
    pub spectrum: Vec<[f64; 2]>,
}

pub(super) const TABLE: &str = "band";
pub(super) const KEYS: &[&str] = &["of", "from", "to", "amplitude", "spectrum"];

const KINDS: [(&str, BandOver); 2] =
    [("frequency", BandOver::Frequency), ("amplitude", BandOver::Amplitude)];
const SPECTRUM: List = List {
    key: "spectrum",
    bound: Bound::Positive,
    example: "[[\"8 Hz\", \"0.2 mm\"], [\"9 Hz\", \"0.3 mm\"]]",
};
/// The same beside `[reduced]`.
const PLAIN_SPECTRUM: List = List { example: "[[0.97, 4.0], [1.03, 5.0]]", ..SPECTRUM };

/// Reads numbers of a band in the way its case is written.
struct Units<'d> {
    design: &'d Design,
    scales: Scales,
}

/// Reads the table, which may be missing; without a design its units are not known.
pub(super) fn read(
    reader: &mut Reader,
    root: &Table,
    design: Option<&Design>,
) -> Option<BandSettings> {
    let table = reader.table(root, TABLE)?;
    let design = design?;
    let units = Units::of(design);
    let over = read_over(reader, &table)?;
    let ends = [("from", r"\min"), ("to", r"\max")].map(|(key, symbol)| match over {
        BandOver::Frequency => units.frequency(reader, &table, key, symbol),
        BandOver::Amplitude => units.amplitude(reader, &table, key, symbol),
    });
    let amplitude =
        table.entry("amplitude").map(|_| units.amplitude(reader, &table, "amplitude", "F"));
    let spectrum = read_spectrum(reader, &table, &units);
    let [from, to] = [ends[0]?, ends[1]?];
    if from >= to {
        let message = "the band ends where it begins, or before";
        let help = "swap `from` and `to`, or write a larger `to`";
        reader.report(table.span_of_value("to"), message, "expected `to` above `from`", help);
        return None;
    }
    let twice = match over {
        BandOver::Amplitude => ["amplitude", "spectrum"].into_iter().find(|key| table.has(key)),
        BandOver::Frequency if amplitude.is_some() => table.has("spectrum").then_some("spectrum"),
        BandOver::Frequency => None,
    };
    if let Some(key) = twice {
        let message = format!("`{key}` says again what the amplitude is");
        let help = "remove one of the lines";
        reader.report(table.span_of(key), message, "expected the amplitude in one way only", help);
        return None;
    }
    if let (Some((_, value)), Some(corners)) = (table.entry("spectrum"), &spectrum) {
        let written = reader.as_written(value.span());
        reader.inputs.push(Input {
            table: TABLE,
            name: "spectrum",
            symbol: "F(f)",
            value: corners.len() as f64,
            unit: "1",
            as_written: written.split_whitespace().collect::<Vec<_>>().join(" ").replace('"', ""),
        });
    }
    let spectrum = match amplitude {
        Some(amplitude) => vec![[from, amplitude?]],
        None => spectrum?,
    };
    Some(BandSettings { over, range: [from, to], spectrum })
}

fn read_over(reader: &mut Reader, table: &Table) -> Option<BandOver> {
    let Some((_, value)) = table.entry("of") else { return Some(BandOver::Frequency) };
    let found = match value.get_ref() {
        DeValue::String(text) => KINDS.into_iter().find(|(name, _)| *name == text.as_ref()),
        _ => None,
    };
    if found.is_none() {
        let written = reader.as_written(value.span());
        let expected = "expected \"frequency\" or \"amplitude\"";
        let help = "write for example of = \"frequency\"";
        reader.report(value.span(), format!("`of` is {written}"), expected, help);
    }
    found.map(|(_, over)| over)
}

impl<'d> Units<'d> {
    fn of(design: &'d Design) -> Self {
        Self { design, scales: design.scales() }
    }

    fn excitation(&self) -> Option<PhysicalExcitation> {
        match self.design {
            Design::Physical(physical) => Some(physical.excitation),
            Design::Reduced(_) => None,
        }
    }

    /// A frequency as `Omega`.
    pub fn frequency(
        &self,
        reader: &mut Reader,
        table: &Table,
        key: &'static str,
        symbol: &'static str,
    ) -> Option<f64> {
        match self.scales.natural_frequency_rad_per_s {
            Some(_) => {
                let field = Field::new(key, symbol, Bound::Positive, "\"8 Hz\"");
                self.scales.frequency_ratio(table.quantity::<Frequency>(reader, field)?)
            }
            None => table.number(reader, Field::new(key, symbol, Bound::Positive, "0.97")),
        }
    }

    /// An amplitude over the case's own.
    pub fn amplitude(
        &self,
        reader: &mut Reader,
        table: &Table,
        key: &'static str,
        symbol: &'static str,
    ) -> Option<f64> {
        let value = match self.excitation() {
            Some(PhysicalExcitation::BaseDisplacement { .. }) => table.quantity::<Length>(
                reader,
                Field::new(key, symbol, Bound::Positive, "\"0.25 mm\""),
            ),
            Some(PhysicalExcitation::Force { .. }) => table
                .quantity::<Force>(reader, Field::new(key, symbol, Bound::Positive, "\"2.9 N\"")),
            None => table.number(reader, Field::new(key, symbol, Bound::Positive, "4.3")),
        }?;
        self.over_own(reader, value, table.span_of_value(key))
    }

    fn over_own(
        &self,
        reader: &mut Reader,
        value: f64,
        span: std::ops::Range<usize>,
    ) -> Option<f64> {
        let own = match self.design {
            Design::Physical(physical) => match physical.excitation {
                PhysicalExcitation::BaseDisplacement { amplitude_m } => amplitude_m,
                PhysicalExcitation::Force { amplitude_n } => amplitude_n,
            },
            Design::Reduced(reduced) => reduced.forcing,
        };
        let ratio = value / own;
        if ratio.is_finite() {
            return Some(ratio);
        }
        let help = "give the case's own excitation an amplitude above 0";
        reader.report(
            span,
            "an amplitude of the band is given as a multiple of the case's own, which is 0",
            "expected a case that is driven",
            help,
        );
        None
    }

    fn spectrum(&self) -> &'static List {
        if self.excitation().is_some() { &SPECTRUM } else { &PLAIN_SPECTRUM }
    }

    /// A pair of a list, from text with units or from numbers.
    fn pair(&self, reader: &mut Reader, items: &DeArray) -> Option<[f64; 2]> {
        let (at, amplitude) = (items.first()?, items.get(1)?);
        let list = self.spectrum();
        let (frequency, value) = match self.excitation() {
            Some(excitation) => {
                let frequency = list.quantity::<Frequency>(reader, at)?;
                let value = match excitation {
                    PhysicalExcitation::BaseDisplacement { .. } => {
                        list.quantity::<Length>(reader, amplitude)?
                    }
                    PhysicalExcitation::Force { .. } => {
                        list.quantity::<Force>(reader, amplitude)?
                    }
                };
                (frequency, value)
            }
            None => (list.number(reader, at)?, list.number(reader, amplitude)?),
        };
        let omega = match self.scales.natural_frequency_rad_per_s {
            Some(_) => self.scales.frequency_ratio(frequency)?,
            None => frequency,
        };
        Some([omega, self.over_own(reader, value, amplitude.span())?])
    }
}

fn read_spectrum(reader: &mut Reader, table: &Table, units: &Units) -> Option<Vec<[f64; 2]>> {
    let Some((_, value)) = table.entry("spectrum") else { return Some(Vec::new()) };
    let list: Option<&DeArray> = match value.get_ref() {
        DeValue::Array(list) if !list.is_empty() => Some(list),
        _ => None,
    };
    let pairs: Option<Vec<[f64; 2]>> = list.and_then(|list| {
        list.iter()
            .map(|pair| match pair.get_ref() {
                DeValue::Array(items) if items.len() == 2 => units.pair(reader, items),
                _ => {
                    let message = "`spectrum` holds something that is not a pair";
                    let expected = "expected pairs of a frequency and an amplitude";
                    let help = units.spectrum().help();
                    reader.report(pair.span(), message, expected, help);
                    None
                }
            })
            .collect()
    });
    if list.is_none() {
        let message = "`spectrum` is not a list of pairs";
        let expected = "expected pairs of a frequency and an amplitude, between brackets";
        reader.report(value.span(), message, expected, units.spectrum().help());
    }
    let pairs = pairs?;
    if pairs.windows(2).any(|two| two[0][0] >= two[1][0]) {
        let message = "the frequencies of `spectrum` do not rise";
        let help = "sort the pairs, and keep each frequency once";
        reader.report(value.span(), message, "expected each frequency above the one before", help);
        return None;
    }
    Some(pairs)
}

/// The range of excitations that a design must serve. The table may be left out.
#[derive(schemars::JsonSchema)]
#[schemars(deny_unknown_fields)]
#[expect(dead_code, reason = "describes the table to editors; read() is what reads it")]
pub(super) struct BandTable {
    /// What the range is of: the excitation's frequency, unless given, or its amplitude at the case's
    /// frequency.
    of: Option<BandOf>,
    /// Where it begins: a frequency, or an amplitude as in [excitation]; plain numbers beside
    /// [reduced].
    #[schemars(example = "8 Hz")]
    from: serde_json::Value,
    /// Where it ends, above `from`.
    #[schemars(example = "9 Hz")]
    to: serde_json::Value,
    /// Amplitude of the excitation over a band of frequencies; the case's own unless given.
    #[schemars(example = "0.25 mm")]
    amplitude: Option<serde_json::Value>,
    /// Amplitude over a band of frequencies as pairs of frequency and amplitude: straight lines
    /// between them, constant before the first and after the last.
    spectrum: Option<Vec<[serde_json::Value; 2]>>,
}

#[derive(schemars::JsonSchema)]
#[schemars(rename_all = "kebab-case")]
#[expect(dead_code, reason = "describes a key to editors")]
enum BandOf {
    Frequency,
    Amplitude,
}
