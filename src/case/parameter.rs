//! What a parameter is in a design: its value, the quantity that it is, and how it is written.

use std::f64::consts::{FRAC_PI_2, TAU};

use serde_json::Value;

use super::Design;
use super::excitation::{ExcitationTable, impossible};
use super::number::Form;
use super::physical::{AbsorberTable, OscillatorTable};
use super::reduced::ReducedTable;
use super::schema::of_table;
use crate::excitation::{Scene, SweepRate, Transient};
use crate::quantity::catalogue as of;
use crate::quantity::{Dimension, Kind};
use crate::system::{Excitation, Parameter, System};

impl Design {
    /// The value of a parameter in SI, or a plain number of a reduced design; `None` for a part of the start,
    /// or what the design has not.
    pub fn value(&self, parameter: Parameter) -> Option<f64> {
        match (parameter, self) {
            (Parameter::Frequency, Self::Reduced(r)) => Some(r.frequency_ratio()),
            (Parameter::Detuning, Self::Reduced(r)) => {
                let of_ratio = || (r.frequency_ratio() - 1.0) / r.mass_ratio;
                Some(r.detuning.unwrap_or_else(of_ratio))
            }
            _ => self.clone().numbers(parameter).pop().map(|(number, over)| *number / over),
        }
    }

    /// The design with another value; unchanged by what is a part of the start, or what it has not. A
    /// mass, stiffness or damping changes alone: the others keep their numbers, not their ratios.
    #[must_use]
    pub fn with(mut self, parameter: Parameter, value: f64) -> Self {
        match (parameter, &mut self) {
            (Parameter::Frequency, Self::Reduced(r)) => {
                (r.frequency_ratio, r.detuning) = (Some(value), None);
            }
            (Parameter::Detuning, Self::Reduced(r)) => {
                (r.frequency_ratio, r.detuning) = (None, Some(value));
            }
            (Parameter::Clearance, Self::Reduced(r)) => {
                // Gravity and friction stay what they are, not their ratio to the clearance.
                r.cavity = r.cavity.with_clearance_scaled(value / r.clearance);
                r.clearance = value;
            }
            (_, changed) => {
                for (number, over) in changed.numbers(parameter) {
                    *number = value * over;
                }
            }
        }
        // What has no frequency of its own is counted in the structure's.
        if let (Scene::Release | Scene::Record, Self::Physical(p)) = (self.scene(), &mut self) {
            p.frequency_hz = p.natural_frequency_rad_per_s() / TAU;
        }
        self
    }

    /// The system; none where values that are each valid leave none, or nothing that could happen to it.
    pub fn possible_system(&self) -> Option<System> {
        let possible = self.transient().is_none_or(|of| impossible(&of).is_none());
        possible.then(|| self.system().ok())?
    }

    fn transient_mut(&mut self) -> Option<&mut Transient> {
        match self {
            Self::Physical(physical) => physical.transient.as_mut(),
            Self::Reduced(reduced) => reduced.transient.as_mut(),
        }
    }

    /// Whether a parameter is a number of the structure and its absorber, or of steady excitation.
    fn is_of_system(&self, parameter: Parameter) -> bool {
        use Parameter as P;
        match (self.scene(), parameter) {
            (Scene::Steady, other) => other != P::Rate,
            (scene, P::Amplitude) => scene == Scene::Sweep,
            (_, P::Frequency | P::Detuning | P::Rate) => false,
            (_, other) => !other.is_initial(),
        }
    }

    /// The same with errors added to some parameters; restitutions stay between 0 and 1, an angle within a quarter
    /// turn, an amplitude and friction at 0 or more.
    #[must_use]
    pub fn deviating(self, errors: &[(Parameter, f64)]) -> Self {
        errors.iter().fold(self, |design, (parameter, error)| {
            let value = design.value(*parameter).unwrap_or(f64::NAN) + error;
            let possible = match parameter {
                Parameter::Restitution => {
                    let half = 0.5 * design.restitution_difference().abs();
                    value.max(half).min(1.0 - half)
                }
                Parameter::Inclination => value.clamp(-FRAC_PI_2, FRAC_PI_2),
                Parameter::Amplitude | Parameter::Friction | Parameter::FrictionAcceleration => {
                    value.max(0.0)
                }
                _ => value,
            };
            design.with(*parameter, possible)
        })
    }

    /// Restitution at the wall `x - y = +b` less that at `x - y = -b`.
    pub fn restitution_difference(&self) -> f64 {
        match self {
            Self::Physical(physical) => physical.restitution_difference,
            Self::Reduced(reduced) => reduced.cavity.restitution_difference,
        }
    }

    /// The design with restitutions further apart, their mean as it is.
    #[must_use]
    pub fn with_restitutions_apart(mut self, by: f64) -> Self {
        let difference = match &mut self {
            Self::Physical(physical) => &mut physical.restitution_difference,
            Self::Reduced(reduced) => &mut reduced.cavity.restitution_difference,
        };
        *difference += by.copysign(*difference);
        self
    }

    /// `b`, in metres or the design's own unit.
    pub fn clearance(&self) -> f64 {
        self.scales().clearance
    }

    /// The numbers of a design that say it, and what each is over where it is a ratio; none for a detuning or the
    /// frequency of a reduced design.
    fn numbers(&mut self, parameter: Parameter) -> Vec<(&mut f64, f64)> {
        use Parameter as P;
        if !self.is_of_system(parameter) {
            let numbers = self.transient_mut().map(|of| of.numbers(parameter));
            return numbers.into_iter().flatten().map(|number| (number, 1.0)).collect();
        }
        let number = match (parameter, self) {
            (P::MassRatio, Self::Physical(p)) => {
                return vec![(&mut p.absorber_mass_kg, p.mass_kg)];
            }
            (P::DampingRatio, Self::Physical(p)) => {
                let critical = p.critical_damping_n_s_per_m();
                return vec![(&mut p.damping_n_s_per_m, critical)];
            }
            (P::Clearance, Self::Physical(p)) => &mut p.clearance_m,
            (P::Frequency, Self::Physical(p)) => &mut p.frequency_hz,
            (P::Amplitude, Self::Physical(p)) => &mut p.amplitude,
            (P::Restitution, Self::Physical(p)) => &mut p.restitution,
            (P::Inclination, Self::Physical(p)) => &mut p.inclination_rad,
            (P::Friction, Self::Physical(p)) => &mut p.friction,
            (P::AbsorberMass, Self::Physical(p)) => &mut p.absorber_mass_kg,
            (P::Mass, Self::Physical(p)) => &mut p.mass_kg,
            (P::Stiffness, Self::Physical(p)) => &mut p.stiffness_n_per_m,
            (P::Damping, Self::Physical(p)) => &mut p.damping_n_s_per_m,
            (P::Clearance, Self::Reduced(r)) => &mut r.clearance,
            (P::Amplitude, Self::Reduced(r)) => &mut r.forcing,
            (P::Restitution, Self::Reduced(r)) => &mut r.restitution,
            (P::GravityAlong, Self::Reduced(r)) => &mut r.cavity.gravity_along,
            (P::FrictionAcceleration, Self::Reduced(r)) => &mut r.cavity.friction_acceleration,
            (P::MassRatio, Self::Reduced(r)) => &mut r.mass_ratio,
            (P::Damping, Self::Reduced(r)) => &mut r.damping,
            _ => return Vec::new(),
        };
        vec![(number, 1.0)]
    }

    /// What a number of the cavity that a design of the other kind has is called in this one.
    pub(super) fn counterpart(&self, parameter: Parameter) -> Option<Parameter> {
        use Parameter as P;
        match (self, parameter) {
            (Self::Reduced(_), P::Inclination) => Some(P::GravityAlong),
            (Self::Reduced(_), P::Friction) => Some(P::FrictionAcceleration),
            (Self::Physical(_), P::GravityAlong) => Some(P::Inclination),
            (Self::Physical(_), P::FrictionAcceleration) => Some(P::Friction),
            _ => None,
        }
    }

    /// Its kind in the words of a message.
    pub(super) fn words(&self) -> &'static str {
        match self {
            Self::Physical(_) => "a design in [oscillator], [absorber] and [excitation]",
            Self::Reduced(_) => "a design in [reduced]",
        }
    }

    /// The quantity that a parameter is beside this design.
    pub fn kind(&self, parameter: Parameter) -> &'static Kind {
        use Parameter as P;
        match (parameter, self.transient()) {
            (P::Amplitude, Some(Transient::Release(shock))) if shock.impulse > 0.0 => {
                return &of::IMPULSE;
            }
            (P::Amplitude, Some(Transient::Release(_))) => return &of::INITIAL_VELOCITY,
            _ => {}
        }
        match (parameter, self) {
            (P::Clearance, _) => &of::CLEARANCE,
            (P::Rate, _) => match self.sine_sweep().map(|sweep| sweep.rate) {
                Some(SweepRate::Octaves(_)) => &of::OCTAVE_RATE,
                _ => &of::SWEEP_RATE,
            },
            (P::Frequency, Self::Physical(_)) => &of::EXCITATION_FREQUENCY,
            (P::Frequency, Self::Reduced(_)) => &of::FREQUENCY_RATIO,
            (P::Detuning, _) => &of::DETUNING,
            (P::Amplitude, Self::Reduced(_)) => &of::REDUCED_FORCING,
            (P::Amplitude, Self::Physical(physical)) => match physical.excitation {
                Excitation::BaseDisplacement => &of::BASE_AMPLITUDE,
                Excitation::Force => &of::FORCE_AMPLITUDE,
            },
            (P::Restitution, _) => &of::RESTITUTION,
            (P::Inclination, _) => &of::INCLINATION,
            (P::Friction, _) => &of::FRICTION,
            (P::GravityAlong, _) => &of::GRAVITY_ALONG,
            (P::FrictionAcceleration, _) => &of::FRICTION_ACCELERATION,
            (P::AbsorberMass, _) => &of::ABSORBER_MASS,
            (P::MassRatio, _) => &of::MASS_RATIO,
            (P::Mass, _) => &of::OSCILLATOR_MASS,
            (P::Stiffness, _) => &of::STIFFNESS,
            (P::Damping, Self::Physical(_)) => &of::DAMPING,
            (P::Damping, Self::Reduced(_)) => &of::REDUCED_DAMPING,
            (P::DampingRatio, _) => &of::DAMPING_RATIO,
            (P::InitialDisplacement, _) => &of::INITIAL_DISPLACEMENT,
            (P::InitialVelocity, _) => &of::INITIAL_VELOCITY,
            (P::InitialAbsorberDisplacement, _) => &of::INITIAL_ABSORBER_DISPLACEMENT,
            (P::InitialAbsorberVelocity, _) => &of::INITIAL_ABSORBER_VELOCITY,
        }
    }

    /// The symbol of the SI unit in which a parameter's values are held; "1" for a plain number.
    pub fn unit(&self, parameter: Parameter) -> &'static str {
        self.kind(parameter).dimension.symbol(self.scales().physical)
    }

    /// How values of a parameter are written beside this design: as the design's own; `None` where it has no
    /// such number.
    pub(super) fn form(&self, parameter: Parameter) -> Option<Form> {
        let of_system = self.is_of_system(parameter);
        if !of_system && self.clone().numbers(parameter).is_empty() {
            return None;
        }
        if !of_system || !parameter.is_initial() {
            let form = Form::of(self.schema(parameter)?)?;
            if parameter != Parameter::Rate || matches!(self, Self::Reduced(_)) {
                return Some(form);
            }
            let dimension = self.kind(parameter).dimension;
            let example = format!("\"{}\"", dimension.words().1);
            return Some(Form { dimension: Some(dimension), exact: true, example, ..form });
        }
        let symbol = match parameter {
            Parameter::InitialDisplacement => "x_0",
            Parameter::InitialVelocity => r"\dot{x}_0",
            Parameter::InitialAbsorberDisplacement => "y_0",
            _ => r"\dot{y}_0",
        };
        let dimension = self.kind(parameter).dimension;
        Some(match (self, dimension) {
            (Self::Reduced(_), _) => Form::free(None, "0.5", symbol),
            (_, Dimension::Length) => Form::free(Some(dimension), "\"5 mm\"", symbol),
            _ => Form::free(Some(dimension), "\"0.2 m/s\"", symbol),
        })
    }

    /// The key in which a design has a parameter; `None` where it has no such number.
    fn schema(&self, parameter: Parameter) -> Option<&'static Value> {
        let reduced = || &of_table::<ReducedTable>()["properties"];
        let excitation = match self {
            Self::Physical(_) => &of_table::<ExcitationTable>()["properties"],
            Self::Reduced(_) => reduced(),
        };
        match (parameter, self) {
            (Parameter::AbsorberMass, Self::Physical(_)) => {
                of_table::<AbsorberTable>()["properties"].get("mass")
            }
            (Parameter::Amplitude | Parameter::InitialVelocity, _)
                if self.scene() == Scene::Release =>
            {
                let struck = self.kind(parameter).dimension == Dimension::Impulse;
                excitation.get(if struck { "impulse" } else { "velocity" })
            }
            (Parameter::InitialDisplacement, _) => excitation.get("displacement"),
            (Parameter::Amplitude, Self::Physical(physical)) => {
                let branch = usize::from(physical.excitation == Excitation::Force);
                let branch = &of_table::<ExcitationTable>()["oneOf"][branch];
                branch["properties"].get(parameter.key())
            }
            (Parameter::Frequency, Self::Reduced(_)) => reduced().get("frequency_ratio"),
            (Parameter::Amplitude, Self::Reduced(_)) => reduced().get("forcing"),
            (_, Self::Reduced(_)) => reduced().get(parameter.key()),
            (_, Self::Physical(_)) => {
                let tables = [
                    of_table::<OscillatorTable>,
                    of_table::<AbsorberTable>,
                    of_table::<ExcitationTable>,
                ];
                tables.iter().find_map(|table| table()["properties"].get(parameter.key()))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Case;

    #[test]
    fn a_value_that_is_set_is_the_value_that_is_there() {
        let design = Case::parse("a case", &Case::starting_text("t")).expect("valid").design;
        let design = design.with(Parameter::Inclination, 0.01).with(Parameter::Friction, 0.003);
        for parameter in Parameter::ALL {
            let Some(own) = design.value(parameter) else { continue };
            let other = design.with(parameter, 1.1 * own).value(parameter).expect("the same key");
            assert!((other / own - 1.1).abs() < 1e-12, "{parameter:?}");
        }
        assert_eq!(design.value(Parameter::InitialVelocity), None);
        assert_eq!(design.with(Parameter::InitialVelocity, 1.0), design);
        let off = [(Parameter::Restitution, 2.0), (Parameter::Amplitude, -1e9)];
        let built = design.deviating(&off);
        assert_eq!(built.value(Parameter::Restitution), Some(1.0));
        assert_eq!(built.value(Parameter::Amplitude), Some(0.0));
        let off = [(Parameter::Inclination, -2.0), (Parameter::Friction, -0.1)];
        let built = design.deviating(&off);
        assert_eq!(built.value(Parameter::Inclination), Some(-FRAC_PI_2));
        assert_eq!(built.value(Parameter::Friction), Some(0.0));
    }
}
