//! Where the two asymmetric impacts of an ideal cavity end: the borders of area Z2.
//!
//! The motions are explicit in `nu`; what ends them is the sign of one closed form of it. Both of these change their sign
//! once between symmetry breaking, `nu = 0`, and [`LARGEST`], whatever the restitution.

use serde::Serialize;

use super::CavityTheory;
use super::motion::CavityMotion;
use super::shape::MotionShape;
use crate::equations::cavity::{DETERMINANT, DOUBLING, GRAZING, TRACE, TURNING, WALL_1, WALL_2};
use crate::numerics::bracket::brent;

/// `nu` next to symmetry breaking, where a multiplier is 1 up to its square.
const SMALLEST: f64 = 1e-3;
/// `nu` beyond both ends: a wall is grazed by 1.14, the period doubled by 0.73 and, for almost elastic impacts, again from
/// 1.38 on.
const LARGEST: f64 = 1.25;
/// Width of the last bracket: rounding of `nu`.
const WIDTH: f64 = 4.0 * f64::EPSILON;

/// Where the two asymmetric impacts per cycle of an ideal cavity end as the oscillator's amplitude grows.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct AsymmetricLimits {
    /// Where they double their period; `None` if a wall is grazed first.
    pub period_doubling: Option<CavityMotion>,
    /// Where the absorber grazes a wall, so that a third impact appears: the end of area Z2. `None` where it does
    /// before they begin, as for almost plastic impacts, `r` below a tenth.
    pub grazing: Option<CavityMotion>,
}

impl AsymmetricLimits {
    /// Those for the restitution `r` in `0..=1`.
    ///
    /// ```
    /// let limits = vinesink_core::cavity::AsymmetricLimits::of(0.6);
    /// let [doubling, grazing] = [limits.period_doubling, limits.grazing].map(|one| one.expect("both"));
    /// assert!((doubling.oscillator_amplitude - 1.008).abs() < 1e-3);
    /// assert!((grazing.oscillator_amplitude - 1.190).abs() < 1e-3);
    /// ```
    pub fn of(restitution: f64) -> Self {
        let cavity = CavityTheory::valid(0.0, 0.0, [restitution; 2]);
        let end = |condition: fn(f64, &MotionShape, [f64; 2]) -> f64| {
            let at = |nu: f64| cavity.asymmetric(nu);
            let f = |nu: f64| {
                let shape = at(nu);
                condition(restitution, &shape, cavity.velocities(&shape))
            };
            brent(SMALLEST, LARGEST, WIDTH, f).ok().map(|root| cavity.complete(&at(root.at)))
        };
        let grazing = end(grazing);
        let before = |one: &CavityMotion| grazing.is_some_and(|end| one.deviation < end.deviation);
        Self { period_doubling: end(doubling).filter(before), grazing }
    }
}

/// Above 0 while no multiplier is below -1.
fn doubling(r: f64, shape: &MotionShape, [u1, u2]: [f64; 2]) -> f64 {
    let ([[x1, v1], [x2, v2]], [t1, t2]) = (shape.at_impacts(), shape.times);
    let walls = [WALL_1.at([r, x1, v1, u2]), WALL_2.at([r, x2, v2, u1])];
    DOUBLING.at([TRACE.at([r, t1, t2, walls[0], walls[1]]), DETERMINANT.at([r])])
}

/// Above 0 where the absorber crosses the wall that it left before it flies to the other one. Where it does not turn, at
/// small `nu`, its slowest place counts.
fn grazing(_: f64, shape: &MotionShape, [u1, _]: [f64; 2]) -> f64 {
    let ([[x1, _], _], [in_phase, quadrature]) = (shape.at_impacts(), shape.parts);
    let turning = TURNING.at([shape.amplitude.max(u1), u1]);
    GRAZING.at([in_phase, quadrature, shape.times[0], u1, x1, turning])
}
