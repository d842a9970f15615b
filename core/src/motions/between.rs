//! How bad a number may be between two places of a band: by the one rule that every structure and every number has.
//!
//! Around a smooth top, whose neighbours are lower by as much as it is from its own, half of what the places around differ by is
//! enough; steep flanks and scatter make it wide. Where places are at uneven distances the top of the parabola through the worse
//! of the two and its neighbours may be higher.

/// The worst that a number may be between `around[right - 1]` and `around[right]`, of up to two places to either side, ascending,
/// each with where it is and the number there, larger being worse.
///
/// ```
/// use vinesink_core::motions::worst_between;
/// // A parabola y = -x^2, seen at 0.4 to either side of its top and beyond: what it reaches is less than what it may.
/// let places = [-1.2, -0.4, 0.4, 1.2].map(|x: f64| [x, -x * x]);
/// assert!(worst_between(&places, 2) > 0.0);
/// ```
pub fn worst_between(around: &[[f64; 2]], right: usize) -> f64 {
    let value = |k: usize| around[k][1];
    let largest = around.iter().map(|one| one[1]).fold(f64::NEG_INFINITY, f64::max);
    let smallest = around.iter().map(|one| one[1]).fold(f64::INFINITY, f64::min);
    let worse = if value(right) > value(right - 1) { right } else { right - 1 };
    let scatter = value(worse) + 0.5 * (largest - smallest);
    let beside = |k: usize| {
        let [at, value] = *around.get(k)?;
        let [here, own] = around[worse];
        (value <= own).then_some([at - here, value - own])
    };
    let sides = worse.checked_sub(1).and_then(beside).zip(beside(worse + 1));
    let top = sides.map_or(0.0, |(left, right)| top_above(left, right));
    scatter.max(value(worse) + top)
}

/// By how much the top of the parabola through the origin and two points to its left and right, which are no higher, is above the
/// origin.
fn top_above([left, below_left]: [f64; 2], [right, below_right]: [f64; 2]) -> f64 {
    // y = p x + c x^2.
    let [a, b] = [below_left / left, below_right / right];
    let c = (b - a) / (right - left);
    let p = a - c * left;
    if c < 0.0 { (-0.25 * p * p / c).max(0.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At uneven distances the parabola's own top is higher than half of what the places differ by.
    #[test]
    fn the_top_of_a_parabola_is_never_above() {
        for (left, right) in [(0.1, 3.0), (3.0, 0.1), (1.0, 1.0), (2.0, 0.3)] {
            for off in [-0.3, 0.0, 0.05, 0.4] {
                let at = [off - left, off, off + right];
                let places = at.map(|x: f64| [x, 2.0 - x * x]);
                let most = [1, 2].map(|gap| worst_between(&places, gap));
                let inside = |gap: usize| places[gap - 1][0] <= 0.0 && 0.0 <= places[gap][0];
                for gap in [1, 2] {
                    if inside(gap) {
                        assert!(most[gap - 1] >= 2.0 - 1e-12, "{places:?} {gap} {most:?}");
                    }
                }
            }
        }
    }
}
