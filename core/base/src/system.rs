//! The dimensionless system that every layer computes with.
//!
//! Lengths are divided by the clearance, time by the reciprocal natural frequency
//! (`tau = omega0 t`), forces accordingly. With the mass ratio `eps`, the damping `lambda`, the
//! frequency ratio `Omega`, the forcing per clearance `gamma = G / b` and the restitution `r`, the
//! equation of motion is equation (1) of Li, Seguy, Berlioz (2016) divided by the clearance.

mod band;
mod modal;
mod parameter;
mod physical;
mod scales;
mod shaking;

use serde::{Deserialize, Serialize};

pub use band::{Band, BandOver, Stretch};
pub use modal::{
    InvalidModalSystem, LARGEST_DAMPING_RATIO, MOST_MODES, ModalAbsorber, ModalParameter,
    ModalParameters, ModalState, ModalSystem, Mode,
};
pub use parameter::Parameter;
pub use physical::{
    Absorber, Harmonic, STANDARD_GRAVITY, Structure, gravity_shares, modal_stiffness,
};
pub use scales::Scales;
pub use shaking::Shaking;

/// How the linear oscillator is driven.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Excitation {
    #[default]
    /// The base moves by `F sin(omega t)`; spring and damper both transmit it, equation (1).
    BaseDisplacement,
    /// A force acts on the oscillator's mass; there is no damper term in the excitation.
    Force,
}

/// The numbers of a [`System`] before they are proven valid.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Parameters {
    /// `eps = m2 / m1`, dimensionless, above 0.
    pub mass_ratio: f64,
    /// `lambda = c1 / (m2 omega0)`, dimensionless, at least 0.
    pub damping: f64,
    /// `r`, dimensionless, from 0 to 1.
    pub restitution: f64,
    /// `Omega = omega / omega0`, dimensionless, above 0.
    pub frequency_ratio: f64,
    /// `gamma = G / b`, dimensionless, at least 0. For a force of amplitude `P` on the mass,
    /// `G = P / (k1 eps)`.
    pub forcing_per_clearance: f64,
    /// Where the excitation enters.
    pub excitation: Excitation,
    /// What the cavity has beyond two equal walls.
    #[serde(flatten, skip_serializing_if = "Cavity::is_ideal")]
    pub cavity: Cavity,
}

/// What a real cavity has beyond two equal walls; all 0 in the paper's, [`Cavity::IDEAL`].
///
/// Between impacts the absorber has `y'' = a + s f`, `s` the sign of `w' = x' - y'`, and the oscillator takes
/// `-eps s f`. Displacements are those from the rest of the oscillator without absorber, gravity included.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Cavity {
    /// `a = g sin(inclination)/(b omega0^2)`, the absorber's acceleration along the cavity, towards the wall at
    /// `x - y = -b` where it is positive.
    pub gravity_along: f64,
    /// `f = mu g cos(inclination)/(b omega0^2)`, sliding friction over the absorber's mass, at least 0.
    pub friction_acceleration: f64,
    /// Restitution at the wall `x - y = +b` less that at `x - y = -b`; [`Parameters::restitution`] is their mean.
    pub restitution_difference: f64,
}

impl Cavity {
    /// Level, without friction, its ends alike.
    pub const IDEAL: Self =
        Self { gravity_along: 0.0, friction_acceleration: 0.0, restitution_difference: 0.0 };

    /// Whether it is level, without friction, and its ends are alike.
    pub fn is_ideal(&self) -> bool {
        *self == Self::IDEAL
    }

    /// Whether the mirror image of a motion is a motion: neither inclined nor with ends that differ.
    pub fn is_symmetric(&self) -> bool {
        self.gravity_along == 0.0 && self.restitution_difference == 0.0
    }

    /// Whether gravity or friction act on an absorber between the walls.
    pub fn moves_absorber(&self) -> bool {
        self.gravity_along != 0.0 || self.friction_acceleration != 0.0
    }

    /// The same accelerations over a `b omega0^2` that is `factor` times as large.
    #[must_use]
    pub fn with_clearance_scaled(self, factor: f64) -> Self {
        Self {
            gravity_along: self.gravity_along / factor,
            friction_acceleration: self.friction_acceleration / factor,
            ..self
        }
    }
}

/// A parameter that no physical system can have.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{name} is {value}, expected {expected}")]
#[non_exhaustive]
pub struct InvalidParameter {
    /// The parameter's name as in [`Parameters`].
    pub name: &'static str,
    /// The offending value.
    pub value: f64,
    /// What would have been accepted, as words.
    pub expected: &'static str,
}

/// A dimensionless system whose parameters have been proven valid once, here.
///
/// [`System::new`] checks every number and names the one that no system can have; [`System::physical`] begins with those
/// of a drawing.
///
/// ```
/// use vinesink_core::system::{Cavity, Excitation, Parameters, System};
///
/// let parameters = Parameters {
///     mass_ratio: 0.01,
///     damping: 2.0, // over the absorber's mass: the damping ratio is 0.01 * 2.0 / 2 = 1 %
///     restitution: 0.6,
///     frequency_ratio: 1.0,
///     forcing_per_clearance: 3.0,
///     excitation: Excitation::Force,
///     cavity: Cavity::IDEAL,
/// };
/// let system = System::new(parameters)?;
/// // At resonance the damper alone holds the force: an amplitude of gamma / lambda clearances.
/// let bare = system.linear_response().expect("damped").amplitude();
/// assert!((bare - 3.0 / 2.0).abs() < 1e-14);
///
/// let refused = System::new(Parameters { restitution: 1.2, ..parameters }).unwrap_err();
/// assert_eq!(refused.to_string(), "restitution is 1.2, expected a number from 0 to 1");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(into = "Parameters")]
pub struct System {
    parameters: Parameters,
    // Held beside the frequency ratio, because 1 + eps sigma forgets sigma when eps is tiny.
    detuning: f64,
    // By how much the excitation's phase is ahead: of stretches of a sweep, which need not begin with a period.
    lead: f64,
}

impl From<System> for Parameters {
    fn from(system: System) -> Self {
        system.parameters
    }
}

impl System {
    /// Accepts every physically meaningful combination, extremes included.
    ///
    /// # Errors
    /// [`InvalidParameter`] names the first parameter that is not finite or out of its range.
    pub fn new(parameters: Parameters) -> Result<Self, InvalidParameter> {
        let p = &parameters;
        let positive =
            |name, value: f64| check(name, value, value > 0.0, "a finite number above 0");
        let not_negative =
            |name, value: f64| check(name, value, value >= 0.0, "a finite number, 0 or more");
        positive("mass_ratio", p.mass_ratio)?;
        not_negative("damping", p.damping)?;
        let within = (0.0..=1.0).contains(&p.restitution);
        check("restitution", p.restitution, within, "a number from 0 to 1")?;
        let Cavity { gravity_along, friction_acceleration, restitution_difference } = p.cavity;
        check("gravity_along", gravity_along, true, "a finite number")?;
        not_negative("friction_acceleration", friction_acceleration)?;
        let within = within_one(p.restitution, restitution_difference);
        let expected = "a difference that leaves both restitutions from 0 to 1";
        check("restitution_difference", restitution_difference, within, expected)?;
        positive("frequency_ratio", p.frequency_ratio)?;
        not_negative("forcing_per_clearance", p.forcing_per_clearance)?;
        let detuning = (p.frequency_ratio - 1.0) / p.mass_ratio;
        check("detuning", detuning, true, "a finite number")?;
        Ok(Self { parameters, detuning, lead: 0.0 })
    }

    /// `eps`, the mass ratio.
    pub fn mass_ratio(&self) -> f64 {
        self.parameters.mass_ratio
    }

    /// `lambda`, a pure number, so that the damping term of the oscillator is `eps lambda x'` in fast time.
    pub fn damping(&self) -> f64 {
        self.parameters.damping
    }

    /// What the cavity has beyond two equal walls.
    pub fn cavity(&self) -> Cavity {
        self.parameters.cavity
    }

    /// Coefficients of restitution at the walls `x - y = +b` and `x - y = -b`.
    pub fn restitutions(&self) -> [f64; 2] {
        let half = 0.5 * self.parameters.cavity.restitution_difference;
        [half, -half].map(|half| (self.parameters.restitution + half).clamp(0.0, 1.0))
    }

    /// `r`, the coefficient of restitution, a ratio from 0 to 1; the mean where the walls differ.
    pub fn restitution(&self) -> f64 {
        self.parameters.restitution
    }

    /// `Omega`, the excitation frequency over the natural frequency.
    pub fn frequency_ratio(&self) -> f64 {
        self.parameters.frequency_ratio
    }

    /// `sigma = (Omega - 1) / eps`, the detuning of equation (7).
    pub fn detuning(&self) -> f64 {
        self.detuning
    }

    /// `gamma = G / b`, the reduced forcing per clearance.
    pub fn forcing_per_clearance(&self) -> f64 {
        self.parameters.forcing_per_clearance
    }

    /// Where the excitation enters.
    pub fn excitation(&self) -> Excitation {
        self.parameters.excitation
    }

    /// `2 pi / Omega`, the excitation period in fast time.
    pub fn period(&self) -> f64 {
        std::f64::consts::TAU / self.parameters.frequency_ratio
    }

    /// All parameters, to derive a neighbouring system from.
    pub fn parameters(&self) -> Parameters {
        self.parameters
    }

    /// The same excitation acting on a system whose clearance is `factor` times as large.
    ///
    /// # Errors
    /// As [`System::new`], when `factor` is not a positive finite number.
    pub fn with_clearance_scaled(&self, factor: f64) -> Result<Self, InvalidParameter> {
        check("clearance factor", factor, factor > 0.0, "a finite number above 0")?;
        let forcing_per_clearance = self.parameters.forcing_per_clearance / factor;
        let cavity = self.parameters.cavity.with_clearance_scaled(factor);
        let scaled = Self::new(Parameters { forcing_per_clearance, cavity, ..self.parameters })?;
        Ok(Self { detuning: self.detuning, ..scaled })
    }

    /// The same system driven at another frequency.
    ///
    /// # Errors
    /// As [`System::new`].
    pub fn with_frequency_ratio(&self, frequency_ratio: f64) -> Result<Self, InvalidParameter> {
        Self::new(Parameters { frequency_ratio, ..self.parameters })
    }

    /// The same system driven at the detuning `sigma`, which [`System::detuning`] then returns
    /// exactly, however small the mass ratio; `Omega = 1 + eps sigma`.
    ///
    /// # Errors
    /// As [`System::new`], when `sigma` is not finite or leaves no positive frequency.
    pub fn with_detuning(&self, detuning: f64) -> Result<Self, InvalidParameter> {
        let frequency_ratio = libm::fma(self.parameters.mass_ratio, detuning, 1.0);
        Ok(Self { detuning, ..self.with_frequency_ratio(frequency_ratio)? })
    }

    /// The same system whose excitation is ahead by a phase in radians: `sin(Omega tau + lead)`.
    #[must_use]
    pub fn with_lead(&self, lead: f64) -> Self {
        Self { lead, ..*self }
    }

    /// Complex amplitude, over the clearance, of the steady motion without absorber impacts, so
    /// that `x = re sin(Omega tau) + im cos(Omega tau)`. `None` for an undamped system driven
    /// exactly at its natural frequency, which has no steady motion.
    pub fn linear_response(&self) -> Option<LinearResponse> {
        self.response_of(1.0)
    }

    /// The same with the absorber in tow, without what gravity displaces; the mass is then `1 + eps`.
    pub fn response_carried(&self) -> Option<LinearResponse> {
        self.response_of(1.0 + self.parameters.mass_ratio)
    }

    fn response_of(&self, mass: f64) -> Option<LinearResponse> {
        let omega = self.parameters.frequency_ratio;
        let damping = self.parameters.mass_ratio * self.parameters.damping;
        let (sine, cosine) = self.excitation_amplitudes();
        let scaled = mass.sqrt() * omega;
        let stiffness = (1.0 - scaled) * (1.0 + scaled);
        let loss = damping * omega;
        let scale = stiffness * stiffness + loss * loss;
        if scale == 0.0 {
            return None;
        }
        Some(LinearResponse {
            sine: (sine * stiffness + cosine * loss) / scale,
            cosine: (cosine * stiffness - sine * loss) / scale,
        })
    }

    /// Amplitudes of the excitation's `sin(Omega tau)` and `cos(Omega tau)` on the right-hand side
    /// of equation (1), over the clearance.
    pub fn excitation_amplitudes(&self) -> (f64, f64) {
        let Parameters { mass_ratio: eps, damping, frequency_ratio, .. } = self.parameters;
        let sine = eps * self.parameters.forcing_per_clearance;
        let (sine, cosine) = match self.parameters.excitation {
            Excitation::BaseDisplacement => (sine, eps * damping * frequency_ratio * sine),
            Excitation::Force => (sine, 0.0),
        };
        if self.lead == 0.0 {
            return (sine, cosine);
        }
        let (s, c) = libm::sincos(self.lead);
        (sine * c - cosine * s, sine * s + cosine * c)
    }
}

/// Displacements and velocities of oscillator and absorber, over the clearance, in fast time.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct State {
    /// Oscillator displacement.
    pub x: f64,
    /// Oscillator velocity.
    pub x_velocity: f64,
    /// Absorber displacement.
    pub y: f64,
    /// Absorber velocity.
    pub y_velocity: f64,
}

impl State {
    /// Nothing moves, and the absorber is in the middle of its cavity.
    pub const AT_REST: Self = Self { x: 0.0, x_velocity: 0.0, y: 0.0, y_velocity: 0.0 };

    /// Relative displacement `w = x - y`, over the clearance.
    pub fn relative_displacement(&self) -> f64 {
        self.x - self.y
    }

    /// Largest absolute value among the four, lengths over the clearance and fast time.
    pub fn size(&self) -> f64 {
        let Self { x, x_velocity, y, y_velocity } = *self;
        [x, x_velocity, y, y_velocity].iter().map(|part| part.abs()).fold(0.0, f64::max)
    }

    /// Largest difference from `other` in any of the four, lengths over the clearance and fast time.
    pub fn distance(&self, other: &Self) -> f64 {
        let difference = Self {
            x: self.x - other.x,
            x_velocity: self.x_velocity - other.x_velocity,
            y: self.y - other.y,
            y_velocity: self.y_velocity - other.y_velocity,
        };
        difference.size()
    }

    /// Kinetic and potential energy per unit of the oscillator's mass.
    pub fn energy(&self, mass_ratio: f64) -> f64 {
        0.5 * (self.x * self.x
            + self.x_velocity * self.x_velocity
            + mass_ratio * self.y_velocity * self.y_velocity)
    }
}

/// Steady motion of the oscillator alone, over the clearance: `sine sin(Omega tau) + cosine
/// cos(Omega tau)`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LinearResponse {
    /// Coefficient of `sin(Omega tau)`.
    pub sine: f64,
    /// Coefficient of `cos(Omega tau)`.
    pub cosine: f64,
}

impl LinearResponse {
    /// Amplitude over the clearance.
    pub fn amplitude(&self) -> f64 {
        libm::hypot(self.sine, self.cosine)
    }

    /// The oscillator on its steady motion at excitation phase 0, the absorber resting in the
    /// middle of its travel.
    pub fn state(&self, system: &System) -> State {
        let x_velocity = system.frequency_ratio() * self.sine;
        State { x: self.cosine, x_velocity, y: 0.0, y_velocity: 0.0 }
    }
}

/// Whether both restitutions are from 0 to 1, but for the rounding of their mean.
fn within_one(mean: f64, difference: f64) -> bool {
    0.5 * difference.abs() <= mean.min(1.0 - mean) + f64::EPSILON
}

#[doc(hidden)]
pub fn check(
    name: &'static str,
    value: f64,
    within: bool,
    expected: &'static str,
) -> Result<(), InvalidParameter> {
    if within && value.is_finite() {
        Ok(())
    } else {
        Err(InvalidParameter { name, value, expected })
    }
}
