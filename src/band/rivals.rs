//! What else could be done: nothing, or a tuned mass damper of the same mass.

use nalgebra::Complex;
use serde::Serialize;

use super::Band;
use crate::case::BandOver;
use crate::numerics::scan::largest;
use crate::system::System;

/// The tuned mass damper of Den Hartog (Mechanical Vibrations, 4th ed., section 3.3): for an undamped
/// oscillator driven by a force, tuning and damping that make the two fixed points of its response
/// equally high and the response nearly flat there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TunedMassDamper {
    /// Natural frequency over the oscillator's: `1/(1 + mu)`.
    pub tuning: f64,
    /// Damping ratio: `sqrt(3 mu/(8 (1 + mu)^3))`.
    pub damping_ratio: f64,
}

impl TunedMassDamper {
    /// The best one of mass ratio `mu`.
    pub fn best(mass_ratio: f64) -> Self {
        let total = 1.0 + mass_ratio;
        Self {
            tuning: 1.0 / total,
            damping_ratio: (3.0 * mass_ratio / (8.0 * total * total * total)).sqrt(),
        }
    }

    /// Amplitude of the oscillator that carries it instead of the absorber, over the system's
    /// clearance; `None` where nothing limits it.
    pub fn amplitude(&self, system: &System) -> Option<f64> {
        let omega = system.frequency_ratio();
        let mu = system.mass_ratio();
        let (sine, cosine) = system.excitation_amplitudes();
        // What the damper's mass does to the oscillator, as a dynamic mass.
        let spring = self.tuning * self.tuning;
        let coupling = Complex::new(spring, 2.0 * self.damping_ratio * self.tuning * omega);
        let dynamic_mass = mu * coupling / (coupling - omega * omega);
        let loss = mu * system.damping() * omega;
        let stiffness = Complex::new(1.0 - omega * omega, loss) - omega * omega * dynamic_mass;
        let amplitude = libm::hypot(sine, cosine) / libm::hypot(stiffness.re, stiffness.im);
        amplitude.is_finite().then_some(amplitude)
    }
}

/// Amplitude of the oscillator alone, over the system's clearance; `None` where nothing limits it.
pub fn bare_amplitude(system: &System) -> Option<f64> {
    system.linear_response().map(|response| response.amplitude())
}

/// Pieces of a band in which a rival's largest amplitude is looked for: a resonance has a few hundredths
/// of its frequency as width.
const PIECES: u32 = 256;

/// Places over which amplitudes are averaged.
const AVERAGED: u32 = 1001;

/// What a rival's amplitude is like along a band, over the clearance; infinite where nothing limits it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Rival {
    /// The largest.
    pub largest: f64,
    /// The average.
    pub mean: f64,
}

impl Rival {
    /// That of an amplitude along a band.
    pub fn along(band: &Band, amplitude: impl Fn(&System) -> Option<f64>) -> Self {
        let there = |at: f64| band.system(at).ok().and_then(|system| amplitude(&system));
        let sum: f64 = band.places(AVERAGED).map(|at| there(at).unwrap_or(f64::INFINITY)).sum();
        let largest = largest_along(band, &amplitude);
        let mean = if largest.is_finite() { sum / f64::from(AVERAGED) } else { f64::INFINITY };
        Self { largest, mean }
    }
}

/// The largest amplitudes along a band of the bare oscillator and of one with the best tuned mass damper
/// of the absorber's mass, over the clearance; infinite where nothing limits them.
pub fn largest_amplitudes(band: &Band) -> [f64; 2] {
    let damper = TunedMassDamper::best(band.base.mass_ratio());
    [largest_along(band, bare_amplitude), largest_along(band, |system| damper.amplitude(system))]
}

fn largest_along(band: &Band, amplitude: impl Fn(&System) -> Option<f64>) -> f64 {
    let there = |at: f64| band.system(at).ok().map(|s| amplitude(&s).unwrap_or(f64::INFINITY));
    let found = largest(band.range, PIECES, there).map_or(f64::INFINITY, |(_, value)| value);
    // Without damping nothing limits the bare oscillator at one frequency, which no scan meets.
    let [from, to] = band.range;
    let resonates = band.over == BandOver::Frequency && from <= 1.0 && 1.0 <= to;
    if resonates { there(1.0).map_or(found, |there| found.max(there)) } else { found }
}

/// Reduction in decibels of an amplitude against another: positive where it is smaller.
pub fn reduction_db(amplitude: f64, against: f64) -> f64 {
    20.0 * libm::log10(against / amplitude)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{Excitation, Parameters};

    /// Den Hartog's own check: without damping of the oscillator the response at both fixed points is
    /// `sqrt(1 + 2/mu)` times the static one, whatever the damper's damping.
    #[test]
    fn the_fixed_points_are_as_high_as_den_hartog_says() {
        for mu in [0.01, 0.05, 0.25] {
            let damper = TunedMassDamper::best(mu);
            let height = (1.0 + 2.0 / mu).sqrt();
            // Fixed points: g^2 = (1 -+ sqrt(mu/(2 + mu)))/(1 + mu).
            for sign in [-1.0, 1.0] {
                let squared = (1.0 + sign * (mu / (2.0 + mu)).sqrt()) / (1.0 + mu);
                let system = System::new(Parameters {
                    mass_ratio: mu,
                    damping: 0.0,
                    restitution: 0.6,
                    frequency_ratio: squared.sqrt(),
                    // A static displacement of 1: eps gamma = 1.
                    forcing_per_clearance: 1.0 / mu,
                    excitation: Excitation::Force,
                })
                .expect("valid");
                for factor in [0.3, 1.0, 4.0] {
                    let other =
                        TunedMassDamper { damping_ratio: factor * damper.damping_ratio, ..damper };
                    let amplitude = other.amplitude(&system).expect("it is damped");
                    assert!((amplitude / height - 1.0).abs() < 1e-12, "{mu} {sign} {factor}");
                }
            }
        }
    }

    #[test]
    fn half_the_amplitude_is_six_decibels() {
        assert!((reduction_db(0.5, 1.0) - 6.020_599_913_279_624).abs() < 1e-12);
    }
}
