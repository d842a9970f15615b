//! The chosen absorber, simulated from many starts along its band.

use serde::Serialize;

use super::task::{Deviation, Task};
use crate::band::exact::{attracting, stability, unstable_places};
use crate::case::{Choice, Objective};
use crate::regimes::long_term::{Effort, Motion, motions};
use crate::simulation::StartError;
use crate::system::System;

/// Places of a band, its ends among them.
const PLACES: u32 = 9;
/// How thoroughly each is simulated.
const EFFORT: Effort = Effort { starts: 32, periods: 250 };

/// What simulation finds at a place. Lengths in the units of a [`Choice`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Place {
    /// `Omega`, or the amplitude over the case's own.
    pub at: f64,
    /// Amplitude of the exact symmetric orbit that attracts, if one does.
    pub exact: Option<f64>,
    /// Starts that were simulated.
    pub starts: u32,
    /// Starts that led to the exact orbit.
    pub as_predicted: u32,
    /// Starts that never woke the absorber; that from rest is one of them where there are any.
    pub asleep: u32,
    /// How many motions with impacts the starts led to.
    pub motions: usize,
    /// The largest amplitude among them.
    pub largest: Option<f64>,
}

/// Simulates an absorber at nine places of the band, or at the case's own excitation. Where the worst
/// amplitude is asked for, also in the middle of each stretch in which no orbit attracts.
///
/// # Errors
/// [`StartError`] where a start is not finite.
pub fn confirm(task: &Task, choice: &Choice) -> Result<Vec<Place>, StartError> {
    let Some((band, clearance)) = task.band_of(choice, &Deviation::default()) else {
        return Ok(Vec::new());
    };
    let mut places: Vec<f64> = match &task.band {
        Some(_) => band.places(PLACES).collect(),
        None => vec![band.base.frequency_ratio()],
    };
    if task.objective == Objective::WorstAmplitude && task.band.is_some() {
        places.extend(unstable_places(&band, &stability(&band), PLACES));
        places.sort_by(f64::total_cmp);
        places.dedup();
    }
    let systems: Vec<(f64, System)> =
        places.into_iter().filter_map(|at| Some((at, band.system(at).ok()?))).collect();
    let alone: Vec<System> = systems.iter().map(|(_, system)| *system).collect();
    let found = motions(&alone, &EFFORT)?;
    let place = |((at, _), motions): (&(f64, System), Vec<Motion>)| {
        let exact = attracting(&band, *at);
        let starts = |which: &dyn Fn(&Motion) -> bool| {
            motions.iter().filter(|one| which(one)).map(|one| one.starts).sum::<u32>()
        };
        let largest = motions.iter().map(|motion| motion.peak).max_by(f64::total_cmp);
        Place {
            at: *at,
            exact: exact.as_ref().map(|orbit| orbit.peaks.displacement * clearance),
            starts: EFFORT.starts,
            as_predicted: starts(&|one| {
                exact.as_ref().is_some_and(|orbit| one.is_orbit_with_peak(orbit.peaks.displacement))
            }),
            asleep: starts(&Motion::is_asleep),
            motions: motions.iter().filter(|one| !one.is_asleep()).count(),
            largest: largest.map(|peak| peak * clearance),
        }
    };
    Ok(systems.iter().zip(found).map(place).collect())
}

impl Place {
    /// Whether every start led to the exact orbit, those that never woke the absorber aside.
    pub fn is_as_predicted(&self) -> bool {
        self.as_predicted > 0 && self.as_predicted + self.asleep == self.starts
    }
}

/// The largest amplitude that was simulated; `None` where nothing could be.
pub fn largest(places: &[Place]) -> Option<f64> {
    places.iter().filter_map(|place| place.largest).max_by(f64::total_cmp)
}
