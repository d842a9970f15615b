//! The report of a structure of several modes with several absorbers, as data and files. The sentences are in
//! `templates/loads*.tera`.

mod alternatives;
mod analysis;
mod criteria;
mod figure;
mod listing;
mod live;
mod motions;
mod optimum;
mod ranges;
mod theory;

use serde_json::{Value, json};

use super::choice;
use super::document::claims::claim;
use super::document::criteria::badge;
use super::document::motions::pair;
use super::document::place::FilePlace;
use super::document::{Content, Tone, Word, headed, keep_case};
use super::error::RenderError;
use super::render::{self, Files, with_document};
use super::template::{render, worded};
use crate::case::{ActsOn, Load, ModalCase, Of, StructuralMode};
use crate::criteria::Worst;
use crate::executor::Serial;
use crate::method::Method;
use crate::modal::{Beside, DamperChoice, ForceStep, LoadClaim, ModalAnswer, OverForce, Stretches};
use crate::orbits::ReachEnd;
use crate::quantity::catalogue as of;
use crate::quantity::{Dimension, Kind, Quantity, Units};
use crate::system::Scales;
use crate::validation::Verdict;

pub use analysis::{analysis, analysis_text};
pub use criteria::checked;
pub use listing::{listing, listing_text};
pub use live::{at_frequency, over_frequency};
pub use optimum::{optimum, optimum_files, optimum_text};

use criteria::{compared, criteria, holds};

/// Units of the pages of a case: lengths in that of the smallest clearance.
pub fn units(case: &ModalCase) -> Units {
    let units = Units::from(Scales {
        physical: !case.reduced,
        clearance: case.least_clearance_m(),
        natural_frequency: case.omega(),
        oscillator_mass: case.modes[0].mass_kg,
    });
    case.page_units.of_pages(units, &case.criteria)
}

/// The unit of frequencies in a document: "1" where they are over that of the first mode.
fn frequency_unit(case: &ModalCase) -> &'static str {
    Dimension::Frequency.symbol(!case.reduced)
}

/// A mass in kg, or over the first mode's of a reduced case.
fn mass(case: &ModalCase, kind: &'static Kind, value: f64) -> Quantity {
    given(kind, value / case.mass_unit())
}

fn given(kind: &'static Kind, value: f64) -> Quantity {
    Quantity::new(kind, value, Method::Given)
}

fn simulated(kind: &'static Kind, value: f64) -> Quantity {
    Quantity::new(kind, value, Method::Simulation)
}

fn closed(kind: &'static Kind, value: f64) -> Quantity {
    Quantity::new(kind, value, Method::ClosedForm)
}

/// The word of what all criteria come to; of a case without them that of the structure against itself alone.
fn word(case: &ModalCase, answer: &ModalAnswer) -> Word {
    badge(&answer.judged).unwrap_or_else(|| against_alone(case, answer))
}

/// Whether that is good news: limits that hold where the structure moves farther than without absorbers are not.
fn tone(case: &ModalCase, answer: &ModalAnswer) -> Tone {
    match word(case, answer).tone() {
        Tone::Good if against_alone(case, answer) == Word::MakesItWorse => Tone::Mixed,
        tone => tone,
    }
}

/// Whether it moves less than without absorbers.
fn against_alone(case: &ModalCase, answer: &ModalAnswer) -> Word {
    match answer.worst(case, None).map(|worst| worst.found) {
        Some(worst) if worst.most() < answer.bare() => Word::Works,
        Some(worst) if worst.value > answer.bare() => Word::MakesItWorse,
        Some(_) => Word::DoesNothing,
        None => Word::NoAnswer,
    }
}

/// The same as a list has it.
fn headline(case: &ModalCase, answer: &ModalAnswer) -> Option<&'static str> {
    match against_alone(case, answer) {
        Word::Works => Some("less"),
        Word::MakesItWorse => Some("worse"),
        Word::DoesNothing => Some("little"),
        _ => None,
    }
}

/// What a load does with other amplitudes.
fn forces_row(case: &ModalCase, load: &Load, of_load: &OverForce) -> Value {
    let amplitude = |times: f64| simulated(load.amplitude_kind(), times * load.amplitude);
    let limits = of_load.limits(case).map(|limits| {
        json!({
            "holds": limits.holds.into_iter().map(|ends| ends.map(amplitude)).collect::<Vec<_>>(),
            "open": limits.open.into_iter().map(amplitude).collect::<Vec<_>>(),
            "fails": limits.fails.into_iter().map(amplitude).collect::<Vec<_>>(),
        })
    });
    let working = of_load
        .working
        .iter()
        .map(|range| range.map(|range| range.map(|at| closed(&of::PEAK, at))));
    // The largest displacement of each motion.
    let peaks = |one: &ForceStep| {
        one.motions.iter().map(|one| pair(motions::peak(one))).collect::<Vec<_>>()
    };
    let step = |one: &ForceStep| json!({ "amplitude": amplitude(one.times), "peaks": peaks(one) });
    json!({
        "at": of_load.at.iter().map(|at| given(&of::EXCITATION_FREQUENCY, *at)).collect::<Vec<_>>(),
        "limits": limits,
        "working": working.collect::<Vec<_>>(),
        "exact": of_load.exact.as_ref().map(|(at, found)| {
            let at = given(&of::EXCITATION_FREQUENCY, *at);
            json!({ "at": at, "stretches": stretch_rows(load.amplitude_kind(), found) })
        }),
        "steps": of_load.steps.iter().map(step).collect::<Vec<_>>(),
    })
}

/// Stretches on which an exact orbit attracts: their ends with what ends them, and whether that is where looking ended.
fn stretch_rows(kind: &'static Kind, of: &Stretches) -> Vec<Value> {
    let end = |end: &ReachEnd| {
        let edge = of.range.contains(&end.value);
        let at =
            Quantity::new(kind, end.value, if edge { Method::Given } else { Method::ExactOrbit });
        json!({ "at": at, "kind": end.kind, "edge": edge })
    };
    of.found.iter().map(|[from, to]| json!({ "from": end(from), "to": end(to) })).collect()
}

/// A load with its range in words.
///
/// # Errors
/// [`RenderError::Template`] if the template does not fit.
pub fn load_words(case: &ModalCase, load: &Load) -> Result<String, RenderError> {
    let text = render("load.txt", &units(case), &json!({ "of": load_row(case, load) }))?;
    Ok(text.trim_end().to_owned())
}

fn load_row(case: &ModalCase, load: &Load) -> Value {
    let kind = load.amplitude_kind();
    let (place, mode) = match load.on {
        ActsOn::Place(place) => (Some(&case.places[place]), None),
        ActsOn::Mode(mode) => (None, Some(mode + 1)),
        ActsOn::Base | ActsOn::Modes => (None, None),
    };
    let [from, to] = load.range_hz.map(|at| given(&of::EXCITATION_FREQUENCY, at));
    json!({ "amplitude": given(kind, load.amplitude), "place": place, "mode": mode, "from": from, "to": to })
}

fn worst_row(case: &ModalCase, worst: &Worst) -> Value {
    let (all_settled, worst) = (worst.all_settled(), &worst.found);
    let known = |value: f64| Quantity::new(&of::PEAK, value, worst.known_by);
    let place = if let Of::Place(place) = worst.of { Some(&case.places[place]) } else { None };
    json!({
        "load": worst.load + 1,
        "place": place,
        "at": worst.at.map(|at| given(&of::EXCITATION_FREQUENCY, at)),
        "peak": known(worst.value).with_error(worst.error),
        "most": known(worst.most()),
        "settled": all_settled,
        "rests": worst.rests(),
        // Which absorbers do, from 1, and in which share of their places.
        "resting": numbers(&worst.resting),
        "absorbers": case.absorbers.len(),
        "share": worst.rest,
    })
}

/// The numbers of absorbers that rest, from 1.
fn numbers(resting: &[bool]) -> Vec<u32> {
    resting.iter().zip(1..).filter(|(rests, _)| **rests).map(|(_, j)| j).collect()
}

/// What is known along each load.
fn along(case: &ModalCase, answer: &ModalAnswer, beside: &Beside) -> Vec<Value> {
    let rows = answer.along.iter().enumerate().map(|(k, along)| {
        let largest = along.bare.iter().max_by(|a, b| a[0].total_cmp(&b[0]));
        let worst = answer.worst(case, Some(k));
        let here = worst.and_then(|worst| along.at(worst.found.at?));
        json!({
            "load": k + 1,
            "excitation": load_row(case, &along.load),
            "bare": largest.map(|[most, at]| json!({
                "peak": closed(&of::BARE_PEAK, *most), "at": given(&of::EXCITATION_FREQUENCY, *at),
            })),
            "worst": worst.map(|worst| worst_row(case, &worst)),
            // The motions there.
            "at_worst": here.map(|one| motions::rows(case, &one.motions)).unwrap_or_default(),
            // Those at other frequencies where criteria are worst.
            "decides": criteria::elsewhere(case, answer, k, worst.and_then(|worst| worst.found.at)),
            "alone": beside.alone.get(k).and_then(|one| one.as_ref()).map(|[value, error]| {
                simulated(&of::PEAK, *value).with_error(*error)
            }),
            "dampers": beside.dampers.iter().map(|one| closed(&of::DAMPER_PEAK, one.worst[k])).collect::<Vec<_>>(),
            "forces": beside.forces.get(k).and_then(|one| one.as_ref()).map(|one| forces_row(case, &along.load, one)),
            "theory": beside.theory.iter().filter(|one| one.load == k).map(|one| theory::row(case, one)).collect::<Vec<_>>(),
            "motions": along.is_point().then(|| motions::rows(case, &along.places[0].motions)),
            "places": (!along.is_point()).then(|| motions::over_frequencies(case, along)),
        })
    });
    rows.collect()
}

fn absorbers(case: &ModalCase) -> Vec<Value> {
    let each = case.absorbers.iter().enumerate().map(|(j, one)| {
        let ratio = |mode: &StructuralMode| {
            one.mass_kg * mode.shape[one.place] * mode.shape[one.place] / mode.mass_kg
        };
        json!({
            "number": j + 1,
            "place": case.places[one.place],
            "mass": mass(case, &of::ABSORBER_MASS, one.mass_kg),
            "clearance": given(&of::CLEARANCE, one.clearance_m),
            "restitution": given(&of::RESTITUTION, one.restitution),
            "contact_time": one.contact_time_s.map(|time| given(&of::CONTACT_TIME, time)),
            // Over the mass that its impacts see.
            "mass_ratio": closed(&of::MASS_RATIO, case.modes.iter().map(ratio).sum()),
        })
    });
    each.collect()
}

/// A claim, with the load, where there are several, and the frequency that it is about.
fn claim_row(case: &ModalCase, of_load: &LoadClaim) -> Value {
    let LoadClaim { load, at, claim: of_one } = of_load;
    let mut row = claim(&units(case), of_one);
    row["load"] = json!((case.loads.len() > 1).then_some(load + 1));
    row["at"] = json!(given(&of::EXCITATION_FREQUENCY, *at));
    row
}

/// Starts at each frequency: of the ranges, or where there are none of the loads of one frequency.
fn starts(case: &ModalCase) -> u32 {
    case.loads.iter().map(|load| case.starts_of(load)).min().unwrap_or_default()
}

/// The report: [`FORMAT`](super::document::FORMAT) with the fields that an index and a comparison read, and those of several modes.
pub fn document(
    name: &str,
    case: &ModalCase,
    answer: &ModalAnswer,
    beside: &Beside,
    content: Content,
) -> Value {
    let word = word(case, answer);
    let worst = answer.worst(case, None);
    let (bare, peak) = (answer.bare(), worst.map_or(f64::NAN, |one| one.found.value));
    let error = worst.map_or(0.0, |one| one.found.error);
    // Of the better choice.
    let largest = |one: &DamperChoice| one.worst.iter().copied().fold(0.0, f64::max);
    let damper = beside.dampers.iter().map(largest).min_by(f64::total_cmp);
    let level = |peak: f64| 20.0 * libm::log10(peak / bare);
    let mut quantities = vec![
        given(&of::CLEARANCE, case.least_clearance_m()),
        closed(&of::BARE_PEAK, bare),
        simulated(&of::PEAK, peak).with_error(error),
        simulated(&of::CHANGE_DB, level(peak)).with_error(level(peak + error) - level(peak)),
    ];
    quantities.extend(damper.map(|one| closed(&of::DAMPER_PEAK, one)));
    let quantities: serde_json::Map<String, Value> =
        quantities.into_iter().map(|one| (one.kind.id.to_owned(), json!(one))).collect();
    let modes = case.modes.iter().map(|mode| {
        json!({
            "frequency": given(&of::NATURAL_FREQUENCY, mode.frequency_hz),
            "damping_ratio": given(&of::DAMPING_RATIO, mode.damping_ratio),
            "mass": mass(case, &of::OSCILLATOR_MASS, mode.mass_kg),
            "participation": mode.participation,
            "shape": mode.shape,
        })
    });
    let dampers = beside.dampers.iter().map(|one| {
        let mut each = alternatives::each(case, &one.dampers, false, false);
        for (row, stroke) in each.iter_mut().zip(&one.strokes) {
            row["stroke"] = json!(closed(&of::DAMPER_STROKE, *stroke));
        }
        json!({
            "count": each.len(),
            "worst": closed(&of::DAMPER_PEAK, one.worst.iter().copied().fold(0.0, f64::max)),
            "stroke": closed(&of::DAMPER_STROKE, one.strokes.iter().copied().fold(0.0, f64::max)),
            "holds": holds(case, &one.criteria),
            // Whether there is no limit that a damper does not have.
            "holds_all": one.criteria.iter().all(Option::is_some),
            "each": each,
        })
    });
    let notes = warnings(case).into_iter().map(|one| {
        let mut note = json!(one);
        note["kind"] = json!("warning");
        note
    });
    let claims = &beside.claims;
    let confirmed = claims.iter().filter(|one| one.claim.verdict == Verdict::Confirmed);
    let fields = json!({
        "name": name,
        "verdict": {
            "tone": tone(case, answer),
            "word": word,
            "headline": headline(case, answer),
            // Claims that were confirmed.
            "confirmed": confirmed.count(),
        },
        "quantities": quantities,
        "criteria": criteria(case, answer),
        "compared": compared(case, answer, beside),
        "notes": notes.collect::<Vec<_>>(),
        "band": null,
        "places_of_shapes": case.places,
        "modes": modes.collect::<Vec<_>>(),
        "modes_from": case.modes_from,
        "absorbers": absorbers(case),
        "worst": worst.map(|one| worst_row(case, &one)),
        "loads": along(case, answer, beside),
        "dampers": dampers.collect::<Vec<_>>(),
        "simulated": true,
        "claims": claims.iter().map(|one| claim_row(case, one)).collect::<Vec<_>>(),
        "starts": starts(case),
        "over_frequencies": case.loads.iter().any(|load| load.range_hz[0] < load.range_hz[1]),
        "figures": [],
    });
    let heading = [&case.title, &case.source, &case.text_hash].map(String::as_str);
    let mut document = headed(heading, units(case).name(), content, fields);
    if answer.alternatives.is_some() {
        (document["alternatives"], document["choice"]) = alternatives::rows(case, answer);
    }
    let (rows, told) = ranges::rows(case, answer);
    if !rows.is_empty() {
        (document["holds_for"], document["ranges"]) = (json!(rows), json!(told));
        document["combined"] = json!(ranges::combined(case, answer));
    }
    if answer.reliability.is_some() {
        document["reliability"] = ranges::probability(case, answer);
    }
    if content == Content::Report {
        keep_case(&mut document, case.written(), case.files());
    }
    document
}

/// The files of its report.
///
/// # Errors
/// [`RenderError`] says which part cannot be rendered.
pub fn files(
    name: &str,
    case: &ModalCase,
    answer: &ModalAnswer,
    beside: &Beside,
) -> Result<Files, RenderError> {
    let mut document = document(name, case, answer, beside, Content::Report);
    let mut drawn = figure::loads(case, answer, beside, &document);
    drawn.extend([
        figure::forces(case, answer, beside, &document),
        figure::over_time(case, beside, &document),
        figure::manifolds(case, beside, &document),
    ]);
    let compared = answer.alternatives.as_ref();
    drawn.extend(compared.and_then(|found| choice::figure(units(case), found, &document)));
    drawn.extend(ranges::figure(case, answer, &document));
    drawn.retain(|figure| !figure.panels.is_empty());
    let figures = worded(drawn, &units(case))?;
    document["figures"] = figures.iter().map(super::document::figure_row).collect();
    let files = render::files("loads.md", &document, None, &units(case), &figures, &Serial)?;
    Ok(with_document(files, &told_of_one(case, document)))
}

/// What a document says of the loads of a case, of which there is no list, at its top as that of one mode does: the motions of its
/// excitation, those along its range, and the exact orbits near each mode in that.
fn told_of_one(case: &ModalCase, mut document: Value) -> Value {
    if case.lists_loads {
        return document;
    }
    for key in ["motions", "places", "orbits"] {
        let rows = document["loads"].as_array_mut().into_iter().flatten();
        let each = rows.filter_map(|row| row.as_object_mut()?.remove(key)).collect::<Vec<_>>();
        let told = each.iter().filter_map(Value::as_array).flatten().cloned().collect::<Vec<_>>();
        if each.iter().any(Value::is_array) {
            document[key] = json!(told);
        } else if !each.is_empty() {
            document[key] = Value::Null;
        }
    }
    document
}

/// What simulation says of it, with nothing beside: [`FORMAT`](super::document::FORMAT).
pub fn simulation(name: &str, case: &ModalCase, answer: &ModalAnswer) -> Value {
    told_of_one(case, document(name, case, answer, &Beside::default(), Content::Simulation))
}

/// The same on a terminal.
///
/// # Errors
/// [`RenderError::Template`] if the template does not fit.
pub fn text(name: &str, case: &ModalCase, answer: &ModalAnswer) -> Result<String, RenderError> {
    let facts = document(name, case, answer, &Beside::default(), Content::Simulation);
    render("loads.txt", &units(case), &facts)
}

/// What is almost surely a slip in its file.
fn warnings(case: &ModalCase) -> Vec<FilePlace> {
    case.warnings.iter().map(FilePlace::from).collect()
}
