//! The optional table `[band]`: the range of excitations that a design must serve.

use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::{Value, json};

use super::Design;
use super::inputs::Input;
use super::reader::{Reader, Table};
use super::schema::in_design;
pub use crate::system::BandOver;
use crate::system::{Band, Parameter, System};

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

impl BandSettings {
    /// The band around a system, whose frequency and amplitude the ratios are over.
    pub fn around(&self, system: &System) -> Band {
        let Self { over, range, spectrum } = self;
        Band { base: *system, over: *over, range: *range, spectrum: spectrum.clone() }
    }

    /// That of another design of the case: a band of frequencies stays where it is in hertz, but is shifted by as much as
    /// the design's own excitation is off.
    pub(crate) fn beside(&self, own: &Design, other: &Design) -> Self {
        let natural = |design: &Design| design.units().natural_frequency;
        let scale = natural(own) / natural(other);
        let shift = match (own, other) {
            (Design::Physical(own), Design::Physical(of)) => {
                TAU * (of.frequency_hz - own.frequency_hz) / natural(other)
            }
            (Design::Reduced(own), Design::Reduced(of)) => {
                of.frequency_ratio() - own.frequency_ratio()
            }
            _ => 0.0,
        };
        self.moved(scale, shift)
    }

    /// The same with other frequency ratios, so many times as large and then shifted.
    pub(super) fn moved(&self, scale: f64, shift: f64) -> Self {
        if self.over != BandOver::Frequency {
            return self.clone();
        }
        let at = |ratio: f64| scale * ratio + shift;
        let spectrum =
            self.spectrum.iter().map(|[frequency, amplitude]| [at(*frequency), *amplitude]);
        Self { over: self.over, range: self.range.map(at), spectrum: spectrum.collect() }
    }
}

/// The range of excitations that a design must serve. The table may be left out.
#[derive(Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields, extend("oneOf" = ends()))]
pub(super) struct BandTable {
    /// What the range is of: the excitation's frequency, unless given, or its amplitude at the case's
    /// frequency.
    of: Option<BandOver>,
    /// Where it begins: a frequency, or an amplitude as in [excitation]; plain numbers beside
    /// [reduced].
    #[schemars(with = "Value", extend("x-parameter" = "frequency", "x-symbol" = r"\min", "exclusiveMinimum" = 0), example = "8 Hz")]
    from: f64,
    /// Where it ends, above `from`.
    #[schemars(with = "Value", extend("x-parameter" = "frequency", "x-symbol" = r"\max", "exclusiveMinimum" = 0), example = "9 Hz")]
    to: f64,
    /// Amplitude of the excitation over a band of frequencies; the case's own unless given.
    #[schemars(with = "Option<Value>", extend("x-parameter" = "amplitude", "x-symbol" = "F", "exclusiveMinimum" = 0))]
    #[schemars(example = "0.25 mm")]
    amplitude: Option<f64>,
    /// Amplitude over a band of frequencies as pairs of frequency and amplitude: straight lines
    /// between them, constant before the first and after the last.
    #[schemars(
        with = "Option<Vec<Value>>",
        extend("items" = corner(), "minItems" = 1, "x-ascending" = true, "x-plain" = [[[0.97, 4.0], [1.03, 5.0]]])
    )]
    #[schemars(example = vec![["8 Hz", "0.2 mm"], ["9 Hz", "0.3 mm"]])]
    spectrum: Option<Vec<[f64; 2]>>,
}

fn positive(parameter: &str) -> Value {
    let mut number = in_design(parameter);
    number["exclusiveMinimum"] = json!(0);
    number
}

fn corner() -> Value {
    let parts = [in_design("frequency"), positive("amplitude")];
    json!({ "type": "array", "prefixItems": parts, "minItems": 2, "maxItems": 2 })
}

/// How the ends are written for each kind of band.
fn ends() -> Value {
    let branch = |over: BandOver, required: &[&str]| {
        let [mut from, mut to] = [positive(over.name()), positive(over.name())];
        from["x-symbol"] = json!(r"\min");
        to["x-symbol"] = json!(r"\max");
        let properties = json!({ "of": { "const": over.name() }, "from": from, "to": to });
        json!({ "properties": properties, "required": required })
    };
    json!([branch(BandOver::Frequency, &[]), branch(BandOver::Amplitude, &["of"])])
}

/// Reads the table, which may be missing; without a design its units are not known.
pub(super) fn read(reader: &mut Reader, root: &Table) -> Option<BandSettings> {
    let (table, band) = reader.optional::<BandTable>(root, "band")?;
    let design = reader.design?;
    let over = band.of.unwrap_or(BandOver::Frequency);
    if band.from >= band.to {
        let message = "the band ends where it begins, or before";
        let help = "swap `from` and `to`, or write a larger `to`";
        reader.report(table.span_of_value("to"), message, "expected `to` above `from`", help);
        return None;
    }
    let amplitudes = match over {
        BandOver::Frequency => ["amplitude", "spectrum"].as_slice(),
        BandOver::Amplitude => &["from", "amplitude", "spectrum"],
    };
    let mut amplitudes = amplitudes.iter().filter(|key| table.has(key));
    let said = amplitudes.next();
    if let Some(key) = amplitudes.next() {
        let message = format!("`{key}` says again what the amplitude is");
        let help = "remove one of the lines";
        reader.report(table.span_of(key), message, "expected the amplitude in one way only", help);
        return None;
    }
    if let (Some(value), Some(corners)) = (table.value("spectrum"), &band.spectrum) {
        let (span, value) = (value.span(), corners.len() as f64);
        let written = reader.as_written(span.clone()).replace('"', "");
        let as_written = written.split_whitespace().collect::<Vec<_>>().join(" ");
        let (table, name, symbol) = ("band".to_owned(), "spectrum", "F(f)".to_owned());
        reader.inputs.push(Input { table, name, symbol, value, unit: "1", as_written, span });
    }
    let own = design.value(Parameter::Amplitude)?;
    let omega = |frequency: f64| design.units().frequency_ratio(frequency);
    let range = [band.from, band.to].map(|end| match over {
        BandOver::Frequency => omega(end),
        BandOver::Amplitude => end / own,
    });
    let spectrum: Vec<_> = match (band.amplitude, band.spectrum) {
        (Some(amplitude), _) => vec![[range[0], amplitude / own]],
        (None, corners) => corners
            .unwrap_or_default()
            .into_iter()
            .map(|[at, height]| [omega(at), height / own])
            .collect(),
    };
    let known = range.iter().chain(spectrum.iter().flatten()).all(|one| one.is_finite());
    if let (Some(key), false) = (said, known) {
        let message =
            "an amplitude of the band is given as a multiple of the case's own, which is 0";
        let help = "give the case's own excitation an amplitude above 0";
        reader.report(table.span_of_value(key), message, "expected a case that is driven", help);
        return None;
    }
    Some(BandSettings { over, range, spectrum })
}
