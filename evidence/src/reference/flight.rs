//! The two motions between events: the absorber free or sliding, its parabola beside the oscillator, and both
//! as one mass.

use super::oscillator::{ReferenceOscillator, TimePoint, Vector};
use super::real::Decimal;

/// The absorber moves freely, or slides under a friction of constant direction.
pub(super) struct ReferenceFlight {
    start: Vector,
    /// Displacement at which a constant force holds the oscillator.
    rest: Decimal,
    y: Decimal,
    velocity: Decimal,
    acceleration: Decimal,
}

impl ReferenceFlight {
    /// From displacements and velocities: the absorber is accelerated by `gravity` and by `friction`, whose
    /// reaction the oscillator feels.
    pub(super) fn new(
        z: &Vector,
        [y, velocity]: [&Decimal; 2],
        [gravity, friction, eps]: [&Decimal; 3],
    ) -> Self {
        Self {
            start: z.clone(),
            rest: -&(eps * friction),
            y: y.clone(),
            velocity: velocity.clone(),
            acceleration: gravity + friction,
        }
    }

    pub(super) fn start(&self) -> TimePoint {
        TimePoint { s: Decimal::of(0.0), z: about(&self.start, &self.rest) }
    }

    /// The oscillator with its excitation.
    pub(super) fn z(&self, point: &TimePoint) -> Vector {
        about(&point.z, &-&self.rest)
    }

    /// Displacement and velocity of the absorber.
    pub(super) fn absorber(&self, point: &TimePoint) -> [Decimal; 2] {
        let gained = &self.acceleration * &point.s;
        let half = &(&gained * &point.s) / &Decimal::of(2.0);
        let y = &(&self.y + &(&self.velocity * &point.s)) + &half;
        [y, &self.velocity + &gained]
    }

    /// `w = x - y` and its rate.
    pub(super) fn gap(&self, point: &TimePoint) -> [Decimal; 2] {
        let [y, velocity] = self.absorber(point);
        [&(&point.z[0] + &self.rest) - &y, &point.z[1] - &velocity]
    }

    /// `w''`.
    pub(super) fn bend(&self, alone: &ReferenceOscillator, point: &TimePoint) -> Decimal {
        &alone.rate(&point.z)[1] - &self.acceleration
    }
}

/// The absorber is held, and the oscillator carries it.
pub(super) struct Hold {
    gravity: Decimal,
    /// Displacement at which the absorber's weight holds the oscillator.
    rest: Decimal,
}

impl Hold {
    pub(super) fn new(gravity: &Decimal, eps: &Decimal) -> Self {
        Self { gravity: gravity.clone(), rest: eps * gravity }
    }

    pub(super) fn start(&self, z: &Vector) -> TimePoint {
        TimePoint { s: Decimal::of(0.0), z: about(z, &self.rest) }
    }

    /// The oscillator with its excitation.
    pub(super) fn z(&self, point: &TimePoint) -> Vector {
        about(&point.z, &-&self.rest)
    }

    /// What friction and wall together accelerate the absorber by, and its rate.
    pub(super) fn held_by(
        &self,
        carrying: &ReferenceOscillator,
        point: &TimePoint,
    ) -> [Decimal; 2] {
        let rate = carrying.rate(&point.z);
        [&rate[1] - &self.gravity, carrying.rate(&rate)[1].clone()]
    }
}

/// The same motion, displacements counted from elsewhere.
fn about([x, v, sin, cos]: &Vector, rest: &Decimal) -> Vector {
    [x - rest, v.clone(), sin.clone(), cos.clone()]
}
