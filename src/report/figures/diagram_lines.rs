//! Lines and points of a bifurcation diagram, without what would only be drawn twice.

use super::diagram::{Heights, Shown};

/// Most points of one value and way: a chaotic band is a band with so many.
const MOST_POINTS: usize = 10;
/// Points of one value closer than this part of an axis are one.
const APART: f64 = 0.006;
/// Heights of orbits that are one in the figure.
const LEVEL: f64 = 1e-9;

impl Shown<'_> {
    /// All pieces of one stability as one line with gaps.
    pub(super) fn lines(&self, stable: bool, heights: &Heights) -> Vec<[f64; 2]> {
        let mut line = Vec::new();
        let mut known: Vec<Vec<[f64; 2]>> = Vec::new();
        for piece in self.diagram.exact.pieces.iter().filter(|piece| piece.stable == stable) {
            let all: Vec<Vec<f64>> = piece.points.iter().map(heights.exact).collect();
            for k in 0..all.first().map_or(0, Vec::len) {
                let points = piece.points.iter().zip(&all);
                let points: Vec<[f64; 2]> =
                    points.map(|(point, all)| [self.place(point.value), all[k]]).collect();
                // Dashes over dashes would look solid.
                let Some(points) = outside(points, &known) else { continue };
                line.extend(points.iter().copied().chain([[f64::NAN; 2]]));
                known.push(points);
            }
        }
        line
    }
}

/// Heights that can be told apart, at most [`MOST_POINTS`], evenly chosen.
pub(super) fn thinned(mut heights: Vec<f64>, part: &dyn Fn(f64) -> f64) -> Vec<f64> {
    heights.retain(|height| (0.0..=1.0).contains(&part(*height)));
    heights.sort_by(f64::total_cmp);
    heights.dedup_by(|next, kept| part(*next) - part(*kept) < APART);
    if heights.len() <= MOST_POINTS {
        return heights;
    }
    let step = (heights.len() - 1) as f64 / (MOST_POINTS - 1) as f64;
    (0..MOST_POINTS).map(|k| heights[(step * k as f64) as usize]).collect()
}

/// A level line without what other level lines of its height cover already; any other line as it is.
fn outside(points: Vec<[f64; 2]>, known: &[Vec<[f64; 2]>]) -> Option<Vec<[f64; 2]>> {
    let height = points.first()?[1];
    let level = |line: &[[f64; 2]]| line.iter().all(|at| (at[1] - height).abs() < LEVEL);
    if !level(&points) {
        return Some(points);
    }
    let ends = |line: &[[f64; 2]]| {
        let low = line.iter().map(|at| at[0]).fold(f64::INFINITY, f64::min);
        [low, line.iter().map(|at| at[0]).fold(f64::NEG_INFINITY, f64::max)]
    };
    let [mut low, mut high] = ends(&points);
    for [from, to] in known.iter().filter(|line| level(line)).map(|line| ends(line)) {
        if from <= low {
            low = low.max(to);
        }
        if to >= high {
            high = high.min(from);
        }
    }
    (low < high).then(|| vec![[low, height], [high, height]])
}
