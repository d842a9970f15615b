//! What theory says of the mode that a load drives, as data.

use serde_json::{Value, json};

use super::{closed, given};
use crate::case::ModalCase;
use crate::method::Method;
use crate::modal::{GroupTheory, LoadTheory};
use crate::quantity::catalogue as of;
use crate::quantity::{Kind, Quantity};

fn by_theory(kind: &'static Kind, value: f64) -> Quantity {
    Quantity::new(kind, value, Method::Theory)
}

/// A row: modes and absorbers by their numbers, from 1.
pub(super) fn row(case: &ModalCase, found: &LoadTheory) -> Value {
    let kind = case.loads[found.load].amplitude_kind();
    let group = |one: &GroupTheory| {
        let point = |(amplitude, stable): &(f64, bool)| {
            let amplitude =
                by_theory(&of::OSCILLATOR_AMPLITUDE, *amplitude).with_error(one.error * amplitude);
            json!({ "amplitude": amplitude, "stable": stable })
        };
        json!({
            "mass_ratio": closed(&of::MASS_RATIO, one.mass_ratio),
            "range": one.range.map(|range| range.map(|end| by_theory(&of::OSCILLATOR_AMPLITUDE, end))),
            "points": one.points.iter().map(point).collect::<Vec<_>>(),
            // Amplitudes of the load at which two of them collide.
            "collisions": one.collisions.iter().map(|at| by_theory(kind, *at)).collect::<Vec<_>>(),
        })
    };
    let scattered =
        found.scattered.iter().map(|(mode, times)| json!({ "mode": mode + 1, "times": times }));
    let restitutions = found.restitutions.iter().map(|one| by_theory(&of::RESTITUTION, *one));
    json!({
        "at": given(&of::EXCITATION_FREQUENCY, found.at),
        "mode": found.mode + 1,
        // Where it moves farthest: amplitudes are of this place.
        "place": case.places[found.place],
        "restitutions": restitutions.collect::<Vec<_>>(),
        "scattered": scattered.collect::<Vec<_>>(),
        "group": found.group.as_ref().map(group),
        "exact": found.exact.iter().map(|one| json!({
            "amplitude": Quantity::new(&of::OSCILLATOR_AMPLITUDE, one.amplitude, Method::ExactOrbit),
            "stable": one.attracts,
        })).collect::<Vec<_>>(),
    })
}
