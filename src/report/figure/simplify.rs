//! Fewer points, same picture: every function here moves a line by less than its tolerance.

use std::collections::BTreeMap;

/// A curve is cut into pieces of this many points before it is simplified, so that the worst case
/// (no point can go) costs a bounded time per point. It adds one point per thousand.
const PIECE: usize = 1024;

/// From that many points per pixel column on, a curve that never runs backwards is reduced to the
/// four points per column that decide its picture.
const DENSE: f64 = 4.0;

/// Reduces a polyline in pixels. No point of the original is further than `tolerance` from the
/// result, but for the columns of a dense series, which keep first, least, greatest and last point.
pub(super) fn simplify(points: &[[f64; 2]], tolerance: f64) -> Vec<[f64; 2]> {
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return Vec::new() };
    let column = (tolerance / 0.15).max(1.0);
    let monotone = points.windows(2).all(|pair| pair[0][0] <= pair[1][0]);
    let dense = points.len() as f64 > DENSE * (last[0] - first[0]).abs() / column;
    if monotone && dense && points.len() > 16 {
        return peucker(&columns(points, column), tolerance);
    }
    peucker(points, tolerance)
}

/// First, least, greatest and last point of every pixel column, in their order.
fn columns(points: &[[f64; 2]], width: f64) -> Vec<[f64; 2]> {
    let mut kept = Vec::new();
    let of = |p: &[f64; 2]| (p[0] / width).floor();
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
fn peucker(points: &[[f64; 2]], tolerance: f64) -> Vec<[f64; 2]> {
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

/// The squared distance of a point from a segment (not from the line through it: a curve may turn back).
fn square_distance(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let square = dx * dx + dy * dy;
    let t = if square > 0.0 { ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square } else { 0.0 };
    let t = t.clamp(0.0, 1.0);
    let (ex, ey) = (p[0] - a[0] - t * dx, p[1] - a[1] - t * dy);
    ex * ex + ey * ey
}

/// Points that stand for themselves and for others closer than a distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Merged {
    /// The index of the one that is drawn.
    pub index: usize,
    /// How many it stands for, itself included.
    pub count: usize,
}

/// Lets every point that is closer than `distance` to an earlier one be represented by that one.
/// Points for which `alone` holds stand for themselves.
pub(super) fn merge(
    points: &[[f64; 2]],
    distance: f64,
    alone: impl Fn(usize) -> bool,
) -> Vec<Merged> {
    let mut kept: Vec<Merged> = Vec::new();
    let mut cells: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
    for (index, point) in points.iter().enumerate() {
        let cell = ((point[0] / distance).floor() as i64, (point[1] / distance).floor() as i64);
        let near = (-1..=1)
            .flat_map(|dx| (-1..=1).map(move |dy| (cell.0 + dx, cell.1 + dy)))
            .filter_map(|cell| cells.get(&cell))
            .flatten()
            .copied()
            .find(|&k| {
                let other = points[kept[k].index];
                libm::hypot(other[0] - point[0], other[1] - point[1]) < distance
            });
        match near {
            Some(k) if !alone(index) => kept[k].count += 1,
            _ => {
                cells.entry(cell).or_default().push(kept.len());
                kept.push(Merged { index, count: 1 });
            }
        }
    }
    kept
}
