//! A structure that is let go or struck: `x(0) = x0`, `x'(0) = v0 + J/m1` with an impulse `J`, and an absorber at rest at
//! `y(0) = x0 - w`, or as fast as the structure where the base came to move.

use crate::system::{Scales, State};

/// How a structure is set in motion, in SI or the units of a reduced case; the absorber's place is open.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Release {
    /// Displacement of the structure.
    pub displacement: f64,
    /// Its velocity.
    pub velocity: f64,
    /// Velocity of the absorber: that of the structure where the base was set in motion, else 0.
    pub absorber_velocity: f64,
    /// Impulse on the structure, which adds to its velocity.
    pub impulse: f64,
}

impl Release {
    /// The same, so many times as strong.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let Self { displacement, velocity, absorber_velocity, impulse } = *self;
        Self {
            displacement: factor * displacement,
            velocity: factor * velocity,
            absorber_velocity: factor * absorber_velocity,
            impulse: factor * impulse,
        }
    }

    /// The amplitude with which the structure begins, over the clearance.
    pub fn amplitude(&self, scales: &Scales) -> f64 {
        amplitude(&self.state(scales, 0.0))
    }

    /// The state in which an absorber at a relative displacement `w` begins.
    pub fn state(&self, scales: &Scales, w: f64) -> State {
        let x = scales.over_clearance(self.displacement);
        let velocity = self.velocity + self.impulse / scales.oscillator_mass;
        let speed = scales.velocity(1.0);
        let y_velocity = self.absorber_velocity / speed;
        State { x, x_velocity: velocity / speed, y: x - w, y_velocity }
    }
}

/// The amplitude of a structure in a state.
pub fn amplitude(state: &State) -> f64 {
    libm::hypot(state.x, state.x_velocity)
}
