//! Modes that stand twice: an exporter that appends, two set-ups of a measurement, a table that was copied.

/// Two modes of a list, by their numbers from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Alike {
    pub first: usize,
    pub second: usize,
    /// One mode written twice; else two that are nearly one.
    pub equal: bool,
}

impl Alike {
    /// How many modes they are.
    pub fn words(self) -> &'static str {
        if self.equal { "one" } else { "nearly one" }
    }
}

/// Up to which difference of frequencies, over the lower one, and sine of the angle between their shapes two modes are one: what
/// rounding to seven and to four digits leaves. Shapes may be scaled otherwise.
const EQUAL: [f64; 2] = [1e-6, 1e-3];
/// The same of what is probably one mode: two estimates of one from measurements. The modal assurance criterion of their shapes is above
/// 0.99.
const NEARLY: [f64; 2] = [0.01, 0.1];

/// Modes that are equal or nearly so, each a frequency and a shape.
pub(super) fn alike(modes: &[(f64, &[f64])]) -> Vec<Alike> {
    let pairs =
        (0..modes.len()).flat_map(|first| (first + 1..modes.len()).map(move |k| (first, k)));
    let found = pairs.filter_map(|(first, second)| {
        let [a, b] = [modes[first], modes[second]];
        let frequency = (a.0 - b.0).abs() / a.0.min(b.0);
        let within = |[most, angle]: [f64; 2]| frequency <= most && sine(a.1, b.1) <= angle;
        within(NEARLY).then(|| Alike { first, second, equal: within(EQUAL) })
    });
    found.collect()
}

/// The sine of the angle between two shapes.
fn sine(a: &[f64], b: &[f64]) -> f64 {
    let largest = |of: &[f64]| of.iter().map(|value| value.abs()).fold(f64::MIN_POSITIVE, f64::max);
    let (most_a, most_b) = (largest(a), largest(b));
    let product = |a: &[f64], of_a: f64, b: &[f64], of_b: f64| -> f64 {
        a.iter().zip(b).map(|(x, y)| (x / of_a) * (y / of_b)).sum()
    };
    let [aa, bb] = [product(a, most_a, a, most_a), product(b, most_b, b, most_b)];
    let along = product(a, most_a, b, most_b) / aa;
    // What is left of the second without its part along the first, so that rounding does not count.
    let left = a.iter().zip(b).map(|(x, y)| y / most_b - along * (x / most_a));
    (left.map(|value| value * value).sum::<f64>() / bb).sqrt()
}

#[cfg(test)]
mod tests {
    use super::{Alike, alike};

    #[test]
    fn modes_that_stand_twice_are_found_whatever_their_scale() {
        let (first, second): (&[f64], &[f64]) = (&[0.34, 1.0], &[-0.714, 1.0]);
        let of = |hz: f64, shape| alike(&[(1.1, first), (6.894, second), (hz, shape)]);
        let pair = |first, equal| vec![Alike { first, second: 2, equal }];
        assert_eq!(of(19.31, &[0.02, 1.0]), []);
        assert_eq!(of(1.1, second), []);
        assert_eq!(of(1.1, first), pair(0, true));
        assert_eq!(of(6.894_000_5, &[1.428, -2.0]), pair(1, true));
        assert_eq!(of(6.894_02, second), pair(1, false));
        assert_eq!(of(1.1, &[0.342, 1.0]), pair(0, false));
        assert_eq!(of(1.105, &[3.4e-300, 1e-299]), pair(0, false));
        assert_eq!(of(1.12, first), []);
        assert_eq!(of(1.1, &[0.6, 1.0]), []);
    }
}
