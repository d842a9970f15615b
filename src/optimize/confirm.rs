//! The chosen absorber, simulated from many starts along its band.

use serde::Serialize;

use super::task::{Deviation, Task};
use crate::band::exact::{attracting, stability, unstable_places};
use crate::band::simulated::{Effort, Motion, motions_from};
use crate::case::{Choice, Objective};
use crate::simulation::StartError;
use crate::system::{State, System};

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

/// Oscillator and absorber at rest in the middle.
const REST: State = State { x: 0.0, x_velocity: 0.0, y: 0.0, y_velocity: 0.0 };

/// Simulates an absorber at nine places of the band, or at the case's own excitation. Where the worst
/// amplitude is asked for, also in the middle of each stretch in which no orbit attracts, and also from
/// rest.
///
/// # Errors
/// [`StartError`] where a start is not finite.
pub fn confirm(task: &Task, choice: &Choice) -> Result<Vec<Place>, StartError> {
    let Some((band, clearance)) = task.band_of(choice, &Deviation::default()) else {
        return Ok(Vec::new());
    };
    let worst = task.objective == Objective::WorstAmplitude;
    let mut places: Vec<f64> = match &task.band {
        Some(_) => band.places(PLACES).collect(),
        None => vec![band.base.frequency_ratio()],
    };
    if worst && task.band.is_some() {
        places.extend(unstable_places(&band, &stability(&band), PLACES));
        places.sort_by(f64::total_cmp);
        places.dedup();
    }
    let further: &[State] = if worst { &[REST] } else { &[] };
    let systems: Vec<(f64, System)> =
        places.into_iter().filter_map(|at| Some((at, band.system(at).ok()?))).collect();
    let alone: Vec<System> = systems.iter().map(|(_, system)| *system).collect();
    let found = motions_from(&alone, &EFFORT, further)?;
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
            starts: EFFORT.starts + further.len() as u32,
            as_predicted: predicted.map(|motion| motion.starts).sum(),
            motions: motions.len(),
            largest: largest.map(|peak| peak * clearance),
        }
    };
    Ok(systems.iter().zip(found).map(place).collect())
}

/// The largest amplitude that was simulated; `None` where nothing could be.
pub fn largest(places: &[Place]) -> Option<f64> {
    places.iter().filter_map(|place| place.largest).max_by(f64::total_cmp)
}
