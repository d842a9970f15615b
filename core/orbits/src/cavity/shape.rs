//! What a motion of a cavity is made of.

use crate::equations::cavity::{PLACE_1, PLACE_2, SPEED_1, SPEED_2};

/// What a motion is made of, by `nu` and `c_c`.
#[derive(Debug, Clone, Copy)]
pub(super) struct MotionShape {
    pub(super) nu: f64,
    pub(super) times: [f64; 2],
    pub(super) drift: f64,
    pub(super) absorber: f64,
    /// `c_c`, `c_s`.
    pub(super) parts: [f64; 2],
    pub(super) amplitude: f64,
    pub(super) impulse: f64,
    pub(super) contact: f64,
    /// `S`, `K`.
    pub(super) forces: [f64; 2],
}

/// Changes of parts of a [`MotionShape`] along the manifold.
pub(super) struct ShapeChange {
    pub(super) parts: [f64; 2],
    pub(super) impulse: f64,
    pub(super) contact: f64,
    pub(super) amplitude: f64,
}

impl MotionShape {
    /// Whether the absorber goes from wall to wall: numbers out of range do not.
    pub(super) fn is_motion(&self) -> bool {
        self.absorber > 0.0 && self.amplitude > 0.0 && self.amplitude.is_finite()
    }

    /// Displacements and velocities of the oscillator at the two impacts.
    pub(super) fn at_impacts(&self) -> [[f64; 2]; 2] {
        let [in_phase, quadrature] = self.parts;
        let given = [self.nu, in_phase, quadrature];
        [[PLACE_1.at(given), SPEED_1.at(given)], [PLACE_2.at(given), SPEED_2.at(given)]]
    }
}
