//! The optional table `[uncertainty]`: by how much a built design, and what drives it, may differ from
//! the case.

use std::f64::consts::TAU;

use serde::Serialize;
use toml::de::DeValue;

use super::inputs::Input;
use super::quantity::{Dimension, Force, Frequency, Length};
use super::reader::{Bound, Field, Reader};
use super::table::Table;
use super::{Design, PhysicalExcitation};

/// How the error of one parameter is distributed around what is written.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Distribution {
    /// There is no error.
    #[default]
    Certain,
    /// Normally distributed, with this standard deviation.
    Normal(f64),
    /// Uniformly distributed, up to this to either side.
    Uniform(f64),
}

impl Distribution {
    /// Whether there is no error.
    pub fn is_certain(self) -> bool {
        self == Self::Certain
    }

    /// Of an error that is measured in another unit, `unit` of this one.
    fn over(self, unit: f64) -> Self {
        match self {
            Self::Certain => Self::Certain,
            Self::Normal(deviation) => Self::Normal(deviation / unit),
            Self::Uniform(largest) => Self::Uniform(largest / unit),
        }
    }
}

/// The errors of what is built, and of what drives it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Uncertainty {
    /// Of the clearance, in metres or the case's own unit.
    pub clearance: Distribution,
    /// Of the restitution.
    pub restitution: Distribution,
    /// Of the excitation's frequency, as a frequency ratio.
    pub frequency_ratio: Distribution,
    /// Of the excitation's amplitude, over the case's own.
    pub amplitude: Distribution,
}

impl Uncertainty {
    /// Whether anything is uncertain.
    pub fn is_any(&self) -> bool {
        self.count() > 0
    }

    /// How many parameters are uncertain.
    pub fn count(&self) -> usize {
        let all = [self.clearance, self.restitution, self.frequency_ratio, self.amplitude];
        all.iter().filter(|one| !one.is_certain()).count()
    }
}

pub(super) const TABLE: &str = "uncertainty";
pub(super) const KEYS: &[&str] = &["clearance", "restitution", "frequency", "amplitude"];

/// Signs of a largest error.
const SIGNS: [&str; 3] = ["±", "+-", "+/-"];

/// The error of one key, and how its size is read.
struct Error {
    key: &'static str,
    /// Symbols of a standard deviation and of a largest error.
    symbols: [&'static str; 2],
    example: &'static str,
    read: Size,
}

/// Reads the size of an error behind the sign that takes up some bytes of its text.
type Size = fn(&Table, &mut Reader, Field, usize) -> Option<f64>;

fn number(table: &Table, reader: &mut Reader, field: Field, sign: usize) -> Option<f64> {
    table.number_behind(reader, field, sign)
}

fn quantity<D: Dimension>(
    table: &Table,
    reader: &mut Reader,
    field: Field,
    sign: usize,
) -> Option<f64> {
    table.quantity_behind::<D>(reader, field, sign)
}

const fn error(
    key: &'static str,
    symbols: [&'static str; 2],
    example: &'static str,
    read: Size,
) -> Error {
    Error { key, symbols, example, read }
}

/// The errors of a design's clearance, restitution, frequency and amplitude.
fn errors_of(design: &Design) -> [Error; 4] {
    let restitution = error("restitution", ["s_r", r"\Delta r"], "0.05", number);
    let Design::Physical(physical) = design else {
        return [
            error("clearance", ["s_b", r"\Delta b"], "0.02", number),
            restitution,
            error("frequency", [r"s_\Omega", r"\Delta\Omega"], "0.005", number),
            error("amplitude", ["s_G", r"\Delta G"], "0.1", number),
        ];
    };
    let amplitude = match physical.excitation {
        PhysicalExcitation::BaseDisplacement { .. } => {
            error("amplitude", ["s_F", r"\Delta F"], "\"0.02 mm\"", quantity::<Length>)
        }
        PhysicalExcitation::Force { .. } => {
            error("amplitude", ["s_P", r"\Delta P"], "\"0.2 N\"", quantity::<Force>)
        }
    };
    [
        error("clearance", ["s_b", r"\Delta b"], "\"0.2 mm\"", quantity::<Length>),
        restitution,
        error("frequency", ["s_f", r"\Delta f"], "\"0.05 Hz\"", quantity::<Frequency>),
        amplitude,
    ]
}

/// Reads the error of one key, which may be missing.
fn read_error(reader: &mut Reader, table: &Table, error: &Error) -> Distribution {
    let Some((_, value)) = table.entry(error.key) else { return Distribution::Certain };
    let sign = match value.get_ref() {
        DeValue::String(text) => sign_of(text),
        _ => 0,
    };
    let symbol = error.symbols[usize::from(sign > 0)];
    let field = Field::new(error.key, symbol, Bound::NotNegative, error.example);
    match (error.read)(table, reader, field, sign) {
        None | Some(0.0) => Distribution::Certain,
        Some(largest) if sign > 0 => Distribution::Uniform(largest),
        Some(deviation) => Distribution::Normal(deviation),
    }
}

/// The bytes that the sign of a largest error takes up at the beginning of a text.
fn sign_of(text: &str) -> usize {
    let begun = text.trim_start();
    let sign = SIGNS.into_iter().find(|sign| begun.starts_with(sign));
    sign.map_or(0, |sign| text.len() - begun.len() + sign.len())
}

impl Input {
    /// What stands behind the sign of a largest error; `None` where there is no such sign.
    pub fn largest_error(&self) -> Option<&str> {
        let sign = sign_of(&self.as_written);
        (sign > 0).then(|| self.as_written[sign..].trim())
    }
}

/// Reads the table, which may be missing.
pub(super) fn read(reader: &mut Reader, root: &Table, design: Option<&Design>) -> Uncertainty {
    let table = reader.table(root, TABLE);
    let (Some(table), Some(design)) = (table, design) else { return Uncertainty::default() };
    let [clearance, restitution, frequency, amplitude] =
        errors_of(design).map(|error| read_error(reader, &table, &error));
    let amplitude = amplitude.over(match design {
        Design::Physical(physical) => match physical.excitation {
            PhysicalExcitation::BaseDisplacement { amplitude_m } => amplitude_m,
            PhysicalExcitation::Force { amplitude_n } => amplitude_n,
        },
        Design::Reduced(reduced) => reduced.forcing,
    });
    if matches!(amplitude, Distribution::Normal(size) | Distribution::Uniform(size) if !size.is_finite())
    {
        reader.report(
            table.span_of_value("amplitude"),
            "the amplitude is uncertain in a case that is not driven",
            "expected an excitation with an amplitude above 0",
            "give the case's own excitation an amplitude, or remove the line",
        );
        return Uncertainty::default();
    }
    let natural_hz = design.scales().natural_frequency_rad_per_s.map_or(1.0, |omega| omega / TAU);
    Uncertainty { clearance, restitution, frequency_ratio: frequency.over(natural_hz), amplitude }
}

/// By how much a built design, and what drives it, may differ from the case. A value is the standard
/// deviation of a normally distributed error; one behind ± (or +-, in quotes) is the largest of a
/// uniformly distributed one. Each key may be left out.
#[derive(schemars::JsonSchema)]
#[schemars(deny_unknown_fields)]
#[expect(dead_code, reason = "describes the table to editors; read() is what reads it")]
pub(super) struct UncertaintyTable {
    /// Of the clearance: a length, or a plain number beside [reduced].
    #[schemars(example = "0.2 mm", example = "± 0.2 mm")]
    clearance: Option<serde_json::Value>,
    /// Of the restitution.
    restitution: Option<RestitutionError>,
    /// Of the excitation's frequency, that of a whole band included: a frequency, or a frequency ratio
    /// beside [reduced].
    #[schemars(example = "0.05 Hz", example = "± 0.1 Hz")]
    frequency: Option<serde_json::Value>,
    /// Of the excitation's amplitude, as in [excitation]; that of a whole band in proportion.
    #[schemars(example = "0.02 mm", example = "± 0.05 mm")]
    amplitude: Option<serde_json::Value>,
}

/// A number, or text with a sign and a number.
struct RestitutionError;

impl schemars::JsonSchema for RestitutionError {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "RestitutionError".into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let text = r"^\s*(±|\+-|\+/-)\s*\+?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?\s*$";
        schemars::json_schema!({
            "anyOf": [
                { "type": "number", "minimum": 0.0 },
                { "type": "string", "pattern": text },
            ],
            "examples": [0.05, "± 0.05"],
        })
    }
}
