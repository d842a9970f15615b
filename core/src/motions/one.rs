//! Of one mode with one absorber, what a search must know: many trajectories fly side by side.

use super::identity::begins;
use super::model::{
    Averages, FLIGHTS, KnownMotion, LongTerm, Model, PUSH, Proof, RECOGNITION, Sample,
};
use super::rest::Rest;
use super::watch::{Watch, WindowSample};
use super::{Facts, Motion, MotionKind, Reached, Value, settling, solved};
use crate::orbits::Orbit;
use crate::regimes::{Periodicity, Regime};
use crate::simulation::batch::{self, Extent};
use crate::simulation::{Observer, Simulation, StartError, Stop};
use crate::system::{State, System};

/// Share of its steady amplitude within which a structure vibrates as if alone.
const STEADY: f64 = 1e-6;
/// Trajectories up to which each flies alone: most lanes of a batch would be empty.
const FEW: usize = 3;

impl Model for System {
    type State = State;
    type Motion = Motion;
    type Kind = MotionKind;
    type Flight = Simulation;
    type Watch = Watch;
    type Sample = WindowSample;
    type StartError = StartError;

    const MOST_STARTS: usize = 32;

    fn settling(&self, known: &[KnownMotion<Self>]) -> u64 {
        let orbits = known.iter().filter_map(|one| one.motion.orbit().cloned());
        settling::SettlingTime::beside(self, &orbits.collect::<Vec<Orbit>>()).periods
    }

    fn window(&self, periods: u64) -> u64 {
        settling::window(self, periods)
    }

    fn shortest_window(&self) -> u64 {
        RECOGNITION
    }

    fn most_impacts(&self, _: f64) -> f64 {
        f64::INFINITY
    }

    fn creeps(&self) -> bool {
        settling::creeps(self)
    }

    fn comes_to_rest(&self) -> bool {
        settling::comes_to_rest(self)
    }

    fn begin(&self, state: &State, phase: f64) -> Result<Simulation, StartError> {
        Simulation::new(self, *state, phase)
    }

    fn pushed(&self, state: &State) -> Option<Simulation> {
        let push = PUSH * state.size().max(1.0);
        let gap = state.relative_displacement();
        // Inwards, as the absorber may be at a wall.
        let y = state.y + push * if gap < 0.0 { -1.0 } else { 1.0 };
        let beside = State { x_velocity: state.x_velocity + push, y, ..*state };
        Simulation::new(self, beside, 0.0).ok()
    }

    fn of(flight: &Simulation) -> &Self {
        flight.system()
    }

    fn state(flight: &Simulation) -> State {
        flight.state()
    }

    fn periods(flight: &Simulation) -> u64 {
        flight.periods()
    }

    fn impacts(flight: &Simulation) -> u64 {
        flight.impacts()
    }

    fn extent(flight: &Simulation, periods: u64, most_impacts: u64) -> Extent {
        // A slow excitation has many natural periods in each of its own.
        let natural = (1.0 / flight.system().frequency_ratio()).max(1.0);
        Extent {
            periods,
            impacts: ((periods as f64 * natural) as u64).saturating_mul(most_impacts),
        }
    }

    fn run(
        flights: &mut [&mut Simulation],
        far: &[Extent],
        watches: Option<&mut [Watch]>,
    ) -> Vec<Stop> {
        match watches {
            None => run(flights, far, &mut vec![(); far.len()]),
            Some(watches) => {
                let mut told: Vec<_> = watches.iter_mut().map(|one| &mut one.observers).collect();
                run(flights, far, &mut told)
            }
        }
    }

    fn periods_of_flights(flight: &Simulation) -> u64 {
        let speed = flight.state().y_velocity.abs();
        let duration = FLIGHTS * 2.0 / speed;
        if speed > 0.0 { (duration / flight.system().period()) as u64 } else { 0 }
    }

    fn at_rest(flight: &Simulation) -> Option<State> {
        settling::at_rest(flight.system(), &flight.state())
    }

    fn watch(flight: &Simulation, _: u64) -> Watch {
        Watch::begin(flight)
    }

    fn watch_of_repetition(flight: &Simulation, periods: u64) -> Watch {
        Watch::of_repetition(flight, periods)
    }

    fn repeats(watch: &mut Watch) -> Option<bool> {
        watch.repetition().map(Periodicity::has_settled)
    }

    fn is_silent(watch: &mut Watch) -> bool {
        watch.statistics().impacts() == 0
    }

    fn sample(watch: &mut Watch, flight: &Simulation, stop: Stop) -> Option<WindowSample> {
        watch.sample(flight, stop)
    }

    fn end(sample: &WindowSample) -> &State {
        &sample.end
    }

    fn solved(&self) -> Vec<KnownMotion<Self>> {
        let mut solved = solved::known(self);
        let rest = solved::at_rest(self);
        solved.extend(rest.map(|motion| KnownMotion::new(self, motion)));
        solved
    }

    fn rests(&self, sample: &WindowSample) -> bool {
        // Without damping a free vibration beside it never fades; after almost plastic impacts the absorber drifts so
        // slowly that no wall is reached in any window, while the structure vibrates as if alone.
        let alone = || {
            let drifts = !self.cavity().moves_absorber();
            let steady = self.linear_response().map_or(f64::NAN, |at| at.amplitude());
            drifts && (sample.facts.peak.value - steady).abs() < STEADY * steady
        };
        sample.evidence.impacts_per_period == 0.0 && (self.damping() == 0.0 || alone())
            || sample.evidence.periodicity.is_some_and(|found| found.impacts == 0)
    }

    fn resting(&self, seen: Option<&WindowSample>) -> Option<Motion> {
        let (facts, state) = match seen {
            Some(sample) => (sample.facts, sample.end),
            None => {
                let steady = self.linear_response()?;
                (Facts::of_sine(steady.amplitude(), 0.0), steady.state(self))
            }
        };
        Some(Motion::resting(Rest::seen(self, facts.peak.value), facts, state))
    }

    fn proof(&self, sample: &WindowSample) -> Proof<Self> {
        sample.evidence.periodicity.map_or(Proof::Open, |found| Proof::of(self, sample, found))
    }

    fn proven(&self, kind: MotionKind, sample: &WindowSample) -> Option<Motion> {
        Motion::proven(self, kind, Some(sample))
    }

    fn is_kind(motion: &Motion, kind: &MotionKind) -> bool {
        motion.kind.is_same(kind)
    }

    /// It has the regime of what all its windows show together.
    fn wandering(&self, samples: &[WindowSample], periods: u64) -> Motion {
        let evidence: Vec<_> = samples.iter().map(|one| one.evidence).collect();
        let windows: Vec<_> = samples.iter().map(|one| (one.facts, &one.course)).collect();
        Motion {
            facts: Facts::pooled(&windows, periods),
            kind: MotionKind::Wanders,
            regime: Regime::of_several(&evidence),
            state: samples[0].begin,
            reached: Reached::default(),
            settled: true,
            stop: samples[0].stop,
        }
    }

    fn begins(&self, motion: &Motion) -> (Vec<(State, f64)>, u32) {
        begins(self, motion)
    }

    fn distance(of: &State, other: &State) -> f64 {
        of.distance(other)
    }

    fn size(states: &[State]) -> f64 {
        states.iter().map(State::size).fold(1.0, f64::max)
    }
}

fn run<O: Observer>(
    flights: &mut [&mut Simulation],
    far: &[Extent],
    observers: &mut [O],
) -> Vec<Stop> {
    if flights.len() > FEW {
        return batch::run_each(flights, far, observers);
    }
    let each = flights.iter_mut().zip(far).zip(observers);
    each.map(|((one, far), observer)| one.run(far.periods, far.impacts, observer)).collect()
}

impl LongTerm for Motion {
    fn rests(&self) -> bool {
        self.rest().is_some()
    }

    fn wanders(&self) -> bool {
        matches!(self.kind, MotionKind::Wanders)
    }

    fn is_same(&self, other: &Self) -> bool {
        self.kind.is_same(&other.kind)
    }

    fn multiplier(&self) -> Option<f64> {
        self.largest_multiplier()
    }

    fn averages(&self) -> Averages {
        averages(&self.facts)
    }

    fn largest(&self) -> Vec<Value> {
        vec![self.facts.peak]
    }

    fn reached(&self) -> Reached {
        self.reached
    }

    fn with(self, reached: Reached) -> Self {
        Self { reached, ..self }
    }

    fn has_settled(&self) -> bool {
        self.settled
    }

    fn with_settled(self, settled: bool) -> Self {
        Self { settled, ..self }
    }
}

fn averages(facts: &Facts) -> Averages {
    Averages { amplitudes: vec![facts.rms], impacts: vec![facts.impacts_per_period] }
}

impl Sample for WindowSample {
    fn stop(&self) -> Stop {
        self.stop
    }

    fn averages(&self) -> Averages {
        averages(&self.facts)
    }

    fn mean_squares(&self) -> Vec<[f64; 2]> {
        vec![self.mean_squares]
    }

    fn depths(&self) -> [f64; 2] {
        self.depths
    }

    fn drifts(&self) -> bool {
        self.drifts
    }

    fn repeats(&self) -> bool {
        self.evidence.periodicity.is_some()
    }

    fn of_repeating_kind(&self) -> bool {
        WindowSample::of_repeating_kind(self)
    }
}
