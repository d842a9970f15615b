//! Which parts of a panel are taken, on a coarse raster.

use core::ops::RangeInclusive;

use super::geometry::{Point, Rect, distance, lerp};

/// The raster's pitch, pixels.
const PITCH: f64 = 2.0;
/// The bit of words that have been placed.
pub(super) const WORDS: u64 = 1 << 63;

/// One set of bits per square: one bit for each layer, one for words.
pub(super) struct Raster {
    area: Rect,
    columns: usize,
    taken: Vec<u64>,
}

/// The bit of a layer; those from the 63rd on share one.
pub(super) fn bit(layer: usize) -> u64 {
    1 << layer.min(62)
}

/// Squares of some width along a line.
fn along(line: &[Point], width: f64) -> impl Iterator<Item = Rect> {
    line.windows(2).flat_map(move |pair| {
        let steps = (distance(pair[0], pair[1]) / (0.75 * PITCH)).ceil().max(1.0);
        (0..=steps as usize).map(move |step| {
            Rect::around(lerp(pair[0], pair[1], step as f64 / steps), width, width)
        })
    })
}

impl Raster {
    pub(super) fn new(area: Rect) -> Self {
        let [columns, rows] =
            [area.width(), area.height()].map(|length| (length / PITCH).ceil() as usize + 1);
        Self { area, columns, taken: vec![0; columns * rows] }
    }

    /// Where the squares that a rectangle touches are, row by row.
    fn rows(&self, rect: &Rect) -> impl Iterator<Item = RangeInclusive<usize>> + use<> {
        let columns = self.columns;
        let index = |v: f64, origin: f64, count: usize| {
            ((v - origin) / PITCH).clamp(0.0, count as f64 - 1.0) as usize
        };
        let [left, right] = [rect.left, rect.right].map(|x| index(x, self.area.left, columns));
        let count = self.taken.len() / columns;
        let [top, bottom] = [rect.top, rect.bottom].map(|y| index(y, self.area.top, count));
        (top..=bottom).map(move |row| row * columns + left..=row * columns + right)
    }

    pub(super) fn take(&mut self, rect: &Rect, bit: u64) {
        for row in self.rows(rect) {
            self.taken[row].iter_mut().for_each(|square| *square |= bit);
        }
    }

    /// Takes the squares along a line of some width.
    pub(super) fn trace(&mut self, line: &[Point], width: f64, bit: u64) {
        for square in along(line, width) {
            self.take(&square, bit);
        }
    }

    /// Whether any of some bits is taken in a rectangle.
    pub(super) fn any(&self, rect: &Rect, bits: u64) -> bool {
        self.rows(rect).any(|row| self.taken[row].iter().any(|square| square & bits != 0))
    }

    /// Whether words are on a thin line.
    pub(super) fn words_on(&self, line: &[Point]) -> bool {
        along(line, 1.0).any(|square| self.any(&square, WORDS))
    }

    /// How many squares of a rectangle have any of some bits, for each set of bits.
    pub(super) fn count<const N: usize>(&self, rect: &Rect, bits: [u64; N]) -> [usize; N] {
        let mut counts = [0; N];
        for row in self.rows(rect) {
            for (count, bits) in counts.iter_mut().zip(bits) {
                // Without a branch, several squares at a time: the highest bit of `x | -x` tells whether there is any.
                let one = |square: &u64| (square & bits | (square & bits).wrapping_neg()) >> 63;
                *count += self.taken[row.clone()].iter().map(one).sum::<u64>() as usize;
            }
        }
        counts
    }
}
