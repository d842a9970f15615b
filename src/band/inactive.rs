//! The absorber that never wakes: where the structure alone does not move as far as the clearance, an
//! absorber at rest may stay at rest, and the structure then vibrates as if it had none.
//!
//! From rest the structure's displacement is its steady motion and a free one that decays,
//! `x = Re(S e^{i Omega tau}) + Re(H e^{(i omega_d - zeta) tau})`. With `X` the largest displacement on the
//! way, an absorber that rests within `b - X` of the middle of its cavity is never touched: a share
//! `1 - X/b` of its resting places.

use nalgebra::Complex;
use serde::Serialize;

use super::Band;
use crate::numerics::scan::largest;
use crate::system::System;

/// Share of the resting places below which nobody will meet the inactive absorber.
const NEGLIGIBLE: f64 = 0.01;
/// Phases of one beat between the steady and the free motion at which its envelope is evaluated: the
/// largest of them is then below the true one by at most 1 - cos(pi/256), 1e-4 of the free part.
const PHASES: u32 = 128;
/// Pieces of a band in which the largest amplitude is looked for before it is narrowed down.
const PIECES: u32 = 512;

/// The motion with an absorber that stays at rest. Lengths over the clearance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Inactive {
    /// Amplitude of the structure.
    pub amplitude: f64,
    /// Share of the absorber's resting places from which a start from rest stays in this motion: `1 - X/b`.
    pub share: f64,
}

impl Inactive {
    /// That of a system; `None` where every start from rest wakes the absorber, but for a negligible share.
    pub fn of(system: &System) -> Option<Self> {
        let steady = system.linear_response()?;
        let [zeta, omega] =
            [0.5 * system.mass_ratio() * system.damping(), system.frequency_ratio()];
        let start = steady.state(system);
        let forced = Complex::new(start.x, -start.x_velocity / omega);
        if forced.norm() >= 1.0 {
            return None;
        }
        // An overdamped structure has no free oscillation; its free motion is never larger than this.
        let natural = (1.0 - zeta * zeta).max(0.0).sqrt();
        let free = match natural {
            0.0 => forced.norm(),
            _ => libm::hypot(start.x, (zeta * start.x - start.x_velocity) / natural),
        };
        let largest = largest_from_rest(forced.norm(), free, zeta, (natural - omega).abs());
        // Without damping the free part stays.
        let amplitude = if zeta == 0.0 { largest } else { forced.norm() };
        let share = 1.0 - largest;
        (share > NEGLIGIBLE).then_some(Self { amplitude, share })
    }
}

/// Largest value of the envelope `|S + H e^{(i beat - zeta) tau}|` of a motion that begins at 0, `H`
/// opposite to `S`. It exceeds the largest displacement by what the fast phase leaves, which vanishes
/// near resonance: on the safe side.
fn largest_from_rest(forced: f64, free: f64, zeta: f64, beat: f64) -> f64 {
    let envelope = |k: u32| {
        let phase = std::f64::consts::TAU * f64::from(k) / f64::from(PHASES);
        let left = free * libm::exp(-zeta * phase / beat.max(f64::MIN_POSITIVE));
        let (sine, cosine) = libm::sincos(phase);
        libm::hypot(forced - left * cosine, left * sine)
    };
    (1..=PHASES).map(envelope).fold(forced, f64::max)
}

/// Where along a band the structure with an inactive absorber vibrates most, and that motion; `None`
/// where the absorber always wakes.
pub fn worst(band: &Band) -> Option<(f64, Inactive)> {
    let there = |at: f64| Inactive::of(&band.system(at).ok()?);
    let (at, _) = largest_by(band, |at| there(at).map(|one| one.amplitude))?;
    Some((at, there(at)?))
}

/// Where along a band something of the inactive absorber's motion is largest, and that value.
pub fn largest_by(band: &Band, value: impl FnMut(f64) -> Option<f64>) -> Option<(f64, f64)> {
    largest(band.range, if band.is_point() { 1 } else { PIECES }, value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{Cavity, Excitation, Parameters};

    /// Largest displacement of the structure alone from rest, by steps of Runge and Kutta: 2 pi/0.02 steps
    /// a period, an error of 1e-6.
    fn largest_by_steps(system: &System) -> f64 {
        const STEP: f64 = 0.02;
        let damping = system.mass_ratio() * system.damping();
        let (sine, cosine) = system.excitation_amplitudes();
        let rate = |time: f64, [x, v]: [f64; 2]| {
            let (s, c) = libm::sincos(system.frequency_ratio() * time);
            [v, sine * s + cosine * c - damping * v - x]
        };
        let after =
            |[x, v]: [f64; 2], [dx, dv]: [f64; 2], step: f64| [x + step * dx, v + step * dv];
        let (mut state, mut largest): ([f64; 2], f64) = ([0.0; 2], 0.0);
        for k in 0..100_000 {
            let time = STEP * f64::from(k);
            let a = rate(time, state);
            let b = rate(time + 0.5 * STEP, after(state, a, 0.5 * STEP));
            let c = rate(time + 0.5 * STEP, after(state, b, 0.5 * STEP));
            let d = rate(time + STEP, after(state, c, STEP));
            let mean = [0, 1].map(|k| (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]) / 6.0);
            state = after(state, mean, STEP);
            largest = largest.max(state[0].abs());
        }
        largest
    }

    #[test]
    fn the_share_of_resting_places_is_what_the_largest_displacement_from_rest_leaves() {
        for (zeta, omega, excitation) in [
            (0.004, 1.0, Excitation::Force),
            (0.004, 0.99, Excitation::Force),
            (0.01, 1.013, Excitation::BaseDisplacement),
            (0.02, 0.9, Excitation::BaseDisplacement),
            (0.0, 0.97, Excitation::Force),
        ] {
            let parameters = Parameters {
                mass_ratio: 0.01,
                damping: 2.0 * zeta / 0.01,
                restitution: 0.6,
                frequency_ratio: omega,
                forcing_per_clearance: 1e-3,
                excitation,
                cavity: Cavity::IDEAL,
            };
            let system = System::new(parameters).expect("valid");
            let half =
                system.with_clearance_scaled(2.0 * largest_by_steps(&system)).expect("valid");
            let found = Inactive::of(&half).expect("half of the places stay");
            // The envelope lies above the motion by what the fast phase leaves: 2 % so near resonance.
            assert!((found.share - 0.5).abs() < 0.01, "{zeta} {omega}: {found:?}");
            let steady = half.linear_response().expect("steady").amplitude();
            let amplitude = if zeta == 0.0 { 0.5 } else { steady };
            assert!((found.amplitude / amplitude - 1.0).abs() < 0.02, "{zeta} {omega}: {found:?}");
            let narrow = half.with_clearance_scaled(0.5).expect("valid");
            assert_eq!(Inactive::of(&narrow), None, "the wall reaches every place");
        }
    }
}
