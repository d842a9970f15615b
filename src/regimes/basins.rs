//! Basins of attraction: which starts of a plane lead to which long-term motion.

use serde::Serialize;

use super::attractor::Effort;
use super::{Attractor, DynamicsKind};
use crate::simulation::{StartError, Stop};
use crate::system::{State, System};

/// One coordinate of a start; lengths over the clearance, velocities in fast time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Coordinate {
    /// Oscillator displacement.
    Displacement,
    /// Oscillator velocity.
    Velocity,
    /// Relative displacement `w = x - y`.
    Gap,
    /// Absorber velocity.
    AbsorberVelocity,
}

/// A coordinate and the range that it takes, in cells of equal width.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Axis {
    /// Which.
    pub coordinate: Coordinate,
    /// Lower and upper end.
    pub range: [f64; 2],
    /// Number of cells.
    pub cells: u32,
}

impl Axis {
    /// Middle of a cell.
    pub fn middle(&self, cell: u32) -> f64 {
        let [low, high] = self.range;
        low + (high - low) * (f64::from(cell) + 0.5) / f64::from(self.cells)
    }
}

/// A plane of starts at excitation phase 0: two coordinates vary, the other two are fixed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Plane {
    /// Varies along a row.
    pub horizontal: Axis,
    /// Varies from row to row.
    pub vertical: Axis,
    /// Displacement, velocity, gap and absorber velocity where they do not vary.
    pub fixed: [f64; 4],
}

impl Plane {
    /// The start in the middle of a cell. The absorber may be outside the cavity.
    pub fn start(&self, column: u32, row: u32) -> State {
        let mut at = self.fixed;
        for (axis, cell) in [(&self.horizontal, column), (&self.vertical, row)] {
            at[axis.coordinate as usize] = axis.middle(cell);
        }
        let [x, x_velocity, gap, y_velocity] = at;
        State { x, x_velocity, y: x - gap, y_velocity }
    }
}

/// Ratio of the rms displacement in one short window to that in a long one: a modulation of the depth
/// that strongly modulated responses have, seen at its lowest or highest.
const SCATTER: f64 = 1.6;

/// Where a cell leads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Cell {
    /// To the long-term motion with this index.
    Leads(usize),
    /// The effort ended before the motion had settled, or it was given up for its impacts.
    NotSettled,
    /// There is no such start: the absorber would be outside its cavity.
    Impossible,
}

/// The cells of a plane and the motions that they lead to.
#[derive(Debug, Clone, Serialize)]
pub struct Basins {
    /// The plane.
    pub plane: Plane,
    /// Row by row, lowest value first.
    pub cells: Vec<Cell>,
    /// The motions, those that were known first. A motion and its mirror image are one.
    pub attractors: Vec<Attractor>,
}

impl Basins {
    /// Follows a start from the middle of every cell with `effort`, and matches what it becomes with
    /// the motions that are `known` or have been found before. `progress` is told of each cell.
    ///
    /// # Errors
    /// [`StartError`] if the plane is not finite.
    pub fn of(
        system: &System,
        plane: Plane,
        known: Vec<Attractor>,
        effort: &Effort,
        progress: &mut dyn FnMut(u64),
    ) -> Result<Self, StartError> {
        let mut basins = Self { plane, cells: Vec::new(), attractors: known };
        for row in 0..plane.vertical.cells {
            for column in 0..plane.horizontal.cells {
                let cell = match Attractor::reach(system, plane.start(column, row), effort) {
                    Ok(reached) => basins.matched(reached),
                    Err(StartError::OutsideCavity { .. }) => Cell::Impossible,
                    Err(error) => return Err(error),
                };
                basins.cells.push(cell);
                progress(1);
            }
        }
        Ok(basins)
    }

    /// The cell in a column and row.
    pub fn cell(&self, column: u32, row: u32) -> Option<Cell> {
        let index = u64::from(row) * u64::from(self.plane.horizontal.cells) + u64::from(column);
        let inside = column < self.plane.horizontal.cells;
        self.cells.get(usize::try_from(index).ok().filter(|_| inside)?).copied()
    }

    /// How many cells lead to each motion.
    pub fn counts(&self) -> Vec<usize> {
        let led = |index| self.cells.iter().filter(|cell| **cell == Cell::Leads(index)).count();
        (0..self.attractors.len()).map(led).collect()
    }

    /// The known motion that never repeats and is nearest in rms, within [`SCATTER`]: in the short
    /// window of one cell the averages and even the regime of a chaotic motion scatter.
    fn scattered(&self, reached: &Attractor) -> Option<usize> {
        let moves =
            |one: &Attractor| !one.repeats() && one.impact_count > 0 && one.stop == Stop::EndTime;
        let apart = |known: &Attractor| libm::log(known.rms / reached.rms).abs();
        let known = self.attractors.iter().enumerate().filter(|(_, known)| moves(known));
        let nearest = known.min_by(|a, b| apart(a.1).total_cmp(&apart(b.1)))?;
        (moves(reached) && apart(nearest.1) < libm::log(SCATTER)).then_some(nearest.0)
    }

    fn matched(&mut self, reached: Attractor) -> Cell {
        if let Some(known) = self.attractors.iter().position(|known| known.is_same(&reached)) {
            self.attractors[known].replace_if_settled(reached);
            return Cell::Leads(known);
        }
        if let Some(known) = self.scattered(&reached) {
            return Cell::Leads(known);
        }
        let open = reached.classification.dynamics == DynamicsKind::TransientNotOver;
        if open || reached.stop != Stop::EndTime {
            return Cell::NotSettled;
        }
        self.attractors.push(reached);
        Cell::Leads(self.attractors.len() - 1)
    }
}
