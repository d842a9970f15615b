//! The motion that a point of the manifold stands for, equations (3), (11), (12).

use std::f64::consts::{FRAC_2_PI, PI};

use super::FixedPoint;
use crate::operation_count;
use crate::system::{State, System};

/// The state at excitation phase 0 on the leading-order motion of a fixed point:
/// `v0 = C sin(Omega tau - eta)`, `w0 = v0 + (2/pi) B Pi(Omega tau - eta + Theta)`, from which
/// `x = (v + eps w)/(1 + eps)`, `y = (v - w)/(1 + eps)`. Off the true orbit by a multiple of `eps`;
/// the relative displacement is kept within the cavity.
pub fn state_of(point: &FixedPoint, system: &System) -> State {
    let eps = system.mass_ratio();
    let omega = system.frequency_ratio();
    let (sin, cos) = libm::sincos(-point.eta);
    let v = [point.oscillator_amplitude * sin, point.oscillator_amplitude * omega * cos];
    let sawtooth = point.absorber_phase - point.eta;
    let (folded, direction) = fold(sawtooth);
    let w = [
        (v[0] + FRAC_2_PI * point.absorber_amplitude * folded).clamp(-1.0, 1.0),
        v[1] + FRAC_2_PI * point.absorber_amplitude * omega * direction,
    ];
    let x = [(v[0] + eps * w[0]) / (1.0 + eps), (v[1] + eps * w[1]) / (1.0 + eps)];
    State { x: x[0], x_velocity: x[1], y: x[0] - w[0], y_velocity: x[1] - w[1] }
}

/// Root mean square displacement of the oscillator, over the clearance, on the motion with the
/// amplitudes `C/b`, `B/b` and the phase `Theta`: with `k = eps/(1 + eps)` it is
/// `x = C sin z + k (2/pi) B Pi(z + Theta)`, whose mean square is
/// `C^2/2 + k (8/pi^2) B C cos Theta + k^2 B^2/3`. Off the true orbit by a multiple of `eps`.
pub fn root_mean_square(system: &System, oscillator: f64, absorber: f64, theta: f64) -> f64 {
    operation_count::note(operation_count::ELEMENTARY + 16);
    let share = system.mass_ratio() / (1.0 + system.mass_ratio());
    let joint = 8.0 / (PI * PI) * share * absorber * oscillator * libm::cos(theta);
    let own = share * share * absorber * absorber / 3.0;
    (0.5 * oscillator * oscillator + joint + own).sqrt()
}

/// `Pi(z) = arcsin(sin z)` and its derivative, equation (13).
fn fold(z: f64) -> (f64, f64) {
    let turned = (z + 0.5 * PI).rem_euclid(2.0 * PI);
    if turned < PI { (turned - 0.5 * PI, 1.0) } else { (1.5 * PI - turned, -1.0) }
}

/// Amplitudes and phases of the theory, at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlowVariables {
    /// `C/b`: amplitude of `v = x + eps y`.
    pub oscillator_amplitude: f64,
    /// `B/b = (pi^2/8) E/b`, where `E` is the amplitude of `w - v = -(1 + eps) y`.
    pub absorber_amplitude: f64,
    /// `eta`.
    pub eta: f64,
    /// `Theta`.
    pub absorber_phase: f64,
}

/// Reads `C`, `B`, `eta`, `Theta` off the first harmonics (coefficients of `sin` and `cos` of the
/// excitation's phase) of oscillator and absorber.
pub fn read_off(system: &System, oscillator: [f64; 2], absorber: [f64; 2]) -> SlowVariables {
    let eps = system.mass_ratio();
    let v = [oscillator[0] + eps * absorber[0], oscillator[1] + eps * absorber[1]];
    let sawtooth = [-(1.0 + eps) * absorber[0], -(1.0 + eps) * absorber[1]];
    let phase = |harmonic: [f64; 2]| libm::atan2(harmonic[1], harmonic[0]);
    SlowVariables {
        oscillator_amplitude: libm::hypot(v[0], v[1]),
        absorber_amplitude: PI * PI / 8.0 * libm::hypot(sawtooth[0], sawtooth[1]),
        eta: -phase(v),
        absorber_phase: wrapped(phase(sawtooth) - phase(v)),
    }
}

/// An angle in `(-pi, pi]`.
pub fn wrapped(angle: f64) -> f64 {
    let turned = angle.rem_euclid(2.0 * PI);
    if turned > PI { turned - 2.0 * PI } else { turned }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sawtooth_is_the_folded_sine() {
        for k in -40..40 {
            let z = f64::from(k) * 0.17;
            let (value, slope) = fold(z);
            assert!((value - libm::asin(libm::sin(z))).abs() < 1e-13, "{z}");
            assert_eq!(slope, libm::cos(z).signum());
        }
    }
}
