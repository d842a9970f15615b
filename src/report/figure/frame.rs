//! Ground, grid, frame, ticks and the words around a plot.

use std::fmt::Write;

use super::data::Figure;
use super::layout::{Frame, LINE, TICK};
use super::text::{Anchor, LARGE, SMALL, Words, tenths};

const GRID: &str = "#E9E9E9";
const EDGE: &str = "#777777";
/// Lengths of ticks with and without words, pixels.
const LONG: f64 = 4.0;
const SHORT: f64 = 2.5;

/// Draws the white ground and the frames of all panels; returns their words.
pub(super) fn draw(svg: &mut String, figure: &Figure, frames: &[Frame]) -> Vec<Words> {
    let (width, height) = figure.size;
    let _ = writeln!(svg, "<rect width=\"{width}0\" height=\"{height}0\" fill=\"#FFFFFF\"/>");
    for frame in frames {
        lines(svg, frame);
    }
    let words: Vec<Words> = frames.iter().flat_map(frame_words).collect();
    for word in &words {
        word.write(svg);
    }
    words
}

fn lines(svg: &mut String, frame: &Frame) {
    let [left, top, right, bottom] =
        [frame.plot.left, frame.plot.top, frame.plot.right, frame.plot.bottom].map(tenths);
    let (mut grid, mut ticks) = (String::new(), String::new());
    let length = |words: &str| tenths(if words.is_empty() { SHORT } else { LONG });
    for mark in &frame.x_ticks {
        let x = tenths(frame.map([mark.value, frame.spans.y.first])[0]);
        let _ = write!(ticks, "M{x} {bottom}v{}", length(&mark.words));
        if !mark.words.is_empty() {
            let _ = write!(grid, "M{x} {top}V{bottom}");
        }
    }
    for mark in &frame.y_ticks {
        let y = tenths(frame.map([frame.spans.x.first, mark.value])[1]);
        let _ = write!(ticks, "M{left} {y}h-{}", length(&mark.words));
        if !mark.words.is_empty() {
            let _ = write!(grid, "M{left} {y}H{right}");
        }
    }
    let _ = write!(ticks, "M{left} {top}H{right}V{bottom}H{left}z");
    for (color, d) in [(GRID, grid), (EDGE, ticks)] {
        if !d.is_empty() {
            let stroke = format!("stroke=\"{color}\" stroke-width=\"8\"");
            let _ = writeln!(svg, "<path fill=\"none\" {stroke} d=\"{d}\"/>");
        }
    }
}

/// The words around a plot.
fn frame_words(frame: &Frame) -> Vec<Words> {
    let plot = &frame.plot;
    let mut all = Vec::new();
    for mark in frame.x_ticks.iter().filter(|m| frame.x_words && !m.words.is_empty()) {
        let x = frame.map([mark.value, frame.spans.y.first])[0];
        let at = [x, plot.bottom + TICK + SMALL / 2.0 + 0.5];
        all.push(Words::new(mark.words.clone(), at, Anchor::Middle, SMALL));
    }
    for mark in frame.y_ticks.iter().filter(|m| !m.words.is_empty()) {
        let y = frame.map([frame.spans.x.first, mark.value])[1];
        all.push(Words::new(mark.words.clone(), [plot.left - TICK, y], Anchor::End, SMALL));
    }
    let [cx, cy] = plot.center();
    let dark = |words: Words| Words { color: "#000000", ..words };
    for (i, text) in frame.x_label.iter().enumerate().filter(|_| frame.x_words) {
        let y = plot.bottom + TICK + SMALL + 6.0 + LINE * (i as f64 + 0.5);
        all.push(dark(Words::new(text.clone(), [cx, y], Anchor::Middle, LARGE)));
    }
    let first = plot.left - TICK - frame.tick_room - 4.0;
    for (i, text) in frame.y_label.iter().rev().enumerate() {
        let x = first - LINE * (i as f64 + 0.5);
        let words = Words::new(text.clone(), [x, cy], Anchor::Middle, LARGE);
        all.push(dark(Words { upright: true, ..words }));
    }
    if let Some(heading) = &frame.heading {
        let y = plot.top - frame.legend_room - LINE / 2.0 - 4.0;
        let words = Words::new(heading.clone(), [plot.left, y], Anchor::Start, LARGE);
        all.push(dark(Words { bold: true, ..words }));
    }
    all
}
