//! What a search of better absorbers of a structure of several modes found, as data and in words.

use serde_json::{Value, json};

use super::criteria::criteria;
use super::{absorbers, given, simulated, units, worst_row};
use crate::case::{Bounds, ModalCase};
use crate::modal::{JudgedAbsorbers, ModalOptimum, clearance_bounds};
use crate::quantity::catalogue as of;
use crate::report::error::RenderError;
use crate::report::template::render;

/// Absorbers and what they do.
fn candidate(found: &JudgedAbsorbers) -> Value {
    let loads = 0..found.case.loads.len();
    let peaks = loads.map(|k| {
        let worst = found.answer.worst(&found.case, Some(k)).map(|worst| worst.found);
        worst.map(|one| simulated(&of::PEAK, one.value).with_error(one.error))
    });
    json!({
        "absorbers": absorbers(&found.case),
        "criteria": criteria(&found.case, &found.answer),
        "all_hold": found.answer.all_hold(),
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
    let Bounds { clearance_m, restitution, places, split_mass } = &case.bounds;
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

/// What was found: `vinesink/optimization@3` with the fields of several modes, in SI.
pub fn optimum(case: &ModalCase, found: &ModalOptimum) -> Value {
    json!({
        "format": "vinesink/optimization@3",
        "title": case.title,
        "answer": if found.succeeds() { "found" } else { "none" },
        "asked": !case.criteria.is_empty(),
        "bounds": bounds(case),
        "candidates": found.candidates,
        "starts": super::starts(case),
        "nearest": absorbers(&found.nearest().case),
        "at_bound": at_bound(case, &found.nearest().case),
        "own": candidate(&found.own),
        "best": found.best.iter().map(candidate).collect::<Vec<_>>(),
        "loads": case.loads.iter().map(|load| super::load_row(case, load)).collect::<Vec<_>>(),
    })
}

/// The same on a terminal.
///
/// # Errors
/// [`RenderError::Template`] if the template does not fit.
pub fn optimum_text(case: &ModalCase, document: &Value) -> Result<String, RenderError> {
    render("modal-optimum.txt", &units(case), document)
}
