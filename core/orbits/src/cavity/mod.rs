//! The theory at leading order where the cavity is tilted, rubs, or returns the absorber otherwise at its two ends.
//!
//! Between impacts the absorber has `y'' = a + s f`, `s` the sign of `w'`: `a` is gravity's part along the cavity, `f`
//! the sliding friction, both over `b omega0^2`. `r_1` is the restitution at the wall `w = b`, `r_2` that at `w = -b`.
//! Every motion with two impacts per cycle, also the asymmetric one of a level cavity without friction, is explicit in
//! the times between its impacts ([`CavityMotion`]); the slow flow on these motions has its fixed points at the roots of
//! one function of them ([`CavityFixedPoint`]).
//!
//! Source: derived here beyond Li, Seguy, Berlioz (2016), in [`crate::equations::cavity`]; with a level cavity, equal
//! ends and no friction it is (14) to (18). Valid at first order in the mass ratio, near 1:1 resonance; with friction
//! only while the relative velocity keeps its sign between impacts, which [`CavityMotion::admissible`] tells. A friction
//! that goes to 0 therefore ends at admissible motions of fewer kinds than none does.

mod analysis;
mod fixed_point;
mod limits;
mod linear_map;
mod manifold;
mod motion;
mod shape;

use serde::Serialize;

use crate::equations::cavity::{
    DEVIATION, FRICTION_BREAKING, FRICTION_FOLD, FRICTION_FOLD_RATIO, RATIO_DIFFERENCE, RATIO_MEAN,
};
use crate::equations::stated::{CURVATURE, RESTITUTION_RATIO};
use crate::system::{Cavity, InvalidParameter, System, check};

pub use analysis::CavityAnalysis;
pub use fixed_point::{CavityFixedPoint, Forcing};
pub use limits::AsymmetricLimits;
pub use motion::CavityMotion;

/// A point of the manifold, over the clearance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ManifoldPoint {
    /// Amplitude of the absorber's sawtooth, `B/b`.
    #[serde(rename = "B")]
    pub absorber_amplitude: f64,
    /// Amplitude of the oscillator, `C/b`.
    #[serde(rename = "C")]
    pub oscillator_amplitude: f64,
}

/// A cavity with a tilt, friction and a restitution for each end.
///
/// ```
/// use vinesink_core::cavity::{CavityTheory, Forcing};
///
/// // Table 1 of Li, Seguy, Berlioz (2016) at 8 Hz and b = 7.5 mm, where gravity is 0.4753 b omega0^2: a tilt of
/// // 1 degree, a friction coefficient of 0.05.
/// let cavity = CavityTheory::new(0.4753 * 0.017452, 0.4753 * 0.05, [0.6, 0.6])?;
/// let forcing = Forcing { damping: 1.799, detuning: -5.445, forcing_per_clearance: 4.3417 };
/// let points = cavity.fixed_points(&forcing);
/// let steady = points.iter().find(|point| point.stable).expect("one");
/// // Impacts are no longer half a cycle apart; level and without friction the amplitude is 0.470.
/// let [there, back] = steady.motion.times;
/// assert!((back - there - 0.0765).abs() < 1e-4);
/// assert!((steady.motion.oscillator_amplitude - 0.4635).abs() < 1e-4);
/// let refused = CavityTheory::new(0.0, -0.1, [0.6, 0.6]).unwrap_err();
/// assert_eq!(refused.to_string(), "friction is -0.1, expected a finite number, 0 or more");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CavityTheory {
    acceleration: f64,
    friction: f64,
    restitutions: [f64; 2],
    /// Mean of `rho` at both ends, and that at `w = b` less that at `w = -b`.
    #[serde(skip)]
    ratios: [f64; 2],
}

impl CavityTheory {
    /// A cavity with `acceleration` `a` of any sign and `friction` `f`, both over `b omega0^2`, and the restitutions at
    /// `w = b` and `w = -b`.
    ///
    /// # Errors
    /// [`InvalidParameter`] names the first number that is not finite or out of its range.
    pub fn new(
        acceleration: f64,
        friction: f64,
        restitutions: [f64; 2],
    ) -> Result<Self, InvalidParameter> {
        check("acceleration", acceleration, true, "a finite number")?;
        check("friction", friction, friction >= 0.0, "a finite number, 0 or more")?;
        for (name, value) in ["first restitution", "second restitution"].iter().zip(restitutions) {
            check(name, value, (0.0..=1.0).contains(&value), "a number from 0 to 1")?;
        }
        Ok(Self::valid(acceleration, friction, restitutions))
    }

    /// The cavity of a system.
    pub fn of(system: &System) -> Self {
        let Cavity { gravity_along, friction_acceleration, .. } = system.cavity();
        Self::valid(gravity_along, friction_acceleration, system.restitutions())
    }

    fn valid(acceleration: f64, friction: f64, restitutions: [f64; 2]) -> Self {
        let at_ends = restitutions.map(|one| RESTITUTION_RATIO.at([one]));
        let ratios = [RATIO_MEAN.at(at_ends), RATIO_DIFFERENCE.at(at_ends)];
        Self { acceleration, friction, restitutions, ratios }
    }

    /// `a`, the absorber's acceleration along the cavity over `b omega0^2`: `g sin(tilt)`.
    pub fn acceleration(&self) -> f64 {
        self.acceleration
    }

    /// `f`, friction per mass of the absorber over `b omega0^2`: `mu g cos(tilt)`.
    pub fn friction(&self) -> f64 {
        self.friction
    }

    /// Restitutions at `w = b` and `w = -b`.
    pub fn restitutions(&self) -> [f64; 2] {
        self.restitutions
    }

    /// Whether the cavity is level and both ends are equal.
    pub fn is_symmetric(&self) -> bool {
        self.acceleration == 0.0 && self.ratios[1] == 0.0
    }

    /// Where impacts of a symmetric cavity begin, in closed form; `None` for another one, or where friction, `f >= 1/rho`,
    /// leaves none.
    pub fn fold(&self) -> Option<ManifoldPoint> {
        let [ratio, _] = self.ratios;
        let given = [self.friction, ratio, CURVATURE.at([ratio])];
        let absorber_amplitude = FRICTION_FOLD_RATIO.at(given);
        let point =
            ManifoldPoint { absorber_amplitude, oscillator_amplitude: FRICTION_FOLD.at(given) };
        (self.is_symmetric() && absorber_amplitude > 0.0).then_some(point)
    }

    /// Where two symmetric impacts of a symmetric cavity lose their symmetry, in closed form; `None` as for the fold.
    pub fn symmetry_breaking(&self) -> Option<ManifoldPoint> {
        let absorber_amplitude = FRICTION_BREAKING.at([self.friction, self.ratios[0]]);
        let motion = self.symmetric_motion(absorber_amplitude)?;
        let oscillator_amplitude = motion.oscillator_amplitude;
        Some(ManifoldPoint { absorber_amplitude, oscillator_amplitude })
    }

    /// `nu`, an angle of the excitation in radians: a quarter of what the flight from `w = b` to `w = -b` takes longer than
    /// that back, at an absorber amplitude `B/b`: first order in tilt and difference of the ends, and singular where symmetry
    /// would break. A difference `rho_d` of the ends looks like a tilt `a = -2 rho_d B/(pi^2 rho)`.
    pub fn small_deviation(&self, absorber: f64) -> f64 {
        let [mean, difference] = self.ratios;
        DEVIATION.at([self.acceleration, self.friction, mean, difference, absorber])
    }
}
