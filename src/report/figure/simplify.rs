//! Fewer points, same picture: every function here moves a line by less than its tolerance.

use super::geometry::square_distance;

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
