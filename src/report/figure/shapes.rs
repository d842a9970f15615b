//! Layers in pixels: cut at the plot and reduced to what can be seen.

use std::collections::BTreeMap;

use super::data::Panel;
use super::geometry::{Rect, clip_polygon, clip_polyline};
use super::image::{Placed, placed};
use super::layers::{Layer, MarkedPoint, Rule};
use super::layout::Frame;
use super::simplify::simplify;

/// A point to be drawn.
#[derive(Debug, Clone)]
pub(super) struct Dot {
    pub at: [f64; 2],
    /// The index in the layer.
    pub index: usize,
    /// How many points of the layer it stands for.
    pub count: usize,
}

/// What remains of a layer.
#[derive(Debug, Clone)]
pub(super) enum Shape {
    Lines(Vec<Vec<[f64; 2]>>),
    Dots(Vec<Dot>),
    Area(Vec<[f64; 2]>),
    Place([f64; 2]),
    Image(Placed),
    Nothing,
}

/// How much detail is left out; 1 is invisible, more is for figures that would be too large.
pub(super) fn shapes(panel: &Panel, frame: &Frame, coarseness: f64) -> Vec<Shape> {
    panel.layers.iter().map(|layer| shape(layer, frame, coarseness)).collect()
}

fn shape(layer: &Layer, frame: &Frame, coarseness: f64) -> Shape {
    let tolerance = 0.15 * coarseness;
    let map = |points: &[[f64; 2]]| points.iter().map(|p| frame.map(*p)).collect::<Vec<_>>();
    match layer {
        Layer::Curve { points, .. } => lines(frame, &map(points), tolerance),
        Layer::Band { outline, .. } => {
            let mut area = clip_polygon(&frame.plot, &map(outline));
            if let Some(&first) = area.first() {
                area.push(first);
                area = simplify_closed(&area, tolerance);
            }
            Shape::Area(area)
        }
        Layer::Rule { rule, .. } => match ends(*rule, frame) {
            Some(ends) => lines(frame, &map(&ends), tolerance),
            None => Shape::Nothing,
        },
        Layer::Image(image) => {
            let spans = [&frame.spans.x, &frame.spans.y];
            placed(image, &frame.plot, spans).map_or(Shape::Nothing, Shape::Image)
        }
        Layer::Points { points, .. } => Shape::Dots(dots(points, frame, 0.5 * coarseness)),
        Layer::Note { at, .. } | Layer::ThisCase { at, .. } => {
            let at = frame.map(*at);
            if Rect::has(at, &frame.plot.grown(0.5)) { Shape::Place(at) } else { Shape::Nothing }
        }
    }
}

fn lines(frame: &Frame, points: &[[f64; 2]], tolerance: f64) -> Shape {
    let pieces = clip_polyline(&frame.plot, points);
    Shape::Lines(pieces.iter().map(|piece| simplify(piece, tolerance)).collect())
}

/// A closed line may start at any of its points, and may be dense going either way.
fn simplify_closed(area: &[[f64; 2]], tolerance: f64) -> Vec<[f64; 2]> {
    let middle = area.len() / 2;
    let mut first = simplify(&area[..=middle], tolerance);
    first.pop();
    first.extend(simplify(&area[middle..], tolerance));
    first.pop();
    first
}

/// Two points of a rule outside the plot or on its edge, in data coordinates.
fn ends(rule: Rule, frame: &Frame) -> Option<[[f64; 2]; 2]> {
    let (x, y) = (frame.spans.x, frame.spans.y);
    match rule {
        Rule::Horizontal(v) => Some([[x.first, v], [x.last, v]]),
        Rule::Vertical(v) => Some([[v, y.first], [v, y.last]]),
        Rule::Sloped { through, slope } => {
            let at = |v: f64| [v, through[1] + slope * (v - through[0])];
            (slope.is_finite()).then(|| [at(x.first), at(x.last)])
        }
    }
}

/// The visible points; one that is closer than `distance` to an earlier one is represented by that one, unless
/// it has a label.
fn dots(points: &[MarkedPoint], frame: &Frame, distance: f64) -> Vec<Dot> {
    let edge = frame.plot.grown(0.5);
    let mut kept: Vec<Dot> = Vec::new();
    let mut cells: BTreeMap<[i64; 2], Vec<usize>> = BTreeMap::new();
    for (index, point) in points.iter().enumerate() {
        let at = frame.map([point.x, point.y]);
        if !Rect::has(at, &edge) {
            continue;
        }
        let [column, row] = at.map(|v| (v / distance).floor() as i64);
        let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| [column + dx, row + dy]));
        let near = around.filter_map(|cell| cells.get(&cell)).flatten().copied().find(|&k| {
            let other = kept[k].at;
            libm::hypot(other[0] - at[0], other[1] - at[1]) < distance
        });
        match near.filter(|_| point.label.is_none()) {
            Some(k) => kept[k].count += 1,
            None => {
                cells.entry([column, row]).or_default().push(kept.len());
                kept.push(Dot { at, index, count: 1 });
            }
        }
    }
    kept
}
