//! The chosen absorber, simulated from many starts along its band.

use serde::Serialize;

use super::task::{Deviation, Task};
use crate::band::exact::attracting;
use crate::band::simulated::{Effort, Motion, motions};
use crate::case::Choice;
use crate::simulation::StartError;
use crate::system::System;

/// Places of a band, its ends among them.
const PLACES: u32 = 9;
/// How thoroughly each is simulated.
const EFFORT: Effort = Effort { starts: 32, periods: 250 };
/// Relative difference up to which a simulated amplitude is that of the exact orbit, and that of the
/// impacts per period.
const ALIKE: f64 = 0.01;

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
    /// How many motions the starts led to.
    pub motions: usize,
    /// The largest amplitude among them.
    pub largest: Option<f64>,
}

/// Simulates an absorber at nine places of the band, or at the case's own excitation.
///
/// # Errors
/// [`StartError`] where a start is not finite.
pub fn confirm(task: &Task, choice: &Choice) -> Result<Vec<Place>, StartError> {
    let Some((band, clearance)) = task.band_of(choice, &Deviation::default()) else {
        return Ok(Vec::new());
    };
    let places: Vec<f64> = match &task.band {
        Some(_) => band.places(PLACES).collect(),
        None => vec![band.base.frequency_ratio()],
    };
    let systems: Vec<(f64, System)> =
        places.into_iter().filter_map(|at| Some((at, band.system(at).ok()?))).collect();
    let alone: Vec<System> = systems.iter().map(|(_, system)| *system).collect();
    let found = motions(&alone, &EFFORT)?;
    let place = |((at, _), motions): (&(f64, System), Vec<Motion>)| {
        let exact = attracting(&band, *at).map(|orbit| orbit.peaks.displacement);
        let predicted = motions.iter().filter(|motion| {
            exact.is_some_and(|exact| (motion.peak - exact).abs() <= ALIKE * exact)
                && (motion.impacts_per_period - 2.0).abs() <= ALIKE
        });
        let largest = motions.iter().map(|motion| motion.peak).max_by(f64::total_cmp);
        Place {
            at: *at,
            exact: exact.map(|peak| peak * clearance),
            starts: EFFORT.starts,
            as_predicted: predicted.map(|motion| motion.starts).sum(),
            motions: motions.len(),
            largest: largest.map(|peak| peak * clearance),
        }
    };
    Ok(systems.iter().zip(found).map(place).collect())
}
