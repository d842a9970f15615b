//! Lines along the edges of cells: where neighbours differ, and nowhere else.

use std::collections::{BTreeMap, BTreeSet};

/// A corner of cells: its column and its row.
type Corner = [usize; 2];
/// Edges between neighbouring corners that are still to be walked, by either end.
type Edges = BTreeMap<Corner, BTreeSet<Corner>>;

/// A line between the cells that differ, as one curve whose pieces are separated by NaN. Cells in which nothing
/// is known have no line around them.
///
/// `cells` are row by row from the smallest ordinate.
pub(super) fn between<T: PartialEq>(
    cells: &[Option<T>],
    x_edges: &[f64],
    y_edges: &[f64],
) -> Vec<[f64; 2]> {
    let across = x_edges.len() - 1;
    let differ =
        |a: usize, b: usize| cells[a].as_ref().zip(cells[b].as_ref()).is_some_and(|(a, b)| a != b);
    let mut edges = Edges::new();
    let mut join = |a: Corner, b: Corner| {
        edges.entry(a).or_default().insert(b);
        edges.entry(b).or_default().insert(a);
    };
    for cell in 0..cells.len() {
        let (column, row) = (cell % across, cell / across);
        if row > 0 && differ(cell, cell - across) {
            join([column, row], [column + 1, row]);
        }
        if column > 0 && differ(cell, cell - 1) {
            join([column, row], [column, row + 1]);
        }
    }
    let pieces = pieces(edges);
    let drawn = pieces.iter().map(|piece| {
        piece.iter().map(|[column, row]| [x_edges[*column], y_edges[*row]]).collect::<Vec<_>>()
    });
    drawn.collect::<Vec<_>>().join(&[f64::NAN; 2])
}

/// Every edge once, in pieces that are as long as they can be; corners in a straight line are left out.
fn pieces(mut edges: Edges) -> Vec<Vec<Corner>> {
    let corners: Vec<Corner> = edges.keys().copied().collect();
    let mut pieces = Vec::new();
    // Where three or four lines meet, and where a line ends, a piece begins; what is left is closed.
    for closed in [false, true] {
        for corner in &corners {
            while !edges[corner].is_empty() && (closed || edges[corner].len() != 2) {
                pieces.push(walk(&mut edges, *corner));
            }
        }
    }
    pieces
}

fn walk(edges: &mut Edges, start: Corner) -> Vec<Corner> {
    let mut piece = vec![start];
    let mut corner = start;
    while let Some(next) = edges.get_mut(&corner).and_then(BTreeSet::pop_first) {
        let back = edges.entry(next).or_default();
        back.remove(&corner);
        // Elsewhere than on a simple line another piece begins.
        let ends = next == start || back.len() != 1;
        if let [.., before, last] = piece.as_slice()
            && (0..2).any(|k| before[k] == last[k] && last[k] == next[k])
        {
            piece.pop();
        }
        piece.push(next);
        corner = next;
        if ends {
            break;
        }
    }
    piece
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two kinds and one unknown cell: the line runs where the kinds meet and not around the unknown.
    #[test]
    fn a_line_runs_where_neighbours_differ() {
        // Row by row from below; the unknown cell is the middle of the upper row.
        let cells = [Some(1), Some(1), Some(2), Some(1), None, Some(2)];
        let curve = between(&cells, &[0.0, 1.0, 2.0, 4.0], &[10.0, 20.0, 30.0]);
        assert_eq!(curve, [[2.0, 10.0], [2.0, 20.0]]);
        assert!(between(&[Some('a'); 6], &[0.0, 1.0, 2.0, 3.0], &[0.0, 1.0, 2.0]).is_empty());
    }

    /// An island has a closed line of four corners.
    #[test]
    fn an_island_is_gone_round_once() {
        let mut cells = [Some(false); 9];
        cells[4] = Some(true);
        let edges = [0.0, 1.0, 2.0, 3.0];
        let curve = between(&cells, &edges, &edges);
        assert_eq!(curve.len(), 5, "{curve:?}");
        assert_eq!(curve[0], curve[4]);
        for corner in [[1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0]] {
            assert!(curve.contains(&corner), "{curve:?}");
        }
    }

    /// Where three kinds meet, every edge is drawn exactly once.
    #[test]
    fn three_kinds_meet_in_a_point() {
        let cells = [Some(1), Some(2), Some(3), Some(3)];
        let curve = between(&cells, &[0.0, 1.0, 2.0], &[0.0, 1.0, 2.0]);
        let mut length = 0.0;
        for pair in curve.windows(2) {
            let step = (pair[1][0] - pair[0][0]).abs() + (pair[1][1] - pair[0][1]).abs();
            length += if step.is_nan() { 0.0 } else { step };
        }
        assert_eq!(length, 3.0, "{curve:?}");
    }
}
