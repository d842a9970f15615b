//! Claims of the exact orbits, confirmed by simulations that start on them.
//!
//! The two share no code: an orbit is a root of closed equations, a simulation goes from event to
//! event. A motion near an orbit that attracts is never simulated for longer than it takes to see
//! its disturbance shrink.

use super::{Claim, Finding, ReachedMotion, Reason, Statement, Verdict};
use crate::motions::{Measured, Window};
use crate::orbits::{AfterImpact, Bifurcation, FullSystem, ImpactMap, Limit, Orbit, Peaks};
use crate::regimes::AbsorberAmplitude;
use crate::simulation::{Simulation, StartError};
use crate::system::System;

/// Disturbance of the absorber's speed, relative: linear, and far above rounding.
pub(crate) const DISTURBANCE: f64 = 1e-6;
/// Factor by which a disturbance must shrink or grow to be seen.
const SEEN: f64 = 100.0;
/// Periods that this may take.
const LONGEST: f64 = 5000.0;
/// Distance after a period, over the size of the motion, per unit of growth of a disturbance.
const CLOSES: f64 = 1e-10;
/// Relative distance in clearance at which the two sides of a limit are simulated: small against the
/// theory's error, large enough for motions to leave within some thousand periods.
const ASIDE: f64 = 0.01;
/// Relative disturbance there: small beside the basin of an orbit that is about to lose stability.
const SMALL: f64 = 1e-3;
/// Long enough to leave an orbit one percent beyond its limit.
const WINDOW: Window = Window { discard: 4000, periods: 100, impact_limit: 100_000 };

/// For each admissible orbit with two impacts per period: a simulation started on it repeats, and a small disturbance
/// shrinks or grows as its multipliers say.
pub fn simulated(exact: &FullSystem) -> Result<Vec<Claim>, StartError> {
    let mut claims = Vec::new();
    for (index, orbit) in exact.two_impact_orbits().into_iter().enumerate() {
        if !orbit.admissibility.admissible {
            continue;
        }
        let number = index + 1;
        claims.extend(repeats(&exact.system, orbit, number)?);
        claims.extend(shrinks(&exact.system, orbit, number)?);
    }
    Ok(claims)
}

/// The state at the next end of an excitation period on the orbit, by simulation from its impact.
fn begun(system: &System, after: &AfterImpact) -> Result<Simulation, StartError> {
    let mut simulation = Simulation::new(system, after.state(), after.phase)?;
    simulation.run(1, u64::MAX, &mut ());
    Ok(simulation)
}

fn repeats(system: &System, orbit: &Orbit, number: usize) -> Result<Option<Claim>, StartError> {
    let cycle = &orbit.cycle;
    let Ok(map) = ImpactMap::of(system) else { return Ok(None) };
    let peaks = Peaks::of(&map, cycle);
    let mut simulation = begun(system, &cycle.impacts[0])?;
    let before = simulation.state();
    simulation.run(1, u64::MAX, &mut ());
    let size = 1.0 + peaks.displacement + peaks.velocity;
    let missed = before.distance(&simulation.state()) / size;
    Ok(Some(closes(number, missed, orbit.radius_per_period())))
}

/// That an orbit repeats, by how far a simulation misses its start after a period, over the size of the motion.
pub(crate) fn closes(number: usize, missed: f64, multiplier: f64) -> Claim {
    let tolerance = CLOSES * multiplier.max(1.0);
    let claim = Claim::of_outcome(
        Statement::Repeats { orbit: number },
        [Finding::Repeats, Finding::Misses { by: missed }],
        Reason::Growth,
        Verdict::of(missed <= tolerance),
    );
    Claim { difference: Some(missed), tolerance, ..claim }
}

fn shrinks(system: &System, orbit: &Orbit, number: usize) -> Result<Option<Claim>, StartError> {
    let after = orbit.cycle.impacts[0];
    let disturbed = AfterImpact { y_velocity: after.y_velocity * (1.0 + DISTURBANCE), ..after };
    let mut reference = begun(system, &after)?;
    let mut simulation = begun(system, &disturbed)?;
    let first = reference.state().distance(&simulation.state());
    // An unstable reference leaves as well: rounding grows with the disturbance, from far below it.
    let left = |periods: u64| {
        for _ in 0..periods {
            reference.run(1, u64::MAX, &mut ());
            simulation.run(1, u64::MAX, &mut ());
        }
        reference.state().distance(&simulation.state()) / first
    };
    Ok(followed(number, orbit.radius_per_period(), left))
}

/// That a disturbance of an orbit dies out or grows as its largest multiplier says, by the share of one that is left after so many
/// periods as it should take to change a hundredfold; none where that is too long, or too fast to be followed.
pub(crate) fn followed(
    number: usize,
    multiplier: f64,
    left: impl FnOnce(u64) -> f64,
) -> Option<Claim> {
    let needed = (libm::log(SEEN) / libm::log(multiplier).abs()).ceil();
    if !(1.0..=LONGEST).contains(&needed) {
        return None;
    }
    let dies_out = multiplier < 1.0;
    let periods = needed as u64;
    let share = left(periods);
    Some(Claim::of_outcome(
        Statement::Disturbance { orbit: number, multiplier },
        [Finding::Disturbance { dies_out }, Finding::Left { share, periods }],
        Reason::Followed,
        Verdict::of((share < 1.0) == dies_out),
    ))
}

/// On either side of each limit of stability next to the case: the motion stays, or leaves.
pub fn limits(exact: &FullSystem) -> Result<Vec<Claim>, StartError> {
    let around = |limit: &&Limit| (0.5..2.0).contains(&limit.clearance);
    let mut claims = Vec::new();
    for limit in exact.stability_limits().filter(around) {
        let Ok(cycle) = limit.cycle(&exact.system) else { continue };
        let side = |factor: f64| -> Result<Option<(bool, ReachedMotion)>, StartError> {
            let scaled = exact.system.with_clearance_scaled(limit.clearance * factor);
            let Ok(there) = scaled else { return Ok(None) };
            let found = FullSystem::of(&there);
            // Where no orbit attracts, the one at the limit is the place to start.
            let after = match found.attracting() {
                Some(orbit) => orbit.orbit.cycle.impacts[0],
                None => cycle.impacts[0],
            };
            let start = AfterImpact { y_velocity: after.y_velocity * (1.0 - SMALL), ..after };
            let reached = stays(&there, &start)?;
            Ok(Some((found.attracting().is_some(), reached)))
        };
        let (Some(below), Some(above)) = (side(1.0 - ASIDE)?, side(1.0 + ASIDE)?) else {
            continue;
        };
        let agrees =
            |(attracts, reached): (bool, ReachedMotion)| attracts == reached.is_steady_flight();
        let rests = limit.kind == Bifurcation::Sticking;
        claims.push(Claim::of_outcome(
            Statement::Limit { bifurcation: limit.kind },
            [
                Finding::Steady { below: below.0, above: above.0, rests },
                Finding::Reached { below: below.1, above: above.1 },
            ],
            Reason::EitherSide,
            Verdict::of(agrees(below) && agrees(above)),
        ));
    }
    Ok(claims)
}

fn stays(system: &System, after: &AfterImpact) -> Result<ReachedMotion, StartError> {
    let simulation = begun(system, after)?;
    let found = Measured::reach(system, simulation.state(), &WINDOW)?;
    let AbsorberAmplitude { smallest, largest, .. } =
        found.classification.evidence.absorber_amplitude;
    // A modulation no deeper than the disturbance is left of it, where the motion is slow to settle.
    let steady = largest - smallest <= SMALL * (largest + smallest);
    let repeats = found.classification.evidence.periodicity.map(|repetition| repetition.periods);
    Ok(ReachedMotion {
        regime: found.regime(),
        repeats_after: repeats.or(steady.then_some(1)),
        rests: found.sustained_contact.duration_tau > 0.0,
    })
}
