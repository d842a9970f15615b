//! What watches a trajectory side by side with others, and what it has seen.

use std::cell::RefCell;

use super::Facts;
use crate::regimes::modulation;
use crate::regimes::periodicity::{self, Periodicity};
use crate::regimes::{Evidence, ImpactSequence, Regime};
use crate::simulation::{
    Course, Impact, ImpactLog, Measurement, PeriodRecord, Simulation, Statistics, Stop,
};
use crate::system::State;

/// Impacts that are kept to tell a regime by: their intervals are averaged.
const KEPT_IMPACTS: usize = 1000;
/// Watches whose memory is kept when they are over, for those to come, and the most records and impacts of one.
const SPARE: usize = 64;
const SPARE_LENGTH: usize = 1024;

thread_local! {
    /// To ask for memory anew for every start of a survey, and to let it grow, takes an eighth of its time.
    static MEMORY: RefCell<Vec<(Vec<PeriodRecord>, Vec<Impact>)>> = const { RefCell::new(Vec::new()) };
}

/// Measures one trajectory and keeps its last impacts.
pub(super) struct Watch {
    /// What is told of the trajectory.
    pub(super) observers: (Measurement, ImpactLog),
    begin: State,
}

/// What was seen of a trajectory over a window.
#[derive(Debug, Clone)]
pub(super) struct WindowSample {
    pub facts: Facts,
    pub evidence: Evidence,
    /// States at the beginning and the end of the window, phase 0.
    pub begin: State,
    pub end: State,
    /// The impacts of the last repetition, and its `C`, `E` and peak; nothing of what does not repeat.
    pub impacts: Vec<Impact>,
    pub amplitudes: [f64; 3],
    /// What each of its periods came to.
    pub course: Course,
    /// Whether the absorber rests on a wall at times.
    pub contact: bool,
    /// Whether the mean square goes up or down over the window.
    pub drifts: bool,
    /// Mean square displacement in its halves, and the depth of modulation.
    pub mean_squares: [f64; 2],
    pub depths: [f64; 2],
    pub stop: Stop,
}

impl WindowSample {
    pub fn regime(&self) -> Regime {
        Regime::of(&self.evidence)
    }

    /// Whether it is of a kind that repeats and was not seen to: an absorber that has come to rest, or was captured, only
    /// late, or that drifts from one wall to the other for longer than the window.
    pub fn of_repeating_kind(&self) -> bool {
        matches!(self.regime(), Regime::AtRest | Regime::TwoSymmetric | Regime::TwoAsymmetric)
    }
}

impl Watch {
    pub fn begin(simulation: &Simulation) -> Self {
        Self::after(0, simulation)
    }

    /// Sees whether a motion repeats in so many periods, of which it measures flights in no more than the longest
    /// repetition that they can show: a motion that does not repeat then has no size.
    pub fn of_repetition(simulation: &Simulation, periods: u64) -> Self {
        Self::after(periods - periodicity::longest_within(periods), simulation)
    }

    fn after(periods: u64, simulation: &Simulation) -> Self {
        let (system, begin) = (simulation.system(), simulation.state());
        let (records, impacts) = MEMORY.with_borrow_mut(Vec::pop).unwrap_or_default();
        let measurement = Measurement::after(periods, system, begin).with_memory(records);
        let log = ImpactLog::of_the_last(KEPT_IMPACTS).with_memory(impacts);
        Self { observers: (measurement, log), begin }
    }

    /// How what has been seen so far repeats.
    pub fn repetition(&mut self) -> Option<Periodicity> {
        periodicity::find(self.statistics().records())
    }

    /// What has been measured so far.
    pub fn statistics(&mut self) -> &Statistics {
        self.observers.0.statistics()
    }

    /// The impacts that are kept.
    pub fn impacts(&self) -> &[Impact] {
        &self.observers.1.impacts
    }

    /// What was seen; none where the trajectory came to a bad end.
    pub fn sample(&mut self, simulation: &Simulation, stop: Stop) -> Option<WindowSample> {
        if !matches!(stop, Stop::EndTime | Stop::ImpactLimit) {
            return None;
        }
        let (measurement, log) = &mut self.observers;
        let statistics = measurement.statistics();
        let records = statistics.records();
        let mut evidence =
            Evidence::of_impacts(statistics, &log.impacts, simulation.system().period());
        let last = evidence.periodicity.and_then(|found| {
            periodicity::last_repetition(found, &log.impacts).map(|last| (found, last))
        });
        evidence.sequence = last.and_then(|(_, impacts)| ImpactSequence::of(impacts));
        let amplitudes = evidence.periodicity.map_or([0.0; 3], |found| {
            let last = found.last(records);
            let harmonic = |of: fn(&PeriodRecord) -> [f64; 2]| {
                let part = |k: usize| last.iter().map(|one| of(one)[k]).sum::<f64>();
                libm::hypot(part(0), part(1)) / last.len().max(1) as f64
            };
            let peak = last.iter().map(|one| one.peak).fold(0.0, f64::max);
            [harmonic(|one| one.oscillator_harmonic), harmonic(|one| one.absorber_harmonic), peak]
        });
        let (first, second) = records.split_at(records.len() / 2);
        let halves = |of: &dyn Fn(&[PeriodRecord]) -> f64| [of(first), of(second)];
        Some(WindowSample {
            facts: Facts::measured(statistics, &evidence),
            begin: self.begin,
            end: simulation.state(),
            impacts: last.map(|(_, impacts)| impacts.to_vec()).unwrap_or_default(),
            amplitudes,
            course: statistics.course(),
            contact: statistics.sustained_contact().intervals > 0,
            drifts: modulation::drifting(records),
            mean_squares: halves(&|part| {
                part.iter().map(|one| one.mean_square).sum::<f64>() / part.len().max(1) as f64
            }),
            depths: halves(&modulation::depth),
            evidence,
            stop,
        })
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        let (measurement, log) = &mut self.observers;
        let memory = (measurement.take_memory(), std::mem::take(&mut log.impacts));
        // Not where the thread is about to end.
        let _ = MEMORY.try_with(|all| {
            let mut all = all.borrow_mut();
            if all.len() < SPARE && memory.0.capacity().max(memory.1.capacity()) <= SPARE_LENGTH {
                all.push(memory);
            }
        });
    }
}
