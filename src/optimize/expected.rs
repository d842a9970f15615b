//! The expected objective of an absorber whose parameters are uncertain: Gauss quadrature, every
//! combination of the nodes of each uncertain parameter.

use super::search::{Spread, map};
use super::task::{Deviation, Task};
use crate::case::{Choice, Distribution, Objective, Uncertainty};
use crate::numerics::gauss;

/// Nodes of each uncertain parameter where that many are uncertain, from none to four, for an
/// objective in closed form: at most 625 together. Shares have kinks, which many nodes even out.
const CLOSED_FORM: [usize; 5] = [1, 21, 15, 7, 5];
/// The same for one that needs orbits, which cost ten times as much: at most 125.
const ORBITS: [usize; 5] = [1, 15, 7, 5, 3];

/// Errors of one parameter with their weights; a certain one has a single node.
fn nodes(distribution: Distribution, count: usize) -> Vec<(f64, f64)> {
    let (rule, size) = match distribution {
        Distribution::Certain => return vec![(0.0, 1.0)],
        Distribution::Normal(deviation) => (gauss::normal(count), deviation),
        Distribution::Uniform(largest) => (gauss::uniform(count), largest),
    };
    rule.into_iter().map(|(node, weight)| (node * size, weight)).collect()
}

/// All combinations of deviations with their weights, which add up to 1; `count` nodes of each
/// uncertain parameter.
pub fn combinations(uncertainty: &Uncertainty, count: usize) -> Vec<(Deviation, f64)> {
    let Uncertainty { clearance, restitution, frequency_ratio, amplitude } = *uncertainty;
    let [clearances, restitutions, frequency_ratios, amplitudes] =
        [clearance, restitution, frequency_ratio, amplitude].map(|one| nodes(one, count));
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
    /// Nodes of each uncertain parameter.
    pub fn nodes(&self) -> usize {
        let counts = if self.objective == Objective::Z3Share { CLOSED_FORM } else { ORBITS };
        counts[self.uncertainty.count()]
    }

    /// The combinations of deviations over which is averaged.
    pub fn deviations(&self) -> Vec<(Deviation, f64)> {
        combinations(&self.uncertainty, self.nodes())
    }

    /// The average objective over deviations with weights; `None` where one leaves no system.
    pub fn expected(
        &self,
        choice: &Choice,
        deviations: &[(Deviation, f64)],
        spread: &dyn Spread,
    ) -> Option<f64> {
        let scores = map(spread, "", deviations.len(), |k| self.score(choice, &deviations[k].0));
        scores.into_iter().zip(deviations).map(|(score, (_, weight))| Some(weight * score?)).sum()
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
        let all = combinations(&two, 7);
        assert_eq!(all.len(), 49);
        let mean = |of: &dyn Fn(&Deviation) -> f64| -> f64 {
            all.iter().map(|(off, weight)| weight * of(off)).sum()
        };
        assert!((mean(&|_| 1.0) - 1.0).abs() < 1e-14);
        assert!((mean(&|off| off.clearance * off.clearance) - 0.01).abs() < 1e-14);
        assert!((mean(&|off| off.amplitude * off.amplitude) - 0.04 / 3.0).abs() < 1e-14);
        assert!(mean(&|off| off.clearance * off.amplitude).abs() < 1e-16);
        assert_eq!(combinations(&Uncertainty::default(), 7), [(Deviation::default(), 1.0)]);
    }
}
