//! Criteria of a structure that is not driven steadily: the worst place of the absorber counts; of several records the
//! mean.

use std::f64::consts::TAU;

use super::Judged;
use crate::band::rivals::reduction_db;
use crate::case::{Case, Criterion, Scales, Subject};
use crate::method::Method;
use crate::transient::{
    Decay, DecayStudy, Measured, RecordStudy, Study, SweepStart, SweepStudy, awake, worst_of_places,
};

/// Judges every criterion of a case that is not driven steadily.
pub fn judge_transient(case: &Case, study: &Study) -> Vec<Judged> {
    match study {
        Study::Release(study) => judge_release(case, study),
        Study::Sweep(study) => judge_sweep(case, study),
        Study::Record(study) => judge_record(case, study),
    }
}

/// Those of one that is released.
pub fn judge_release(case: &Case, study: &DecayStudy) -> Vec<Judged> {
    let scales = case.scales();
    let of_start = |subject: Subject, start: &Decay| match subject {
        Subject::DecayTime => scales.time(TAU * start.oscillations),
        Subject::PeakDisplacement => scales.length(start.peak),
        _ => scales.velocity(start.impact_speed),
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

/// Those of one that is swept through resonance.
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

/// Those of one that a record drives.
fn judge_record(case: &Case, study: &RecordStudy) -> Vec<Judged> {
    let scales = case.scales();
    let records = study.realisations.len();
    let judge = |criterion: &Criterion| {
        let [value, error] = of_records(&scales, study, criterion.subject);
        criterion.judged(Some(value), error, Method::Simulation).under(records)
    };
    case.criteria.iter().map(judge).collect()
}

/// What becomes of a subject from the worst place of the absorber: of one record with how much worse others may be, of
/// several the mean with two standard errors.
pub fn of_records(scales: &Scales, study: &RecordStudy, subject: Subject) -> Measured {
    let length = |value: Measured| value.map(|one| scales.length(one));
    match subject {
        Subject::RmsDisplacement => length(study.worst(|_, place| place.rms)),
        Subject::ImpactVelocity => {
            study.worst(|_, place| place.impact_speed).map(|speed| scales.velocity(speed))
        }
        Subject::ReductionDb => study.reduction_db(|one| one.bare.peak),
        Subject::ReductionDbTmd => study.reduction_db(|one| one.damped.peak),
        _ => length(study.worst(|_, place| place.peak)),
    }
}
