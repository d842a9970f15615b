//! Of several modes with several absorbers, what a search must know.

use std::f64::consts::PI;
use std::sync::Arc;

use super::at_rest::modal_at_rest;
use super::motion::ModalMotion;
use super::proven::{Near, attracting, near, seen};
use super::watch::{MOST_IMPACTS, ModalSample, ModalWatch, SAME_STATE};
use crate::motions::model::{
    Averages, FLIGHTS, KnownMotion, LongTerm, Model, PUSH, Proof, RECOGNITION,
};
use crate::motions::rest::PERIODS;
use crate::motions::{Reached, Value};
use crate::simulation::batch::Extent;
use crate::simulation::{ModalSimulation, ModalStartError, Reading, Sensor, Stop};
use crate::system::{MOST_MODES, ModalAbsorber, ModalState, ModalSystem};

/// Times in which the slowest mode decays to `1/e` that a start is left alone, and fewest and most excitation periods of such a time.
const DECAYS: u32 = 8;
const QUICKEST: f64 = 32.0;
const LONGEST: f64 = 8192.0;
/// Such times of the shortest window, and the fewest excitation periods of the windows of a place together.
const DECAYS_OF_WINDOW: f64 = 2.0;
const SHORTEST: u64 = 1024;
/// Most impacts of a start until its slowest mode has died out, and fewest in a period of each absorber: one that chatters on is given up.
const MOST_OF_START: u64 = 400_000;
const FEWEST_IMPACTS: u64 = 16;
/// Impacts of starts that wander, times modes and absorbers, after which a place is given up: some seconds. What still wanders may then
/// be a transient.
const MOST_WANDERED: f64 = 8e6;
/// Periods above which what has no impact is at rest: fewer may lie between two impacts.
const SILENT: u64 = 40;

/// Excitation periods in which the slowest mode decays to `1/e`.
fn decay_periods(system: &ModalSystem) -> f64 {
    let decays = system.modes().iter().map(|mode| mode.damping_ratio * mode.frequency);
    let slowest = decays.fold(f64::INFINITY, f64::min);
    system.frequency_ratio() / (std::f64::consts::TAU * slowest)
}

/// Excitation periods of a time in which the slowest mode decays.
fn decay(system: &ModalSystem) -> u64 {
    decay_periods(system).clamp(QUICKEST, LONGEST).ceil() as u64
}

/// Excitation periods after which nothing is left of a start from rest; as with one mode no more than so many are looked at.
pub(super) fn transient(system: &ModalSystem) -> u64 {
    (u64::from(DECAYS) * decay(system)).min(PERIODS[1] as u64)
}

/// Excitation periods over which a motion that does not repeat is measured at first, in a case with a window of so many.
pub(super) fn window(system: &ModalSystem, periods: u64) -> u64 {
    periods.max(SHORTEST).max(shortest_window(system))
}

fn shortest_window(system: &ModalSystem) -> u64 {
    let of_decay = (DECAYS_OF_WINDOW * decay_periods(system).min(LONGEST)).ceil() as u64;
    of_decay.max(RECOGNITION)
}

/// Excitation periods that a start is flown for about, where at least so many are measured, then twice as many, and no other of its
/// place settles.
pub fn longest_flight(system: &ModalSystem, periods: u64) -> f64 {
    f64::from(DECAYS) * decay(system) as f64 + 3.0 * window(system, periods) as f64
}

/// Most impacts in a period of a start, of all absorbers.
pub(super) fn most_impacts(system: &ModalSystem) -> u64 {
    let of_start = MOST_OF_START / (u64::from(DECAYS) * decay(system));
    of_start.clamp(FEWEST_IMPACTS * system.absorbers().len() as u64, MOST_IMPACTS)
}

/// A structure, and what is read of its motion.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::motions) struct Sensed(Arc<(ModalSystem, Vec<Sensor>)>);

impl Sensed {
    pub fn new(system: ModalSystem, sensors: Vec<Sensor>) -> Self {
        Self(Arc::new((system, sensors)))
    }

    pub fn system(&self) -> &ModalSystem {
        &self.0.0
    }

    pub fn sensors(&self) -> &[Sensor] {
        &self.0.1
    }

    fn reads(&self) -> Vec<Reading> {
        self.sensors().iter().map(|one| one.reads).collect()
    }
}

/// A trajectory of it.
pub(in crate::motions) struct SensedFlight {
    of: Sensed,
    simulation: ModalSimulation,
}

impl Model for Sensed {
    type State = ModalState;
    type Motion = ModalMotion;
    type Kind = Box<ModalMotion>;
    type Flight = SensedFlight;
    type Watch = ModalWatch;
    type Sample = ModalSample;
    type StartError = ModalStartError;

    /// So many fly about as many windows together as where another motion attracts, and the engine of several modes is fifty times
    /// slower than that of one.
    const MOST_STARTS: usize = 6;

    fn settling(&self, _: &[KnownMotion<Self>]) -> u64 {
        u64::from(DECAYS) * decay(self.system())
    }

    fn window(&self, periods: u64) -> u64 {
        periods
    }

    fn shortest_window(&self) -> u64 {
        shortest_window(self.system())
    }

    fn most_impacts(&self, patience: f64) -> f64 {
        patience * MOST_WANDERED
            / (self.system().modes().len() * self.system().absorbers().len()) as f64
    }

    fn creeps(&self) -> bool {
        false
    }

    fn comes_to_rest(&self) -> bool {
        let system = self.system();
        let forced = |k: usize| system.modal_forcing(k) != 0.0;
        let still = system.base_amplitude() == 0.0 && !(0..system.modes().len()).any(forced);
        still && system.modes().iter().all(|mode| mode.damping_ratio > 0.0)
    }

    fn begin(&self, state: &ModalState, phase: f64) -> Result<SensedFlight, ModalStartError> {
        let simulation = ModalSimulation::new(self.system(), state, phase)?;
        Ok(SensedFlight { of: self.clone(), simulation })
    }

    /// Absorbers are pushed inwards, as one may be at a wall.
    fn pushed(&self, state: &ModalState) -> Option<SensedFlight> {
        let push = PUSH * state.size();
        let mut beside = *state;
        beside.modes[0][1] += push;
        for (j, one) in self.system().absorbers().iter().enumerate() {
            let [place, _] = self.system().displaced(j, state);
            let inwards = if place > state.absorbers[j][0] { 1.0 } else { -1.0 };
            beside.absorbers[j][0] += inwards * push.min(0.1 * one.clearance);
        }
        self.begin(&beside, 0.0).ok()
    }

    fn of(flight: &SensedFlight) -> &Self {
        &flight.of
    }

    fn state(flight: &SensedFlight) -> ModalState {
        flight.simulation.state()
    }

    fn periods(flight: &SensedFlight) -> u64 {
        flight.simulation.periods()
    }

    fn impacts(flight: &SensedFlight) -> u64 {
        flight.simulation.impacts()
    }

    fn extent(_: &SensedFlight, periods: u64, most_impacts: u64) -> Extent {
        Extent { periods, impacts: periods.saturating_mul(most_impacts) }
    }

    fn run(
        flights: &mut [&mut SensedFlight],
        far: &[Extent],
        watches: Option<&mut [ModalWatch]>,
    ) -> Vec<Stop> {
        let each = flights.iter_mut().zip(far);
        match watches {
            None => each
                .map(|(one, far)| one.simulation.run(far.periods, far.impacts, &mut ()))
                .collect(),
            Some(watches) => each
                .zip(watches)
                .map(|((one, far), watch)| one.simulation.run(far.periods, far.impacts, watch))
                .collect(),
        }
    }

    fn periods_of_flights(flight: &SensedFlight) -> u64 {
        let system = flight.of.system();
        let state = flight.simulation.state();
        let absorbers = system.absorbers().iter().zip(&state.absorbers);
        let crossing = absorbers.map(|(one, [_, velocity])| 2.0 * one.clearance / velocity.abs());
        let slowest = crossing.filter(|time| time.is_finite()).fold(0.0, f64::max);
        (FLIGHTS * slowest / system.period()) as u64
    }

    /// The energy of a free vibration of a mode never grows.
    fn at_rest(flight: &SensedFlight) -> Option<ModalState> {
        let (system, state) = (flight.of.system(), flight.simulation.state());
        let mut steady = state;
        let mut free = [0.0; MOST_MODES];
        for (k, mode) in system.modes().iter().enumerate() {
            let of = system.steady_motion(k);
            steady.modes[k] = [of.cosine, system.frequency_ratio() * of.sine];
            let off = [0, 1].map(|n| state.modes[k][n] - steady.modes[k][n]);
            // Of a mode that hardly rings the largest displacement is that, over its sine.
            let ringing = (1.0 - mode.damping_ratio * mode.damping_ratio).sqrt();
            free[k] = libm::hypot(off[0], off[1] / mode.frequency) / ringing;
        }
        let damped = system.modes().iter().all(|mode| mode.damping_ratio > 0.0);
        let stays = |(j, one): (usize, &ModalAbsorber)| {
            let [y, velocity] = state.absorbers[j];
            let modes = system.modes().iter().zip(&free);
            let free: f64 = modes.map(|(mode, free)| mode.shape[j].abs() * free).sum();
            let apart = y.abs() + system.steady_motion_at(j).amplitude() + free;
            velocity == 0.0 && apart < one.clearance
        };
        (damped && system.absorbers().iter().enumerate().all(stays)).then_some(steady)
    }

    fn watch(flight: &SensedFlight, window: u64) -> ModalWatch {
        ModalWatch::new(flight.of.system(), flight.of.sensors(), &flight.simulation, window)
    }

    fn watch_of_repetition(flight: &SensedFlight, periods: u64) -> ModalWatch {
        ModalWatch::of_repetition(flight.of.system(), &flight.simulation, periods)
    }

    fn repeats(watch: &mut ModalWatch) -> Option<bool> {
        watch.repeats().settled()
    }

    fn is_silent(watch: &mut ModalWatch) -> bool {
        ModalWatch::is_silent(watch)
    }

    fn sample(watch: &mut ModalWatch, flight: &SensedFlight, stop: Stop) -> Option<ModalSample> {
        watch.sample(&flight.simulation, stop)
    }

    fn end(sample: &ModalSample) -> &ModalState {
        &sample.end
    }

    fn solved(&self) -> Vec<KnownMotion<Self>> {
        let rest = modal_at_rest(self.system(), self.sensors());
        let all = attracting(self).into_iter().chain(rest);
        all.map(|motion| KnownMotion::new(self, motion)).collect()
    }

    fn rests(&self, sample: &ModalSample) -> bool {
        let over = sample.repeats.exactly.is_some() || sample.course.periods > SILENT;
        over && sample.measured > 0 && sample.course.is_silent()
    }

    fn resting(&self, seen: Option<&ModalSample>) -> Option<ModalMotion> {
        let sample = seen?;
        let course = vec![sample.course.clone()];
        let periods = sample.course.periods;
        let motion = ModalMotion::of(&self.reads(), course, sample.repeats.exactly, true, periods);
        Some(ModalMotion { state: Some(sample.end), ..motion })
    }

    fn proof(&self, sample: &ModalSample) -> Proof<Self> {
        // What has no impact is at rest where that was measured.
        if sample.measured == 0 && sample.course.is_silent() {
            return Proof::Open;
        }
        let (repeats, seen_as) = (&sample.repeats, || Box::new(sample.clone()));
        let mut periods = repeats.nearly.iter().chain(&repeats.roughly);
        match periods.find_map(|after| near(self, &sample.end, *after)) {
            Some(Near::On(motion)) => Proof::Is(motion, seen_as()),
            Some(Near::Beside(motion)) => Proof::Nears(motion, seen_as()),
            Some(Near::Leaves) => Proof::Leaves,
            None => {
                let motion = repeats.exactly.and_then(|after| seen(self, &sample.end, after));
                // What still changes in a period adds up until the slowest mode has died out.
                let left = SAME_STATE * decay(self.system()) as f64;
                let is = |motion: ModalMotion| Proof::Is(Box::new(motion.within(left)), seen_as());
                motion.map_or(Proof::Open, is)
            }
        }
    }

    fn proven(&self, kind: Box<ModalMotion>, _: &ModalSample) -> Option<ModalMotion> {
        Some(*kind)
    }

    fn is_kind(motion: &ModalMotion, kind: &Box<ModalMotion>) -> bool {
        motion.is_same(kind)
    }

    fn wandering(&self, samples: &[ModalSample], periods: u64) -> ModalMotion {
        let courses = samples.iter().map(|one| one.course.clone()).collect();
        // One whose slowest mode has not died out may still change.
        let settled = decay_periods(self.system()) <= LONGEST && samples[0].stop == Stop::EndTime;
        let motion = ModalMotion::of(&self.reads(), courses, None, settled, periods);
        ModalMotion { state: Some(samples[0].begin), ..motion }
    }

    fn begins(&self, motion: &ModalMotion) -> (Vec<(ModalState, f64)>, u32) {
        let (Some(_), Some(begin), Some(periods)) =
            (motion.largest_multiplier, motion.state, motion.repeats_after)
        else {
            return (Vec::new(), 0);
        };
        let turned = ModalState {
            modes: begin.modes.map(|pair| pair.map(|one| -one)),
            absorbers: begin.absorbers.map(|pair| pair.map(|one| -one)),
        };
        (vec![(begin, 0.0), (turned, PI)], periods)
    }

    fn distance(of: &ModalState, other: &ModalState) -> f64 {
        of.apart(other)
    }

    fn size(states: &[ModalState]) -> f64 {
        states.iter().map(ModalState::size).fold(0.0, f64::max)
    }
}

impl LongTerm for ModalMotion {
    fn rests(&self) -> bool {
        ModalMotion::rests(self)
    }

    fn wanders(&self) -> bool {
        self.repeats_after.is_none()
    }

    fn is_same(&self, other: &Self) -> bool {
        ModalMotion::is_same(self, other)
    }

    fn multiplier(&self) -> Option<f64> {
        self.largest_multiplier
    }

    fn averages(&self) -> Averages {
        let value = |[value, error]: [f64; 2]| Value::new(value, error);
        Averages {
            amplitudes: self.read(Reading::Displacement).map(|one| value(one.rms)).collect(),
            impacts: self.impacts_per_period.iter().copied().map(value).collect(),
        }
    }

    fn largest(&self) -> Vec<Value> {
        self.read(Reading::Displacement).map(|one| Value::new(one.peak, one.error)).collect()
    }

    fn reached(&self) -> Reached {
        Reached { starts: self.starts, followed: self.followed, ..Reached::default() }
    }

    fn with(self, reached: Reached) -> Self {
        Self { starts: reached.starts, followed: reached.followed, ..self }
    }

    fn has_settled(&self) -> bool {
        self.settled
    }

    fn with_settled(self, settled: bool) -> Self {
        Self { settled, ..self }
    }
}
