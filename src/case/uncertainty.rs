//! The optional table `[uncertainty]`: by how much a built design, and what drives it, may differ from
//! the case.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::inputs::Input;
use super::number::{Form, sign_of};
use super::reader::{Reader, Table};
use super::schema::NUMBER;
use super::value::ValuePlace;
use crate::system::Parameter;

/// How the error of one parameter is distributed around what is written, in the units of its design.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Distribution {
    /// Normally distributed, with this standard deviation.
    Normal(f64),
    /// Uniformly distributed, up to this to either side.
    Uniform(f64),
}

/// Standard deviations of a normal error up to which a number is off, of 19 in 20.
const DEVIATIONS: f64 = 2.0;

impl Distribution {
    /// A standard deviation or the largest error, and how many times that a number is likely to be off by at the most.
    pub const fn tolerance(self) -> (f64, f64) {
        match self {
            Self::Normal(deviation) => (deviation, DEVIATIONS),
            Self::Uniform(largest) => (largest, 1.0),
        }
    }
}

/// By how much a built design, and what drives it, may differ from the case. A value is the standard
/// deviation of a normally distributed error; one behind ± (or +-, in quotes) is the largest of a
/// uniformly distributed one. Each key may be left out.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Uncertainty {
    /// Of the clearance: a length, or a plain number beside [reduced].
    #[schemars(with = "Option<Value>", extend("x-signed" = "clearance", "x-plain" = [0.02], "minimum" = 0))]
    #[schemars(example = "0.2 mm", example = "± 0.2 mm")]
    pub clearance: Option<Distribution>,
    /// Of the restitution.
    #[schemars(with = "Option<Value>", extend("x-signed" = "restitution", "anyOf" = plain_errors(), "minimum" = 0, "maximum" = 1))]
    #[schemars(example = 0.05, example = "± 0.05")]
    pub restitution: Option<Distribution>,
    /// Of the cavity's inclination; not beside [reduced].
    #[schemars(with = "Option<Value>", extend("x-signed" = "inclination", "minimum" = 0))]
    #[schemars(example = "0.2 deg", example = "± 0.5 deg")]
    pub inclination: Option<Distribution>,
    /// Of the coefficient of friction, which stays at 0 or more; not beside [reduced].
    #[schemars(with = "Option<Value>", extend("x-signed" = "friction", "minimum" = 0))]
    #[schemars(example = 0.001, example = "± 0.2 %")]
    pub friction: Option<Distribution>,
    /// Of gravity along the cavity, beside [reduced].
    #[schemars(with = "Option<Value>", extend("x-signed" = "gravity_along", "anyOf" = plain_errors(), "minimum" = 0))]
    #[schemars(example = 0.001, example = "± 0.001")]
    pub gravity_along: Option<Distribution>,
    /// Of the acceleration by friction, which stays at 0 or more, beside [reduced].
    #[schemars(with = "Option<Value>", extend("x-signed" = "friction_acceleration", "anyOf" = plain_errors(), "minimum" = 0))]
    #[schemars(example = 0.001, example = "± 0.001")]
    pub friction_acceleration: Option<Distribution>,
    /// Of the excitation's frequency, that of a whole band included: a frequency, or a frequency ratio
    /// beside [reduced].
    #[schemars(with = "Option<Value>", extend("x-signed" = "frequency", "x-plain" = [0.005], "minimum" = 0))]
    #[schemars(example = "0.05 Hz", example = "± 0.1 Hz")]
    pub frequency: Option<Distribution>,
    /// Of the excitation's amplitude, as in [excitation]; that of a whole band in proportion.
    #[schemars(with = "Option<Value>", extend("x-signed" = "amplitude", "x-plain" = [0.1], "minimum" = 0))]
    #[schemars(example = "0.02 mm", example = "± 0.05 mm")]
    pub amplitude: Option<Distribution>,
    /// Of the oscillator's mass, its stiffness as it is; not beside [reduced].
    #[schemars(with = "Option<Value>", extend("x-signed" = "mass", "minimum" = 0))]
    #[schemars(example = "0.1 kg", example = "± 0.2 kg")]
    pub oscillator_mass: Option<Distribution>,
    /// Of the oscillator's natural frequency, by its stiffness; not beside [reduced].
    #[schemars(with = "Option<Value>", extend("x-signed" = "natural_frequency", "minimum" = 0))]
    #[schemars(example = "0.1 Hz", example = "± 0.3 Hz")]
    pub natural_frequency: Option<Distribution>,
    /// Of the oscillator's damping ratio, which stays at 0 or more; not beside [reduced].
    #[schemars(with = "Option<Value>", extend("x-signed" = "damping_ratio", "minimum" = 0))]
    #[schemars(example = "0.1 %", example = "± 0.2 %")]
    pub damping_ratio: Option<Distribution>,
    /// Of the absorber's mass; not beside [reduced].
    #[schemars(with = "Option<Value>", extend("x-signed" = "absorber_mass", "minimum" = 0))]
    #[schemars(example = "2 g", example = "± 5 g")]
    pub absorber_mass: Option<Distribution>,
    /// Designs that are drawn at random for the probability that all criteria hold, from 20 to 100,000.
    #[schemars(extend("minimum" = 20, "maximum" = 100_000), example = 200)]
    pub samples: Option<u32>,
}

/// By how much a structure of several modes or absorbers may differ from the case, written as of one: an error of an absorber or of an
/// excitation is each one's own, one of a mode is the first one's, and all others change in proportion. Each key may be left out.
#[derive(Debug, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct UncertaintyOfSeveral {
    /// Of each absorber's clearance.
    #[schemars(with = "Option<Value>", extend("x-signed" = "clearance", "x-plain" = [0.02], "minimum" = 0))]
    #[schemars(example = "0.2 mm", example = "± 0.2 mm")]
    clearance: Option<Distribution>,
    /// Of each absorber's restitution.
    #[schemars(with = "Option<Value>", extend("x-signed" = "restitution", "anyOf" = plain_errors(), "minimum" = 0, "maximum" = 1))]
    #[schemars(example = 0.05, example = "± 0.05")]
    restitution: Option<Distribution>,
    /// Of each excitation's amplitude; not beside [reduced].
    #[schemars(with = "Option<Value>", extend("x-signed" = "amplitude", "minimum" = 0))]
    #[schemars(example = "2 N", example = "± 5 N")]
    amplitude: Option<Distribution>,
    /// Of the first mode's modal mass, stiffness as it is; not beside [reduced].
    #[schemars(with = "Option<Value>", extend("x-signed" = "mass", "minimum" = 0))]
    #[schemars(example = "0.1 kg", example = "± 0.2 kg")]
    oscillator_mass: Option<Distribution>,
    /// Of the first mode's natural frequency, by its stiffness; not beside [reduced].
    #[schemars(with = "Option<Value>", extend("x-signed" = "natural_frequency", "minimum" = 0))]
    #[schemars(example = "0.1 Hz", example = "± 0.3 Hz")]
    natural_frequency: Option<Distribution>,
    /// Of the first mode's damping ratio, which stays at 0 or more.
    #[schemars(with = "Option<Value>", extend("x-signed" = "damping_ratio", "minimum" = 0))]
    #[schemars(example = "0.1 %", example = "± 0.2 %")]
    damping_ratio: Option<Distribution>,
    /// Of each absorber's mass; not beside [reduced].
    #[schemars(with = "Option<Value>", extend("x-signed" = "absorber_mass", "minimum" = 0))]
    #[schemars(example = "2 g", example = "± 5 g")]
    absorber_mass: Option<Distribution>,
    /// Designs that are drawn at random for the probability that all criteria hold, from 20 to 100,000.
    #[schemars(extend("minimum" = 20, "maximum" = 100_000), example = 200)]
    samples: Option<u32>,
}

impl From<UncertaintyOfSeveral> for Uncertainty {
    fn from(of: UncertaintyOfSeveral) -> Self {
        Self {
            clearance: of.clearance,
            restitution: of.restitution,
            amplitude: of.amplitude,
            oscillator_mass: of.oscillator_mass,
            natural_frequency: of.natural_frequency,
            damping_ratio: of.damping_ratio,
            absorber_mass: of.absorber_mass,
            samples: of.samples,
            ..Self::default()
        }
    }
}

/// What may be uncertain of a reduced one, whose other numbers are units.
const OF_REDUCED: [&str; 4] = ["clearance", "restitution", "damping_ratio", "samples"];

/// A number, or text with a sign and a number.
fn plain_errors() -> Value {
    let text = format!(r"^\s*(±|\+-|\+/-)\s*{NUMBER}\s*$");
    json!([{ "type": "number", "minimum": 0.0 }, { "type": "string", "pattern": text }])
}

impl Uncertainty {
    /// Whether anything is uncertain.
    pub fn is_any(&self) -> bool {
        self.parameters().next().is_some()
    }

    /// The uncertain parameters, each with its errors in the units of its design.
    pub fn parameters(&self) -> impl Iterator<Item = (Parameter, Distribution)> + use<> {
        let all = [
            (Parameter::Clearance, self.clearance),
            (Parameter::Restitution, self.restitution),
            (Parameter::Frequency, self.frequency),
            (Parameter::Amplitude, self.amplitude),
            (Parameter::Inclination, self.inclination),
            (Parameter::Friction, self.friction),
            (Parameter::GravityAlong, self.gravity_along),
            (Parameter::FrictionAcceleration, self.friction_acceleration),
            (Parameter::Mass, self.oscillator_mass),
            (Parameter::NaturalFrequency, self.natural_frequency),
            (Parameter::DampingRatio, self.damping_ratio),
            (Parameter::AbsorberMass, self.absorber_mass),
        ];
        all.into_iter().filter_map(|(parameter, errors)| Some((parameter, errors?)))
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
pub(super) fn read_error(reader: &mut Reader, place: ValuePlace, form: Form) -> Option<Value> {
    let sign = place.value.get_ref().as_str().and_then(|text| sign_of(text, &SIGNS)).unwrap_or(0);
    let symbol = match form.symbol.as_str() {
        symbol if sign == 0 => format!("s_{symbol}"),
        symbol if symbol.starts_with('\\') => format!(r"\Delta{symbol}"),
        symbol => format!(r"\Delta {symbol}"),
    };
    let size = reader.number(&ValuePlace { sign, ..place }, &Form { symbol, ..form })?;
    serde_json::to_value(match size {
        0.0 => None,
        largest if sign > 0 => Some(Distribution::Uniform(largest)),
        deviation => Some(Distribution::Normal(deviation)),
    })
    .ok()
}

/// Reads the table, which may be missing.
pub(super) fn read(reader: &mut Reader, root: &Table) -> Uncertainty {
    let table = reader.optional::<Uncertainty>(root, "uncertainty");
    let (Some((table, read)), Some(design)) = (table, reader.design) else {
        return Uncertainty::default();
    };
    let keys = table.keys.clone();
    for key in keys.into_iter().filter(|key| table.has(key)) {
        let named = table.schema_of(key)["x-signed"].as_str().and_then(Parameter::of_name);
        let Some(parameter) = named.filter(|one| design.form(*one).is_none()) else { continue };
        let instead = design.counterpart(parameter).map(Parameter::key);
        let instead = instead.map(|key| format!("write {key} instead, or ")).unwrap_or_default();
        let this = design.carried(parameter).unwrap_or(design.writing().words);
        reader.report(
            table.span_of(key),
            format!("{this} has no `{key}` that could be uncertain"),
            "expected a number that the design has",
            format!("{instead}remove the line"),
        );
    }
    if read.amplitude.is_some() && design.value(Parameter::Amplitude) == Some(0.0) {
        reader.report(
            table.span_of_value("amplitude"),
            "the amplitude is uncertain in a case that is not driven",
            "expected an excitation with an amplitude above 0",
            "give the case's own excitation an amplitude, or remove the line",
        );
    }
    read
}

/// Reads the table of a structure of several modes or absorbers, which may be missing; `moves_base` tells of each excitation whether the
/// base moves.
pub(super) fn read_of_several(
    reader: &mut Reader,
    root: &Table,
    is_reduced: bool,
    moves_base: &[bool],
) -> Uncertainty {
    // Amplitudes are written as those of the first one.
    let before = reader.of_several;
    reader.of_several = moves_base.first().copied().or(before);
    let table = reader.optional::<UncertaintyOfSeveral>(root, "uncertainty");
    reader.of_several = before;
    let Some((table, read)) = table else { return Uncertainty::default() };
    let keys = table.keys.clone();
    for key in keys.into_iter().filter(|key| table.has(key)) {
        let (message, help) = if is_reduced && !OF_REDUCED.contains(&key) {
            (
                format!("`{key}` cannot be uncertain beside [reduced]"),
                "remove the line, or write the structure with units",
            )
        } else if key == "amplitude" && moves_base.windows(2).any(|two| two[0] != two[1]) {
            (
                "one error cannot be that of a force and of a base".to_owned(),
                "remove the line, or write a case for each excitation",
            )
        } else {
            continue;
        };
        reader.report(table.span_of(key), message, "expected a number that all have alike", help);
    }
    read.into()
}
