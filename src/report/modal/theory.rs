//! What theory says of the mode that a load drives, as data.

use serde_json::{Value, json};

use super::{closed, given};
use crate::case::ModalCase;
use crate::cavity::ManifoldPoint;
use crate::method::Method;
use crate::modal::{AbsorberManifold, GroupTheory, LoadTheory};
use crate::quantity::catalogue as of;
use crate::quantity::{Kind, Quantity};

fn by_theory(kind: &'static Kind, value: f64) -> Quantity {
    Quantity::new(kind, value, Method::Theory)
}

/// The ends of the stable branch of an absorber's manifold: its own amplitude, and the structure's where it moves farthest.
fn manifold(of_one: &AbsorberManifold) -> Value {
    let end = |at: &ManifoldPoint| {
        let [absorber, structure] = of_one.at([at.absorber_amplitude, at.oscillator_amplitude]);
        json!({
            "absorber_amplitude": by_theory(&of::ABSORBER_AMPLITUDE, absorber),
            "oscillator_amplitude": by_theory(&of::OSCILLATOR_AMPLITUDE, structure),
        })
    };
    json!({
        "absorber": of_one.absorber + 1,
        "fold": end(&of_one.manifold.fold),
        "symmetry_breaking": end(&of_one.manifold.symmetry_breaking),
    })
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
            // Of each absorber that the mode moves, by its number from 1: where its manifold is stable, from the fold on.
            "manifolds": one.manifolds.iter().map(manifold).collect::<Vec<_>>(),
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
