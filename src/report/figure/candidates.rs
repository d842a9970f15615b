//! Places that a label could take, and how good each would be.

use super::geometry::{Point, Rect, depth, distance, lerp};
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
    fn at(center: Point, size: Point, anchor: Anchor, penalty: f64) -> Self {
        Self { room: Rect::around(center, size[0], size[1]), anchor, penalty, leader: None }
    }
}

/// Words of some size on the sides of a point.
fn around(at: Point, gap: f64, size: Point) -> impl Iterator<Item = Candidate> {
    SIDES.into_iter().map(move |(anchor, down, penalty)| {
        let right = 1.0 - 2.0 * anchor.part();
        let center = [at[0] + right * (size[0] / 2.0 + gap), at[1] + down * (size[1] / 2.0 + gap)];
        Candidate::at(center, size, anchor, penalty)
    })
}

/// Beside lines, about every ten pixels; the middle is liked a little better than the ends.
pub(super) fn along(lines: &[Vec<Point>], size: Point) -> Vec<Candidate> {
    const EVERY: f64 = 10.0;
    let pairs = || lines.iter().flat_map(|line| line.windows(2));
    let total: f64 = pairs().map(|pair| distance(pair[0], pair[1])).sum();
    let every = EVERY.max(total / 400.0);
    let (mut passed, mut next, mut all) = (0.0, 0.5 * every.min(total), Vec::new());
    for pair in pairs() {
        let step = distance(pair[0], pair[1]);
        while next <= passed + step && step > 0.0 {
            let at = lerp(pair[0], pair[1], (next - passed) / step);
            let off_middle = 4.0 * (next / total - 0.55).abs();
            for gap in [5.0, 9.0] {
                let penalty = off_middle + 0.15 * gap;
                let worse = |c: Candidate| Candidate { penalty: c.penalty + penalty, ..c };
                all.extend(around(at, gap, size).map(worse));
            }
            next += every;
        }
        passed += step;
    }
    all
}

/// Beside one of many points with markers of some radius that are named together.
pub(super) fn among(points: &[Point], radius: f64, size: Point) -> Vec<Candidate> {
    let every = points.len().div_ceil(60).max(1);
    points.iter().step_by(every).flat_map(|at| around(*at, radius + 5.0, size)).collect()
}

/// Inside an area, far from its edges; beside it with a leader where it is too narrow.
pub(super) fn within(area: &[Point], size: Point) -> Vec<Candidate> {
    const STEPS: u32 = 40;
    let Some(&first) = area.first() else { return Vec::new() };
    let (low, high) = area.iter().fold((first, first), |(low, high), p| {
        ([low[0].min(p[0]), low[1].min(p[1])], [high[0].max(p[0]), high[1].max(p[1])])
    });
    let (mut all, mut deepest) = (Vec::new(), (0.0, first));
    for (i, k) in (0..=STEPS).flat_map(|i| (0..=STEPS).map(move |k| (i, k))) {
        let [right, down] = [i, k].map(|step| f64::from(step) / f64::from(STEPS));
        let at = [lerp(low, high, right)[0], lerp(low, high, down)[1]];
        let depth_here = depth(area, at);
        if depth_here > deepest.0 {
            deepest = (depth_here, at);
        }
        let place = Candidate::at(at, size, Anchor::Middle, 20.0 - depth_here.min(20.0));
        let Rect { left, top, right, bottom } = place.room;
        let corners = [[left, top], [right, top], [left, bottom], [right, bottom]];
        if depth_here > size[1] / 2.0 && corners.iter().all(|c| depth(area, *c) >= 0.0) {
            all.push(place);
        }
    }
    let beside = rings(deepest.1, 3.0, size).into_iter().filter(|c| c.leader.is_some());
    all.extend(beside.map(|c| Candidate { penalty: c.penalty + 40.0, ..c }));
    all
}

/// Beside a point, then further and further from it, with a leader where that is far.
pub(super) fn rings(at: Point, radius: f64, size: Point) -> Vec<Candidate> {
    const CLOSE: f64 = 7.0;
    let mut all = Vec::new();
    for gap in [4.0, 6.5, 14.0, 20.0, 28.0, 38.0, 50.0, 64.0] {
        for near in around(at, radius + gap, size) {
            if gap < CLOSE {
                all.push(Candidate { penalty: near.penalty + gap, ..near });
            } else {
                let leader = leader(at, radius + 1.5, &near.room);
                all.push(Candidate { penalty: near.penalty + gap + 10.0, leader, ..near });
            }
        }
    }
    all
}

/// The line from the edge of a marker to the nearest point of the words' room.
fn leader(at: Point, radius: f64, room: &Rect) -> Option<[Point; 2]> {
    let end = [at[0].clamp(room.left, room.right), at[1].clamp(room.top, room.bottom)];
    let length = distance(at, end);
    let reach = length - 1.5;
    (reach > radius + 2.0).then(|| [radius, reach].map(|way| lerp(at, end, way / length)))
}

/// At a place, or beside it.
pub(super) fn nearby(at: Point, size: Point) -> Vec<Candidate> {
    let mut all = vec![Candidate::at(at, size, Anchor::Middle, 0.0)];
    all.extend(rings(at, 0.0, size));
    all
}
