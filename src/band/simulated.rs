//! What simulation finds along a band, from several starts at each place: many trajectories side by
//! side.

use serde::Serialize;

use super::{Band, Stretch, exact};
use crate::case::BandOver;
use crate::regimes::long_term::{Effort, Motion, motions};
use crate::simulation::StartError;
use crate::system::System;

/// Even places of a band that are simulated, its ends among them.
pub const PLACES: u32 = 33;
/// How often it is looked closer around the place with the largest amplitude, and at how many places on
/// either side: the second time to a sixteenth of the distance of even ones.
const REFINEMENTS: u32 = 2;
const CLOSER: u32 = 3;

/// A place of a band, and the motions that starts led to there.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Place {
    /// `Omega`, or the amplitude over the base system's.
    pub at: f64,
    /// In the order in which starts led to them.
    pub motions: Vec<Motion>,
}

impl Place {
    /// The motion with the largest amplitude.
    pub fn largest(&self) -> Option<&Motion> {
        self.motions.iter().max_by(|a, b| a.peak.total_cmp(&b.peak))
    }

    /// Whether the absorber stays asleep in one of the motions: from rest it is only woken by a wall that
    /// reaches it.
    pub fn sleeps(&self) -> bool {
        self.motions.iter().any(Motion::is_asleep)
    }

    /// Whether there are several motions with impacts.
    pub fn has_several(&self) -> bool {
        self.motions.iter().filter(|motion| !motion.is_asleep()).count() > 1
    }
}

/// The motions along a band: at even places, in the middle of each stretch without an attracting
/// symmetric orbit, which may lie between two of them, at the resonances, whose peaks may, and closer
/// around the place with the largest amplitude.
///
/// # Errors
/// [`StartError`] where a start is not finite.
pub fn along(
    band: &Band,
    stability: &[Stretch<bool>],
    effort: &Effort,
) -> Result<Vec<Place>, StartError> {
    let mut places: Vec<f64> = band.places(PLACES).collect();
    places.extend(exact::unstable_middles(stability));
    places.extend(resonances(band));
    let mut found = simulated_at(band, places, effort)?;
    for _ in 0..REFINEMENTS {
        let closer = around_largest(&found);
        found.extend(simulated_at(band, closer, effort)?);
        found.sort_by(|a, b| a.at.total_cmp(&b.at));
    }
    Ok(found)
}

/// The places of a band at which the oscillator alone, or with the absorber's mass on it, resonates.
fn resonances(band: &Band) -> impl Iterator<Item = f64> {
    let [from, to] = band.range;
    let carrying = 1.0 / (1.0 + band.base.mass_ratio()).sqrt();
    let over_frequency = band.over == BandOver::Frequency;
    [1.0, carrying].into_iter().filter(move |at| over_frequency && from < *at && *at < to)
}

/// Places on both sides of the one with the largest amplitude, up to its neighbours.
fn around_largest(found: &[Place]) -> Vec<f64> {
    let largest = |place: &Place| place.largest().map_or(0.0, |motion| motion.peak);
    let of = (0..found.len()).max_by(|a, b| largest(&found[*a]).total_cmp(&largest(&found[*b])));
    let Some(middle) = of else { return Vec::new() };
    let neighbours = [middle.checked_sub(1), Some(middle + 1)];
    let sides = neighbours.into_iter().flatten().filter_map(|side| found.get(side));
    let parts = (1..=CLOSER).map(|k| f64::from(k) / f64::from(CLOSER + 1));
    let at = found[middle].at;
    sides.flat_map(|side| parts.clone().map(move |part| at + (side.at - at) * part)).collect()
}

/// The motions at places, in ascending order, each once.
fn simulated_at(
    band: &Band,
    mut places: Vec<f64>,
    effort: &Effort,
) -> Result<Vec<Place>, StartError> {
    places.sort_by(f64::total_cmp);
    places.dedup();
    let there = |at: f64| Some((at, band.system(at).ok()?));
    let (places, systems): (Vec<f64>, Vec<System>) = places.into_iter().filter_map(there).unzip();
    let found = places.into_iter().zip(motions(&systems, effort)?);
    Ok(found.map(|(at, motions)| Place { at, motions }).collect())
}
