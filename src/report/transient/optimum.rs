//! What `optimize` says of a structure that is not driven steadily.

use serde_json::{Value, json};

use crate::case::Case;
use crate::excitation::Scene;
use crate::method::Method;
use crate::operating_range::Edge;
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;
use crate::report::document::{NOTICEABLE, edges};
use crate::report::optimize::FORMAT;
use crate::report::render::RenderError;
use crate::report::template::render;
use crate::transient::{ClearanceOptimum, WithError};

/// What was found, in SI. `written` is the document of the case with the best clearance, `beside`
/// the edges of that.
pub fn optimum(case: &Case, best: &ClearanceOptimum, written: &Value, beside: &[Edge]) -> Value {
    let records = written["records"].as_u64().unwrap_or(1);
    let (objective, kind, [bare, damper]) = match case.design.scene() {
        Scene::Release => ("decay-time", &of::DECAY_TIME, ["bare_decay_time", "damper_decay_time"]),
        _ if records > 1 => ("peak-displacement", &of::MEAN_PEAK, ["bare_peak", "damper_peak"]),
        _ => ("peak-displacement", &of::PEAK, ["bare_peak", "damper_peak"]),
    };
    let clearance = |length| Quantity::new(&of::CLEARANCE, length, Method::Given);
    let simulated = |[value, error]: WithError| {
        Quantity::new(kind, value, Method::Simulation).with_error(error)
    };
    let alone = &written["quantities"][bare];
    // Of one release, sweep or set of records what every command says of the written case.
    let all = match case.optimize.releases {
        None => json!(written["quantities"][kind.id]),
        Some(_) => json!(simulated(best.checked)),
    };
    let (checked, own) = (best.checked[0], best.own[0]);
    // Nothing limits what has no number.
    let limit = alone["value"].as_f64().unwrap_or(f64::INFINITY) * (1.0 - NOTICEABLE);
    let answer = match checked {
        _ if !checked.is_finite() => "not-reached",
        _ if checked.min(own) >= limit => "no-help",
        _ if best.design.clearance() == case.design.clearance() => "own-is-best",
        _ => "found",
    };
    json!({
        "format": FORMAT,
        "title": case.title,
        "objective": objective,
        "answer": answer,
        "optimum": { "clearance": best.design.clearance() },
        "claimed": simulated(best.claimed),
        // From the places of a study, as every command says it.
        "checked": all,
        "sample": written["sample"],
        "bound": best.bound.map(clearance),
        // Numbers a fiftieth beside which a criterion fails, or the objective is half as large again.
        "edges": edges(case, beside),
        "records": records,
        "feasible": written["criteria"].is_null()
            || written["criteria"]["holding"] == written["criteria"]["count"],
        "clearance": clearance(best.design.clearance()),
        "own": { "clearance": clearance(case.design.clearance()), "value": simulated(best.own) },
        "alone": alone,
        "damper": written["quantities"][damper],
        "releases": case.optimize.releases,
        "share": case.decay_level,
        "criteria": written["criteria"],
        "landscape": best.landscape,
    })
}

/// Its sentences.
///
/// # Errors
/// [`RenderError::Template`] if the template does not fit.
pub fn optimum_text(case: &Case, document: &Value) -> Result<String, RenderError> {
    render("clearance.txt", &case.units(), document)
}
