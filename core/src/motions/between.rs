//! How bad a number may be between two places of a band: by the one rule that every structure and every number has.
//!
//! Around a smooth top, whose neighbours are lower by as much as it is from its own, half of what the places around differ by is
//! enough; steep flanks and scatter make it wide. Where places are at uneven distances the top of the parabola through the worse
//! of the two and its neighbours may be higher.

use crate::numerics::scan::top_of;

/// The worst that a number may be between `around[right - 1]` and `around[right]`, of up to two places to either side, ascending,
/// each with where it is and the number there, larger being worse.
pub(super) fn worst_between(around: &[[f64; 2]], right: usize) -> f64 {
    let value = |k: usize| around[k][1];
    let largest = around.iter().map(|one| one[1]).fold(f64::NEG_INFINITY, f64::max);
    let smallest = around.iter().map(|one| one[1]).fold(f64::INFINITY, f64::min);
    let scatter = value(right - 1).max(value(right)) + 0.5 * (largest - smallest);
    let top = |k: usize| {
        let around = around.get(k.checked_sub(1)?..k + 2)?;
        top_of([around[0], around[1], around[2]])
    };
    [right - 1, right].into_iter().filter_map(top).fold(scatter, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of y = 2 - x^2, wherever it is seen: at 4 to 1 half of what -2, 2 and 3 differ by is too little.
    #[test]
    fn the_top_of_a_parabola_is_never_above() {
        let mut inside = 0;
        for (left, right) in [(0.8, 3.0), (3.0, 0.8), (1.0, 1.0), (2.0, 0.6), (4.0, 1.0)] {
            for off in [-1.0, -0.3, 0.0, 0.05, 0.4, 2.0] {
                let places = [off - left, off, off + right].map(|x: f64| [x, 2.0 - x * x]);
                for gap in [1, 2] {
                    if places[gap - 1][0] <= 0.0 && 0.0 <= places[gap][0] {
                        inside += 1;
                        let most = worst_between(&places, gap);
                        assert!(most >= 2.0 - 1e-12, "{places:?} {gap} {most}");
                    }
                }
            }
        }
        assert!(inside > 25, "{inside}");
    }

    /// A difference between places that almost coincide says nothing of what lies far from them.
    #[test]
    fn places_that_almost_coincide_have_no_slope() {
        let places = [[0.0, 1.0], [1e-9, 1.1], [1.0, 0.2]];
        assert!((worst_between(&places, 2) - 1.55).abs() < 1e-12);
    }
}
