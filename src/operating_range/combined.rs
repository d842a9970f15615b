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
    /// Whether both are ends of the stretches in which all criteria hold while the other number stays.
    pub corner: bool,
    /// What its criteria come to.
    pub outcome: Together,
}

/// Every combination of two amplitudes and two natural frequencies on either side of the case, by amplitude, then frequency:
/// the ends of their ranges, and the ends of the part in which all criteria hold, or half way where that is none of its own;
/// none where one of the ranges is not known.
///
/// Those along one range are known from it. A corner of what holds is judged as `check` judges it.
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
    let both = amplitude.1.iter().flat_map(|a| frequency.1.iter().map(|f| (*a, *f)));
    let both: Vec<(Value, Value)> = both.collect();
    let outcome = |k: usize| {
        let (a, f) = both[k];
        let corner = a.end_of_hold && f.end_of_hold;
        let there = case.varied(amplitude.0, a.value);
        let outcome = match there.and_then(|case| case.varied(frequency.0, f.value)) {
            Some(there) => {
                let how =
                    if corner { Looked::AsCheck(Together::Undecided) } else { Looked::OnTheWay };
                Together::of(&judge(&there, effort, how)?)
            }
            None => Together::Fail,
        };
        Ok(Combined { at: [a.value, f.value], corner, outcome })
    };
    map(on, "combinations", both.len(), outcome).into_iter().collect()
}

/// Another value of a number.
#[derive(Clone, Copy)]
struct Value {
    value: f64,
    /// Whether the stretch in which all criteria hold ends there.
    end_of_hold: bool,
}

/// Part of the way to the end of a range from which on the end of what holds stands for both.
const NEAR: f64 = 0.8;

/// Two on either side, ascending; none in a direction in which the range ends at the case.
fn values(of: &HoldsFor) -> Vec<Value> {
    let mut all = Vec::new();
    for k in [0, 1] {
        let end = of.range[k];
        let hold = of.holds.map(|holds| holds[k]).filter(|hold| *hold != of.value);
        let half_way = 0.5 * (of.value + end);
        let two = match hold {
            Some(hold) if (hold - of.value) / (end - of.value) > NEAR => [half_way, hold],
            Some(hold) => [hold, end],
            None => [half_way, end],
        };
        all.extend(two.map(|value| Value { value, end_of_hold: hold == Some(value) }));
    }
    all.retain(|one| one.value != of.value);
    all.sort_by(|a, b| a.value.total_cmp(&b.value));
    all
}
