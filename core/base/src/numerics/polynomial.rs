//! Polynomials: the one through some points, and real roots, between those of the derivative.

use nalgebra::{DMatrix, DVector};

use super::bracket::bisected;

/// Coefficients, by ascending power, of the polynomial through points at different places; none where
/// two of these are one, or a number is not finite.
pub fn through(points: &[(f64, f64)]) -> Vec<f64> {
    let count = points.len();
    let power = |row: usize, column: usize| libm::pow(points[row].0, column as f64);
    let values = DVector::from_iterator(count, points.iter().map(|point| point.1));
    let found = DMatrix::from_fn(count, count, power).lu().solve(&values);
    let finite = found.filter(|found| found.iter().all(|one| one.is_finite()));
    finite.map_or_else(Vec::new, |found| found.iter().copied().collect())
}

/// All real roots, ascending; `coefficients` ascend by power. Between neighbouring roots of the
/// derivative, and beyond them, a polynomial changes its sign at most once. Roots of even multiplicity
/// may be found or not, as rounding has it.
pub fn real_roots(coefficients: &[f64]) -> Vec<f64> {
    let degree = coefficients.iter().rposition(|coefficient| *coefficient != 0.0).unwrap_or(0);
    if degree == 0 {
        return Vec::new();
    }
    let coefficients = &coefficients[..=degree];
    let slope: Vec<f64> = (1..=degree).map(|power| power as f64 * coefficients[power]).collect();
    // Twice Cauchy's bound: a root may lie so close to it that the value there is rounding.
    let largest = coefficients[..degree].iter().fold(0.0_f64, |most, c| most.max(c.abs()));
    let bound = 2.0 + 2.0 * largest / coefficients[degree].abs();
    let mut places = vec![-bound];
    places.extend(real_roots(&slope));
    places.push(bound);
    let value = |at: f64| coefficients.iter().rev().fold(0.0, |sum, c| sum * at + c);
    places.windows(2).filter_map(|pair| bisected([pair[0], pair[1]], value)).collect()
}

/// Real roots of `constant + linear x + square x^2`, ascending, by the formula that does not
/// cancel.
pub fn quadratic_roots([constant, linear, square]: [f64; 3]) -> Vec<f64> {
    let discriminant = linear * linear - 4.0 * square * constant;
    if square == 0.0 || discriminant.is_nan() || discriminant < 0.0 {
        return Vec::new();
    }
    let q = -0.5 * (linear + discriminant.sqrt().copysign(linear));
    let mut roots = if q == 0.0 { vec![0.0] } else { vec![q / square, constant / q] };
    roots.sort_by(f64::total_cmp);
    roots
}

#[cfg(test)]
mod tests {
    use super::{real_roots, through};
    use proptest::prelude::*;

    fn expand(roots: &[f64]) -> Vec<f64> {
        let mut coefficients = vec![1.0];
        for root in roots {
            let mut next = vec![0.0; coefficients.len() + 1];
            for (n, c) in coefficients.iter().enumerate() {
                next[n + 1] += c;
                next[n] -= root * c;
            }
            coefficients = next;
        }
        coefficients
    }

    #[test]
    fn what_has_no_roots_gives_none() {
        for coefficients in
            [&[][..], &[0.0, 0.0], &[3.0], &[1.0, 0.0, 1.0], &[1.0, 0.0, 2.0, 0.0, 1.0]]
        {
            assert_eq!(real_roots(coefficients), [] as [f64; 0], "{coefficients:?}");
        }
        // A leading coefficient that is zero lowers the degree.
        let found = real_roots(&[-2.0, 1.0, 0.0]);
        assert!(found.len() == 1 && (found[0] - 2.0).abs() < 1e-15, "{found:?}");
    }

    #[test]
    fn scales_from_tiny_to_huge_are_handled() {
        let roots = [-1e30, 1e-30, 1.0, 9.5, 1e15];
        let found = real_roots(&expand(&roots));
        assert_eq!(found.len(), roots.len(), "{found:?}");
        for (found, root) in found.iter().zip(roots) {
            assert!((found / root - 1.0).abs() < 1e-14, "{found} {root}");
        }
    }

    /// By hand: `1 - 2 x + 3 x^2`.
    #[test]
    fn the_polynomial_through_points_has_its_coefficients() {
        let found = through(&[(-1.0, 6.0), (0.5, 0.75), (2.0, 9.0)]);
        assert!(
            found.iter().zip([1.0, -2.0, 3.0]).all(|(a, b)| (a - b).abs() < 1e-14),
            "{found:?}"
        );
        assert!(through(&[(1.0, 2.0), (1.0, 3.0)]).is_empty());
        assert!(through(&[(1.0, f64::NAN), (2.0, 3.0)]).is_empty());
    }

    /// A leading coefficient that is all but zero puts the slope's root next to Cauchy's bound.
    #[test]
    fn a_root_is_found_beside_one_that_rounding_has_put_far_away() {
        let found = real_roots(&[26.714064776353187, -16.20566834238112, -1.2789769243681799e-15]);
        assert_eq!(found.len(), 2, "{found:?}");
        assert!((found[1] - 1.648_439_4).abs() < 1e-6, "{found:?}");
    }

    proptest! {
        /// Roots in steps of 1/8 make exact coefficients, so that the truth is known.
        #[test]
        fn every_simple_root_is_found(eighths in prop::collection::btree_set(-64_i32..64, 1..5)) {
            let roots: Vec<f64> = eighths.iter().map(|n| f64::from(*n) / 8.0).collect();
            let found = real_roots(&expand(&roots));
            prop_assert_eq!(found.len(), roots.len());
            for (found, root) in found.iter().zip(roots) {
                // Values up to 8^4 are rounded; the slope at a root is at least (1/8)^3.
                prop_assert!((found - root).abs() < 1e-8, "{found} {root}");
            }
        }
    }
}
