//! How well an average, or a largest value, is known from its scatter.

use std::f64::consts::PI;

/// Twice the standard error of the mean of `blocks`, averages over stretches of equal length; infinite
/// for fewer than two. Stretches shorter than a motion remembers make it too small.
pub fn twice_standard_error(blocks: &[f64]) -> f64 {
    let count = blocks.len() as f64;
    deviation(blocks).map_or(f64::INFINITY, |deviation| 2.0 * deviation / count.sqrt())
}

/// How many times as long a run is whose largest value is spoken of.
const LONGER: f64 = 10.0;
/// Odds at which that stays within the error of what was seen.
const ODDS: f64 = 19.0;

/// By how much the largest value of another run, ten times as long as this one, may exceed that of this
/// one, at odds of 19 to 1, from the largest values of its `blocks`, stretches of equal length; 0 for fewer
/// than two. Where the largest of `runs` such runs is known, see [`error_of_largest_of`].
///
/// Largest values of long blocks follow a Gumbel law with the scale `beta = s sqrt(6)/pi`, `s` their
/// standard deviation, and the largest of `n` blocks lies `beta ln n` higher (Gumbel, Statistics of
/// Extremes, 1958; Coles, An Introduction to Statistical Modeling of Extreme Values, 2001, chapter 3). So
/// the longer run is expected `beta ln 10` higher, and the difference of two such values is logistic: it
/// stays below another `beta ln 19` in 19 of 20 cases. A motion within bounds grows by less.
pub fn error_of_largest(blocks: &[f64]) -> f64 {
    let scale = |deviation: f64| deviation * 6.0_f64.sqrt() / PI;
    deviation(blocks).map_or(0.0, |deviation| scale(deviation) * libm::log(LONGER * ODDS))
}

/// The share of that error which remains for the largest of so many runs: the longer run is then no longer
/// ten times as long as all of them together.
pub fn error_of_largest_of(runs: u32) -> f64 {
    let longer = (LONGER / f64::from(runs.max(1))).max(1.0);
    libm::log(longer * ODDS) / libm::log(LONGER * ODDS)
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
    use super::{drifts, error_of_largest, error_of_largest_of, twice_standard_error};

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

    /// By hand: variance 5/3, and sqrt(6) ln(190)/pi = 4.0910.
    #[test]
    fn the_error_of_a_largest_value_follows_from_the_scatter_of_blocks() {
        let error = error_of_largest(&[1.0, 2.0, 3.0, 4.0]);
        assert!((error - 4.091_03 * (5.0_f64 / 3.0).sqrt()).abs() < 1e-4, "{error}");
        assert_eq!((error_of_largest(&[7.0; 16]), error_of_largest(&[7.0])), (0.0, 0.0));
        // ln(190/5) / ln(190), and never less than ln(19) / ln(190).
        assert!((error_of_largest_of(5) - 3.637_59 / 5.247_02).abs() < 1e-5);
        assert!((error_of_largest_of(400) - 2.944_44 / 5.247_02).abs() < 1e-5);
        assert_eq!(error_of_largest_of(1), 1.0);
    }
}
