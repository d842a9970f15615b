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

use std::f64::consts::TAU;

use super::unforced;
use crate::excitation::Piece;
use crate::linear::{Meter, Response, StillToCome};
use crate::simulation::{Detail, Impact, Observer, ShakingMeter, Simulation, StartError, Stop};
use crate::system::{InvalidParameter, Shaking, State, System};

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
    /// Whether the piece is so short that the motion is measured by cubics.
    short: bool,
    frame: BaseFrame,
    /// Where the motion was measured last: time in the piece, and what was seen from the base.
    last: (f64, State),
    told: &'a mut dyn FnMut(&Impact),
}

impl ResponseLog<'_> {
    fn seen(&mut self, s: f64, state: &State) -> State {
        let now = self.frame.leave(s, state);
        if self.short {
            self.meter.moved(&self.piece, [self.last.0, s], [&self.last.1, &now]);
        }
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
/// it is seen from the base, its time that since the start. Where the pieces end with one of rest the structure rings on
/// until nothing that is measured can become larger.
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
    let mut flight = DrivenFlight::of(system, start, shaking);
    for piece in pieces {
        let mut next = *piece;
        flight.meter.jump(&next, &mut flight.state);
        next.jump = 0.0;
        match next.is_rest() {
            true => flight.ring(next, told)?,
            false => flight.pass(&next, true, told)?,
        }
    }
    flight.finished()
}

/// A piece in which impacts alone are heard of.
const OSCILLATION: f64 = TAU;
/// What is small enough after a record's end: energy over the work of the excitation, of which impacts might still take a
/// share, and a speed of impacts over that of the largest displacement.
const LEFT: f64 = 1e-3;
/// Relative velocity of what does not slide over the structure's: some roundings.
const STANDS: f64 = 1e-12;

/// A structure with its absorber under way.
struct DrivenFlight<'a> {
    system: &'a System,
    meter: Meter,
    state: State,
    /// Largest distance of a piece's frame.
    farthest: f64,
    shakes: Option<ShakingMeter>,
    /// Mean square velocity and acceleration until nothing drove any more.
    mean_squares: Option<[f64; 2]>,
}

impl<'a> DrivenFlight<'a> {
    fn of(system: &'a System, start: State, shaking: bool) -> Self {
        Self {
            system,
            meter: Meter::new(system.mass_ratio(), system.mass_ratio() * system.damping()),
            state: start,
            farthest: 0.0,
            shakes: shaking.then(|| ShakingMeter::of(system).of_short()),
            mean_squares: None,
        }
    }

    /// Flies a piece at whose beginning nothing jumps; one that is not `short` for its impacts alone.
    fn pass(
        &mut self,
        piece: &Piece,
        short: bool,
        told: &mut dyn FnMut(&Impact),
    ) -> Result<(), DrivenError> {
        let free = unforced(self.system, piece.duration)?;
        let frame = BaseFrame::of(piece, self.system.mass_ratio() * self.system.damping());
        self.farthest = self.farthest.max(frame.shift.abs());
        let mut simulation = Simulation::new(&free, frame.enter(&self.state), 0.0)?;
        let last = (0.0, self.state);
        if let Some(meter) = &mut self.shakes {
            // The unforced system is seen from a frame that moves evenly.
            meter.set_frame(frame.slope + piece.base);
        }
        let log = ResponseLog { meter: &mut self.meter, piece: *piece, short, frame, last, told };
        let mut observers = (log, self.shakes.as_mut().filter(|_| short));
        let stop = simulation.run(1, MOST_IMPACTS, &mut observers);
        self.state = observers.0.last.1;
        if stop != Stop::EndTime {
            return Err(DrivenError::Stopped(stop));
        }
        match short {
            true => self.meter.passed(piece, &self.state),
            false => self.meter.went_by(piece),
        }
        Ok(())
    }

    /// Follows what nothing drives any more until nothing that is measured can become larger: first all of it, then
    /// impacts alone.
    fn ring(&mut self, piece: Piece, told: &mut dyn FnMut(&Impact)) -> Result<(), DrivenError> {
        self.mean_squares = self.shakes.map(|meter| meter.mean_squares());
        loop {
            let (energy, bounds) = self.still_to_come(piece.base);
            let rates = self.shakes.map(|meter| meter.peaks());
            let moves_less = bounds.is_nothing(&self.meter.found, rates);
            let is_over = moves_less && self.has_struck(energy);
            if is_over || self.meter.gives_up(&piece, bounds.displacement) {
                return Ok(());
            }
            let duration = if moves_less { OSCILLATION } else { piece.duration };
            let duration = duration.min(self.meter.left(&piece));
            self.pass(&Piece { duration, ..piece }, !moves_less, told)?;
        }
    }

    /// The energy that is left, and what it bounds. With gravity `a` along the cavity and the displacement `w` of the
    /// structure against the absorber it is `(x'^2 + (x - eps a)^2 + eps y'^2)/2 + eps (|a| + a w)`, of which each part
    /// is 0 or more; nothing adds to it.
    fn still_to_come(&self, base: f64) -> (f64, StillToCome) {
        let (eps, cavity) = (self.system.mass_ratio(), self.system.cavity());
        let (gravity, state) = (cavity.gravity_along, &self.state);
        let hangs = State { x: state.x - eps * gravity, ..*state };
        let lifted = match self.is_held(&hangs) {
            true => 0.0,
            false => gravity.abs() + gravity * state.relative_displacement(),
        };
        let energy = hangs.energy(eps) + eps * lifted.max(0.0);
        let most = (2.0 * energy).sqrt();
        let pushed = eps * (gravity.abs() + cavity.friction_acceleration);
        let damping = eps * self.system.damping();
        let bounds = StillToCome {
            displacement: most + eps * gravity.abs(),
            stroke: 0.0,
            rates: [base.abs() + most, libm::hypot(1.0, damping) * most + pushed],
        };
        (energy, bounds)
    }

    /// Whether friction holds the absorber in the cavity from now on: it does not slide, and the structure that carries it
    /// cannot accelerate as much.
    fn is_held(&self, hangs: &State) -> bool {
        let (eps, cavity) = (self.system.mass_ratio(), self.system.cavity());
        let slides = (hangs.x_velocity - hangs.y_velocity).abs();
        let swings = libm::hypot(hangs.x, hangs.x_velocity);
        let acceleration = libm::hypot(1.0, eps * self.system.damping()) * (1.0 + eps) * swings;
        slides <= STANDS * swings
            && cavity.friction_acceleration > cavity.gravity_along.abs() + acceleration
    }

    /// Whether impacts to come are none, no faster than those before, and take no share of the energy that counts. A relative
    /// velocity `u` has an energy of `u^2/(1 + 1/eps)/2` at least.
    fn has_struck(&self, energy: f64) -> bool {
        let (eps, found) = (self.system.mass_ratio(), &self.meter.found);
        let speed = (2.0 * energy * (1.0 + 1.0 / eps)).sqrt();
        let slow = StillToCome::is_below(speed, found.impact_speed.max(LEFT * found.peak));
        slow && energy <= LEFT * found.work.abs() || self.rests_within()
    }

    /// Whether the absorber rests where the structure never reaches it with a wall.
    fn rests_within(&self) -> bool {
        let State { x, x_velocity, y, y_velocity } = self.state;
        let reach = libm::hypot(x, x_velocity) + y.abs();
        y_velocity == 0.0 && !self.system.cavity().moves_absorber() && reach < 1.0
    }

    fn finished(self) -> Result<Response, DrivenError> {
        let means = self.mean_squares;
        let shaken = |meter: ShakingMeter| {
            Shaking::of(meter.peaks(), means.unwrap_or_else(|| meter.mean_squares()))
        };
        let found = Response { shaking: self.shakes.map(shaken), ..self.meter.finished() };
        match self.farthest * f64::EPSILON > HIDDEN * found.peak {
            true => Err(DrivenError::Damped),
            false => Ok(found),
        }
    }
}
