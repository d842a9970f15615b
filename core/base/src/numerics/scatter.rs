//! How well an average, or a largest value, is known from its scatter.

use std::f64::consts::PI;

/// Twice the standard error of the mean of `blocks`, averages over stretches of equal length; infinite
/// for fewer than two. Stretches shorter than a motion remembers make it too small.
pub fn twice_standard_error(blocks: &[f64]) -> f64 {
    let count = blocks.len() as f64;
    deviation(blocks).map_or(f64::INFINITY, |deviation| 2.0 * deviation / count.sqrt())
}

/// Parts of a window whose averages are compared. Those of a tenth are independent of one another unless a motion remembers
/// for longer; then those of a fifth, or whole windows, scatter more than so many parts should.
const PARTS: [usize; 3] = [10, 5, 1];
/// Fewest averages that say how much they scatter.
const FEWEST_PARTS: usize = 4;

/// Twice the standard error of the mean of what was seen in windows of one motion, numbers of stretches of equal length that
/// follow one another in each; infinite for fewer than two of them. Averages of tenths and of fifths of a window and of whole
/// windows are compared: the largest of their errors knows the longest memory that was seen. It is widened by Student's law
/// for so few averages, and to what first halves differ by from second ones.
pub fn twice_error_of_mean(windows: &[&[f64]]) -> f64 {
    if windows.iter().map(|one| one.len()).sum::<usize>() < 2 {
        return f64::INFINITY;
    }
    let of_parts = |parts: usize| {
        let blocks: Vec<f64> = windows
            .iter()
            .flat_map(|one| one.chunks_exact((one.len() / parts).max(1)))
            .map(mean)
            .collect();
        let too_few = parts < PARTS[0] && blocks.len() < FEWEST_PARTS;
        if too_few { 0.0 } else { twice_standard_error(&blocks) * student(blocks.len()) }
    };
    let halves = |one: &&[f64]| {
        let (first, second) = one.split_at(one.len() / 2);
        mean(second) - mean(first)
    };
    let long = windows.iter().filter(|one| one.len() >= 2);
    let changes: Vec<f64> = long.map(halves).collect();
    PARTS.into_iter().map(of_parts).fold(mean(&changes).abs(), f64::max)
}

/// The error of a root, from that of its square, which varies twice as much.
pub fn error_of_root(root: f64, of_square: f64) -> f64 {
    of_square / (2.0 * root).max(f64::MIN_POSITIVE)
}

/// The 97.5 % quantile of Student's law for the mean of so many numbers, over that of the normal one: its expansion in the
/// inverse of the degrees of freedom (Abramowitz and Stegun, 1964, 26.7.5), within 3 % from three of them on.
fn student(count: usize) -> f64 {
    let inverse = 1.0 / count.saturating_sub(1).max(1) as f64;
    1.0 + inverse * (1.21 + inverse * (1.44 + 1.34 * inverse))
}

fn mean(of: &[f64]) -> f64 {
    of.iter().sum::<f64>() / of.len().max(1) as f64
}

/// How many times as long a run is whose largest value is spoken of.
pub const LONGER: f64 = 10.0;
/// Odds at which that stays within the error of what was seen.
const ODDS: f64 = 19.0;
/// Blocks of a window at most; shorter ones say nothing of its largest values.
const MOST_BLOCKS: usize = 16;
/// Fewest blocks of all windows together: fewer say nothing.
const FEWEST_BLOCKS: usize = 4;
/// Correlation that is none, and the same in standard errors of a correlation.
const NO_CORRELATION: f64 = 0.05;
const BY_CHANCE: f64 = 2.0;
/// Stretches of a window between which correlation is looked for: of a longer one several count as one.
const STRETCHES: usize = 1024;

/// By how much the largest value of another run, `longer` times as long as these windows of one motion together, may exceed
/// the largest seen in them, at odds of 19 to 1, from the largest values of stretches of equal length that follow one another
/// in each; 0 for fewer than two.
///
/// Blocks are twice as long as the motion remembers, but for the stretch that all of it happens in, so that a motion whose
/// bursts are rare has few. Largest values of blocks follow a Gumbel law with the scale `beta = s sqrt(6)/pi`, `s` their
/// standard deviation, and the largest of `n` lies `beta ln n` higher (Gumbel, Statistics of Extremes, 1958; Coles, An
/// Introduction to Statistical Modeling of Extreme Values, 2001, chapter 3). So the longer run is expected `beta ln(longer)` higher, and the difference of two such values is logistic:
/// it stays below another `beta ln 19` in 19 of 20 cases. That is widened for the error of `beta` itself. Where the tail is
/// heavier than Gumbel's the largest quarter of all blocks says so: an exponential tail has the scale of its mean excess.
pub fn error_of_largest(windows: &[&[f64]], longer: f64) -> f64 {
    let windows: Vec<Vec<f64>> = windows.iter().map(|one| shortened(one)).collect();
    let block = 2.0 * memory(&windows) - 1.0;
    let fewest = FEWEST_BLOCKS.div_ceil(windows.len().max(1));
    let largest = |block: &[f64]| block.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let of_window = |one: &Vec<f64>| {
        let count = ((one.len() as f64 / block) as usize).clamp(fewest, MOST_BLOCKS);
        let length = (one.len() / count).max(1);
        one.chunks_exact(length).map(largest).collect::<Vec<f64>>()
    };
    let mut blocks: Vec<f64> = windows.iter().flat_map(of_window).collect();
    let Some(deviation) = deviation(&blocks) else { return 0.0 };
    let whole = deviation * 6.0_f64.sqrt() / PI * few(blocks.len());
    blocks.sort_by(|a, b| b.total_cmp(a));
    let (tail, others) = blocks.split_at(blocks.len().div_ceil(4));
    let excess = others.first().map_or(0.0, |from| mean(tail) - from);
    let of_tail = excess * (1.0 + 1.0 / (tail.len() as f64).sqrt());
    let of_tail = if tail.len() < 2 { 0.0 } else { of_tail };
    whole.max(of_tail) * libm::log(longer.max(1.0) * ODDS)
}

/// By how much the error of a scale that is known from so many blocks widens that of the largest value: the 95 % quantile of
/// the difference of two largest values over the standard deviation of `n` blocks, over what it is for many. Within 8 % of
/// 400,000 simulated samples of 2 to 128 blocks for runs of 1 to 10 times their length.
fn few(blocks: usize) -> f64 {
    let further = (blocks as f64 - 1.0).max(1.0);
    1.0 + 0.6 / (blocks as f64).sqrt() + 3.3 / further + 6.5 / (further * further * further)
}

/// The same with several stretches as one, their largest, where there are many.
fn shortened(window: &[f64]) -> Vec<f64> {
    let together = window.len().div_ceil(STRETCHES).max(1);
    window.chunks(together).map(|some| some.iter().copied().fold(some[0], f64::max)).collect()
}

/// Stretches for which a motion remembers: its integrated correlation time over all windows, up to half a window.
fn memory(windows: &[Vec<f64>]) -> f64 {
    let count = windows.iter().map(Vec::len).sum::<usize>().max(1) as f64;
    let mean = windows.iter().flatten().sum::<f64>() / count;
    let covariance = |lag: usize| {
        let of = |one: &Vec<f64>| {
            let pairs = one.iter().zip(&one[lag.min(one.len())..]);
            pairs.map(|(a, b)| (a - mean) * (b - mean)).sum::<f64>()
        };
        let pairs = windows.iter().map(|one| one.len().saturating_sub(lag)).sum::<usize>();
        windows.iter().map(of).sum::<f64>() / pairs.max(1) as f64
    };
    let (variance, none) = (covariance(0), NO_CORRELATION.max(BY_CHANCE / count.sqrt()));
    let longest = windows.iter().map(Vec::len).max().unwrap_or(0) / 2;
    let each = (1..longest).map(|lag| covariance(lag) / variance);
    1.0 + 2.0 * each.take_while(|one| *one >= none).sum::<f64>()
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
    use super::{
        LONGER, drifts, error_of_largest, student, twice_error_of_mean, twice_standard_error,
    };

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

    /// By hand: four blocks, deviation s = sqrt(5/3): s sqrt(6)/pi (1 + 0.3 + 1.1 + 6.5/27) ln 190. Ten times the same
    /// says nothing new of the scatter, and a longer run reaches no further than it is longer.
    #[test]
    fn the_error_of_a_largest_value_follows_from_the_scatter_of_blocks() {
        let blocks = [1.0, 4.0, 3.0, 2.0];
        let error = error_of_largest(&[&blocks], LONGER);
        let by_hand = (5.0_f64 / 3.0).sqrt() * 0.779_697 * 2.640_741 * libm::log(190.0);
        assert!((error - by_hand).abs() < 1e-4, "{error}");
        assert!(
            (error_of_largest(&[&blocks], 1.0) / error - libm::log(19.0) / libm::log(190.0)).abs()
                < 1e-12
        );
        assert_eq!(
            (error_of_largest(&[&[7.0; 16]], LONGER), error_of_largest(&[&[7.0]], LONGER)),
            (0.0, 0.0)
        );
        assert!(error_of_largest(&[&blocks, &blocks, &blocks], LONGER) < 0.8 * error);
    }

    /// A sequence that is evenly spread in 0 to 1, without a period.
    fn spread(k: u32) -> f64 {
        libm::modf(f64::from(k) * 0.618_033_988_749_894_9).0
    }

    /// Bursts: 200 numbers that hold one of four heights each. A block of twenty says nothing that its neighbour does not.
    #[test]
    fn what_remembers_for_long_has_few_independent_blocks() {
        let quick: Vec<f64> = (0..800).map(spread).collect();
        let slow: Vec<f64> = (0..800).map(|k| spread(k / 200)).collect();
        let heights: Vec<f64> = (0..4).map(spread).collect();
        let [quick, slow, four] =
            [quick, slow, heights].map(|one| error_of_largest(&[&one], LONGER));
        assert!(quick < 0.5 && slow > 4.0 * quick, "{quick} {slow}");
        // Four blocks with an error of their own, not sixteen.
        assert!((slow / four - 1.0).abs() < 1e-12, "{slow} {four}");
    }

    /// A heavy tail: three blocks in four are alike, and the others are as far above as an exponential law has them.
    #[test]
    fn a_heavy_tail_counts_by_its_own_excess() {
        let (even, heavy): (Vec<f64>, Vec<f64>) = (0..64)
            .map(|k| {
                let p = (f64::from(k * 37 % 64) + 0.5) / 64.0;
                (
                    -libm::log(-libm::log(p)),
                    if p < 0.75 { p } else { 0.75 - 3.0 * libm::log(4.0 * (1.0 - p)) },
                )
            })
            .unzip();
        // Gumbel's own numbers stay with their deviation: 1.2 with 64 blocks of twice the memory of one.
        let [even, heavy] = [even, heavy].map(|one| {
            let windows: Vec<&[f64]> = one.chunks(4).collect();
            error_of_largest(&windows, LONGER)
        });
        assert!(
            (even / libm::log(190.0) - 1.2).abs() < 0.25 && heavy > 2.5 * even,
            "{even} {heavy}"
        );
    }

    /// Where all numbers are independent the error is that of their mean, but for Student's law; where a window remembers all
    /// of it, that of the windows; and two halves are never closer than they are.
    #[test]
    fn the_error_of_an_average_knows_the_longest_memory() {
        let quick: Vec<f64> = (0..1000).map(|k| spread(k * k % 997)).collect();
        let alone = twice_error_of_mean(&[&quick]);
        let independent = 2.0 * (1.0_f64 / 12.0 / 1000.0).sqrt();
        assert!(alone > 0.4 * independent && alone < 2.5 * independent, "{alone} {independent}");
        let windows: Vec<Vec<f64>> = (0..16)
            .map(|w| (0..200).map(|k| f64::from(w % 4) + 0.01 * quick[k]).collect())
            .collect();
        let windows: Vec<&[f64]> = windows.iter().map(Vec::as_slice).collect();
        // Sixteen windows of heights 0 to 3: variance 4/3.
        let of_windows = 2.0 * (4.0_f64 / 3.0 / 16.0).sqrt();
        let error = twice_error_of_mean(&windows);
        assert!(error >= of_windows && error < 1.1 * of_windows, "{error} {of_windows}");
        let drifting: Vec<f64> = (0..100).map(|k| if k < 50 { 1.0 } else { 2.0 }).collect();
        assert!(twice_error_of_mean(&[&drifting]) >= 1.0);
        assert_eq!(twice_error_of_mean(&[&[3.0; 50]]), 0.0);
        assert_eq!(twice_error_of_mean(&[&[3.0]]), f64::INFINITY);
        // Student's law with 3, 9 and 159 degrees of freedom: 3.182, 2.262 and 1.975 over 1.960.
        for (count, truth) in [(4, 1.6237), (10, 1.1542), (160, 1.0077)] {
            assert!((student(count) / truth - 1.0).abs() < 0.03, "{count} {}", student(count));
        }
    }
}
