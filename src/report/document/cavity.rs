//! What the theory of a cavity that is not ideal, and its exact orbits with two impacts per period, say.

use std::f64::consts::TAU;

use serde_json::{Value, json};

use super::scale::{Scale, rounded};
use crate::analysis::ManifoldPoint;
use crate::cavity::{CavityAnalysis, CavityFixedPoint};
use crate::method::Method::{ExactOrbit, Theory};
use crate::orbits::{FullSystem, SteadyOrbit};
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;

/// Fixed points, fold and symmetry breaking by the theory of the cavity, and exact orbits; none of an ideal cavity.
pub fn cavity(scale: &Scale, theory: Option<&CavityAnalysis>, exact: &FullSystem) -> Option<Value> {
    let theory = theory?;
    let place = |point: ManifoldPoint| {
        [
            scale.units.quantity(&of::ABSORBER_AMPLITUDE, point.absorber_amplitude, Theory),
            scale.units.quantity(&of::OSCILLATOR_AMPLITUDE, point.oscillator_amplitude, Theory),
        ]
    };
    let orbits = exact.two_impact_measured();
    Some(json!({
        "fixed_points": theory.fixed_points.iter().map(|one| point(scale, one)).collect::<Vec<_>>(),
        // B and C; none where the cavity is not symmetric.
        "fold": theory.fold.map(place),
        "symmetry_breaking": theory.symmetry_breaking.map(place),
        "orbits": orbits.iter().map(|one| orbit(scale, one)).collect::<Vec<_>>(),
        "attracting": orbits.iter().position(|one| one.orbit.attracts()),
        // Places at which the search for orbits cannot tell.
        "undecided": exact.two_impact.as_ref().map_or(0, |found| found.undecided.len()),
    }))
}

fn point(scale: &Scale, point: &CavityFixedPoint) -> Value {
    let length = |kind, value| scale.units.quantity(kind, value, Theory);
    let number = |kind, value| Quantity::new(kind, value, Theory);
    let motion = &point.motion;
    json!({
        "oscillator_amplitude": length(&of::OSCILLATOR_AMPLITUDE, motion.oscillator_amplitude),
        "absorber_amplitude": length(&of::ABSORBER_AMPLITUDE, motion.absorber_amplitude),
        "eta": number(&of::ETA, point.eta),
        // From the impact on the wall at +b to the other one.
        "flight_share": number(&of::FLIGHT_SHARE, motion.times[0] / TAU),
        "trace": number(&of::TRACE, point.trace),
        "determinant": number(&of::DETERMINANT, point.determinant),
        "stable": point.stable,
        "admissible": motion.admissible,
    })
}

fn orbit(scale: &Scale, found: &SteadyOrbit) -> Value {
    let number = |kind, value| Quantity::new(kind, value, ExactOrbit);
    let SteadyOrbit { orbit, peaks, impact_speed, .. } = found;
    let durations = orbit.cycle.unfolded().durations;
    let period: f64 = durations.iter().sum();
    json!({
        "flight_share": number(&of::FLIGHT_SHARE, durations[0] / period),
        "peak": scale.units.quantity(&of::PEAK, peaks.displacement, ExactOrbit),
        // The larger of both.
        "impact_speed": scale.units.quantity(&of::IMPACT_SPEED, *impact_speed, ExactOrbit),
        // Over a whole period.
        "multiplier": rounded(number(&of::SPECTRAL_RADIUS, orbit.radius_per_period())),
        "leading": orbit.multipliers.leading(),
        "admissible": orbit.admissibility.admissible,
        "sticks": orbit.admissibility.sticks(),
        // Whether the slip of an absorber that rubs would reverse between impacts.
        "reverses": orbit.admissibility.reverses(),
        "stable": orbit.multipliers.stable(),
        "residual": orbit.convergence.residual,
    })
}
