//! Markers as SVG path data around a point, in tenths of a pixel.

use std::fmt::Write;

use super::palette::{Color, Marker, Shape};
use super::text::tenths;

/// Side of the square and legs of the others, as parts of the circle's diameter: equal weight to the eye.
const SQUARE: f64 = 0.88;
const TRIANGLE: f64 = 1.16;
const DIAMOND: f64 = 1.22;
const CROSS: f64 = 0.8;

/// Whether a marker is drawn as the round end of a line of no length, the shortest way.
fn is_dot(marker: Marker) -> bool {
    marker.filled && marker.shape == Shape::Circle
}

/// The attributes that all markers of a layer share.
pub(super) fn paint(marker: Marker, color: Color) -> String {
    let hex = color.hex();
    let strokes = matches!(marker.shape, Shape::Cross | Shape::Tick);
    if is_dot(marker) {
        let width = tenths(marker.diameter);
        format!("fill=\"none\" stroke=\"{hex}\" stroke-width=\"{width}\" stroke-linecap=\"round\"")
    } else if strokes {
        format!("fill=\"none\" stroke=\"{hex}\" stroke-width=\"15\" stroke-linecap=\"round\"")
    } else if marker.filled {
        format!("fill=\"{hex}\" stroke=\"#FFFFFF\" stroke-width=\"6\"")
    } else {
        format!("fill=\"#FFFFFF\" stroke=\"{hex}\" stroke-width=\"13\"")
    }
}

/// White below all dots of a layer, so that they stand out from the line they lie on; clouds of
/// small dots go without.
pub(super) fn underlay(marker: Marker) -> Option<String> {
    let white = Marker { diameter: marker.diameter + 1.2, ..marker };
    (is_dot(marker) && marker.diameter > 4.0)
        .then(|| paint(white, Color::Black).replace(Color::Black.hex(), "#FFFFFF"))
}

/// A marker as path data.
pub(super) fn outline(marker: Marker, at: [f64; 2]) -> String {
    let [x, y] = at.map(tenths);
    let radius = tenths(marker.diameter / 2.0).max(1);
    let part = |factor: f64| (f64::from(radius) * factor).round() as i32;
    let mut d = String::new();
    let _ = match marker.shape {
        Shape::Circle if marker.filled => write!(d, "M{x} {y}h0"),
        Shape::Circle => {
            let (start, across) = (x - radius, 2 * radius);
            write!(
                d,
                "M{start} {y}a{radius} {radius} 0 1 0 {across} 0a{radius} {radius} 0 1 0-{across} 0z"
            )
        }
        Shape::Square => {
            let half = part(SQUARE);
            let side = 2 * half;
            write!(d, "M{} {}h{side}v{side}h-{side}z", x - half, y - half)
        }
        Shape::Triangle => {
            let (half, up) = (part(TRIANGLE), part(TRIANGLE));
            let height = part(1.7 * TRIANGLE);
            write!(d, "M{x} {}l{half} {height}h-{}z", y - up, 2 * half)
        }
        Shape::Diamond => {
            let half = part(DIAMOND);
            write!(d, "M{x} {}l{half} {half}l-{half} {half}l-{half}-{half}z", y - half)
        }
        Shape::Cross => {
            let half = part(CROSS);
            let side = 2 * half;
            write!(d, "M{} {}l{side} {side}m0-{side}l-{side} {side}", x - half, y - half)
        }
        Shape::Tick => write!(d, "M{x} {}v{}", y - radius, 2 * radius),
    };
    d
}

/// A star with five points as path data.
pub(super) fn star(at: [f64; 2], radius: f64) -> String {
    let mut d = String::new();
    for k in 0..10 {
        let radius = if k % 2 == 0 { radius } else { 0.42 * radius };
        let (sin, cos) = libm::sincos(f64::from(k) * core::f64::consts::PI / 5.0);
        let (x, y) = (tenths(at[0] + radius * sin), tenths(at[1] - radius * cos));
        let command = if k == 0 { 'M' } else { 'L' };
        let _ = write!(d, "{command}{x} {y}");
    }
    d.push('z');
    d
}
