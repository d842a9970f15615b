//! The page of `vinesink optimize` as data, most of which is its JSON document. The sentences are in
//! `templates/`.

mod figure;

use serde_json::json;

use super::document::criteria::criterion;
use super::document::{AbsorberAlong, Scale, damper, edges};
use super::render::{Files, RenderError, page_files};
use super::template::{render, worded};
use crate::case::{self, BandOver, Case, Objective};
use crate::criteria::method;
use crate::method::Method;
use crate::motions::{Motion, Value};
use crate::optimize::sensitivity::Sensitivity;
use crate::optimize::{Bounds, JudgedDesign, Optimization, Task};
use crate::quantity::{Kind, Quantity, catalogue};
use crate::system::Parameter;

pub use figure::figures;

/// The format of documents of what an optimisation found, whatever moves.
pub const FORMAT: &str = "vinesink/optimization@4";
/// Relative distance from a bound within which a value lies on it: it may have been rounded.
const ON_BOUND: f64 = 1e-3;
/// Share of a band in strips from which on the reader is told.
const STRIPS: f64 = 0.01;
/// Places of the band that the table shows, the worst one included.
const SHOWN: usize = 9;

/// What an optimisation found. Lengths in metres or the case's own unit.
pub fn document(case: &Case, found: &Optimization) -> serde_json::Value {
    let (best, task) = (&found.best, &found.task);
    let row = |design: &JudgedDesign| absorber(case, task, design);
    let robust = found.robust.as_ref().map(|one| {
        let [of_robust, of_best] = one.under;
        let mut robust = row(&one.design);
        robust["expected"] = json!(of_robust.expected);
        robust["worst_corner"] = json!(of_robust.worst_corner);
        // The same for the optimum as written.
        robust["optimum_expected"] = json!(of_best.expected);
        robust["optimum_worst_corner"] = json!(of_best.worst_corner);
        robust
    });
    let along = AbsorberAlong { over: over(task), worst: best.worst.as_ref() };
    let (scale, rivals) = (Scale::of(&best.written.case), best.survey.rivals());
    let mut beside = damper(&scale, rivals, Some(&along));
    // Where the structure's frequency is off by the least drift that the case names, either way.
    let drift = case.alternatives.drift.first().copied().unwrap_or_default();
    let off = |factor: f64| {
        let damped = rivals.damped_off(best.survey.band(), factor)?;
        let peak = |value| scale.units.quantity(&catalogue::DAMPER_PEAK, value, Method::ClosedForm);
        Some(json!({ "change": factor - 1.0, "peak": peak(damped.amplitude) }))
    };
    beside["detuned"] = [1.0 - drift, 1.0 + drift].into_iter().filter_map(off).collect();
    let mut page = json!({
        "format": FORMAT,
        "title": case.title,
        "answer": match (found.reached(), best.is_feasible(), found.improves()) {
            // The objective has no value above 0.
            (false, ..) => "not-reached",
            (true, false, _) => "none-meets",
            (true, true, false) => "own-is-best",
            (true, true, true) => "found",
        },
        "objective": task.objective.name(),
        "bounds": bounds(task),
        // In the units of the case.
        "uncertainty": case.uncertainty,
        // Whether the objective has a value at all.
        "reached": found.reached(),
        // Whether all criteria hold at the optimum; true without criteria.
        "feasible": best.is_feasible(),
        // Whether the optimum is another absorber than the case's own, and not worse.
        "improves": found.improves(),
        // Rounded as it is written; none where nothing is reached.
        "optimum": found.reached().then(|| built(&best.choice)),
        // The objective at the optimum as it is shown, and as a check of the written case gives it.
        "claimed": objective(task, best, [best.value, best.error]),
        "checked": objective(task, best, found.checked.into()),
        "best": row(best),
        "own": row(&found.own),
        // Where nothing meets all criteria, the absorber that misses them least.
        "closest": found.closest.as_ref().map(row),
        // What the limit of a displacement asks for by the first guess, where nothing meets all criteria.
        "needed": found.needed_mass_ratio.map(|ratio| json!({
            "mass_ratio": Quantity::new(&catalogue::MASS_RATIO, ratio, Method::ClosedForm),
            "mass": case.design.value(Parameter::Mass).map(|mass| {
                Quantity::new(&catalogue::ABSORBER_MASS, ratio * mass, Method::ClosedForm)
            }),
        })),
        "robust": robust,
        // Bounds of the search on which the optimum lies.
        "on_bounds": on_bounds(found),
        // Numbers a fiftieth beside which a criterion fails, or the worst displacement is half as large again.
        "edges": edges(&best.written.case, &found.edges),
        // Clearances that are as good as the optimum's.
        "plateau": found.plateau,
        "bare": best.survey.bare().1 * best.choice.clearance(),
        // The one of the absorber's mass that is best along the band.
        "tuned_mass_damper": beside,
        // Pairs of clearance and objective by the cheap layer.
        "landscape": found.landscape,
        // Every absorber that was judged.
        "judged": judged(found),
        "sensitivities": sensitivities(found),
        // Over the case's own clearance.
        "claim": found.claim,
        "chart": found.chart,
        "case_sha256": case.text_hash,
    });
    if !case.design.has_ideal_cavity() {
        page["real_cavity"] = json!(true);
    }
    page
}

/// A parameter as templates and files call it: of masses only the absorber's is chosen.
fn name(parameter: Parameter) -> &'static str {
    if parameter == Parameter::AbsorberMass { "mass" } else { parameter.key() }
}

/// The absorber of a design.
fn built(design: &case::Design) -> serde_json::Value {
    let chosen = [Parameter::Clearance, Parameter::Restitution, Parameter::AbsorberMass];
    let each = chosen.into_iter().map(|one| (name(one).to_owned(), json!(design.value(one))));
    let mut built: serde_json::Value = each.collect();
    // Those of both walls, where they differ.
    let apart = design.restitution_difference();
    let mean = design.value(Parameter::Restitution);
    if let Some(mean) = mean.filter(|_| apart != 0.0) {
        built["restitutions"] = json!([mean + 0.5 * apart, mean - 0.5 * apart]);
    }
    built
}

fn judged(found: &Optimization) -> Vec<serde_json::Value> {
    let rows = found.judged.iter().map(|one| {
        let (clearance, feasible) = (one.choice.clearance(), one.is_feasible());
        json!({ "clearance": clearance, "value": one.value, "error": one.error, "feasible": feasible })
    });
    rows.collect()
}

fn sensitivities(found: &Optimization) -> Vec<serde_json::Value> {
    let rows = found.sensitivities.iter().map(|one| {
        let Sensitivity { of, change, smaller, larger } = one;
        json!({ "of": name(*of), "change": change, "smaller": smaller, "larger": larger })
    });
    rows.collect()
}

fn bounds(task: &Task) -> Vec<serde_json::Value> {
    let bounds = task.bounds.iter().map(|Bounds { parameter, from, to }| {
        json!({ "variable": name(*parameter), "from": from, "to": to })
    });
    bounds.collect()
}

/// An absorber with its objective, as a quantity is written, and the criteria that it misses of all.
fn absorber(case: &Case, task: &Task, design: &JudgedDesign) -> serde_json::Value {
    let missed = design.criteria.iter().filter(|one| one.holds != Some(true));
    let mut row = json!(objective(task, design, [design.value, design.error]));
    for (key, value) in built(&design.choice).as_object().into_iter().flatten() {
        row[key] = value.clone();
    }
    row["feasible"] = json!(design.is_feasible());
    row["criteria"] = json!(design.criteria.len());
    row["missed"] = missed.map(|one| criterion(case, one)).collect();
    row
}

/// The kind of an objective's value.
pub(super) fn kind(objective: Objective) -> &'static Kind {
    match objective {
        Objective::Z3Share => &catalogue::Z3_SHARE,
        Objective::StableShare => &catalogue::STABLE_SHARE,
        Objective::WorstAmplitude => &catalogue::PEAK,
        Objective::Margin => &catalogue::SMALLEST_MARGIN,
    }
}

fn objective(task: &Task, design: &JudgedDesign, [value, error]: [f64; 2]) -> Quantity {
    let worst = design.worst.as_ref().map_or(Method::Simulation, |worst| method(&worst.motion));
    let method = match task.objective {
        Objective::Z3Share => Method::Theory,
        Objective::StableShare | Objective::Margin => Method::ExactOrbit,
        Objective::WorstAmplitude => worst,
    };
    Quantity::new(kind(task.objective), value, method).with_error(error)
}

/// The files of the page, by their path in the case's folder.
///
/// # Errors
/// [`RenderError`] if template and page do not fit, or a figure cannot be drawn.
pub fn files(case: &Case, found: &Optimization) -> Result<Files, RenderError> {
    let units = case.units();
    let tone = if found.succeeds() { "good" } else { "bad" };
    let figures = worded(figures(case, found), &units)?;
    page_files("optimize", "optimize.md", Some(tone), &units, context(case, found), &figures)
}

/// What the terminal shows.
///
/// # Errors
/// [`RenderError::Template`] if template and page do not fit.
pub fn summary(case: &Case, found: &Optimization) -> Result<String, RenderError> {
    render("optimize.txt", &case.units(), &context(case, found))
}

/// What became of the file that was asked for, in a line; `robust` if it holds the best in expectation.
///
/// # Errors
/// [`RenderError::Template`] if template and page do not fit.
pub fn written(
    case: &Case,
    found: &Optimization,
    file: &str,
    written: Option<&JudgedDesign>,
    robust: bool,
) -> Result<String, RenderError> {
    let context = json!({
        "file": file,
        "choice": written.map(|design| built(&design.choice)),
        "feasible": written.is_some_and(JudgedDesign::is_feasible),
        "none_meets": !found.best.is_feasible(),
        "robust": robust,
        "reached": found.reached(),
        "bounds": bounds(&found.task),
    });
    Ok(render("optimize-written.txt", &case.units(), &context)?.trim().to_owned())
}

/// What the templates read.
fn context(case: &Case, found: &Optimization) -> serde_json::Value {
    let (best, scale) = (&found.best, Scale::of(case));
    let over = over(&found.task);
    let worst = best.worst.as_ref().filter(|_| found.task.objective == Objective::WorstAmplitude);
    let given = case.inputs().iter().filter(|input| input.table == "uncertainty");
    let uncertain = given.filter(|input| input.value > 0.0).map(|input| {
        json!({
            "name": input.name, "as_written": input.as_written, "largest": input.largest_error(),
        })
    });
    json!({ "at": {
        "page": document(case, found),
        "over": case.band.as_ref().map(|band| band.over.name()),
        "uncertain": uncertain.collect::<Vec<_>>(),
        "worst": worst.map(|worst| json!({
            "at": scale.place(over, worst.at),
            "of": match worst.motion.rest() {
                Some(rest) => json!({ "is": "inactive", "share": rest.share }),
                None if worst.motion.is_one_to_one() => json!({ "is": "orbit" }),
                None => json!({
                    "is": "other",
                    "repeats": worst.motion.repeats_after().is_some(),
                    "impacts_per_period": worst.motion.facts().impacts_per_period.value,
                }),
            },
        })),
        "strips": found.strips.filter(|[a1, a2]| a1 + a2 > STRIPS),
        "places": places(over, found),
        "expectation": found.robust.is_some().then(|| [found.task.nodes(), found.task.deviations().len()]),
        "chart_at": figure::nearest(found).map(|one| scale.frequency(one.frequency_ratio, Method::Given)),
        "version": env!("CARGO_PKG_VERSION"),
    } })
}

/// What varies along the band.
fn over(task: &Task) -> BandOver {
    task.case.band.as_ref().map_or(BandOver::Frequency, |band| band.over)
}

/// The bounds on which the best lies, but for those that no restitution can pass.
fn on_bounds(found: &Optimization) -> Vec<serde_json::Value> {
    let ends = found.task.bounds.iter().filter_map(|bounds| {
        let Bounds { parameter, from, to } = *bounds;
        let value = bounds.value(&found.best.choice);
        let passable =
            |end: &f64| parameter != Parameter::Restitution || (*end > 0.0 && *end < 1.0);
        let near = |end: &f64| (value - end).abs() <= ON_BOUND * end;
        let end = [from, to].into_iter().filter(passable).find(near)?;
        Some(json!({ "variable": name(parameter), "value": end }))
    });
    ends.collect()
}

/// What the survey finds with the best absorber at some of its places.
fn places(over: BandOver, found: &Optimization) -> Vec<serde_json::Value> {
    let JudgedDesign { survey, written, worst, .. } = &found.best;
    let motions = &survey.motions;
    let places = if motions.simulated() { motions.places() } else { &[] };
    let scale = Scale::of(&written.case);
    let every = places.len().div_ceil(SHOWN).max(1);
    let amplitude = found.task.objective == Objective::WorstAmplitude;
    let shown = places.iter().enumerate().filter(|(k, (at, _))| {
        k.is_multiple_of(every) || worst.as_ref().is_some_and(|worst| worst.at == *at)
    });
    let rows = shown.map(|(_, (at, here))| {
        let peak = |motion: &Motion| {
            let Value { value, error } = motion.facts().peak;
            let error = if amplitude { error } else { 0.0 };
            scale.units.quantity_with(&catalogue::PEAK, [value, error], method(motion))
        };
        let largest = |is_one: &dyn Fn(&Motion) -> bool| {
            let alike = here.iter().filter(|motion| is_one(motion));
            alike.max_by(|a, b| a.facts().peak.value.total_cmp(&b.facts().peak.value))
        };
        let moving = |motion: &Motion| motion.rest().is_none();
        json!({
            "at": scale.place(over, *at),
            "orbit": largest(&Motion::is_one_to_one).map(peak),
            "motions": here.iter().filter(|one| moving(one)).count(),
            "largest": largest(&moving).map(peak),
            "inactive": here.rest().map(peak),
            "inactive_share": here.rest().and_then(Motion::rest).map(|rest| rest.share),
        })
    });
    rows.collect()
}
