//! What the numbers of a simulated motion are known to.
//!
//! A motion that repeats is known as exactly as its repetition closes. One that does not repeat is
//! different after every change of rounding: its averages may move within their standard errors,
//! numbers without an error are judged by those that have one, or not at all.

use serde_json::Value;

use super::accuracy::{Allowance, Basis, number};
use crate::regimes::share::wilson;

/// A simulated motion counts as repeating when it closes to this, over its size; its numbers are
/// known no better.
pub(super) const CLOSURE: f64 = 1e-6;
/// Captures, energy flows and the like ride on impacts and amplitude and scatter as they do, captures
/// most: between runs of the shipped cases that differ in rounding only, some moved by twice as much.
const RIDES: f64 = 3.0;
/// Impacts may be locked to a whole number per period and then have no error: a motion that is
/// modulated a little moves by as much all the same.
const WEAK_MODULATION: f64 = 0.01;
/// The largest of some thousand peaks that are spread over the depth of modulation: between the same
/// runs it moved by up to half of it, a quarter for either side.
const SPREAD_OF_PEAKS: f64 = 0.3;
/// Fewer captures than this say nothing of how long they are.
const FEW_CAPTURES: f64 = 10.0;
/// A limit that some starts find and some do not is no sharper than two of its brackets.
const BRACKETS: f64 = 2.0;
/// Decibels for a small relative change of an amplitude.
const DECIBELS: f64 = 20.0 * std::f64::consts::LOG10_E;

/// Averages that have no error of their own.
const RIDING: [&str; 11] = [
    "energetics/damper_power",
    "energetics/impact_power",
    "energetics/input_power",
    "energetics/loss_per_impact",
    "energetics/loss_per_period",
    "energetics/transfer_efficiency",
    "evidence/absorber_amplitude/between",
    "evidence/absorber_amplitude/in_captures",
    "evidence/captures/mean",
    "evidence/captures/share",
    "evidence/visits_per_period",
];

/// What another number of the motion says as well.
const RESTATED: [&str; 9] = [
    "displacement/peak_over_clearance",
    "displacement/rms_over_clearance",
    "evidence/exponent/interval",
    "evidence/exponent/standard_error",
    "evidence/impacts_per_period",
    "share_interval_95",
    "starts",
    "two_standard_errors/impacts_per_period",
    "two_standard_errors/rms_over_clearance",
];

/// What follows from where a run happened to end, in any motion.
const CHANCE: [&str; 11] = [
    "energy/stored",
    "evidence/absorber_amplitude/correlation_with_growth",
    "evidence/exponent/block",
    "evidence/exponent/block_correlation",
    "evidence/exponent/converged",
    "evidence/exponent/periods",
    "evidence/modulation_growth",
    "impacts",
    "late_starts",
    "longest_transient_periods",
    "periods",
];

/// Whether the motion repeats.
fn repeats(motion: &Value) -> bool {
    !motion["evidence"]["periodicity"].is_null()
}

/// Errors of the averages of a motion that does not repeat, relative: of the rms displacement and of
/// the impacts per period. An error that one side does not state is that of the other.
fn errors(old: &Value, new: &Value) -> Option<[f64; 2]> {
    let relative = |motion: &Value, field: &str, value: f64| {
        let error = motion["two_standard_errors"][field].as_f64();
        error.filter(|_| value > 0.0).map(|error| error / value)
    };
    let rms = |motion: &Value| {
        let value = number(&motion["displacement"], "rms_over_clearance");
        relative(motion, "rms_over_clearance", value)
    };
    let impacts = |motion: &Value| {
        relative(motion, "impacts_per_period", number(motion, "impacts_per_period"))
    };
    let both = |error: &dyn Fn(&Value) -> Option<f64>| match (error(old), error(new)) {
        (Some(old), Some(new)) => Some(old + new),
        (one, other) => one.or(other).map(|error| 2.0 * error),
    };
    Some([both(&rms)?, both(&impacts)?])
}

/// How far a number of a motion may move from `a` to `b`.
pub(super) fn allowance(key: &str, old: &Value, new: &Value, a: f64, b: f64) -> Allowance {
    let key = key.strip_prefix("attractors/").unwrap_or(key);
    let scale = a.abs().max(b.abs());
    match key {
        _ if RESTATED.contains(&key) => Allowance::Restated,
        _ if CHANCE.contains(&key) => Allowance::Unjudged,
        "share_of_starts" => overlap(a, b, &old["share_interval_95"], &new["share_interval_95"]),
        "evidence/exponent/per_period" => {
            let interval = |motion: &Value| motion["evidence"]["exponent"]["interval"].clone();
            overlap(a, b, &interval(old), &interval(new))
        }
        _ if repeats(old) && repeats(new) => {
            // Powers and lengths are compared with themselves, numbers of order one with one.
            let of_order_one = key.starts_with("evidence/")
                || key.ends_with("_db")
                || ["energy/relative_residual", "largest_penetration_over_clearance"]
                    .contains(&key);
            let size = if of_order_one { scale.max(1.0) } else { scale };
            Allowance::Within(CLOSURE * size, Basis::Repetition)
        }
        "energy/relative_residual" | "largest_penetration_over_clearance" => {
            Allowance::Within(CLOSURE, Basis::Residual)
        }
        _ if key.starts_with("evidence/captures/")
            && captures(old).min(captures(new)) < FEW_CAPTURES =>
        {
            Allowance::Unjudged
        }
        _ => match errors(old, new) {
            Some(errors) => scattered(key, scale, errors, depth(old) + depth(new)),
            None => Allowance::Unjudged,
        },
    }
}

/// The same where the motion does not repeat, with the sums of both sides' relative errors.
fn scattered(key: &str, scale: f64, [rms, impacts]: [f64; 2], depth: f64) -> Allowance {
    match key {
        "displacement/rms" => Allowance::Within(rms * scale, Basis::TwoStandardErrors),
        "energetics/rms_change_db" => Allowance::Within(DECIBELS * rms, Basis::TwoStandardErrors),
        "impacts_per_period" => Allowance::Within(impacts * scale, Basis::TwoStandardErrors),
        "displacement/peak" => {
            Allowance::Within(SPREAD_OF_PEAKS * depth * scale, Basis::Modulation)
        }
        "energetics/peak_change_db" => {
            Allowance::Within(DECIBELS * SPREAD_OF_PEAKS * depth, Basis::Modulation)
        }
        _ if RIDING.contains(&key) => {
            let relative = (RIDES * (rms + impacts)).max(depth.min(WEAK_MODULATION));
            Allowance::Within(relative * scale, Basis::OtherErrors)
        }
        _ => Allowance::Unjudged,
    }
}

fn captures(motion: &Value) -> f64 {
    number(&motion["evidence"]["captures"], "count")
}

fn depth(motion: &Value) -> f64 {
    number(&motion["evidence"], "modulation_depth")
}

/// How far a number of the clearances that were simulated beside the case's may move.
pub(super) fn probed(key: &str, old: &Value, new: &Value, a: f64, b: f64) -> Allowance {
    let scale = a.abs().max(b.abs());
    let confirmations = |document: &Value| document["confirmations"].clone();
    let (old, new) = (confirmations(old), confirmations(new));
    match key {
        "confirmations/upper_limit/kept" | "confirmations/upper_limit/lost/factor" => {
            let width = |probes: &Value| {
                let limit = &probes["upper_limit"];
                (number(&limit["lost"], "factor") - number(limit, "kept")).abs()
            };
            Allowance::Within(BRACKETS * (width(&old) + width(&new)), Basis::Bracket)
        }
        "confirmations/best/steady" | "confirmations/upper_limit/lost/steady" => {
            let lost = key.contains("lost");
            let starts = |probes: &Value| {
                let probe = if lost { &probes["upper_limit"]["lost"] } else { &probes["best"] };
                number(probe, "starts")
            };
            let interval = |steady: f64, starts: f64| {
                let ends = wilson(steady as u32, starts as u32).map(|share| share * starts);
                serde_json::json!(ends)
            };
            overlap(a, b, &interval(a, starts(&old)), &interval(b, starts(&new)))
        }
        "confirmations/best/factor" | "confirmations/best/steady_peak" => {
            Allowance::Within(CLOSURE * scale, Basis::Repetition)
        }
        "confirmations/best/starts" | "confirmations/upper_limit/lost/starts" => {
            Allowance::Within(0.0, Basis::Rounding)
        }
        // The largest peak of a few short runs, or at a clearance that moves.
        _ => Allowance::Unjudged,
    }
}

/// How far apart two numbers may be for their intervals to touch.
fn overlap(a: f64, b: f64, old: &Value, new: &Value) -> Allowance {
    let end = |interval: &Value, index: usize, at: f64| interval[index].as_f64().unwrap_or(at);
    let (towards, back) = if a <= b { (1, 0) } else { (0, 1) };
    let reach = (end(old, towards, a) - a).abs() + (end(new, back, b) - b).abs();
    Allowance::Within(reach, Basis::Interval)
}

/// Whether a motion that is on one side only could have been missed on the other: no start of as many
/// is within the interval of its share.
pub(super) fn found_by_chance(motion: &Value) -> bool {
    let share = number(motion, "share_of_starts");
    let low = motion["share_interval_95"][0].as_f64();
    let starts = if share > 0.0 { number(motion, "starts") / share } else { 0.0 };
    let missed = wilson(0, starts.round() as u32)[1];
    low.is_some_and(|low| share > 0.0 && low <= missed)
}

/// Whether a word or a flag of a motion says what chance decides.
pub(super) fn is_chance(key: &str) -> bool {
    key.strip_prefix("attractors/").is_some_and(|key| CHANCE.contains(&key))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn chaotic() -> Value {
        json!({
            "impacts_per_period": 2.0,
            "share_interval_95": [0.25, 0.75],
            "displacement": {"rms_over_clearance": 0.5},
            "two_standard_errors": {"rms_over_clearance": 0.01, "impacts_per_period": 0.1},
            "evidence": {"periodicity": null, "modulation_depth": 0.5,
                         "exponent": {"interval": [0.5, 1.0]}},
        })
    }

    fn within(key: &str, motion: &Value, a: f64, b: f64) -> (f64, Basis) {
        match allowance(&format!("attractors/{key}"), motion, motion, a, b) {
            Allowance::Within(allowed, basis) => ((1e9 * allowed).round() / 1e9, basis),
            other => panic!("{key}: {other:?}"),
        }
    }

    /// By hand: errors of both sides added, relative ones times the larger number.
    #[test]
    fn what_does_not_repeat_may_move_within_both_errors() {
        let motion = chaotic();
        let errors = Basis::TwoStandardErrors;
        assert_eq!(within("displacement/rms", &motion, 1.0, 0.5), (0.04, errors));
        assert_eq!(within("impacts_per_period", &motion, 2.0, 1.0), (0.2, errors));
        assert_eq!(within("displacement/peak", &motion, 2.0, 1.0), (0.6, Basis::Modulation));
        assert_eq!(within("energetics/input_power", &motion, 1.0, 1.0), (0.42, Basis::OtherErrors));
        // From 0.6 up to 0.75, and from 0.8 down to 0.25.
        assert_eq!(within("share_of_starts", &motion, 0.6, 0.8), (0.7, Basis::Interval));
        assert_eq!(within("share_of_starts", &motion, 0.6, 0.4), (0.7, Basis::Interval));
        let exponent = within("evidence/exponent/per_period", &motion, 0.75, 0.75);
        assert_eq!(exponent, (0.5, Basis::Interval));
        let stored = allowance("attractors/energy/stored", &motion, &motion, 1.0, 9.0);
        assert_eq!(stored, Allowance::Unjudged);
    }

    #[test]
    fn what_repeats_is_held_to_its_closure() {
        let mut motion = chaotic();
        motion["evidence"]["periodicity"] = json!({"closure": 1e-15});
        assert_eq!(within("displacement/rms", &motion, 2.0, 1.0), (2e-6, Basis::Repetition));
        assert_eq!(within("evidence/asymmetry", &motion, 0.0, 1e-9), (1e-6, Basis::Repetition));
    }

    #[test]
    fn an_error_that_one_side_lacks_is_that_of_the_other() {
        let (mut old, new) = (chaotic(), chaotic());
        old["two_standard_errors"] = Value::Null;
        let found = allowance("attractors/displacement/rms", &old, &new, 1.0, 1.0);
        assert_eq!(found, Allowance::Within(0.04, Basis::TwoStandardErrors));
        let unknown = allowance("attractors/displacement/rms", &old, &old, 1.0, 1.0);
        assert_eq!(unknown, Allowance::Unjudged);
    }

    #[test]
    fn a_limit_between_two_simulated_clearances_may_move_by_both_brackets() {
        let document = json!({"confirmations": {"upper_limit":
            {"kept": 1.0, "lost": {"factor": 1.25, "starts": 8}}}});
        let kept = "confirmations/upper_limit/kept";
        let found = probed(kept, &document, &document, 1.0, 1.25);
        assert_eq!(found, Allowance::Within(1.0, Basis::Bracket));
    }

    #[test]
    fn one_start_of_many_may_be_chance() {
        let found = |starts: u32, of: u32| {
            found_by_chance(&json!({"starts": starts,
                "share_of_starts": f64::from(starts) / f64::from(of),
                "share_interval_95": wilson(starts, of)}))
        };
        assert!(found(1, 32));
        assert!(!found(16, 32));
        assert!(
            !found(0, 32),
            "a motion that no start finds is reached from the theory, not by chance"
        );
    }
}
