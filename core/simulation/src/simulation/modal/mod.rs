//! Direct simulation of a structure of several modes with several absorbers, from event to event.
//!
//! Between events everything is closed form ([`motion`]). Each absorber's first impact is proven by itself, in panels by the
//! same certificate as that of one mode and one absorber, and the least is the event ([`flight`]). Absorbers that rest on a
//! wall move with the structure, whose modes they couple: a series in short panels, with bounds that are proven ([`contact`]).
//!
//! Rules where the order matters: impacts at one instant, to rounding, take place in the order of the absorbers, one by one;
//! an impact finds those that rest on a wall free to leave it. A chattering sequence ends where its rest is below the
//! tolerances of [`ContactTolerance`](super::ContactTolerance), as for one absorber; where several stand on their walls, those
//! rest that the walls push, by the one solution of a complementarity problem.

mod contact;
mod flight;
mod meter;
mod motion;
mod peaks;
mod products;
mod trace;

use std::f64::consts::TAU;

use serde::Serialize;

use self::contact::{HeldPanel, Inverse};
use self::flight::{FlightEnd, Standing, resting, side};
use self::motion::{Constants, Gap, Phasors, View, sine_and_cosine};
use super::events::{Detail, Side};
use super::path::{Path, StraightLine};
use super::run::Stop;
use crate::system::{LinearResponse, MOST_MODES, ModalState, ModalSystem};

pub use meter::{ModalMeter, Reading, Sensor, SensorRecord};
pub use trace::ModalTrace;

const MOST: usize = MOST_MODES;
/// What is seen from a place at rest.
const STILL: StraightLine<f64> = StraightLine { y: 0.0, velocity: 0.0 };

/// A start that no motion can have.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ModalStartError {
    /// An absorber would start outside of its cavity.
    #[error(
        "absorber {absorber} would start {gap} clearances from the middle of its cavity, expected at most 1"
    )]
    OutsideCavity {
        /// Which, from 1.
        absorber: usize,
        /// `(X_j - y_j)/b_j`.
        gap: f64,
    },
    /// A number is infinite or not a number.
    #[error("the start of the motion is not finite")]
    NotFinite,
}

/// One impact of one absorber.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ModalImpact {
    /// Time since the start of the run, from phase 0 of its first period.
    pub tau: f64,
    /// Excitation phase, `0 .. 2 pi`.
    pub phase: f64,
    /// Which absorber, from 0.
    pub absorber: usize,
    /// Which wall.
    pub side: Side,
    /// `X_j`.
    pub x: f64,
    /// `X_j'` before and after.
    pub x_velocity: [f64; 2],
    /// `y_j'` before and after.
    pub y_velocity: [f64; 2],
    /// Energy lost.
    pub loss: f64,
}

/// A stretch of motion without events.
#[derive(Debug)]
pub struct ModalSegment<'a> {
    all: &'a All,
    course: Course<'a>,
    lines: [StraightLine<f64>; MOST],
    stuck: [f64; MOST],
    /// Whole periods since the start of the run.
    pub turns: u64,
    /// Excitation phase at the beginning.
    pub phase: f64,
    /// Its length.
    pub duration: f64,
}

#[derive(Debug)]
enum Course<'a> {
    Free { begin: &'a Phasors<MOST>, end: &'a Phasors<MOST> },
    Held(&'a HeldPanel),
}

impl ModalSegment<'_> {
    /// The state a time `s` after the beginning.
    pub fn at(&self, s: f64) -> ModalState {
        let mut state = match &self.course {
            Course::Free { begin, .. } => {
                let rotor = sine_and_cosine(self.phase + self.all.constants.frequency * s);
                self.all.state(&self.turned(begin, s), rotor)
            }
            Course::Held(panel) => panel.state(s),
        };
        for j in 0..self.all.absorbers {
            let (b, wall) = (self.all.clearances[j], self.stuck[j]);
            let line = self.lines[j].from(s);
            state.absorbers[j] = [line.y * b, line.velocity * b];
            if wall != 0.0 {
                let [x, v, _] = self.place(&self.all.constants.views[j], s);
                state.absorbers[j] = [(x - wall) * b, v * b];
            }
        }
        state
    }

    /// The wall that an absorber rests on, if it does.
    pub fn rests(&self, absorber: usize) -> Option<Side> {
        resting(self.stuck[absorber])
    }

    /// The relative displacement `X_j - y_j` of an absorber, a time `s` after the beginning.
    fn gap(&self, j: usize, s: f64) -> f64 {
        let over_clearance = match self.stuck[j] {
            0.0 => self.place(&self.all.constants.views[j], s)[0] - self.lines[j].from(s).y,
            wall => wall,
        };
        over_clearance * self.all.clearances[j]
    }

    /// The free phasors after any time.
    fn turned(&self, begin: &Phasors<MOST>, s: f64) -> [[f64; 2]; MOST] {
        let mut z = begin.z;
        for (z, mode) in z.iter_mut().zip(&self.all.constants.modes).take(self.all.modes) {
            let ([sin, cos], envelope) =
                (sine_and_cosine(mode.ringing * s), libm::exp(-mode.decay * s));
            *z = super::phasor::multiply(*z, [envelope * cos, envelope * sin]);
        }
        z
    }

    /// Displacement, velocity and acceleration of what is seen, a time `s` after the beginning.
    fn place(&self, view: &View<MOST>, s: f64) -> [f64; 3] {
        let rotor = sine_and_cosine(self.phase + self.all.constants.frequency * s);
        match &self.course {
            Course::Free { begin, .. } => {
                let at = Phasors { z: self.turned(begin, s), rotor };
                self.all.constants.seen(view, &self.all.constants.free(&at), rotor)
            }
            Course::Held(panel) => panel.sight(view).moment(s),
        }
    }
}

/// Receives what happens, in order. What it does not need costs nothing: see [`Detail`].
pub trait ModalObserver {
    /// What it needs; the same at any time.
    fn detail(&self) -> Detail {
        Detail::Flights
    }
    /// A stretch without events was completed.
    fn segment(&mut self, _segment: &ModalSegment<'_>) {}
    /// An impact took place.
    fn impact(&mut self, _impact: &ModalImpact) {}
    /// A chattering sequence of an absorber ended: it rests on its wall, and the rest of its relative energy is lost.
    fn sticks(&mut self, _absorber: usize, _loss: f64) {}
    /// An excitation period is over: so many are since the start of the run, and the phase is 0 again.
    fn period(&mut self, _turns: u64, _state: &ModalState) {}
}

/// An observer that ignores everything.
impl ModalObserver for () {
    fn detail(&self) -> Detail {
        Detail::Nothing
    }
}

/// Both are told.
impl<A: ModalObserver, B: ModalObserver> ModalObserver for (A, B) {
    fn detail(&self) -> Detail {
        self.0.detail().max(self.1.detail())
    }
    fn segment(&mut self, segment: &ModalSegment<'_>) {
        self.0.segment(segment);
        self.1.segment(segment);
    }
    fn impact(&mut self, impact: &ModalImpact) {
        self.0.impact(impact);
        self.1.impact(impact);
    }
    fn sticks(&mut self, absorber: usize, loss: f64) {
        self.0.sticks(absorber, loss);
        self.1.sticks(absorber, loss);
    }
    fn period(&mut self, turns: u64, state: &ModalState) {
        self.0.period(turns, state);
        self.1.period(turns, state);
    }
}

/// What a trajectory never changes.
#[derive(Debug, Clone)]
struct All {
    constants: Constants<MOST, MOST>,
    /// Of each mode: its steady motion, `sin` and `cos`; its mass; and the force on it, over no mass.
    steady: [[f64; 2]; MOST],
    masses: [f64; MOST],
    forces: [f64; MOST],
    base: f64,
    absorber_masses: [f64; MOST],
    clearances: [f64; MOST],
    modes: usize,
    absorbers: usize,
}

impl All {
    fn of(system: &ModalSystem) -> Self {
        let mut all = Self {
            constants: Constants::of(system),
            steady: [[0.0; 2]; MOST],
            masses: [1.0; MOST],
            forces: [0.0; MOST],
            base: system.base_amplitude(),
            absorber_masses: [0.0; MOST],
            clearances: [1.0; MOST],
            modes: system.modes().len(),
            absorbers: system.absorbers().len(),
        };
        for (k, mode) in system.modes().iter().enumerate() {
            let steady = system.steady_motion(k);
            all.steady[k] = [steady.sine, steady.cosine];
            (all.masses[k], all.forces[k]) = (mode.mass, mode.mass * system.modal_forcing(k));
        }
        for (j, absorber) in system.absorbers().iter().enumerate() {
            (all.absorber_masses[j], all.clearances[j]) = (absorber.mass, absorber.clearance);
        }
        all
    }

    /// How what has this shape sees the motion, or a derivative of it by the fast time, over a length.
    fn view(&self, shape: &[f64], order: usize, length: f64) -> View<MOST> {
        let (shape, frequency) = (&shape[..shape.len().min(self.modes)], self.constants.frequency);
        let base = LinearResponse { sine: self.base, cosine: 0.0 };
        let steady = shape.iter().zip(&self.steady).fold(base, |sum, (phi, [s, c])| {
            LinearResponse { sine: sum.sine + phi * s, cosine: sum.cosine + phi * c }
        });
        let steady = (0..order).fold(steady, |of, _| LinearResponse {
            sine: -frequency * of.cosine,
            cosine: frequency * of.sine,
        });
        self.constants.view(shape, self.base, steady, length)
    }

    /// The modes' motion.
    fn state(&self, z: &[[f64; 2]; MOST], [sin, cos]: [f64; 2]) -> ModalState {
        let mut state = ModalState::default();
        for (k, [re, im]) in z.iter().enumerate().take(self.modes) {
            let (mode, [s, c]) = (&self.constants.modes[k], self.steady[k]);
            state.modes[k] = [
                re + s * sin + c * cos,
                self.constants.frequency * (s * cos - c * sin)
                    - (mode.decay * re + mode.ringing * im),
            ];
        }
        state
    }

    /// The free phasors of it.
    fn phasors(&self, state: &ModalState, [sin, cos]: [f64; 2]) -> Phasors<MOST> {
        let mut z = [[0.0; 2]; MOST];
        for (k, z) in z.iter_mut().enumerate().take(self.modes) {
            let (mode, [s, c], [q, v]) = (&self.constants.modes[k], self.steady[k], state.modes[k]);
            let x = q - (s * sin + c * cos);
            let v = v - self.constants.frequency * (s * cos - c * sin);
            *z = [x, -((v + mode.decay * x) * mode.inverse_ringing)];
        }
        Phasors { z, rotor: [sin, cos] }
    }
}

/// How far a run goes on.
#[derive(Debug, Clone, Copy)]
struct Limits {
    turns: u64,
    impacts: u64,
}

impl Limits {
    fn reached(&self, turns: u64, impacts: u64) -> bool {
        self.turns <= turns || self.impacts <= impacts
    }
}

/// The observer, and what is needed to tell it.
struct Told<'a> {
    all: &'a All,
    detail: Detail,
    observer: &'a mut dyn ModalObserver,
}

impl Told<'_> {
    #[inline(never)]
    fn flown<const N: usize, const M: usize>(
        &mut self,
        begin: &Standing<N, M>,
        end: &Phasors<N>,
        duration: f64,
    ) {
        let at = Standing::<MOST, MOST>::START.with(begin);
        let end = end.of_most();
        self.observer.segment(&ModalSegment {
            all: self.all,
            course: Course::Free { begin: &at.phasors, end: &end },
            lines: at.lines,
            stuck: [0.0; MOST],
            turns: at.turns,
            phase: at.phase,
            duration,
        });
    }

    #[inline(never)]
    fn impact<const N: usize, const M: usize>(
        &mut self,
        before: &Standing<N, M>,
        after: &Standing<N, M>,
        j: usize,
        wall: f64,
    ) {
        let (constants, b) = (&self.all.constants, self.all.clearances[j]);
        let [before, after] = [before, after].map(|one| Standing::<MOST, MOST>::START.with(one));
        let [from, to] = [&before, &after].map(|at| constants.gap(j, &at.phasors, STILL));
        let velocities = [before.lines[j].velocity, after.lines[j].velocity];
        self.observer.impact(&ModalImpact {
            tau: (before.turns as f64 * TAU + before.phase) / constants.frequency,
            phase: before.phase,
            absorber: j,
            side: side(wall),
            x: from.gap * b,
            x_velocity: [from.slope * b, to.slope * b],
            y_velocity: velocities.map(|velocity| velocity * b),
            loss: constants.loss(j, from.slope - velocities[0]),
        });
    }

    #[inline(never)]
    fn period<const N: usize, const M: usize>(&mut self, at: &Standing<N, M>) {
        let at = Standing::START.with(at);
        self.observer.period(at.turns, &state_of(self.all, &at));
    }
}

fn state_of(all: &All, at: &Standing<MOST, MOST>) -> ModalState {
    let mut state = all.state(&at.phasors.z, at.phasors.rotor);
    for j in 0..all.absorbers {
        let StraightLine { y, velocity } = at.lines[j];
        state.absorbers[j] = [y * all.clearances[j], velocity * all.clearances[j]];
    }
    state
}

/// A trajectory of several modes and absorbers that can be continued.
///
/// Two absorbers fly to their walls and hand over momentum, one after the other:
///
/// ```
/// use vinesink_core::simulation::{ModalSimulation, Stop};
/// use vinesink_core::system::{ModalAbsorber, ModalParameters, ModalState, ModalSystem, Mode};
///
/// let mode = Mode { frequency: 1.0, damping_ratio: 0.01, mass: 1.0, shape: vec![1.0; 2], ..Mode::default() };
/// let absorbers = [2.0, 3.0].map(|clearance| ModalAbsorber { mass: 0.01, clearance, restitution: 0.5 });
/// let system = ModalSystem::new(ModalParameters {
///     modes: vec![mode],
///     absorbers: absorbers.to_vec(),
///     frequency_ratio: 0.1,
///     ..ModalParameters::default()
/// })?;
/// let mut start = ModalState::AT_REST;
/// start.absorbers = [[0.0, 0.1]; 8];
/// let mut simulation = ModalSimulation::new(&system, &start, 0.0)?;
/// assert_eq!(simulation.run(1, u64::MAX, &mut ()), Stop::EndTime);
/// assert_eq!(simulation.impacts(), 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct ModalSimulation {
    all: All,
    at: Standing<MOST, MOST>,
    /// The wall that an absorber rests on, +1 or -1.
    stuck: [f64; MOST],
    inverse: Inverse,
    slow: bool,
}

impl ModalSimulation {
    /// A trajectory from `start` at an excitation phase in radians.
    ///
    /// A start on a wall is accepted: moving outwards it collides at once, moving inwards it flies.
    ///
    /// # Errors
    /// [`ModalStartError`] where an absorber would be outside of its cavity, or a number is not finite.
    pub fn new(
        system: &ModalSystem,
        start: &ModalState,
        phase: f64,
    ) -> Result<Self, ModalStartError> {
        let all = All::of(system);
        let numbers = start.modes.iter().chain(&start.absorbers).flatten();
        if !(phase.is_finite() && numbers.into_iter().all(|number| number.is_finite())) {
            return Err(ModalStartError::NotFinite);
        }
        let phase = phase.rem_euclid(TAU);
        let mut at = Standing::START;
        at.phase = phase;
        at.phasors = all.phasors(start, sine_and_cosine(phase));
        let sizes = all.constants.sizes(&at.phasors);
        for j in 0..all.absorbers {
            let [y, velocity] = start.absorbers[j].map(|value| value / all.clearances[j]);
            let line = StraightLine { y, velocity };
            let Gap { gap, slope, .. } = all.constants.gap(j, &at.phasors, line);
            let touch = all.constants.touch(&all.constants.views[j], &sizes, line);
            if gap.abs() > 1.0 + touch {
                return Err(ModalStartError::OutsideCavity { absorber: j + 1, gap });
            }
            at.lines[j] = line;
            at.walls[j] = if gap.abs() >= 1.0 - touch { gap.signum() } else { 0.0 };
            // What rounding makes of a velocity that is the wall's.
            if at.walls[j] != 0.0 && slope.abs() <= touch * (1.0 + all.constants.fastest) {
                at.lines[j].velocity += slope;
                at.lines[j].velocity += all.constants.gap(j, &at.phasors, at.lines[j]).slope;
            }
        }
        let inverse = Inverse::of(&all, &[0.0; MOST]);
        let mut simulation = Self { all, at, stuck: [0.0; MOST], inverse, slow: false };
        simulation.settle(&mut ());
        Ok(simulation)
    }

    /// Finds every impact by the slow, finer search alone: what the fast one is measured against.
    #[must_use]
    pub fn step_by_step(mut self) -> Self {
        self.slow = true;
        self
    }

    /// Where the trajectory stands.
    pub fn state(&self) -> ModalState {
        state_of(&self.all, &self.at)
    }

    /// Phase of the excitation, 0 to 2 pi: 0 after a run to the end of a period.
    pub fn phase(&self) -> f64 {
        self.at.phase
    }

    /// Whole excitation periods since the start of the trajectory.
    pub fn periods(&self) -> u64 {
        self.at.turns
    }

    /// Impacts of all absorbers since the start of the trajectory.
    pub fn impacts(&self) -> u64 {
        self.at.impacts
    }

    /// Evaluations of the closed form, all modes at one time each, that flights have cost so far.
    pub fn evaluations(&self) -> u64 {
        self.at.evaluations
    }

    /// The wall that an absorber rests on, if it does.
    pub fn rests(&self, absorber: usize) -> Option<Side> {
        resting(self.stuck[absorber])
    }

    /// Kinetic and potential energy of modes and absorbers, in masses times squared lengths over time.
    pub fn energy(&self) -> f64 {
        let state = self.state();
        let modes = self.all.masses.iter().zip(&self.all.constants.modes).zip(&state.modes);
        let modes = modes.map(|((mass, mode), [q, v])| mass * (v * v + mode.stiffness * q * q));
        let absorbers = self.all.absorber_masses.iter().zip(&state.absorbers);
        0.5 * (modes.sum::<f64>() + absorbers.map(|(mass, [_, v])| mass * v * v).sum::<f64>())
    }

    /// Continues to the end of the `periods`-th excitation period from here, or until `impact_limit` further impacts have
    /// happened (`u64::MAX` for no limit); says which.
    pub fn run(
        &mut self,
        periods: u64,
        impact_limit: u64,
        observer: &mut dyn ModalObserver,
    ) -> Stop {
        let limits = Limits {
            turns: self.at.turns + periods,
            impacts: self.at.impacts.saturating_add(impact_limit),
        };
        loop {
            if self.at.turns >= limits.turns {
                return Stop::EndTime;
            }
            if self.at.impacts >= limits.impacts {
                return Stop::ImpactLimit;
            }
            let done = if self.stuck == [0.0; MOST] {
                self.fly(limits, observer)
            } else {
                self.tow(observer)
            };
            if let Err(stop) = done {
                return stop;
            }
        }
    }

    fn fly(&mut self, limits: Limits, observer: &mut dyn ModalObserver) -> Result<(), Stop> {
        // The least numbers that engines exist for.
        let size = |count: usize| if count > 4 { MOST } else { count };
        macro_rules! engines {
            ($($n:literal: $($m:literal)*;)*) => {
                match (size(self.all.modes), size(self.all.absorbers)) {
                    $($(($n, $m) => self.fly_by::<$n, $m>(limits, observer),)*)*
                    _ => self.fly_by::<MOST, MOST>(limits, observer),
                }
            };
        }
        engines! { 1: 1 2 3 4 8; 2: 1 2 3 4 8; 3: 1 2 3 4 8; 4: 1 2 3 4 8; 8: 1 2 3 4; }
    }

    fn fly_by<const N: usize, const M: usize>(
        &mut self,
        limits: Limits,
        observer: &mut dyn ModalObserver,
    ) -> Result<(), Stop> {
        let constants: Constants<N, M> = self.all.constants.first();
        let mut at = Standing::<N, M>::START.with(&self.at);
        let mut told = Told { all: &self.all, detail: observer.detail(), observer: &mut *observer };
        let end = constants.fly(&mut at, limits, self.slow, &mut told);
        self.at = self.at.with(&at);
        if end? == FlightEnd::MayStick {
            self.settle(observer);
        }
        Ok(())
    }
}
