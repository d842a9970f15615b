//! A structure that is swept through resonance.

mod figure;

use serde_json::{Value, json};

use super::{sample, word_of, worst_rows};
use crate::case::Case;
use crate::excitation::SweepRate;
use crate::measure::Measure;
use crate::method::Method;
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;
use crate::report::document::{Scale, Word};
use crate::transient::{ByRate, Jump, SweepStart, SweepStudy};

pub(super) use figure::figures;

/// What its page has beside what all have.
pub(super) fn add(case: &Case, study: &SweepStudy, document: &mut Value) {
    let scale = Scale::of(case);
    let length = |kind, value| scale.units.quantity(kind, value, Method::Simulation);
    let start = |(w, found): &SweepStart| {
        json!({
            "absorber": scale.units.quantity(&of::RELATIVE_DISPLACEMENT, *w, Method::Given),
            "peak": length(&of::PEAK, found.peak()[1]),
            "at": scale.frequency(found.peak()[0], Method::Simulation),
            "impacts": Quantity::new(&of::IMPACT_COUNT, found.impacts as f64, Method::Simulation),
            "impact_speed": scale.units.quantity(&of::IMPACT_SPEED, found.impact_speed, Method::Simulation),
        })
    };
    let jump = |jump: &Jump| {
        json!({
            "at": scale.frequency(jump.at, Method::Simulation),
            "levels": jump.levels.map(|level| length(&of::PEAK, level)),
        })
    };
    let by_rate = |one: &ByRate| {
        json!({
            "rate": rate(one.sweep.rate),
            "own": one.sweep == study.sweep,
            "peaks": one.peaks.map(|[at, peak]| json!({
                "peak": length(&of::PEAK, peak), "at": scale.frequency(at, Method::Simulation),
            })),
        })
    };
    // One for each place of the absorber.
    document["starts"] = study.starts.by_place().into_iter().map(start).collect();
    document["worst"] = worst_rows(case, &study.starts, Measure::Peak, start);
    document["sample"] = sample(study.starts.sample());
    document["places_beside"] = study.starts.even.min(SweepStudy::STARTS_BESIDE.into()).into();
    document["down"] = (study.sweep.from > study.sweep.to).into();
    // In the case's direction, and in the other.
    document["jumps"] =
        study.jumps.iter().map(|all| all.iter().map(jump).collect::<Vec<_>>()).collect();
    document["differ"] =
        json!(study.differ.map(|ends| ends.map(|at| scale.frequency(at, Method::Simulation))));
    document["by_rate"] = study.by_rate.iter().map(by_rate).collect();
}

fn rate(rate: SweepRate) -> Quantity {
    match rate {
        SweepRate::Linear(rate) => Quantity::new(&of::SWEEP_RATE, rate, Method::Given),
        SweepRate::Octaves(rate) => Quantity::new(&of::OCTAVE_RATE, rate, Method::Given),
    }
}

/// What has no place in the list of measures.
pub(super) fn quantities(case: &Case, study: &SweepStudy) -> Vec<Quantity> {
    let scale = Scale::of(case);
    let given = |kind, value| Quantity::new(kind, value, Method::Given);
    let simulated = Method::Simulation;
    let (sweep, [at, peak]) = (&study.sweep, study.back.peak());
    let least = study.starts.least(Measure::Peak).unwrap_or(f64::INFINITY);
    vec![
        scale.amplitude(1.0, Method::Given),
        given(&of::SWEEP_FROM, sweep.from),
        given(&of::SWEEP_TO, sweep.to),
        rate(sweep.rate),
        Quantity::new(&of::SWEEP_TIME, sweep.time(sweep.count() as f64), Method::ClosedForm),
        scale.units.quantity(&of::RETURN_PEAK, peak, simulated),
        scale.units.quantity(&of::RETURN_PEAK_FREQUENCY, at, simulated),
        scale.units.quantity(&of::LEAST_PEAK, least, simulated),
    ]
}

pub(super) fn word(study: &SweepStudy) -> Word {
    let alone = study.alone.peak()[1];
    let worst = study.worst().map_or(f64::NAN, |(_, worst)| worst.peak()[1]);
    let least = study.starts.least(Measure::Peak).unwrap_or(f64::NAN);
    word_of(worst / alone, least / alone)
}
