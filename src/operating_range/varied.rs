//! Numbers of a case whose range is looked for, and the steps in which it is.

use serde::Serialize;

use crate::case::Case;
use crate::system::Parameter;

/// What varies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Varied {
    /// Of the force or the base, all amplitudes of a band with it; of a release its displacement or velocity, or the
    /// impulse.
    Amplitude,
    /// The structure's, by its stiffness.
    NaturalFrequency,
    /// The structure's damping constant.
    Damping,
    /// The structure's mass, its stiffness as it is.
    Mass,
    /// Restitution.
    Restitution,
    /// Clearance.
    Clearance,
    /// Inclination, or gravity along the cavity.
    Inclination,
    /// Friction.
    Friction,
}

/// Steps outwards, as factors.
const FACTORS: [f64; 13] = [1.02, 1.05, 1.1, 1.15, 1.22, 1.3, 1.4, 1.55, 1.75, 2.0, 2.4, 3.0, 4.0];
/// The same of what decides less: the structure's damping and mass.
const COARSE: [f64; 7] = [1.05, 1.12, 1.22, 1.4, 1.75, 2.4, 4.0];
/// The same of the natural frequency, which a resonance makes narrow.
const OF_FREQUENCY: [f64; 9] = [1.005, 1.01, 1.02, 1.035, 1.055, 1.08, 1.12, 1.18, 1.25];
/// Steps that are added: of a restitution, of an inclination in rad (0.1 to 10 degrees), of gravity along a reduced cavity
/// and of friction.
const OF_RESTITUTION: [f64; 8] = [0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6];
const OF_INCLINATION: [f64; 5] = [0.001_745, 0.005_236, 0.017_453, 0.052_36, 0.174_533];
const OF_FRICTION: [f64; 5] = [0.002, 0.005, 0.02, 0.05, 0.2];
impl Varied {
    /// Every one.
    pub const ALL: [Self; 8] = [
        Self::Amplitude,
        Self::NaturalFrequency,
        Self::Damping,
        Self::Mass,
        Self::Restitution,
        Self::Clearance,
        Self::Inclination,
        Self::Friction,
    ];

    /// What a page tells first: nobody builds them.
    pub const FIRST: [Self; 2] = [Self::Amplitude, Self::NaturalFrequency];

    /// The parameter of a case that it is; none where the case has no such number.
    pub fn parameter(self, case: &Case) -> Option<Parameter> {
        let all: &[Parameter] = match self {
            Self::Amplitude => {
                &[Parameter::Amplitude, Parameter::InitialDisplacement, Parameter::InitialVelocity]
            }
            Self::NaturalFrequency => &[Parameter::NaturalFrequency],
            Self::Damping => &[Parameter::Damping],
            Self::Mass => &[Parameter::Mass],
            Self::Restitution => &[Parameter::Restitution],
            Self::Clearance => &[Parameter::Clearance],
            Self::Inclination => &[Parameter::Inclination, Parameter::GravityAlong],
            Self::Friction => &[Parameter::Friction, Parameter::FrictionAcceleration],
        };
        let has = |one: &&Parameter| {
            case.design.value(**one).is_some_and(|own| own > 0.0 || self.is_added())
        };
        all.iter().find(has).copied()
    }

    /// Whether steps are added, and not factors.
    pub(super) const fn is_added(self) -> bool {
        matches!(self, Self::Restitution | Self::Inclination | Self::Friction)
    }

    /// The tolerance that the case states, and how many times that it is likely to be off by at the most.
    pub(super) fn tolerance(self, case: &Case) -> Option<(f64, f64)> {
        let parameter = self.parameter(case)?;
        let own = case.design.value(parameter)?;
        let stated = |of: Parameter| case.uncertainty.parameters().find(|(one, _)| *one == of);
        let ratio = |(_, of)| Some((of, own / case.design.value(Parameter::DampingRatio)?));
        let (error, scale) = match (stated(parameter), self) {
            (Some((_, of)), _) => (of, 1.0),
            // With the structure as it is the constant is in proportion to the ratio.
            (None, Self::Damping) => stated(Parameter::DampingRatio).and_then(ratio)?,
            (None, _) => return None,
        };
        let (error, times) = error.tolerance();
        Some((scale * error, times))
    }

    /// Values close to the case's own, outwards: in steps of half of the tolerance that the case states, up to the largest error
    /// or two standard deviations; none without one.
    pub(super) fn near(self, tolerance: Option<(f64, f64)>, own: f64, up: bool) -> Vec<f64> {
        let Some((tolerance, times)) = tolerance else { return Vec::new() };
        let half = if up { 0.5 } else { -0.5 } * tolerance;
        let steps = (1..=(2.0 * times) as u32).map(|k| own + f64::from(k) * half);
        steps.filter(|at| self.may_be(*at)).collect()
    }

    /// Whether it may have a value, as far as that is known of all cases.
    fn may_be(self, at: f64) -> bool {
        match self {
            Self::Restitution => (0.0..=1.0).contains(&at),
            Self::Inclination => true,
            Self::Friction => at >= 0.0,
            _ => at > 0.0,
        }
    }

    /// Values from the case's own outwards, down or up.
    pub(super) fn steps(self, own: f64, up: bool) -> Vec<f64> {
        let sign = if up { 1.0 } else { -1.0 };
        let added = |steps: &[f64]| steps.iter().map(|step| own + sign * step).collect::<Vec<_>>();
        let times = |steps: &[f64]| {
            steps.iter().map(|step| if up { own * step } else { own / step }).collect::<Vec<_>>()
        };
        match self {
            Self::Restitution | Self::Inclination | Self::Friction => {
                let mut all = match self {
                    Self::Restitution => added(&OF_RESTITUTION),
                    Self::Inclination => added(&OF_INCLINATION),
                    _ => added(&OF_FRICTION),
                };
                all.retain(|one| self.may_be(*one));
                all
            }
            Self::NaturalFrequency => times(&OF_FREQUENCY),
            Self::Damping | Self::Mass => times(&COARSE),
            _ => times(&FACTORS),
        }
    }
}
