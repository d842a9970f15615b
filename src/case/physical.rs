//! The tables `[oscillator]`, `[absorber]` and `[excitation]`: a design in physical units.

use std::f64::consts::TAU;

use libm::sqrt;
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::{Value, json};

use super::reader::{Reader, Table};
use super::record;
use super::schema::one_of;
use crate::names::names;
use crate::quantity::Dimension;
use crate::system::Excitation;
use crate::transient::{RecordQuantity, Release, SineSweep, SweepRate, Transient};

/// The linear oscillator whose vibration is to be reduced.
#[derive(Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields, extend("allOf" = [
    { "oneOf": one_of("stiffness", "frequency") },
    { "oneOf": one_of("damping", "damping_ratio") },
]))]
pub(super) struct OscillatorTable {
    /// m1, the oscillator's mass, above 0.
    #[schemars(extend("x-measurand" = "a mass", "exclusiveMinimum" = 0, "x-symbol" = "m_1"), example = "4.168 kg")]
    mass: f64,
    /// k1, the stiffness between base and oscillator, above 0; or give frequency.
    #[schemars(extend("x-measurand" = "a stiffness", "exclusiveMinimum" = 0, "x-symbol" = "k_1"))]
    stiffness: Option<f64>,
    /// f0 = sqrt(k1 / m1) / (2 pi), the natural frequency, above 0; or give stiffness.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0, "x-symbol" = "f_0"), example = "8.35 Hz")]
    frequency: Option<f64>,
    /// c1, the viscous damping between base and oscillator, 0 or more; or give damping_ratio.
    #[schemars(extend("x-measurand" = "a damping", "minimum" = 0, "x-symbol" = "c_1"))]
    damping: Option<f64>,
    /// c1 / (2 sqrt(k1 m1)), 0 or more; or give damping.
    #[schemars(extend("x-measurand" = "a share", "minimum" = 0, "x-symbol" = r"\zeta_1"), example = 0.0069, example = "0.69 %")]
    damping_ratio: Option<f64>,
}

/// The small mass that moves freely between two walls of the oscillator.
#[derive(Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields, extend("oneOf" = one_of("mass", "mass_ratio")))]
pub(super) struct AbsorberTable {
    /// m2, the absorber's mass, above 0; or give mass_ratio.
    #[schemars(extend("x-measurand" = "a mass", "exclusiveMinimum" = 0, "x-symbol" = "m_2"))]
    mass: Option<f64>,
    /// m2 / m1, above 0; or give mass.
    #[schemars(
        extend("x-measurand" = "a share", "exclusiveMinimum" = 0, "x-symbol" = r"\varepsilon"), example = 0.0077, example = "0.77 %"
    )]
    mass_ratio: Option<f64>,
    /// b, the free distance from the middle to either wall, above 0.
    #[schemars(extend("x-measurand" = "a length", "exclusiveMinimum" = 0, "x-symbol" = "b"))]
    clearance: f64,
    /// r, the coefficient of restitution: 1 loses no energy at an impact, 0 does not rebound.
    #[schemars(range(min = 0.0, max = 1.0), extend("x-symbol" = "r"), example = 0.6)]
    restitution: f64,
}

names! { name:
    /// How the oscillator is set in motion.
    pub(super) enum ExcitationKind {
        /// The base moves by F sin(omega t).
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
#[derive(Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields, extend("oneOf" = keys_by_kind()))]
pub(super) struct ExcitationTable {
    /// "base-displacement" shakes the base, "force" pushes the oscillator; "free" lets it go, "impulse" strikes it;
    /// "sine-sweep" goes through a range of frequencies; "record" drives it as a file or a spectrum says.
    kind: ExcitationKind,
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
    amplitude: Option<f64>,
    /// f, the excitation frequency, above 0.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0, "x-symbol" = "f"))]
    frequency: Option<f64>,
    /// What is swept: "base-displacement" or "force".
    of: Option<Excitation>,
    /// Frequency at which a sweep begins, from rest, above 0; with one above `to` it goes down.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0, "x-symbol" = "f_1"), example = "7.5 Hz")]
    from: Option<f64>,
    /// Frequency at which it ends, above 0.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0, "x-symbol" = "f_2"), example = "9 Hz")]
    to: Option<f64>,
    /// How fast the frequency changes, above 0: by so many hertz or octaves in a time.
    #[schemars(extend("x-measurand" = "a sweep rate", "exclusiveMinimum" = 0, "x-symbol" = r"\dot{f}"), example = "0.1 Hz/s")]
    rate: Option<f64>,
    /// Displacement from which the oscillator is let go, its velocity, or both; 0 or more.
    #[schemars(extend("x-measurand" = "a length", "minimum" = 0, "x-symbol" = "x_0"), example = "5 mm")]
    displacement: Option<f64>,
    /// Velocity of the oscillator when it is let go, or that which a shock gives the base; 0 or more.
    #[schemars(extend("x-measurand" = "a velocity", "minimum" = 0, "x-symbol" = r"\dot{x}_0"), example = "0.2 m/s")]
    velocity: Option<f64>,
    /// Impulse on the oscillator, above 0; or give the velocity of the base.
    #[schemars(extend("x-measurand" = "an impulse", "exclusiveMinimum" = 0, "x-symbol" = "J"), example = "2 N s")]
    impulse: Option<f64>,
}

/// A frequency and a density.
fn corner() -> Value {
    json!({
        "type": "array", "minItems": 2, "maxItems": 2,
        "items": { "type": "number", "exclusiveMinimum": 0 },
    })
}

/// For each kind of excitation the keys that it has, and how its amplitude is written.
fn keys_by_kind() -> Value {
    let amplitude = |of: Excitation| {
        let (example, measures, symbol) = match of {
            Excitation::BaseDisplacement => ("0.25 mm", "a length", "F"),
            Excitation::Force => ("2.9 N", "a force", "P"),
        };
        json!({
            "type": "number", "examples": [example], "minimum": 0,
            "x-measurand": measures, "x-symbol": symbol,
        })
    };
    let harmonic = |kind: Excitation| {
        json!({
            "properties": { "kind": { "const": kind }, "amplitude": amplitude(kind), "frequency": true },
            "required": ["amplitude", "frequency"],
        })
    };
    let swept = |of: Excitation| {
        json!({
            "properties": {
                "kind": { "const": "sine-sweep" }, "of": { "const": of }, "amplitude": amplitude(of),
                "from": true, "to": true, "rate": true,
            },
            "required": ["of", "amplitude", "from", "to", "rate"],
        })
    };
    let own = |kind: &str, keys: [&str; 2], how: &str| {
        let properties = json!({ "kind": { "const": kind }, keys[0]: true, keys[1]: true });
        json!({ "properties": properties, how: one_of(keys[0], keys[1]) })
    };
    json!([
        harmonic(Excitation::BaseDisplacement),
        harmonic(Excitation::Force),
        swept(Excitation::BaseDisplacement),
        swept(Excitation::Force),
        own("free", ["displacement", "velocity"], "anyOf"),
        own("impulse", ["impulse", "velocity"], "oneOf"),
        {
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
        },
    ])
}

impl ExcitationTable {
    /// What is not steady in it; `None` for harmonic excitation of one frequency, or where something is missing.
    fn transient(&self, rate_in: Option<Dimension>) -> Option<Transient> {
        if self.kind != ExcitationKind::SineSweep {
            return self.release().map(Transient::Release);
        }
        let rate = match rate_in {
            Some(Dimension::OctaveRate) => SweepRate::Octaves(self.rate?),
            _ => SweepRate::Linear(self.rate?),
        };
        Some(Transient::Sweep(SineSweep { from: self.from?, to: self.to?, rate }))
    }

    /// How the oscillator is set in motion, if nothing drives it.
    fn release(&self) -> Option<Release> {
        let [displacement, velocity, impulse] =
            [self.displacement, self.velocity, self.impulse].map(Option::unwrap_or_default);
        match self.kind {
            ExcitationKind::BaseDisplacement
            | ExcitationKind::Force
            | ExcitationKind::SineSweep
            | ExcitationKind::Record => None,
            ExcitationKind::Free => {
                Some(Release { displacement, velocity, absorber_velocity: 0.0, impulse: 0.0 })
            }
            // The base comes to move: so do structure and absorber against it, the other way.
            ExcitationKind::Impulse => {
                Some(Release { displacement: 0.0, velocity, absorber_velocity: velocity, impulse })
            }
        }
    }
}

/// A design in SI units. [`Case::parse`](super::Case::parse) proves every value finite, masses,
/// stiffness, clearance and frequency above 0, damping and amplitude at least 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Physical {
    /// `m1`, the mass of the linear oscillator.
    pub mass_kg: f64,
    /// `k1`, the stiffness between base and oscillator.
    pub stiffness_n_per_m: f64,
    /// `c1`, the viscous damping between base and oscillator.
    pub damping_n_s_per_m: f64,
    /// `m2`, the mass of the absorber.
    pub absorber_mass_kg: f64,
    /// `b`: the absorber is free while its displacement relative to the oscillator is below `b`.
    pub clearance_m: f64,
    /// `r`, the coefficient of restitution, from 0 to 1.
    pub restitution: f64,
    /// What drives the oscillator.
    pub excitation: Excitation,
    /// `F` in m, the base's displacement, or `P` in N, the force on the oscillator's mass.
    pub amplitude: f64,
    /// `f`, the excitation frequency; that at which a sweep begins, the natural one where nothing drives the
    /// oscillator.
    pub frequency_hz: f64,
    /// What is not steady harmonic excitation.
    pub transient: Option<Transient>,
}

impl Physical {
    /// `omega0 = sqrt(k1/m1)`, the natural frequency in rad/s.
    pub fn natural_frequency_rad_per_s(&self) -> f64 {
        sqrt(self.stiffness_n_per_m) / sqrt(self.mass_kg)
    }

    /// `2 sqrt(k1 m1)`, the damping at which the oscillator alone ceases to ring, in N s/m.
    pub fn critical_damping_n_s_per_m(&self) -> f64 {
        2.0 * sqrt(self.stiffness_n_per_m) * sqrt(self.mass_kg)
    }
}

pub(super) const TABLES: [&str; 3] = ["oscillator", "absorber", "excitation"];

/// Reads the three tables; `None` when something was reported.
pub(super) fn read(reader: &mut Reader, root: &Table) -> Option<Physical> {
    report_missing(reader, root);
    let oscillator = reader.optional::<OscillatorTable>(root, TABLES[0]);
    let absorber = reader.optional::<AbsorberTable>(root, TABLES[1]);
    let excitation = reader.optional::<ExcitationTable>(root, TABLES[2]);
    hint_other_kind(reader, root);
    let (table, oscillator) = oscillator?;
    let stiffness_n_per_m = match (oscillator.stiffness, oscillator.frequency) {
        (Some(stiffness), _) => stiffness,
        (None, frequency) => stiffness_of(reader, &table, frequency?, oscillator.mass)?,
    };
    let ((_, absorber), (place, excitation)) = (absorber?, excitation?);
    let written = place.value("rate").and_then(|rate| rate.get_ref().as_str());
    let transient = excitation.transient(written.and_then(Dimension::of));
    if let Some((message, expected, help)) = impossible(transient.as_ref()) {
        reader.report(place.span.clone(), message, expected, help);
        return None;
    }
    let mut physical = Physical {
        mass_kg: oscillator.mass,
        stiffness_n_per_m,
        damping_n_s_per_m: 0.0,
        absorber_mass_kg: match (absorber.mass, absorber.mass_ratio) {
            (Some(mass), _) => mass,
            (None, ratio) => ratio? * oscillator.mass,
        },
        clearance_m: absorber.clearance,
        restitution: absorber.restitution,
        excitation: match (excitation.kind, excitation.quantity) {
            (ExcitationKind::Force, _) | (_, Some(RecordQuantity::Force)) => Excitation::Force,
            _ => excitation.of.unwrap_or_default(),
        },
        amplitude: excitation.amplitude.unwrap_or_default(),
        frequency_hz: 0.0,
        transient,
    };
    physical.frequency_hz = match (transient, excitation.kind) {
        (Some(Transient::Sweep(sweep)), _) => sweep.from,
        (_, ExcitationKind::BaseDisplacement | ExcitationKind::Force) => excitation.frequency?,
        _ => physical.natural_frequency_rad_per_s() / TAU,
    };
    physical.damping_n_s_per_m = match (oscillator.damping, oscillator.damping_ratio) {
        (Some(damping), _) => damping,
        (None, ratio) => ratio? * physical.critical_damping_n_s_per_m(),
    };
    if excitation.kind == ExcitationKind::Record {
        reader.recording = Some(record::read(reader, &place, excitation)?);
        let quantity = reader.recording.as_ref().map(|recording| recording.quantity);
        physical.transient = quantity.map(Transient::Record);
    }
    Some(physical)
}

/// Why an excitation whose numbers are each valid cannot be: message, what was expected, help.
pub(super) fn impossible(transient: Option<&Transient>) -> Option<(String, String, &'static str)> {
    match transient? {
        Transient::Release(Release { displacement, velocity, impulse, .. })
            if [*displacement, *velocity, *impulse] == [0.0; 3] =>
        {
            Some((
                "nothing sets the oscillator in motion".into(),
                "expected a displacement, a velocity or an impulse above 0".into(),
                "give displacement = \"5 mm\", velocity = \"0.2 m/s\" or, for a shock, impulse = \"2 N s\"",
            ))
        }
        Transient::Release(_) => None,
        Transient::Sweep(sweep) if sweep.fastest_change() > SineSweep::LARGEST_CHANGE => Some((
            format!("the frequency changes by {:.3} % in a period", 100.0 * sweep.fastest_change()),
            format!("expected at most {} %", 100.0 * SineSweep::LARGEST_CHANGE),
            "choose a lower `rate`: so fast a change is a shock, not a sweep",
        )),
        Transient::Sweep(sweep) if sweep.count() < SineSweep::FEWEST => Some((
            format!("the sweep has {} whole periods", sweep.count()),
            format!("expected at least {}", SineSweep::FEWEST),
            "choose `from` and `to` further apart, or a lower `rate`",
        )),
        Transient::Sweep(_) | Transient::Record(_) => None,
    }
}

fn report_missing(reader: &mut Reader, root: &Table) {
    let present = TABLES.into_iter().find(|table| root.has(table)).unwrap_or_default();
    for name in TABLES.into_iter().filter(|name| !root.has(name)) {
        let message = format!("the table [{name}] is missing");
        let expected = format!("expected [{}] beside it", TABLES.join("], ["));
        let help = format!(
            "add a line [{name}] and its keys below it; `vinesink new NAME` shows them all"
        );
        reader.report(root.span_of(present), message, expected, help);
    }
}

/// `k1` in N/m of a natural frequency in Hz and a mass in kg, each valid by itself.
fn stiffness_of(reader: &mut Reader, table: &Table, frequency: f64, mass: f64) -> Option<f64> {
    let omega0 = TAU * frequency;
    let stiffness = mass * omega0 * omega0;
    if stiffness.is_finite() && stiffness > 0.0 {
        return Some(stiffness);
    }
    let message =
        format!("a natural frequency with this mass gives a stiffness of {stiffness} N/m");
    let help = "check the units of `frequency` and `mass`";
    let expected = "expected a stiffness above 0 that a number can hold";
    reader.report(table.span_of_value("frequency"), message, expected, help);
    None
}

/// Adds the way out when the amplitude suits the other kind of excitation.
fn hint_other_kind(reader: &mut Reader, root: &Table) -> Option<()> {
    let amplitude = root.value(TABLES[2])?.get_ref().get("amplitude")?;
    let measured = Dimension::of(amplitude.get_ref().as_str()?)?;
    let kind = match measured {
        Dimension::Force => json!(Excitation::Force),
        Dimension::Length => json!(Excitation::BaseDisplacement),
        _ => return None,
    };
    let of_other_unit = |problem: &&mut super::Problem| {
        amplitude.span().contains(&problem.span.start) && problem.message.contains("is the unit of")
    };
    let problem = reader.problems.iter_mut().find(of_other_unit)?;
    let help = problem.help.take().unwrap_or_default();
    let measures = measured.words().0;
    problem.help = Some(format!("{help}; if {measures} is meant, write kind = {kind}"));
    Some(())
}
