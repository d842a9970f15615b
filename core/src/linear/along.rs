//! Where along a band of excitations a structure without the absorber moves farthest, alone or with a tuned mass damper.
//! Amplitudes are closed forms in the frequency ratio; their largest value is looked for at even places, at ever closer
//! ones around a narrow resonance, and narrowed down.

use serde::Serialize;

use super::{TunedMassDamper, bare_amplitude};
use crate::numerics::scan::{largest_of, narrow, places};
use crate::system::{Band, BandOver, System};

/// Pieces of a band in which a rival's largest amplitude is looked for: a resonance has a few hundredths
/// of its frequency as width.
const PIECES: u32 = 256;

/// Part of the highest value from which on a peak is looked at as well.
const ALMOST: f64 = 0.9;
/// Relative difference up to which two largest values are one: some roundings.
const SAME: f64 = 4e-15;
/// Ratio of distances of places around a narrow resonance, down to this part of its width; no resonance is narrower than
/// the last.
const CLOSER: f64 = 0.5;
const PART_OF_WIDTH: f64 = 0.25;
const NARROWEST: f64 = 1e-14;

/// The largest values along a band of a structure with a tuned mass damper, over the clearance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Damped {
    /// Amplitude of the structure.
    pub amplitude: f64,
    /// Where.
    pub at: f64,
    /// Displacement of the damper's mass against the structure.
    pub stroke: f64,
}

/// Where the structure alone moves farthest along a band, and how far.
pub fn bare_along(band: &Band) -> (f64, f64) {
    BandSystems::of(band).largest(bare_amplitude)
}

/// Places around a resonance that is narrower than a piece of the band, ever closer ones down to its width; none in other
/// bands.
fn near_resonance(band: &Band) -> Vec<f64> {
    let [from, to] = band.range;
    let (piece, system) = ((to - from) / f64::from(PIECES), &band.base);
    if band.over != BandOver::Frequency || !(from <= 1.0 && 1.0 <= to) {
        return Vec::new();
    }
    // A damper's two resonances are the square root of its mass apart.
    let damping = system.mass_ratio() * system.damping();
    let width = damping.min(system.mass_ratio().sqrt()).max(NARROWEST);
    let mut found = Vec::new();
    let mut distance = piece;
    while distance > PART_OF_WIDTH * width {
        distance *= CLOSER;
        found.extend([1.0 - distance, 1.0 + distance]);
    }
    found.retain(|at| (from..=to).contains(at));
    found
}

/// A band with its systems at even places, at which many amplitudes are asked for.
pub struct BandSystems<'a> {
    /// The band.
    pub band: &'a Band,
    systems: Vec<(f64, System)>,
}

impl<'a> BandSystems<'a> {
    /// Its systems at even places and closer ones around resonance.
    pub fn of(band: &'a Band) -> Self {
        let system = |at: f64| Some((at, band.system(at).ok()?));
        let mut all: Vec<f64> = places(band.range, PIECES).collect();
        all.extend(near_resonance(band));
        all.sort_by(f64::total_cmp);
        Self { band, systems: all.into_iter().filter_map(system).collect() }
    }

    /// Where an amplitude is largest, `Omega` or an amplitude over the base system's own, and that amplitude over the
    /// clearance.
    pub fn largest(&self, amplitude: impl Fn(&System) -> f64) -> (f64, f64) {
        let there = |at: f64| self.band.system(at).ok().map(|system| amplitude(&system));
        let [from, to] = self.band.range;
        let tried = self.systems.iter().map(|(at, system)| (*at, amplitude(system)));
        let tried: Vec<(f64, f64)> = tried.collect();
        let all = tried.iter().copied();
        let found = largest_of(all, [from, to], PIECES, there).unwrap_or((from, f64::INFINITY));
        let resonates = self.band.over == BandOver::Frequency && from <= 1.0 && 1.0 <= to;
        let mut best = match there(1.0).filter(|resonant| resonates && *resonant > found.1) {
            Some(resonant) => (1.0, resonant),
            None => found,
        };
        // Of peaks that are almost as high, as the two of a damper, another may be the higher one in truth; and one among close
        // places is narrower than a piece.
        let highest = tried.iter().map(|(_, value)| *value).fold(0.0, f64::max);
        for three in tried.windows(3).filter(|_| !self.band.is_point()) {
            let [(before, left), (_, middle), (after, right)] = [three[0], three[1], three[2]];
            if middle < left || middle < right || !middle.is_finite() || middle < ALMOST * highest {
                continue;
            }
            narrow([before, after], |at| {
                let value = there(at).unwrap_or(f64::NEG_INFINITY);
                if value > best.1 * (1.0 + SAME) {
                    best = (at, value);
                }
                Some(value)
            });
        }
        best
    }

    /// Largest amplitude and stroke with a tuned mass damper, over the clearance.
    pub fn damped(&self, damper: TunedMassDamper) -> Damped {
        let (at, amplitude) = self.largest(|system| damper.amplitude(system));
        let (_, stroke) = self.largest(|system| damper.stroke(system));
        Damped { amplitude, at, stroke }
    }
}

impl TunedMassDamper {
    /// What it comes to along a band.
    pub fn along(self, band: &Band) -> Damped {
        BandSystems::of(band).damped(self)
    }
}
