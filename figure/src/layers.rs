//! What is drawn in a panel: plain data, which the renderer multiplies by the factors of the axes.

use super::image::Image;
use super::palette::{Color, Marker, Role, Style};

/// Something drawn in a panel.
#[derive(Debug, Clone, PartialEq)]
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
    /// Cells in colours; what the colours stand for is said by [`super::Figure::keys`], or by a bar in a panel
    /// of its own.
    Image(Image),
}

impl Layer {
    /// A curve in the style of its role, or in one of its own.
    pub fn curve(style: impl Into<Style>, points: Vec<[f64; 2]>) -> Self {
        Self::Curve { points, style: style.into(), label: None }
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
    pub fn rule(rule: Rule, style: impl Into<Style>) -> Self {
        Self::Rule { rule, style: style.into(), label: None }
    }

    /// One at an abscissa.
    pub fn vertical(x: f64, style: impl Into<Style>) -> Self {
        Self::rule(Rule::Vertical(x), style)
    }

    /// One at an ordinate.
    pub fn horizontal(y: f64, style: impl Into<Style>) -> Self {
        Self::rule(Rule::Horizontal(y), style)
    }

    /// Words at a place; they move a little where they would cover something.
    pub fn note(at: [f64; 2], text: impl Into<String>) -> Self {
        Self::marked(Marker::NONE, Color::Grey, [MarkedPoint::from(at).with_label(text)])
    }

    /// The case at hand: one unmistakable mark.
    #[must_use]
    pub fn this_case(at: [f64; 2], tooltip: Option<String>) -> Self {
        let words = "this case";
        let point = MarkedPoint::from(at).with_label(words);
        let point = point.with_tooltip(tooltip.unwrap_or_else(|| words.to_owned()));
        Self::marked(Marker::THIS_CASE, Color::Black, [point])
    }

    /// Names the layer; what the colours of an image stand for is said elsewhere.
    #[must_use]
    pub fn labelled(mut self, name: impl Into<Label>) -> Self {
        if let Some(label) = self.place_of_label() {
            *label = Some(name.into());
        }
        self
    }

    /// What it is called, to be changed.
    pub fn label_mut(&mut self) -> Option<&mut Label> {
        self.place_of_label()?.as_mut()
    }

    const fn place_of_label(&mut self) -> Option<&mut Option<Label>> {
        match self {
            Self::Curve { label, .. }
            | Self::Points { label, .. }
            | Self::Band { label, .. }
            | Self::Rule { label, .. } => Some(label),
            Self::Image(_) => None,
        }
    }

    /// Whether it is [`Layer::this_case`].
    pub fn marks_case(&self) -> bool {
        matches!(self, Self::Points { marker, .. } if *marker == Marker::THIS_CASE)
    }

    /// What it is called.
    pub(super) const fn label(&self) -> Option<&Label> {
        match self {
            Self::Curve { label, .. }
            | Self::Points { label, .. }
            | Self::Band { label, .. }
            | Self::Rule { label, .. } => label.as_ref(),
            Self::Image(_) => None,
        }
    }

    /// The colour of its words.
    pub(super) const fn text_color(&self) -> &'static str {
        match self {
            Self::Curve { style, .. } | Self::Rule { style, .. } => style.color.text_hex(),
            Self::Points { color, .. } => color.text_hex(),
            Self::Band { fill, .. } => fill.color.text_hex(),
            Self::Image(_) => Color::Black.text_hex(),
        }
    }
}

/// The name of a layer. It is written beside the data where that is possible without covering
/// anything, and in a row above the panel where it is not.
#[derive(Debug, Clone, PartialEq)]
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
#[derive(Debug, Clone, PartialEq)]
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
#[derive(Debug, Clone, Copy, PartialEq)]
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
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hatch {
    /// None.
    None,
    /// Rising to the right.
    Rising,
    /// Falling to the right.
    Falling,
}

/// A straight line, in data coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
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
