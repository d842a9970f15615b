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
    /// Root mean square displacement over the record, without what comes after its end.
    pub rms: f64,
    /// Largest displacement of absorber or damper against the structure.
    pub stroke: f64,
    /// Impacts.
    pub impacts: u64,
    /// Largest relative speed of one of them.
    pub impact_speed: f64,
    /// Work of the excitation.
    pub work: f64,
    /// Energy that the structure's own damping took until the record's end.
    pub damping_loss: f64,
    /// Energy that impacts took.
    pub impact_loss: f64,
    /// Energy of structure and absorber, or mass of the damper, at the record's end; its spring's not included.
    pub stored: f64,
    /// Time and displacement at the end of every piece, after the record's end for as long as the displacement could still
    /// become larger.
    pub trace: Vec<[f64; 2]>,
    /// Velocity and acceleration of the structure, absolute: that of the base is added. Root mean squares are those over the
    /// record. None where they were not asked for.
    pub shaking: Option<Shaking>,
    /// How long the motion was followed, and of it after the record's end.
    pub duration: f64,
    /// See [`Self::duration`].
    pub rang: f64,
    /// By how much the largest displacement may exceed [`Self::peak`]: 0 unless nothing takes the energy that is left.
    pub open: f64,
}

/// Largest values that a motion which nothing drives any more can still reach, by the energy that is left.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StillToCome {
    /// Displacement of the structure.
    pub displacement: f64,
    /// Displacement of a damper's mass against the structure; 0 of an absorber, whose walls bound it.
    pub stroke: f64,
    /// Velocity and acceleration of the structure, absolute.
    pub rates: [f64; 2],
}

impl StillToCome {
    /// By how much a largest value may be passed over: twice what cubics leave out in a piece of
    /// [`Record::LONGEST`](crate::excitation::Record::LONGEST).
    const SAME: f64 = 1e-5;

    /// Whether a value of which so much can still come stays the largest.
    pub(crate) fn is_below(bound: f64, largest: f64) -> bool {
        bound <= largest * (1.0 + Self::SAME)
    }

    /// Whether nothing that was measured can become larger: of velocity and acceleration where they are.
    pub(crate) fn is_nothing(&self, found: &Response, rates: Option<[f64; 2]>) -> bool {
        let rates = rates.is_none_or(|largest| {
            self.rates
                .into_iter()
                .zip(largest)
                .all(|(bound, largest)| Self::is_below(bound, largest))
        });
        Self::is_below(self.displacement, found.peak)
            && Self::is_below(self.stroke, found.stroke)
            && rates
    }
}

/// Measures a motion between states that are so near that it is a cubic in between.
pub struct Meter {
    /// What was measured so far.
    pub found: Response,
    /// Mass of the absorber or damper over the structure's, and `eps lambda`.
    mass_ratio: f64,
    damping: f64,
    /// Fast time that has passed, and of it during the record and after its end.
    pub time: f64,
    driven: f64,
    after: f64,
    square: f64,
}

impl Meter {
    /// Of an absorber or damper with a mass over the structure's, and `eps lambda`.
    pub fn new(mass_ratio: f64, damping: f64) -> Self {
        let mut found = Response::default();
        found.trace.push([0.0, 0.0]);
        Self { found, mass_ratio, damping, time: 0.0, driven: 0.0, after: 0.0, square: 0.0 }
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
        found.peak = x.largest_beyond(found.peak);
        found.stroke = w.largest_beyond(found.stroke);
        if piece.is_rest() {
            return;
        }
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
        self.went_by(piece);
        self.found.trace.push([self.time, state.x]);
        if !piece.is_rest() {
            self.found.stored = state.energy(self.mass_ratio);
        }
    }

    /// The same of a piece in which no displacement was looked at.
    pub(crate) fn went_by(&mut self, piece: &Piece) {
        self.time += piece.duration;
        let of = if piece.is_rest() { &mut self.after } else { &mut self.driven };
        *of += piece.duration;
    }

    /// How much longer a motion may be followed that goes on in such pieces.
    pub(crate) fn left(&self, piece: &Piece) -> f64 {
        piece.rings - self.after
    }

    /// Whether that is no longer; then `displacement` is what it may still reach.
    pub(crate) fn gives_up(&mut self, piece: &Piece, displacement: f64) -> bool {
        let given_up = self.left(piece) <= 0.0;
        if given_up && !StillToCome::is_below(displacement, self.found.peak) {
            self.found.open = displacement - self.found.peak;
        }
        given_up
    }

    /// What was measured.
    pub fn finished(mut self) -> Response {
        let mean = self.square / self.driven;
        self.found.rms = if self.driven > 0.0 { mean.sqrt() } else { 0.0 };
        (self.found.duration, self.found.rang) = (self.time, self.after);
        self.found
    }
}
