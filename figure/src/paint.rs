//! Layers as SVG: lengths in tenths of a pixel, whole; attributes only.

use std::fmt::Write;

use super::colors::Tint;
use super::geometry::{Point, lerp};
use super::layers::{Fill, Hatch, Layer, MarkedPoint};
use super::layout::{KEY, swatch};
use super::markers;
use super::palette::{Color, Dash, Marker, Style};
use super::shapes::{Dot, ShapeOfLayer};
use super::text::{escape, tenths};

/// What holds unless an element says otherwise.
pub(super) const USUAL: &str =
    "fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\" font-size=\"140\"";

/// Draws a layer.
pub(super) fn layer(svg: &mut String, layer: &Layer, shape: &ShapeOfLayer) {
    match (layer, shape) {
        (Layer::Curve { style, .. } | Layer::Rule { style, .. }, ShapeOfLayer::Lines(lines)) => {
            stroke(svg, lines, *style);
        }
        (Layer::Band { fill, .. }, ShapeOfLayer::Area(area)) => area_of(svg, area, *fill),
        (Layer::Points { points, marker, color, .. }, ShapeOfLayer::Dots(dots))
            if *marker != Marker::NONE =>
        {
            points_of(svg, points, dots, *marker, *color);
        }
        _ => {}
    }
}

/// A sample of a layer, from the middle of its left edge.
pub(super) fn sample(svg: &mut String, of: &Layer, at: Point) {
    let width = swatch(of);
    let shape = match of {
        Layer::Points { marker, color, .. } => {
            let d = markers::path(*marker, [[at[0] + width / 2.0, at[1]]]);
            return path(svg, &d, &markers::paint(*marker, *color).0);
        }
        Layer::Band { .. } => {
            let [left, right] = [at[0] + 3.0, at[0] + width - 3.0];
            let [top, bottom] = [at[1] - 6.0, at[1] + 6.0];
            ShapeOfLayer::Area(vec![[left, top], [right, top], [right, bottom], [left, bottom]])
        }
        _ => ShapeOfLayer::Lines(vec![vec![at, [at[0] + width, at[1]]]]),
    };
    layer(svg, of, &shape);
}

/// A tint in a rectangle, with an edge where it is light.
pub(super) fn key(svg: &mut String, at: Point, tint: Tint) {
    let [x, y] = [at[0], at[1] - 6.0].map(tenths);
    let (width, fill) = (tenths(KEY), tint.hex());
    let attributes = format!("fill=\"{fill}\" stroke=\"#777777\" stroke-width=\"6\"");
    path(svg, &format!("M{x} {y}h{width}v120h-{width}z"), &attributes);
}

/// A thin grey line from words to what they name.
pub(super) fn leader(svg: &mut String, ends: [Point; 2]) {
    path(svg, &path_data([&ends[..]]), "stroke=\"#6E6E6E\" stroke-width=\"7\"");
}

fn path(svg: &mut String, d: &str, attributes: &str) {
    if !d.is_empty() {
        let _ = writeln!(svg, "<path d=\"{d}\" {attributes}/>");
    }
}

/// Lines as path data; steps are relative, hence short, and summed without rounding.
fn path_data<'a>(lines: impl IntoIterator<Item = &'a [Point]>) -> String {
    let mut d = String::new();
    let mut pen = [0, 0];
    for line in lines {
        let mut command = if d.is_empty() { "M" } else { "m" };
        for point in line.iter().map(|p| p.map(tenths)) {
            let [dx, dy] = [point[0] - pen[0], point[1] - pen[1]];
            pen = point;
            if (dx, dy) == (0, 0) && "l ".contains(command) {
                continue;
            }
            let before = if command == " " && dx < 0 { "" } else { command };
            let between = if dy < 0 { "" } else { " " };
            let _ = write!(d, "{before}{dx}{between}{dy}");
            command = if "Mm".contains(command) { "l" } else { " " };
        }
        if command == "l" {
            d.push_str("h0");
        }
    }
    d
}

/// Lines, as one path.
fn stroke(svg: &mut String, lines: &[Vec<Point>], style: Style) {
    let d = path_data(lines.iter().map(Vec::as_slice));
    let (color, width) = (style.color.hex(), tenths(style.width));
    let mut attributes = format!("stroke=\"{color}\" stroke-width=\"{width}\"");
    if style.dash != Dash::Solid {
        let dashes = style.dash.tenths();
        let _ = write!(attributes, " stroke-dasharray=\"{dashes}\" stroke-linecap=\"butt\"");
    }
    path(svg, &d, &attributes);
}

fn area_of(svg: &mut String, area: &[Point], fill: Fill) {
    if area.is_empty() {
        return;
    }
    let (color, opacity) = (fill.color.hex(), fill.opacity.clamp(0.0, 1.0));
    let d = format!("{}z", path_data([area]));
    path(svg, &d, &format!("fill=\"{color}\" fill-opacity=\"{opacity:.2}\""));
    let d = path_data(hatching(area, fill.hatch).iter().map(Vec::as_slice));
    path(svg, &d, &format!("stroke=\"{color}\" stroke-width=\"8\" stroke-opacity=\"0.55\""));
}

/// The parts of slanted lines inside an area, by the even-odd rule.
fn hatching(area: &[Point], hatch: Hatch) -> Vec<Vec<Point>> {
    const EVERY: f64 = 9.0;
    let slope = match hatch {
        Hatch::None => return Vec::new(),
        Hatch::Rising => 1.0,
        Hatch::Falling => -1.0,
    };
    // Along a line `key` is constant; lines are told apart by it.
    let key = |p: Point| p[1] + slope * p[0];
    let keys = || area.iter().map(|p| key(*p));
    let first = (keys().fold(f64::INFINITY, f64::min) / EVERY).ceil() as i32;
    let last = (keys().fold(f64::NEG_INFINITY, f64::max) / EVERY).floor() as i32;
    let across = |k: i32| {
        let level = EVERY * f64::from(k);
        let cut = |(i, &b): (usize, &Point)| {
            let a = area[(i + area.len() - 1) % area.len()];
            let (ka, kb) = (key(a), key(b));
            ((ka > level) != (kb > level)).then(|| lerp(a, b, (level - ka) / (kb - ka)))
        };
        let mut cuts: Vec<Point> = area.iter().enumerate().filter_map(cut).collect();
        cuts.sort_by(|a, b| a[0].total_cmp(&b[0]));
        cuts.chunks_exact(2).map(<[Point]>::to_vec).collect::<Vec<_>>()
    };
    (first..=last).flat_map(across).collect()
}

/// Points: those that have nothing to say in one path, the others as elements with a tooltip.
fn points_of(svg: &mut String, points: &[MarkedPoint], dots: &[Dot], marker: Marker, color: Color) {
    let (paint, below) = markers::paint(marker, color);
    let at = |dots: &[&Dot]| markers::path(marker, dots.iter().map(|dot| dot.at));
    if let Some(below) = below {
        path(svg, &at(&dots.iter().collect::<Vec<_>>()), &below);
    }
    let (telling, silent): (Vec<&Dot>, Vec<&Dot>) =
        dots.iter().partition(|dot| points[dot.index].tooltip.is_some());
    path(svg, &at(&silent), &paint);
    if telling.is_empty() {
        return;
    }
    let _ = writeln!(svg, "<g {paint}>");
    for dot in telling {
        let said = escape(points[dot.index].tooltip.as_deref().unwrap_or_default());
        let more = match dot.count {
            1 => String::new(),
            count => format!(" (and {} more here)", count - 1),
        };
        let d = at(&[dot]);
        let _ = writeln!(svg, "<path d=\"{d}\"><title>{said}{more}</title></path>");
    }
    svg.push_str("</g>\n");
}
