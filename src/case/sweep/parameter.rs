//! What an axis of a sweep can vary.

use serde_json::Value;

use super::super::Design;
use super::super::names::names;
use super::super::number::Form;
use super::super::schema::SCHEMA;
use crate::quantity::Dimension;
use crate::system::Excitation;

names! { key:
    /// A number of a case, or of a start, that an axis varies; every other number of the case stays. A
    /// design's own are in SI units, or plain numbers of a reduced design.
    pub enum SweepParameter {
        /// Clearances.
        Clearance = "clearance",
        /// Frequencies of the excitation, or frequency ratios beside [reduced].
        Frequency = "frequency",
        /// Detunings sigma, beside [reduced].
        Detuning = "detuning",
        /// Amplitudes of the excitation, as in [excitation]; the reduced forcing G beside [reduced].
        Amplitude = "amplitude",
        /// Restitutions.
        Restitution = "restitution",
        /// Masses of the absorber, with a unit.
        AbsorberMass = "absorber_mass",
        /// Masses of the absorber over that of the oscillator.
        MassRatio = "mass_ratio",
        /// Masses of the oscillator, with a unit.
        Mass = "mass",
        /// Stiffnesses of the oscillator, with a unit.
        Stiffness = "stiffness",
        /// Viscous dampings of the oscillator, with a unit; lambda beside [reduced].
        Damping = "damping",
        /// Dampings of the oscillator over the critical one.
        DampingRatio = "damping_ratio",
        /// Displacements of the oscillator at the start.
        InitialDisplacement = "initial_displacement",
        /// Velocities of the oscillator at the start.
        InitialVelocity = "initial_velocity",
        /// Displacements of the absorber at the start; unless given it is half a clearance from the oscillator.
        InitialAbsorberDisplacement = "initial_absorber_displacement",
        /// Velocities of the absorber at the start.
        InitialAbsorberVelocity = "initial_absorber_velocity",
    }
}

impl SweepParameter {
    /// Whether it is a part of the start, not of the design: these are the last.
    pub fn is_initial(self) -> bool {
        self >= Self::InitialDisplacement
    }

    /// Whether it is a ratio to other numbers of a design, so that these have to be known first.
    pub fn is_ratio(self) -> bool {
        matches!(self, Self::MassRatio | Self::DampingRatio)
    }

    /// Another parameter that says the same of a design.
    pub(super) fn rival(self) -> Option<Self> {
        match self {
            Self::AbsorberMass => Some(Self::MassRatio),
            Self::Damping => Some(Self::DampingRatio),
            Self::Frequency => Some(Self::Detuning),
            _ => None,
        }
    }

    /// How its values are written beside a design: as the design's own; `None` where it has no such number.
    pub(in super::super) fn form(self, design: &Design) -> Option<Form> {
        let of_start = |measurand: Dimension, example: &str, symbol: &str| {
            let physical = matches!(design, Design::Physical(_));
            let example = if physical { example } else { "0.5" };
            Some(Form::free(physical.then_some(measurand), example, symbol))
        };
        match self {
            Self::InitialDisplacement => of_start(Dimension::Length, "\"5 mm\"", "x_0"),
            Self::InitialVelocity => of_start(Dimension::Velocity, "\"0.2 m/s\"", r"\dot{x}_0"),
            Self::InitialAbsorberDisplacement => of_start(Dimension::Length, "\"5 mm\"", "y_0"),
            Self::InitialAbsorberVelocity => {
                of_start(Dimension::Velocity, "\"0.2 m/s\"", r"\dot{y}_0")
            }
            _ => Form::of(self.schema(design)?),
        }
    }

    /// The key in which a design has it; `None` where it has no such number.
    fn schema(self, design: &Design) -> Option<&'static Value> {
        let properties = |table: &str| &SCHEMA["properties"][table]["properties"];
        match (self, design) {
            (Self::AbsorberMass, Design::Physical(_)) => properties("absorber").get("mass"),
            (Self::Amplitude, Design::Physical(physical)) => {
                let branch = usize::from(physical.excitation == Excitation::Force);
                let branch = &SCHEMA["properties"]["excitation"]["oneOf"][branch];
                branch["properties"].get(self.key())
            }
            (Self::Frequency, Design::Reduced(_)) => properties("reduced").get("frequency_ratio"),
            (Self::Amplitude, Design::Reduced(_)) => properties("reduced").get("forcing"),
            (_, Design::Reduced(_)) => properties("reduced").get(self.key()),
            (_, Design::Physical(_)) => {
                let mut tables =
                    ["oscillator", "absorber", "excitation"].map(properties).into_iter();
                tables.find_map(|table| table.get(self.key()))
            }
        }
    }

    /// The unit of its values beside a design: an SI unit, or "1".
    pub fn unit(self, design: &Design) -> &'static str {
        self.form(design).map_or("1", |form| form.unit())
    }

    /// Its value in a design; `None` for a part of the start, or what the design has not.
    pub fn of(self, design: &Design) -> Option<f64> {
        match (self, design) {
            (Self::Frequency, Design::Reduced(r)) => return Some(r.frequency_ratio()),
            (Self::Detuning, Design::Reduced(r)) => {
                let of_ratio = || (r.frequency_ratio() - 1.0) / r.mass_ratio;
                return Some(r.detuning.unwrap_or_else(of_ratio));
            }
            _ => {}
        }
        self.number(&mut design.clone()).map(|(number, over)| *number / over)
    }

    /// The design with another value; unchanged by what is a part of the start, or what it has not. A
    /// mass, stiffness or damping changes alone: the others keep their numbers, not their ratios.
    #[must_use]
    pub fn applied(self, design: &Design, value: f64) -> Design {
        let mut changed = *design;
        match (self, &mut changed) {
            (Self::Frequency, Design::Reduced(r)) => {
                (r.frequency_ratio, r.detuning) = (Some(value), None);
            }
            (Self::Detuning, Design::Reduced(r)) => {
                (r.frequency_ratio, r.detuning) = (None, Some(value));
            }
            (_, changed) => {
                if let Some((number, over)) = self.number(changed) {
                    *number = value * over;
                }
            }
        }
        changed
    }

    /// The number of a design that says it, and what it is over where it is a ratio; none for a detuning or the
    /// frequency of a reduced design.
    fn number(self, design: &mut Design) -> Option<(&mut f64, f64)> {
        let number = match (self, design) {
            (Self::MassRatio, Design::Physical(p)) => {
                return Some((&mut p.absorber_mass_kg, p.mass_kg));
            }
            (Self::DampingRatio, Design::Physical(p)) => {
                let critical = p.critical_damping_n_s_per_m();
                return Some((&mut p.damping_n_s_per_m, critical));
            }
            (Self::Clearance, Design::Physical(p)) => &mut p.clearance_m,
            (Self::Frequency, Design::Physical(p)) => &mut p.frequency_hz,
            (Self::Amplitude, Design::Physical(p)) => &mut p.amplitude,
            (Self::Restitution, Design::Physical(p)) => &mut p.restitution,
            (Self::AbsorberMass, Design::Physical(p)) => &mut p.absorber_mass_kg,
            (Self::Mass, Design::Physical(p)) => &mut p.mass_kg,
            (Self::Stiffness, Design::Physical(p)) => &mut p.stiffness_n_per_m,
            (Self::Damping, Design::Physical(p)) => &mut p.damping_n_s_per_m,
            (Self::Clearance, Design::Reduced(r)) => &mut r.clearance,
            (Self::Amplitude, Design::Reduced(r)) => &mut r.forcing,
            (Self::Restitution, Design::Reduced(r)) => &mut r.restitution,
            (Self::MassRatio, Design::Reduced(r)) => &mut r.mass_ratio,
            (Self::Damping, Design::Reduced(r)) => &mut r.damping,
            _ => return None,
        };
        Some((number, 1.0))
    }
}
