//! Criteria of a structure that is released or struck: the worst place of the absorber counts.

use std::f64::consts::TAU;

use super::Judged;
use crate::case::{Case, Criterion, Subject};
use crate::method::Method;
use crate::transient::{DecayStudy, Start, worst_of_places};

/// Judges every criterion of a case that is released.
pub fn judge_release(case: &Case, study: &DecayStudy) -> Vec<Judged> {
    let scales = case.scales();
    let of_start = |subject: Subject, (_, decay, found): &Start| match subject {
        Subject::DecayTime => scales.time(TAU * decay.oscillations),
        Subject::PeakDisplacement => scales.length(found.peak),
        _ => scales.velocity(decay.impact_speed),
    };
    let judge = |criterion: &Criterion| {
        let values: Vec<f64> =
            study.starts.iter().map(|start| of_start(criterion.subject, start)).collect();
        let [worst, error] = worst_of_places(&values);
        let alone = scales.time(TAU * study.bare);
        if criterion.subject == Subject::DecayTime && study.decides_inactive() && alone > worst {
            let judged = criterion.judged(Some(alone), 0.0, Method::ClosedForm);
            return Judged { inactive: Some(study.inactive), ..judged };
        }
        criterion.judged(Some(worst), error, Method::Simulation)
    };
    case.criteria.iter().map(judge).collect()
}
