//! What theory and exact orbits of a structure of several modes claim, judged by the layer that is independent of them.

use super::ModalError;
use super::orbits::LoadOrbits;
use super::theory::{GroupTheory, LoadTheory};
use crate::case::{ModalCase, PlacedAbsorber};
use crate::executor::{Executor, map};
use crate::orbits::{ModalOrbit, antiperiodic_orbits, orbit_state};
use crate::simulation::{ModalSimulation, ModalStartError};
use crate::system::{ModalState, ModalSystem};
use crate::validation::orbits::{DISTURBANCE, closes, followed};
use crate::validation::{Claim, Finding, Reason, Statement, Verdict, motions, tolerance};

/// A claim about the motions under a load at one frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadClaim {
    /// Which load.
    pub load: usize,
    /// In Hz.
    pub at: f64,
    /// The claim, of lengths over the smallest clearance.
    pub claim: Claim,
}

/// What theory claims of the modes that loads drive, judged by the exact orbits of all modes, and what these claim, judged by simulations
/// that start on them and beside them.
///
/// # Errors
/// [`ModalError`] where there is no steady motion, or no simulation can begin.
pub fn claims(
    case: &ModalCase,
    found: &[LoadOrbits],
    on: &dyn Executor,
) -> Result<Vec<LoadClaim>, ModalError> {
    let each = map(on, "claims", found.len(), |k| of_one(case, &found[k]));
    let mut all = Vec::new();
    for (one, claims) in found.iter().zip(each) {
        let LoadOrbits { load, at, .. } = *one;
        all.extend(claims?.into_iter().map(|claim| LoadClaim { load, at, claim }));
    }
    Ok(all)
}

fn of_one(case: &ModalCase, found: &LoadOrbits) -> Result<Vec<Claim>, ModalError> {
    let mut claims = match &found.theory {
        Some(theory) => fixed_points(case, theory, &of_moved(case, found, theory.mode)?),
        None => Vec::new(),
    };
    let system = case.system(&case.loads[found.load], found.at)?;
    for (number, orbit) in (1..).zip(&found.orbits).filter(|(_, orbit)| orbit.admissible) {
        claims.extend(simulated(&system, orbit, number)?);
    }
    Ok(claims)
}

/// The exact orbits of the absorbers that a mode moves, which are those that the theory of the mode speaks of: one at a node of it does not
/// hit both of its walls in every period, and may rest.
fn of_moved(
    case: &ModalCase,
    found: &LoadOrbits,
    mode: usize,
) -> Result<Vec<ModalOrbit>, ModalError> {
    let moved = |one: &&PlacedAbsorber| case.modes[mode].shape[one.place] != 0.0;
    let absorbers: Vec<PlacedAbsorber> = case.absorbers.iter().filter(moved).cloned().collect();
    if absorbers.is_empty() || absorbers.len() == case.absorbers.len() {
        return Ok(found.orbits.clone());
    }
    let alone = ModalCase { absorbers, ..case.clone() };
    Ok(antiperiodic_orbits(&alone.system(&case.loads[found.load], found.at)?))
}

/// For each fixed point: stable or not, and if an exact orbit is near it its amplitude.
fn fixed_points(case: &ModalCase, theory: &LoadTheory, orbits: &[ModalOrbit]) -> Vec<Claim> {
    let Some(GroupTheory { points, error, .. }) = &theory.group else { return Vec::new() };
    let amplitudes: Vec<f64> = orbits.iter().map(|one| theory.amplitude(case, one)).collect();
    let own: Vec<f64> = points.iter().map(|(amplitude, _)| *amplitude).collect();
    let says_nothing = *error > tolerance::SAYS_NOTHING;
    let reason = match case.modes.len() {
        1 => Reason::NeglectedTerms { says_nothing },
        _ => Reason::OtherModes { says_nothing },
    };
    let unit = case.least_clearance_m();
    let mut claims = Vec::new();
    for (point, (amplitude, stable)) in (1..).zip(points.iter().copied()) {
        let near = motions::nearest(amplitude, &own, &amplitudes, *error);
        let observed = near.map_or(Finding::NoOrbit, |k| Finding::Stability {
            stable: orbits[k].stable(),
            multiplier: Some(per_period(&orbits[k])),
        });
        claims.push(Claim::of_outcome(
            Statement::Stability { point, absorber_amplitude: None, stable },
            [Finding::Stability { stable, multiplier: None }, observed],
            Reason::NearestOrbit,
            Verdict::of(near.is_some_and(|k| orbits[k].stable() == stable)),
        ));
        claims.extend(near.map(|k| {
            let both = [amplitude, amplitudes[k]].map(|one| one / unit);
            Claim::of_number(Statement::FixedPoint { point, symbol: "C" }, both, *error, reason)
        }));
    }
    claims
}

/// The largest multiplier of a whole period.
fn per_period(orbit: &ModalOrbit) -> f64 {
    orbit.spectral_radius() * orbit.spectral_radius()
}

/// That a simulation which starts on an orbit repeats, and that one beside it comes to it or leaves it.
fn simulated(
    system: &ModalSystem,
    orbit: &ModalOrbit,
    number: usize,
) -> Result<Vec<Claim>, ModalStartError> {
    let begin = orbit_state(system, orbit);
    let multiplier = per_period(orbit);
    let after = |simulation: &mut ModalSimulation, periods: u64| -> ModalState {
        simulation.run(periods, u64::MAX, &mut ());
        simulation.state()
    };
    let mut once = ModalSimulation::new(system, &begin, 0.0)?;
    let missed = begin.distance(&after(&mut once, 1));
    let mut claims = vec![closes(number, missed, multiplier)];
    let mut beside = begin;
    // Each by another share: what equal ones hide is seen too.
    for (k, absorber) in (1_u32..).zip(&mut beside.absorbers[..system.absorbers().len()]) {
        absorber[1] *= 1.0 + f64::from(k) * DISTURBANCE;
    }
    let mut on = ModalSimulation::new(system, &begin, 0.0)?;
    let mut beside = ModalSimulation::new(system, &beside, 0.0)?;
    claims.extend(followed(number, multiplier, |periods| {
        let mut apart = || after(&mut on, periods).apart(&after(&mut beside, periods));
        // What dies out fastest is gone after as long: of what is left the slowest decides.
        let before = apart();
        apart() / before
    }));
    Ok(claims)
}
