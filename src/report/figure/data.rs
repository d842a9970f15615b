//! What a figure is: plain data, in the units of its axes.

use serde::Serialize;

use super::palette::{Color, Marker, Role, Style};

/// A figure: one or more panels, and the words that go with them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Figure {
    /// The file's stem.
    pub name: String,
    /// The accessible title, first child of the SVG; it is not drawn.
    pub title: String,
    /// What to see, for print below the figure; it is not drawn.
    pub caption: String,
    /// What to see, for those who cannot see the figure; it is not drawn.
    pub alt: String,
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// The panels, in the order of the layout's cells.
    pub panels: Vec<Panel>,
    /// Where the panels go.
    pub layout: Layout,
}

impl Figure {
    /// A figure of the usual size, without panels yet.
    pub fn new(name: impl Into<String>, title: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            title: title.into(),
            caption: String::new(),
            alt: String::new(),
            size: (720, 450),
            panels: Vec::new(),
            layout: Layout::Row,
        }
    }

    /// Sets the caption and the alternative text.
    #[must_use]
    pub fn with_words(mut self, caption: impl Into<String>, alt: impl Into<String>) -> Self {
        self.caption = caption.into();
        self.alt = alt.into();
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
        self.layout = layout;
        self
    }

    /// Adds a panel.
    #[must_use]
    pub fn with_panel(mut self, panel: Panel) -> Self {
        self.panels.push(panel);
        self
    }
}

/// Where the panels go. Panels one above the other whose x axes have the same label and scale share
/// that axis: one range, and the words only at the lowest.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Layout {
    /// Side by side; also right for a single panel.
    Row,
    /// One above the other.
    Column,
    /// Row by row, with that many columns.
    Grid {
        /// The number of columns.
        columns: usize,
    },
    /// All panels but the last one above the other on the left, the last one on the right over the full height.
    TimeSeriesAndProjection,
    /// Anything else.
    Cells {
        /// Relative widths of the columns.
        widths: Vec<f64>,
        /// Relative heights of the rows.
        heights: Vec<f64>,
        /// One cell for each panel.
        cells: Vec<Cell>,
    },
}

/// A rectangle of grid cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Cell {
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
#[derive(Debug, Clone, PartialEq, Serialize)]
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

/// An axis.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Axis {
    /// Name, symbol and unit: `clearance b (mm)`.
    pub label: String,
    /// First and last value; chosen from the data if absent.
    pub range: Option<(f64, f64)>,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// The ticks; chosen round if absent.
    pub ticks: Option<Vec<Tick>>,
}

impl Axis {
    /// A linear axis that fits the data.
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), range: None, scale: Scale::Linear, ticks: None }
    }

    /// A logarithmic axis that fits the data.
    pub fn log(label: impl Into<String>) -> Self {
        Self { scale: Scale::Log, ..Self::linear(label) }
    }

    /// Fixes the range.
    #[must_use]
    pub const fn with_range(mut self, first: f64, last: f64) -> Self {
        self.range = Some((first, last));
        self
    }

    /// Fixes the ticks.
    #[must_use]
    pub fn with_ticks(mut self, ticks: Vec<Tick>) -> Self {
        self.ticks = Some(ticks);
        self
    }
}

/// How values become lengths.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Scale {
    /// In proportion.
    Linear,
    /// By their decimal logarithm; values at or below 0 are not drawn.
    Log,
}

/// A tick at a given value.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Tick {
    /// Where.
    pub value: f64,
    /// What to write; the number itself if absent.
    pub label: Option<String>,
}

/// Something drawn in a panel.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum Layer {
    /// A line through points; a value that is not finite interrupts it.
    Curve {
        /// The points, `[x, y]`.
        points: Vec<[f64; 2]>,
        /// How it looks.
        style: Style,
        /// What it is called.
        label: Option<Label>,
    },
    /// Separate points.
    Points {
        /// The points.
        points: Vec<MarkedPoint>,
        /// How each looks.
        marker: Marker,
        /// In which colour.
        color: Color,
        /// What they are called.
        label: Option<Label>,
    },
    /// A shaded area.
    Band {
        /// The corners, `[x, y]`; the last is joined to the first.
        outline: Vec<[f64; 2]>,
        /// How it is filled.
        fill: Fill,
        /// What it is called.
        label: Option<Label>,
    },
    /// A straight line across the whole panel.
    Rule {
        /// Where.
        rule: Rule,
        /// How it looks.
        style: Style,
        /// What it is called.
        label: Option<Label>,
    },
    /// Words at a place; they move a little where they would cover something.
    Note {
        /// The middle of the words.
        at: [f64; 2],
        /// The words.
        text: String,
        /// Their colour.
        color: Color,
    },
    /// The case at hand: one unmistakable mark.
    ThisCase {
        /// Where.
        at: [f64; 2],
        /// Shown on hovering.
        tooltip: Option<String>,
    },
}

impl Layer {
    /// A curve in the style of its role.
    #[must_use]
    pub const fn curve(role: Role, points: Vec<[f64; 2]>) -> Self {
        Self::Curve { points, style: role.style(), label: None }
    }

    /// A curve in a style of its own.
    #[must_use]
    pub const fn styled(style: Style, points: Vec<[f64; 2]>) -> Self {
        Self::Curve { points, style, label: None }
    }

    /// Points with the marker and colour of their role.
    pub fn points<P: Into<MarkedPoint>>(role: Role, points: impl IntoIterator<Item = P>) -> Self {
        let points = points.into_iter().map(Into::into).collect();
        Self::Points { points, marker: role.marker(), color: role.color(), label: None }
    }

    /// Points with a marker and a colour of their own.
    pub fn marked<P: Into<MarkedPoint>>(
        marker: Marker,
        color: Color,
        points: impl IntoIterator<Item = P>,
    ) -> Self {
        let points = points.into_iter().map(Into::into).collect();
        Self::Points { points, marker, color, label: None }
    }

    /// The area between two curves with the same abscissae or not.
    #[must_use]
    pub fn between(lower: &[[f64; 2]], upper: &[[f64; 2]], fill: Fill) -> Self {
        let outline = lower.iter().chain(upper.iter().rev()).copied().collect();
        Self::Band { outline, fill, label: None }
    }

    /// A straight line across the whole panel.
    #[must_use]
    pub const fn rule(rule: Rule, style: Style) -> Self {
        Self::Rule { rule, style, label: None }
    }

    /// Words at a place.
    pub fn note(at: [f64; 2], text: impl Into<String>) -> Self {
        Self::Note { at, text: text.into(), color: Color::Grey }
    }

    /// The case at hand.
    #[must_use]
    pub const fn this_case(at: [f64; 2], tooltip: Option<String>) -> Self {
        Self::ThisCase { at, tooltip }
    }

    /// Names the layer; notes and the case at hand have their words already and stay as they are.
    #[must_use]
    pub fn labelled(mut self, name: impl Into<Label>) -> Self {
        match &mut self {
            Self::Curve { label, .. }
            | Self::Points { label, .. }
            | Self::Band { label, .. }
            | Self::Rule { label, .. } => *label = Some(name.into()),
            Self::Note { .. } | Self::ThisCase { .. } => {}
        }
        self
    }
}

/// The name of a layer. It is written beside the data where that is possible without covering
/// anything, and in a row above the panel where it is not.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Label {
    /// The words.
    pub text: String,
    /// A place to prefer, `[x, y]`.
    pub near: Option<[f64; 2]>,
}

impl Label {
    /// A label that prefers to be near a place, `[x, y]`.
    pub fn near(text: impl Into<String>, place: [f64; 2]) -> Self {
        Self { text: text.into(), near: Some(place) }
    }
}

impl From<&str> for Label {
    fn from(text: &str) -> Self {
        Self { text: text.to_owned(), near: None }
    }
}

impl From<String> for Label {
    fn from(text: String) -> Self {
        Self { text, near: None }
    }
}

/// A point with what can be said about it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MarkedPoint {
    /// Abscissa.
    pub x: f64,
    /// Ordinate.
    pub y: f64,
    /// Shown on hovering.
    pub tooltip: Option<String>,
    /// Written beside it.
    pub label: Option<String>,
}

impl MarkedPoint {
    /// A point without words.
    #[must_use]
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y, tooltip: None, label: None }
    }

    /// Sets what is shown on hovering.
    #[must_use]
    pub fn with_tooltip(mut self, tooltip: impl Into<String>) -> Self {
        self.tooltip = Some(tooltip.into());
        self
    }

    /// Sets what is written beside it.
    #[must_use]
    pub fn with_label(mut self, label: impl Into<String>) -> Self {
        self.label = Some(label.into());
        self
    }
}

impl From<[f64; 2]> for MarkedPoint {
    fn from([x, y]: [f64; 2]) -> Self {
        Self::new(x, y)
    }
}

/// How an area is filled.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Fill {
    /// Its colour.
    pub color: Color,
    /// From 0, invisible, to 1.
    pub opacity: f64,
    /// Plain, or hatched so that two areas differ in grey as well.
    pub hatch: Hatch,
}

impl Fill {
    /// A plain tint.
    #[must_use]
    pub const fn tint(color: Color) -> Self {
        Self { color, opacity: 0.22, hatch: Hatch::None }
    }

    /// A tint with lines across.
    #[must_use]
    pub const fn hatched(color: Color, hatch: Hatch) -> Self {
        Self { color, opacity: 0.12, hatch }
    }
}

/// Lines across an area.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Hatch {
    /// None.
    None,
    /// Rising to the right.
    Rising,
    /// Falling to the right.
    Falling,
}

/// A straight line, in data coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Rule {
    /// At one ordinate.
    Horizontal(f64),
    /// At one abscissa.
    Vertical(f64),
    /// Through a point with a slope, on linear axes.
    Sloped {
        /// The point, `[x, y]`.
        through: [f64; 2],
        /// The slope, ordinate per abscissa.
        slope: f64,
    },
}
