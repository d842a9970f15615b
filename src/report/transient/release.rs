//! A structure that is released or struck.

mod figure;

use std::f64::consts::TAU;

use serde_json::{Value, json};

use super::{sample, word_of, worst_rows};
use crate::case::Case;
use crate::method::Method;
use crate::quantity::catalogue as of;
use crate::quantity::{Kind, Quantity};
use crate::report::document::{Scale, Word};
use crate::transient::{Decay, DecayStudy, Measured};

pub(super) use figure::figures;

/// What its page has beside what all have.
pub(super) fn add(case: &Case, study: &DecayStudy, document: &mut Value) {
    let scale = Scale::of(case);
    document["notes"].as_array_mut().into_iter().for_each(|all| all.extend(notes(study)));
    // One for each place of the absorber.
    let mut starts: Vec<&Decay> = study.starts.iter().collect();
    starts.sort_by(|a, b| a.place.total_cmp(&b.place));
    document["starts"] = starts.iter().map(|start| row(&scale, start)).collect();
    document["worst"] =
        worst_rows(&study.starts, |start| start.oscillations, |start| row(&scale, start));
    document["sample"] = sample(study.even, study.starts.len());
    // The lowest and the highest place of an absorber that no wall reaches.
    let place = |w| scale.units.quantity(&of::RELATIVE_DISPLACEMENT, w, Method::ClosedForm);
    document["inactive"] = json!(study.inactive.places.map(|ends| ends.map(place)));
    // Share of the first amplitude that counts as rest.
    document["share"] = case.decay_level.into();
}

fn row(scale: &Scale, decay: &Decay) -> Value {
    json!({
        "absorber": scale.units.quantity(&of::RELATIVE_DISPLACEMENT, decay.place, Method::Given),
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

fn time_with(scale: &Scale, kind: &'static Kind, time: Measured, method: Method) -> Quantity {
    scale.units.quantity_with(kind, time.map(|oscillations| TAU * oscillations), method)
}

pub(super) fn quantities(case: &Case, study: &DecayStudy) -> Vec<Quantity> {
    let scale = Scale::of(case);
    let theory = &study.predicted;
    let (_, damped) = &study.damped;
    let simulated = Method::Simulation;
    let mut all = vec![
        scale.units.quantity(&of::INITIAL_AMPLITUDE, study.from, Method::Given),
        scale.units.quantity(&of::DECAY_LEVEL, study.level, Method::Given),
        time(&scale, &of::BARE_DECAY_TIME, study.bare, Method::ClosedForm),
        time(&scale, &of::DAMPER_DECAY_TIME, damped.settles, Method::ClosedForm),
        scale.units.quantity(&of::DAMPER_STROKE, damped.stroke, Method::ClosedForm),
        scale.units.quantity(&of::RESIDUAL_AMPLITUDE, theory.residual, Method::ClosedForm),
    ];
    if let Some(oscillations) = theory.oscillations {
        // Of first order in the mass ratio, and more below the end of capture: nobody knows how much.
        let predicted = time(&scale, &of::THEORY_DECAY_TIME, oscillations, theory.method);
        all.push(predicted.with_error(f64::NAN));
    }
    if study.inactive.share > 0.0 {
        all.push(Quantity::new(&of::INACTIVE_SHARE, study.inactive.share, Method::ClosedForm));
    }
    if let Some(worst) = study.worst() {
        let decay = study.decay();
        let decided = if decay.inactive { Method::ClosedForm } else { simulated };
        let slowest = study.largest(|start| start.oscillations);
        let (peak, speed) =
            (study.largest(|start| start.peak), study.largest(|start| start.impact_speed));
        all.extend([
            scale.units.quantity_with(&of::PEAK, peak, simulated),
            time_with(&scale, &of::DECAY_TIME, decay.oscillations, decided),
            time_with(&scale, &of::ACTIVE_DECAY_TIME, slowest, simulated),
            time(&scale, &of::FASTEST_DECAY_TIME, study.fastest(), simulated),
            scale.units.quantity_with(&of::IMPACT_SPEED, speed, simulated),
            Quantity::new(&of::IMPACT_COUNT, worst.impacts as f64, simulated),
            Quantity::new(&of::IMPACT_ENERGY_SHARE, worst.impact_share, simulated),
        ]);
    }
    all
}

pub(super) fn word(study: &DecayStudy) -> Word {
    word_of(study.decay().oscillations[0] / study.bare, study.fastest() / study.bare)
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
