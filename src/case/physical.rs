//! The tables `[oscillator]`, `[absorber]` and `[excitation]`: a design in physical units.

use std::f64::consts::TAU;

use libm::sqrt;
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::{Value, json};

use super::names::names;
use super::quantity::{
    Damping, Dimension, Force, Frequency, Length, Mass, Measurand, Quantity, Stiffness,
};
use super::reader::Reader;
use super::schema::{Ratio, one_of, pattern};
use super::table::Table;
use crate::system::Excitation;

/// The linear oscillator whose vibration is to be reduced.
#[derive(Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields, extend("allOf" = [
    { "oneOf": one_of("stiffness", "frequency") },
    { "oneOf": one_of("damping", "damping_ratio") },
]))]
pub(super) struct OscillatorTable {
    /// m1, the oscillator's mass, above 0.
    #[schemars(extend("exclusiveMinimum" = 0, "x-symbol" = "m_1"), example = "4.168 kg")]
    mass: Quantity<Mass>,
    /// k1, the stiffness between base and oscillator, above 0; or give frequency.
    #[schemars(extend("exclusiveMinimum" = 0, "x-symbol" = "k_1"))]
    stiffness: Option<Quantity<Stiffness>>,
    /// f0 = sqrt(k1 / m1) / (2 pi), the natural frequency, above 0; or give stiffness.
    #[schemars(extend("exclusiveMinimum" = 0, "x-symbol" = "f_0"), example = "8.35 Hz")]
    frequency: Option<Quantity<Frequency>>,
    /// c1, the viscous damping between base and oscillator, 0 or more; or give damping_ratio.
    #[schemars(extend("minimum" = 0, "x-symbol" = "c_1"))]
    damping: Option<Quantity<Damping>>,
    /// c1 / (2 sqrt(k1 m1)), 0 or more; or give damping.
    #[schemars(extend("minimum" = 0, "x-symbol" = r"\zeta_1"), example = 0.0069, example = "0.69 %")]
    damping_ratio: Option<Ratio>,
}

/// The small mass that moves freely between two walls of the oscillator.
#[derive(Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields, extend("oneOf" = one_of("mass", "mass_ratio")))]
pub(super) struct AbsorberTable {
    /// m2, the absorber's mass, above 0; or give mass_ratio.
    #[schemars(extend("exclusiveMinimum" = 0, "x-symbol" = "m_2"))]
    mass: Option<Quantity<Mass>>,
    /// m2 / m1, above 0; or give mass.
    #[schemars(
        extend("exclusiveMinimum" = 0, "x-symbol" = r"\varepsilon"), example = 0.0077, example = "0.77 %"
    )]
    mass_ratio: Option<Ratio>,
    /// b, the free distance from the middle to either wall, above 0.
    #[schemars(extend("exclusiveMinimum" = 0, "x-symbol" = "b"))]
    clearance: Quantity<Length>,
    /// r, the coefficient of restitution: 1 loses no energy at an impact, 0 does not rebound.
    #[schemars(range(min = 0.0, max = 1.0), extend("x-symbol" = "r"), example = 0.6)]
    restitution: f64,
}

/// What drives the oscillator harmonically.
#[derive(Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields, extend("oneOf" = amplitude_by_kind()))]
pub(super) struct ExcitationTable {
    kind: Kind,
    /// F, the displacement amplitude of the base, or P, the amplitude of the force; 0 or more.
    #[schemars(with = "String", example = "0.25 mm")]
    amplitude: f64,
    /// f, the excitation frequency, above 0.
    #[schemars(extend("exclusiveMinimum" = 0, "x-symbol" = "f"))]
    frequency: Quantity<Frequency>,
}

names! { name:
    /// "base-displacement" shakes the base, "force" pushes the oscillator.
    pub(super) enum Kind {
        /// The base moves.
        BaseDisplacement = "base-displacement",
        /// A force acts on the oscillator's mass.
        Force = "force",
    }
}

impl From<Kind> for Excitation {
    fn from(kind: Kind) -> Self {
        match kind {
            Kind::BaseDisplacement => Self::BaseDisplacement,
            Kind::Force => Self::Force,
        }
    }
}

/// For each kind of excitation how its amplitude is written.
fn amplitude_by_kind() -> Value {
    let case = |kind: Kind, pattern: String, example: &str, measures: &str, symbol: &str| {
        let amplitude = json!({
            "pattern": pattern, "examples": [example], "minimum": 0,
            "x-measurand": measures, "x-symbol": symbol,
        });
        json!({ "properties": { "kind": { "const": kind.name() }, "amplitude": amplitude } })
    };
    json!([
        case(Kind::BaseDisplacement, pattern::<Length>(), "0.25 mm", Length::NAME, "F"),
        case(Kind::Force, pattern::<Force>(), "2.9 N", Force::NAME, "P"),
    ])
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
    /// What drives the oscillator, and how much.
    pub excitation: PhysicalExcitation,
    /// `f`, the excitation frequency.
    pub frequency_hz: f64,
}

/// What drives the oscillator.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PhysicalExcitation {
    /// The base moves by `F sin(omega t)`.
    BaseDisplacement {
        /// `F`.
        amplitude_m: f64,
    },
    /// The force `P sin(omega t)` acts on the oscillator's mass.
    Force {
        /// `P`.
        amplitude_n: f64,
    },
}

impl PhysicalExcitation {
    /// Where the excitation enters, without its amplitude.
    pub fn kind(self) -> Excitation {
        match self {
            Self::BaseDisplacement { .. } => Excitation::BaseDisplacement,
            Self::Force { .. } => Excitation::Force,
        }
    }

    /// `F` in m, or `P` in N.
    pub fn amplitude(mut self) -> f64 {
        *self.amplitude_mut()
    }

    pub(super) fn amplitude_mut(&mut self) -> &mut f64 {
        match self {
            Self::BaseDisplacement { amplitude_m: amplitude }
            | Self::Force { amplitude_n: amplitude } => amplitude,
        }
    }
}

impl Physical {
    /// `omega0 = sqrt(k1/m1)`, the natural frequency in rad/s.
    pub fn natural_frequency_rad_per_s(&self) -> f64 {
        sqrt(self.stiffness_n_per_m) / sqrt(self.mass_kg)
    }

    /// `2 sqrt(k1 m1)`, the damping at which the oscillator alone ceases to ring, in N s/m.
    pub fn critical_damping_n_s_per_m(&self) -> f64 {
        critical_damping(self.stiffness_n_per_m, self.mass_kg)
    }
}

/// `2 sqrt(k1 m1)` in N s/m.
fn critical_damping(stiffness: f64, mass: f64) -> f64 {
    2.0 * sqrt(stiffness) * sqrt(mass)
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
    let mass_kg = oscillator.mass.si();
    let stiffness_n_per_m = match (oscillator.stiffness, oscillator.frequency) {
        (Some(stiffness), _) => stiffness.si(),
        (None, frequency) => stiffness_of(reader, &table, frequency?.si(), mass_kg)?,
    };
    let damping_n_s_per_m = match (oscillator.damping, oscillator.damping_ratio) {
        (Some(damping), _) => damping.si(),
        (None, ratio) => ratio?.0 * critical_damping(stiffness_n_per_m, mass_kg),
    };
    let ((_, absorber), (_, excitation)) = (absorber?, excitation?);
    Some(Physical {
        mass_kg,
        stiffness_n_per_m,
        damping_n_s_per_m,
        absorber_mass_kg: match (absorber.mass, absorber.mass_ratio) {
            (Some(mass), _) => mass.si(),
            (None, ratio) => ratio?.0 * mass_kg,
        },
        clearance_m: absorber.clearance.si(),
        restitution: absorber.restitution,
        excitation: match excitation.kind {
            Kind::BaseDisplacement => {
                PhysicalExcitation::BaseDisplacement { amplitude_m: excitation.amplitude }
            }
            Kind::Force => PhysicalExcitation::Force { amplitude_n: excitation.amplitude },
        },
        frequency_hz: excitation.frequency.si(),
    })
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
    let measured = Measurand::of(amplitude.get_ref().as_str()?)?;
    let kind = match measured {
        force if force == Force::OF => Kind::Force,
        length if length == Length::OF => Kind::BaseDisplacement,
        _ => return None,
    };
    let of_other_unit = |problem: &&mut super::Problem| {
        amplitude.span().contains(&problem.span.start) && problem.message.contains("is the unit of")
    };
    let problem = reader.problems.iter_mut().find(of_other_unit)?;
    let help = problem.help.take().unwrap_or_default();
    let (measures, kind) = (measured.name, kind.name());
    problem.help = Some(format!("{help}; if {measures} is meant, write kind = \"{kind}\""));
    Some(())
}
