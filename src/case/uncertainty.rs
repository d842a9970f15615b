//! The optional table `[uncertainty]`: by how much a built design, and what drives it, may differ from
//! the case.

use schemars::{JsonSchema, Schema};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::inputs::Input;
use super::number::{Form, sign_of};
use super::reader::{Reader, Table};
use super::schema::NUMBER;
use super::value::Place;

/// How the error of one parameter is distributed around what is written.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
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

/// By how much a built design, and what drives it, may differ from the case. A value is the standard
/// deviation of a normally distributed error; one behind ± (or +-, in quotes) is the largest of a
/// uniformly distributed one. Each key may be left out.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields, transform = without_defaults)]
#[serde(default)]
pub struct Uncertainty {
    /// Of the clearance: a length, or a plain number beside [reduced].
    #[schemars(with = "Value", extend("x-signed" = "clearance", "x-plain" = [0.02], "minimum" = 0))]
    #[schemars(example = "0.2 mm", example = "± 0.2 mm")]
    pub clearance: Distribution,
    /// Of the restitution.
    #[schemars(with = "Value", extend("x-signed" = "restitution", "anyOf" = plain_errors(), "minimum" = 0))]
    #[schemars(example = 0.05, example = "± 0.05")]
    pub restitution: Distribution,
    /// Of the excitation's frequency, that of a whole band included: a frequency, or a frequency ratio
    /// beside [reduced].
    #[serde(rename(deserialize = "frequency"))]
    #[schemars(with = "Value", extend("x-signed" = "frequency", "x-plain" = [0.005], "minimum" = 0))]
    #[schemars(example = "0.05 Hz", example = "± 0.1 Hz")]
    pub frequency_ratio: Distribution,
    /// Of the excitation's amplitude, as in [excitation]; that of a whole band in proportion.
    #[schemars(with = "Value", extend("x-signed" = "amplitude", "x-plain" = [0.1], "minimum" = 0))]
    #[schemars(example = "0.02 mm", example = "± 0.05 mm")]
    pub amplitude: Distribution,
}

/// That there is no error is no value that can be written.
fn without_defaults(schema: &mut Schema) {
    let properties = schema.ensure_object()["properties"].as_object_mut();
    for property in properties.into_iter().flat_map(Map::values_mut) {
        property.as_object_mut().and_then(|property| property.remove("default"));
    }
}

/// A number, or text with a sign and a number.
fn plain_errors() -> Value {
    let text = format!(r"^\s*(±|\+-|\+/-)\s*{NUMBER}\s*$");
    json!([{ "type": "number", "minimum": 0.0 }, { "type": "string", "pattern": text }])
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

/// Signs of a largest error.
const SIGNS: [&str; 3] = ["±", "+-", "+/-"];

impl Input {
    /// What stands behind the sign of a largest error; `None` where there is no such sign.
    pub fn largest_error(&self) -> Option<&str> {
        Some(self.as_written[sign_of(&self.as_written, &SIGNS)?..].trim())
    }
}

/// Reads one error, whose size is written as `form` says.
pub(super) fn read_error(reader: &mut Reader, place: Place, form: Form) -> Option<Value> {
    let sign = place.value.get_ref().as_str().and_then(|text| sign_of(text, &SIGNS)).unwrap_or(0);
    let symbol = match form.symbol.as_str() {
        symbol if sign == 0 => format!("s_{symbol}"),
        symbol if symbol.starts_with('\\') => format!(r"\Delta{symbol}"),
        symbol => format!(r"\Delta {symbol}"),
    };
    let size = reader.number(&Place { sign, ..place }, &Form { symbol, ..form })?;
    serde_json::to_value(match size {
        0.0 => Distribution::Certain,
        largest if sign > 0 => Distribution::Uniform(largest),
        deviation => Distribution::Normal(deviation),
    })
    .ok()
}

/// Reads the table, which may be missing; frequency and amplitude become ratios.
pub(super) fn read(reader: &mut Reader, root: &Table) -> Uncertainty {
    let table = reader.optional::<Uncertainty>(root, "uncertainty");
    let (Some((table, read)), Some(design)) = (table, reader.design) else {
        return Uncertainty::default();
    };
    let amplitude = read.amplitude.over(design.amplitude());
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
    let natural_hz = design.scales().frequency(1.0);
    Uncertainty { frequency_ratio: read.frequency_ratio.over(natural_hz), amplitude, ..read }
}
