//! What drives the oscillator or sets it in motion, by its kind: in `[excitation]`, and without units in `[reduced]`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::reader::{Reader, Table};
use super::record;
use super::schema::one_of;
use crate::excitation::{RecordQuantity, Release, SineSweep, SweepRate, Transient};
use crate::quantity::Dimension;
use crate::system::Excitation;
use vinesink_core::names;

names! { name:
    /// How the oscillator is set in motion.
    #[derive(Default, Serialize)]
    #[derive(schemars::JsonSchema)]
    pub(super) enum ExcitationKind {
        /// The base moves by F sin(omega t).
        #[default]
        BaseDisplacement = "base-displacement",
        /// A force P sin(omega t) acts on the oscillator.
        Force = "force",
        /// The oscillator is let go, and nothing drives it.
        Free = "free",
        /// A shock: a force too short to be followed, or a sudden velocity of the base.
        Impulse = "impulse",
        /// The frequency of a harmonic excitation goes evenly through a range.
        SineSweep = "sine-sweep",
        /// A record of the base's motion or of a force, or noise of a given spectrum.
        Record = "record",
    }
}

/// What drives the oscillator, or sets it in motion.
#[derive(Default, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields, extend("oneOf" = keys_by_kind(false)))]
pub(super) struct ExcitationTable {
    /// "base-displacement" shakes the base, "force" pushes the oscillator; "free" lets it go, "impulse" strikes it;
    /// "sine-sweep" goes through a range of frequencies; "record" drives it as a file or a spectrum says.
    pub(super) kind: ExcitationKind,
    /// What a record, or a spectrum, is of.
    #[schemars(example = "base-acceleration")]
    pub(super) quantity: Option<RecordQuantity>,
    /// The record: a CSV file beside the case, a time and a value a line below a head that names the units.
    #[schemars(example = "quake.csv")]
    pub(super) file: Option<String>,
    /// One-sided power spectral density instead of a file: frequencies in Hz that ascend, each with the density there
    /// in the squared SI unit of the quantity per Hz; straight in between on logarithmic scales, nothing outside.
    #[schemars(extend("minItems" = 2, "x-ascending" = true, "items" = corner()))]
    #[schemars(example = vec![[0.5, 0.02], [5.0, 0.02]])]
    pub(super) spectrum: Option<Vec<[f64; 2]>>,
    /// How long each record of a spectrum is, above 0.
    #[schemars(extend("x-measurand" = "a time", "exclusiveMinimum" = 0, "x-symbol" = "T"), example = "60 s")]
    pub(super) duration: Option<f64>,
    /// What the random numbers of a spectrum begin with: the same seed gives the same records.
    #[schemars(range(min = 0, max = 1_000_000_000), extend("x-symbol" = r"\mathrm{seed}"), example = 1)]
    pub(super) seed: Option<u64>,
    /// How many records are made of a spectrum, 20 unless given.
    #[schemars(range(min = 2, max = 1000), extend("x-symbol" = r"N_\mathrm{records}"), example = 20)]
    pub(super) realisations: Option<u64>,
    /// F, the displacement amplitude of the base, or P, the amplitude of the force; 0 or more.
    #[schemars(with = "Option<String>", example = "0.25 mm")]
    pub(super) amplitude: Option<f64>,
    /// f, the excitation frequency, above 0.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0, "x-symbol" = "f"))]
    pub(super) frequency: Option<f64>,
    /// What is swept: "base-displacement" or "force".
    pub(super) of: Option<Excitation>,
    /// Frequency at which a sweep begins, from rest, above 0; with one above `to` it goes down.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0, "x-symbol" = "f_1"), example = "7.5 Hz")]
    pub(super) from: Option<f64>,
    /// Frequency at which it ends, above 0.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0, "x-symbol" = "f_2"), example = "9 Hz")]
    pub(super) to: Option<f64>,
    /// How fast the frequency changes, above 0: by so many hertz or octaves in a time.
    #[schemars(extend("x-measurand" = "a sweep rate", "exclusiveMinimum" = 0, "x-symbol" = r"\dot{f}"), example = "0.1 Hz/s")]
    pub(super) rate: Option<f64>,
    /// Displacement from which the oscillator is let go, its velocity, or both; 0 or more.
    #[schemars(extend("x-measurand" = "a length", "minimum" = 0, "x-symbol" = "x_0"), example = "5 mm")]
    pub(super) displacement: Option<f64>,
    /// Velocity of the oscillator when it is let go, or that which a shock gives the base; 0 or more.
    #[schemars(extend("x-measurand" = "a velocity", "minimum" = 0, "x-symbol" = r"\dot{x}_0"), example = "0.2 m/s")]
    pub(super) velocity: Option<f64>,
    /// Impulse on the oscillator, above 0; or give the velocity of the base.
    #[schemars(extend("x-measurand" = "an impulse", "exclusiveMinimum" = 0, "x-symbol" = "J"), example = "2 N s")]
    pub(super) impulse: Option<f64>,
}

/// A frequency and a density.
fn corner() -> Value {
    json!({
        "type": "array", "minItems": 2, "maxItems": 2,
        "items": { "type": "number", "exclusiveMinimum": 0 },
    })
}

/// For each kind of excitation the keys that it has, and how its amplitude is written; in `[reduced]` that is its
/// forcing, and the first kind holds where none is given.
pub(super) fn keys_by_kind(reduced: bool) -> Value {
    let strength = if reduced { "forcing" } else { "amplitude" };
    let amplitude = |of: Excitation| {
        let (example, measures, symbol) = match of {
            _ if reduced => return json!(true),
            Excitation::BaseDisplacement => ("0.25 mm", "a length", "F"),
            Excitation::Force => ("2.9 N", "a force", "P"),
        };
        json!({
            "type": "number", "examples": [example], "minimum": 0,
            "x-measurand": measures, "x-symbol": symbol,
        })
    };
    let harmonic = |kind: Excitation| match reduced {
        false => json!({
            "properties": { "kind": { "const": kind }, strength: amplitude(kind), "frequency": true },
            "required": [strength, "frequency"],
        }),
        true => json!({
            "properties": {
                "kind": { "const": kind }, strength: true, "frequency_ratio": true, "detuning": true,
            },
            "required": [strength],
            "oneOf": one_of("frequency_ratio", "detuning"),
        }),
    };
    let swept = |of: Excitation| {
        json!({
            "properties": {
                "kind": { "const": "sine-sweep" }, "of": { "const": of }, strength: amplitude(of),
                "from": true, "to": true, "rate": true,
            },
            "required": ["of", strength, "from", "to", "rate"],
        })
    };
    let own = |kind: &str, keys: [&str; 2], how: &str| {
        let properties = json!({ "kind": { "const": kind }, keys[0]: true, keys[1]: true });
        json!({ "properties": properties, "required": [], how: one_of(keys[0], keys[1]) })
    };
    let mut branches = [
        harmonic(Excitation::BaseDisplacement),
        harmonic(Excitation::Force),
        swept(Excitation::BaseDisplacement),
        swept(Excitation::Force),
        own("free", ["displacement", "velocity"], "anyOf"),
        own("impulse", ["impulse", "velocity"], "oneOf"),
        recorded(reduced),
    ];
    for branch in &mut branches[1..] {
        branch["required"].as_array_mut().into_iter().for_each(|keys| keys.push("kind".into()));
    }
    json!(branches)
}

/// Those of a record; a spectrum has units.
fn recorded(reduced: bool) -> Value {
    if reduced {
        return json!({
            "properties": { "kind": { "const": "record" }, "quantity": true, "file": true },
            "required": ["quantity", "file"],
        });
    }
    json!({
        "properties": {
            "kind": { "const": "record" }, "quantity": true, "file": true, "spectrum": true,
            "duration": true, "seed": true, "realisations": true,
        },
        "required": ["quantity"],
        "oneOf": one_of("file", "spectrum"),
        "dependentRequired": {
            "spectrum": ["duration", "seed"], "duration": ["spectrum"], "seed": ["spectrum"],
            "realisations": ["spectrum"],
        },
    })
}

impl ExcitationTable {
    /// Where it enters.
    pub(super) fn enters(&self) -> Excitation {
        match (self.kind, self.quantity) {
            (ExcitationKind::Force, _) | (_, Some(RecordQuantity::Force)) => Excitation::Force,
            _ => self.of.unwrap_or_default(),
        }
    }

    /// What is not steady in it, none of harmonic excitation of one frequency. `None` where something is missing or
    /// was reported. With the phase of a period in the unit of frequencies.
    pub(super) fn transient(
        &self,
        reader: &mut Reader,
        place: &Table,
        turn: f64,
    ) -> Option<Option<Transient>> {
        let found = match self.kind {
            ExcitationKind::BaseDisplacement | ExcitationKind::Force => return Some(None),
            ExcitationKind::Record => {
                reader.recording = Some(record::read(reader, place, self)?);
                return self.quantity.map(|quantity| Some(Transient::Record(quantity)));
            }
            ExcitationKind::SineSweep => {
                let written = place.value("rate").and_then(|rate| rate.get_ref().as_str());
                let rate = match written.and_then(Dimension::of) {
                    Some(Dimension::OctaveRate) => SweepRate::Octaves(self.rate?),
                    _ => SweepRate::Linear(self.rate?),
                };
                Transient::Sweep(SineSweep { from: self.from?, to: self.to?, rate, turn })
            }
            ExcitationKind::Free | ExcitationKind::Impulse => {
                let given = [self.displacement, self.velocity, self.impulse];
                // A number that could not be read was reported.
                let unread = |(key, value): (&str, Option<f64>)| value.is_none() && place.has(key);
                if ["displacement", "velocity", "impulse"].into_iter().zip(given).any(unread) {
                    return None;
                }
                Transient::Release(self.release())
            }
        };
        let Some((message, expected, help)) = impossible(&found) else { return Some(Some(found)) };
        reader.report(place.span.clone(), message, expected, help);
        None
    }

    /// How the oscillator is set in motion where nothing drives it.
    fn release(&self) -> Release {
        let [displacement, velocity, impulse] =
            [self.displacement, self.velocity, self.impulse].map(Option::unwrap_or_default);
        // The base comes to move: so do structure and absorber against it, the other way.
        let absorber_velocity = if self.kind == ExcitationKind::Free { 0.0 } else { velocity };
        Release { displacement, velocity, absorber_velocity, impulse }
    }
}

/// Why an excitation whose numbers are each valid cannot be: message, what was expected, help.
pub(super) fn impossible(transient: &Transient) -> Option<(String, String, &'static str)> {
    match transient {
        Transient::Release(Release { displacement, velocity, impulse, .. })
            if [*displacement, *velocity, *impulse] == [0.0; 3] =>
        {
            Some((
                "nothing sets the oscillator in motion".into(),
                "expected a displacement, a velocity or an impulse above 0".into(),
                "to let it go takes `displacement` or `velocity` above 0, a shock `impulse` or `velocity`",
            ))
        }
        Transient::Sweep(sweep) if sweep.fastest_change() > SineSweep::LARGEST_CHANGE => Some((
            match 100.0 * sweep.fastest_change() {
                told if told < 1e6 => format!("the frequency changes by {told:.3} % in a period"),
                _ => "the frequency changes by more than 1e6 % in a period".into(),
            },
            format!("expected at most {} %", 100.0 * SineSweep::LARGEST_CHANGE),
            "choose a lower `rate`: so fast a change is a shock, not a sweep",
        )),
        Transient::Sweep(sweep) if sweep.count() < SineSweep::FEWEST => Some((
            format!("the sweep has {} whole periods", sweep.count()),
            format!("expected at least {}", SineSweep::FEWEST),
            "choose `from` and `to` further apart, or a lower `rate`",
        )),
        Transient::Release(_) | Transient::Sweep(_) | Transient::Record(_) => None,
    }
}
