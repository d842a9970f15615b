//! Places that a label could take, and how good each would be.

use super::geometry::{Point, Rect, depth, distance, is_inside, lerp};
use super::layers::Layer;
use super::shapes::ShapeOfLayer;
use super::text::Anchor;

/// The eight sides of a point, the liked ones first: by what side the words are held, how far down they are,
/// and a small penalty.
const SIDES: [(Anchor, f64, f64); 8] = [
    (Anchor::Start, -1.0, 0.0),
    (Anchor::End, -1.0, 0.3),
    (Anchor::Middle, -1.0, 0.4),
    (Anchor::Start, 0.0, 0.6),
    (Anchor::End, 0.0, 0.8),
    (Anchor::Start, 1.0, 1.0),
    (Anchor::End, 1.0, 1.2),
    (Anchor::Middle, 1.0, 1.4),
];
/// From what is named to words beside it, and to words with a leader, pixels.
const CLOSE: [f64; 2] = [4.5, 8.0];
const FAR: [f64; 6] = [14.0, 20.0, 28.0, 38.0, 50.0, 64.0];

/// A place for words.
#[derive(Debug, Clone, Copy)]
pub(super) struct Candidate {
    pub room: Rect,
    /// Where the words are held, so that they stay close to what they name if they run narrower.
    pub anchor: Anchor,
    /// Lower is better.
    pub penalty: f64,
    /// A line from the words to what they name, where they are far from it.
    pub leader: Option<[Point; 2]>,
}

impl Candidate {
    /// Words right on a place.
    fn on(at: Point, size: Point, penalty: f64) -> Self {
        let room = Rect::around(at, size[0], size[1]);
        Self { room, anchor: Anchor::Middle, penalty, leader: None }
    }
}

/// Where the name of a layer can go; nowhere where nothing of the layer is visible.
pub(super) fn of_layer(layer: &Layer, shape: &ShapeOfLayer, size: Point) -> Vec<Candidate> {
    let close = |(at, radius, penalty)| around(at, radius, &CLOSE, penalty, size);
    match (layer, shape) {
        (_, ShapeOfLayer::Lines(lines)) => {
            sampled(lines).into_iter().flat_map(|(at, penalty)| close((at, 0.5, penalty))).collect()
        }
        (Layer::Points { marker, .. }, ShapeOfLayer::Dots(dots)) => {
            let some = dots.iter().step_by(dots.len().div_ceil(60).max(1));
            some.flat_map(|dot| close((dot.at, marker.diameter / 2.0, 0.0))).collect()
        }
        (_, ShapeOfLayer::Area(area)) => within(area, size),
        _ => Vec::new(),
    }
}

/// Where the words of a marked point can go: beside its marker, or on its place where it has none, then further
/// and further from it.
pub(super) fn of_point(at: Point, radius: f64, size: Point) -> Vec<Candidate> {
    let on = (radius == 0.0).then(|| Candidate::on(at, size, 0.0));
    let beside = around(at, radius, &CLOSE, 1.0, size);
    on.into_iter().chain(beside).chain(around(at, radius, &FAR, 10.0, size)).collect()
}

/// Words on the sides of a marker of some radius, with a leader where they are far from it.
fn around(
    at: Point,
    radius: f64,
    gaps: &'static [f64],
    penalty: f64,
    size: Point,
) -> impl Iterator<Item = Candidate> {
    let place = move |gap: f64, (anchor, down, side): (Anchor, f64, f64)| {
        let right = 1.0 - 2.0 * anchor.part();
        let gaps = radius + gap;
        let at_side =
            [at[0] + right * (size[0] / 2.0 + gaps), at[1] + down * (size[1] / 2.0 + gaps)];
        let room = Rect::around(at_side, size[0], size[1]);
        let far = gap >= FAR[0];
        let leader = if far { leader(at, radius + 1.5, &room) } else { None };
        let gap = if far { gap } else { 0.15 * gap };
        Candidate { room, anchor, penalty: penalty + side + gap, leader }
    };
    gaps.iter().flat_map(move |gap| SIDES.map(|side| place(*gap, side)))
}

/// The line from the edge of a marker to the nearest point of the words' room.
fn leader(at: Point, radius: f64, room: &Rect) -> Option<[Point; 2]> {
    let end = [at[0].clamp(room.left, room.right), at[1].clamp(room.top, room.bottom)];
    let length = distance(at, end);
    let reach = length - 1.5;
    (reach > radius + 2.0).then(|| [radius, reach].map(|way| lerp(at, end, way / length)))
}

/// Places on lines about every ten pixels; the middle is liked a little better than the ends.
fn sampled(lines: &[Vec<Point>]) -> Vec<(Point, f64)> {
    const EVERY: f64 = 10.0;
    let pairs = || lines.iter().flat_map(|line| line.windows(2));
    let total: f64 = pairs().map(|pair| distance(pair[0], pair[1])).sum();
    let every = EVERY.max(total / 400.0);
    let (mut passed, mut next, mut all) = (0.0, 0.5 * every.min(total), Vec::new());
    for pair in pairs() {
        let step = distance(pair[0], pair[1]);
        while next <= passed + step && step > 0.0 {
            let at = lerp(pair[0], pair[1], (next - passed) / step);
            all.push((at, 4.0 * (next / total - 0.55).abs()));
            next += every;
        }
        passed += step;
    }
    all
}

/// Inside an area, far from its edges; beside it with a leader where it is too narrow.
fn within(area: &[Point], size: Point) -> Vec<Candidate> {
    const STEPS: u32 = 40;
    let Some(&first) = area.first() else { return Vec::new() };
    let (low, high) = area.iter().fold((first, first), |(low, high), p| {
        ([low[0].min(p[0]), low[1].min(p[1])], [high[0].max(p[0]), high[1].max(p[1])])
    });
    let (mut all, mut deepest) = (Vec::new(), (0.0, first));
    let (room, step) = (size[1] / 2.0, (high[1] - low[1]) / f64::from(STEPS));
    for right in 0..=STEPS {
        // Depth grows no faster than way: most points of a column cannot be deep enough.
        let mut at_most = f64::INFINITY;
        for down in 0..=STEPS {
            let [right, down] = [right, down].map(|step| f64::from(step) / f64::from(STEPS));
            let at = [lerp(low, high, right)[0], lerp(low, high, down)[1]];
            at_most += step;
            if at_most < room.min(deepest.0) {
                continue;
            }
            let depth_here = depth(area, at);
            // Rounding is far below a pixel.
            at_most = depth_here + 1e-6;
            if depth_here > deepest.0 {
                deepest = (depth_here, at);
            }
            let place = Candidate::on(at, size, 20.0 - depth_here.min(20.0));
            let Rect { left, top, right, bottom } = place.room;
            let corners = [[left, top], [right, top], [left, bottom], [right, bottom]];
            if depth_here > room && corners.iter().all(|corner| is_inside(area, *corner)) {
                all.push(place);
            }
        }
    }
    all.extend(around(deepest.1, 3.0, &FAR, 50.0, size));
    all
}
