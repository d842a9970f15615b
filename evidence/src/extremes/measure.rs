//! One trajectory, measured: what it costs, how well it closes its balances, and how far it is from
//! the reference in multiple precision.

use std::f64::consts::TAU;

use serde::Serialize;

use super::Entry;
use crate::reference::{Event, Reference};
use vinesink::simulation::trust::energy_residual;
use vinesink::simulation::{
    AbsorberMotion, Doubt, Impact, Measurement, Observer, Segment, Simulation, StartError, Stop,
};

/// Points of each stretch of motion at which the cavity is looked into.
const LOOKS: u32 = 8;
/// Difference of times, in fast time, from which on two trajectories are two.
const VISIBLE: f64 = 1e-6;
/// Impacts of one chattering sequence that the reference follows at most.
pub(super) const LONGEST_SEQUENCE: u32 = 5_000;
/// Impacts and releases that the reference follows.
pub const FOLLOWED: usize = 30;

/// What a trajectory came to.
#[derive(Debug, Clone, Serialize)]
pub struct MeasuredRun {
    /// Whether it came to its end.
    pub whole: bool,
    /// Whole periods done.
    pub periods: u64,
    /// Impacts.
    pub impacts: u64,
    /// Evaluations of the closed form in search of events.
    pub evaluations: u64,
    /// Residual of the energy balance over the largest energy of the run.
    pub energy_residual: f64,
    /// Largest `abs(x - y) - 1`, at impacts and at points between.
    pub penetration: f64,
    /// Why it should not be trusted.
    #[serde(skip)]
    pub doubts: Vec<Doubt>,
    /// How it compares with the reference.
    pub comparison: Option<Comparison>,
}

/// A trajectory against the reference.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Comparison {
    /// Impacts and releases compared.
    pub events: usize,
    /// Whether walls, sticking and releases came in the same order.
    pub same_order: bool,
    /// Largest difference of their times, in fast time.
    pub error: f64,
    /// Largest difference that the reference itself makes when its start and every wall are moved by
    /// the spacing of floating-point numbers at the largest displacement: what rounding costs.
    pub one_rounding: f64,
    /// Spacing of floating-point numbers at the last of those times.
    pub clock: f64,
    /// Part of the run that the events compared cover.
    pub part: f64,
}

/// What the engine reports, in order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Seen {
    Impact { tau: f64, side: f64 },
    Stick,
    ContactEnd(ContactEnd),
}

impl Seen {
    /// When it happened; contact is part of the impact before.
    fn tau(&self) -> Option<f64> {
        match self {
            Self::Impact { tau, .. } | Self::ContactEnd(ContactEnd { tau, .. }) => Some(*tau),
            Self::Stick => None,
        }
    }
}

/// The end of a sustained contact, and what led to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ContactEnd {
    pub tau: f64,
    /// Displacement of the oscillator over the clearance.
    pub x: f64,
    /// Energy lost up to there.
    pub loss: f64,
}

/// Keeps the first events and looks into the cavity.
#[derive(Default)]
pub(super) struct Witness {
    /// How many are kept.
    pub wanted: usize,
    pub seen: Vec<Seen>,
    carried: bool,
    penetration: f64,
    loss: f64,
}

impl Witness {
    pub(super) fn of(wanted: usize) -> Self {
        Self { wanted, ..Self::default() }
    }

    fn keep(&mut self, event: Seen) {
        if self.seen.len() < self.wanted {
            self.seen.push(event);
        }
    }
}

impl Observer for Witness {
    fn segment(&mut self, segment: &Segment) {
        let carried = !matches!(segment.absorber, AbsorberMotion::Flying { .. });
        if self.carried && !carried {
            let omega = segment.motion.oscillator().frequency;
            let tau = (segment.turns as f64 * TAU + segment.phase) / omega;
            self.keep(Seen::ContactEnd(ContactEnd { tau, x: segment.at(0.0).x, loss: self.loss }));
        }
        self.carried = carried;
        for k in 0..=LOOKS {
            let s = segment.duration * f64::from(k) / f64::from(LOOKS);
            self.penetration =
                self.penetration.max(segment.at(s).relative_displacement().abs() - 1.0);
        }
    }

    fn impact(&mut self, impact: &Impact) {
        self.penetration = self.penetration.max(impact.penetration);
        self.loss += impact.loss;
        self.keep(Seen::Impact { tau: impact.tau, side: impact.side.sign() });
    }

    fn sticks(&mut self, loss: f64) {
        self.loss += loss;
        self.keep(Seen::Stick);
    }
}

impl Entry {
    /// Simulates and compares.
    ///
    /// # Errors
    /// [`StartError`] where the start is impossible.
    pub fn measure(&self) -> Result<MeasuredRun, StartError> {
        let start = self.start.state();
        let mut simulation = Simulation::new(&self.system, start, 0.0)?;
        let mut measurement = Measurement::begin(&self.system, start);
        let mut witness = Witness::of(FOLLOWED);
        let observers = &mut (&mut measurement, &mut witness);
        let stop = simulation.run(self.periods, self.impact_limit, observers);
        let statistics = measurement.statistics();
        let peak = statistics.peak();
        let compared = !witness.seen.is_empty();
        Ok(MeasuredRun {
            whole: stop == Stop::EndTime,
            periods: simulation.periods(),
            impacts: simulation.impacts(),
            evaluations: simulation.evaluations(),
            energy_residual: energy_residual(&statistics.energy(), peak),
            penetration: witness.penetration,
            doubts: statistics.doubts(stop),
            comparison: compared.then(|| self.compare(&witness.seen, peak)),
        })
    }

    fn compare(&self, seen: &[Seen], peak: f64) -> Comparison {
        let rounding = f64::EPSILON * (1.0 + peak);
        let reference =
            |rounding| follow(Reference::new(&self.system, self.start.state(), rounding), seen);
        let ((complete, mut exact), (_, moved)) = (reference(0.0), reference(rounding));
        // Beyond the first event that rounding moves visibly nothing can be compared.
        let pairs = exact.iter().zip(&moved);
        let known = pairs.take_while(|(a, b)| (*a - *b).abs() <= VISIBLE).count();
        let same_order = complete || known < exact.len();
        exact.truncate(known);
        let largest = |times: &[f64]| {
            let pairs = times.iter().zip(&exact);
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        let engine: Vec<f64> = seen.iter().filter_map(Seen::tau).collect();
        let last = exact.last().copied().unwrap_or(0.0);
        let period = self.system.period();
        Comparison {
            events: exact.len(),
            same_order,
            error: largest(&engine),
            one_rounding: largest(&moved),
            // The phase is kept to a spacing of numbers below 2 pi.
            clock: f64::EPSILON * (last + period),
            part: last / (self.periods as f64 * period),
        }
    }
}

/// Times of the events that the engine saw, by the reference, and whether it saw the same ones; ends
/// where it did not. Where friction turns or stops the absorber in flight is no event of its own: what it makes of the next
/// one tells.
fn follow(mut reference: Reference, seen: &[Seen]) -> (bool, Vec<f64>) {
    let mut next = |until: f64| {
        loop {
            match reference.next(until) {
                Some(Event::Reversal { .. } | Event::Stick { .. }) => {}
                event => return event,
            }
        }
    };
    let mut times = Vec::new();
    let mut resting = false;
    for event in seen {
        match *event {
            Seen::Impact { tau, side } => match next(2.0 * tau + 10.0) {
                Some(Event::Impact { tau, side: found, sticks, .. }) if found == side => {
                    times.push(tau);
                    resting = sticks;
                }
                _ => return (false, times),
            },
            Seen::Stick => {
                let last = times.last().copied().unwrap_or(0.0);
                for _ in 0..LONGEST_SEQUENCE {
                    if resting {
                        break;
                    }
                    match next(last + 10.0) {
                        Some(Event::Impact { sticks, .. }) => resting = sticks,
                        _ => return (false, times),
                    }
                }
                if !resting {
                    return (false, times);
                }
            }
            Seen::ContactEnd(ContactEnd { tau, .. }) => match next(2.0 * tau + 10.0) {
                Some(Event::Release { tau, .. }) => times.push(tau),
                _ => return (false, times),
            },
        }
    }
    (true, times)
}
