//! The excitation's amplitude and the natural frequency changed at once: what holds for each alone may fail for both.

use super::{Depth, HoldsFor, Together, Varied, Varies};
use crate::case::Relation;
use crate::executor::{Executor, map};
use crate::system::Parameter;

/// A design with another amplitude and another natural frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Combined {
    /// Of which load the amplitude is, where a case has a list of them.
    pub of: Option<usize>,
    /// Both, in SI or the units of a reduced case.
    pub at: [f64; 2],
    /// Whether the verdict counts it, which is judged as `check` does: an end of the amplitudes at which all criteria hold while
    /// the frequency stays, and an end of such frequencies or the worst of them.
    pub promised: bool,
    /// What its criteria come to.
    pub outcome: Together,
}

/// Every combination of two amplitudes, of each load by itself, and two natural frequencies on either side of the case, by amplitude,
/// then frequency: where all criteria hold with one changed alone the end of that stretch and the worst place in it, as two designs
/// that each keep a limit well may miss it together; else the end of the range and half way. None where one of the ranges is not
/// known. `known` is how thoroughly `check` searches the case.
///
/// # Errors
/// Where a motion cannot be followed.
pub fn combined<C: Varies>(
    case: &C,
    ranges: &[HoldsFor],
    known: &C::Effort,
    on: &dyn Executor,
) -> Result<Vec<Combined>, C::Error> {
    let of = |varied: Varied| -> Vec<Values> {
        let Some(number) = case.parameter(varied) else { return Vec::new() };
        let all = ranges.iter().filter(|one| one.parameter == varied);
        all.map(|range| Values { number, of: range.of, all: values(case, range) }).collect()
    };
    let [amplitudes, frequencies] = Varied::FIRST.map(of);
    let mut both = Vec::new();
    for (amplitude, frequency) in
        amplitudes.iter().flat_map(|one| frequencies.iter().map(move |other| (one, other)))
    {
        for a in &amplitude.all {
            both.extend(frequency.all.iter().map(|f| ((amplitude, a), (frequency, f))));
        }
    }
    let outcome = |k: usize| {
        let ((amplitude, a), (frequency, f)) = both[k];
        let promised = a.held && a.is_end && f.held;
        let there = case.with(amplitude.number, amplitude.of, a.value);
        let outcome =
            match there.and_then(|case| case.with(frequency.number, frequency.of, f.value)) {
                Some(there) => {
                    let how = if promised { Depth::AsCheck } else { Depth::OnTheWay };
                    Together::of(&there.judge(known, how)?)
                }
                None => Together::Fail,
            };
        Ok(Combined { of: amplitude.of, at: [a.value, f.value], promised, outcome })
    };
    map(on, "combinations", both.len(), outcome).into_iter().collect()
}

/// Values of a number, and of which part it is.
struct Values {
    number: Parameter,
    of: Option<usize>,
    all: Vec<Value>,
}

/// Another value of a number.
#[derive(Clone, Copy)]
struct Value {
    value: f64,
    /// Whether all criteria hold there while the other number stays.
    held: bool,
    /// Whether the stretch ends there.
    is_end: bool,
}

/// Two on either side, ascending; none in a direction in which the range ends at the case.
fn values<C: Varies>(case: &C, of: &HoldsFor) -> Vec<Value> {
    let larger_is_worse =
        case.criteria().first().is_none_or(|first| first.relation == Relation::AtMost);
    let badness = |found: f64| if larger_is_worse { found } else { -found };
    let side = |k: usize| {
        let hold = of.holds.map(|holds| holds[k]).filter(|hold| *hold != of.value);
        let end = hold.unwrap_or(of.range[k]);
        let within = of.reached.iter().filter(|[at, _]| (at - of.value) * (at - end) < 0.0);
        let worst = within.max_by(|a, b| badness(a[1]).total_cmp(&badness(b[1])));
        let inner = worst.filter(|_| hold.is_some()).map_or(0.5 * (of.value + end), |[at, _]| *at);
        [(inner, false), (end, true)].map(|(value, is_end)| Value {
            value,
            held: hold.is_some(),
            is_end,
        })
    };
    let mut all: Vec<Value> = [0, 1].into_iter().flat_map(side).collect();
    all.retain(|one| one.value != of.value);
    all.sort_by(|a, b| a.value.total_cmp(&b.value));
    all
}
