//! A structure that is swept through resonance.

mod figure;

use serde_json::{Value, json};

use super::{sample, word_of, worst_rows};
use crate::case::Case;
use crate::excitation::SweepRate;
use crate::flights::Passage;
use crate::linear::reduction_db;
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
    let mut starts: Vec<&SweepStart> = study.starts.iter().collect();
    starts.sort_by(|a, b| a.0.total_cmp(&b.0));
    document["starts"] = starts.into_iter().map(start).collect();
    document["worst"] = worst_rows(&study.starts, |(_, found)| found.peak()[1], start);
    document["sample"] = sample(study.even, study.starts.len());
    document["places_beside"] = study.even.min(SweepStudy::STARTS_BESIDE.into()).into();
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

pub(super) fn quantities(case: &Case, study: &SweepStudy) -> Vec<Quantity> {
    let scale = Scale::of(case);
    let given = |kind, value| Quantity::new(kind, value, Method::Given);
    let at =
        |kind, passage: &Passage, method| scale.units.quantity(kind, passage.peak()[0], method);
    let peak =
        |kind, passage: &Passage, method| scale.units.quantity(kind, passage.peak()[1], method);
    let (exact, simulated) = (Method::ClosedForm, Method::Simulation);
    let (sweep, damped) = (&study.sweep, &study.damped.1);
    let mut all = vec![
        scale.amplitude(1.0, Method::Given),
        given(&of::SWEEP_FROM, sweep.from),
        given(&of::SWEEP_TO, sweep.to),
        rate(sweep.rate),
        Quantity::new(&of::SWEEP_TIME, sweep.time(sweep.count() as f64), exact),
        peak(&of::BARE_PEAK, &study.alone, exact),
        at(&of::BARE_PEAK_FREQUENCY, &study.alone, exact),
        peak(&of::DAMPER_PEAK, damped, exact),
        at(&of::DAMPER_PEAK_FREQUENCY, damped, exact),
        scale.units.quantity(&of::DAMPER_STROKE, damped.stroke, exact),
        peak(&of::RETURN_PEAK, &study.back, simulated),
        at(&of::RETURN_PEAK_FREQUENCY, &study.back, simulated),
        scale.units.quantity(&of::LEAST_PEAK, study.least(), simulated),
    ];
    if let Some((_, worst)) = study.worst() {
        let (largest, speed) =
            (study.largest(|found| found.peak()[1]), study.largest(|found| found.impact_speed));
        let change = |kind, rival: &Passage| {
            let level = |peak: f64| reduction_db(peak, rival.peak()[1]);
            let [peak, error] = largest;
            Quantity::new(kind, level(peak), simulated)
                .with_error(level(peak) - level(peak + error))
        };
        all.extend([
            scale.units.quantity_with(&of::PEAK, largest, simulated),
            at(&of::PEAK_FREQUENCY, worst, simulated),
            scale.units.quantity_with(&of::IMPACT_SPEED, speed, simulated),
            Quantity::new(&of::IMPACT_COUNT, worst.impacts as f64, simulated),
            change(&of::REDUCTION_DB, &study.alone),
            change(&of::REDUCTION_DB_TMD, damped),
        ]);
    }
    all
}

pub(super) fn word(study: &SweepStudy) -> Word {
    let alone = study.alone.peak()[1];
    let worst = study.worst().map_or(f64::NAN, |(_, worst)| worst.peak()[1]);
    word_of(worst / alone, study.least() / alone)
}
