//! Criteria of a structure that is released, struck or swept: the worst place of the absorber counts.

use std::f64::consts::TAU;

use super::Judged;
use crate::band::rivals::reduction_db;
use crate::case::{Case, Criterion, Subject};
use crate::method::Method;
use crate::transient::{DecayStudy, Start, SweepStart, SweepStudy, awake, worst_of_places};

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
            awake(&study.starts).map(|start| of_start(criterion.subject, start)).collect();
        let [worst, error] = worst_of_places(&values);
        let alone = scales.time(TAU * study.bare);
        let inactive = study.decides_inactive() || values.is_empty();
        if criterion.subject == Subject::DecayTime && inactive && alone > worst {
            let judged = criterion.judged(Some(alone), 0.0, Method::ClosedForm);
            return Judged { inactive: Some(study.inactive), ..judged };
        }
        criterion.judged(Some(worst), error, Method::Simulation)
    };
    case.criteria.iter().map(judge).collect()
}

/// Judges every criterion of a case that is swept through resonance.
pub fn judge_sweep(case: &Case, study: &SweepStudy) -> Vec<Judged> {
    let scales = case.scales();
    let of_starts = |of: &dyn Fn(&SweepStart) -> f64| -> [f64; 2] {
        worst_of_places(&study.starts.iter().map(of).collect::<Vec<f64>>())
    };
    let peak = || of_starts(&|(_, found)| scales.length(found.peak()[1]));
    let judge = |criterion: &Criterion| {
        let rival = match criterion.subject {
            Subject::ReductionDb => &study.alone,
            _ => &study.damped.1,
        };
        let [found, error] = match criterion.subject {
            Subject::PeakDisplacement => peak(),
            Subject::ReductionDb | Subject::ReductionDbTmd => {
                let ([peak, error], rival) = (peak(), scales.length(rival.peak()[1]));
                let found = reduction_db(peak, rival);
                [found, found - reduction_db(peak + error, rival)]
            }
            _ => of_starts(&|(_, found)| scales.velocity(found.impact_speed)),
        };
        criterion.judged(Some(found), error, Method::Simulation)
    };
    case.criteria.iter().map(judge).collect()
}
