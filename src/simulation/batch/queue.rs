//! The trajectories of a batch.

use crate::simulation::events::Observer;
use crate::simulation::panels::Limits;
use crate::simulation::run::{Moment, Simulation, Stop};

/// A trajectory on its way.
pub(super) struct Task<'a, O> {
    pub(super) simulation: &'a mut Simulation,
    pub(super) observer: &'a mut O,
    pub(super) limits: Limits,
    pub(super) stop: Option<Stop>,
}

impl<O: Observer> Task<'_, O> {
    /// Goes on alone until the trajectory flies through panels, or has ended; at least one step if
    /// `doubt`.
    pub(super) fn alone(&mut self, mut doubt: bool) -> Option<Moment> {
        loop {
            if let Some(stop) = self.limits.stop(self.simulation) {
                self.stop = Some(stop);
                return None;
            }
            if !doubt && let Some(departure) = self.simulation.departure() {
                return Some(departure);
            }
            doubt = false;
            let one = Limits::of(self.simulation, 1, 1);
            if let Err(stop) = self.simulation.step(one, self.observer) {
                self.stop = Some(stop);
                return None;
            }
        }
    }
}

/// Trajectories, and which of them is to be taken up next.
pub(super) struct Queue<'a, O> {
    pub(super) tasks: Vec<Task<'a, O>>,
    pub(super) next: usize,
}
