//! Criteria of a structure that is released or struck: the worst place of the absorber counts.

use std::f64::consts::TAU;

use super::Judged;
use crate::case::{Case, Criterion, Subject};
use crate::method::Method;
use crate::numerics::scatter::error_of_largest;
use crate::transient::DecayStudy;
use crate::transient::Start;

/// Neighbouring starts whose worst is one value of those that tell how much worse others may be.
const TOGETHER: usize = 4;

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
        let largest = |some: &[f64]| some.iter().copied().fold(0.0, f64::max);
        let worst = largest(&values);
        let alone = scales.time(TAU * study.bare);
        if criterion.subject == Subject::DecayTime && study.decides_inactive() && alone > worst {
            let judged = criterion.judged(Some(alone), 0.0, Method::ClosedForm);
            return Judged { inactive: Some(study.inactive), ..judged };
        }
        // Places in between may be worse.
        let blocks: Vec<f64> = values.chunks_exact(TOGETHER).map(largest).collect();
        let error = if worst.is_finite() { error_of_largest(&blocks) } else { 0.0 };
        criterion.judged(Some(worst), error, Method::Simulation)
    };
    case.criteria.iter().map(judge).collect()
}
