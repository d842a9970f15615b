//! Which parts of a panel are taken, on a coarse raster.

use super::geometry::Rect;

/// The raster's pitch, pixels.
const PITCH: f64 = 2.0;
/// The bit of words that have been placed; layers from this number on share one bit.
const WORDS: u32 = 63;

/// One set of bits per square: one bit for each layer, one for words.
pub(super) struct Raster {
    area: Rect,
    columns: usize,
    rows: usize,
    taken: Vec<u64>,
}

/// The bit of a layer.
pub(super) fn bit(layer: usize) -> u64 {
    1 << (layer as u32).min(WORDS - 1)
}

/// The bit of words.
pub(super) const fn words() -> u64 {
    1 << WORDS
}

impl Raster {
    pub(super) fn new(area: Rect) -> Self {
        let columns = (area.width() / PITCH).ceil() as usize + 1;
        let rows = (area.height() / PITCH).ceil() as usize + 1;
        Self { area, columns, rows, taken: vec![0; columns * rows] }
    }

    /// Columns and rows that a rectangle touches.
    fn squares(&self, rect: &Rect) -> [usize; 4] {
        let index = |v: f64, origin: f64, count: usize| {
            ((v - origin) / PITCH).floor().clamp(0.0, count as f64 - 1.0) as usize
        };
        [
            index(rect.left, self.area.left, self.columns),
            index(rect.right, self.area.left, self.columns),
            index(rect.top, self.area.top, self.rows),
            index(rect.bottom, self.area.top, self.rows),
        ]
    }

    pub(super) fn take(&mut self, rect: &Rect, bit: u64) {
        let [left, right, top, bottom] = self.squares(rect);
        for row in top..=bottom {
            for square in &mut self.taken[row * self.columns + left..=row * self.columns + right] {
                *square |= bit;
            }
        }
    }

    /// Takes the squares along a line of some width.
    pub(super) fn trace(&mut self, line: &[[f64; 2]], width: f64, bit: u64) {
        for pair in line.windows(2) {
            let (a, b) = (pair[0], pair[1]);
            let steps = (libm::hypot(b[0] - a[0], b[1] - a[1]) / (0.75 * PITCH)).ceil().max(1.0);
            for step in 0..=steps as usize {
                let t = step as f64 / steps;
                let at = [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
                self.take(&Rect::around(at, width, width), bit);
            }
        }
    }

    /// Whether any of some bits is taken in a rectangle.
    pub(super) fn any(&self, rect: &Rect, bits: u64) -> bool {
        self.count(rect, bits) > 0
    }

    /// How many squares of a rectangle have any of some bits.
    pub(super) fn count(&self, rect: &Rect, bits: u64) -> usize {
        let [left, right, top, bottom] = self.squares(rect);
        (top..=bottom)
            .map(|row| {
                let row = &self.taken[row * self.columns..][left..=right];
                row.iter().filter(|square| *square & bits != 0).count()
            })
            .sum()
    }
}
