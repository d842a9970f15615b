//! A branch of the dissipation curve: motions that change continuously with the oscillator's amplitude.

use serde::Serialize;

use super::pair::PairPoint;

/// Points on either side of a place from which slopes are taken where the motion does not repeat: their scatter
/// would else be the slope.
const NEIGHBOURS: usize = 4;

/// Motions of the impact pair that follow each other.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct PairBranch {
    /// By ascending amplitude, at least two.
    pub points: Vec<PairPoint>,
    /// Whether it is the manifold's stable branch, in closed form.
    pub closed_form: bool,
}

impl PairBranch {
    /// Its smallest and its largest amplitude.
    pub fn range(&self) -> [f64; 2] {
        let [first, .., last] = &self.points[..] else { return [f64::NAN; 2] };
        [first.amplitude, last.amplitude]
    }

    /// Whether an amplitude is on it.
    pub fn covers(&self, amplitude: f64) -> bool {
        let [from, to] = self.range();
        (from..=to).contains(&amplitude)
    }

    /// The points on either side of an amplitude, by the number of the first.
    fn piece(&self, amplitude: f64) -> usize {
        let after = self.points.partition_point(|point| point.amplitude <= amplitude);
        after.clamp(1, self.points.len() - 1) - 1
    }

    /// `S` and `K` at an amplitude on the branch, linear between points, and their errors: those of the points, and
    /// of the interpolation by the bend between neighbouring pieces. None outside.
    pub fn forces(&self, amplitude: f64) -> Option<([f64; 2], [f64; 2])> {
        let at = self.piece(amplitude);
        let [from, to] = [&self.points[at], &self.points[at + 1]];
        let part = (amplitude - from.amplitude) / (to.amplitude - from.amplitude);
        let force = |k: usize| from.forces()[k] * (1.0 - part) + to.forces()[k] * part;
        let error = |k: usize| from.errors[k].max(to.errors[k]) + self.bend(at, k);
        self.covers(amplitude).then(|| ([0, 1].map(force), [0, 1].map(error)))
    }

    /// Largest distance of a parabola from the chord of a piece, an eighth of its second derivative times the
    /// squared length, from the slopes of the pieces beside it.
    fn bend(&self, at: usize, k: usize) -> f64 {
        let length = |at: usize| self.points[at + 1].amplitude - self.points[at].amplitude;
        let slope = |at: usize| self.piece_slopes(at)[k];
        let beside = [at.checked_sub(1), Some(at + 1).filter(|next| next + 1 < self.points.len())];
        let second =
            |beside: usize| (slope(beside) - slope(at)) / (0.5 * (length(beside) + length(at)));
        let second = beside.into_iter().flatten().map(|beside| second(beside).abs());
        second.fold(0.0, f64::max) * length(at) * length(at) / 8.0
    }

    /// `dS/dc` and `dK/dc` between a point and the next.
    pub(super) fn piece_slopes(&self, at: usize) -> [f64; 2] {
        let [from, to] = [&self.points[at], &self.points[at + 1]];
        let length = to.amplitude - from.amplitude;
        [0, 1].map(|k| (to.forces()[k] - from.forces()[k]) / length)
    }

    /// `dS/dc` and `dK/dc` at an amplitude: of the piece, or of the line through the points around it where the
    /// motion does not repeat.
    pub fn slopes(&self, amplitude: f64) -> [f64; 2] {
        let at = self.piece(amplitude);
        if self.points[at..=at + 1].iter().all(|point| point.repeats_after.is_some()) {
            return self.piece_slopes(at);
        }
        let from = (at + 1).saturating_sub(NEIGHBOURS);
        let points = &self.points[from..(at + 1 + NEIGHBOURS).min(self.points.len())];
        let count = points.len() as f64;
        let middle = points.iter().map(|point| point.amplitude).sum::<f64>() / count;
        let spread: f64 = points
            .iter()
            .map(|point| (point.amplitude - middle) * (point.amplitude - middle))
            .sum();
        let slope = |k: usize| {
            points.iter().map(|point| (point.amplitude - middle) * point.forces()[k]).sum::<f64>()
                / spread
        };
        [0, 1].map(slope)
    }
}
