//! What a real cavity does to an absorber that slides along it: gravity, friction, and where friction holds it.
//!
//! With `s` the sign of `w' = x' - y'` the absorber has `y'' = a + s f` and the oscillator takes `-eps s f`, a constant
//! force: flights stay closed form between walls and moments at which `w' = 0`. There the absorber would have to have
//! `y'' - a = (x'' - a)/(1 + eps)` to go along with the oscillator, `x''` being that of the oscillator alone. Friction
//! gives that much up to `f`, and holds it; else it slides on, the way it is left behind. A wall helps friction one way.

use super::certificate::Hull;
use super::events::{Observer, Reversal, Side};
use super::flow::{Kinematics, Oscillator};
use super::path::{Parabola, Path, StraightLine};
use super::phasor::{FlightState, ON_WALL, Rates};
use super::run::{Mode, Moment, Simulation};
use super::walls::TOUCH_ULPS;
use crate::system::{State, System};

/// Parts of the times after which a parabola turns or meets a wall that a panel is to end after.
const PAST_TURN: f64 = 1.5;
const PAST_WALL: f64 = 1.25;
/// Part of a panel below which none is cut to measure.
const SHORTEST_REACH: f64 = 1e-7;
/// Opening of the gap in a flight from wall to wall that friction may turn, below which the step-by-step search takes over:
/// rounding moves the walls by less than a thousandth of it where the motion is not hundreds of clearances large.
const SMALL_EXCURSION: f64 = 1e-9;

/// Gravity and friction as a flight needs them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sliding {
    /// `a`.
    pub gravity: f64,
    /// `f`.
    pub friction: f64,
    /// Whether there is neither, so that flights are straight lines.
    pub straight: bool,
    mass_ratio: f64,
}

impl Sliding {
    pub(super) fn of(system: &System) -> Self {
        let cavity = system.cavity();
        Self {
            gravity: cavity.gravity_along,
            friction: cavity.friction_acceleration,
            straight: !cavity.moves_absorber(),
            mass_ratio: system.mass_ratio(),
        }
    }

    /// The sign of `w'` in a first flight from a state at phase 0; where friction holds the absorber there is none.
    pub(super) fn first_sense(system: &System, start: &State) -> f64 {
        let slope = start.x_velocity - start.y_velocity;
        if slope == 0.0 {
            return Self::of(system).pull(&Oscillator::alone(system), 0.0, start).signum();
        }
        slope.signum()
    }

    /// `x'' - a` of the oscillator alone, without friction, in a state.
    pub(super) fn pull(&self, alone: &Oscillator, phase: f64, state: &State) -> f64 {
        alone.acceleration(phase, Kinematics { x: state.x, v: state.x_velocity }) - self.gravity
    }

    /// The absorber's acceleration where `w'` has a sign.
    pub(super) fn acceleration(&self, sense: f64) -> f64 {
        self.gravity + sense * self.friction
    }

    /// Where the oscillator alone would rest under this friction.
    pub(super) fn rest(&self, sense: f64) -> f64 {
        -(sense * self.mass_ratio * self.friction)
    }

    /// Where it would rest with the absorber in tow.
    pub(super) fn rest_in_tow(&self) -> f64 {
        self.mass_ratio * self.gravity
    }

    /// Acceleration of the oscillator alone, less `a`, up to which friction holds the absorber.
    pub(super) fn grip(&self) -> f64 {
        (1.0 + self.mass_ratio) * self.friction
    }

    /// The absorber's flight, seen from where the oscillator would rest.
    fn path(&self, sense: f64, y: f64, velocity: f64) -> Parabola {
        let line = StraightLine { y: y - self.rest(sense), velocity };
        Parabola { line, acceleration: self.acceleration(sense) }
    }
}

/// How the cavity shapes flights through panels.
pub(super) trait CavityFlight: Copy {
    type Path: Path<f64>;
    /// The oscillator's displacement and the absorber's flight, seen from where the oscillator would rest.
    fn depart(&self, at: &Moment) -> (f64, Self::Path);
    /// Both displacements, as seen from there.
    fn arrive(&self, sense: f64, seen: f64) -> f64;
    /// Whether `w'` is proven to keep its sign in a panel, if that matters.
    fn one_way(&self, sense: f64, hull: &Hull<f64>, ends: [&FlightState<f64>; 2]) -> bool;
    /// Length of the first part of a panel of length `step` to look into, if not all of it.
    fn reach(&self, sense: f64, here: &FlightState<f64>, step: f64) -> Option<f64>;
    /// Whether a flight from a wall is one for the step-by-step search.
    fn short(&self, rates: &Rates<f64>, here: &FlightState<f64>) -> bool;
    /// Whether short flights back to a wall are known to end there.
    fn returns(&self) -> bool;
    /// Whether it matters, and `w'` is proven to change its sign once.
    fn turns(&self, sense: f64, hull: &Hull<f64>, ends: [&FlightState<f64>; 2]) -> bool;
}

/// A straight flight.
#[derive(Debug, Clone, Copy)]
pub(super) struct Straight;

impl CavityFlight for Straight {
    type Path = StraightLine<f64>;
    #[inline(always)]
    fn depart(&self, at: &Moment) -> (f64, StraightLine<f64>) {
        (at.state.x, StraightLine { y: at.state.y, velocity: at.state.y_velocity })
    }
    #[inline(always)]
    fn arrive(&self, _: f64, seen: f64) -> f64 {
        seen
    }
    #[inline(always)]
    fn one_way(&self, _: f64, _: &Hull<f64>, _: [&FlightState<f64>; 2]) -> bool {
        true
    }
    #[inline(always)]
    fn reach(&self, _: f64, _: &FlightState<f64>, _: f64) -> Option<f64> {
        None
    }
    #[inline(always)]
    fn short(&self, rates: &Rates<f64>, here: &FlightState<f64>) -> bool {
        rates.short(here)
    }
    #[inline(always)]
    fn returns(&self) -> bool {
        true
    }
    #[inline(always)]
    fn turns(&self, _: f64, _: &Hull<f64>, _: [&FlightState<f64>; 2]) -> bool {
        false
    }
}

impl CavityFlight for Sliding {
    type Path = Parabola;
    #[inline(always)]
    fn depart(&self, at: &Moment) -> (f64, Parabola) {
        let State { x, y, y_velocity, .. } = at.state;
        (x - self.rest(at.sense), self.path(at.sense, y, y_velocity))
    }
    #[inline(always)]
    fn arrive(&self, sense: f64, seen: f64) -> f64 {
        seen + self.rest(sense)
    }
    #[inline(always)]
    fn one_way(&self, sense: f64, hull: &Hull<f64>, [here, there]: [&FlightState<f64>; 2]) -> bool {
        self.friction == 0.0 || hull.rises(sense, here.slope, there.slope)
    }
    #[inline(always)]
    fn reach(&self, sense: f64, here: &FlightState<f64>, step: f64) -> Option<f64> {
        let (speed, bend, room) = (here.slope * sense, here.a * sense, 1.0 - here.gap * sense);
        let squared = speed * speed + 2.0 * bend * room;
        let reach = match squared < 0.0 {
            true => PAST_TURN * speed / -bend,
            false => PAST_WALL * 2.0 * room / (speed + squared.sqrt()),
        };
        let short = self.friction > 0.0 && 0.0 < reach && reach <= 0.5 * step;
        short.then_some(reach.max(SHORTEST_REACH * step))
    }
    #[inline(always)]
    fn short(&self, rates: &Rates<f64>, here: &FlightState<f64>) -> bool {
        let closing = here.a * here.gap.signum();
        let slow = here.slope * here.slope < 2.0 * SMALL_EXCURSION * closing;
        if self.friction == 0.0 { rates.short(here) } else { slow && ON_WALL <= here.gap.abs() }
    }
    #[inline(always)]
    fn returns(&self) -> bool {
        self.friction == 0.0
    }
    #[inline(always)]
    fn turns(&self, sense: f64, hull: &Hull<f64>, [here, there]: [&FlightState<f64>; 2]) -> bool {
        self.friction > 0.0 && hull.turns(sense, here.slope, there.slope)
    }
}

impl Simulation {
    fn pull(&self) -> f64 {
        self.sliding.pull(&self.alone, self.stand.at.phase, &self.stand.at.state)
    }

    /// What rounding may make of forces where the trajectory stands.
    pub(super) fn force_rounding(&self, state: &State) -> f64 {
        let (State { x, x_velocity, .. }, sliding) = (state, &self.sliding);
        let scale = self.alone.largest_force + x.abs() + x_velocity.abs();
        TOUCH_ULPS * f64::EPSILON * (scale + sliding.gravity.abs() + sliding.friction)
    }

    /// Which way the absorber slides from here, or that friction holds it.
    pub(super) fn settle(&mut self) {
        let Sliding { friction, .. } = self.sliding;
        let State { x, x_velocity, y, y_velocity } = self.stand.at.state;
        let slope = x_velocity - y_velocity;
        self.stand.at.sense = if friction == 0.0 {
            0.0
        } else if slope != 0.0 {
            slope.signum()
        } else {
            let pull = self.pull();
            if self.holds(&self.stand.at.state, pull) {
                self.mode = Mode::Held { gap: x - y };
                0.0
            } else {
                pull.signum()
            }
        };
    }

    /// Whether friction holds an absorber at relative rest.
    fn holds(&self, state: &State, pull: f64) -> bool {
        pull.abs() <= self.sliding.grip() + self.force_rounding(state)
    }

    /// Whether the absorber slides on at once from where sliding has ended, the oscillator's acceleration before that
    /// being known.
    #[inline(never)]
    pub(super) fn slides_on(
        &self,
        at: &mut Moment,
        acceleration: f64,
        observer: &mut dyn Observer,
    ) -> bool {
        // Without friction the oscillator would rest at 0.
        let pull = acceleration - self.sliding.rest(at.sense) - self.sliding.gravity;
        if self.holds(&at.state, pull) {
            return false;
        }
        let before = at.sense;
        at.state.y_velocity = at.state.x_velocity;
        at.sense = pull.signum();
        observer.reversal(&self.reversal(at, before));
        true
    }

    fn reversal(&self, at: &Moment, before: f64) -> Reversal {
        let Moment { state, phase, turns, sense, .. } = *at;
        Reversal { tau: self.tau(turns, phase), phase, state, before, after: sense }
    }

    /// The absorber has come to rest relative to the oscillator.
    pub(super) fn reverse(&mut self, observer: &mut dyn Observer) {
        let before = self.stand.at.sense;
        self.stand.at.state.y_velocity = self.stand.at.state.x_velocity;
        self.settle();
        observer.reversal(&self.reversal(&self.stand.at, before));
    }

    /// What acts on the absorber at a wall that it leaves, and when it comes back: accelerations towards the wall.
    pub(super) fn closing(&self, side: Side) -> [f64; 2] {
        let (pull, grip) = (side.sign() * self.pull(), self.sliding.grip());
        [pull + grip, pull - grip]
    }
}
