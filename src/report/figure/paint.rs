//! Layers as SVG: lengths in tenths of a pixel, whole; attributes only.

use std::fmt::Write;

use super::colors::Tint;
use super::geometry::in_polygon;
use super::image::{self, Image, Placed};
use super::labels::STAR;
use super::layers::{Fill, Hatch, Layer, MarkedPoint};
use super::markers;
use super::palette::{Color, Marker, Style};
use super::shapes::{Dot, Shape};
use super::text::{escape, tenths};

/// Draws a layer.
pub(super) fn layer(svg: &mut String, layer: &Layer, shape: &Shape, coarseness: f64) {
    match (layer, shape) {
        (Layer::Image(image), Shape::Image(placed)) => image_of(svg, image, placed, coarseness),
        (Layer::Curve { style, .. } | Layer::Rule { style, .. }, Shape::Lines(lines)) => {
            stroke(svg, lines, *style);
        }
        (Layer::Band { fill, .. }, Shape::Area(area)) => area_of(svg, area, *fill),
        (Layer::Points { points, marker, color, .. }, Shape::Dots(dots)) => {
            points_of(svg, points, dots, *marker, *color);
        }
        (Layer::ThisCase { tooltip, .. }, Shape::Place(at)) => {
            star(svg, *at, tooltip.as_deref().unwrap_or("this case"));
        }
        _ => {}
    }
}

/// An image: each cell keeps its edges at any size. Below it are large blocks of the same colours, for viewers
/// that refuse an image within an image: GitHub's pages in Firefox do.
fn image_of(svg: &mut String, image: &Image, placed: &Placed, coarseness: f64) {
    let Placed { place, .. } = placed;
    let [x, y, right, bottom] = [place.left, place.top, place.right, place.bottom].map(tenths);
    let (width, height) = (right - x, bottom - y);
    for (tint, rects) in image::blocks(image, placed) {
        let mut d = String::new();
        for rect in rects {
            let [x, y, right, bottom] = [rect.left, rect.top, rect.right, rect.bottom].map(tenths);
            let _ = write!(d, "M{x} {y}h{}v{}H{x}z", right - x, bottom - y);
        }
        let fill = tint.hex();
        let _ = writeln!(svg, "<path d=\"{d}\" fill=\"{fill}\" shape-rendering=\"crispEdges\"/>");
    }
    let url = image::url(image, placed, coarseness);
    let _ = writeln!(
        svg,
        "<image x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" \
         preserveAspectRatio=\"none\" image-rendering=\"pixelated\" href=\"{url}\"/>"
    );
}

/// A tint in a rectangle, with an edge where it is light.
pub(super) fn key(svg: &mut String, at: [f64; 2], width: f64, tint: Tint) {
    let [x, y] = [at[0], at[1] - 6.0].map(tenths);
    let _ = writeln!(
        svg,
        "<rect x=\"{x}\" y=\"{y}\" width=\"{}\" height=\"120\" fill=\"{}\" stroke=\"#777777\" \
         stroke-width=\"6\"/>",
        tenths(width),
        tint.hex()
    );
}

/// Lines, as one path.
pub(super) fn stroke(svg: &mut String, lines: &[Vec<[f64; 2]>], style: Style) {
    let d: String = lines.iter().map(|line| path(line)).collect();
    if d.is_empty() {
        return;
    }
    let dashes: Vec<String> = style.dash.lengths().iter().map(|l| tenths(*l).to_string()).collect();
    let dashes = if dashes.is_empty() {
        " stroke-linecap=\"round\"".to_owned()
    } else {
        format!(" stroke-dasharray=\"{}\"", dashes.join(" "))
    };
    let (color, width) = (style.color.hex(), tenths(style.width));
    let _ = writeln!(
        svg,
        "<path d=\"{d}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\" \
         stroke-linejoin=\"round\"{dashes}/>"
    );
}

/// A thin grey line from words to what they name.
pub(super) fn leader(svg: &mut String, ends: [[f64; 2]; 2]) {
    let d = path(&ends);
    let _ = writeln!(svg, "<path d=\"{d}\" fill=\"none\" stroke=\"#6E6E6E\" stroke-width=\"7\"/>");
}

/// A line as path data; steps are relative, hence short, and summed without rounding.
fn path(points: &[[f64; 2]]) -> String {
    let mut d = String::new();
    let mut points = points.iter().map(|p| p.map(tenths));
    let Some(mut last) = points.next() else { return d };
    let _ = write!(d, "M{} {}", last[0], last[1]);
    let mut command = 'l';
    for point in points {
        let (dx, dy) = (point[0] - last[0], point[1] - last[1]);
        if dx == 0 && dy == 0 {
            continue;
        }
        last = point;
        let gap = if command == ' ' && dx < 0 { String::new() } else { command.to_string() };
        let between = if dy < 0 { "" } else { " " };
        let _ = write!(d, "{gap}{dx}{between}{dy}");
        command = ' ';
    }
    if command == 'l' {
        d.push_str("h0");
    }
    d
}

fn area_of(svg: &mut String, area: &[[f64; 2]], fill: Fill) {
    if area.is_empty() {
        return;
    }
    let (color, opacity) = (fill.color.hex(), fill.opacity.clamp(0.0, 1.0));
    let d = path(area);
    let _ = writeln!(svg, "<path d=\"{d}z\" fill=\"{color}\" fill-opacity=\"{opacity:.2}\"/>");
    let d: String = hatching(area, fill.hatch).iter().map(|line| path(line)).collect();
    if !d.is_empty() {
        let _ = writeln!(
            svg,
            "<path d=\"{d}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"8\" \
             stroke-opacity=\"0.55\"/>"
        );
    }
}

/// The parts of slanted lines inside an area.
fn hatching(area: &[[f64; 2]], hatch: Hatch) -> Vec<Vec<[f64; 2]>> {
    const EVERY: f64 = 9.0;
    let slope = match hatch {
        Hatch::None => return Vec::new(),
        Hatch::Rising => 1.0,
        Hatch::Falling => -1.0,
    };
    // Along a line `key` is constant; lines are told apart by it.
    let key = |p: [f64; 2]| p[1] + slope * p[0];
    let keys = || area.iter().map(|p| key(*p));
    let first = (keys().fold(f64::INFINITY, f64::min) / EVERY).ceil() as i32;
    let last = (keys().fold(f64::NEG_INFINITY, f64::max) / EVERY).floor() as i32;
    let mut pieces = Vec::new();
    for k in first..=last {
        let level = EVERY * f64::from(k);
        let mut cuts: Vec<[f64; 2]> = Vec::new();
        for (i, &b) in area.iter().enumerate() {
            let a = area[(i + area.len() - 1) % area.len()];
            let (ka, kb) = (key(a), key(b));
            if (ka > level) != (kb > level) {
                let t = (level - ka) / (kb - ka);
                cuts.push([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]);
            }
        }
        cuts.sort_by(|a, b| a[0].total_cmp(&b[0]));
        for pair in cuts.windows(2) {
            let middle = [0, 1].map(|i| f64::midpoint(pair[0][i], pair[1][i]));
            if in_polygon(area, middle) {
                pieces.push(pair.to_vec());
            }
        }
    }
    pieces
}

/// Points: those that have nothing to say in one path, the others as elements with a tooltip.
fn points_of(svg: &mut String, points: &[MarkedPoint], dots: &[Dot], marker: Marker, color: Color) {
    let silent: String = dots
        .iter()
        .filter(|dot| points[dot.index].tooltip.is_none())
        .map(|dot| markers::outline(marker, dot.at))
        .collect();
    let paint = markers::paint(marker, color);
    if !silent.is_empty() {
        if let Some(below) = markers::underlay(marker) {
            let _ = writeln!(svg, "<path d=\"{silent}\" {below}/>");
        }
        let _ = writeln!(svg, "<path d=\"{silent}\" {paint}/>");
    }
    let telling = || dots.iter().filter(|dot| points[dot.index].tooltip.is_some());
    if telling().next().is_none() {
        return;
    }
    let _ = writeln!(svg, "<g {paint}>");
    for dot in telling() {
        let said = points[dot.index].tooltip.as_deref().unwrap_or_default();
        let more = match dot.count {
            0 | 1 => String::new(),
            count => format!(" (and {} more here)", count - 1),
        };
        let (d, said) = (markers::outline(marker, dot.at), escape(said));
        let _ = writeln!(svg, "<path d=\"{d}\"><title>{said}{more}</title></path>");
    }
    svg.push_str("</g>\n");
}

/// The one mark for the case at hand: a black star in a white one.
fn star(svg: &mut String, at: [f64; 2], tooltip: &str) {
    let d = markers::star(at, STAR);
    let title = escape(tooltip);
    let _ = writeln!(
        svg,
        "<path d=\"{d}\" fill=\"#FFFFFF\" stroke=\"#FFFFFF\" stroke-width=\"50\" \
         stroke-linejoin=\"round\"/>\n<path d=\"{d}\" fill=\"#000000\"><title>{title}</title></path>"
    );
}
