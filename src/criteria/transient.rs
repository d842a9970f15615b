//! Criteria of a structure that is not driven steadily: the worst place of the absorber counts; of several records the
//! mean.

use std::f64::consts::TAU;

use super::Judged;
use crate::case::{Case, Criterion, Subject};
use crate::linear::reduction_db;
use crate::method::Method;
use crate::quantity::Units;
use crate::transient::{DecayStudy, Measured, RecordStudy, Study, SweepStudy};

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
    let units = case.units();
    let judge = |criterion: &Criterion| {
        let scaled = |[value, error]: Measured, scale: &dyn Fn(f64) -> f64| {
            criterion.judged(Some(scale(value)), scale(error), Method::Simulation)
        };
        match criterion.subject {
            Subject::DecayTime => {
                let found = study.decay();
                let judged = scaled(found.oscillations, &|one| units.time(TAU * one));
                match found.inactive {
                    true => Judged {
                        inactive: Some(study.inactive.share),
                        decided_by: Method::ClosedForm,
                        ..judged
                    },
                    false => judged,
                }
            }
            Subject::PeakDisplacement => {
                scaled(study.largest(|start| start.peak), &|one| units.length(one))
            }
            _ => scaled(study.largest(|start| start.impact_speed), &|one| units.velocity(one)),
        }
    };
    case.criteria.iter().map(judge).collect()
}

/// Those of one that is swept through resonance.
pub fn judge_sweep(case: &Case, study: &SweepStudy) -> Vec<Judged> {
    let units = case.units();
    let peak = || study.largest(|found| units.length(found.peak()[1]));
    let judge = |criterion: &Criterion| {
        let rival = match criterion.subject {
            Subject::ReductionDb => &study.alone,
            _ => &study.damped.1,
        };
        let [found, error] = match criterion.subject {
            Subject::PeakDisplacement => peak(),
            Subject::ReductionDb | Subject::ReductionDbTmd => {
                let ([peak, error], rival) = (peak(), units.length(rival.peak()[1]));
                let found = reduction_db(peak, rival);
                [found, found - reduction_db(peak + error, rival)]
            }
            _ => study.largest(|found| units.velocity(found.impact_speed)),
        };
        criterion.judged(Some(found), error, Method::Simulation)
    };
    case.criteria.iter().map(judge).collect()
}

/// Those of one that a record drives.
fn judge_record(case: &Case, study: &RecordStudy) -> Vec<Judged> {
    let units = case.units();
    let records = study.realisations.len();
    let judge = |criterion: &Criterion| {
        let [value, error] = of_records(&units, study, criterion.subject);
        criterion.judged(Some(value), error, Method::Simulation).under(records)
    };
    case.criteria.iter().map(judge).collect()
}

/// What becomes of a subject from the worst place of the absorber: of one record with how much worse others may be, of
/// several the mean with two standard errors.
pub fn of_records(units: &Units, study: &RecordStudy, subject: Subject) -> Measured {
    let length = |value: Measured| value.map(|one| units.length(one));
    match subject {
        Subject::RmsDisplacement => length(study.worst(|_, place| place.rms)),
        Subject::ImpactVelocity => {
            study.worst(|_, place| place.impact_speed).map(|speed| units.velocity(speed))
        }
        Subject::ReductionDb => study.reduction_db(|one| one.bare.peak),
        Subject::ReductionDbTmd => study.reduction_db(|one| one.damped.peak),
        _ => length(study.worst(|_, place| place.peak)),
    }
}
