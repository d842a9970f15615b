//! The largest amplitude along a band: of the exact orbit where one attracts, simulated elsewhere.

use crate::band::Band;
use crate::band::exact::{attracting, largest_value, stability, unstable_places};
use crate::regimes::long_term::{Effort, motions};
use crate::system::System;

/// Places of a band that are simulated where no symmetric orbit attracts, its ends among them.
const PLACES: u32 = 9;
/// How thoroughly: enough to rank absorbers; the winner is simulated from many more starts.
const EFFORT: Effort = Effort { starts: 2, periods: 100 };

/// The largest absolute displacement of the oscillator, over the clearance; `None` where nothing could
/// be measured.
pub fn worst(band: &Band, ranges: bool) -> Option<f64> {
    if !ranges {
        let alone = attracting(band, band.base.frequency_ratio());
        let orbit = alone.map(|orbit| orbit.peaks.displacement);
        return orbit.or_else(|| simulated(&[band.base]));
    }
    let stability = stability(band);
    let exact = largest_value(band, &stability, |_, orbit| orbit.peaks.displacement);
    let largest = exact.map(|(_, peak)| peak);
    let places = unstable_places(band, &stability, PLACES);
    let systems: Vec<System> = places.iter().filter_map(|at| band.system(*at).ok()).collect();
    if systems.is_empty() {
        return largest;
    }
    Some(simulated(&systems)?.max(largest.unwrap_or(0.0)))
}

fn simulated(systems: &[System]) -> Option<f64> {
    let found = motions(systems, &EFFORT).ok()?;
    found.iter().flatten().map(|motion| motion.peak).max_by(f64::total_cmp)
}
