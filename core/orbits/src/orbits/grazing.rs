//! The orbit that goes on, with one more impact, where another one grazes a wall.

use super::cycle::Cycle;
use super::impact_map::AfterImpact;
use super::orbit::Orbit;
use super::tracer::Tracer;

/// Relative changes of the parameter at which an orbit with one more impact is looked for beyond a
/// grazing. It is born with a square root, so that Newton's method needs some room.
const BEYOND: [f64; 6] = [1e-5, -1e-5, 1e-4, -1e-4, 1e-3, -1e-3];

/// Distance from the grazing orbit, over the clearance and in radians, within which an orbit with one
/// more impact is the one that it becomes: some hundred times the largest change in [`BEYOND`].
const GOES_ON: f64 = 0.1;

/// The sequence of walls of the orbit that goes on beyond a grazing, if Newton's method finds it.
pub(super) fn beyond_grazing(tracer: &Tracer, scaled: f64, orbit: &Orbit) -> Option<String> {
    across(tracer, scaled, orbit).map(|(found, _)| found.cycle.sequence())
}

/// The orbit with one more impact where `orbit` grazes, and the scaled parameter at which it was
/// found.
pub(super) fn across(tracer: &Tracer, scaled: f64, orbit: &Orbit) -> Option<(Orbit, f64)> {
    let with_contact = inserted(tracer, scaled, orbit)?;
    BEYOND.iter().find_map(|change| {
        let scaled = scaled * (1.0 + change);
        let found = tracer.at(&with_contact, scaled)?;
        let goes_on = found.cycle.distance(&with_contact) <= GOES_ON;
        (goes_on && found.admissibility.admissible).then_some((found, scaled))
    })
}

/// The cycle with the grazing contact counted as an impact.
fn inserted(tracer: &Tracer, scaled: f64, orbit: &Orbit) -> Option<Cycle> {
    let at = orbit.admissibility.narrowest?;
    let map = tracer.map_at(scaled)?;
    let mut cycle = orbit.cycle.clone();
    let start = cycle.impacts[at.flight];
    let duration = cycle.durations[at.flight];
    let first = at.fraction * duration;
    let leg = cycle.flights(&map)[at.flight];
    let there = leg.oscillator(first);
    let contact = AfterImpact {
        wall: at.wall,
        phase: start.phase + map.flight.frequency() * first,
        x: there.x,
        x_velocity: there.v,
        y_velocity: start.y_velocity + leg.acceleration * first,
    };
    cycle.durations[at.flight] = first;
    cycle.durations.insert(at.flight + 1, duration - first);
    cycle.impacts.insert(at.flight + 1, contact);
    Some(cycle)
}
