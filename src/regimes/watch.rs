//! What watches a trajectory side by side with others.

use super::periodicity::{self, Periodicity};
use super::{Evidence, Motion};
use crate::simulation::{Impact, ImpactLog, Measurement, Simulation, Statistics, Stop};

/// Impacts that are kept to tell a regime by: their intervals are averaged.
const KEPT_IMPACTS: usize = 1000;

/// Measures one trajectory and keeps its last impacts.
pub(super) struct Watch {
    /// What is told of the trajectory.
    pub(super) observers: (Measurement, ImpactLog),
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
        let (system, state) = (simulation.system(), simulation.state());
        let measurement = Measurement::after(periods, system, state);
        Self { observers: (measurement, ImpactLog::of_the_last(KEPT_IMPACTS)) }
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

    /// The motion measured; none where the trajectory came to a bad end.
    pub fn motion(&mut self, simulation: &Simulation, stop: Stop) -> Option<Motion> {
        if !matches!(stop, Stop::EndTime | Stop::ImpactLimit) {
            return None;
        }
        let (measurement, log) = &mut self.observers;
        let statistics = measurement.statistics();
        let period = simulation.system().period();
        let evidence = Evidence::of_impacts(statistics, &log.impacts, period);
        Some(Motion::of(statistics, &evidence, simulation, stop))
    }
}
