//! A structure that is released or struck.

mod figure;

use std::f64::consts::TAU;

use serde_json::{Value, json};

use super::{sample, word_of, worst_rows};
use crate::case::Case;
use crate::measure::Measure;
use crate::method::Method;
use crate::quantity::catalogue as of;
use crate::quantity::{Kind, Quantity};
use crate::report::document::{Scale, Word};
use crate::transient::{Decay, DecayStudy};

pub(super) use figure::figures;

/// What its page has beside what all have.
pub(super) fn add(case: &Case, study: &DecayStudy, document: &mut Value) {
    let scale = Scale::of(case);
    document["notes"].as_array_mut().into_iter().for_each(|all| all.extend(notes(study)));
    // One for each place of the absorber.
    let row = |(w, start): &(f64, Decay)| row(&scale, *w, start);
    document["starts"] = study.starts.by_place().into_iter().map(row).collect();
    document["worst"] = worst_rows(case, &study.starts, Measure::DecayTime, row);
    document["sample"] = sample(study.starts.sample());
    // The lowest and the highest place of an absorber that no wall reaches.
    let place = |w| scale.units.quantity(&of::RELATIVE_DISPLACEMENT, w, Method::ClosedForm);
    document["inactive"] = json!(study.inactive.places.map(|ends| ends.map(place)));
    // Share of the first amplitude that counts as rest.
    document["share"] = case.decay_level.into();
}

fn row(scale: &Scale, place: f64, decay: &Decay) -> Value {
    json!({
        "absorber": scale.units.quantity(&of::RELATIVE_DISPLACEMENT, place, Method::Given),
        "time": time(scale, &of::DECAY_TIME, decay.oscillations, Method::Simulation),
        "impacts": Quantity::new(&of::IMPACT_COUNT, decay.impacts as f64, Method::Simulation),
        "impact_speed": scale.units.quantity(&of::IMPACT_SPEED, decay.impact_speed, Method::Simulation),
        "impact_share": Quantity::new(&of::IMPACT_ENERGY_SHARE, decay.impact_share, Method::Simulation),
    })
}

/// A time in oscillations of the structure.
fn time(scale: &Scale, kind: &'static Kind, oscillations: f64, method: Method) -> Quantity {
    scale.units.quantity(kind, TAU * oscillations, method)
}

/// What has no place in the list of measures.
pub(super) fn quantities(case: &Case, study: &DecayStudy) -> Vec<Quantity> {
    let scale = Scale::of(case);
    let mut all = vec![
        scale.units.quantity(&of::INITIAL_AMPLITUDE, study.from, Method::Given),
        scale.units.quantity(&of::DECAY_LEVEL, study.level, Method::Given),
        scale.units.quantity(&of::RESIDUAL_AMPLITUDE, study.predicted.residual, Method::ClosedForm),
    ];
    let [slowest, fastest] = [&of::ACTIVE_DECAY_TIME, &of::FASTEST_DECAY_TIME];
    if study.inactive.share > 0.0 {
        all.push(Quantity::new(&of::INACTIVE_SHARE, study.inactive.share, Method::ClosedForm));
    }
    if let Some(found) = study.starts.largest(Measure::DecayTime) {
        let found = found.map(|oscillations| TAU * oscillations);
        all.push(scale.units.quantity_with(slowest, found, Method::Simulation));
    }
    if let Some(found) = study.starts.least(Measure::DecayTime) {
        all.push(time(&scale, fastest, found, Method::Simulation));
    }
    all
}

pub(super) fn word(study: &DecayStudy) -> Word {
    let fastest = study.starts.least(Measure::DecayTime).unwrap_or(f64::INFINITY);
    word_of(study.decay().oscillations[0] / study.bare, fastest / study.bare)
}

fn notes(study: &DecayStudy) -> Vec<Value> {
    let mut notes = Vec::new();
    if study.system.restitution() == 1.0 {
        notes.push(json!({ "kind": "elastic" }));
    }
    if study.level < study.predicted.residual && study.system.cavity().is_ideal() {
        notes.push(json!({ "kind": "below-capture" }));
    }
    notes
}
