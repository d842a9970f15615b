//! What a figure is: plain data, and axes that know the unit of their labels.

use super::colors::Tint;
use super::layers::Layer;

/// A figure: one or more panels, and the words that go with them.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// The file's stem.
    pub name: String,
    /// The accessible title, first child of the SVG; it is not drawn.
    pub title: String,
    /// What to see, for print below the figure; it is not drawn.
    pub caption: String,
    /// What to see, for those who cannot see the figure; it is not drawn.
    pub alt: String,
    /// What title, caption and alternative text are made from; none where they are set.
    pub facts: Option<CaptionFacts>,
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// The panels, in the order of the layout's cells.
    pub panels: Vec<Panel>,
    /// Where the panels go; side by side where nothing is said.
    pub layout: Option<Layout>,
    /// What the tints of its images stand for, in rows above all panels.
    pub keys: Vec<Key>,
}

/// What a figure's words are made from.
#[derive(Debug, Clone, PartialEq)]
pub struct CaptionFacts {
    /// A template whose first three lines are title, caption and alternative text.
    pub template: &'static str,
    /// What it gets.
    pub data: serde_json::Value,
}

/// A tint and what it stands for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Key {
    /// The tint.
    pub tint: Tint,
    /// What it stands for.
    pub label: String,
}

impl From<(Tint, &str)> for Key {
    fn from((tint, label): (Tint, &str)) -> Self {
        Self { tint, label: label.to_owned() }
    }
}

impl Figure {
    /// A figure of the usual size, without panels yet.
    pub fn new(name: impl Into<String>, title: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            title: title.into(),
            caption: String::new(),
            alt: String::new(),
            facts: None,
            size: (720, 450),
            panels: Vec::new(),
            layout: None,
            keys: Vec::new(),
        }
    }

    /// Leaves title, caption and alternative text to a template, which gets the data.
    #[must_use]
    pub fn with_facts(mut self, template: &'static str, data: serde_json::Value) -> Self {
        self.facts = Some(CaptionFacts { template, data });
        self
    }

    /// Sets the size in pixels.
    #[must_use]
    pub fn with_size(mut self, width: u32, height: u32) -> Self {
        self.size = (width, height);
        self
    }

    /// Sets the layout.
    #[must_use]
    pub fn with_layout(mut self, layout: Layout) -> Self {
        self.layout = Some(layout);
        self
    }

    /// Adds a panel.
    #[must_use]
    pub fn with_panel(mut self, panel: Panel) -> Self {
        self.panels.push(panel);
        self
    }

    /// Takes the mark of the case out of the first panel, for whoever draws it themselves: where it was.
    pub fn take_case(&mut self) -> Option<[f64; 2]> {
        let layers = &mut self.panels.first_mut()?.layers;
        let index = layers.iter().position(|layer| layer.marks_case())?;
        match layers.remove(index) {
            Layer::Points { points, .. } => points.first().map(|point| [point.x, point.y]),
            _ => None,
        }
    }
}

/// Where the panels go. Panels one above the other whose x axes have the same label and scale share
/// that axis: one range, and the words only at the lowest.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// Relative widths of the columns.
    pub widths: Vec<f64>,
    /// Relative heights of the rows.
    pub heights: Vec<f64>,
    /// One cell for each panel.
    pub cells: Vec<GridCell>,
}

impl Layout {
    /// A grid with relative widths of its columns and heights of its rows, and for each panel the first column
    /// and row of its cell and how many it takes.
    #[must_use]
    pub fn cells(widths: &[f64], heights: &[f64], cells: &[[usize; 4]]) -> Self {
        let cell = |[column, row, columns, rows]: &[usize; 4]| GridCell {
            column: *column,
            row: *row,
            columns: *columns,
            rows: *rows,
        };
        let cells = cells.iter().map(cell).collect();
        Self { widths: widths.to_vec(), heights: heights.to_vec(), cells }
    }

    /// Panels side by side, with these relative widths.
    #[must_use]
    pub fn columns(widths: &[f64]) -> Self {
        let cells: Vec<[usize; 4]> = (0..widths.len()).map(|column| [column, 0, 1, 1]).collect();
        Self::cells(widths, &[1.0], &cells)
    }

    /// Panels one above the other, with these relative heights.
    #[must_use]
    pub fn rows(heights: &[f64]) -> Self {
        let cells: Vec<[usize; 4]> = (0..heights.len()).map(|row| [0, row, 1, 1]).collect();
        Self::cells(&[1.0], heights, &cells)
    }
}

/// A rectangle of grid cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct GridCell {
    /// First column, from 0.
    pub column: usize,
    /// First row, from 0 at the top.
    pub row: usize,
    /// Number of columns.
    pub columns: usize,
    /// Number of rows.
    pub rows: usize,
}

/// One pair of axes and what is drawn between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// What is drawn, from the back to the front.
    pub layers: Vec<Layer>,
    /// Whether one unit is equally long on both axes.
    pub equal_aspect: bool,
    /// A few words above the panel.
    pub heading: Option<String>,
}

impl Panel {
    /// An empty panel.
    #[must_use]
    pub const fn new(x: Axis, y: Axis) -> Self {
        Self { x, y, layers: Vec::new(), equal_aspect: false, heading: None }
    }

    /// Adds a layer in front of the others.
    #[must_use]
    pub fn with(mut self, layer: Layer) -> Self {
        self.layers.push(layer);
        self
    }

    /// Makes one unit equally long on both axes.
    #[must_use]
    pub fn with_equal_aspect(mut self) -> Self {
        self.equal_aspect = true;
        self
    }

    /// Sets the words above the panel.
    #[must_use]
    pub fn with_heading(mut self, heading: impl Into<String>) -> Self {
        self.heading = Some(heading.into());
        self
    }
}

/// An axis. The data may be in another unit than the label: the renderer multiplies what is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Name, symbol and unit: `clearance b (mm)`.
    pub label: String,
    /// What a number of the data is multiplied by to be in the unit of the label.
    pub factor: f64,
    /// First and last value, as the data have them; chosen from the data if absent.
    pub range: Option<(f64, f64)>,
    /// Linear or logarithmic.
    pub scale: AxisScale,
    /// The ticks, in the unit of the label; chosen round if absent.
    pub ticks: Option<Vec<Tick>>,
}

impl Axis {
    /// A linear axis that fits the data.
    pub fn linear(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            factor: 1.0,
            range: None,
            scale: AxisScale::Linear,
            ticks: None,
        }
    }

    /// A logarithmic axis that fits the data.
    pub fn log(label: impl Into<String>) -> Self {
        Self::linear(label).with_scale(AxisScale::Log)
    }

    /// Sets the scale.
    #[must_use]
    pub const fn with_scale(mut self, scale: AxisScale) -> Self {
        self.scale = scale;
        self
    }

    /// Sets what a number of the data is multiplied by to be in the unit of the label.
    #[must_use]
    pub const fn with_factor(mut self, factor: f64) -> Self {
        self.factor = factor;
        self
    }

    /// Fixes the range.
    #[must_use]
    pub const fn with_range(mut self, first: f64, last: f64) -> Self {
        self.range = Some((first, last));
        self
    }

    /// An axis without a label, with these ticks alone.
    #[must_use]
    pub fn of_ticks((first, last): (f64, f64), ticks: Vec<Tick>) -> Self {
        Self { ticks: Some(ticks), ..Self::linear("").with_range(first, last) }
    }
}

/// How values become lengths.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisScale {
    /// In proportion.
    Linear,
    /// By their decimal logarithm; values at or below 0 are not drawn.
    Log,
}

/// A tick at a given value.
#[derive(Debug, Clone, PartialEq)]
pub struct Tick {
    /// Where.
    pub value: f64,
    /// What to write; nothing beside a minor tick.
    pub label: Option<String>,
}

impl Tick {
    /// What is written beside it.
    pub(super) fn words(&self) -> &str {
        self.label.as_deref().unwrap_or_default()
    }
}
