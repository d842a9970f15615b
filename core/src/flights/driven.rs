//! A structure with its absorber that is driven piece by piece, with exact flights by the event engine.
//!
//! In a piece the excitation is linear. Seen from a frame that moves at the velocity that the base has at the
//! beginning of the piece, the structure obeys `x'' + eps lambda x' + x = g`, with `g = f` where a force acts, and
//! `g = d + eps lambda d'` where the base has moved by `d` and `d'' = -f`; an absorber in flight obeys `y'' = 0`.
//! For `g = c0 + c1 s` the particular solution `c1 s + c0 - eps lambda c1` is linear. Without it, subtracted from `x`
//! and `y`, the system is the unforced one: `x - y`, differences of velocities, and so impacts, are the same, and so
//! is sustained contact, whose mass `1 + eps` has no part in a solution without acceleration. For a base that shakes
//! `g` is a cubic, of which the nearest straight line (least squares over the piece) is taken: the rest is orthogonal
//! to straight lines, so that the motion at the end of a piece of length `h` is off by `h^5`.

use super::unforced;
use crate::excitation::Piece;
use crate::linear::{Meter, Response};
use crate::simulation::{Detail, Impact, Observer, ShakingMeter, Simulation, StartError, Stop};
use crate::system::{InvalidParameter, State, System};

/// Share of the largest displacement from which on rounding of a piece's frame is not passed over.
const HIDDEN: f64 = 1e-6;
/// Impacts in a piece after which a run is given up: chattering ends in contact long before.
const MOST_IMPACTS: u64 = 100_000;

/// Why a driven structure could not be followed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DrivenError {
    /// The motion is so large that rounding hides the walls, or is not finite.
    #[error(transparent)]
    Start(#[from] StartError),
    /// A flight ended before its time.
    #[error("the simulation of the record met {}", .0.words())]
    Stopped(Stop),
    /// A case names a file, and nobody has handed in what it holds.
    #[error("the samples of the record are missing: hand them in by `Case::with_record`")]
    NoRecord,
    /// The damping is so large against the motion that rounding of what it holds off hides it.
    #[error(
        "the structure is damped so much that rounding hides its motion under the record; lower its damping"
    )]
    Damped,
    /// A piece is too short or too long for a number.
    #[error(transparent)]
    Piece(#[from] InvalidParameter),
}

/// From what is seen from the base to what the unforced system does in a piece.
struct BaseFrame {
    shift: f64,
    slope: f64,
    /// Acceleration of the base at the beginning of the piece, and its slope.
    base: [f64; 2],
}

impl BaseFrame {
    fn of(piece: &Piece, damping: f64) -> Self {
        let (h, [force, slope]) = (piece.duration, piece.force);
        if !piece.shakes {
            return Self { shift: force - damping * slope, slope, base: [0.0; 2] };
        }
        let [a, b] = [-force, -slope];
        // g = damping a s + (a + damping b)/2 s^2 + b/6 s^3; the nearest lines to s^2 and s^3 are h s - h^2/6 and
        // 9/10 h^2 s - h^3/5.
        let bend = 0.5 * (a + damping * b);
        let rise = damping * a + bend * h + 0.15 * b * h * h;
        let level = -bend * h * h / 6.0 - b * h * h * h / 30.0;
        Self { shift: level - damping * rise, slope: rise, base: [a, b] }
    }

    fn enter(&self, state: &State) -> State {
        let x = state.x - self.shift;
        State {
            x,
            x_velocity: state.x_velocity - self.slope,
            // The absorber on a wall stays on it to the last digit.
            y: x - state.relative_displacement(),
            y_velocity: state.y_velocity - self.slope,
        }
    }

    fn leave(&self, s: f64, state: &State) -> State {
        let [a, b] = self.base;
        let x = state.x + self.shift + s * (self.slope - s * (0.5 * a + s * b / 6.0));
        let velocity = self.slope - s * (a + 0.5 * s * b);
        State {
            x,
            x_velocity: state.x_velocity + velocity,
            y: x - state.relative_displacement(),
            y_velocity: state.y_velocity + velocity,
        }
    }
}

/// Hears of the unforced system, and measures what is seen from the base.
struct ResponseLog<'a> {
    meter: &'a mut Meter,
    piece: Piece,
    frame: BaseFrame,
    /// Where the motion was measured last: time in the piece, and what was seen from the base.
    last: (f64, State),
    told: &'a mut dyn FnMut(&Impact),
}

impl ResponseLog<'_> {
    fn seen(&mut self, s: f64, state: &State) -> State {
        let now = self.frame.leave(s, state);
        self.meter.moved(&self.piece, [self.last.0, s], [&self.last.1, &now]);
        now
    }
}

impl Observer for ResponseLog<'_> {
    fn detail(&self) -> Detail {
        Detail::Events
    }

    fn impact(&mut self, impact: &Impact) {
        let before = impact.state_before();
        let mut after = self.seen(impact.tau, &before);
        let [x_gained, y_gained] =
            [after.x_velocity - before.x_velocity, after.y_velocity - before.y_velocity];
        (self.told)(&Impact {
            tau: self.meter.time + impact.tau,
            x: after.x,
            x_velocity_before: impact.x_velocity_before + x_gained,
            x_velocity_after: impact.x_velocity_after + x_gained,
            y_velocity_before: impact.y_velocity_before + y_gained,
            y_velocity_after: impact.y_velocity_after + y_gained,
            ..*impact
        });
        after.x_velocity += impact.x_velocity_after - impact.x_velocity_before;
        after.y_velocity += impact.y_velocity_after - impact.y_velocity_before;
        self.last = (impact.tau, after);
        let found = &mut self.meter.found;
        found.impacts += 1;
        found.impact_loss += impact.loss;
        let speed = (impact.x_velocity_before - impact.y_velocity_before).abs();
        found.impact_speed = found.impact_speed.max(speed);
    }

    fn sticks(&mut self, loss: f64) {
        self.meter.found.impact_loss += loss;
    }

    fn period(&mut self, state: &State) {
        let now = self.seen(self.piece.duration, state);
        self.last = (self.piece.duration, now);
    }
}

/// Follows a structure at rest whose absorber is at a relative displacement `w`, over the clearance.
///
/// # Errors
/// [`DrivenError`] where the engine cannot resolve the motion.
pub fn follow(system: &System, pieces: &[Piece], w: f64) -> Result<Response, DrivenError> {
    follow_from(system, pieces, State { y: -w, ..State::AT_REST }, false, &mut |_| {})
}

/// The same from a state; velocity and acceleration are measured where they are asked for, and `told` hears of every impact as
/// it is seen from the base, its time that since the start.
///
/// # Errors
/// As [`follow`].
pub fn follow_from(
    system: &System,
    pieces: &[Piece],
    start: State,
    shaking: bool,
    told: &mut dyn FnMut(&Impact),
) -> Result<Response, DrivenError> {
    let damping = system.mass_ratio() * system.damping();
    let mut meter = Meter::new(system.mass_ratio(), damping);
    let (mut state, mut farthest) = (start, 0.0_f64);
    let mut shakes = shaking.then(|| ShakingMeter::of(system).of_short());
    for piece in pieces {
        meter.jump(piece, &mut state);
        let free = unforced(system, piece.duration)?;
        let frame = BaseFrame::of(piece, damping);
        farthest = farthest.max(frame.shift.abs());
        let mut simulation = Simulation::new(&free, frame.enter(&state), 0.0)?;
        let last = (0.0, state);
        if let Some(meter) = &mut shakes {
            // The unforced system is seen from a frame that moves evenly.
            meter.set_frame(frame.slope + piece.base);
        }
        let log = ResponseLog { meter: &mut meter, piece: *piece, frame, last, told: &mut *told };
        let mut observers = (log, &mut shakes);
        let stop = simulation.run(1, MOST_IMPACTS, &mut observers);
        state = observers.0.last.1;
        if stop != Stop::EndTime {
            return Err(DrivenError::Stopped(stop));
        }
        meter.passed(piece, &state);
    }
    let found = Response { shaking: shakes.map(|one| one.found()), ..meter.finished() };
    match farthest * f64::EPSILON > HIDDEN * found.peak {
        true => Err(DrivenError::Damped),
        false => Ok(found),
    }
}
