//! What rounding makes of the walls: touching them, and chattering down to sustained contact.

use super::phasor::{Line, Rates};
use crate::numerics::lanes::Real;

/// Units in the last place of the largest length involved that count as touching a wall.
pub(super) const TOUCH_ULPS: f64 = 16.0;

/// Distance over the clearance that rounding can move the walls by.
#[inline(always)]
pub(super) fn touch<R: Real>(x: R, v: R, line: Line<R>) -> R {
    let scale = x.abs() + 1.0 + v.abs() + line.y.abs() + line.velocity.abs();
    scale * (TOUCH_ULPS * f64::EPSILON)
}

/// Where a flight does not begin between the walls, nor leaves one.
#[inline(always)]
pub(super) fn blocked<R: Real>(x: R, v: R, line: Line<R>) -> R::Mask {
    let (gap, slope) = (x - line.y, v - line.velocity);
    let touch = touch(x, v, line);
    let beyond = (touch + 1.0).less(gap.abs());
    let on = (-touch + 1.0).at_most(gap.abs());
    beyond | (on & gap.like(0.0).at_most(gap * slope))
}

/// What tells whether an impact may be the end of a chattering sequence.
pub(super) struct Sticking<'a, R> {
    pub rates: &'a Rates<R>,
    pub largest_force: R,
    /// Tolerated opening of the gap.
    pub excursion: R,
    /// `1/(1 - r^2)`.
    pub inverse_loss: R,
}

/// Where the gap need not open further than tolerated after an impact on `wall`, whatever the
/// acceleration is.
#[inline(always)]
pub(super) fn may_stick<R: Real>(
    x: R,
    v: R,
    line: Line<R>,
    wall: R,
    by: &Sticking<'_, R>,
) -> R::Mask {
    let opening = -wall * (v - line.velocity);
    let excursion = by.excursion.larger(touch(x, v, line) * by.inverse_loss);
    let largest = by.largest_force + by.rates.decay * 2.0 * v.abs() + by.rates.stiffness * x.abs();
    (opening * opening).at_most(excursion * 2.0 * largest)
}

/// `1/(1 - r^2)`: an impact takes the share `1 - r^2` of an excursion's energy.
pub(super) fn inverse_loss(restitution: f64) -> f64 {
    1.0 / ((1.0 - restitution) * (1.0 + restitution))
}
