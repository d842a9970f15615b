//! What rounding makes of the walls: touching them, and chattering down to sustained contact.

use super::events::Side;
use super::path::StraightLine;
use super::run::Simulation;
use crate::numerics::lanes::Real;

/// Units in the last place of the largest length involved that count as touching a wall.
pub(super) const TOUCH_ULPS: f64 = 16.0;

/// Distance over the clearance that rounding can move the walls by.
#[inline(always)]
pub(super) fn touch<R: Real>(x: R, v: R, line: StraightLine<R>) -> R {
    let scale = x.abs() + 1.0 + v.abs() + line.y.abs() + line.velocity.abs();
    scale * (TOUCH_ULPS * f64::EPSILON)
}

/// Whether the absorber is at a wall.
pub(super) fn touches(x: f64, v: f64, line: StraightLine<f64>) -> bool {
    ((x - line.y).abs() - 1.0).abs() <= touch(x, v, line)
}

/// Where a flight does not begin between the walls, nor leaves one.
#[inline(always)]
pub(super) fn blocked<R: Real>(x: R, v: R, line: StraightLine<R>) -> R::Mask {
    let (gap, slope) = (x - line.y, v - line.velocity);
    let touch = touch(x, v, line);
    let beyond = (touch + 1.0).less(gap.abs());
    let on = (-touch + 1.0).at_most(gap.abs());
    beyond | (on & gap.like(0.0).at_most(gap * slope))
}

/// What tells whether an impact may be the end of a chattering sequence.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sticking<R> {
    pub decay: R,
    pub stiffness: R,
    /// Largest force on the oscillator without absorber, and what gravity and friction add to the gap's acceleration.
    pub largest_force: R,
    /// Tolerated opening of the gap.
    pub excursion: R,
    /// `1/(1 - r^2)`: an impact takes the share `1 - r^2` of an excursion's energy.
    pub inverse_loss: R,
}

impl Sticking<f64> {
    /// That of a trajectory at a wall.
    pub(super) fn of(simulation: &Simulation, side: Side) -> Self {
        let (alone, r) = (&simulation.alone, simulation.restitution(side));
        let sliding = &simulation.sliding;
        Self {
            decay: alone.decay,
            stiffness: alone.stiffness,
            largest_force: alone.largest_force + sliding.gravity.abs() + sliding.grip(),
            excursion: simulation.tolerance.excursion,
            inverse_loss: 1.0 / ((1.0 - r) * (1.0 + r)),
        }
    }
}

impl<R: Real> Sticking<R> {
    /// Tolerated opening of the gap. Rounding adds up to a touch to each, of which an impact takes a share:
    /// where the two balance a sequence would never end.
    #[inline(always)]
    pub(super) fn tolerated(&self, x: R, v: R, line: StraightLine<R>) -> R {
        self.excursion.larger(touch(x, v, line) * self.inverse_loss)
    }

    /// Where the gap need not open further than tolerated after an impact on `wall`, whatever the
    /// acceleration is.
    #[inline(always)]
    pub(super) fn possible(&self, x: R, v: R, line: StraightLine<R>, wall: R) -> R::Mask {
        let opening = -wall * (v - line.velocity);
        let excursion = self.tolerated(x, v, line);
        let largest = self.largest_force + self.decay * 2.0 * v.abs() + self.stiffness * x.abs();
        (opening * opening).at_most(excursion * 2.0 * largest)
    }
}
