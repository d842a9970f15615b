//! The same of a case of several modes or absorbers.

use super::Decided;
use crate::case::ModalCase;
use crate::executor::Executor;
use crate::modal::{ModalAnswer, ModalError, looks, seconds, seconds_of_designs};
use crate::operating_range::{Reliability, Together};

/// Seconds up to which a case, and a probability beside it, which is that of 200 checks, are ordinary.
pub const ORDINARY: f64 = 60.0;
/// See [`ORDINARY`].
pub const ORDINARY_PROBABILITY: f64 = 180.0;
/// About how many times a `check` of the case the two structures of a drift take, which are looked at more coarsely.
const OF_DRIFT: f64 = 1.2;
/// The same of another amplitude of a load and other natural frequencies: half of 16 are looked at in full.
const OF_LOAD: f64 = 11.0;

/// What is left out where it would take too long.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LeftOut {
    /// What else could be done in place of the absorbers.
    Alternatives,
    /// How far numbers may change.
    Ranges,
    /// The same of the amplitude of a load and the natural frequencies at once.
    Combinations,
    /// With which probability all criteria hold.
    Probability,
}

/// An answer with what `told` says beside the criteria: what else could be done, how far numbers may change, and with which probability all hold where some are
/// uncertain. `affords` says of each, by about how many seconds it takes and whether that is ordinary, whether it is looked for.
///
/// # Errors
/// [`ModalError`] where a motion cannot be flown.
pub fn decided(
    case: &ModalCase,
    answer: ModalAnswer,
    told: Decided,
    affords: &dyn Fn(LeftOut, f64, bool) -> bool,
    on: &dyn Executor,
) -> Result<ModalAnswer, ModalError> {
    let own = seconds(case);
    let affords = |what: LeftOut, checks: f64, ordinary: f64| {
        checks > 0.0 && affords(what, own * checks, own * (1.0 + checks) <= ordinary)
    };
    let drifts = if told.alternatives { case.alternatives.drift.len() } else { 0 };
    let designs = if told.alternatives { seconds_of_designs(case) } else { 0.0 };
    let checks = OF_DRIFT * drifts as f64 + designs / own.max(f64::MIN_POSITIVE);
    let compares = affords(LeftOut::Alternatives, checks, ORDINARY);
    let answer = if compares { answer.compared(case, on)? } else { answer };
    // Where a criterion fails there is no range.
    let may_hold = !answer.judged.is_empty() && Together::of(&answer.judged) != Together::Fail;
    let checks = if may_hold { looks(case, told.ranges) } else { 0.0 };
    let ranged = affords(LeftOut::Ranges, checks, ORDINARY);
    let designs = if told.reliability { Reliability::samples(case) } else { 0 };
    let draws = affords(LeftOut::Probability, f64::from(designs), ORDINARY_PROBABILITY);
    let ranges = if ranged { told.ranges } else { &[] };
    let answer = answer.decided(case, ranges, told.until, draws, on)?;
    let combines = told.combined && !answer.holds_for.is_empty();
    let checks = if combines { OF_LOAD * case.loads.len() as f64 } else { 0.0 };
    match affords(LeftOut::Combinations, checks, ORDINARY) {
        true => answer.combined(case, on),
        false => Ok(answer),
    }
}
