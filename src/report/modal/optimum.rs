//! What a search of better absorbers of a structure of several modes found, as data and in words.

use serde_json::{Value, json};

use super::criteria::criteria;
use super::{absorbers, figure, given, simulated, units, worst_row};
use crate::case::{Bounds, ModalCase, Objective};
use crate::method::Method;
use crate::modal::{Aim, JudgedAbsorbers, ModalOptimum, clearance_bounds};
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;
use crate::report::error::RenderError;
use crate::report::optimize::{FORMAT, kind};
use crate::report::render::{Files, page_files};
use crate::report::template::{render, worded};

/// Absorbers and what they do.
fn candidate(found: &JudgedAbsorbers, aim: Aim) -> Value {
    let loads = 0..found.case.loads.len();
    let peaks = loads.map(|k| {
        let worst = found.answer.worst(&found.case, Some(k)).map(|worst| worst.found);
        worst.map(|one| simulated(&of::PEAK, one.value).with_error(one.error))
    });
    json!({
        "absorbers": absorbers(&found.case),
        "criteria": criteria(&found.case, &found.answer),
        "all_hold": found.answer.all_hold(),
        // What was looked for.
        "value": value(found, aim, found.value),
        // The most that any motion may have of what a criterion is about, over what is allowed.
        "reach": found.reaches.iter().copied().fold(0.0, f64::max),
        "worst": found.answer.worst(&found.case, None).map(|one| worst_row(&found.case, &one)),
        "loads": peaks.collect::<Vec<_>>(),
    })
}

/// Whether a clearance of absorbers that were found is at an end of the bounds within which it was looked for.
fn at_bound(case: &ModalCase, found: &ModalCase) -> bool {
    if found.absorbers == case.absorbers {
        return false;
    }
    let mut both = case.absorbers.iter().zip(&found.absorbers);
    both.any(|(own, one)| {
        let bounds = clearance_bounds(case.bounds.clearance_m, own);
        bounds.into_iter().any(|end| (one.clearance_m / end - 1.0).abs() < AT_BOUND)
    })
}

/// Distance from a bound, over it, up to which a clearance is at it.
const AT_BOUND: f64 = 0.03;

/// Between which bounds was looked.
fn bounds(case: &ModalCase) -> Value {
    let Bounds { clearance_m, restitution, places, split_mass, .. } = &case.bounds;
    let clearances = case
        .absorbers
        .iter()
        .map(|one| clearance_bounds(*clearance_m, one).map(|bound| given(&of::CLEARANCE, bound)));
    let names = places.iter().map(|place| &case.places[*place]);
    json!({
        "clearances": clearances.collect::<Vec<_>>(),
        "common": clearance_m.is_some() || case.absorbers.len() == 1,
        "restitution": restitution.map(|both| both.map(|bound| given(&of::RESTITUTION, bound))),
        "places": names.collect::<Vec<_>>(),
        "split_mass": split_mass,
    })
}

/// What was looked for of absorbers: null where nothing can be said.
fn value(found: &JudgedAbsorbers, aim: Aim, [value, error]: [f64; 2]) -> Value {
    let of = match aim {
        Aim::Of(objective) => Quantity::new(kind(objective), value, method(objective)),
        // A share of what criteria allow.
        Aim::Room => {
            return json!(
                value.is_finite().then(|| json!({ "value": value, "error": error, "unit": "1" }))
            );
        }
    };
    let unit = of.kind.dimension.symbol(!found.case.reduced);
    let mut told = json!(of.with_error(error));
    told["unit"] = json!(unit);
    json!(value.is_finite().then_some(told))
}

/// How it is known.
fn method(objective: Objective) -> Method {
    match objective {
        Objective::WorstAmplitude => Method::Simulation,
        Objective::StableShare | Objective::Margin | Objective::Z3Share => Method::ExactOrbit,
    }
}

/// Absorbers as they are written: each of a list, and of one alone at the top.
fn built(found: &JudgedAbsorbers) -> Value {
    let each = found.case.absorbers.iter().enumerate().map(|(j, one)| {
        json!({
            "absorber": j + 1,
            "place": found.case.places[one.place],
            "clearance": one.clearance_m,
            "restitution": one.restitution,
            "mass": one.mass_kg / found.case.mass_unit(),
        })
    });
    let each: Vec<Value> = each.collect();
    match each.as_slice() {
        [one] => {
            let mut told = one.clone();
            told["absorbers"] = json!(each);
            told
        }
        _ => json!({ "absorbers": each }),
    }
}

/// What was found, in SI: the fields of one mode, and those of several.
pub fn optimum(case: &ModalCase, found: &ModalOptimum) -> Value {
    let (aim, nearest) = (found.aim, found.nearest());
    let row = |one: &JudgedAbsorbers| candidate(one, aim);
    let robust = found.robust.as_ref().map(|one| {
        let mut told = row(&one.design);
        let [of_robust, of_best] = one.under;
        let of = |number: f64| value(&one.design, aim, [number, 0.0]);
        told["expected"] = of(of_robust.expected);
        told["worst_corner"] = of(of_robust.worst_corner);
        // The same for the optimum as written.
        told["optimum_expected"] = of(of_best.expected);
        told["optimum_worst_corner"] = of(of_best.worst_corner);
        told["combinations"] = json!(one.combinations);
        told["is_optimum"] = json!(one.design.case.absorbers == nearest.case.absorbers);
        told["optimum"] = built(&one.design);
        told
    });
    let (name, objective) = match aim {
        Aim::Room => ("criteria", None),
        Aim::Of(objective) => (objective.name(), Some(objective)),
    };
    json!({
        "format": FORMAT,
        "title": case.title,
        "answer": match (found.reached(), found.succeeds()) {
            (false, _) => "not-reached",
            (true, true) => "found",
            (true, false) => "none",
        },
        "reached": found.reached(),
        "asked": !case.criteria.is_empty(),
        "objective": name,
        "by_orbits": objective.is_some_and(|one| method(one) == Method::ExactOrbit),
        "uncertainty": case.uncertainty,
        // Whether all criteria hold at the optimum; true without criteria.
        "feasible": nearest.is_feasible(),
        // Whether the optimum is other absorbers than the case's own, and better.
        "improves": found.reached() && nearest.case.absorbers != case.absorbers,
        // Rounded as it is written.
        "optimum": found.reached().then(|| built(nearest)),
        // What is looked for, of the case as it is written.
        "claimed": value(nearest, aim, nearest.value),
        "checked": value(nearest, aim, nearest.value),
        "bounds": bounds(case),
        "candidates": found.candidates,
        "starts": super::starts(case),
        "nearest": absorbers(&nearest.case),
        "at_bound": at_bound(case, &nearest.case),
        "own": row(&found.own),
        "best": found.best.iter().map(row).collect::<Vec<_>>(),
        "robust": robust,
        "loads": case.loads.iter().map(|load| super::load_row(case, load)).collect::<Vec<_>>(),
        "case_sha256": case.text_hash,
    })
}

/// What the templates read of a document.
fn context(document: &Value) -> Value {
    let mut at = document.clone();
    at["version"] = json!(env!("CARGO_PKG_VERSION"));
    json!({ "at": at })
}

/// The files of the page, by their path in the case's folder.
///
/// # Errors
/// [`RenderError`] if template and document do not fit, or a figure cannot be drawn.
pub fn optimum_files(
    case: &ModalCase,
    found: &ModalOptimum,
    document: &Value,
) -> Result<Files, RenderError> {
    let (units, context) = (units(case), context(document));
    let mut drawn = vec![figure::optimum(case, found, &context)];
    drawn.retain(|figure| !figure.panels.is_empty());
    let figures = worded(drawn, &units)?;
    let tone = if found.succeeds() { "good" } else { "bad" };
    page_files("optimize", "loads-optimum.md", Some(tone), &units, context, &figures)
}

/// The same on a terminal.
///
/// # Errors
/// [`RenderError::Template`] if the template does not fit.
pub fn optimum_text(case: &ModalCase, document: &Value) -> Result<String, RenderError> {
    render("loads-optimum.txt", &units(case), &context(document))
}
