//! From a figure to its file.

use std::fmt::Write;

use super::data::Figure;
use super::error::FigureError;
use super::frame;
use super::geometry::Rect;
use super::labels::{Labels, color_of, place};
use super::layers::Layer;
use super::layout::{Frame, GAP, KEY, KEYS_FROM, key_places, label_of, lay_out, swatch};
use super::markers;
use super::paint;
use super::shapes::{Shape, shapes};
use super::text::{Anchor, FAMILY, SMALL, Words, escape};

/// No file is larger than this, bytes.
pub const LIMIT: usize = 150_000;
/// Each time the file is too large, this many times more detail is left out.
const COARSER: f64 = 2.0;
/// How often; beyond, the picture would be wrong rather than coarse.
const ATTEMPTS: usize = 5;
/// How often names that found no place go to the legend, which makes the plot smaller.
const ROUNDS: usize = 4;

/// A drawn figure and where its words are.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// The whole file.
    pub svg: String,
    /// Every piece of text with the room it takes, in pixels of [`Figure::size`], cautiously estimated.
    pub texts: Vec<PlacedText>,
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
    let mut coarseness = 1.0;
    let mut bytes = 0;
    for _ in 0..ATTEMPTS {
        let drawing = compose(figure, &frames, &labels, coarseness)?;
        bytes = drawing.svg.len();
        if bytes <= LIMIT {
            return Ok(drawing);
        }
        coarseness *= COARSER;
    }
    Err(FigureError::TooLarge { name: figure.name.clone(), bytes, limit: LIMIT })
}

/// Places panels and names; names without a place go to legends until all others have one.
fn arrange(figure: &Figure) -> Result<(Vec<Frame>, Vec<Labels>), FigureError> {
    let mut legends: Vec<Vec<usize>> = vec![Vec::new(); figure.panels.len()];
    let mut round = 0;
    loop {
        let frames = lay_out(figure, &legends)?;
        let labels: Vec<Labels> = figure
            .panels
            .iter()
            .zip(&frames)
            .map(|(panel, frame)| place(panel, frame, &shapes(panel, frame, 1.0)))
            .collect();
        round += 1;
        if labels.iter().all(|l| l.homeless.is_empty()) {
            return Ok((frames, labels));
        }
        for (legend, labels) in legends.iter_mut().zip(&labels) {
            legend.extend(&labels.homeless);
            legend.sort_unstable();
        }
        if round == ROUNDS {
            for (legend, panel) in legends.iter_mut().zip(&figure.panels) {
                *legend = (0..panel.layers.len())
                    .filter(|i| label_of(&panel.layers[*i]).is_some())
                    .collect();
            }
        }
    }
}

fn compose(
    figure: &Figure,
    frames: &[Frame],
    labels: &[Labels],
    coarseness: f64,
) -> Result<Drawing, FigureError> {
    let (body, mut words) = frame::draw(figure, frames)?;
    let mut svg = head(figure);
    svg.push_str(&body);
    for ((panel, frame), labels) in figure.panels.iter().zip(frames).zip(labels) {
        let shapes = shapes(panel, frame, coarseness);
        for (layer, shape) in panel.layers.iter().zip(&shapes) {
            paint::layer(&mut svg, layer, shape, coarseness);
        }
        for ends in &labels.leaders {
            paint::leader(&mut svg, *ends);
        }
        for label in &labels.words {
            label.write(&mut svg);
        }
        words.extend(labels.words.iter().cloned());
        for (index, at) in &frame.legend {
            let at = [frame.plot.left + at[0], frame.plot.top + at[1]];
            words.extend(entry(&mut svg, &panel.layers[*index], at));
        }
    }
    words.extend(keys(&mut svg, figure, frames));
    svg.push_str("</svg>\n");
    let placed = |w: Words| PlacedText { room: w.bounds(), text: w.text };
    Ok(Drawing { svg, texts: words.into_iter().map(placed).collect() })
}

fn head(figure: &Figure) -> String {
    let (width, height) = figure.size;
    let mut svg = String::new();
    let _ = writeln!(
        svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {}0 {}0\" role=\"img\" font-family=\"{FAMILY}\">",
        width, height
    );
    let _ = writeln!(svg, "<title>{}</title>", escape(&figure.title));
    if !figure.alt.is_empty() {
        let _ = writeln!(svg, "<desc>{}</desc>", escape(&figure.alt));
    }
    svg
}

/// The keys of a figure, and their words.
fn keys(svg: &mut String, figure: &Figure, frames: &[Frame]) -> Vec<Words> {
    let most = KEYS_FROM * f64::from(figure.size.0);
    let left = frames.first().map_or(0.0, |frame| frame.plot.left).min(most);
    let places = key_places(figure, left);
    let written = figure.keys.iter().zip(places).map(|(key, at)| {
        paint::key(svg, at, KEY, key.tint);
        let words = Words::new(key.label.clone(), [at[0] + KEY + GAP, at[1]], Anchor::Start, SMALL);
        words.write(svg);
        words
    });
    written.collect()
}

/// A sample of a layer and its name.
fn entry(svg: &mut String, layer: &Layer, at: [f64; 2]) -> Option<Words> {
    let label = label_of(layer)?;
    let width = swatch(layer);
    let middle = [at[0] + width / 2.0, at[1]];
    match layer {
        Layer::Points { marker, color, .. } => {
            let (d, paint) = (markers::outline(*marker, middle), markers::paint(*marker, *color));
            let _ = writeln!(svg, "<path d=\"{d}\" {paint}/>");
        }
        Layer::Band { .. } => {
            let [left, right] = [at[0] + 3.0, at[0] + width - 3.0];
            let [top, bottom] = [at[1] - 6.0, at[1] + 6.0];
            let corners = vec![[left, top], [right, top], [right, bottom], [left, bottom]];
            paint::layer(svg, layer, &Shape::Area(corners), 1.0);
        }
        _ => {
            let line = vec![at, [at[0] + width, at[1]]];
            paint::layer(svg, layer, &Shape::Lines(vec![line]), 1.0);
        }
    }
    let at = [at[0] + width + GAP, at[1]];
    let color = color_of(layer);
    let words = Words { color, ..Words::new(label.text.clone(), at, Anchor::Start, SMALL) };
    words.write(svg);
    Some(words)
}
