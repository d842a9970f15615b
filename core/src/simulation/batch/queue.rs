//! The trajectories of a batch.

use crate::simulation::events::{Detail, Observer};
use crate::simulation::panels::Limits;
use crate::simulation::run::{Simulation, Stand, Stop};
use crate::simulation::sliding::Sliding;

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

/// Trajectories, and which of them are yet to be taken up.
pub(super) struct Queue<'a> {
    pub(super) tasks: Vec<Trajectory<'a>>,
    /// The next one last.
    pub(super) waiting: Vec<usize>,
}

impl<'a> Queue<'a> {
    pub(super) fn new(tasks: Vec<Trajectory<'a>>) -> Self {
        Self { tasks, waiting: Vec::new() }
    }

    /// Lets those wait that are not done, of such cavities.
    pub(super) fn take_up(&mut self, such: impl Fn(&Sliding) -> bool) {
        let tasks = self.tasks.iter().enumerate().rev();
        let open = tasks.filter(|(_, task)| task.stop.is_none() && such(&task.simulation.sliding));
        self.waiting = open.map(|(index, _)| index).collect();
    }
}
