//! From a figure to its file.

use super::data::{AxisScale, Figure};
use super::frame;
use super::geometry::Rect;
use super::image;
use super::labels::{Labels, place};
use super::layers::Layer;
use super::layout::{Frame, GAP, KEY, KEYS_FROM, key_places, lay_out};
use super::limits::Span;
use super::paint;
use super::shapes::shapes;
use super::text::{self, Anchor, FAMILY, SMALL, Words, escape};

/// No file is larger than this, bytes.
pub const LIMIT: usize = 150_000;
/// Each time the file is too large, this many times more detail is left out.
const COARSER: f64 = 2.0;
/// How often; beyond, the picture would be wrong rather than coarse.
const ATTEMPTS: usize = 5;
/// How often names that found no place go to the legend, which makes the plot smaller.
const ROUNDS: usize = 4;

/// Why a figure could not be drawn.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("figure {figure}: {reason}")]
pub struct FigureError {
    /// The figure's name.
    pub figure: String,
    /// What is wrong with it, and what helps.
    pub reason: String,
}

impl FigureError {
    pub(super) fn new(figure: &str, reason: impl Into<String>) -> Self {
        Self { figure: figure.to_owned(), reason: reason.into() }
    }
}

/// A drawn figure and where its words are.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// The whole file.
    pub svg: String,
    /// Every piece of text with the room it takes, in pixels of [`Figure::size`], cautiously estimated.
    pub texts: Vec<PlacedText>,
    /// The panels in their order.
    pub panels: Vec<PlacedPanel>,
}

/// Where the data of a panel are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlacedPanel {
    /// The rectangle between the axes, pixels.
    pub room: Rect,
    /// First and last value of each axis, across and up, as the data have them, and whether it is logarithmic.
    pub axes: [(f64, f64, bool); 2],
}

/// Words and the room they take.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedText {
    /// The words.
    pub text: String,
    /// Their room, pixels.
    pub room: Rect,
}

/// Draws a figure as a complete SVG file.
///
/// # Errors
/// [`FigureError`] says what is wrong with the figure.
pub fn render(figure: &Figure) -> Result<String, FigureError> {
    draw(figure).map(|drawing| drawing.svg)
}

/// Draws a figure and tells where its words are.
///
/// # Errors
/// [`FigureError`] says what is wrong with the figure.
pub fn draw(figure: &Figure) -> Result<Drawing, FigureError> {
    let (frames, labels) = arrange(figure)?;
    let (mut coarseness, mut bytes) = (1.0, 0);
    for _ in 0..ATTEMPTS {
        let drawing = compose(figure, &frames, &labels, coarseness);
        bytes = drawing.svg.len();
        if bytes <= LIMIT {
            return Ok(drawing);
        }
        coarseness *= COARSER;
    }
    let reason = format!("takes {bytes} bytes, {LIMIT} are allowed; draw fewer points");
    Err(FigureError::new(&figure.name, reason))
}

/// Places panels and names; names without a place go to legends until all others have one.
fn arrange(figure: &Figure) -> Result<(Vec<Frame>, Vec<Labels>), FigureError> {
    let mut legends: Vec<Vec<usize>> = vec![Vec::new(); figure.panels.len()];
    for round in 1.. {
        let frames = lay_out(figure, &legends)?;
        let panels = figure.panels.iter().zip(&frames);
        let labels: Vec<Labels> =
            panels.map(|(panel, frame)| place(panel, frame, &shapes(panel, frame, 1.0))).collect();
        if labels.iter().all(|l| l.homeless.is_empty()) {
            return Ok((frames, labels));
        }
        for ((legend, labels), panel) in legends.iter_mut().zip(&labels).zip(&figure.panels) {
            let all = 0..panel.layers.len();
            if round < ROUNDS {
                legend.extend(&labels.homeless);
                legend.sort_unstable();
            } else {
                *legend = all.filter(|i| panel.layers[*i].label().is_some()).collect();
            }
        }
    }
    unreachable!("with all names in legends, none is without a place")
}

fn compose(figure: &Figure, frames: &[Frame], labels: &[Labels], coarseness: f64) -> Drawing {
    let mut svg = head(figure) + &frame::draw(figure, frames);
    let mut words: Vec<Words> = frames.iter().flat_map(|frame| frame.words.clone()).collect();
    for ((panel, frame), labels) in figure.panels.iter().zip(frames).zip(labels) {
        let shapes = shapes(panel, frame, coarseness);
        for (layer, shape) in panel.layers.iter().zip(&shapes) {
            match layer {
                Layer::Image(image) => image::write(&mut svg, image, frame, coarseness),
                _ => paint::layer(&mut svg, layer, shape),
            }
        }
        for ends in &labels.leaders {
            paint::leader(&mut svg, *ends);
        }
        words.extend(labels.words.iter().cloned());
        for (index, at) in &frame.legend {
            paint::sample(&mut svg, &panel.layers[*index], *at);
        }
    }
    let most = KEYS_FROM * f64::from(figure.size.0);
    let left = frames.first().map_or(0.0, |frame| frame.plot.left).min(most);
    for (key, at) in figure.keys.iter().zip(key_places(figure, left)) {
        paint::key(&mut svg, at, key.tint);
        words.push(Words::new(&key.label, [at[0] + KEY + GAP, at[1]], Anchor::Start, SMALL));
    }
    text::write(&mut svg, &words);
    svg.push_str("</svg>\n");
    let placed = |w: Words| PlacedText { room: w.bounds(), text: w.text };
    let axis = |span: Span| {
        let [first, last] = span.of_data();
        (first, last, span.scale == AxisScale::Log)
    };
    let panels = frames.iter().map(|frame| {
        let axes = [frame.spans.x, frame.spans.y].map(axis);
        PlacedPanel { room: frame.plot, axes }
    });
    Drawing { svg, panels: panels.collect(), texts: words.into_iter().map(placed).collect() }
}

fn head(figure: &Figure) -> String {
    let (width, height) = figure.size;
    let (title, alt) = (escape(&figure.title), escape(&figure.alt));
    let alt = if alt.is_empty() { alt } else { format!("<desc>{alt}</desc>\n") };
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width}0 {height}0\" role=\"img\" font-family=\"{FAMILY}\" {}>\n\
         <title>{title}</title>\n{alt}",
        paint::USUAL
    )
}
