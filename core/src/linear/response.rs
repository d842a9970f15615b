//! What is read of a structure that a record drives, with an absorber, a damper or alone: peaks, mean square and energies,
//! piece by piece ([`Piece`]).
//!
//! Between two states that are near the motion is a cubic, so that integrals are exact but for `h^4`. The work of the
//! excitation is `W = integral f q' ds` with `q = x` for a force, `q = x + mu y` for a base that shakes; by parts it is
//! `f q` at the ends less the slope of `f` times the integral of `q`. The structure's damping takes
//! `eps lambda integral x'^2 ds`.

use crate::excitation::Piece;
use crate::numerics::extremes::Cubic;
use crate::system::{Shaking, State};

/// What a driven structure did. Lengths over the clearance and relative to the base, fast time; energies per unit of
/// the oscillator's mass.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Response {
    /// Largest displacement of the structure.
    pub peak: f64,
    /// Root mean square displacement over the whole record.
    pub rms: f64,
    /// Largest displacement of absorber or damper against the structure.
    pub stroke: f64,
    /// Impacts.
    pub impacts: u64,
    /// Largest relative speed of one of them.
    pub impact_speed: f64,
    /// Work of the excitation.
    pub work: f64,
    /// Energy that the structure's own damping took.
    pub damping_loss: f64,
    /// Energy that impacts took.
    pub impact_loss: f64,
    /// Energy of structure and absorber, or mass of the damper, at the end; its spring's not included.
    pub stored: f64,
    /// Time and displacement at the end of every piece.
    pub trace: Vec<[f64; 2]>,
    /// Velocity and acceleration of the structure with an absorber over the whole record, absolute: that of the base is added.
    /// None where they were not asked for.
    pub shaking: Option<Shaking>,
}

/// Measures a motion between states that are so near that it is a cubic in between.
pub struct Meter {
    /// What was measured so far.
    pub found: Response,
    /// Mass of the absorber or damper over the structure's, and `eps lambda`.
    mass_ratio: f64,
    damping: f64,
    /// Fast time that has passed.
    pub time: f64,
    square: f64,
}

impl Meter {
    /// Of an absorber or damper with a mass over the structure's, and `eps lambda`.
    pub fn new(mass_ratio: f64, damping: f64) -> Self {
        let mut found = Response::default();
        found.trace.push([0.0, 0.0]);
        Self { found, mass_ratio, damping, time: 0.0, square: 0.0 }
    }

    /// The base changes its velocity.
    pub fn jump(&mut self, piece: &Piece, state: &mut State) {
        let before = state.energy(self.mass_ratio);
        state.x_velocity += piece.jump;
        state.y_velocity += piece.jump;
        self.found.work += state.energy(self.mass_ratio) - before;
    }

    /// The motion between two times of a piece.
    pub fn moved(&mut self, piece: &Piece, [from, to]: [f64; 2], states: [&State; 2]) {
        let duration = to - from;
        let x = Cubic::of(duration, states.map(|state| [state.x, state.x_velocity]));
        let against =
            |state: &State| [state.relative_displacement(), state.x_velocity - state.y_velocity];
        let w = Cubic::of(duration, states.map(against));
        let found = &mut self.found;
        found.peak = found.peak.max(x.largest());
        found.stroke = found.stroke.max(w.largest());
        self.square += x.square();
        found.damping_loss += self.damping * x.square_of_slope();
        // The integral of f q', by parts.
        let moved = if piece.shakes { self.mass_ratio } else { 0.0 };
        let q = |state: &State| {
            [state.x + moved * state.y, state.x_velocity + moved * state.y_velocity]
        };
        let [force, slope] = piece.force;
        let ends = states.map(q);
        found.work += (force + slope * to) * ends[1][0] - (force + slope * from) * ends[0][0];
        found.work -= slope * Cubic::of(duration, ends).integral();
    }

    /// A piece has come to its end.
    pub fn passed(&mut self, piece: &Piece, state: &State) {
        self.time += piece.duration;
        self.found.trace.push([self.time, state.x]);
        self.found.stored = state.energy(self.mass_ratio);
    }

    /// What was measured.
    pub fn finished(mut self) -> Response {
        self.found.rms = if self.time > 0.0 { (self.square / self.time).sqrt() } else { 0.0 };
        self.found
    }
}
