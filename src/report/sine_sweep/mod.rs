//! A structure that is swept through resonance: its report, and what `simulate` prints of it. The sentences are in
//! `templates/`.

mod figure;

use serde_json::{Value, json};

use super::document::criteria::badge;
use super::document::{Scale, Word, units};
use super::release::{NOTICEABLE, head, written};
use super::render::{Files, RenderError};
use super::template::render;
use crate::case::{Case, Design};
use crate::criteria::Judged;
use crate::method::Method;
use crate::quantity::catalogue as of;
use crate::quantity::{Kind, Quantity};
use crate::transient::{ByRate, Jump, Passage, SweepRate, SweepStart, SweepStudy};

/// The files of a report's folder.
///
/// # Errors
/// [`RenderError`] says which part cannot be rendered.
pub fn files(
    name: &str,
    case: &Case,
    study: &SweepStudy,
    judged: &[Judged],
) -> Result<Files, RenderError> {
    let facts = document(name, case, study, judged);
    let figures = figure::figures(case, study, &facts);
    written("sine-sweep.md", case, facts, figures)
}

/// What a terminal shows.
///
/// # Errors
/// [`RenderError::Template`] if the template does not fit.
pub fn text(case: &Case, document: &Value) -> Result<String, RenderError> {
    render("sine-sweep.txt", &units(case), document)
}

/// A report as data. Quantities are in SI.
pub fn document(name: &str, case: &Case, study: &SweepStudy, judged: &[Judged]) -> Value {
    let scale = Scale::of(case);
    let length = |kind, value| scale.length(kind, value, Method::Simulation);
    let word = badge(judged).unwrap_or_else(|| word(study));
    let mut document = head(name, case, (word, "sine-sweep"), &quantities(case, study), judged);
    let start = |(w, found): &SweepStart| {
        json!({
            "absorber": scale.length(&of::RELATIVE_DISPLACEMENT, *w, Method::Given),
            "peak": length(&of::PEAK, found.peak()[1]),
            "at": scale.frequency(found.peak()[0], Method::Simulation),
            "impacts": Quantity::new(&of::IMPACT_COUNT, found.impacts as f64, Method::Simulation),
            "impact_speed": scale.velocity(&of::IMPACT_SPEED, [found.impact_speed, 0.0], Method::Simulation),
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
    document["starts"] = study.starts.iter().map(start).collect();
    document["down"] = (study.sweep.from > study.sweep.to).into();
    // In the case's direction, and in the other.
    document["jumps"] =
        study.jumps.iter().map(|all| all.iter().map(jump).collect::<Vec<_>>()).collect();
    document["differ"] =
        json!(study.differ.map(|ends| ends.map(|at| scale.frequency(at, Method::Simulation))));
    document["by_rate"] = study.by_rate.iter().map(by_rate).collect();
    document
}

fn rate(rate: SweepRate) -> Quantity {
    match rate {
        SweepRate::Linear(rate) => Quantity::new(&of::SWEEP_RATE, rate, Method::Given),
        SweepRate::Octaves(rate) => Quantity::new(&of::OCTAVE_RATE, rate, Method::Given),
    }
}

fn quantities(case: &Case, study: &SweepStudy) -> Vec<Quantity> {
    let scale = Scale::of(case);
    let given = |kind, value| Quantity::new(kind, value, Method::Given);
    let at = |kind: &'static Kind, passage: &Passage, method| Quantity {
        kind,
        ..scale.frequency(passage.peak()[0], method)
    };
    let peak = |kind, passage: &Passage, method| scale.length(kind, passage.peak()[1], method);
    let (exact, simulated) = (Method::ClosedForm, Method::Simulation);
    let (sweep, damped) = (&study.sweep, &study.damped.1);
    let mut all = vec![
        scale.length(&of::CLEARANCE, 1.0, Method::Given),
        given(&of::RESTITUTION, study.system.restitution()),
        given(&of::MASS_RATIO, study.system.mass_ratio()),
        scale.amplitude(1.0, Method::Given),
        given(&of::SWEEP_FROM, sweep.from),
        given(&of::SWEEP_TO, sweep.to),
        Quantity { kind: rate(sweep.rate).kind, ..rate(sweep.rate) },
        Quantity::new(&of::SWEEP_TIME, sweep.time(sweep.count() as f64), exact),
        peak(&of::BARE_PEAK, &study.alone, exact),
        at(&of::BARE_PEAK_FREQUENCY, &study.alone, exact),
        peak(&of::DAMPER_PEAK, damped, exact),
        at(&of::DAMPER_PEAK_FREQUENCY, damped, exact),
        scale.length(&of::DAMPER_STROKE, damped.stroke, exact),
        peak(&of::RETURN_PEAK, &study.back, simulated),
        at(&of::RETURN_PEAK_FREQUENCY, &study.back, simulated),
        scale.length(&of::LEAST_PEAK, study.least(), simulated),
    ];
    if let Some((_, worst)) = study.worst() {
        let largest =
            |of: &dyn Fn(&SweepStart) -> f64| study.starts.iter().map(of).fold(0.0, f64::max);
        let speed = largest(&|(_, found)| found.impact_speed);
        let change = |kind, rival: &Passage| {
            let level = crate::band::rivals::reduction_db(worst.peak()[1], rival.peak()[1]);
            Quantity::new(kind, level, simulated)
        };
        all.extend([
            peak(&of::PEAK, worst, simulated),
            at(&of::PEAK_FREQUENCY, worst, simulated),
            scale.velocity(&of::IMPACT_SPEED, [speed, 0.0], simulated),
            Quantity::new(&of::IMPACT_COUNT, worst.impacts as f64, simulated),
            change(&of::REDUCTION_DB, &study.alone),
            change(&of::REDUCTION_DB_TMD, damped),
        ]);
    }
    if let Design::Physical(physical) = &case.design {
        all.push(given(&of::ABSORBER_MASS, physical.absorber_mass_kg));
    }
    all
}

/// The answer where there are no criteria.
fn word(study: &SweepStudy) -> Word {
    let alone = study.alone.peak()[1];
    let worst = study.worst().map_or(f64::NAN, |(_, worst)| worst.peak()[1]);
    match (worst / alone, study.least() / alone) {
        (worst, _) if worst < 1.0 - NOTICEABLE => Word::Works,
        (_, least) if least < 1.0 - NOTICEABLE => Word::Mixed,
        (worst, _) if worst > 1.0 + NOTICEABLE => Word::MakesItWorse,
        _ => Word::DoesNothing,
    }
}
