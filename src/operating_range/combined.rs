//! The excitation's amplitude and the natural frequency changed at once: what holds for each alone may fail for both.

use super::{HoldsFor, Looked, Together, Varied, judge};
use crate::case::Case;
use crate::executor::{Executor, map};
use crate::flights::DrivenError;
use crate::motions::Effort;

/// A design with another amplitude and another natural frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Combined {
    /// Both, in SI or the units of a reduced case.
    pub at: [f64; 2],
    /// What its criteria come to.
    pub outcome: Together,
}

/// Every combination of the amplitude and the natural frequency half way to the ends of their ranges and at them, by
/// amplitude, then frequency; none where one of the ranges is not known.
///
/// Those along one range are known from it.
///
/// # Errors
/// [`DrivenError`] where a motion cannot be followed.
pub fn combined(
    case: &Case,
    ranges: &[HoldsFor],
    effort: &Effort,
    on: &dyn Executor,
) -> Result<Vec<Combined>, DrivenError> {
    let [amplitude, frequency] = Varied::FIRST.map(|varied| {
        let range = ranges.iter().find(|one| one.parameter == varied)?;
        Some((varied.parameter(case)?, values(range)))
    });
    let (Some(amplitude), Some(frequency)) = (amplitude, frequency) else { return Ok(Vec::new()) };
    let both = amplitude.1.iter().flat_map(|a| frequency.1.iter().map(|f| [*a, *f]));
    let both: Vec<[f64; 2]> = both.collect();
    let outcome = |k: usize| {
        let [a, f] = both[k];
        let there = case.varied(amplitude.0, a).and_then(|case| case.varied(frequency.0, f));
        let Some(there) = there else { return Ok(Together::Fail) };
        judge(&there, effort, Looked::Longer).map(|judged| Together::of(&judged))
    };
    let found = map(on, "combinations", both.len(), outcome);
    let found =
        both.iter().zip(found).map(|(at, outcome)| Ok(Combined { at: *at, outcome: outcome? }));
    found.collect()
}

/// Values on the way to both ends, ascending; none in a direction in which the range ends at the case.
fn values(of: &HoldsFor) -> Vec<f64> {
    let mut all: Vec<f64> =
        of.range.iter().flat_map(|end| [0.5 * (of.value + end), *end]).collect();
    all.retain(|one| *one != of.value);
    all.sort_by(f64::total_cmp);
    all
}
