//! Basins of attraction: which of many starts lead to which long-term motion.

use super::Motion;
use super::long_term::{Effort, long_term};
use crate::simulation::{StartError, Stop};
use crate::system::{State, System};

/// Ratio of the rms displacement in one short window to that in a long one: a modulation of the depth
/// that strongly modulated responses have, seen at its lowest or highest.
const SCATTER: f64 = 1.6;
/// Starts that are followed side by side, so that progress can be told.
const TOGETHER: usize = 64;

/// Where a start leads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cell {
    /// To the long-term motion with this index.
    Leads(usize),
    /// The effort ended before the motion had settled, or it was given up for its impacts.
    NotSettled,
}

/// Where starts lead, and the motions that they lead to.
#[derive(Debug, Clone, Default)]
pub struct Basins {
    /// One for each start.
    pub cells: Vec<Cell>,
    /// The motions, those that were known first. A motion and its mirror image are one.
    pub motions: Vec<Motion>,
}

impl Basins {
    /// Follows starts at excitation phase 0, and matches what they become with the motions that are `known` or
    /// have been found before. `progress` is told of how many were followed.
    ///
    /// # Errors
    /// [`StartError`] for a start outside the cavity, or one that is not finite.
    pub fn of(
        system: &System,
        starts: &[State],
        known: Vec<Motion>,
        effort: &Effort,
        progress: &mut dyn FnMut(u64),
    ) -> Result<Self, StartError> {
        let mut basins = Self { cells: Vec::with_capacity(starts.len()), motions: known };
        for some in starts.chunks(TOGETHER) {
            let begun: Vec<(System, State)> = some.iter().map(|start| (*system, *start)).collect();
            for motion in long_term(&begun, effort)? {
                let cell = basins.matched(motion);
                basins.cells.push(cell);
            }
            progress(some.len() as u64);
        }
        Ok(basins)
    }

    /// How many starts lead to each motion.
    pub fn counts(&self) -> Vec<usize> {
        let led = |index| self.cells.iter().filter(|cell| **cell == Cell::Leads(index)).count();
        (0..self.motions.len()).map(led).collect()
    }

    /// The known motion that never repeats and is nearest in rms, within [`SCATTER`]: in the short
    /// window of one start the averages and even the regime of a chaotic motion scatter.
    fn scattered(&self, reached: &Motion) -> Option<usize> {
        let moves =
            |one: &Motion| !one.repeats() && !one.is_inactive() && one.stop == Stop::EndTime;
        let apart = |known: &Motion| libm::log(known.rms / reached.rms).abs();
        let known = self.motions.iter().enumerate().filter(|(_, known)| moves(known));
        let nearest = known.min_by(|a, b| apart(a.1).total_cmp(&apart(b.1)))?;
        (moves(reached) && apart(nearest.1) < libm::log(SCATTER)).then_some(nearest.0)
    }

    fn matched(&mut self, reached: Option<Motion>) -> Cell {
        let Some(reached) = reached else { return Cell::NotSettled };
        let known = self.motions.iter().position(|known| known.is_same(&reached));
        if let Some(known) = known.or_else(|| self.scattered(&reached)) {
            return Cell::Leads(known);
        }
        if !reached.settled || reached.stop != Stop::EndTime {
            return Cell::NotSettled;
        }
        self.motions.push(reached);
        Cell::Leads(self.motions.len() - 1)
    }
}
