//! Many systems at once: a grid over parameters of a case, cut into chunks with fixed numbers, so that any of
//! them can be worked out anywhere and at any time, with the same bytes.
//!
//! For the program itself: this module may change at any time.

pub mod columns;
pub mod csv;
mod facts;
mod follow;
pub mod limits;
pub mod parquet;
mod transient;
pub mod work;

use std::ops::Range;

use crate::case::{Case, Design, SweepSettings};
use crate::digest::sha256;
use crate::quantity::Units;
use crate::system::{Parameter, State, System};
use transient::Unsteady;

/// Points of a chunk, at least: about half a second's work, so that little is lost with one, and a file of some
/// hundred kilobytes, so that there are not too many of them.
const FEWEST_POINTS: u64 = 1024;
/// Seconds that a chunk of dearer points takes, about, at least.
const CHUNK: f64 = 0.5;
/// Points of a chunk, at most: about half a minute's work.
const MOST_POINTS: u64 = 65_536;
/// Lines of a chunk, at least, along which motions are followed.
const LINES: u64 = 16;
/// Chunks of a sweep from which on they grow instead of becoming more: file systems and schedulers that
/// many share suffer from more files and tasks.
const MANY_CHUNKS: u64 = 16_384;

/// What is worked out at every point, and how it is cut into chunks.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The case's own design.
    pub design: Design,
    /// Axes, starts, periods, and what is recorded.
    pub settings: SweepSettings,
    /// Names the results: of the case's text and its record, the program and its version, and the size of a chunk.
    pub identity: String,
    /// Points of a chunk.
    points_per_chunk: u64,
    /// What else the case says where its structure is not driven steadily.
    unsteady: Option<Unsteady>,
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
        let (identity, unsteady) = (String::new(), Unsteady::of(case));
        let mut plan =
            Self { design: case.design, settings, identity, points_per_chunk: 1, unsteady };
        let settings = &plan.settings;
        let size = settings.points().div_ceil(MANY_CHUNKS).next_power_of_two();
        let size = size.clamp(plan.fewest_points(), MOST_POINTS);
        // A motion is followed along whole lines, as many of them side by side as a batch has lanes.
        plan.points_per_chunk = match settings.axes.last() {
            Some(axis) if settings.follow => {
                let line = axis.values.len() as u64;
                line * (size / line).max(LINES)
            }
            _ => size,
        };
        let [name, version] = [env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION")];
        let mut named = format!("{name} {version} {} {}", plan.points_per_chunk, case.text_hash);
        named.extend(plan.unsteady.iter().filter_map(Unsteady::digest));
        plan.identity = sha256(named.as_bytes());
        Some(plan)
    }

    /// Points of a chunk, at least: fewer of dearer ones.
    fn fewest_points(&self) -> u64 {
        let last = self.points().saturating_sub(1);
        let some = [0, last / 2, last].map(|number| self.seconds(&self.point(number)));
        let mean = some.into_iter().flatten().sum::<f64>() / some.len() as f64;
        match self.unsteady {
            Some(_) => ((CHUNK / mean) as u64).clamp(1, FEWEST_POINTS).next_power_of_two(),
            None => FEWEST_POINTS,
        }
    }

    /// About how many seconds a point takes where the structure is not driven steadily; none where it is.
    pub fn seconds(&self, point: &GridPoint) -> Option<f64> {
        self.unsteady.as_ref().map(|unsteady| unsteady.seconds(self, point))
    }

    /// Names the chunks: as [`Self::identity`], and of the sources that the program was built from. Two
    /// builds of one version may give other numbers, and their chunks must not be put together.
    pub fn identity_of_chunks(&self) -> String {
        sha256(format!("{} {}", self.identity, env!("VINESINK_SOURCES")).as_bytes())
    }

    /// Number of points: every combination of the axes' values.
    pub fn points(&self) -> u64 {
        self.settings.points()
    }

    /// Number of chunks.
    pub fn chunks(&self) -> u64 {
        self.points().div_ceil(self.points_per_chunk)
    }

    /// Points of every chunk but perhaps the last.
    pub fn points_per_chunk(&self) -> u64 {
        self.points_per_chunk
    }

    /// The points of a chunk; empty beyond the last.
    pub fn chunk(&self, number: u64) -> Range<u64> {
        let begin = number.saturating_mul(self.points_per_chunk).min(self.points());
        begin..begin.saturating_add(self.points_per_chunk).min(self.points())
    }

    /// The point of a number; the last axis varies fastest.
    pub fn point(&self, number: u64) -> GridPoint {
        let axes = &self.settings.axes;
        let indices = indices(number, axes.iter().map(|axis| axis.values.len()));
        let coordinates: Vec<f64> =
            axes.iter().zip(indices).map(|(axis, index)| axis.values[index]).collect();
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

/// The place of a point on each axis, given how many values these have; the last varies fastest.
pub fn indices(number: u64, counts: impl DoubleEndedIterator<Item = usize>) -> Vec<usize> {
    let mut rest = number;
    let mut indices: Vec<usize> = Vec::new();
    for count in counts.rev() {
        indices.push((rest % count as u64) as usize);
        rest /= count as u64;
    }
    indices.reverse();
    indices
}
