//! Places that a label could take, and how good each would be.

use super::geometry::{Rect, in_polygon, square_distance};
use super::text::Anchor;

/// The eight sides of a point, the liked ones first: `[right, down]`, and a small penalty.
const SIDES: [([f64; 2], f64); 8] = [
    ([1.0, -1.0], 0.0),
    ([-1.0, -1.0], 0.3),
    ([0.0, -1.0], 0.4),
    ([1.0, 0.0], 0.6),
    ([-1.0, 0.0], 0.8),
    ([1.0, 1.0], 1.0),
    ([-1.0, 1.0], 1.2),
    ([0.0, 1.0], 1.4),
];

/// A place for words.
#[derive(Debug, Clone)]
pub(super) struct Candidate {
    pub room: Rect,
    /// Where the words are held, so that they stay close to what they name if they run narrower.
    pub anchor: Anchor,
    /// Lower is better.
    pub penalty: f64,
    /// A line from the words to what they name, where they are far from it.
    pub leader: Option<[[f64; 2]; 2]>,
}

/// What the words name.
#[derive(Debug, Clone)]
pub(super) enum Target {
    /// Lines; the words go beside one of them.
    Lines(Vec<Vec<[f64; 2]>>),
    /// Points that are named together, with the radius of their markers.
    Dots(Vec<[f64; 2]>, f64),
    /// An area; the words go into it.
    Area(Vec<[f64; 2]>),
    /// One point, with the radius of its marker.
    Point([f64; 2], f64),
    /// The words stand for themselves.
    Place([f64; 2]),
}

/// Every place worth trying.
pub(super) fn candidates(
    target: &Target,
    size: [f64; 2],
    near: Option<[f64; 2]>,
) -> Vec<Candidate> {
    let mut all = match target {
        Target::Lines(lines) => along(lines, size),
        Target::Dots(dots, radius) => {
            let every = dots.len().div_ceil(60).max(1);
            dots.iter().step_by(every).flat_map(|at| around(*at, radius + 5.0, size)).collect()
        }
        Target::Area(area) => within(area, size),
        Target::Point(at, radius) => rings(*at, *radius, size),
        Target::Place(at) => nearby(*at, size),
    };
    if let Some(near) = near {
        for candidate in &mut all {
            let center = candidate.room.center();
            candidate.penalty += 0.3 * libm::hypot(center[0] - near[0], center[1] - near[1]);
        }
    }
    all
}

/// The words on one side of a point.
fn beside(at: [f64; 2], side: [f64; 2], gap: f64, size: [f64; 2]) -> Candidate {
    let center = [at[0] + side[0] * (size[0] / 2.0 + gap), at[1] + side[1] * (size[1] / 2.0 + gap)];
    let anchor = if side[0] > 0.0 {
        Anchor::Start
    } else if side[0] < 0.0 {
        Anchor::End
    } else {
        Anchor::Middle
    };
    Candidate { room: Rect::around(center, size[0], size[1]), anchor, penalty: 0.0, leader: None }
}

fn around(at: [f64; 2], gap: f64, size: [f64; 2]) -> impl Iterator<Item = Candidate> {
    SIDES
        .into_iter()
        .map(move |(side, penalty)| Candidate { penalty, ..beside(at, side, gap, size) })
}

/// Beside the lines, about every ten pixels; the middle is liked a little better than the ends.
fn along(lines: &[Vec<[f64; 2]>], size: [f64; 2]) -> Vec<Candidate> {
    const EVERY: f64 = 10.0;
    let length = |a: [f64; 2], b: [f64; 2]| libm::hypot(b[0] - a[0], b[1] - a[1]);
    let total: f64 =
        lines.iter().flat_map(|line| line.windows(2)).map(|pair| length(pair[0], pair[1])).sum();
    let every = EVERY.max(total / 400.0);
    let (mut passed, mut next, mut all) = (0.0, 0.5 * every.min(total), Vec::new());
    for pair in lines.iter().flat_map(|line| line.windows(2)) {
        let step = length(pair[0], pair[1]);
        while next <= passed + step && step > 0.0 {
            let t = (next - passed) / step;
            let at = [0, 1].map(|i| pair[0][i] + t * (pair[1][i] - pair[0][i]));
            let off_middle = 4.0 * (next / total - 0.55).abs();
            for gap in [5.0, 9.0] {
                all.extend(
                    around(at, gap, size)
                        .map(|c| Candidate { penalty: c.penalty + off_middle + 0.15 * gap, ..c }),
                );
            }
            next += every;
        }
        passed += step;
    }
    all
}

/// Inside an area, far from its edges; beside it with a leader where it is too narrow.
fn within(area: &[[f64; 2]], size: [f64; 2]) -> Vec<Candidate> {
    let [mut least, mut most] = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    for p in area {
        for i in 0..2 {
            least[i] = least[i].min(p[i]);
            most[i] = most[i].max(p[i]);
        }
    }
    let step = [0, 1].map(|i| ((most[i] - least[i]) / 40.0).max(2.0));
    let (mut all, mut deepest) = (Vec::new(), (-1.0, area.first().copied().unwrap_or_default()));
    for i in 0..=40 {
        for k in 0..=40 {
            let at = [least[0] + f64::from(i) * step[0], least[1] + f64::from(k) * step[1]];
            if at[0] > most[0] || at[1] > most[1] || !in_polygon(area, at) {
                continue;
            }
            let depth = depth(area, at);
            if depth > deepest.0 {
                deepest = (depth, at);
            }
            let room = Rect::around(at, size[0], size[1]);
            let corners = [
                [room.left, room.top],
                [room.right, room.top],
                [room.left, room.bottom],
                [room.right, room.bottom],
            ];
            if depth > size[1] / 2.0 && corners.iter().all(|c| in_polygon(area, *c)) {
                let penalty = 20.0 - depth.min(20.0);
                all.push(Candidate { room, anchor: Anchor::Middle, penalty, leader: None });
            }
        }
    }
    if !area.is_empty() {
        let beside = rings(deepest.1, 3.0, size).into_iter().filter(|c| c.leader.is_some());
        all.extend(beside.map(|c| Candidate { penalty: c.penalty + 40.0, ..c }));
    }
    all
}

/// The distance of a point from the edges of an area.
fn depth(area: &[[f64; 2]], p: [f64; 2]) -> f64 {
    let before = |i: usize| area[(i + area.len() - 1) % area.len()];
    let edges = area.iter().enumerate().map(|(i, b)| square_distance(p, before(i), *b));
    edges.fold(f64::INFINITY, f64::min).sqrt()
}

/// Beside a point, then further and further from it, with a leader where that is far.
fn rings(at: [f64; 2], radius: f64, size: [f64; 2]) -> Vec<Candidate> {
    const CLOSE: f64 = 7.0;
    let mut all = Vec::new();
    for gap in [4.0, 6.5, 14.0, 20.0, 28.0, 38.0, 50.0, 64.0] {
        for candidate in around(at, radius + gap, size) {
            let leader = (gap > CLOSE).then(|| leader(at, radius + 1.5, &candidate.room)).flatten();
            let far = if gap > CLOSE { 10.0 } else { 0.0 };
            all.push(Candidate { penalty: candidate.penalty + gap + far, leader, ..candidate });
        }
    }
    all
}

/// The line from the edge of a marker to the nearest point of the words' room.
fn leader(at: [f64; 2], radius: f64, room: &Rect) -> Option<[[f64; 2]; 2]> {
    let end = [at[0].clamp(room.left, room.right), at[1].clamp(room.top, room.bottom)];
    let (dx, dy) = (end[0] - at[0], end[1] - at[1]);
    let length = libm::hypot(dx, dy);
    let reach = length - 1.5;
    (reach > radius + 2.0).then(|| {
        let on = |distance: f64| [at[0] + dx * distance / length, at[1] + dy * distance / length];
        [on(radius), on(reach)]
    })
}

/// At a place, or as near to it as possible.
fn nearby(at: [f64; 2], size: [f64; 2]) -> Vec<Candidate> {
    let mut all = Vec::new();
    for ring in 0..=14 {
        let radius = 5.0 * f64::from(ring);
        let around = if ring == 0 { 1 } else { 12 };
        for k in 0..around {
            let (sin, cos) = libm::sincos(f64::from(k) * core::f64::consts::TAU / 12.0);
            let center = [at[0] + radius * cos, at[1] + radius * sin];
            let room = Rect::around(center, size[0], size[1]);
            all.push(Candidate { room, anchor: Anchor::Middle, penalty: radius, leader: None });
        }
    }
    all
}
