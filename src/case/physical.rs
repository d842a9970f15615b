//! The tables `[oscillator]`, `[absorber]` and `[excitation]`: a design in physical units.

use std::f64::consts::TAU;

use libm::sqrt;

use super::quantity::{
    Damping, Dimension, Force, Frequency, Length, Mass, Stiffness, dimension_of,
};
use super::reader::{Bound, Field, Reader};
use super::suggest::nearest;
use super::table::Table;
use crate::system::Excitation;

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
pub(super) const OSCILLATOR: &[&str] =
    &["mass", "stiffness", "frequency", "damping", "damping_ratio"];
pub(super) const ABSORBER: &[&str] = &["mass", "mass_ratio", "clearance", "restitution"];
pub(super) const EXCITATION: &[&str] = &["kind", "amplitude", "frequency"];

const MASS: Field = Field::new("mass", "m_1", Bound::Positive, "\"4.168 kg\"");
const STIFFNESS: Field = Field::new("stiffness", "k_1", Bound::Positive, "\"11.47 kN/m\"");
const NATURAL: Field = Field::new("frequency", "f_0", Bound::Positive, "\"8.35 Hz\"");
const DAMPING: Field = Field::new("damping", "c_1", Bound::NotNegative, "\"3.02 N s/m\"");
const DAMPING_RATIO: Field = Field::new("damping_ratio", r"\zeta_1", Bound::NotNegative, "0.0069");
const ABSORBER_MASS: Field = Field::new("mass", "m_2", Bound::Positive, "\"32 g\"");
const MASS_RATIO: Field = Field::new("mass_ratio", r"\varepsilon", Bound::Positive, "0.0077");
const CLEARANCE: Field = Field::new("clearance", "b", Bound::Positive, "\"7.5 mm\"");
pub(super) const RESTITUTION: Field = Field::new("restitution", "r", Bound::UpToOne, "0.6");
const BASE: Field = Field::new("amplitude", "F", Bound::NotNegative, "\"0.25 mm\"");
const FORCE: Field = Field::new("amplitude", "P", Bound::NotNegative, "\"2.9 N\"");
const FREQUENCY: Field = Field::new("frequency", "f", Bound::Positive, "\"8 Hz\"");

/// Reads the three tables; `None` when something was reported.
pub(super) fn read(reader: &mut Reader, root: &Table) -> Option<Physical> {
    let [oscillator, absorber, excitation] = TABLES.map(|name| required_table(reader, root, name));
    let oscillator = oscillator.and_then(|table| Oscillator::read(reader, &table));
    let absorber = absorber.and_then(|table| Absorber::read(reader, &table, oscillator));
    let excitation = excitation.map(|table| {
        (read_excitation(reader, &table), table.quantity::<Frequency>(reader, FREQUENCY))
    });
    let (oscillator, absorber, (excitation, frequency)) = (oscillator?, absorber?, excitation?);
    Some(Physical {
        mass_kg: oscillator.mass,
        stiffness_n_per_m: oscillator.stiffness,
        damping_n_s_per_m: oscillator.damping,
        absorber_mass_kg: absorber.mass,
        clearance_m: absorber.clearance,
        restitution: absorber.restitution,
        excitation: excitation?,
        frequency_hz: frequency?,
    })
}

fn required_table<'t>(
    reader: &mut Reader,
    root: &Table<'t>,
    name: &'static str,
) -> Option<Table<'t>> {
    if !root.has(name) {
        let present = TABLES.into_iter().find(|table| root.has(table)).unwrap_or_default();
        reader.report(
            root.span_of(present),
            format!("the table [{name}] is missing"),
            format!("expected [{}] beside it", TABLES.join("], [")),
            format!(
                "add a line [{name}] and its keys below it; `vinesink new NAME` shows them all"
            ),
        );
    }
    reader.table(root, name)
}

#[derive(Clone, Copy)]
struct Oscillator {
    mass: f64,
    stiffness: f64,
    damping: f64,
}

impl Oscillator {
    fn read(reader: &mut Reader, table: &Table) -> Option<Self> {
        let mass = table.quantity::<Mass>(reader, MASS);
        let stiffness = match table.either(reader, STIFFNESS, NATURAL) {
            Some("stiffness") => table.quantity::<Stiffness>(reader, STIFFNESS),
            Some(_) => {
                let frequency = table.quantity::<Frequency>(reader, NATURAL);
                frequency.zip(mass).and_then(|both| stiffness_of(reader, table, both))
            }
            None => None,
        };
        let damping = match table.either(reader, DAMPING, DAMPING_RATIO)? {
            "damping" => table.quantity::<Damping>(reader, DAMPING)?,
            _ => {
                table.ratio(reader, DAMPING_RATIO, "0.69 %")? * critical_damping(stiffness?, mass?)
            }
        };
        Some(Self { mass: mass?, stiffness: stiffness?, damping })
    }
}

/// `k1` in N/m of a natural frequency in Hz and a mass in kg, each valid by itself.
fn stiffness_of(reader: &mut Reader, table: &Table, (frequency, mass): (f64, f64)) -> Option<f64> {
    let omega0 = TAU * frequency;
    let stiffness = mass * omega0 * omega0;
    if stiffness.is_finite() && stiffness > 0.0 {
        return Some(stiffness);
    }
    let message =
        format!("a natural frequency with this mass gives a stiffness of {stiffness} N/m");
    let help = "check the units of `frequency` and `mass`";
    let expected = "expected a stiffness above 0 that a number can hold";
    reader.report(table.span_of_value(NATURAL.key), message, expected, help);
    None
}

struct Absorber {
    mass: f64,
    clearance: f64,
    restitution: f64,
}

impl Absorber {
    fn read(reader: &mut Reader, table: &Table, oscillator: Option<Oscillator>) -> Option<Self> {
        let mass = match table.either(reader, ABSORBER_MASS, MASS_RATIO) {
            Some("mass") => table.quantity::<Mass>(reader, ABSORBER_MASS),
            Some(_) => {
                let ratio = table.ratio(reader, MASS_RATIO, "0.77 %");
                ratio.zip(oscillator).map(|(ratio, oscillator)| ratio * oscillator.mass)
            }
            None => None,
        };
        let clearance = table.quantity::<Length>(reader, CLEARANCE);
        let restitution = table.number(reader, RESTITUTION);
        Some(Self { mass: mass?, clearance: clearance?, restitution: restitution? })
    }
}

const KINDS: [(&str, Excitation); 2] =
    [("base-displacement", Excitation::BaseDisplacement), ("force", Excitation::Force)];

fn read_excitation(reader: &mut Reader, table: &Table) -> Option<PhysicalExcitation> {
    match read_kind(reader, table)? {
        Excitation::BaseDisplacement => {
            let amplitude = table.quantity::<Length>(reader, BASE);
            hint_other_kind(reader, table, Force::NAME, "force");
            amplitude.map(|amplitude_m| PhysicalExcitation::BaseDisplacement { amplitude_m })
        }
        Excitation::Force => {
            let amplitude = table.quantity::<Force>(reader, FORCE);
            hint_other_kind(reader, table, Length::NAME, "base-displacement");
            amplitude.map(|amplitude_n| PhysicalExcitation::Force { amplitude_n })
        }
    }
}

/// Adds the way out when the amplitude suits the other kind of excitation.
fn hint_other_kind(reader: &mut Reader, table: &Table, measures: &str, kind: &str) {
    let value = table.span_of_value("amplitude");
    let written = reader.text[value.clone()].trim_matches(['"', '\'']);
    if let Some(problem) = reader.problems.last_mut()
        && dimension_of(written) == Some(measures)
        && value.contains(&problem.span.start)
    {
        let help = problem.help.take().unwrap_or_default();
        problem.help = Some(format!("{help}; if {measures} is meant, write kind = \"{kind}\""));
    }
}

/// Reads the key `kind`, which must be there.
pub(super) fn read_kind(reader: &mut Reader, table: &Table) -> Option<Excitation> {
    let written =
        table.text(reader, "kind", "kind = \"base-displacement\"  or  kind = \"force\"")?;
    let found = KINDS.iter().find(|(name, _)| *name == written);
    if found.is_none() {
        let near = nearest(written, &KINDS.map(|(name, _)| name));
        let help = match near {
            Some(near) => format!("did you mean \"{near}\"?"),
            None => {
                "\"base-displacement\" shakes the base, \"force\" pushes the oscillator".to_owned()
            }
        };
        let message = format!("`kind` is \"{written}\"");
        let expected = "expected \"base-displacement\" or \"force\"";
        reader.report(table.span_of_value("kind"), message, expected, help);
    }
    found.map(|(_, excitation)| *excitation)
}
