//! Layers in pixels: cut at the plot and reduced to what can be seen.

use std::collections::BTreeMap;

use super::data::Panel;
use super::geometry::{Point, clip_polygon, clip_polyline, square_distance};
use super::layers::{Layer, MarkedPoint, Rule};
use super::layout::Frame;

/// How far a line may be from its points where no detail is left out, pixels.
const TOLERANCE: f64 = 0.2;
/// A curve is cut into pieces of this many points before it is simplified, so that the worst case
/// (no point can go) costs a bounded time per point. It adds one point per thousand.
const PIECE: usize = 1024;

/// A point to be drawn.
#[derive(Debug, Clone)]
pub(super) struct Dot {
    pub at: Point,
    /// The index in the layer.
    pub index: usize,
    /// How many points of the layer it stands for.
    pub count: usize,
}

/// What remains of a layer; no lines where nothing does. An image has a way of its own.
#[derive(Debug, Clone)]
pub(super) enum ShapeOfLayer {
    Lines(Vec<Vec<Point>>),
    Dots(Vec<Dot>),
    Area(Vec<Point>),
}

/// How much detail is left out; 1 is invisible, more is for figures that would be too large.
pub(super) fn shapes(panel: &Panel, frame: &Frame, coarseness: f64) -> Vec<ShapeOfLayer> {
    panel.layers.iter().map(|layer| shape(layer, frame, coarseness)).collect()
}

fn shape(layer: &Layer, frame: &Frame, coarseness: f64) -> ShapeOfLayer {
    let tolerance = TOLERANCE * coarseness;
    let map = |points: &[Point]| points.iter().map(|p| frame.map(*p)).collect::<Vec<_>>();
    let lines = |points: &[Point]| {
        let pieces = clip_polyline(&frame.plot, points);
        ShapeOfLayer::Lines(pieces.iter().map(|piece| simplify(piece, tolerance)).collect())
    };
    match layer {
        Layer::Curve { points, .. } => lines(&map(points)),
        Layer::Rule { rule, .. } => lines(&ends(*rule, frame)),
        Layer::Band { outline, .. } => {
            // Their edges are faint, or lie below the lines that bound them.
            ShapeOfLayer::Area(simplify(&clip_polygon(&frame.plot, &map(outline)), 2.0 * tolerance))
        }
        Layer::Image(_) => ShapeOfLayer::Lines(Vec::new()),
        Layer::Points { points, .. } => ShapeOfLayer::Dots(dots(points, frame, 0.5 * coarseness)),
    }
}

/// Two points of a rule outside the plot or on its edge, in pixels.
fn ends(rule: Rule, frame: &Frame) -> [Point; 2] {
    let (x, y) = (frame.spans.x, frame.spans.y);
    match rule {
        Rule::Horizontal(v) => [0.0, 1.0].map(|part| frame.place([part, y.part(v)])),
        Rule::Vertical(v) => [0.0, 1.0].map(|part| frame.place([x.part(v), part])),
        Rule::Sloped { through, slope } => {
            x.of_data().map(|v| frame.map([v, through[1] + slope * (v - through[0])]))
        }
    }
}

/// The visible points; of those in one square of this side the first stands for the others, unless they have
/// labels.
fn dots(points: &[MarkedPoint], frame: &Frame, side: f64) -> Vec<Dot> {
    let edge = frame.plot.grown(0.5);
    let mut kept: Vec<Dot> = Vec::new();
    let mut squares: BTreeMap<[i64; 2], usize> = BTreeMap::new();
    for (index, point) in points.iter().enumerate() {
        let at = frame.map([point.x, point.y]);
        if !edge.has(at) {
            continue;
        }
        let first = *squares.entry(at.map(|v| (v / side).floor() as i64)).or_insert(kept.len());
        if first < kept.len() && point.label.is_none() {
            kept[first].count += 1;
        } else {
            kept.push(Dot { at, index, count: 1 });
        }
    }
    kept
}

/// Reduces a polyline in pixels; no point of the original is further than `tolerance` from the result. Keeps,
/// between two kept points, the one furthest from their segment if it is further than the
/// tolerance, and so on (Ramer; Douglas and Peucker).
fn simplify(points: &[Point], tolerance: f64) -> Vec<Point> {
    if points.len() < 3 {
        return points.to_vec();
    }
    let end = points.len() - 1;
    let mut keep = vec![false; points.len()];
    let mut work: Vec<(usize, usize)> =
        (0..end).step_by(PIECE).map(|start| (start, (start + PIECE).min(end))).collect();
    keep[end] = true;
    for &(start, _) in &work {
        keep[start] = true;
    }
    while let Some((a, b)) = work.pop() {
        let mut furthest = (tolerance * tolerance, 0);
        for i in a + 1..b {
            let square = square_distance(points[i], points[a], points[b]);
            if square > furthest.0 {
                furthest = (square, i);
            }
        }
        if furthest.1 > 0 {
            keep[furthest.1] = true;
            work.push((a, furthest.1));
            work.push((furthest.1, b));
        }
    }
    points.iter().zip(&keep).filter(|(_, keep)| **keep).map(|(p, _)| *p).collect()
}
