//! The best absorber where parameters are uncertain: its objective expected by Gauss quadrature over every
//! combination of deviations, and the worst at their corners.

use super::OptimizeError;
use super::choose::Proposed;
use super::design::{Judge, JudgedDesign};
use super::search::{self, SearchEffort};
use super::task::Task;
use crate::case::{self, Distribution, Objective};
use crate::executor::{Executor, Serial, map};
use crate::motions::Effort;
use crate::numerics::gauss;
use crate::operating_range::{Uncertain, Varies};
use crate::system::Parameter;

/// The best in expectation. Values are those of the objective.
#[derive(Debug, Clone, PartialEq)]
pub struct Robust {
    /// The absorber, judged as it is written.
    pub design: JudgedDesign,
    /// What it and what the best as written achieve under deviations.
    pub under: [UnderDeviations; 2],
}

/// What an absorber achieves where parameters deviate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnderDeviations {
    /// The expected objective.
    pub expected: f64,
    /// The worst at the corners of the deviations: the largest of uniform ones, two standard deviations.
    pub worst_corner: f64,
}

/// Errors of some numbers, and the weight that they have in an average.
pub type WeightedErrors = (Vec<(Uncertain, f64)>, f64);

/// The same of parameters of a design.
fn of_design(errors: &[(Uncertain, f64)]) -> Vec<(Parameter, f64)> {
    errors.iter().map(|(one, error)| (one.parameter, *error)).collect()
}

/// How thoroughly the expectation of an exact objective is looked for.
const ROBUST: SearchEffort =
    SearchEffort { pieces: 48, particles: 16, steps: 12, width: 1e-3, smooth: true };
/// Nodes of each uncertain parameter where that many are uncertain, from none to six or more, for an
/// objective in closed form: at most 625 together up to six. Shares have kinks, which many nodes even out.
const CLOSED_FORM: [usize; 7] = [1, 21, 15, 7, 5, 3, 2];
/// The same for one that needs orbits, which cost ten times as much: at most 125.
const ORBITS: [usize; 7] = [1, 15, 7, 5, 3, 2, 2];
/// The same while the best in expectation is looked for.
const ORBITS_LOOKED_AT: [usize; 7] = [1, 7, 4, 3, 2, 2, 2];
/// The same for one that needs simulation: at most 27, or two of each.
const SIMULATED: [usize; 7] = [1, 5, 3, 3, 2, 2, 2];
/// Corner of a normally distributed deviation, over its standard deviation.
const SIGMAS: f64 = 2.0;
/// Periods of a window, and part of the usual patience, where an amplitude is averaged over deviations: single ones decide
/// nothing.
const PERIODS: u64 = 300;
const PATIENCE: f64 = 0.25;
/// Judged absorbers that are looked at under deviations.
const CANDIDATES: usize = 5;

/// So many for so many numbers.
fn nodes_of(counts: &[usize; 7], uncertain: usize) -> usize {
    counts[uncertain.min(counts.len() - 1)]
}

/// Nodes of each of so many uncertain numbers where each combination is simulated.
pub fn nodes_simulated(uncertain: usize) -> usize {
    nodes_of(&SIMULATED, uncertain)
}

/// The best in expectation of those that are not worse than the case's `own`; `None` where nothing is
/// uncertain.
///
/// # Errors
/// [`OptimizeError`] of an absorber that cannot be written or simulated.
pub fn best(
    judge: &Judge,
    proposed: &Proposed,
    designs: &[JudgedDesign],
    own: &JudgedDesign,
    executor: &dyn Executor,
) -> Result<Option<Robust>, OptimizeError> {
    let task = judge.task;
    let Some(nominal) = super::choose::best(designs, task.objective) else { return Ok(None) };
    if !task.case.uncertainty.is_any() {
        return Ok(None);
    }
    let deviations = task.deviations();
    let effort = Effort { periods: PERIODS, patience: PATIENCE, ..task.effort };
    let averaged = Task { effort, ..task.clone() };
    let under = |choice: &case::Design| averaged.under(choice, &deviations, executor);
    let of_nominal = under(&nominal.choice);
    let mut candidates: Vec<JudgedDesign> = match task.objective {
        Objective::WorstAmplitude => smoothed(task, proposed, designs),
        _ => {
            let parts = expected_best(task, &deviations, executor)?;
            let mut best: Vec<JudgedDesign> = designs.to_vec();
            best.sort_by(|a, b| b.value.total_cmp(&a.value));
            best.insert(0, judge.design(&parts, executor)?);
            best
        }
    };
    // Like the best as written, it is subject to the criteria and never worse than the case's own.
    candidates.retain(|one| {
        one.is_feasible() == nominal.is_feasible() && !one.is_worse_than(own, task.objective)
    });
    let mut best = (nominal.clone(), of_nominal);
    let score = |under: &UnderDeviations| match task.objective {
        Objective::WorstAmplitude => -under.expected,
        _ => under.expected,
    };
    for design in candidates.into_iter().filter(|one| one.choice != nominal.choice).take(CANDIDATES)
    {
        let found = under(&design.choice);
        if score(&found) > score(&best.1) {
            best = (design, found);
        }
    }
    let (design, of_best) = best;
    Ok(Some(Robust { design, under: [of_best, of_nominal] }))
}

/// Parts of the way at which the expectation of an exact objective is best.
fn expected_best(
    task: &Task,
    deviations: &[WeightedErrors],
    executor: &dyn Executor,
) -> Result<Vec<f64>, OptimizeError> {
    let fewer = combinations(&task.case.uncertain(), task.nodes_looked_at());
    let deviations = if fewer.len() < deviations.len() { fewer.as_slice() } else { deviations };
    let score = |parts: &[f64]| {
        let found = task.expected(&task.choice(parts), deviations, &Serial);
        found.unwrap_or(f64::NEG_INFINITY)
    };
    let dimensions = task.bounds.len();
    let found = search::everywhere("expected objective", dimensions, &ROBUST, executor, &score);
    found.best.map(|best| best.parts).ok_or(OptimizeError::Nowhere)
}

/// Judged absorbers in the order in which the coarse survey likes them once it is averaged over the deviation
/// of the clearance.
fn smoothed(task: &Task, proposed: &Proposed, designs: &[JudgedDesign]) -> Vec<JudgedDesign> {
    let mut only_clearance = task.case.uncertain();
    only_clearance.retain(|one| one.parameter == Parameter::Clearance);
    let nodes = combinations(&only_clearance, SIMULATED[1]);
    let expected = |design: &JudgedDesign| -> f64 {
        let at = |off: &[(Uncertain, f64)]| design.choice.deviating(&of_design(off)).clearance();
        nodes.iter().map(|(off, weight)| weight * coarse(&proposed.landscape, at(off))).sum()
    };
    let mut order: Vec<(f64, &JudgedDesign)> =
        designs.iter().map(|one| (expected(one).max(one.value), one)).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    order.into_iter().map(|(_, design)| design.clone()).collect()
}

/// A landscape between its places.
fn coarse(landscape: &[(f64, f64)], at: f64) -> f64 {
    let right = landscape.partition_point(|place| place.0 < at).clamp(1, landscape.len() - 1);
    let [(a, low), (b, high)] = [landscape[right - 1], landscape[right]];
    let part = ((at - a) / (b - a)).clamp(0.0, 1.0);
    low * (1.0 - part) + high * part
}

/// Errors of one parameter with their weights.
fn nodes(distribution: Distribution, count: usize) -> Vec<(f64, f64)> {
    let (rule, size) = match distribution {
        Distribution::Normal(deviation) => (gauss::normal(count), deviation),
        Distribution::Uniform(largest) => (gauss::uniform(count), largest),
    };
    rule.into_iter().map(|(node, weight)| (node * size, weight)).collect()
}

/// The corners of one parameter's errors: both ends.
fn ends(distribution: Distribution) -> Vec<(f64, f64)> {
    let size = match distribution {
        Distribution::Normal(deviation) => SIGMAS * deviation,
        Distribution::Uniform(largest) => largest,
    };
    vec![(-size, 0.5), (size, 0.5)]
}

/// All combinations of deviations with their weights, which add up to 1; `count` nodes of each
/// uncertain number.
pub fn combinations(uncertain: &[Uncertain], count: usize) -> Vec<WeightedErrors> {
    products(uncertain, |one| nodes(one, count))
}

/// All combinations of the ends of deviations.
pub fn corners(uncertain: &[Uncertain]) -> Vec<WeightedErrors> {
    products(uncertain, ends)
}

fn products(
    uncertain: &[Uncertain],
    values: impl Fn(Distribution) -> Vec<(f64, f64)>,
) -> Vec<WeightedErrors> {
    let mut found = vec![(Vec::new(), 1.0)];
    for one in uncertain {
        let values = values(one.errors);
        let combined = found.iter().flat_map(|(off, weight): &WeightedErrors| {
            values.iter().map(move |(value, share)| {
                ([off.as_slice(), &[(*one, *value)]].concat(), weight * share)
            })
        });
        found = combined.collect();
    }
    found
}

impl Task {
    /// Nodes of each uncertain number.
    pub fn nodes(&self) -> usize {
        let counts = match self.objective {
            Objective::Z3Share => CLOSED_FORM,
            Objective::WorstAmplitude => SIMULATED,
            Objective::StableShare | Objective::Margin => ORBITS,
        };
        self.nodes_of(&counts)
    }

    fn nodes_of(&self, counts: &[usize; 7]) -> usize {
        nodes_of(counts, self.case.uncertain().len())
    }

    /// The same while the best is looked for, which is then averaged over more.
    fn nodes_looked_at(&self) -> usize {
        match self.objective {
            Objective::StableShare | Objective::Margin => self.nodes_of(&ORBITS_LOOKED_AT),
            _ => self.nodes(),
        }
    }

    /// The combinations of deviations over which is averaged.
    pub fn deviations(&self) -> Vec<WeightedErrors> {
        combinations(&self.case.uncertain(), self.nodes())
    }

    /// The average score over deviations with weights; `None` where one leaves no system.
    pub fn expected(
        &self,
        choice: &case::Design,
        deviations: &[WeightedErrors],
        executor: &dyn Executor,
    ) -> Option<f64> {
        let score = |k: usize| self.score(&choice.deviating(&of_design(&deviations[k].0)), &Serial);
        let scores = map(executor, "", deviations.len(), score);
        scores.into_iter().zip(deviations).map(|(score, (_, weight))| Some(weight * score?)).sum()
    }

    /// What an absorber achieves under deviations, as values of the objective; infinite, or nothing, where a
    /// deviation leaves no system.
    fn under(
        &self,
        choice: &case::Design,
        deviations: &[WeightedErrors],
        executor: &dyn Executor,
    ) -> UnderDeviations {
        let corners = corners(&self.case.uncertain());
        let worst = map(executor, "", corners.len(), |k| {
            self.score(&choice.deviating(&of_design(&corners[k].0)), &Serial)
        });
        let worst = worst.into_iter().map(|score| score.unwrap_or(f64::NEG_INFINITY));
        let expected = self.expected(choice, deviations, executor);
        UnderDeviations {
            expected: self.value(expected.unwrap_or(f64::NEG_INFINITY)),
            worst_corner: self.value(worst.fold(f64::INFINITY, f64::min)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Averages of squares are s² for a normal error and a²/3 for one up to a.
    #[test]
    fn combinations_have_the_moments_of_their_errors() {
        let of = |parameter, errors| Uncertain { parameter, of: None, errors };
        let two = [
            of(Parameter::Clearance, Distribution::Normal(0.1)),
            of(Parameter::Amplitude, Distribution::Uniform(0.2)),
        ];
        let all = combinations(&two, 7);
        assert_eq!(all.len(), 49);
        let mean = |of: &dyn Fn(f64, f64) -> f64| -> f64 {
            let weighted = all.iter().map(|(off, weight)| {
                assert_eq!([off[0].0, off[1].0], two);
                weight * of(off[0].1, off[1].1)
            });
            weighted.sum()
        };
        assert!((mean(&|_, _| 1.0) - 1.0).abs() < 1e-14);
        assert!((mean(&|clearance, _| clearance * clearance) - 0.01).abs() < 1e-14);
        assert!((mean(&|_, amplitude| amplitude * amplitude) - 0.04 / 3.0).abs() < 1e-14);
        assert!(mean(&|clearance, amplitude| clearance * amplitude).abs() < 1e-16);
        assert_eq!(combinations(&[], 7), [(Vec::new(), 1.0)]);
    }
}
