//! The expected objective of an absorber whose parameters are uncertain: Gauss quadrature, every
//! combination of the nodes of each uncertain parameter.

use super::task::{Deviation, Task};
use crate::case::{Choice, Distribution, Uncertainty};
use crate::numerics::gauss;

/// Nodes of each uncertain parameter.
const NODES: usize = 5;

/// Errors of one parameter with their weights; a certain one has a single node.
fn nodes(distribution: Distribution) -> Vec<(f64, f64)> {
    let (rule, size) = match distribution {
        Distribution::Certain => return vec![(0.0, 1.0)],
        Distribution::Normal(deviation) => (gauss::normal(NODES), deviation),
        Distribution::Uniform(largest) => (gauss::uniform(NODES), largest),
    };
    rule.into_iter().map(|(node, weight)| (node * size, weight)).collect()
}

/// All combinations of deviations with their weights, which add up to 1.
pub fn combinations(uncertainty: &Uncertainty) -> Vec<(Deviation, f64)> {
    let Uncertainty { clearance, restitution, frequency_ratio, amplitude } = *uncertainty;
    let [clearances, restitutions, frequency_ratios, amplitudes] =
        [clearance, restitution, frequency_ratio, amplitude].map(nodes);
    let mut found = Vec::new();
    for (clearance, a) in &clearances {
        for (restitution, b) in &restitutions {
            for (frequency_ratio, c) in &frequency_ratios {
                for (amplitude, d) in &amplitudes {
                    let off = Deviation {
                        clearance: *clearance,
                        restitution: *restitution,
                        frequency_ratio: *frequency_ratio,
                        amplitude: *amplitude,
                    };
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

    /// Averages of squares are s² for a normal error and a²/3 for one up to a.
    #[test]
    fn combinations_have_the_moments_of_their_errors() {
        let two = Uncertainty {
            clearance: Distribution::Normal(0.1),
            amplitude: Distribution::Uniform(0.2),
            ..Uncertainty::default()
        };
        let all = combinations(&two);
        assert_eq!(all.len(), NODES * NODES);
        let mean = |of: &dyn Fn(&Deviation) -> f64| -> f64 {
            all.iter().map(|(off, weight)| weight * of(off)).sum()
        };
        assert!((mean(&|_| 1.0) - 1.0).abs() < 1e-14);
        assert!((mean(&|off| off.clearance * off.clearance) - 0.01).abs() < 1e-14);
        assert!((mean(&|off| off.amplitude * off.amplitude) - 0.04 / 3.0).abs() < 1e-14);
        assert!(mean(&|off| off.clearance * off.amplitude).abs() < 1e-16);
        assert_eq!(combinations(&Uncertainty::default()), [(Deviation::default(), 1.0)]);
    }
}
