//! Closed-form motion of the linear oscillator between events, equation (1):
//!
//! `x'' + 2 d x' + k x = p sin(phase + Omega s) + q cos(phase + Omega s)`.
//!
//! The free part is written with the two propagators `g` and `g'` of the damped oscillator, which
//! covers under-, critically and overdamped oscillators without cancellation. The forced part is
//! the steady motion, unless damping is so small and the excitation so close to resonance that the
//! steady motion would dwarf the real one; then it is the response from rest, whose formula has no
//! small denominator. Valid for every finite parameter set.

use nalgebra::Complex;

use crate::operation_count;
use crate::system::System;

/// A complex constant of a system.
pub(super) type Phasor = Complex<f64>;

/// Gain of the steady motion over the excitation above which the response from rest replaces it:
/// four digits are the most that the subtraction of the two large parts may cost.
const LARGEST_STEADY_GAIN: f64 = 1e4;

/// Excitation frequency over the natural one below which free and steady part are bounded apart:
/// above, the sum of the two bounds is no better than the bound of the sum.
const SLOW: f64 = 0.1;

/// A linear oscillator with harmonic forcing, per unit of its own mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Oscillator {
    /// Half the damping coefficient, `d`.
    pub decay: f64,
    /// Stiffness `k`, the squared natural frequency.
    pub stiffness: f64,
    /// `Omega`.
    pub frequency: f64,
    /// Forcing in `sin(phase)`.
    pub sine: f64,
    /// Forcing in `cos(phase)`.
    pub cosine: f64,
    /// Largest absolute forcing.
    pub largest_force: f64,
    /// Steady motion: coefficients of `sin` and `cos` of the phase; `None` where it would dwarf the
    /// real one, and the response from rest takes its place.
    pub steady: Option<(f64, f64)>,
}

impl Oscillator {
    /// The oscillator of `system` moving alone, while the absorber flies.
    pub fn alone(system: &System) -> Self {
        Self::with_added_mass(system, 0.0)
    }

    /// The oscillator of `system` carrying the absorber in sustained contact: mass `1 + eps`.
    pub fn carrying_absorber(system: &System) -> Self {
        Self::with_added_mass(system, system.mass_ratio())
    }

    fn with_added_mass(system: &System, added: f64) -> Self {
        let mass = 1.0 + added;
        let (sine, cosine) = system.excitation_amplitudes();
        let decay = 0.5 * system.mass_ratio() * system.damping() / mass;
        let frequency = system.frequency_ratio();
        let mut oscillator = Self {
            decay,
            stiffness: 1.0 / mass,
            frequency,
            sine: sine / mass,
            cosine: cosine / mass,
            largest_force: libm::hypot(sine, cosine) / mass,
            steady: None,
        };
        oscillator.steady = oscillator.steady_motion();
        oscillator
    }

    fn steady_motion(&self) -> Option<(f64, f64)> {
        let root = self.stiffness.sqrt();
        let reactance = (root - self.frequency) * (root + self.frequency);
        let loss = 2.0 * self.decay * self.frequency;
        let scale = reactance * reactance + loss * loss;
        let dwarfs = scale * LARGEST_STEADY_GAIN * LARGEST_STEADY_GAIN < 1.0;
        let sine = (self.sine * reactance + self.cosine * loss) / scale;
        let cosine = (self.cosine * reactance - self.sine * loss) / scale;
        (!dwarfs).then_some((sine, cosine))
    }

    /// Forcing at a phase.
    pub fn force(&self, phase: f64) -> f64 {
        let (sin, cos) = libm::sincos(phase);
        self.sine * sin + self.cosine * cos
    }

    /// The motion that starts at displacement `x` and velocity `v` when the excitation's phase is
    /// `phase`.
    pub fn motion(&self, x: f64, v: f64, phase: f64) -> SmoothMotion {
        self.motion_about(0.0, x, v, phase)
    }

    /// The same under a constant force besides, in which the oscillator would rest at `rest`.
    pub fn motion_about(&self, rest: f64, x: f64, v: f64, phase: f64) -> SmoothMotion {
        let steady = self.forced(phase, 0.0, &Propagator::identity());
        SmoothMotion {
            oscillator: *self,
            rest,
            phase,
            free_x: x - rest - steady.x,
            free_v: v - steady.v,
        }
    }

    /// Free motion, `x'' + 2 d x' + k x = 0`, a time `s` after it had displacement `x` and velocity
    /// `v`; the difference of two motions under the same excitation is one.
    pub fn free(&self, x: f64, v: f64, s: f64) -> Kinematics {
        self.propagator(s).carry(self, x, v)
    }

    /// Acceleration at a phase, displacement and velocity, equation (1).
    pub fn acceleration(&self, phase: f64, at: Kinematics) -> f64 {
        self.force(phase) - 2.0 * self.decay * at.v - self.stiffness * at.x
    }

    fn forced(&self, phase: f64, s: f64, propagator: &Propagator) -> Kinematics {
        let Some((sine, cosine)) = self.steady else {
            return self.response_from_rest(phase, s, propagator);
        };
        let (sin, cos) = libm::sincos(phase + self.frequency * s);
        Kinematics { x: sine * sin + cosine * cos, v: self.frequency * (sine * cos - cosine * sin) }
    }

    /// Response from rest by convolution with the propagator; underdamped, close to resonance.
    ///
    /// With the poles `p = -d + i w`, `conj p` and `E(p) = (e^{i Omega s} - e^{p s})/(i Omega - p)`
    /// the response to `e^{i Omega s}` is `(E(p) - E(conj p)) / (p - conj p)`.
    fn response_from_rest(&self, phase: f64, s: f64, propagator: &Propagator) -> Kinematics {
        if s == 0.0 {
            return Kinematics { x: 0.0, v: 0.0 };
        }
        let w = propagator.ringing;
        let pole = Phasor::new(-self.decay, w);
        let near = exponential_difference(self.frequency, pole, s);
        let far = exponential_difference(self.frequency, pole.conj(), s);
        // Division by p - conj p = 2 i w.
        let over = |one: Phasor| Phasor::new(one.im / (2.0 * w), -one.re / (2.0 * w));
        let (displacement, velocity) = (over(near - far), over(pole * near - pole.conj() * far));
        let (sin, cos) = libm::sincos(phase);
        // The forcing is the imaginary part of (sine + i cosine) e^{i (phase + Omega s)}.
        let amplitude = Phasor::new(self.sine, self.cosine) * Phasor::new(cos, sin);
        Kinematics { x: (amplitude * displacement).im, v: (amplitude * velocity).im }
    }

    fn propagator(&self, s: f64) -> Propagator {
        let root = self.stiffness.sqrt();
        let discriminant = (root - self.decay) * (root + self.decay);
        if discriminant > 0.0 {
            let ringing = discriminant.sqrt();
            let envelope = libm::exp(-self.decay * s);
            let (sin, cos) = libm::sincos(ringing * s);
            let impulse = envelope * if ringing * s == 0.0 { s } else { sin / ringing };
            Propagator { impulse, step: envelope * cos - self.decay * impulse, ringing }
        } else {
            let spread = (-discriminant).sqrt();
            let slow = -self.stiffness / (self.decay + spread);
            let fast = -(self.decay + spread);
            let envelope = libm::exp(slow * s);
            let impulse = if spread == 0.0 {
                envelope * s
            } else {
                -envelope * libm::expm1(-2.0 * spread * s) / (2.0 * spread)
            };
            Propagator { impulse, step: envelope + fast * impulse, ringing: 0.0 }
        }
    }
}

/// The damped oscillator's impulse response `g(s)` and its derivative.
struct Propagator {
    impulse: f64,
    step: f64,
    /// Damped natural frequency; 0 where the oscillator does not ring.
    ringing: f64,
}

impl Propagator {
    fn identity() -> Self {
        Self { impulse: 0.0, step: 1.0, ringing: 0.0 }
    }

    /// Free motion that began with displacement `x` and velocity `v`.
    fn carry(&self, o: &Oscillator, x: f64, v: f64) -> Kinematics {
        let Self { impulse, step, .. } = *self;
        Kinematics {
            x: x * (step + 2.0 * o.decay * impulse) + v * impulse,
            v: v * step - o.stiffness * x * impulse,
        }
    }
}

/// Displacement and velocity of the oscillator, over the clearance and in fast time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kinematics {
    /// Displacement.
    pub x: f64,
    /// Velocity `dx/dtau`.
    pub v: f64,
}

/// One stretch of smooth motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SmoothMotion {
    oscillator: Oscillator,
    /// Where it would rest without excitation.
    rest: f64,
    phase: f64,
    free_x: f64,
    free_v: f64,
}

impl SmoothMotion {
    /// Displacement and velocity a time `s` after the stretch began; error a few units in the last
    /// place of the larger of the free and the forced part.
    pub fn at(&self, s: f64) -> Kinematics {
        // A sine, a cosine and an exponential of the free part, a sine and a cosine of the other.
        operation_count::note(5 * operation_count::ELEMENTARY + 28);
        let o = &self.oscillator;
        let propagator = o.propagator(s);
        let free = propagator.carry(o, self.free_x, self.free_v);
        let forced = o.forced(self.phase, s, &propagator);
        Kinematics { x: free.x + forced.x + self.rest, v: free.v + forced.v }
    }

    /// Seen from where it would rest.
    fn about_rest(&self, at: Kinematics) -> Kinematics {
        Kinematics { x: at.x - self.rest, ..at }
    }

    /// Displacement and velocity of the free part where the stretch began.
    #[cfg(test)]
    pub(super) fn free(&self) -> (f64, f64) {
        (self.free_x, self.free_v)
    }

    /// Forcing a time `s` after the stretch began, an acceleration over the clearance in fast time.
    pub fn force(&self, s: f64) -> f64 {
        self.oscillator.force(self.phase + self.oscillator.frequency * s)
    }

    /// Acceleration over the clearance in fast time, by equation (1) from the displacement and velocity at the same time.
    pub fn acceleration(&self, s: f64, at: Kinematics) -> f64 {
        let o = &self.oscillator;
        o.acceleration(self.phase + o.frequency * s, self.about_rest(at))
    }

    /// Jerk over the clearance in fast time, by the derivative of equation (1).
    pub fn jerk(&self, s: f64, at: Kinematics) -> f64 {
        let o = &self.oscillator;
        let (sin, cos) = libm::sincos(self.phase + o.frequency * s);
        let force_rate = o.frequency * (o.sine * cos - o.cosine * sin);
        force_rate - 2.0 * o.decay * self.acceleration(s, at) - o.stiffness * at.v
    }

    /// The oscillator that moves.
    pub fn oscillator(&self) -> &Oscillator {
        &self.oscillator
    }

    /// Bounds on the derivatives from the time `s` on, when the motion is at `at`, for `horizon` of
    /// time: [`derivative_bounds`], and where they are smaller those of the free and the steady part
    /// by themselves. Without them the fast rate of an overdamped oscillator that has long died out
    /// would still shorten every step, and so would the large forces of a slow excitation, which
    /// balance one another.
    pub fn bounds(&self, s: f64, at: Kinematics, horizon: f64) -> DerivativeBounds {
        let general = derivative_bounds(&self.oscillator, self.about_rest(at), horizon);
        let parts = self.creeping_bounds(s).or_else(|| self.slow_bounds(s));
        let Some(parts) = parts else { return general };
        DerivativeBounds {
            acceleration: general.acceleration.min(parts.acceleration),
            jerk: general.jerk.min(parts.jerk),
            snap: general.snap.min(parts.snap),
        }
    }

    /// Under a slow excitation: the energy of the free part only falls, and the steady part is a
    /// sinusoid.
    fn slow_bounds(&self, s: f64) -> Option<DerivativeBounds> {
        let o = &self.oscillator;
        let (sine, cosine) = o.steady?;
        if o.frequency > SLOW * o.stiffness.sqrt() {
            return None;
        }
        let steady = libm::hypot(sine, cosine) * o.frequency * o.frequency;
        let free = o.free(self.free_x, self.free_v, s);
        let unforced = Oscillator { largest_force: 0.0, ..*o };
        let DerivativeBounds { acceleration, jerk, snap } = derivative_bounds(&unforced, free, 0.0);
        Some(DerivativeBounds {
            acceleration: acceleration + steady,
            jerk: jerk + steady * o.frequency,
            snap: snap + steady * o.frequency * o.frequency,
        })
    }

    /// Each exponential of an overdamped motion only falls, and so do its derivatives.
    fn creeping_bounds(&self, s: f64) -> Option<DerivativeBounds> {
        let o = &self.oscillator;
        let (sine, cosine) = o.steady?;
        let root = o.stiffness.sqrt();
        let spread = ((o.decay - root) * (o.decay + root)).max(0.0).sqrt();
        if spread == 0.0 {
            return None;
        }
        let (slow, fast) = (o.stiffness / (o.decay + spread), o.decay + spread);
        let part = |rate: f64, other: f64| {
            // `e^{-rate s}` and its share of displacement and velocity at the beginning.
            let terms = [self.free_v, other * self.free_x];
            let rounding = 4.0 * f64::EPSILON * (terms[0].abs() + terms[1].abs());
            libm::exp(-rate * s) * ((terms[0] + terms[1]).abs() + rounding) / (2.0 * spread)
        };
        let (creep, dash) = (part(slow, fast), part(fast, slow));
        let steady = libm::hypot(sine, cosine);
        let bound = |order: u32| {
            let power = |rate: f64| (0..order).fold(1.0, |product, _| product * rate);
            creep * power(slow) + dash * power(fast) + steady * power(o.frequency)
        };
        Some(DerivativeBounds { acceleration: bound(2), jerk: bound(3), snap: bound(4) })
    }
}

/// Bounds on the derivatives of a motion from one moment on, for `horizon` of time.
///
/// The oscillator's energy `e = v^2 + k x^2` obeys `d sqrt(e)/ds <= abs(force)`, whatever the
/// damping, so that velocity and stiffness force are bounded by `sqrt(e)` now plus the largest
/// force times the horizon; equation (1) and its derivatives bound the rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DerivativeBounds {
    /// On the acceleration.
    pub acceleration: f64,
    /// On its derivative.
    pub jerk: f64,
    /// On the derivative of the jerk.
    pub snap: f64,
}

/// Bounds for the motion of `oscillator` that passes through `at`, valid for `horizon`.
pub fn derivative_bounds(o: &Oscillator, at: Kinematics, horizon: f64) -> DerivativeBounds {
    let force = o.largest_force;
    let speed = (at.v * at.v + o.stiffness * at.x * at.x).sqrt() + force * horizon;
    let acceleration = force + (2.0 * o.decay + o.stiffness.sqrt()) * speed;
    let jerk = o.frequency * force + 2.0 * o.decay * acceleration + o.stiffness * speed;
    let snap =
        o.frequency * o.frequency * force + 2.0 * o.decay * jerk + o.stiffness * acceleration;
    DerivativeBounds { acceleration, jerk, snap }
}

/// `(e^{i Omega s} - e^{p s}) / (i Omega - p)`, exact also where `i Omega = p`.
fn exponential_difference(frequency: f64, pole: Phasor, s: f64) -> Phasor {
    let envelope = libm::exp(pole.re * s);
    let (sin, cos) = libm::sincos(pole.im * s);
    let mean = mean_of_exponential(Phasor::new(-pole.re * s, (frequency - pole.im) * s));
    Phasor::new(s * envelope * cos, s * envelope * sin) * mean
}

/// Powers of `z` that `(e^z - 1)/z` takes below a size: the next is below 2e-18 of the sum.
const TERMS: [(f64, usize); 3] = [(0.03, 7), (0.15, 10), (0.5, 15)];
/// `1/2`, `1/3`, ...: divisions took most of the time of a window that is measured.
const INVERSES: [f64; 15] = {
    let mut inverses = [0.0; 15];
    let mut n = 0;
    while n < 15 {
        inverses[n] = 1.0 / (n + 2) as f64;
        n += 1;
    }
    inverses
};

/// `(e^z - 1) / z`, by its series for small `z`.
pub(super) fn mean_of_exponential(z: Phasor) -> Phasor {
    let size = libm::hypot(z.re, z.im);
    by_series(z, size).unwrap_or_else(|| {
        let (sin, cos) = libm::sincos(z.im);
        let half = libm::sin(0.5 * z.im);
        let (re, im) = (libm::expm1(z.re) * cos - 2.0 * half * half, libm::exp(z.re) * sin);
        let scale = size * size;
        Phasor::new((re * z.re + im * z.im) / scale, (im * z.re - re * z.im) / scale)
    })
}

/// The same where `e^z` is known; its error is then that of rounding `1`, over `abs(z)`.
pub(super) fn mean_to(z: Phasor, exponential: Phasor) -> Phasor {
    by_series(z, z.norm_sqr().sqrt()).unwrap_or_else(|| (exponential - 1.0) / z)
}

fn by_series(z: Phasor, size: f64) -> Option<Phasor> {
    let (_, last) = TERMS.iter().find(|(below, _)| size < *below)?;
    let mut sum = Phasor::new(1.0, 0.0);
    for inverse in INVERSES[..*last].iter().rev() {
        let product = sum * z;
        sum = Phasor::new(1.0 + product.re * inverse, product.im * inverse);
    }
    Some(sum)
}

#[cfg(test)]
mod tests;
