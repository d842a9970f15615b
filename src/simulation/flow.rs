//! Closed-form motion of the linear oscillator between events, equation (1):
//!
//! `x'' + 2 d x' + k x = p sin(phase + Omega s) + q cos(phase + Omega s)`.
//!
//! The free part is written with the two propagators `g` and `g'` of the damped oscillator, which
//! covers under-, critically and overdamped oscillators without cancellation. The forced part is
//! the steady motion, unless damping is so small and the excitation so close to resonance that the
//! steady motion would dwarf the real one; then it is the response from rest, whose formula has no
//! small denominator. Valid for every finite parameter set.

use crate::operation_count;
use crate::system::System;

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
    largest: f64,
    form: ForcedForm,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum ForcedForm {
    Steady { sine: f64, cosine: f64 },
    FromRest,
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
            largest: libm::hypot(sine, cosine) / mass,
            form: ForcedForm::FromRest,
        };
        oscillator.form = oscillator.choose_form();
        oscillator
    }

    fn choose_form(&self) -> ForcedForm {
        let root = self.stiffness.sqrt();
        let reactance = (root - self.frequency) * (root + self.frequency);
        let loss = 2.0 * self.decay * self.frequency;
        let scale = reactance * reactance + loss * loss;
        if scale * LARGEST_STEADY_GAIN * LARGEST_STEADY_GAIN < 1.0 {
            return ForcedForm::FromRest;
        }
        ForcedForm::Steady {
            sine: (self.sine * reactance + self.cosine * loss) / scale,
            cosine: (self.cosine * reactance - self.sine * loss) / scale,
        }
    }

    /// Steady motion: coefficients of `sin` and `cos` of the phase; `None` where it would dwarf the
    /// real one.
    pub(super) fn steady(&self) -> Option<(f64, f64)> {
        match self.form {
            ForcedForm::Steady { sine, cosine } => Some((sine, cosine)),
            ForcedForm::FromRest => None,
        }
    }

    /// Largest absolute forcing.
    pub fn largest_force(&self) -> f64 {
        self.largest
    }

    /// Forcing at a phase.
    pub fn force(&self, phase: f64) -> f64 {
        let (sin, cos) = libm::sincos(phase);
        self.sine * sin + self.cosine * cos
    }

    /// The motion that starts at displacement `x` and velocity `v` when the excitation's phase is
    /// `phase`.
    pub fn motion(&self, x: f64, v: f64, phase: f64) -> Motion {
        let steady = self.forced(phase, 0.0, &Propagator::identity());
        Motion { oscillator: *self, phase, free_x: x - steady.x, free_v: v - steady.v }
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
        match self.form {
            ForcedForm::Steady { sine, cosine } => {
                let (sin, cos) = libm::sincos(phase + self.frequency * s);
                Kinematics {
                    x: sine * sin + cosine * cos,
                    v: self.frequency * (sine * cos - cosine * sin),
                }
            }
            ForcedForm::FromRest => self.response_from_rest(phase, s, propagator),
        }
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
        let pole = [-self.decay, w];
        let near = exponential_difference(self.frequency, pole, s);
        let far = exponential_difference(self.frequency, [-self.decay, -w], s);
        let difference = [near[0] - far[0], near[1] - far[1]];
        let weighted = subtract(multiply(pole, near), multiply([-self.decay, -w], far));
        // Division by p - conj p = 2 i w.
        let displacement = [difference[1] / (2.0 * w), -difference[0] / (2.0 * w)];
        let velocity = [weighted[1] / (2.0 * w), -weighted[0] / (2.0 * w)];
        let (sin, cos) = libm::sincos(phase);
        // The forcing is the imaginary part of (sine + i cosine) e^{i (phase + Omega s)}.
        let amplitude = multiply([self.sine, self.cosine], [cos, sin]);
        Kinematics { x: multiply(amplitude, displacement)[1], v: multiply(amplitude, velocity)[1] }
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
pub struct Motion {
    oscillator: Oscillator,
    phase: f64,
    free_x: f64,
    free_v: f64,
}

impl Motion {
    /// Displacement and velocity a time `s` after the stretch began; error a few units in the last
    /// place of the larger of the free and the forced part.
    pub fn at(&self, s: f64) -> Kinematics {
        // A sine, a cosine and an exponential of the free part, a sine and a cosine of the other.
        operation_count::note(5 * operation_count::ELEMENTARY + 28);
        let o = &self.oscillator;
        let propagator = o.propagator(s);
        let free = propagator.carry(o, self.free_x, self.free_v);
        let forced = o.forced(self.phase, s, &propagator);
        Kinematics { x: free.x + forced.x, v: free.v + forced.v }
    }

    /// Displacement and velocity of the free part where the stretch began.
    pub(super) fn free(&self) -> (f64, f64) {
        (self.free_x, self.free_v)
    }

    /// Forcing a time `s` after the stretch began.
    pub fn force(&self, s: f64) -> f64 {
        self.oscillator.force(self.phase + self.oscillator.frequency * s)
    }

    /// Acceleration, by equation (1) from the displacement and velocity at the same time.
    pub fn acceleration(&self, s: f64, at: Kinematics) -> f64 {
        let o = &self.oscillator;
        o.acceleration(self.phase + o.frequency * s, at)
    }

    /// Jerk, by the derivative of equation (1).
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
        let general = derivative_bounds(&self.oscillator, at, horizon);
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
        let (sine, cosine) = o.steady()?;
        if o.frequency > SLOW * o.stiffness.sqrt() {
            return None;
        }
        let steady = libm::hypot(sine, cosine) * o.frequency * o.frequency;
        let free = o.free(self.free_x, self.free_v, s);
        let unforced = Oscillator { largest: 0.0, ..*o };
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
        let (sine, cosine) = o.steady()?;
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
    let force = o.largest_force();
    let speed = (at.v * at.v + o.stiffness * at.x * at.x).sqrt() + force * horizon;
    let acceleration = force + (2.0 * o.decay + o.stiffness.sqrt()) * speed;
    let jerk = o.frequency * force + 2.0 * o.decay * acceleration + o.stiffness * speed;
    let snap =
        o.frequency * o.frequency * force + 2.0 * o.decay * jerk + o.stiffness * acceleration;
    DerivativeBounds { acceleration, jerk, snap }
}

/// `(e^{i Omega s} - e^{p s}) / (i Omega - p)` as `[re, im]`, exact also where `i Omega = p`.
fn exponential_difference(frequency: f64, pole: [f64; 2], s: f64) -> [f64; 2] {
    let exponent = [-pole[0] * s, (frequency - pole[1]) * s];
    let envelope = libm::exp(pole[0] * s);
    let (sin, cos) = libm::sincos(pole[1] * s);
    let mean = mean_of_exponential(exponent);
    multiply([s * envelope * cos, s * envelope * sin], mean)
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
pub(super) fn mean_of_exponential(z: [f64; 2]) -> [f64; 2] {
    let size = libm::hypot(z[0], z[1]);
    if let Some((_, last)) = TERMS.iter().find(|(below, _)| size < *below) {
        let mut sum = [1.0, 0.0];
        for inverse in INVERSES[..*last].iter().rev() {
            let product = multiply(sum, z);
            sum = [1.0 + product[0] * inverse, product[1] * inverse];
        }
        return sum;
    }
    let (sin, cos) = libm::sincos(z[1]);
    let half = libm::sin(0.5 * z[1]);
    let numerator = [libm::expm1(z[0]) * cos - 2.0 * half * half, libm::exp(z[0]) * sin];
    let scale = size * size;
    [
        (numerator[0] * z[0] + numerator[1] * z[1]) / scale,
        (numerator[1] * z[0] - numerator[0] * z[1]) / scale,
    ]
}

fn multiply(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn subtract(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{Excitation, Parameters};

    fn oscillator(eps: f64, lambda: f64, frequency_ratio: f64) -> Oscillator {
        let parameters = Parameters {
            mass_ratio: eps,
            damping: lambda,
            restitution: 0.6,
            frequency_ratio,
            forcing_per_clearance: 2.0,
            excitation: Excitation::BaseDisplacement,
        };
        Oscillator::alone(&System::new(parameters).expect("valid"))
    }

    /// Equation (1) by central differences of the closed form, in every damping regime and at
    /// resonance. The differences are good to `h^2` relative to the fastest time scale.
    #[test]
    fn the_motion_satisfies_the_equation_of_motion() {
        let cases = [
            (0.0077, 1.8, 0.96),
            (0.0077, 0.0, 1.0),
            (0.0077, 1e-5, 1.0 + 1e-9),
            (0.5, 4.0, 1.3),
            (0.5, 4.000_000_1, 1.3),
            (0.9, 30.0, 0.4),
        ];
        for (eps, lambda, ratio) in cases {
            let o = oscillator(eps, lambda, ratio);
            let motion = o.motion(0.3, -0.7, 1.1);
            let start = motion.at(0.0);
            assert!((start.x - 0.3).abs() < 1e-15 && (start.v + 0.7).abs() < 1e-15);
            let h = 1e-4;
            for s in [0.2, 1.0, 3.0, 6.0] {
                let (before, here, after) = (motion.at(s - h), motion.at(s), motion.at(s + h));
                let velocity = (after.x - before.x) / (2.0 * h);
                let acceleration = (after.v - before.v) / (2.0 * h);
                let scale = 1.0 + 30.0 * o.decay;
                assert!((velocity - here.v).abs() < 1e-7 * scale, "{eps} {lambda} {ratio} {s}");
                let expected = motion.acceleration(s, here);
                assert!((acceleration - expected).abs() < 1e-6 * scale * scale, "{lambda} {s}");
            }
        }
    }

    /// The bounds hold for all later times, or for the horizon, and for an overdamped or slowly driven
    /// oscillator they fall to what is left of the motion.
    #[test]
    fn derivatives_stay_within_their_bounds() {
        let cases = [(0.9, 1e3, 0.958), (0.9, 4.0, 2.0), (0.0077, 1.8, 1e-3), (0.0077, 1.8, 0.05)];
        for (eps, lambda, ratio) in cases {
            let o = oscillator(eps, lambda, ratio);
            let motion = o.motion(0.3, -0.7, 1.1);
            for k in 0..60 {
                let s = 0.05 * f64::from(k);
                let bounds = motion.bounds(s, motion.at(s), 1.0);
                for l in 0..40 {
                    let later = s + f64::from(l) / 40.0;
                    let at = motion.at(later);
                    let (a, jerk) = (motion.acceleration(later, at), motion.jerk(later, at));
                    let slack = 1.0 + 1e-12;
                    assert!(a.abs() <= bounds.acceleration * slack, "{lambda} {ratio} {s} {later}");
                    assert!(jerk.abs() <= bounds.jerk * slack, "{lambda} {ratio} {s} {later}");
                }
            }
            let general = derivative_bounds(&o, motion.at(3.0), 1.0);
            let better = motion.bounds(3.0, motion.at(3.0), 1.0);
            assert!(better.snap <= general.snap);
            if lambda == 1e3 {
                assert!(better.snap < 1e-6 * general.snap, "{better:?} {general:?}");
            }
        }
    }

    #[test]
    fn both_forced_forms_agree_where_both_are_accurate() {
        let mut o = oscillator(0.01, 0.05, 1.002);
        let steady = o.motion(0.1, 0.2, 0.4);
        assert!(matches!(o.form, ForcedForm::Steady { .. }));
        o.form = ForcedForm::FromRest;
        let from_rest = o.motion(0.1, 0.2, 0.4);
        for s in [0.0, 0.01, 0.3, 2.0, 6.2] {
            let (a, b) = (steady.at(s), from_rest.at(s));
            // The steady motion is about 400 times the excitation: 1e-14 of it may cancel.
            assert!((a.x - b.x).abs() < 1e-13 && (a.v - b.v).abs() < 1e-13, "{s}: {a:?} {b:?}");
        }
    }

    #[test]
    fn the_bounds_hold_along_the_motion() {
        let o = oscillator(0.3, 2.0, 1.7);
        let motion = o.motion(0.8, 0.4, 0.3);
        let bounds = derivative_bounds(&o, motion.at(0.0), 2.0);
        for k in 0..=200 {
            let s = f64::from(k) * 0.01;
            let at = motion.at(s);
            assert!(motion.acceleration(s, at).abs() <= bounds.acceleration);
            assert!(motion.jerk(s, at).abs() <= bounds.jerk);
        }
    }

    /// Without damping, a displacement against the largest force reaches the bound on the
    /// acceleration, and a velocity against the fastest change of the force that on the jerk: smaller
    /// ones would not hold.
    #[test]
    fn the_bounds_are_reached() {
        let o = oscillator(0.3, 0.0, 1.7);
        let quarter = 0.5 * std::f64::consts::PI;
        for (x, v, phase) in [(-1.0, 0.0, quarter), (0.0, -1.0, 0.0)] {
            let motion = o.motion(x, v, phase);
            let at = motion.at(0.0);
            let bounds = derivative_bounds(&o, at, 0.0);
            let (reached, bound) = if v == 0.0 {
                (motion.acceleration(0.0, at), bounds.acceleration)
            } else {
                (motion.jerk(0.0, at), bounds.jerk)
            };
            assert!((reached / bound - 1.0).abs() < 1e-12, "{reached} {bound}");
        }
    }
}
