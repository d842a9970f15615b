//! Exact orbits near each mode that a load drives, and where they attract.

use std::f64::consts::TAU;

use super::ModalError;
use super::theory::LoadTheory;
use crate::case::{Load, ModalCase};
use crate::executor::{Executor, map};
use crate::orbits::{ModalOrbit, ReachEnd, antiperiodic_orbits, stable_stretches};
use crate::system::{ModalParameter, ModalSystem};

/// Parts of a number's own value within which it is looked at.
const RANGE: [f64; 2] = [0.25, 4.0];
/// Most absorbers whose clearances are looked at: the search for orbits takes more starts the more there are.
const MOST_CLEARANCES: usize = 4;

/// The exact orbits under a load at one frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadOrbits {
    /// Which load.
    pub load: usize,
    /// In Hz: the natural frequency of a mode in its range, or the middle of that.
    pub at: f64,
    /// All orbits that are found.
    pub orbits: Vec<ModalOrbit>,
    /// What theory says of the mode that is driven there.
    pub theory: Option<LoadTheory>,
    /// Where one attracts, along each number that is looked at.
    pub along: Vec<Stretches>,
}

/// Where an orbit attracts along a number.
#[derive(Debug, Clone, PartialEq)]
pub struct Stretches {
    /// Which: the load's amplitude, its frequency, or a clearance.
    pub parameter: ModalParameter,
    /// Between which values was looked, in the load's unit, Hz or m.
    pub range: [f64; 2],
    /// Stretches with what ends them, in the same unit, ascending.
    pub found: Vec<[ReachEnd; 2]>,
}

/// The exact orbits under each load, near every mode in its range.
///
/// # Errors
/// [`ModalError::System`] where there is no steady motion.
pub fn orbits(case: &ModalCase, on: &dyn Executor) -> Result<Vec<LoadOrbits>, ModalError> {
    let mut found = at_resonances(case)?;
    let mut asked = Vec::new();
    for (owner, LoadOrbits { load, at, .. }) in found.iter().enumerate() {
        let load = &case.loads[*load];
        let system = case.system(load, *at)?;
        asked.extend(
            parameters(case, load, *at).into_iter().map(|one| (owner, system.clone(), one)),
        );
    }
    let stretches = |k: usize| {
        let (_, system, (parameter, unit, range)) = &asked[k];
        of(system, *parameter, *unit, *range)
    };
    let all = map(on, "exact orbits", asked.len(), stretches);
    for ((owner, ..), stretches) in asked.iter().zip(all) {
        found[*owner].along.push(stretches);
    }
    Ok(found)
}

/// The same without where they attract along any number.
///
/// # Errors
/// As [`orbits`].
pub fn at_resonances(case: &ModalCase) -> Result<Vec<LoadOrbits>, ModalError> {
    let all = case.loads.iter().enumerate();
    let each = all.flat_map(|(load, of)| of.resonances(case).into_iter().map(move |at| (load, at)));
    let found = each.map(|(load, at)| {
        let orbits = antiperiodic_orbits(&case.system(&case.loads[load], at)?);
        let theory = LoadTheory::of(case, (load, at), &orbits);
        Ok(LoadOrbits { load, at, orbits, theory, along: Vec::new() })
    });
    found.collect()
}

/// What is looked at, with what a unit of the physics is worth, and between which values.
fn parameters(case: &ModalCase, load: &Load, at: f64) -> Vec<(ModalParameter, f64, [f64; 2])> {
    let around = |own: f64| RANGE.map(|factor| factor * own);
    let mut all = vec![(ModalParameter::Excitation, load.amplitude, around(load.amplitude))];
    let [from, to] = load.range_hz;
    if from < at && at < to {
        all.push((ModalParameter::FrequencyRatio, case.omega() / TAU, load.range_hz));
    }
    if case.absorbers.len() <= MOST_CLEARANCES {
        let each = case.absorbers.iter().enumerate();
        all.extend(
            each.map(|(j, one)| (ModalParameter::Clearance(j), 1.0, around(one.clearance_m))),
        );
    }
    all
}

/// The amplitudes of a load from a quarter to four times its own at which an orbit attracts at a frequency in Hz.
///
/// # Errors
/// [`ModalError::System`] where there is no steady motion.
pub(super) fn stable_amplitudes(
    case: &ModalCase,
    load: &Load,
    at: f64,
) -> Result<Stretches, ModalError> {
    let own = load.amplitude;
    let range = RANGE.map(|factor| factor * own);
    Ok(of(&case.system(load, at)?, ModalParameter::Excitation, own, range))
}

/// The share of a load's range of frequencies in which an orbit attracts; 1 or 0 of one frequency.
///
/// # Errors
/// [`ModalError::System`] where there is no steady motion.
pub(super) fn stable_share(case: &ModalCase, load: &Load) -> Result<f64, ModalError> {
    let [from, to] = load.range_hz;
    if from == to {
        let system = case.system(load, from)?;
        let attracts = antiperiodic_orbits(&system).iter().any(ModalOrbit::stable);
        return Ok(f64::from(u8::from(attracts)));
    }
    let unit = case.modes[0].frequency_hz;
    let system = case.system(load, load.centre(case))?;
    let found = of(&system, ModalParameter::FrequencyRatio, unit, load.range_hz).found;
    // Of orbits that attract beside one another one is enough.
    let (mut share, mut reached) = (0.0, from);
    for [begin, end] in found.iter().map(|ends| ends.map(|end| end.value)) {
        share += (end - begin.max(reached)).max(0.0);
        reached = reached.max(end);
    }
    Ok(share / (to - from))
}

fn of(system: &ModalSystem, parameter: ModalParameter, unit: f64, range: [f64; 2]) -> Stretches {
    let within = range.map(|value| value / unit);
    let mut found = stable_stretches(system, parameter, within);
    found.iter_mut().flatten().for_each(|end| end.value *= unit);
    Stretches { parameter, range, found }
}
