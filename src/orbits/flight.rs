//! The oscillator between two impacts, in closed form, with its derivatives.
//!
//! `x'' + 2 d x' + x = p sin(phase) + q cos(phase)`, equation (1), with `2 d = eps lambda`. With the
//! steady motion `X(phase)`, `V = Omega X'` and the impulse response `g` of the free oscillator,
//!
//! `x(s) = X(phase + Omega s) + a (x - X) + g (v - V)`, `v(s) = V(phase + Omega s) - g (x - X) + g' (v - V)`,
//!
//! `a = g' + 2 d g`. Valid wherever a steady motion exists: everywhere but for an undamped oscillator
//! driven exactly at its natural frequency.

use super::OrbitError;
use super::equations::{REPEATED_DISPLACEMENT, REPEATED_VELOCITY};
use crate::operation_count::{self, ELEMENTARY};
use crate::system::System;

/// The oscillator of a system, ready to be propagated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flight {
    /// Half the damping coefficient, `d = eps lambda / 2`.
    decay: f64,
    /// `Omega`.
    frequency: f64,
    /// Steady motion over the clearance, coefficients of `sin` and `cos` of the phase.
    steady: [f64; 2],
    /// Derivative of `steady` by `Omega`.
    steady_by_frequency: [f64; 2],
    /// `gamma`.
    forcing: f64,
}

/// Displacement and velocity, over the clearance, fast time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kinematics {
    /// Displacement.
    pub x: f64,
    /// Velocity.
    pub v: f64,
}

/// Free motion of the oscillator over a time: `(x, v) -> (a x + g v, -g x + g' v)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Free {
    /// `a = g' + 2 d g`.
    pub keep: f64,
    /// `g`, the impulse response.
    pub impulse: f64,
    /// `g'`.
    pub impulse_rate: f64,
}

/// Where a flight ends, and how that depends on where it began.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arrival {
    /// Displacement and velocity at the end.
    pub at: Kinematics,
    /// Acceleration at the end.
    pub acceleration: f64,
    /// Derivatives of the displacement by phase, displacement and velocity at the beginning.
    pub x_by_start: [f64; 3],
    /// The same for the velocity.
    pub v_by_start: [f64; 3],
    /// Derivatives of both by the forcing `gamma`.
    pub by_forcing: Kinematics,
    /// Derivatives of both by `Omega`, the duration and the phase at the beginning being fixed.
    pub by_frequency: Kinematics,
}

impl Flight {
    /// The oscillator of `system`.
    ///
    /// # Errors
    /// [`OrbitError::NoSteadyMotion`] for an undamped oscillator driven at its natural frequency.
    pub fn of(system: &System) -> Result<Self, OrbitError> {
        let linear = system.linear_response().ok_or(OrbitError::NoSteadyMotion)?;
        let steady = [linear.sine, linear.cosine];
        Ok(Self {
            decay: 0.5 * system.mass_ratio() * system.damping(),
            frequency: system.frequency_ratio(),
            steady,
            steady_by_frequency: steady_by_frequency(system, steady),
            forcing: system.forcing_per_clearance(),
        })
    }

    /// The same oscillator under another forcing `gamma`; the present one must not be 0.
    pub fn with_forcing(&self, forcing: f64) -> Self {
        let factor = forcing / self.forcing;
        Self {
            steady: self.steady.map(|part| part * factor),
            steady_by_frequency: self.steady_by_frequency.map(|part| part * factor),
            forcing,
            ..*self
        }
    }

    /// `2 d = eps lambda`.
    pub fn damping(&self) -> f64 {
        2.0 * self.decay
    }

    /// Coefficients of `sin` and `cos` of the phase in the steady motion.
    pub fn steady(&self) -> [f64; 2] {
        self.steady
    }

    /// The steady motion at a phase.
    pub fn steady_at(&self, phase: f64) -> Kinematics {
        operation_count::note(2 * ELEMENTARY + 7);
        let (sin, cos) = libm::sincos(phase);
        let [s, c] = self.steady;
        Kinematics { x: s * sin + c * cos, v: self.frequency * (s * cos - c * sin) }
    }

    /// Free motion over `s`, whatever the damping.
    pub fn free(&self, s: f64) -> Free {
        operation_count::note(3 * ELEMENTARY + 14);
        let d = self.decay;
        let discriminant = (1.0 - d) * (1.0 + d);
        let (impulse, impulse_rate) = if discriminant > 0.0 {
            let ringing = discriminant.sqrt();
            let envelope = libm::exp(-d * s);
            let (sin, cos) = libm::sincos(ringing * s);
            let impulse = envelope * if ringing * s == 0.0 { s } else { sin / ringing };
            (impulse, envelope * cos - d * impulse)
        } else {
            let spread = (-discriminant).sqrt();
            let envelope = libm::exp(-s / (d + spread));
            let impulse = if spread == 0.0 {
                envelope * s
            } else {
                -envelope * libm::expm1(-2.0 * spread * s) / (2.0 * spread)
            };
            (impulse, envelope - (d + spread) * impulse)
        };
        Free { keep: impulse_rate + 2.0 * d * impulse, impulse, impulse_rate }
    }

    /// `g` and `1 + g'` after half an excitation period. Near resonance both are small, and are formed
    /// before anything is rounded.
    pub fn half_period_response(&self) -> [f64; 2] {
        let d = self.decay;
        let s = std::f64::consts::PI / self.frequency;
        let discriminant = (1.0 - d) * (1.0 + d);
        let (impulse, rate_plus_one) = if discriminant > 0.0 {
            let ringing = discriminant.sqrt();
            // Angle of the free oscillation beyond half a turn.
            let beyond = s * ((1.0 - self.frequency) - d * d / (1.0 + ringing));
            let envelope = libm::exp(-d * s);
            let half = libm::sin(0.5 * beyond);
            let impulse = -envelope * libm::sin(beyond) / ringing;
            let one_minus = -libm::expm1(-d * s) + 2.0 * envelope * half * half;
            (impulse, one_minus - d * impulse)
        } else {
            let free = self.free(s);
            (free.impulse, free.impulse_rate + 1.0)
        };
        [impulse, rate_plus_one]
    }

    /// `(Phi + I)^-1 (0, 1)` for the free motion `Phi` over half an excitation period: what a motion
    /// that repeats with opposite sign keeps of an impulse.
    pub fn repeated_impulse(&self) -> [f64; 2] {
        let [impulse, rate_plus_one] = self.half_period_response();
        let parameters = [self.decay, impulse, rate_plus_one];
        [REPEATED_DISPLACEMENT.at(parameters), REPEATED_VELOCITY.at(parameters)]
    }

    /// Displacement and velocity a time `s` after `start` at `phase`.
    pub fn at(&self, phase: f64, start: Kinematics, s: f64) -> Kinematics {
        operation_count::note(12);
        let free = self.free(s);
        let before = self.steady_at(phase);
        let after = self.steady_at(phase + self.frequency * s);
        let (x, v) = (start.x - before.x, start.v - before.v);
        Kinematics {
            x: after.x + free.keep * x + free.impulse * v,
            v: after.v - free.impulse * x + free.impulse_rate * v,
        }
    }

    /// Acceleration at a phase, by equation (1).
    pub fn acceleration(&self, phase: f64, at: Kinematics) -> f64 {
        operation_count::note(8);
        let steady = self.steady_at(phase);
        let omega = self.frequency;
        -omega * omega * steady.x - 2.0 * self.decay * (at.v - steady.v) - (at.x - steady.x)
    }

    /// Bound on the acceleration's size for `horizon` of time after passing through `at`: the root
    /// of `v^2 + x^2` grows no faster than the largest force.
    pub fn acceleration_bound(&self, at: Kinematics, horizon: f64) -> f64 {
        operation_count::note(25);
        let [s, c] = self.steady;
        let omega = self.frequency;
        let stiffness = (1.0 - omega) * (1.0 + omega);
        let force = libm::hypot(s, c) * libm::hypot(stiffness, 2.0 * self.decay * omega);
        let size = libm::hypot(at.x, at.v) + force * horizon;
        force + (1.0 + 2.0 * self.decay) * size
    }

    /// Where a flight of length `s` ends, with all derivatives.
    pub fn arrival(&self, phase: f64, start: Kinematics, s: f64) -> Arrival {
        operation_count::note(60);
        let omega = self.frequency;
        let free = self.free(s);
        let before = self.steady_at(phase);
        let end = phase + omega * s;
        let after = self.steady_at(end);
        let (x, v) = (start.x - before.x, start.v - before.v);
        let at = Kinematics {
            x: after.x + free.keep * x + free.impulse * v,
            v: after.v - free.impulse * x + free.impulse_rate * v,
        };
        // d(X, V)/d(phase) = (V / Omega, -Omega X).
        let turn = |at: Kinematics| Kinematics { x: at.v / omega, v: -omega * at.x };
        let carried = |by: Kinematics| Kinematics {
            x: free.keep * by.x + free.impulse * by.v,
            v: -free.impulse * by.x + free.impulse_rate * by.v,
        };
        let less = |a: Kinematics, b: Kinematics| Kinematics { x: a.x - b.x, v: a.v - b.v };
        let by_phase = less(turn(after), carried(turn(before)));
        let forced = less(after, carried(before));
        let by_forcing = if self.forcing > 0.0 {
            Kinematics { x: forced.x / self.forcing, v: forced.v / self.forcing }
        } else {
            Kinematics { x: 0.0, v: 0.0 }
        };
        let (moved, turned) = (self.shifted(end), turn(after));
        let later = Kinematics { x: moved.x + s * turned.x, v: moved.v + s * turned.v };
        Arrival {
            at,
            acceleration: self.acceleration(end, at),
            x_by_start: [by_phase.x, free.keep, free.impulse],
            v_by_start: [by_phase.v, -free.impulse, free.impulse_rate],
            by_forcing,
            by_frequency: less(later, carried(self.shifted(phase))),
        }
    }

    /// Derivative of the steady motion by `Omega` at a fixed phase.
    fn shifted(&self, phase: f64) -> Kinematics {
        operation_count::note(2 * ELEMENTARY + 12);
        let (sin, cos) = libm::sincos(phase);
        let [s, c] = self.steady;
        let [ds, dc] = self.steady_by_frequency;
        Kinematics {
            x: ds * sin + dc * cos,
            v: (s * cos - c * sin) + self.frequency * (ds * cos - dc * sin),
        }
    }
}

/// With `Z = (1 - Omega^2) + i 2 d Omega` the steady motion is `F / Z` for the forcing
/// `F = p + i q`, hence its derivative `(F' - X Z') / Z`.
fn steady_by_frequency(system: &System, [s, c]: [f64; 2]) -> [f64; 2] {
    let omega = system.frequency_ratio();
    let damping = system.mass_ratio() * system.damping();
    let (_, q) = system.excitation_amplitudes();
    // Only the damper's share of the excitation depends on the frequency, in proportion.
    let forcing_rate = q / omega;
    let (re, im) = ((1.0 - omega) * (1.0 + omega), damping * omega);
    let (re_rate, im_rate) = (-2.0 * omega, damping);
    // X = s + i c solves X Z = p + i q when the product's imaginary part follows linear_response.
    let top = [-(s * re_rate - c * im_rate), forcing_rate - (c * re_rate + s * im_rate)];
    let scale = re * re + im * im;
    [(top[0] * re + top[1] * im) / scale, (top[1] * re - top[0] * im) / scale]
}
