//! Observers that keep a history: every impact, or the motion itself for a figure.

use serde::Serialize;

use super::events::{Detail, Impact, Observer, Segment};
use crate::system::State;

/// Keeps impacts: all of them, or the last ones.
#[derive(Debug, Clone)]
pub struct ImpactLog {
    /// In order of time.
    pub impacts: Vec<Impact>,
    kept: usize,
}

impl Default for ImpactLog {
    fn default() -> Self {
        Self { impacts: Vec::new(), kept: usize::MAX / 2 }
    }
}

impl ImpactLog {
    /// Keeps at least the last `kept` impacts and at most twice as many.
    pub fn of_the_last(kept: usize) -> Self {
        Self { impacts: Vec::new(), kept }
    }

    /// The same in the memory of another that is over.
    #[doc(hidden)]
    pub fn with_memory(self, mut impacts: Vec<Impact>) -> Self {
        impacts.clear();
        Self { impacts, ..self }
    }
}

impl Observer for ImpactLog {
    fn detail(&self) -> Detail {
        Detail::Events
    }
    fn impact(&mut self, impact: &Impact) {
        if self.impacts.len() >= 2 * self.kept {
            self.impacts.drain(..self.kept);
        }
        self.impacts.push(*impact);
    }
}

/// A point of a sampled motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TracePoint {
    /// Time in excitation periods since the start of the run.
    pub periods: f64,
    /// The state.
    pub state: State,
}

/// Samples the motion evenly in time, and at both ends of every smooth stretch, so that corners at
/// impacts are kept.
#[derive(Debug, Clone)]
pub struct Trace {
    samples_per_period: f64,
    /// In order of time.
    pub points: Vec<TracePoint>,
    /// The impacts, with their time in periods.
    pub impacts: Vec<(f64, Impact)>,
}

impl Trace {
    /// An empty trace with the given density, at least 1.
    pub fn new(samples_per_period: f64) -> Self {
        Self { samples_per_period, points: Vec::new(), impacts: Vec::new() }
    }
}

impl Observer for Trace {
    fn segment(&mut self, segment: &Segment) {
        let frequency = segment.motion.oscillator().frequency;
        let turns_per_time = frequency / std::f64::consts::TAU;
        let begin = segment.turns as f64 + segment.phase / std::f64::consts::TAU;
        let length = segment.duration * turns_per_time;
        let pieces = (length * self.samples_per_period).ceil().max(1.0);
        for k in 0..=pieces as u64 {
            let part = k as f64 / pieces;
            self.points.push(TracePoint {
                periods: begin + part * length,
                state: segment.at(part * segment.duration),
            });
        }
    }

    fn impact(&mut self, impact: &Impact) {
        let last = self.points.last().map_or(0.0, |point| point.periods);
        self.impacts.push((last, *impact));
    }
}
