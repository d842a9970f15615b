//! Where the absorber is while it flies: on a straight line, for one trajectory or for several side by side, or on a
//! parabola where gravity or friction bend it.

use crate::numerics::lanes::Real;

/// The absorber's flight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct StraightLine<R> {
    /// Displacement at its beginning.
    pub y: R,
    /// Velocity.
    pub velocity: R,
}

/// Where the absorber is while it flies.
pub(super) trait Path<R: Real>: Copy {
    /// The rest of it, from a time `s` on.
    fn from(self, s: R) -> Self;
    /// Displacement and velocity at its beginning.
    fn line(self) -> StraightLine<R>;
    /// The gap's acceleration where the oscillator has the acceleration `a`.
    fn bend(self, a: R) -> R;
    /// The reverse.
    fn unbend(self, bend: R) -> R;
    /// A bound on the gap's acceleration, from one on the oscillator's.
    fn bound(self, largest: R) -> R;
}

impl<R: Real> Path<R> for StraightLine<R> {
    #[inline(always)]
    fn from(self, s: R) -> Self {
        Self { y: self.y + self.velocity * s, ..self }
    }
    #[inline(always)]
    fn line(self) -> Self {
        self
    }
    #[inline(always)]
    fn bend(self, a: R) -> R {
        a
    }
    #[inline(always)]
    fn unbend(self, bend: R) -> R {
        bend
    }
    #[inline(always)]
    fn bound(self, largest: R) -> R {
        largest
    }
}

/// A flight with a constant acceleration.
#[derive(Debug, Clone, Copy)]
pub(super) struct Parabola<R = f64> {
    pub line: StraightLine<R>,
    pub acceleration: R,
}

impl<R: Real> Path<R> for Parabola<R> {
    #[inline(always)]
    fn from(self, s: R) -> Self {
        let StraightLine { y, velocity } = self.line;
        let gained = self.acceleration * s;
        let line =
            StraightLine { y: y + (velocity + gained * 0.5) * s, velocity: velocity + gained };
        Self { line, ..self }
    }
    #[inline(always)]
    fn line(self) -> StraightLine<R> {
        self.line
    }
    #[inline(always)]
    fn bend(self, a: R) -> R {
        a - self.acceleration
    }
    #[inline(always)]
    fn unbend(self, bend: R) -> R {
        bend + self.acceleration
    }
    #[inline(always)]
    fn bound(self, largest: R) -> R {
        largest + self.acceleration.abs()
    }
}
