//! A figure for the screen of a phone.

use super::data::{Figure, GridCell, Layout};
use super::layers::Layer;
use super::text::{SMALL, width};

/// Height of a panel in a narrow figure over that in the usual one, where it has all of it, and the least, pixels.
const NARROW: f64 = 0.75;
const LEAST_PANEL: f64 = 130.0;
/// The widest words in the legend of a narrow figure, pixels.
const LONGEST_LABEL: f64 = 270.0;

impl Figure {
    /// The same for the screen of a phone: 400 pixels wide, its panels one above the other, words as large as before. None of
    /// one that is nothing but bars, or whose legend has words for which that is too little.
    pub fn narrow(&self) -> Option<Self> {
        let all = self.layout.clone();
        let all = all.unwrap_or_else(|| Layout::columns(&vec![1.0; self.panels.len()]));
        let whole: f64 = all.heights.iter().sum();
        // One that has the whole height may become as flat as it becomes narrow.
        let room = |rows: usize| if rows == all.heights.len() { NARROW } else { 1.0 };
        let height = |cell: &GridCell| {
            let rows = all.heights.iter().skip(cell.row).take(cell.rows);
            let share = room(cell.rows) * rows.sum::<f64>() / whole;
            (share * f64::from(self.size.1)).max(LEAST_PANEL)
        };
        let heights: Vec<f64> = all.cells.iter().map(height).collect();
        let layers = self.panels.iter().flat_map(|panel| &panel.layers).filter_map(Layer::label);
        let words = layers.map(|label| &label.text).chain(self.keys.iter().map(|key| &key.label));
        let fits = words.map(|words| width(words, SMALL)).all(|wide| wide < LONGEST_LABEL);
        let high = heights.iter().any(|height| *height > 1.2 * LEAST_PANEL);
        let total = heights.iter().sum::<f64>() as u32;
        let narrow = || self.clone().with_layout(Layout::rows(&heights)).with_size(400, total);
        (fits && high).then(narrow)
    }
}
