//! Markers as SVG: one outline for each shape, set down wherever there is a point.

use std::fmt::Write;

use super::palette::{Color, Marker, Shape};
use super::text::tenths;

/// Half side or half leg of the others, as parts of the circle's radius: equal weight to the eye.
const SQUARE: f64 = 0.88;
const TRIANGLE: f64 = 1.16;
const DIAMOND: f64 = 1.22;
const CROSS: f64 = 0.8;

/// The attributes that all markers of a layer share, and those of what is drawn white below them, so that large
/// dots stand out from the line they lie on.
pub(super) fn paint(marker: Marker, color: Color) -> (String, Option<String>) {
    let hex = color.hex();
    let dot = |hex: &str, diameter: f64| {
        format!("stroke=\"{hex}\" stroke-width=\"{}\"", tenths(diameter))
    };
    match (marker.shape, marker.filled) {
        // The round end of a line of no length, the shortest way to write a disc.
        (Shape::Circle, true) => {
            let below = (marker.diameter > 4.0).then(|| dot("#FFFFFF", marker.diameter + 1.2));
            (dot(hex, marker.diameter), below)
        }
        (Shape::Cross, _) => (dot(hex, 1.5), None),
        (Shape::Star, _) => (format!("fill=\"{hex}\""), Some(dot("#FFFFFF", 5.0))),
        (_, true) => (format!("fill=\"{hex}\" stroke=\"#FFFFFF\" stroke-width=\"6\""), None),
        (_, false) => (format!("fill=\"#FFFFFF\" stroke=\"{hex}\" stroke-width=\"13\""), None),
    }
}

/// Markers at some places as path data. Steps from one to the next are relative, hence short.
pub(super) fn path(marker: Marker, places: impl IntoIterator<Item = [f64; 2]>) -> String {
    let (begin, outline, end) = outline(marker);
    let mut d = String::new();
    let mut pen: Option<[i32; 2]> = None;
    for at in places {
        let [x, y] = at.map(tenths);
        let [x, y] = [x + begin[0], y + begin[1]];
        let (command, [dx, dy]) = pen.map_or(('M', [x, y]), |pen| ('m', [x - pen[0], y - pen[1]]));
        let gap = if dy < 0 { "" } else { " " };
        let _ = write!(d, "{command}{dx}{gap}{dy}{outline}");
        pen = Some([x + end[0], y + end[1]]);
    }
    d
}

/// Where a marker's outline begins, as seen from its middle, its path data from there, and where they end.
fn outline(marker: Marker) -> ([i32; 2], String, [i32; 2]) {
    let radius = tenths(marker.diameter / 2.0).max(1);
    let part = |factor: f64| (f64::from(radius) * factor).round() as i32;
    match marker.shape {
        Shape::Circle if marker.filled => ([0, 0], "h0".to_owned(), [0, 0]),
        // All around but for a tenth of a pixel.
        Shape::Circle => ([0, -radius], format!("a{radius} {radius} 0 1 0 1 0z"), [0, 0]),
        Shape::Square => {
            let (half, side) = (part(SQUARE), 2 * part(SQUARE));
            ([-half, -half], format!("h{side}v{side}h-{side}z"), [0, 0])
        }
        Shape::Triangle => {
            let (half, height) = (part(TRIANGLE), part(1.7 * TRIANGLE));
            ([0, -half], format!("l{half} {height}h-{}z", 2 * half), [0, 0])
        }
        Shape::Diamond => {
            let half = part(DIAMOND);
            ([0, -half], format!("l{half} {half}l-{half} {half}l-{half}-{half}z"), [0, 0])
        }
        Shape::Cross => {
            let (half, side) = (part(CROSS), 2 * part(CROSS));
            ([-half, -half], format!("l{side} {side}m0-{side}l-{side} {side}"), [0, side])
        }
        Shape::Star => {
            let corner = |k: u32| {
                let radius = if k.is_multiple_of(2) { 1.0 } else { 0.42 };
                let (sin, cos) = libm::sincos(f64::from(k) * core::f64::consts::PI / 5.0);
                [part(radius * sin), -part(radius * cos)]
            };
            let step = |k: u32| [0, 1].map(|axis| corner(k + 1)[axis] - corner(k)[axis]);
            let sides = (0..9).map(step).map(|[x, y]| format!("l{x} {y}"));
            ([0, -radius], sides.collect::<String>() + "z", [0, 0])
        }
    }
}
