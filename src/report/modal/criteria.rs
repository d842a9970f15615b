//! Criteria by place and absorber, as data: for pages, for `check`, and beside what the structure alone and dampers come to.

use serde_json::{Value, json};

use super::{
    Beside, absorbers, along, alternatives, closed, given, motions, numbers, ranges, told_of_one,
    units, warnings,
};
use crate::case::{ModalCase, Of};
use crate::criteria::Judged;
use crate::measure::{Device, Part};
use crate::modal::{ModalAnswer, linear_most};
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;
use crate::report::criteria::{Checked, row as criteria_row};
use crate::report::document::criteria::{WorstPlaces, counted, row};

/// Where a criterion is worst.
fn frequency(judged: &Judged) -> Option<Quantity> {
    judged.at.map(|at| given(&of::EXCITATION_FREQUENCY, at))
}

/// A row about a criterion with the place or the absorber that it is about, that which is worst, and under which load.
fn placed(case: &ModalCase, one: &Judged, mut row: Value) -> Value {
    let (key, worst) = match one.criterion.measure.part() {
        Part::Place => ("place", "worst_place"),
        Part::Absorber => ("absorber", "worst_absorber"),
        Part::Whole => ("place", ""),
    };
    // An absorber by its number, from 1.
    let named = |of: Of| match of {
        Of::Any => Value::Null,
        Of::Place(place) => json!(case.places[place]),
        Of::Absorber(j) => json!(j + 1),
    };
    let parts = match one.criterion.measure.part() {
        Part::Place => case.places.len(),
        Part::Absorber => case.absorbers.len(),
        Part::Whole => 0,
    };
    row[key] = named(one.criterion.of);
    if parts > 1 {
        row[worst] = named(one.of);
    }
    row["load"] = json!(one.load + 1);
    if one.inactive.is_some() {
        (row["resting"], row["absorbers"]) =
            (json!(numbers(&one.resting)), json!(case.absorbers.len()));
    }
    row
}

/// The criteria in the form of those of one mode.
pub(super) fn criteria(case: &ModalCase, answer: &ModalAnswer) -> Value {
    let judged = &answer.judged;
    let rows = judged.iter().map(|one| placed(case, one, row(one, frequency(one))));
    let mut counted = counted(judged, rows.collect());
    let times = || case.absorbers.iter().filter_map(|one| one.contact_time_s);
    let least = times().min_by(f64::total_cmp);
    let longest = times().max_by(f64::total_cmp).filter(|longest| Some(*longest) != least);
    if let Some(counted) = &mut counted {
        let time = |one: f64| given(&of::CONTACT_TIME, one);
        counted["count_inactive"] = json!(case.count_inactive);
        counted["contact_time"] = json!(least.map(time));
        counted["longest_contact_time"] = json!(longest.map(time));
    }
    json!(counted)
}

/// The motions at frequencies of a load where criteria are worst that are worst elsewhere than the displacement, each with what it has
/// of these.
pub(super) fn elsewhere(
    case: &ModalCase,
    answer: &ModalAnswer,
    load: usize,
    worst: Option<f64>,
) -> Vec<Value> {
    let along = &answer.along[load];
    WorstPlaces {
        judged: answer.judged.iter().filter(|one| one.load == load).collect(),
        told: worst,
        each: &|asked| answer.each(case, asked),
        motions: &|at| Some(motions::rows(case, &along.at(at)?.motions)),
        at: &|at| given(&of::EXCITATION_FREQUENCY, at),
        row: &|one| placed(case, one, row(one, frequency(one))),
    }
    .rows()
}

/// Whether values meet all criteria that have one; none where none has.
pub(super) fn holds(case: &ModalCase, values: &[Option<f64>]) -> Option<bool> {
    let all = case.criteria.iter().zip(values);
    let mut parts = all.filter_map(|(one, value)| Some(one.part((*value)?))).peekable();
    parts.peek().is_some().then(|| parts.all(|part| part <= 1.0))
}

/// Each criterion with what the structure without absorbers and with each choice of dampers comes to.
pub(super) fn compared(case: &ModalCase, answer: &ModalAnswer, beside: &Beside) -> Vec<Value> {
    let each = answer.judged.iter().zip(&case.criteria).enumerate();
    let each = each.filter(|(_, (_, asked))| linear_most(case, asked, &[]).is_some());
    let rows = each.map(|(n, (judged, asked))| {
        let told = |device: Device, value: Option<f64>| {
            let kind = asked.measure.kind(device);
            let quantity = value.zip(kind).map(|(value, kind)| closed(kind, value));
            json!({ "value": quantity, "misses": value.is_some_and(|value| asked.part(value) > 1.0) })
        };
        let dampers = beside.dampers.iter().map(|one| told(Device::Damper, one.criteria[n]));
        let mut row = placed(case, judged, row(judged, frequency(judged)));
        row["without"] = told(Device::Without, linear_most(case, asked, &[]));
        row["dampers"] = dampers.collect();
        row
    });
    rows.collect()
}

/// What `check` says of it; `path` is that of its file.
pub fn checked(path: &str, name: &str, case: &ModalCase, answer: &ModalAnswer) -> Checked {
    let units = units(case);
    let told = |one: &Judged| placed(case, one, criteria_row(&units, one, frequency(one)));
    let mut document = json!({
        "case": name,
        "title": case.title,
        "holds": answer.all_hold(),
        "criteria": answer.judged.iter().map(told).collect::<Vec<_>>(),
        "loads": along(case, answer, &Beside::default()),
        "modes_from": case.modes_from,
    });
    if !case.warnings.is_empty() {
        document["warnings"] = json!(warnings(case));
    }
    let (devices, choice) = alternatives::rows(case, answer);
    if answer.alternatives.is_some() {
        document["alternatives"] = devices.clone();
    }
    let (rows, ranges) = ranges::rows(case, answer);
    if !rows.is_empty() {
        document["holds_for"] = json!(rows);
    }
    let reliability = ranges::probability(case, answer);
    if !reliability.is_null() {
        document["reliability"] = reliability.clone();
    }
    let page = json!({
        "path": path, "case": name, "warnings": warnings(case), "criteria": criteria(case, answer), "outside": null, "choice": choice,
        "alternatives": devices, "absorbers": absorbers(case), "ranges": ranges, "combined": ranges::combined(case, answer), "reliability": reliability,
        "modes_from": case.modes_from,
    });
    Checked::of(told_of_one(case, document), page, units)
}
