//! The expected objective of an absorber whose parameters are uncertain: Gauss-Hermite quadrature, five
//! points for each uncertain parameter, every combination of them.

use super::task::{Deviation, Task};
use crate::case::{Choice, Uncertainty};

/// Nodes and weights for a standard normal error: exact for polynomials up to the ninth degree.
const NODES: [(f64, f64); 5] = [
    (-2.856_970_013_872_805_6, 0.011_257_411_327_720_69),
    (-1.355_626_179_974_265_7, 0.222_075_922_005_612_64),
    (0.0, 8.0 / 15.0),
    (1.355_626_179_974_265_7, 0.222_075_922_005_612_64),
    (2.856_970_013_872_805_6, 0.011_257_411_327_720_69),
];

/// Nodes of one parameter; a certain one has a single node.
fn nodes(deviation: f64) -> impl Iterator<Item = (f64, f64)> + Clone {
    let certain = deviation == 0.0;
    let all = NODES.into_iter().filter(move |(node, _)| !certain || *node == 0.0);
    all.map(move |(node, weight)| (node * deviation, if certain { 1.0 } else { weight }))
}

/// All combinations of deviations with their weights, which add up to 1.
pub fn combinations(uncertainty: &Uncertainty) -> Vec<(Deviation, f64)> {
    let mut found = Vec::new();
    for (clearance, a) in nodes(uncertainty.clearance) {
        for (restitution, b) in nodes(uncertainty.restitution) {
            for (frequency_ratio, c) in nodes(uncertainty.frequency_ratio) {
                for (amplitude, d) in nodes(uncertainty.amplitude) {
                    let off = Deviation { clearance, restitution, frequency_ratio, amplitude };
                    found.push((off, a * b * c * d));
                }
            }
        }
    }
    found
}

impl Task {
    /// The expected objective; `None` where a deviation leaves no system.
    pub fn expected(&self, choice: &Choice) -> Option<f64> {
        let mut sum = 0.0;
        for (off, weight) in combinations(&self.uncertainty) {
            sum += weight * self.score(choice, &off)?;
        }
        Some(sum)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The moments of a normal error up to the ninth are those of the nodes.
    #[test]
    fn moments_are_those_of_a_normal_error() {
        for (power, moment) in
            [(0.0, 1.0), (1.0, 0.0), (2.0, 1.0), (4.0, 3.0), (6.0, 15.0), (8.0, 105.0), (9.0, 0.0)]
        {
            let moments = NODES.iter().map(|(node, weight)| weight * libm::pow(*node, power));
            let sum: f64 = moments.sum();
            assert!((sum - moment).abs() < 1e-11 * (1.0 + moment), "{power}: {sum}");
        }
        let two = Uncertainty { clearance: 0.1, amplitude: 0.2, ..Uncertainty::default() };
        assert_eq!(combinations(&two).len(), 25);
        assert_eq!(combinations(&Uncertainty::default()), [(Deviation::default(), 1.0)]);
    }
}
