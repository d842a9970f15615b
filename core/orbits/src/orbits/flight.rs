//! The oscillator between two impacts, in closed form, with its derivatives.
//!
//! `x'' + 2 d x' + x = p sin(phase) + q cos(phase)`, equation (1), with `2 d = eps lambda`. With the
//! steady motion `X(phase)`, `V = Omega X'` and the impulse response `g` of the free oscillator,
//!
//! `x(s) = X(phase + Omega s) + a (x - X) + g (v - V)`, `v(s) = V(phase + Omega s) - g (x - X) + g' (v - V)`,
//!
//! `a = g' + 2 d g`; friction, a constant force, shifts `x` and `X`. Valid wherever a steady motion exists: everywhere but for an undamped oscillator
//! driven exactly at its natural frequency.

use nalgebra::{Matrix2, Vector2};

use super::OrbitError;
use super::equations::{REPEATED_DISPLACEMENT, REPEATED_VELOCITY};
use crate::operation_count::{self, ELEMENTARY};
use crate::system::System;

/// Frequency ratio from which on half an excitation period is less than a quarter of the oscillator's own.
const FAR_ABOVE: f64 = 2.0;

/// The oscillator of a system, ready to be propagated. Pairs are displacement and velocity, over the
/// clearance, in fast time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrbitFlight {
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

/// A displacement with its derivatives by fast time, over the clearance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Derivatives {
    /// Displacement.
    pub x: f64,
    /// Velocity.
    pub v: f64,
    /// Acceleration.
    pub a: f64,
    /// Its rate.
    pub jerk: f64,
}

/// The oscillator from a moment on: its steady motion, and the free motion beside it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Course {
    flight: OrbitFlight,
    phase: f64,
    /// Constant force, which shifts the place about which the free motion is.
    push: f64,
    /// Deviation from the steady motion about that place at the beginning.
    deviation: Vector2<f64>,
}

/// Where a course leads, and how that depends on where it began.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arrival {
    /// The motion at the end.
    pub at: Derivatives,
    /// Derivative of the end by the phase at the beginning.
    pub by_phase: Vector2<f64>,
    /// Derivatives by displacement and velocity at the beginning.
    pub by_start: Matrix2<f64>,
    /// Derivative by the forcing `gamma`.
    pub by_forcing: Vector2<f64>,
    /// Derivative by `Omega`, the duration and the phase at the beginning being fixed.
    pub by_frequency: Vector2<f64>,
}

impl OrbitFlight {
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

    /// `2 d = eps lambda`, twice the decay rate per unit of fast time.
    pub fn damping(&self) -> f64 {
        2.0 * self.decay
    }

    /// Coefficients of `sin` and `cos` of the phase in the steady motion.
    pub fn steady(&self) -> [f64; 2] {
        self.steady
    }

    /// `Omega`.
    pub fn frequency(&self) -> f64 {
        self.frequency
    }

    /// The steady motion at a phase.
    pub fn steady_at(&self, phase: f64) -> Vector2<f64> {
        operation_count::note(2 * ELEMENTARY + 7);
        let (sin, cos) = libm::sincos(phase);
        let [s, c] = self.steady;
        Vector2::new(s * sin + c * cos, self.frequency * (s * cos - c * sin))
    }

    /// Free motion over `s`, whatever the damping: `(x, v) -> (a x + g v, -g x + g' v)`.
    pub fn free(&self, s: f64) -> Matrix2<f64> {
        operation_count::note(3 * ELEMENTARY + 14);
        let d = self.decay;
        let discriminant = (1.0 - d) * (1.0 + d);
        if discriminant > 0.0 {
            let ringing = discriminant.sqrt();
            let envelope = libm::exp(-d * s);
            let (sin, cos) = libm::sincos(ringing * s);
            let impulse = envelope * if ringing * s == 0.0 { s } else { sin / ringing };
            let impulse_rate = envelope * cos - d * impulse;
            return Matrix2::new(impulse_rate + 2.0 * d * impulse, impulse, -impulse, impulse_rate);
        }
        // The slow rate is the reciprocal of the fast one, and their sum is 2 d: no difference of large numbers.
        let spread = (-discriminant).sqrt();
        let (fast, slow) = (d + spread, 1.0 / (d + spread));
        let (envelope, faded) = (libm::exp(-slow * s), libm::exp(-fast * s));
        let impulse = if spread == 0.0 {
            envelope * s
        } else {
            -envelope * libm::expm1(-2.0 * spread * s) / (2.0 * spread)
        };
        Matrix2::new(faded + fast * impulse, impulse, -impulse, faded - slow * impulse)
    }

    /// `g` and `1 + g'` after half an excitation period. Near resonance both are small, and are formed
    /// before anything is rounded; far above it is `g`, as little has happened yet.
    pub fn half_period_response(&self) -> [f64; 2] {
        let d = self.decay;
        let s = std::f64::consts::PI / self.frequency;
        let discriminant = (1.0 - d) * (1.0 + d);
        let (impulse, rate_plus_one) = if discriminant > 0.0 && self.frequency < FAR_ABOVE {
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
            (free[(0, 1)], free[(1, 1)] + 1.0)
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

    /// `(Phi + I)^-1 (1, 0)`, the same of a jump in the displacement.
    pub(super) fn repeated_displacement(&self) -> [f64; 2] {
        let [impulse, rate_plus_one] = self.half_period_response();
        let held = rate_plus_one + 2.0 * self.decay * impulse;
        let scale = held * rate_plus_one + impulse * impulse;
        [rate_plus_one / scale, impulse / scale]
    }

    /// The course from a displacement and velocity at `phase` on.
    pub fn course(&self, phase: f64, start: Vector2<f64>) -> Course {
        Course { flight: *self, phase, push: 0.0, deviation: start - self.steady_at(phase) }
    }

    /// Largest force of the excitation, per unit of mass.
    pub fn force(&self) -> f64 {
        let [s, c] = self.steady;
        let omega = self.frequency;
        let stiffness = (1.0 - omega) * (1.0 + omega);
        libm::hypot(s, c) * libm::hypot(stiffness, 2.0 * self.decay * omega)
    }

    /// Largest acceleration of the free motion that begins so.
    fn largest_acceleration(&self, free: Vector2<f64>) -> f64 {
        let d = self.decay;
        // Displacement and velocity squared never grow together.
        let of_energy = (1.0 + 2.0 * d) * libm::hypot(free.x, free.y);
        if d <= 1.0 {
            return of_energy;
        }
        let spread = ((d - 1.0) * (d + 1.0)).sqrt();
        let (fast, slow) = (d + spread, 1.0 / (d + spread));
        // Of the two parts, each of which only fades.
        let slowly = (fast * free.x + free.y).abs() * slow * slow;
        let fastly = (slow * free.x + free.y).abs() * fast * fast;
        of_energy.min((slowly + fastly) / (2.0 * spread))
    }

    /// Derivative of the steady motion by `Omega` at a fixed phase.
    fn shifted(&self, phase: f64) -> Vector2<f64> {
        operation_count::note(2 * ELEMENTARY + 12);
        let (sin, cos) = libm::sincos(phase);
        let [s, c] = self.steady;
        let [ds, dc] = self.steady_by_frequency;
        Vector2::new(
            ds * sin + dc * cos,
            (s * cos - c * sin) + self.frequency * (ds * cos - dc * sin),
        )
    }

    /// `d(X, V)/d(phase) = (V / Omega, -Omega X)` of the steady motion.
    fn turned(&self, steady: Vector2<f64>) -> Vector2<f64> {
        Vector2::new(steady.y / self.frequency, -self.frequency * steady.x)
    }

    /// The motion of which the steady and the free part are known.
    fn motion(&self, steady: Vector2<f64>, free: Vector2<f64>) -> Derivatives {
        operation_count::note(22);
        let (omega, damping) = (self.frequency, self.damping());
        let free_a = -damping * free.y - free.x;
        Derivatives {
            x: steady.x + free.x,
            v: steady.y + free.y,
            a: free_a - omega * omega * steady.x,
            jerk: -damping * free_a - free.y - omega * omega * steady.y,
        }
    }
}

impl Derivatives {
    /// The same motion about another place.
    fn shifted(self, by: f64) -> Self {
        Self { x: self.x + by, ..self }
    }
}

impl Course {
    /// The same under a constant force besides, per unit of mass.
    #[must_use]
    pub fn pushed(self, push: f64) -> Self {
        Self { push, deviation: self.deviation - Vector2::new(push, 0.0), ..self }
    }

    /// The constant force.
    pub(super) fn push(&self) -> f64 {
        self.push
    }

    /// The motion after a time `s`, by equation (1).
    pub fn at(&self, s: f64) -> Derivatives {
        let steady = self.flight.steady_at(self.phase + self.flight.frequency * s);
        self.flight.motion(steady, self.flight.free(s) * self.deviation).shifted(self.push)
    }

    /// The motion after a time `s`, and a bound on its acceleration from then on: that of the steady motion, and of the free
    /// motion, which only fades.
    pub(super) fn bounded(&self, s: f64) -> (Derivatives, f64) {
        let Self { flight, .. } = self;
        let steady = flight.steady_at(self.phase + flight.frequency * s);
        let free = flight.free(s) * self.deviation;
        let driven =
            flight.frequency * flight.frequency * libm::hypot(flight.steady[0], flight.steady[1]);
        (flight.motion(steady, free).shifted(self.push), driven + flight.largest_acceleration(free))
    }

    /// The motion after each of `count` steps of equal length, with one sine, cosine and exponential for
    /// all: rounding grows by a unit in the last place with each.
    pub(super) fn at_steps(
        &self,
        step: f64,
        count: u32,
    ) -> impl Iterator<Item = Derivatives> + use<> {
        let Self { flight, phase, push, mut deviation } = *self;
        let propagator = flight.free(step);
        operation_count::note(2 * ELEMENTARY);
        let (sin, cos) = libm::sincos(flight.frequency * step);
        let omega = flight.frequency;
        let mut steady = flight.steady_at(phase);
        (0..count).map(move |_| {
            operation_count::note(14);
            deviation = propagator * deviation;
            steady = Vector2::new(
                cos * steady.x + sin / omega * steady.y,
                cos * steady.y - omega * sin * steady.x,
            );
            flight.motion(steady, deviation).shifted(push)
        })
    }
    /// Where the course leads in a time `s`, with all derivatives.
    pub fn arrival(&self, s: f64) -> Arrival {
        operation_count::note(48);
        let Self { flight, phase, .. } = self;
        let end = phase + flight.frequency * s;
        let by_start = flight.free(s);
        let [before, after] = [*phase, end].map(|phase| flight.steady_at(phase));
        let forced = after - by_start * before;
        Arrival {
            at: flight.motion(after, by_start * self.deviation).shifted(self.push),
            by_phase: flight.turned(after) - by_start * flight.turned(before),
            by_start,
            by_forcing: if flight.forcing > 0.0 {
                forced / flight.forcing
            } else {
                Vector2::zeros()
            },
            by_frequency: flight.shifted(end) + flight.turned(after) * s
                - by_start * flight.shifted(*phase),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{Cavity, Excitation, Parameters};

    #[test]
    fn steps_lead_where_the_closed_form_does() {
        for (damping, frequency_ratio) in [(1.8, 0.96), (0.0, 3.0), (400.0, 0.2)] {
            let system = System::new(Parameters {
                mass_ratio: 0.01,
                damping,
                restitution: 0.6,
                frequency_ratio,
                forcing_per_clearance: 3.0,
                excitation: Excitation::BaseDisplacement,
                cavity: Cavity::IDEAL,
            });
            let flight = OrbitFlight::of(&system.expect("valid")).expect("a steady motion");
            let course = flight.course(0.7, Vector2::new(-0.4, 0.9));
            for (k, found) in course.at_steps(0.05, 400).enumerate() {
                let exact = course.at(0.05 * (k + 1) as f64);
                // Each step rounds a few times, and what has gone wrong is carried on.
                let rounding = 1e-15 * (k + 1) as f64 * (1.0 + damping);
                for (a, b) in [
                    (found.x, exact.x),
                    (found.v, exact.v),
                    (found.a, exact.a),
                    (found.jerk, exact.jerk),
                ] {
                    assert!((a - b).abs() < rounding, "{damping} {k}: {a} {b}");
                }
            }
        }
    }
}
