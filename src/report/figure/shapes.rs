//! Layers in pixels: cut at the plot and reduced to what can be seen.

use std::collections::BTreeMap;

use super::data::Panel;
use super::geometry::{Point, clip_polygon, clip_polyline, distance, square_distance};
use super::layers::{Layer, MarkedPoint, Rule};
use super::layout::Frame;

/// How far a line may be from its points where no detail is left out, pixels.
const TOLERANCE: f64 = 0.2;
/// A curve is cut into pieces of this many points before it is simplified, so that the worst case
/// (no point can go) costs a bounded time per point. It adds one point per thousand.
const PIECE: usize = 1024;

/// From that many points per pixel column on, a curve that never runs backwards is reduced to the
/// four points per column that decide its picture.
const DENSE: f64 = 4.0;

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
pub(super) enum Shape {
    Lines(Vec<Vec<Point>>),
    Dots(Vec<Dot>),
    Area(Vec<Point>),
    Place(Point),
}

/// How much detail is left out; 1 is invisible, more is for figures that would be too large.
pub(super) fn shapes(panel: &Panel, frame: &Frame, coarseness: f64) -> Vec<Shape> {
    panel.layers.iter().map(|layer| shape(layer, frame, coarseness)).collect()
}

fn shape(layer: &Layer, frame: &Frame, coarseness: f64) -> Shape {
    let tolerance = TOLERANCE * coarseness;
    let map = |points: &[Point]| points.iter().map(|p| frame.map(*p)).collect::<Vec<_>>();
    let lines = |points: &[Point]| {
        let pieces = clip_polyline(&frame.plot, &map(points));
        Shape::Lines(pieces.iter().map(|piece| simplify(piece, tolerance)).collect())
    };
    match layer {
        Layer::Curve { points, .. } => lines(points),
        Layer::Rule { rule, .. } => lines(&ends(*rule, frame)),
        Layer::Band { outline, .. } => {
            // Their edges are faint, or lie below the lines that bound them.
            Shape::Area(simplify(&clip_polygon(&frame.plot, &map(outline)), 2.0 * tolerance))
        }
        Layer::Image(_) => Shape::Lines(Vec::new()),
        Layer::Points { points, .. } => Shape::Dots(dots(points, frame, 0.5 * coarseness)),
        Layer::Note { at, .. } | Layer::ThisCase { at, .. } => {
            let at = frame.map(*at);
            let visible = frame.plot.grown(0.5).has(at);
            if visible { Shape::Place(at) } else { Shape::Lines(Vec::new()) }
        }
    }
}

/// Two points of a rule outside the plot or on its edge, in data coordinates.
fn ends(rule: Rule, frame: &Frame) -> [Point; 2] {
    let (x, y) = (frame.spans.x, frame.spans.y);
    match rule {
        Rule::Horizontal(v) => [[x.first, v], [x.last, v]],
        Rule::Vertical(v) => [[v, y.first], [v, y.last]],
        Rule::Sloped { through, slope } => {
            [x.first, x.last].map(|v| [v, through[1] + slope * (v - through[0])])
        }
    }
}

/// The visible points; one that is closer than `reach` to an earlier one is represented by that one, unless
/// it has a label.
fn dots(points: &[MarkedPoint], frame: &Frame, reach: f64) -> Vec<Dot> {
    let edge = frame.plot.grown(0.5);
    let mut kept: Vec<Dot> = Vec::new();
    let mut cells: BTreeMap<[i64; 2], Vec<usize>> = BTreeMap::new();
    for (index, point) in points.iter().enumerate() {
        let at = frame.map([point.x, point.y]);
        if !edge.has(at) {
            continue;
        }
        let [column, row] = at.map(|v| (v / reach).floor() as i64);
        let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| [column + dx, row + dy]));
        let mut near = around.filter_map(|cell| cells.get(&cell)).flatten().copied();
        match near.find(|&k| point.label.is_none() && distance(kept[k].at, at) < reach) {
            Some(k) => kept[k].count += 1,
            None => {
                cells.entry([column, row]).or_default().push(kept.len());
                kept.push(Dot { at, index, count: 1 });
            }
        }
    }
    kept
}

/// Reduces a polyline in pixels. No point of the original is further than `tolerance` from the
/// result, but for the columns of a dense series, which keep first, least, greatest and last point.
fn simplify(points: &[Point], tolerance: f64) -> Vec<Point> {
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return Vec::new() };
    let column = (tolerance / TOLERANCE).max(1.0);
    let monotone = points.windows(2).all(|pair| pair[0][0] <= pair[1][0]);
    let dense = points.len() as f64 > DENSE * (last[0] - first[0]).abs() / column;
    if monotone && dense && points.len() > 16 {
        return peucker(&columns(points, column), tolerance);
    }
    peucker(points, tolerance)
}

/// First, least, greatest and last point of every pixel column, in their order.
fn columns(points: &[Point], width: f64) -> Vec<Point> {
    let mut kept = Vec::new();
    let of = |p: &Point| (p[0] / width).floor();
    for group in points.chunk_by(|a, b| of(a) == of(b)) {
        let by_height = |&a: &usize, &b: &usize| group[a][1].total_cmp(&group[b][1]);
        let least = (0..group.len()).min_by(by_height).unwrap_or(0);
        let greatest = (0..group.len()).max_by(by_height).unwrap_or(0);
        let mut indices = [0, least.min(greatest), least.max(greatest), group.len() - 1].to_vec();
        indices.dedup();
        kept.extend(indices.into_iter().map(|i| group[i]));
    }
    kept
}

/// Keeps, between two kept points, the one furthest from their segment if it is further than the
/// tolerance, and so on (Ramer; Douglas and Peucker).
fn peucker(points: &[Point], tolerance: f64) -> Vec<Point> {
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
