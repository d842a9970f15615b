//! What the drawing library draws: background, grid, ticks and the edge of every panel.

use plotters::element::PathElement;
use plotters::prelude::{IntoDrawingArea, SVGBackend};
use plotters::style::{Color, RGBColor, WHITE};

use super::data::{Figure, Tick};
use super::layout::Frame;
use super::text::tenths;

const GRID: RGBColor = RGBColor(0xE9, 0xE9, 0xE9);
const EDGE: RGBColor = RGBColor(0x77, 0x77, 0x77);
/// Lengths of ticks with and without words, pixels.
const LONG: f64 = 4.0;
const SHORT: f64 = 2.5;

/// The file's beginning without its first tag.
pub(super) fn draw(figure: &Figure, frames: &[Frame]) -> String {
    let size = (10 * figure.size.0, 10 * figure.size.1);
    let mut svg = String::new();
    let area = SVGBackend::with_string(&mut svg, size).into_drawing_area();
    let line = |points: Vec<(i32, i32)>, color: RGBColor| {
        area.draw(&PathElement::new(points, color.stroke_width(8)))
    };
    let drawn = area.fill(&WHITE).and_then(|()| {
        frames.iter().try_for_each(|frame| {
            line(grid(frame), GRID)?;
            line(edge(frame), EDGE)
        })?;
        area.present()
    });
    drawn.expect("memory takes every line");
    drop(area);
    // Its head is replaced by one with a title, its end is left to the caller.
    let body = svg.split_once('>').map_or("", |(_, body)| body);
    let body = body.trim_start().strip_suffix("</svg>\n").unwrap_or(body);
    body.replace("opacity=\"1\" ", "").replace(" fill=\"none\"", "")
}

/// All lines of the grid as one, which goes from each to the next along the edge.
fn grid(frame: &Frame) -> Vec<(i32, i32)> {
    let plot = &frame.plot;
    let mut points: Vec<[f64; 2]> = Vec::new();
    for tick in frame.x_ticks.iter().filter(|tick| tick.label.is_some()) {
        let (x, from) = (frame.across(tick), points.last().map_or(plot.top, |last| last[1]));
        points.extend([[x, from], [x, plot.top + plot.bottom - from]]);
    }
    if let Some([_, y]) = points.last().copied() {
        points.push([plot.right, y]);
    }
    for tick in frame.y_ticks.iter().filter(|tick| tick.label.is_some()) {
        let (y, from) = (frame.up(tick), points.last().map_or(plot.right, |last| last[0]));
        points.extend([[from, y], [plot.left + plot.right - from, y]]);
    }
    points.iter().map(|[x, y]| (tenths(*x), tenths(*y))).collect()
}

/// The edge of the plot, and along it the ticks, as one line.
fn edge(frame: &Frame) -> Vec<(i32, i32)> {
    let [left, top, right, bottom] =
        [frame.plot.left, frame.plot.top, frame.plot.right, frame.plot.bottom];
    let length = |tick: &Tick| if tick.label.is_some() { LONG } else { SHORT };
    let mut points = vec![[left, top], [right, top], [right, bottom]];
    for tick in frame.x_ticks.iter().rev() {
        let x = frame.across(tick);
        points.extend([[x, bottom], [x, bottom + length(tick)], [x, bottom]]);
    }
    points.push([left, bottom]);
    for tick in &frame.y_ticks {
        let y = frame.up(tick);
        points.extend([[left, y], [left - length(tick), y], [left, y]]);
    }
    points.push([left, top]);
    points.iter().map(|[x, y]| (tenths(*x), tenths(*y))).collect()
}
