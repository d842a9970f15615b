//! One parameter that is varied while all others stay: what branches of orbits, bifurcation diagrams, sweeps,
//! errors and an optimisation move along.
//!
//! Here it is a number of the dimensionless system, `case/parameter.rs` has its values in a design.
// Descriptions of keys go into the schema as they are: [reduced] is a table of the case file, not an item.
#![allow(rustdoc::broken_intra_doc_links)]

use serde::Serialize;

use super::{Cavity, InvalidParameter, Parameters, System};
use crate::names;

names! { key:
    /// A number of a case, or of a start, that an axis varies; every other number of the case stays. A
    /// design's own are in SI units, or plain numbers of a reduced design.
    #[derive(Serialize)]
    #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
    pub enum Parameter {
        /// Clearances.
        Clearance = "clearance",
        /// Frequencies of the excitation, or frequency ratios beside [reduced].
        Frequency = "frequency",
        /// Detunings sigma, beside [reduced].
        Detuning = "detuning",
        /// Amplitudes of the excitation, as in [excitation]; the reduced forcing G beside [reduced]; impulses of a
        /// shock, or velocities that it gives the base.
        Amplitude = "amplitude",
        /// Rates of a sweep through resonance, in hertz or in octaves as in [excitation].
        Rate = "rate",
        /// Restitutions; where the two walls differ their mean, and the difference stays.
        Restitution = "restitution",
        /// Inclinations of the cavity.
        Inclination = "inclination",
        /// Coefficients of sliding friction in the cavity.
        Friction = "friction",
        /// Gravity's acceleration along the cavity over b omega0^2, beside [reduced].
        GravityAlong = "gravity_along",
        /// Accelerations by sliding friction in the cavity over b omega0^2, beside [reduced].
        FrictionAcceleration = "friction_acceleration",
        /// Masses of the absorber, with a unit.
        AbsorberMass = "absorber_mass",
        /// Masses of the absorber over that of the oscillator.
        MassRatio = "mass_ratio",
        /// Masses of the oscillator, with a unit.
        Mass = "mass",
        /// Stiffnesses of the oscillator, with a unit.
        Stiffness = "stiffness",
        /// Natural frequencies of the oscillator, by its stiffness, with a unit.
        NaturalFrequency = "natural_frequency",
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

impl Parameter {
    /// Those of a dimensionless system that [`Parameter::applied`] varies.
    pub const OF_SYSTEM: [Self; 6] = [
        Self::Clearance,
        Self::Frequency,
        Self::Amplitude,
        Self::Restitution,
        Self::GravityAlong,
        Self::FrictionAcceleration,
    ];

    /// Whether it is a part of the start, not of the design: these are the last.
    pub fn is_initial(self) -> bool {
        self >= Self::InitialDisplacement
    }

    /// Whether it is a ratio to other numbers of a design, so that these have to be known first.
    pub fn is_ratio(self) -> bool {
        matches!(
            self,
            Self::MassRatio
                | Self::NaturalFrequency
                | Self::DampingRatio
                | Self::GravityAlong
                | Self::FrictionAcceleration
        )
    }

    /// Whether equal ratios of it deserve equal room, rather than equal differences.
    pub const fn is_logarithmic(self) -> bool {
        matches!(self, Self::Clearance | Self::Amplitude | Self::AbsorberMass)
    }

    /// The value at a part of the way between two, from 0 to 1, in their unit.
    pub fn between(self, [low, high]: [f64; 2], part: f64) -> f64 {
        if self.is_logarithmic() {
            low * libm::exp(part * libm::log(high / low))
        } else {
            low + part * (high - low)
        }
    }

    /// The part of the way between two at which a value lies, a ratio; the inverse of [`Parameter::between`].
    pub fn part(self, [low, high]: [f64; 2], value: f64) -> f64 {
        if self.is_logarithmic() {
            libm::log(value / low) / libm::log(high / low)
        } else {
            (value - low) / (high - low)
        }
    }

    /// Derivatives of forcing `gamma`, frequency, restitution, gravity along the cavity and friction by the
    /// parameter, at `value`: what [`Parameter::applied`] does to them.
    pub fn derivatives(self, base: &System, value: f64) -> [f64; 5] {
        let gamma = base.forcing_per_clearance();
        let Cavity { gravity_along, friction_acceleration, .. } = base.cavity();
        match self {
            Self::Clearance => {
                let over = -1.0 / (value * value);
                [gamma * over, 0.0, 0.0, gravity_along * over, friction_acceleration * over]
            }
            Self::Frequency => [0.0, 1.0, 0.0, 0.0, 0.0],
            Self::Amplitude => [gamma, 0.0, 0.0, 0.0, 0.0],
            Self::Restitution => [0.0, 0.0, 1.0, 0.0, 0.0],
            Self::GravityAlong => [0.0, 0.0, 0.0, 1.0, 0.0],
            Self::FrictionAcceleration => [0.0, 0.0, 0.0, 0.0, 1.0],
            _ => [0.0; 5],
        }
    }

    /// Its value in the base system, dimensionless: a clearance or an amplitude over the base system's, the
    /// frequency as the ratio `Omega`; not a number for what is not varied in a system.
    pub fn of(self, base: &System) -> f64 {
        match self {
            Self::Clearance | Self::Amplitude => 1.0,
            Self::Frequency => base.frequency_ratio(),
            Self::Restitution => base.restitution(),
            Self::GravityAlong => base.cavity().gravity_along,
            Self::FrictionAcceleration => base.cavity().friction_acceleration,
            _ => f64::NAN,
        }
    }

    /// The base system with the parameter at `value`: another clearance leaves the excitation as it is, so that
    /// `gamma` is divided by it; another amplitude multiplies `gamma`. Lengths of the result are over its own
    /// clearance, which is [`Parameter::unit`] times the base system's.
    ///
    /// # Errors
    /// [`InvalidParameter`] if no system has it: a clearance or frequency that is not above 0, a
    /// forcing or friction below 0, a restitution outside of 0 to 1, a parameter that is not varied in a system.
    pub fn applied(self, base: &System, value: f64) -> Result<System, InvalidParameter> {
        let parameters = base.parameters();
        // The detuning depends on the frequency alone, and 1 + eps sigma may have forgotten it.
        let tuned_alike = |parameters: Parameters| {
            System::new(parameters).map(|system| System { detuning: base.detuning, ..system })
        };
        match self {
            Self::Clearance => base.with_clearance_scaled(value),
            Self::Frequency => base.with_frequency_ratio(value),
            Self::Amplitude => {
                let forcing_per_clearance = value * parameters.forcing_per_clearance;
                tuned_alike(Parameters { forcing_per_clearance, ..parameters })
            }
            Self::Restitution => tuned_alike(Parameters { restitution: value, ..parameters }),
            Self::GravityAlong => {
                let cavity = Cavity { gravity_along: value, ..parameters.cavity };
                tuned_alike(Parameters { cavity, ..parameters })
            }
            Self::FrictionAcceleration => {
                let cavity = Cavity { friction_acceleration: value, ..parameters.cavity };
                tuned_alike(Parameters { cavity, ..parameters })
            }
            _ => {
                let expected = "a clearance, frequency, amplitude, restitution, or gravity or friction in the \
                                cavity to vary";
                Err(InvalidParameter { name: self.key(), value, expected })
            }
        }
    }

    /// Length unit of the system at `value`, its clearance, over the base system's clearance.
    pub fn unit(self, value: f64) -> f64 {
        if self == Self::Clearance { value } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::Excitation;

    fn base() -> System {
        // So light an absorber that the frequency ratio cannot hold the detuning.
        System::new(Parameters {
            mass_ratio: 1e-14,
            damping: 1.5,
            restitution: 0.6,
            frequency_ratio: 1.0,
            forcing_per_clearance: 3.0,
            excitation: Excitation::BaseDisplacement,
            cavity: Cavity::IDEAL,
        })
        .and_then(|system| system.with_detuning(0.3))
        .expect("valid")
    }

    #[test]
    fn its_own_value_gives_the_base_system_back() {
        let base = base();
        for parameter in Parameter::OF_SYSTEM {
            let again = parameter.applied(&base, parameter.of(&base)).expect("valid");
            assert_eq!(again.parameters(), base.parameters(), "{parameter:?}");
            // A detuning that is given as a frequency ratio is as good as that number.
            let kept = again.detuning() == base.detuning();
            assert!(kept || parameter == Parameter::Frequency, "{parameter:?}");
        }
    }

    /// A larger excitation and a smaller clearance are one system, seen in different units.
    #[test]
    fn forcing_is_the_reciprocal_of_clearance_but_for_the_unit() {
        let base = base();
        let driven = Parameter::Amplitude.applied(&base, 4.0).expect("valid");
        let narrow = Parameter::Clearance.applied(&base, 0.25).expect("valid");
        assert_eq!(driven, narrow);
        assert_eq!(driven.forcing_per_clearance(), 12.0);
        assert_eq!((Parameter::Amplitude.unit(4.0), Parameter::Clearance.unit(0.25)), (1.0, 0.25));
    }

    #[test]
    fn values_without_a_system_are_refused() {
        for parameter in Parameter::OF_SYSTEM {
            // A tilt has a sign.
            let tilt = parameter == Parameter::GravityAlong;
            assert_eq!(parameter.applied(&base(), -1.0).is_ok(), tilt, "{parameter:?}");
            assert!(parameter.applied(&base(), f64::NAN).is_err(), "{parameter:?}");
        }
        assert!(Parameter::Restitution.applied(&base(), 1.1).is_err());
        // Without excitation there is a system, without room for the absorber there is none.
        assert!(Parameter::Amplitude.applied(&base(), 0.0).is_ok());
        assert!(Parameter::Clearance.applied(&base(), 0.0).is_err());
    }
}
