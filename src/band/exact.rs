//! Where along a band an exact 1:1 orbit attracts, the symmetric one or that of a cavity that is not ideal, and what it is like there.

use serde::Serialize;

use super::{Band, Stretch};
use crate::numerics::quadrature::nodes;
use crate::numerics::scan::{largest, sign_changes};
use crate::orbits::{SteadyOrbit, one_to_one_orbits, steady_orbit};

/// Pieces of a band in which beginnings and ends of stability are looked for. What decides it,
/// multipliers and room between impacts, is smooth along an orbit; pairs of changes within a piece
/// are found by the dip between them.
const PIECES: u32 = 96;
/// Pieces in which a largest value is looked for before it is narrowed down.
const VALUES: u32 = 48;
/// Panels of eight Gauss points per band for an average: amplitudes are smooth where an orbit attracts.
const AVERAGED: f64 = 12.0;

/// The attracting orbit at a place.
pub fn attracting(band: &Band, at: f64) -> Option<SteadyOrbit> {
    steady_orbit(&band.system(at).ok()?)
}

/// The band, cut where an attracting 1:1 orbit begins or ends.
pub fn stability(band: &Band) -> Vec<Stretch<bool>> {
    let mut places: Vec<f64> = band.corners().collect();
    if !band.is_point() {
        places.extend(sign_changes(band.range, PIECES, |at| strength(band, at)));
    }
    band.cut(places, |at| attracting(band, at).is_some())
}

/// By how much the most attracting orbit attracts: above 0 where it does, continuous where orbits
/// change their stability, touch a wall or meet one another.
fn strength(band: &Band, at: f64) -> f64 {
    let Ok(system) = band.system(at) else { return f64::NAN };
    let Ok(orbits) = one_to_one_orbits(&system) else { return f64::NAN };
    let each = orbits.iter().map(|orbit| {
        let inside = 1.0 - orbit.multipliers.spectral_radius();
        let room = orbit.admissibility.min_wall_distance;
        let slip = orbit.admissibility.slowest_slip.unwrap_or(f64::INFINITY);
        let least = inside.min(room).min(slip);
        // The sign is that of the proof, whatever rounding says of the numbers.
        if orbit.attracts() { least.max(f64::MIN_POSITIVE) } else { least.min(-f64::MIN_POSITIVE) }
    });
    // Where orbits meet and vanish a multiplier has come to 1.
    each.max_by(f64::total_cmp).unwrap_or(-f64::MIN_POSITIVE)
}

/// A value of the attracting orbit over the places where there is one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Extreme {
    /// The largest value.
    pub largest: f64,
    /// Where.
    pub at: f64,
    /// The average.
    pub mean: f64,
}

/// Where something of the attracting orbit is largest over all stretches where one attracts, and that
/// value; `None` where none does anywhere.
pub fn largest_value(
    band: &Band,
    stability: &[Stretch<bool>],
    value: impl Fn(f64, &SteadyOrbit) -> f64,
) -> Option<(f64, f64)> {
    let of = |at: f64| attracting(band, at).map(|orbit| value(at, &orbit));
    let stretches = stability.iter().filter(|stretch| stretch.of);
    let each = stretches.filter_map(|stretch| {
        let share = (stretch.to - stretch.from) / band.width();
        let pieces = if band.is_point() { 1 } else { pieces(share) };
        // At the very ends rounding decides whether there is an orbit.
        largest([stretch.from, stretch.to], pieces, of)
    });
    each.max_by(|a, b| a.1.total_cmp(&b.1))
}

/// The largest value and the average of something of the attracting orbit, over all stretches where
/// one attracts; `None` where none does anywhere.
pub fn extreme(
    band: &Band,
    stability: &[Stretch<bool>],
    value: impl Fn(f64, &SteadyOrbit) -> f64,
) -> Option<Extreme> {
    let (at, largest) = largest_value(band, stability, &value)?;
    let (mut sum, mut width) = (0.0, 0.0);
    for stretch in stability.iter().filter(|stretch| stretch.of) {
        nodes(stretch.from, stretch.to, band.width() / AVERAGED, |place, weight| {
            if let Some(orbit) = attracting(band, place) {
                sum += value(place, &orbit) * weight;
                width += weight;
            }
        });
    }
    Some(Extreme { largest, at, mean: sum / width })
}

/// Pieces for a share of the band.
fn pieces(share: f64) -> u32 {
    (share * f64::from(VALUES)).ceil().max(4.0) as u32
}
