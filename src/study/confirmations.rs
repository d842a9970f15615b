//! What simulation from several starts says of the clearances that the exact orbits recommend or
//! allow: a stable 1:1 motion is of little use where few starts lead to it.

use serde::Serialize;

use super::margins::Margins;
use crate::executor::Serial;
use crate::motions::{Effort, Motion, Motions, Place, motions};
use crate::orbits::FullSystem;
use crate::regimes::Regime;
use crate::simulation::StartError;
use crate::system::System;

/// Evenly spread starts per clearance: a motion that half of all starts lead to is missed by all of
/// them once in 256 times.
const STARTS: u32 = 8;
/// Excitation periods of a window of theirs.
const PERIODS: u64 = 200;
/// Relative width to which a limit is bracketed.
const WIDTH: f64 = 0.01;

/// Where several starts lead at another clearance, all else being the case's.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Probe {
    /// Clearance over the case's.
    pub factor: f64,
    /// How many starts were followed.
    pub starts: u32,
    /// How many of them ended in steady 1:1 resonance.
    pub steady: u32,
    /// Largest peak of the oscillator in steady 1:1 resonance, over the case's clearance.
    pub steady_peak: f64,
    /// What most of the others became.
    pub other: Option<Regime>,
    /// Largest peak of the oscillator among the others, over the case's clearance.
    pub other_peak: f64,
}

impl Probe {
    /// Simulates at `factor` times the clearance; `None` if there is no such system.
    ///
    /// # Errors
    /// [`StartError`] never, for starts inside the cavity.
    pub fn at(system: &System, factor: f64) -> Result<Option<Self>, StartError> {
        let Ok(there) = system.with_clearance_scaled(factor) else { return Ok(None) };
        let found = motions(&[Place::new(&there, STARTS)], &Effort::over(PERIODS), &Serial)?;
        let starts = |motion: &&Motion| motion.reached().starts > 0;
        let (steady, others): (Vec<&Motion>, Vec<&Motion>) =
            found.iter().flatten().filter(starts).partition(|motion| motion.is_one_to_one());
        let peak = |motion: &&Motion| motion.facts().peak.value;
        let highest = |motions: &[&Motion]| {
            motions.iter().copied().max_by(|a, b| peak(a).total_cmp(&peak(b))).cloned()
        };
        let scaled = |motion: Option<&Motion>| motion.map_or(0.0, |one| factor * peak(&one));
        let other = highest(&others);
        Ok(Some(Self {
            factor,
            starts: STARTS,
            steady: steady.iter().map(|motion| motion.reached().starts).sum(),
            steady_peak: scaled(highest(&steady).as_ref()),
            other: other.as_ref().map(Motion::regime),
            other_peak: scaled(other.as_ref()),
        }))
    }

    /// Whether every start ended in steady 1:1 resonance.
    pub fn all_steady(&self) -> bool {
        self.steady == self.starts
    }
}

/// The clearance up to which all starts end in steady 1:1 resonance, by bisection.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SimulatedLimit {
    /// The largest clearance found at which they all do, over the case's.
    pub kept: f64,
    /// The smallest found at which some do not.
    pub lost: Probe,
}

/// What simulation adds to the margins of theory; nothing of a study that simulates nothing.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Confirmations {
    /// Upwards in clearance; `None` where the case itself is not steady from all starts, or stays so
    /// up to where its orbit ends.
    pub upper_limit: Option<SimulatedLimit>,
    /// At the clearance where the exact orbit vibrates least.
    pub best: Option<Probe>,
}

impl Confirmations {
    /// Simulates what the margins of a case speak of.
    ///
    /// # Errors
    /// [`StartError`] never, for starts inside the cavity.
    pub fn of(exact: &FullSystem, margins: &Margins, own: &Motions) -> Result<Self, StartError> {
        let best = margins.best_clearance.map(|best| Probe::at(&exact.system, best.factor));
        let best = best.transpose()?.flatten();
        Ok(Self { upper_limit: upper_limit(&exact.system, margins, own)?, best })
    }
}

/// Relative distance past the end of the orbit at which it must be gone.
const PAST: f64 = 0.01;

fn upper_limit(
    system: &System,
    margins: &Margins,
    own: &Motions,
) -> Result<Option<SimulatedLimit>, StartError> {
    let Some(end) = margins.exact.and_then(|exact| exact.clearance[1]) else {
        return Ok(None);
    };
    let steady = own.iter().filter(|motion| motion.is_one_to_one());
    if steady.map(|motion| motion.reached().starts).sum::<u32>() < own.of_starts().max(1) {
        return Ok(None);
    }
    let mut kept = 1.0;
    let beyond = end.factor * (1.0 + PAST);
    let Some(mut lost) = Probe::at(system, beyond)?.filter(|probe| !probe.all_steady()) else {
        return Ok(None);
    };
    while lost.factor > kept * (1.0 + WIDTH) {
        let middle = 0.5 * (kept + lost.factor);
        match Probe::at(system, middle)? {
            Some(probe) if probe.all_steady() => kept = middle,
            Some(probe) => lost = probe,
            None => break,
        }
    }
    Ok(Some(SimulatedLimit { kept, lost }))
}
