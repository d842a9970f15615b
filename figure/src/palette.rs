//! Colours, strokes and markers, and the roles that tie them together.
//!
//! The palette is Okabe and Ito's, which readers with any common colour vision can tell apart. A
//! [`Role`] fixes colour, stroke and marker at once, so that a figure printed in grey says the same.

/// A colour of the Okabe-Ito palette, and the two greys of the background.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Color {
    /// `#000000`.
    Black,
    /// `#E69F00`.
    Orange,
    /// `#56B4E9`.
    SkyBlue,
    /// `#009E73`.
    BluishGreen,
    /// `#F0E442`; too light for lines, made for areas.
    Yellow,
    /// `#0072B2`.
    Blue,
    /// `#D55E00`.
    Vermillion,
    /// `#CC79A7`.
    ReddishPurple,
    /// A grey for what only serves comparison.
    Grey,
    /// A light grey for rules and areas in the background.
    Light,
    /// White, below a line that crosses tints.
    White,
}

impl Color {
    /// The colour as an SVG attribute's value.
    #[must_use]
    pub const fn hex(self) -> &'static str {
        self.codes()[0]
    }

    /// The same hue, dark enough for text on white (contrast at least 4.5 to 1).
    #[must_use]
    pub const fn text_hex(self) -> &'static str {
        self.codes()[1]
    }

    const fn codes(self) -> [&'static str; 2] {
        match self {
            Self::Black => ["#000000", "#000000"],
            Self::Orange => ["#E69F00", "#8F5F00"],
            Self::SkyBlue => ["#56B4E9", "#1B6FA3"],
            Self::BluishGreen => ["#009E73", "#007353"],
            Self::Yellow => ["#F0E442", "#6B6400"],
            Self::Blue => ["#0072B2", "#0067A1"],
            Self::Vermillion => ["#D55E00", "#B24E00"],
            Self::ReddishPurple => ["#CC79A7", "#9C4478"],
            Self::Grey => ["#6E6E6E", "#5A5A5A"],
            Self::Light => ["#B8B8B8", "#5A5A5A"],
            Self::White => ["#FFFFFF", "#5A5A5A"],
        }
    }
}

/// How a line is interrupted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dash {
    /// Not at all.
    Solid,
    /// Dashes.
    Dashed,
    /// Long dashes.
    LongDashed,
    /// Dots.
    Dotted,
    /// Dashes and dots in turn.
    DashDot,
}

impl Dash {
    /// Dash and gap lengths in tenths of a pixel; none for a solid line.
    pub(super) const fn tenths(self) -> &'static str {
        match self {
            Self::Solid => "",
            Self::Dashed => "50 35",
            Self::LongDashed => "100 40",
            Self::Dotted => "15 30",
            Self::DashDot => "90 30 18 30",
        }
    }
}

/// How a line looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Style {
    /// Its colour.
    pub color: Color,
    /// Its width in pixels.
    pub width: f64,
    /// Its dashes.
    pub dash: Dash,
}

impl Style {
    /// A style from its three parts.
    #[must_use]
    pub const fn new(color: Color, width: f64, dash: Dash) -> Self {
        Self { color, width, dash }
    }

    /// The same style in another colour, for families of curves that share their roles.
    #[must_use]
    pub const fn colored(self, color: Color) -> Self {
        Self { color, ..self }
    }
}

impl From<Role> for Style {
    fn from(role: Role) -> Self {
        role.style()
    }
}

/// The outline of a marker.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// A circle.
    Circle,
    /// A square.
    Square,
    /// A triangle that points up.
    Triangle,
    /// A diamond.
    Diamond,
    /// A diagonal cross.
    Cross,
    /// A star with five points, for the case at hand alone.
    Star,
}

/// How a point looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Marker {
    /// Its outline.
    pub shape: Shape,
    /// Filled with its colour, or hollow (white inside). A cross is two strokes either way.
    pub filled: bool,
    /// Its diameter in pixels.
    pub diameter: f64,
}

impl Marker {
    /// None: the words of a point stand on its place.
    pub const NONE: Self = Self::dot().sized(0.0);
    /// The case at hand.
    pub const THIS_CASE: Self = Self::filled(Shape::Star).sized(18.0);

    /// A filled marker of the usual size.
    #[must_use]
    pub const fn filled(shape: Shape) -> Self {
        Self { shape, filled: true, diameter: 7.0 }
    }

    /// A hollow marker of the usual size.
    #[must_use]
    pub const fn hollow(shape: Shape) -> Self {
        Self { shape, filled: false, diameter: 7.5 }
    }

    /// A small dot, for clouds of points.
    #[must_use]
    pub const fn dot() -> Self {
        Self { shape: Shape::Circle, filled: true, diameter: 3.2 }
    }

    /// The same marker in another size.
    #[must_use]
    pub const fn sized(self, diameter: f64) -> Self {
        Self { diameter, ..self }
    }
}

/// What a curve or a point stands for; it decides how it looks, unless a figure colours by family.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// A stable branch: thick and solid.
    Stable,
    /// An unstable branch: thin and dashed.
    Unstable,
    /// Direct simulation: dots, or a thin solid line.
    Simulation,
    /// An exact periodic orbit: hollow circles.
    ExactOrbit,
    /// The boundary on which two fixed points collide: dashed.
    SaddleNode,
    /// The boundary on which a fixed point reaches the fold: solid.
    Hopf,
    /// The boundary on which two impacts per period turn asymmetric: dash-dot.
    SymmetryBreaking,
    /// The oscillator without absorber: grey, dotted.
    BareOscillator,
    /// What drives the oscillator: orange, long dashes.
    Forcing,
    /// An impact: a small filled diamond.
    Impact,
    /// A rule or a line that only guides the eye.
    Guide,
}

impl Role {
    /// The line for this role.
    #[must_use]
    pub const fn style(self) -> Style {
        match self {
            Self::Stable => Style::new(Color::Blue, 2.6, Dash::Solid),
            Self::Unstable => Style::new(Color::Vermillion, 1.3, Dash::Dashed),
            Self::Simulation => Style::new(Color::ReddishPurple, 1.1, Dash::Solid),
            Self::ExactOrbit => Style::new(Color::Black, 1.3, Dash::Solid),
            Self::SaddleNode => Style::new(Color::Vermillion, 1.8, Dash::Dashed),
            Self::Hopf => Style::new(Color::Blue, 1.8, Dash::Solid),
            Self::SymmetryBreaking => Style::new(Color::BluishGreen, 1.8, Dash::DashDot),
            Self::BareOscillator => Style::new(Color::Grey, 1.6, Dash::Dotted),
            Self::Forcing => Style::new(Color::Orange, 1.4, Dash::LongDashed),
            Self::Impact => Style::new(Color::Vermillion, 1.1, Dash::Solid),
            Self::Guide => Style::new(Color::Light, 1.1, Dash::Solid),
        }
    }

    /// The colour for this role.
    #[must_use]
    pub const fn color(self) -> Color {
        self.style().color
    }

    /// The marker for this role.
    #[must_use]
    pub const fn marker(self) -> Marker {
        match self {
            Self::Simulation => Marker::dot().sized(5.4),
            Self::ExactOrbit | Self::Hopf => Marker::hollow(Shape::Circle),
            Self::SaddleNode => Marker::filled(Shape::Cross),
            Self::SymmetryBreaking => Marker::hollow(Shape::Triangle),
            Self::BareOscillator | Self::Forcing => Marker::hollow(Shape::Square),
            Self::Impact => Marker::filled(Shape::Diamond).sized(5.0),
            Self::Stable | Self::Guide => Marker::filled(Shape::Circle),
            Self::Unstable => Marker::hollow(Shape::Diamond),
        }
    }
}
