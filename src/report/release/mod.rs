//! A structure that is released or struck: its report, and what `analyze`, `simulate` and `optimize` print of it.
//! The sentences are in `templates/`.

mod figure;

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use serde_json::{Value, json};

use super::document::criteria::{badge, criteria};
use super::document::{FORMAT, Scale, Word, figure_row, units};
use super::figure::Figure;
use super::render::{Files, RenderError, in_lines, page_files};
use super::template::{render, worded};
use crate::case::{Case, Design};
use crate::criteria::Judged;
use crate::method::Method;
use crate::quantity::catalogue as of;
use crate::quantity::{Kind, Quantity};
use crate::transient::{Best, Decay, DecayStudy, Start};

/// Relative change of the time that is worth calling one.
pub(super) const NOTICEABLE: f64 = 0.02;

/// The files of a report's folder.
///
/// # Errors
/// [`RenderError`] says which part cannot be rendered.
pub fn files(
    name: &str,
    case: &Case,
    study: &DecayStudy,
    judged: &[Judged],
) -> Result<Files, RenderError> {
    let facts = document(name, case, study, judged);
    let figures = figure::figures(case, study, &facts);
    written("release.md", case, facts, figures)
}

/// The files of a page by a template, with its facts and figures.
pub(super) fn written(
    template: &str,
    case: &Case,
    mut facts: Value,
    figures: Vec<Figure>,
) -> Result<Files, RenderError> {
    let units = units(case);
    let figures = worded(figures, &units)?;
    facts["figures"] = figures.iter().map(figure_row).collect();
    let json = format!("{}\n", in_lines(&facts, 0));
    let tone = facts["verdict"]["tone"].as_str().unwrap_or_default().to_owned();
    let mut files = page_files("report", template, Some(&tone), &units, facts, &figures)?;
    files.insert("report.json".into(), json.into_bytes());
    Ok(files)
}

/// What a terminal shows.
///
/// # Errors
/// [`RenderError::Template`] if the template does not fit.
pub fn text(case: &Case, document: &Value) -> Result<String, RenderError> {
    render("release.txt", &units(case), document)
}

/// A report as data. Quantities are in SI.
pub fn document(name: &str, case: &Case, study: &DecayStudy, judged: &[Judged]) -> Value {
    let scale = Scale::of(case);
    let start = |(w, decay, _): &Start| row(&scale, *w, decay);
    let word = badge(judged).unwrap_or_else(|| word(study));
    let mut document = head(name, case, (word, "release"), &quantities(case, study), judged);
    document["notes"].as_array_mut().into_iter().for_each(|all| all.extend(notes(study)));
    // One for each place of the absorber.
    document["starts"] = study.starts.iter().map(start).collect();
    document["count_inactive"] = study.count_inactive.into();
    // Share of the first amplitude that counts as rest.
    document["share"] = case.decay_level.into();
    document
}

/// What every page of a transient has.
pub(super) fn head(
    name: &str,
    case: &Case,
    (word, headline): (Word, &str),
    quantities: &[Quantity],
    judged: &[Judged],
) -> Value {
    let all: BTreeMap<&str, Quantity> = quantities.iter().map(|one| (one.kind.id, *one)).collect();
    let warnings = case.warnings().iter();
    let warnings =
        warnings.map(|one| json!({ "kind": "warning", "line": one.line, "message": one.message }));
    json!({
        "format": FORMAT,
        "name": name,
        "title": case.title,
        "source": case.source,
        "units": "si",
        "verdict": { "tone": word.tone(), "word": word, "headline": headline },
        "quantities": all,
        "criteria": criteria(case, judged),
        "notes": warnings.collect::<Vec<_>>(),
        "count_inactive": case.count_inactive,
        "band": null,
        "inputs": case.inputs(),
        "derived": case.derived(),
        "figures": [],
        "provenance": {
            "program": env!("CARGO_PKG_NAME"),
            "version": env!("CARGO_PKG_VERSION"),
            "case_sha256": case.text_hash,
        },
    })
}

fn row(scale: &Scale, w: f64, decay: &Decay) -> Value {
    json!({
        "absorber": scale.length(&of::RELATIVE_DISPLACEMENT, w, Method::Given),
        "time": time(scale, &of::DECAY_TIME, decay.oscillations, Method::Simulation),
        "impacts": Quantity::new(&of::IMPACT_COUNT, decay.impacts as f64, Method::Simulation),
        "impact_speed": scale.velocity(&of::IMPACT_SPEED, [decay.impact_speed, 0.0], Method::Simulation),
        "impact_share": Quantity::new(&of::IMPACT_ENERGY_SHARE, decay.impact_share, Method::Simulation),
    })
}

/// A time in oscillations of the structure.
fn time(scale: &Scale, kind: &'static Kind, oscillations: f64, method: Method) -> Quantity {
    Quantity::new(kind, scale.time(TAU * oscillations), method)
}

fn quantities(case: &Case, study: &DecayStudy) -> Vec<Quantity> {
    let scale = Scale::of(case);
    let given = |kind, value| Quantity::new(kind, value, Method::Given);
    let theory = &study.predicted;
    let (_, damped, damper_time) = &study.damped;
    let simulated = Method::Simulation;
    let mut all = vec![
        scale.length(&of::CLEARANCE, 1.0, Method::Given),
        given(&of::RESTITUTION, study.system.restitution()),
        given(&of::MASS_RATIO, study.system.mass_ratio()),
        scale.length(&of::INITIAL_AMPLITUDE, study.from, Method::Given),
        scale.length(&of::DECAY_LEVEL, study.level, Method::Given),
        time(&scale, &of::BARE_DECAY_TIME, study.bare, Method::ClosedForm),
        time(&scale, &of::DAMPER_DECAY_TIME, *damper_time, Method::ClosedForm),
        time(&scale, &of::THEORY_DECAY_TIME, theory.oscillations, theory.method),
        scale.length(&of::DAMPER_STROKE, damped.stroke, Method::ClosedForm),
        scale.length(&of::RESIDUAL_AMPLITUDE, theory.residual, Method::ClosedForm),
    ];
    let decided = if study.decides_inactive() { Method::ClosedForm } else { simulated };
    if study.inactive > 0.0 {
        all.push(Quantity::new(&of::INACTIVE_SHARE, study.inactive, Method::ClosedForm));
    }
    if let Some((_, worst, found)) = study.worst() {
        all.extend([
            scale.length(&of::PEAK, found.peak, simulated),
            time(&scale, &of::DECAY_TIME, study.slowest(), decided),
            time(&scale, &of::ACTIVE_DECAY_TIME, worst.oscillations, simulated),
            time(&scale, &of::FASTEST_DECAY_TIME, study.fastest(), simulated),
            scale.velocity(&of::IMPACT_SPEED, [worst.impact_speed, 0.0], simulated),
            Quantity::new(&of::IMPACT_COUNT, worst.impacts as f64, simulated),
            Quantity::new(&of::IMPACT_ENERGY_SHARE, worst.impact_share, simulated),
        ]);
    }
    if let Design::Physical(physical) = &case.design {
        all.push(given(&of::ABSORBER_MASS, physical.absorber_mass_kg));
    }
    all
}

/// The answer where there are no criteria.
fn word(study: &DecayStudy) -> Word {
    let worst = study.slowest();
    match (worst / study.bare, study.fastest() / study.bare) {
        (slow, _) if worst.is_finite() && slow < 1.0 - NOTICEABLE => Word::Works,
        (_, fast) if fast < 1.0 - NOTICEABLE => Word::Mixed,
        (slow, _) if slow > 1.0 + NOTICEABLE => Word::MakesItWorse,
        _ => Word::DoesNothing,
    }
}

fn notes(study: &DecayStudy) -> Vec<Value> {
    let mut notes = Vec::new();
    if study.system.restitution() == 1.0 {
        notes.push(json!({ "kind": "elastic" }));
    }
    if study.level < study.predicted.residual {
        notes.push(json!({ "kind": "below-capture" }));
    }
    notes
}

/// What `optimize` found: `vinesink/optimization@3`.
pub fn optimum(case: &Case, best: &Best, judged: &[Judged]) -> Value {
    let (scale, scales) = (Scale::of(case), case.scales());
    let clearance = |length| Quantity::new(&of::CLEARANCE, length, Method::Given);
    let time = |oscillations| time(&scale, &of::DECAY_TIME, oscillations, Method::Simulation);
    let reached = best.checked.is_finite();
    let improves = reached && best.checked < best.own;
    json!({
        "format": "vinesink/optimization@3",
        "title": case.title,
        "objective": "decay-time",
        "answer": if !reached { "not-reached" } else if improves { "found" } else { "own-is-best" },
        "optimum": { "clearance": best.design.clearance() },
        "claimed": { "value": scales.time(TAU * best.oscillations), "error": 0.0 },
        // From other places of the absorber.
        "checked": { "value": scales.time(TAU * best.checked), "error": 0.0 },
        "feasible": judged.iter().all(|one| one.holds == Some(true)),
        "clearance": clearance(best.design.clearance()),
        "time": time(best.checked),
        "own": { "clearance": clearance(case.design.clearance()), "time": time(best.own) },
        "releases": case.optimize.releases,
        "share": case.decay_level,
        "criteria": criteria(case, judged),
        "landscape": best.landscape.iter().map(|[at, value]| [*at, scales.time(TAU * value)]).collect::<Vec<_>>(),
    })
}

/// The sentences of an optimisation.
///
/// # Errors
/// [`RenderError::Template`] if the template does not fit.
pub fn optimum_text(case: &Case, document: &Value) -> Result<String, RenderError> {
    render("release-optimum.txt", &units(case), document)
}
