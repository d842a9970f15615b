//! One parameter of a system that is varied while all others stay: what branches of orbits and
//! bifurcation diagrams move along.

use serde::Serialize;

use super::{InvalidParameter, Parameters, System};

/// The parameter that is varied, the others being those of a base system.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Parameter {
    /// The clearance over the base system's; the excitation stays what it is, so that `gamma` is
    /// divided by it.
    Clearance,
    /// The frequency ratio `Omega`.
    FrequencyRatio,
    /// The excitation's amplitude over the base system's; the clearance stays what it is, so that
    /// `gamma` is multiplied by it.
    Forcing,
    /// The restitution `r`.
    Restitution,
}

impl Parameter {
    /// All of them.
    pub const ALL: [Self; 4] =
        [Self::Clearance, Self::FrequencyRatio, Self::Forcing, Self::Restitution];

    /// Its name in a sentence.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Clearance => "clearance",
            Self::FrequencyRatio => "excitation frequency",
            Self::Forcing => "excitation amplitude",
            Self::Restitution => "restitution",
        }
    }

    /// The symbol of its value.
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Clearance => "b",
            Self::FrequencyRatio => "Ω",
            Self::Forcing => "F",
            Self::Restitution => "r",
        }
    }

    /// Whether equal ratios of it deserve equal room, rather than equal differences.
    pub const fn is_logarithmic(self) -> bool {
        matches!(self, Self::Clearance | Self::Forcing)
    }

    /// The value at a part of the way between two, from 0 to 1.
    pub fn between(self, [low, high]: [f64; 2], part: f64) -> f64 {
        if self.is_logarithmic() {
            low * libm::exp(part * libm::log(high / low))
        } else {
            low + part * (high - low)
        }
    }

    /// Derivatives of forcing `gamma`, frequency and restitution by the parameter, at `value`: what
    /// [`Parameter::applied`] does to them.
    pub fn derivatives(self, base: &System, value: f64) -> [f64; 3] {
        let gamma = base.forcing_per_clearance();
        match self {
            Self::Clearance => [-gamma / (value * value), 0.0, 0.0],
            Self::FrequencyRatio => [0.0, 1.0, 0.0],
            Self::Forcing => [gamma, 0.0, 0.0],
            Self::Restitution => [0.0, 0.0, 1.0],
        }
    }

    /// Its value in the base system, dimensionless.
    pub fn of(self, base: &System) -> f64 {
        match self {
            Self::Clearance | Self::Forcing => 1.0,
            Self::FrequencyRatio => base.frequency_ratio(),
            Self::Restitution => base.restitution(),
        }
    }

    /// The base system with the parameter at `value`. Lengths of the result are over its own
    /// clearance, which is [`Parameter::unit`] times the base system's.
    ///
    /// # Errors
    /// [`InvalidParameter`] if no system has it: a clearance or frequency that is not above 0, a
    /// forcing below 0, a restitution outside of 0 to 1.
    pub fn applied(self, base: &System, value: f64) -> Result<System, InvalidParameter> {
        let parameters = base.parameters();
        // The detuning depends on the frequency alone, and 1 + eps sigma may have forgotten it.
        let tuned_alike = |parameters: Parameters| {
            System::new(parameters).map(|system| System { detuning: base.detuning, ..system })
        };
        match self {
            Self::Clearance => base.with_clearance_scaled(value),
            Self::FrequencyRatio => base.with_frequency_ratio(value),
            Self::Forcing => {
                let forcing_per_clearance = value * parameters.forcing_per_clearance;
                tuned_alike(Parameters { forcing_per_clearance, ..parameters })
            }
            Self::Restitution => tuned_alike(Parameters { restitution: value, ..parameters }),
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
        })
        .and_then(|system| system.with_detuning(0.3))
        .expect("valid")
    }

    #[test]
    fn its_own_value_gives_the_base_system_back() {
        let base = base();
        for parameter in Parameter::ALL {
            let again = parameter.applied(&base, parameter.of(&base)).expect("valid");
            assert_eq!(again.parameters(), base.parameters(), "{parameter:?}");
            // A detuning that is given as a frequency ratio is as good as that number.
            let kept = again.detuning() == base.detuning();
            assert!(kept || parameter == Parameter::FrequencyRatio, "{parameter:?}");
        }
    }

    /// A larger excitation and a smaller clearance are one system, seen in different units.
    #[test]
    fn forcing_is_the_reciprocal_of_clearance_but_for_the_unit() {
        let base = base();
        let driven = Parameter::Forcing.applied(&base, 4.0).expect("valid");
        let narrow = Parameter::Clearance.applied(&base, 0.25).expect("valid");
        assert_eq!(driven, narrow);
        assert_eq!(driven.forcing_per_clearance(), 12.0);
        assert_eq!((Parameter::Forcing.unit(4.0), Parameter::Clearance.unit(0.25)), (1.0, 0.25));
    }

    #[test]
    fn values_without_a_system_are_refused() {
        for parameter in Parameter::ALL {
            assert!(parameter.applied(&base(), -1.0).is_err(), "{parameter:?}");
            assert!(parameter.applied(&base(), f64::NAN).is_err(), "{parameter:?}");
        }
        assert!(Parameter::Restitution.applied(&base(), 1.1).is_err());
        // Without excitation there is a system, without room for the absorber there is none.
        assert!(Parameter::Forcing.applied(&base(), 0.0).is_ok());
        assert!(Parameter::Clearance.applied(&base(), 0.0).is_err());
    }
}
