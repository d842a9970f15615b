//! Gauss quadrature for averages over a distribution, with any number of nodes.

use nalgebra::DMatrix;

/// Nodes and weights for a standard normal number (Gauss-Hermite), ascending. The weights add up to 1;
/// the average of a polynomial up to the degree `2 count - 1` is exact.
pub fn normal(count: usize) -> Vec<(f64, f64)> {
    nodes(count, |k| k.sqrt())
}

/// The same for a number uniformly distributed from -1 to 1 (Gauss-Legendre).
pub fn uniform(count: usize) -> Vec<(f64, f64)> {
    nodes(count, |k| k / (4.0 * k * k - 1.0).sqrt())
}

/// The rule of a symmetric distribution. Nodes are the eigenvalues of the symmetric tridiagonal matrix of
/// the recurrence of its orthonormal polynomials (Golub and Welsch, "Calculation of Gauss quadrature
/// rules", Mathematics of Computation 23, 1969); weights are Christoffel's numbers, one over the sum of
/// their squares, which are good to rounding where a component of an eigenvector is not. `beside(k)` is
/// the k-th number beside the diagonal, from 1.
fn nodes(count: usize, beside: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    let recurrence = DMatrix::from_fn(count, count, |row, column| {
        if row.abs_diff(column) == 1 { beside(row.max(column) as f64) } else { 0.0 }
    });
    let mut found: Vec<f64> = recurrence.symmetric_eigenvalues().iter().copied().collect();
    found.sort_by(f64::total_cmp);
    let weight = |node: f64| {
        let (mut before, mut here, mut sum) = (0.0, 1.0, 1.0);
        let mut last = 0.0;
        for k in 1..count {
            let next = beside(k as f64);
            (before, here) = (here, (node * here - last * before) / next);
            last = next;
            sum += here * here;
        }
        1.0 / sum
    };
    // Rounding leaves the two sides a little apart, and the middle a little off.
    let node = |k: usize| 0.5 * (found[k] - found[count - 1 - k]);
    (0..count).map(|k| (node(k), weight(node(k)))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moment(rule: &[(f64, f64)], power: i32) -> f64 {
        rule.iter().map(|(node, weight)| weight * libm::pow(*node, f64::from(power))).sum()
    }

    /// Moments of a normal number are 1, 1, 3, 15, 105, ..., of a uniform one 1 / (power + 1); odd ones
    /// vanish. Rounding is some 1e-15 of the largest term, which grows as fast as the moment.
    #[test]
    fn moments_are_those_of_the_distribution() {
        for count in [1, 2, 5, 7, 15, 21] {
            let (hermite, legendre) = (normal(count), uniform(count));
            let mut double_factorial = 1.0;
            for half in 0..count as i32 {
                if half > 0 {
                    double_factorial *= f64::from(2 * half - 1);
                }
                let even = 1.0 / f64::from(2 * half + 1);
                let found = moment(&hermite, 2 * half);
                assert!((found / double_factorial - 1.0).abs() < 1e-12, "{count} {half}: {found}");
                let found = moment(&legendre, 2 * half);
                assert!((found / even - 1.0).abs() < 1e-12, "{count} {half}: {found}");
                assert!(moment(&hermite, 2 * half + 1).abs() < 1e-12 * double_factorial.max(1.0));
                assert!(moment(&legendre, 2 * half + 1).abs() < 1e-15);
            }
            // One degree more is beyond the rule: its error is the norm of the next polynomial.
            if count <= 7 {
                let next = double_factorial * f64::from(2 * count as i32 - 1);
                let factorial: f64 = (1..=count).map(|k| k as f64).product();
                let short = next - moment(&hermite, 2 * count as i32);
                assert!((short / factorial - 1.0).abs() < 1e-9, "{count}: {short}");
            }
        }
    }

    /// Abramowitz and Stegun, tables 25.4 and 25.10 (there for the weight exp(-x^2)).
    #[test]
    fn five_nodes_are_those_of_the_tables() {
        let hermite = normal(5);
        assert!((hermite[4].0 - 2.020_182_870_456_086 * std::f64::consts::SQRT_2).abs() < 1e-14);
        assert!((hermite[3].1 - 0.222_075_922_005_612_64).abs() < 1e-15);
        let legendre = uniform(5);
        assert!((legendre[4].0 - 0.906_179_845_938_664).abs() < 1e-15);
        assert!((legendre[4].1 - 0.5 * 0.236_926_885_056_189_1).abs() < 1e-15);
        assert_eq!((hermite[2].0, legendre[2].0), (0.0, 0.0));
    }
}
