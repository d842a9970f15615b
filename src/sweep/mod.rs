//! Many systems at once: a grid over parameters of a case, cut into chunks with fixed numbers, so that any of
//! them can be worked out anywhere and at any time, with the same bytes.
//!
//! For the program itself: this module may change at any time.

pub mod columns;
pub mod csv;
mod facts;
mod follow;
mod grid;
pub mod limits;
pub mod parquet;
mod several;
mod transient;
pub mod work;

use std::ops::Deref;

use crate::case::{Case, Design};
use crate::quantity::Units;
use crate::system::{Parameter, State, System};
use transient::Unsteady;

pub use grid::{Grid, indices};
pub use several::{LIMITS, ModalPlan};

/// Points of a chunk, at least: about half a second's work, so that little is lost with one, and a file of some
/// hundred kilobytes, so that there are not too many of them.
const FEWEST_POINTS: u64 = 1024;
/// Seconds that a chunk of dearer points takes, about, at least.
const CHUNK: f64 = 0.5;

/// Points of a chunk, at least, of which each takes so many seconds.
fn fewest_of(seconds: f64) -> u64 {
    ((CHUNK / seconds) as u64).clamp(1, FEWEST_POINTS).next_power_of_two()
}

/// What is worked out at every point of a structure of one mode with one absorber.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The case's own design.
    pub design: Design,
    /// Its points.
    pub grid: Grid,
    /// Whether an absorber that stays at rest counts, as the case's criteria say.
    count_rest: bool,
    /// What else the case says where its structure is not driven steadily.
    unsteady: Option<Unsteady>,
}

impl Deref for Plan {
    type Target = Grid;

    fn deref(&self) -> &Grid {
        &self.grid
    }
}

/// A point of the grid.
#[derive(Debug, Clone, PartialEq)]
pub struct GridPoint {
    /// Its number.
    pub number: u64,
    /// Its place on each axis, in the units of [`SweepAxis::values`](crate::case::SweepAxis::values).
    pub coordinates: Vec<f64>,
    /// Its design.
    pub design: Design,
    /// Its system; `None` where the values together leave none.
    pub system: Option<System>,
    /// What turns the system's numbers into the case's units.
    pub units: Units,
    /// Where its motion starts, over its clearance; `None` where no axis says, or nothing drives it steadily.
    pub start: Option<State>,
}

impl Plan {
    /// That of a case; `None` where it has no table `[sweep]`.
    pub fn of(case: &Case) -> Option<Self> {
        let settings = case.sweep.clone()?;
        let unsteady = Unsteady::of(case);
        let mut named = case.text_hash.clone();
        named.extend(unsteady.iter().filter_map(Unsteady::digest));
        let whole = Grid::of(settings, FEWEST_POINTS, &named);
        let count_rest = case.count_inactive;
        let plan = Self { design: case.design, grid: whole, count_rest, unsteady };
        let fewest = plan.fewest_points();
        let grid = Grid::of(plan.settings.clone(), fewest, &named);
        Some(Self { grid, ..plan })
    }

    /// Points of a chunk, at least: fewer of dearer ones.
    fn fewest_points(&self) -> u64 {
        let last = self.points().saturating_sub(1);
        let some = [0, last / 2, last].map(|number| self.seconds(&self.point(number)));
        let mean = some.into_iter().flatten().sum::<f64>() / some.len() as f64;
        if self.unsteady.is_some() { fewest_of(mean) } else { FEWEST_POINTS }
    }

    /// About how many seconds a point takes where the structure is not driven steadily; none where it is.
    pub fn seconds(&self, point: &GridPoint) -> Option<f64> {
        self.unsteady.as_ref().map(|unsteady| unsteady.seconds(self, point))
    }

    /// The point of a number; the last axis varies fastest.
    pub fn point(&self, number: u64) -> GridPoint {
        let axes = &self.settings.axes;
        let coordinates = self.coordinates(number);
        let parameters = axes.iter().map(|axis| axis.parameter);
        let mut values: Vec<(Parameter, f64)> =
            parameters.zip(coordinates.iter().copied()).collect();
        // Ratios are of what the others make the design.
        values.sort_by_key(|(parameter, _)| parameter.is_ratio());
        let applied =
            |design: Design, (parameter, value): &(Parameter, f64)| design.with(*parameter, *value);
        let design = values.iter().fold(self.design, applied);
        let units = design.units();
        let steady = self.unsteady.is_none();
        let start = follow::start(values.into_iter().filter(|_| steady), &units);
        GridPoint { number, design, system: design.possible_system(), units, start, coordinates }
    }

    /// Whether velocity or acceleration is recorded.
    fn asks_for_shaking(&self) -> bool {
        self.settings.record.iter().any(|one| one.asked().0.is_of_shaking())
    }

    /// Whether anything is recorded that only simulation knows.
    pub fn needs_simulation(&self) -> bool {
        self.settings.record.iter().any(|recorded| recorded.is_simulated())
    }
}
