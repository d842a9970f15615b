//! Lines along the edges of cells: where neighbours differ, and nowhere else.

/// A line between the cells that differ, as one curve whose pieces are separated by NaN. Cells in which nothing
/// is known have no line around them.
///
/// `cells` are row by row from the smallest ordinate; edges are in the units of the axes.
pub(super) fn between<T: PartialEq>(
    cells: &[Option<T>],
    x_edges: &[f64],
    y_edges: &[f64],
) -> Vec<[f64; 2]> {
    let (across, up) = (x_edges.len() - 1, y_edges.len() - 1);
    let cell = |column: usize, row: usize| cells[row * across + column].as_ref();
    let differ = |a: Option<&T>, b: Option<&T>| a.zip(b).is_some_and(|(a, b)| a != b);
    let mut lattice = Lattice {
        across: across + 1,
        right: vec![false; (across + 1) * (up + 1)],
        above: vec![false; (across + 1) * (up + 1)],
    };
    for row in 0..up {
        for column in 0..across {
            let here = cell(column, row);
            if row > 0 && differ(here, cell(column, row - 1)) {
                lattice.right[row * (across + 1) + column] = true;
            }
            if column > 0 && differ(here, cell(column - 1, row)) {
                lattice.above[row * (across + 1) + column] = true;
            }
        }
    }
    let mut curve = Vec::new();
    for piece in lattice.pieces() {
        if !curve.is_empty() {
            curve.push([f64::NAN; 2]);
        }
        curve.extend(piece.iter().map(|[column, row]| [x_edges[*column], y_edges[*row]]));
    }
    curve
}

/// Corners of cells and the edges between them that are still to be walked.
struct Lattice {
    /// Corners in a row.
    across: usize,
    /// From each corner to the next on its right.
    right: Vec<bool>,
    /// From each corner to the next above it.
    above: Vec<bool>,
}

impl Lattice {
    /// Every edge once, in pieces that are as long as they can be; corners in a straight line are left out.
    fn pieces(&mut self) -> Vec<Vec<[usize; 2]>> {
        let mut pieces = Vec::new();
        // Where three or four lines meet, and where a line ends, a piece begins; what is left is closed.
        for closed in [false, true] {
            for corner in 0..self.right.len() {
                while self.degree(corner) > 0 && (closed || self.degree(corner) != 2) {
                    let piece = self.walk(corner);
                    pieces.push(piece);
                }
            }
        }
        pieces
    }

    /// The corners next to one, along edges that are left.
    fn neighbours(&self, corner: usize) -> impl Iterator<Item = usize> + '_ {
        let (column, row) = (corner % self.across, corner / self.across);
        let rows = self.right.len() / self.across;
        let right = (column + 1 < self.across && self.right[corner]).then(|| corner + 1);
        let left = (column > 0 && self.right[corner.wrapping_sub(1)]).then(|| corner - 1);
        let up = (row + 1 < rows && self.above[corner]).then(|| corner + self.across);
        let down = (row > 0 && self.above[corner - self.across]).then(|| corner - self.across);
        [right, up, left, down].into_iter().flatten()
    }

    fn degree(&self, corner: usize) -> usize {
        self.neighbours(corner).count()
    }

    fn walk(&mut self, start: usize) -> Vec<[usize; 2]> {
        let place = |corner: usize, across: usize| [corner % across, corner / across];
        let mut piece = vec![place(start, self.across)];
        let mut corner = start;
        loop {
            let Some(next) = self.neighbours(corner).next() else { break };
            let low = corner.min(next);
            if low + 1 == corner.max(next) {
                self.right[low] = false;
            } else {
                self.above[low] = false;
            }
            corner = next;
            let at = place(corner, self.across);
            if let [.., before, last] = piece.as_slice() {
                let straight = (before[0] == last[0] && last[0] == at[0])
                    || (before[1] == last[1] && last[1] == at[1]);
                if straight {
                    piece.pop();
                }
            }
            piece.push(at);
            // Elsewhere than on a simple line another piece begins.
            if corner == start || self.degree(corner) != 1 {
                break;
            }
        }
        piece
    }
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
