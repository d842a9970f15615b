//! The figures of a sweep.

mod contours;
mod lines;
mod maps;
mod overlay;

use super::grid::Grid;
use crate::report::figure::Figure;

/// All figures that the columns allow, the one for the first screen first.
pub(super) fn all(grid: &Grid) -> Vec<Figure> {
    if grid.swept.axes.len() == 1 { lines::all(grid) } else { maps::all(grid) }
}
