//! Criteria of a structure that a record drives: the worst place of the absorber counts; of several records the mean.

use super::Judged;
use crate::case::{Case, Criterion, Subject};
use crate::method::Method;
use crate::transient::RecordStudy;

/// Judges every criterion of a case that is driven by a record.
pub fn judge_record(case: &Case, study: &RecordStudy) -> Vec<Judged> {
    let scales = case.scales();
    let length = |value: [f64; 2]| value.map(|one| scales.length(one));
    let found = |subject: Subject| match subject {
        Subject::RmsDisplacement => length(study.worst(|_, place| place.rms)),
        Subject::ImpactVelocity => {
            study.worst(|_, place| place.impact_speed).map(|speed| scales.velocity(speed))
        }
        Subject::ReductionDb => study.reduction_db(|one| one.bare.peak),
        Subject::ReductionDbTmd => study.reduction_db(|one| one.damped.peak),
        _ => length(study.worst(|_, place| place.peak)),
    };
    let judge = |criterion: &Criterion| {
        let [value, error] = found(criterion.subject);
        criterion.judged(Some(value), error, Method::Simulation)
    };
    case.criteria.iter().map(judge).collect()
}
