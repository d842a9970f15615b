//! A structure that is let go or struck: `x(0) = x0`, `x'(0) = v0` or `J/m1` of an impulse `J`, and an absorber at
//! `y(0) = x0 - w`, at rest or as fast as the structure where the base came to move.

use crate::system::{Parameter, Scales, State};

/// How a structure is set in motion, in SI or the units of a reduced case; the absorber's place is open.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Release {
    /// The structure is let go; the absorber rests.
    LetGo {
        /// Displacement of the structure.
        displacement: f64,
        /// Its velocity.
        velocity: f64,
    },
    /// The structure is struck while both rest.
    Struck {
        /// Impulse on the structure.
        impulse: f64,
    },
    /// The base gets a velocity at once: against it structure and absorber move together, the other way.
    BaseMoves {
        /// That velocity.
        velocity: f64,
    },
}

impl Release {
    /// The number that a parameter is in it; an amplitude is how hard it is struck.
    pub const fn number(&mut self, parameter: Parameter) -> Option<&mut f64> {
        match (self, parameter) {
            (Self::LetGo { displacement, .. }, Parameter::InitialDisplacement) => {
                Some(displacement)
            }
            (Self::LetGo { velocity, .. }, Parameter::InitialVelocity) => Some(velocity),
            (Self::Struck { impulse }, Parameter::Amplitude) => Some(impulse),
            (Self::BaseMoves { velocity }, Parameter::Amplitude) => Some(velocity),
            _ => None,
        }
    }

    /// Whether nothing moves.
    pub fn is_rest(self) -> bool {
        self == self.scaled(0.0)
    }

    /// The same, so many times as strong.
    #[must_use]
    pub const fn scaled(self, factor: f64) -> Self {
        match self {
            Self::LetGo { displacement, velocity } => {
                Self::LetGo { displacement: factor * displacement, velocity: factor * velocity }
            }
            Self::Struck { impulse } => Self::Struck { impulse: factor * impulse },
            Self::BaseMoves { velocity } => Self::BaseMoves { velocity: factor * velocity },
        }
    }

    /// The amplitude with which the structure begins, over the clearance.
    pub fn amplitude(&self, scales: &Scales) -> f64 {
        amplitude(&self.state(scales, 0.0))
    }

    /// Velocity of the frame that its displacements are seen from, over clearance and fast time: that of a base which came to
    /// move.
    pub fn frame_velocity(&self, scales: &Scales) -> f64 {
        match *self {
            Self::LetGo { .. } | Self::Struck { .. } => 0.0,
            Self::BaseMoves { velocity } => -velocity / scales.velocity(1.0),
        }
    }

    /// The state in which an absorber at a relative displacement `w` begins.
    pub fn state(&self, scales: &Scales, w: f64) -> State {
        let [displacement, velocity, absorber_velocity] = match *self {
            Self::LetGo { displacement, velocity } => [displacement, velocity, 0.0],
            Self::Struck { impulse } => [0.0, impulse / scales.oscillator_mass, 0.0],
            Self::BaseMoves { velocity } => [0.0, velocity, velocity],
        };
        let (x, speed) = (scales.over_clearance(displacement), scales.velocity(1.0));
        State { x, x_velocity: velocity / speed, y: x - w, y_velocity: absorber_velocity / speed }
    }
}

/// The amplitude of a structure in a state, in the unit of its displacement.
pub fn amplitude(state: &State) -> f64 {
    libm::hypot(state.x, state.x_velocity)
}
