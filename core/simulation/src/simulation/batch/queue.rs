//! The trajectories of a batch.

use crate::simulation::events::{Detail, Observer};
use crate::simulation::panels::Limits;
use crate::simulation::run::{Simulation, Stand, Stop};

/// A trajectory on its way.
pub(super) struct Trajectory<'a> {
    pub(super) simulation: &'a mut Simulation,
    pub(super) observer: &'a mut dyn Observer,
    /// What the observer needs to be told of.
    pub(super) detail: Detail,
    pub(super) limits: Limits,
    pub(super) stop: Option<Stop>,
}

impl Trajectory<'_> {
    /// Goes on alone until the trajectory can fly beside others, or has ended; at least one step if `doubt`.
    pub(super) fn alone(&mut self, mut doubt: bool) -> Option<Stand> {
        loop {
            if let Some(stop) = self.limits.stop(self.simulation) {
                self.stop = Some(stop);
                return None;
            }
            if !doubt && let Some(departure) = self.simulation.departure() {
                return Some(departure);
            }
            doubt = false;
            let limits = match self.simulation.flies_beside_others() {
                true => Limits::of(self.simulation, 1, 1),
                false => self.limits,
            };
            if let Err(stop) = self.simulation.step(limits, self.observer) {
                self.stop = Some(stop);
                return None;
            }
        }
    }
}

/// Trajectories, and which of them is to be taken up next.
pub(super) struct Queue<'a> {
    pub(super) tasks: Vec<Trajectory<'a>>,
    pub(super) next: usize,
}
