//! How well a share of starts is known.

/// 97.5 % quantile of the normal distribution.
const QUANTILE: f64 = 1.959_963_984_540_054;

/// Wilson's 95 % interval for a share seen as `hits` of `tries` (Wilson 1927; Brown, Cai, DasGupta
/// 2001 recommend it for small counts): the shares `p` from which `hits / tries` is not further away
/// than 1.96 standard errors `sqrt(p (1 - p) / tries)`. Without tries nothing is known: 0 to 1.
///
/// The starts are evenly spread, not random; for smooth basins the interval errs on the wide side.
pub fn wilson(hits: u32, tries: u32) -> [f64; 2] {
    if tries == 0 {
        return [0.0, 1.0];
    }
    let (hits, n) = (f64::from(hits.min(tries)), f64::from(tries));
    let square = QUANTILE * QUANTILE;
    let middle = hits + 0.5 * square;
    let reach = QUANTILE * (hits * (n - hits) / n + 0.25 * square).sqrt();
    let ends = [(middle - reach) / (n + square), (middle + reach) / (n + square)];
    ends.map(|end| end.clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand with z^2 = 3.841459: 0 of n gives z^2/(n + z^2) above; 10 of 20 gives
    /// 1/2 +- z/2 / sqrt(n + z^2); the ends solve (share - p)^2 = z^2 p (1 - p)/n.
    #[test]
    fn the_interval_is_wilsons() {
        let square = 3.841_458_820_694_124;
        let near = |found: [f64; 2], expected: [f64; 2]| {
            let off = (found[0] - expected[0]).abs().max((found[1] - expected[1]).abs());
            assert!(off < 1e-12, "{found:?}, not {expected:?}");
        };
        near(wilson(0, 32), [0.0, square / (32.0 + square)]);
        near(wilson(32, 32), [32.0 / (32.0 + square), 1.0]);
        let half = 0.5 * (square / (20.0 + square)).sqrt();
        near(wilson(10, 20), [0.5 - half, 0.5 + half]);
        for (hits, tries) in [(1, 7), (5, 32), (31, 32), (400, 1000)] {
            let (n, share) = (f64::from(tries), f64::from(hits) / f64::from(tries));
            for end in wilson(hits, tries) {
                let distance = (share - end) * (share - end) - square * end * (1.0 - end) / n;
                assert!(distance.abs() < 1e-14, "{hits} of {tries}: {end}");
            }
        }
        assert_eq!(wilson(0, 0), [0.0, 1.0]);
    }
}
