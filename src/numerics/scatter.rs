//! How well an average, or a largest value, is known from its scatter.

use std::f64::consts::{LN_10, PI};

/// Twice the standard error of the mean of `blocks`, averages over stretches of equal length; infinite
/// for fewer than two. Stretches shorter than a motion remembers make it too small.
pub fn twice_standard_error(blocks: &[f64]) -> f64 {
    let count = blocks.len() as f64;
    deviation(blocks).map_or(f64::INFINITY, |deviation| 2.0 * deviation / count.sqrt())
}

/// By how much the largest value of a run ten times as long is expected to exceed that of this run, from
/// the largest values of its `blocks`, stretches of equal length; 0 for fewer than two.
///
/// Largest values of long blocks follow a Gumbel law with the scale `beta = s sqrt(6)/pi`, `s` their
/// standard deviation, and the largest of `n` blocks lies `beta ln n` higher (Gumbel, Statistics of
/// Extremes, 1958; Coles, An Introduction to Statistical Modeling of Extreme Values, 2001, chapter 3). A
/// motion that stays within bounds grows by less.
pub fn growth_of_largest(blocks: &[f64]) -> f64 {
    match deviation(blocks) {
        Some(deviation) => deviation * 6.0_f64.sqrt() / PI * LN_10,
        None => 0.0,
    }
}

/// Ratio of a straight line's slope to its standard error above which it is none of chance: ten blocks
/// of noise exceed it once in 3000 times.
const SLOPE: f64 = 6.0;
/// Change along that line, over the mean, which is of no consequence.
const LITTLE: f64 = 1e-3;

/// Whether averages over stretches of equal length go up or down, beyond their scatter.
pub fn drifts(blocks: &[f64]) -> bool {
    let count = blocks.len() as f64;
    if count < 3.0 {
        return false;
    }
    let mean = blocks.iter().sum::<f64>() / count;
    let middle = 0.5 * (count - 1.0);
    let places = || (0..blocks.len()).map(|k| k as f64 - middle);
    let spread: f64 = places().map(|at| at * at).sum();
    let slope = places().zip(blocks).map(|(at, block)| at * (block - mean)).sum::<f64>() / spread;
    let rest = |(at, block): (f64, &f64)| block - mean - slope * at;
    let squares: f64 = places().zip(blocks).map(|one| rest(one) * rest(one)).sum();
    let error = (squares / (count - 2.0) / spread).sqrt();
    slope.abs() > SLOPE * error && slope.abs() * count > LITTLE * mean.abs()
}

/// Standard deviation of a sample; none for fewer than two.
fn deviation(sample: &[f64]) -> Option<f64> {
    let count = sample.len() as f64;
    let mean = sample.iter().sum::<f64>() / count;
    let squares: f64 = sample.iter().map(|one| (one - mean) * (one - mean)).sum();
    (count >= 2.0).then(|| (squares / (count - 1.0)).sqrt())
}

#[cfg(test)]
mod tests {
    use super::{drifts, growth_of_largest, twice_standard_error};

    #[test]
    fn the_error_is_that_of_a_mean() {
        // Variance 5/3 of four numbers: the mean's is a quarter of it.
        let error = twice_standard_error(&[1.0, 2.0, 3.0, 4.0]);
        assert!((error - 2.0 * (5.0_f64 / 12.0).sqrt()).abs() < 1e-15);
        assert_eq!(twice_standard_error(&[7.0; 10]), 0.0);
        assert_eq!(twice_standard_error(&[7.0]), f64::INFINITY);
    }

    /// By hand: `0, 1, 2, 3` lies on its line; the second has slope 0.8 and residuals of 0.3, 0.9, 0.9 and
    /// 0.3 about it, so a standard error of 0.42.
    #[test]
    fn a_drift_is_more_than_scatter_and_more_than_little() {
        assert!(drifts(&[1.0, 2.0, 3.0, 4.0]) && drifts(&[4.0, 3.0, 2.0, 1.0]));
        assert!(!drifts(&[1.0, 3.0, 2.0, 4.0]) && !drifts(&[1.0; 10]) && !drifts(&[1.0, 2.0]));
        let little: Vec<f64> = (0..10).map(|k| 1.0 + 0.9e-4 * f64::from(k)).collect();
        let more: Vec<f64> = (0..10).map(|k| 1.0 + 1.1e-4 * f64::from(k)).collect();
        assert!(!drifts(&little) && drifts(&more));
    }

    /// By hand: variance 5/3, and sqrt(6) ln(10)/pi = 1.7953.
    #[test]
    fn the_largest_value_grows_with_the_scatter_of_blocks() {
        let growth = growth_of_largest(&[1.0, 2.0, 3.0, 4.0]);
        assert!((growth - 1.795_29 * (5.0_f64 / 3.0).sqrt()).abs() < 1e-4, "{growth}");
        assert_eq!((growth_of_largest(&[7.0; 16]), growth_of_largest(&[7.0])), (0.0, 0.0));
    }
}
