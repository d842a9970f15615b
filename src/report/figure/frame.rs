//! What the drawing library draws: background, grid, frame, ticks and the words of the axes.

use plotters::coord::Shift;
use plotters::element::PathElement;
use plotters::prelude::{DrawingArea, IntoDrawingArea, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontTransform, IntoFont, IntoTextStyle, RGBColor, WHITE};

use super::data::Figure;
use super::error::FigureError;
use super::layout::{Frame, LINE, TICK};
use super::text::{Anchor, FAMILY, LARGE, SMALL, Words, tenths};

const GRID: RGBColor = RGBColor(0xE9, 0xE9, 0xE9);
const EDGE: RGBColor = RGBColor(0x77, 0x77, 0x77);
/// Lengths of ticks with and without words, pixels.
const LONG: f64 = 4.0;
const SHORT: f64 = 2.5;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Draws the frames of all panels: the file's beginning without the closing tag, and its words.
pub(super) fn draw(figure: &Figure, frames: &[Frame]) -> Result<(String, Vec<Words>), FigureError> {
    let (width, height) = (10 * figure.size.0, 10 * figure.size.1);
    let mut svg = String::new();
    let mut words = Vec::new();
    let refused = |error: &dyn std::fmt::Display| FigureError::Backend {
        name: figure.name.clone(),
        reason: error.to_string(),
    };
    {
        let area = SVGBackend::with_string(&mut svg, (width, height)).into_drawing_area();
        area.fill(&WHITE).map_err(|e| refused(&e))?;
        for frame in frames {
            lines(&area, frame).map_err(|e| refused(&e))?;
            for word in frame_words(frame) {
                write(&area, &word).map_err(|e| refused(&e))?;
                words.push(word);
            }
        }
        area.present().map_err(|e| refused(&e))?;
    }
    // The library's head is replaced by one with a title, its end is left to the caller.
    let body = svg.split_once('>').map_or("", |(_, body)| body);
    let body = body.trim_start().strip_suffix("</svg>\n").unwrap_or(body);
    Ok((body.replace("opacity=\"1\" ", ""), words))
}

type Refused<'a> = plotters::drawing::DrawingAreaErrorKind<
    <SVGBackend<'a> as plotters::prelude::DrawingBackend>::ErrorType,
>;

fn lines<'a>(area: &Area<'a>, frame: &Frame) -> Result<(), Refused<'a>> {
    let plot = &frame.plot;
    let point = |x: f64, y: f64| (tenths(x), tenths(y));
    let line = |a: (i32, i32), b: (i32, i32), color: RGBColor| {
        area.draw(&PathElement::new(vec![a, b], color.stroke_width(8)))
    };
    let across = |v: f64| frame.map([v, frame.spans.y.first])[0];
    let up = |v: f64| frame.map([frame.spans.x.first, v])[1];
    for mark in frame.x_ticks.iter().filter(|m| !m.words.is_empty()) {
        let x = across(mark.value);
        line(point(x, plot.top), point(x, plot.bottom), GRID)?;
    }
    for mark in frame.y_ticks.iter().filter(|m| !m.words.is_empty()) {
        let y = up(mark.value);
        line(point(plot.left, y), point(plot.right, y), GRID)?;
    }
    let length = |words: &str| if words.is_empty() { SHORT } else { LONG };
    for mark in &frame.x_ticks {
        let x = across(mark.value);
        line(point(x, plot.bottom), point(x, plot.bottom + length(&mark.words)), EDGE)?;
    }
    for mark in &frame.y_ticks {
        let y = up(mark.value);
        line(point(plot.left, y), point(plot.left - length(&mark.words), y), EDGE)?;
    }
    let [left, right] = [plot.left, plot.right];
    let corners = [(left, plot.top), (right, plot.top), (right, plot.bottom), (left, plot.bottom)];
    let around: Vec<(i32, i32)> =
        corners.iter().chain(&corners[..1]).map(|(x, y)| point(*x, *y)).collect();
    area.draw(&PathElement::new(around, EDGE.stroke_width(8)))
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

fn write<'a>(area: &Area<'a>, words: &Words) -> Result<(), Refused<'a>> {
    let horizontal = match words.anchor {
        Anchor::Start => HPos::Left,
        Anchor::Middle => HPos::Center,
        Anchor::End => HPos::Right,
    };
    // The library divides a font's size by 1.24, and puts the baseline half an ex below.
    let font = (FAMILY, words.size * 12.4).into_font();
    let font = if words.bold { font.style(plotters::style::FontStyle::Bold) } else { font };
    let font = if words.upright { font.transform(FontTransform::Rotate270) } else { font };
    let shade = if words.color == "#000000" { RGBColor(0, 0, 0) } else { RGBColor(51, 51, 51) };
    let style = font.color(&shade).pos(Pos::new(horizontal, VPos::Center));
    let drop = 0.09 * words.size;
    let [x, y] = if words.upright {
        [words.at[0] + drop, words.at[1]]
    } else {
        [words.at[0], words.at[1] + drop]
    };
    let style = style.into_text_style(area);
    area.draw(&plotters::element::Text::new(words.text.clone(), (tenths(x), tenths(y)), style))
}
