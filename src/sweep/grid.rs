//! The grid of a sweep: its axes, and how its points are cut into chunks with fixed numbers.

use std::ops::Range;

use crate::case::SweepSettings;
use crate::digest::sha256;

/// Points of a chunk, at most: about half a minute's work.
const MOST_POINTS: u64 = 65_536;
/// Lines of a chunk, at least, along which motions are followed.
const LINES: u64 = 16;
/// Chunks of a sweep from which on they grow instead of becoming more: file systems and schedulers that
/// many share suffer from more files and tasks.
const MANY_CHUNKS: u64 = 16_384;

/// Axes, and how their points are cut into chunks.
#[derive(Debug, Clone)]
pub struct Grid {
    /// Axes, starts, periods, and what is recorded.
    pub settings: SweepSettings,
    /// Names the results: of the case's text and its record, the program and its version, and the size of a chunk.
    pub identity: String,
    /// Points of a chunk.
    points_per_chunk: u64,
}

impl Grid {
    /// Cut into chunks of at least so many points; `named` is what its results follow from: the case's text and its files.
    pub(super) fn of(settings: SweepSettings, fewest: u64, named: &str) -> Self {
        let size = settings.points().div_ceil(MANY_CHUNKS).next_power_of_two();
        let size = size.clamp(fewest, MOST_POINTS);
        // A motion is followed along whole lines, as many of them side by side as a batch has lanes.
        let points_per_chunk = match settings.axes.last() {
            Some(axis) if settings.follow => {
                let line = axis.values.len() as u64;
                line * (size / line).max(LINES)
            }
            _ => size,
        };
        let [name, version] = [env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION")];
        let identity = sha256(format!("{name} {version} {points_per_chunk} {named}").as_bytes());
        Self { settings, identity, points_per_chunk }
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

    /// The place of a point on each axis, in the units of [`SweepAxis::values`](crate::case::SweepAxis::values); the last axis varies fastest.
    pub fn coordinates(&self, number: u64) -> Vec<f64> {
        let axes = &self.settings.axes;
        let indices = indices(number, axes.iter().map(|axis| axis.values.len()));
        axes.iter().zip(indices).map(|(axis, index)| axis.values[index]).collect()
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
