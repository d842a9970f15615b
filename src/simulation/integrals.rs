//! Integrals along a stretch of smooth motion, and its largest displacement: in closed form where the
//! oscillator rings, else by quadrature and bracketed roots, exact to rounding.
//!
//! Free motion and excitation are phasors, `Re Z e^{p s}` and `Re E e^{i Omega s}`, and the steady
//! motion is `Re a E e^{i Omega s}`: every quadratic integral is a sum of five, of `Z^2`, `|Z|^2`, `Z E`,
//! `Z conj E` and `E^2`. The second and the fourth have exponents that may vanish, and are taken from
//! `(e^q - 1)/q`, which is exact there.

use std::f64::consts::FRAC_PI_4;

use nalgebra::Complex;

use super::events::{Absorber, Segment};
use super::flow::{Oscillator, mean_of_exponential};
use super::peaks::{self, Moment};
use super::phasor::{Rates, Steady};
use crate::numerics::bracket::brent;
use crate::numerics::quadrature;
use crate::operation_count;
use crate::system::{State, System};

type Phasor = Complex<f64>;

/// Integrals over a stretch, in fast time; lengths over the clearance.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Integrals {
    /// Of `x^2`.
    pub displacement_squared: f64,
    /// Of `x'^2`.
    pub velocity_squared: f64,
    /// Of the excitation's force times `x'`.
    pub work: f64,
    /// Of `x` times sine and cosine of the excitation's phase.
    pub oscillator: [f64; 2],
    /// Of `y` times the same.
    pub absorber: [f64; 2],
}

/// What the integrals of an oscillator that rings have in common.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ringing {
    /// `p = -d + i w`.
    pub pole: Phasor,
    /// `a`.
    pub steady: Phasor,
}

/// Takes the integrals of a system's stretches.
#[derive(Debug, Clone)]
pub(super) struct Integrator {
    frequency: f64,
    /// The excitation's force is `Re f E`.
    force: Phasor,
    /// Longest panels of a quadrature, the second where fast decay has not ended.
    panel: f64,
    first_panel: f64,
    alone: Option<Ringing>,
    carrying: Option<Ringing>,
    rates: Option<Rates<f64>>,
    /// The last phase asked for and its `E`: one stretch ends where the next begins.
    last: (f64, Phasor),
}

impl Ringing {
    fn of(oscillator: &Oscillator) -> Option<Self> {
        let (sine, cosine) = oscillator.steady?;
        let root = oscillator.stiffness.sqrt();
        let ringing = ((root - oscillator.decay) * (root + oscillator.decay)).max(0.0).sqrt();
        // Slower ones are not told from decay.
        (ringing > 0.5 * root).then(|| Self {
            pole: Phasor::new(-oscillator.decay, ringing),
            steady: Phasor::new(cosine, -sine),
        })
    }
}

impl Integrator {
    pub(super) fn of(system: &System) -> Self {
        let (sine, cosine) = system.excitation_amplitudes();
        let oscillating = 1.0_f64.max(system.frequency_ratio());
        let decaying = oscillating.max(system.mass_ratio() * system.damping());
        Self {
            frequency: system.frequency_ratio(),
            panel: FRAC_PI_4 / oscillating,
            first_panel: FRAC_PI_4 / decaying,
            force: Phasor::new(cosine, -sine),
            alone: Ringing::of(&Oscillator::alone(system)),
            carrying: Ringing::of(&Oscillator::carrying_absorber(system)),
            rates: Rates::of(&Oscillator::alone(system)),
            last: (0.0, Phasor::new(1.0, 0.0)),
        }
    }

    /// `e^{i phase}`.
    fn excitation(&mut self, phase: f64) -> Phasor {
        if self.last.0 != phase {
            let (sin, cos) = libm::sincos(phase);
            self.last = (phase, Phasor::new(cos, sin));
        }
        self.last.1
    }

    /// The largest absolute displacement of the oscillator in a stretch, at its ends included.
    pub(super) fn peak(&mut self, segment: &Segment) -> f64 {
        self.peak_by_quintics(segment).unwrap_or_else(|| self.peak_by_roots(segment))
    }

    /// As [`Self::peak`]; `None` as for [`Self::closed`], and in sustained contact.
    pub(super) fn peak_by_quintics(&mut self, segment: &Segment) -> Option<f64> {
        let Absorber::Flying { .. } = segment.absorber else { return None };
        let Ringing { steady, .. } = self.alone?;
        let rates = self.rates?;
        let phasor = steady * self.excitation(segment.phase);
        let steady = Steady { x: phasor.re, v: -self.frequency * phasor.im };
        let (free, velocity) = segment.motion.free();
        let begin = Moment { x: free + steady.x, v: velocity + steady.v, steady };
        Some(peaks::alone(&rates, &begin, segment.duration))
    }

    /// As [`Self::peak`]: where the velocity changes sign between two points a panel apart.
    fn peak_by_roots(&self, segment: &Segment) -> f64 {
        let panels = (segment.duration / self.panel).ceil().max(1.0);
        let step = segment.duration / panels;
        let mut before = segment.motion.at(0.0);
        let mut peak = before.x.abs();
        for k in 0..panels as u64 {
            let from = k as f64 * step;
            let after = segment.motion.at(from + step);
            peak = peak.max(after.x.abs());
            if (before.v > 0.0) != (after.v > 0.0)
                && let Some(root) = brent(from, from + step, 1e-12, |s| segment.motion.at(s).v)
            {
                peak = peak.max(segment.motion.at(root.at).x.abs());
            }
            before = after;
        }
        peak
    }

    /// What flights have in common, of an oscillator that rings and is driven to a steady motion.
    pub(super) fn alone(&self) -> Option<Ringing> {
        self.alone
    }

    /// What turns phasors in flight.
    pub(super) fn rates(&self) -> Option<Rates<f64>> {
        self.rates
    }

    /// The integrals over a stretch.
    pub(super) fn over(&mut self, segment: &Segment) -> Integrals {
        self.closed(segment).unwrap_or_else(|| self.by_quadrature(segment))
    }

    /// As [`Self::over`], for any oscillator.
    pub(super) fn by_quadrature(&self, segment: &Segment) -> Integrals {
        let omega = self.frequency;
        let mut sums = [0.0; 7];
        quadrature::graded_nodes(segment.duration, self.first_panel, self.panel, |s, weight| {
            let State { x, x_velocity, y, .. } = segment.at(s);
            operation_count::note(2 * operation_count::ELEMENTARY + 30);
            let (sin, cos) = libm::sincos(segment.phase + omega * s);
            let force = -self.force.im * sin + self.force.re * cos;
            let terms = [
                x * x,
                x_velocity * x_velocity,
                force * x_velocity,
                x * sin,
                x * cos,
                y * sin,
                y * cos,
            ];
            for (sum, term) in sums.iter_mut().zip(terms) {
                *sum += weight * term;
            }
        });
        let [displacement_squared, velocity_squared, work, x_sin, x_cos, y_sin, y_cos] = sums;
        Integrals {
            displacement_squared,
            velocity_squared,
            work,
            oscillator: [x_sin, x_cos],
            absorber: [y_sin, y_cos],
        }
    }

    /// As [`Self::over`], in closed form; `None` where the oscillator does not ring, or has no steady motion
    /// to be told from its free one.
    pub(super) fn closed(&mut self, segment: &Segment) -> Option<Integrals> {
        let Ringing { pole, steady } = match segment.absorber {
            Absorber::Flying { .. } => self.alone?,
            Absorber::Carried(_) => self.carrying?,
        };
        // Both phasors' ends, two means, five integrals and their sums.
        operation_count::note(5 * operation_count::ELEMENTARY + 300);
        let (duration, frequency) = (segment.duration, self.frequency);
        let begin = self.excitation(segment.phase);
        let end = self.excitation(segment.phase + frequency * duration);
        let (free, velocity) = segment.motion.free();
        let z = Phasor::new(free, -(velocity - pole.re * free) / pole.im);
        let (sin, cos) = libm::sincos(pole.im * duration);
        let z_end = z * Phasor::new(cos, sin) * libm::exp(pole.re * duration);
        let turn = Phasor::new(0.0, frequency);
        let mean = |re: f64, im: f64| {
            mean_of_exponential(Phasor::new(re * duration, im * duration)) * duration
        };
        // The five.
        let zz = (z_end * z_end - z * z) / (pole * 2.0);
        let size = z.norm_sqr() * mean(2.0 * pole.re, 0.0).re;
        let ze = (z_end * end - z * begin) / (pole + turn);
        let ze_conj = z * begin.conj() * mean(pole.re, pole.im - frequency);
        let ee = (end * end - begin * begin) / (turn * 2.0);
        // Of Re(u) Re(w) for two phasors, each a free and a steady part.
        let product = |u: [Phasor; 2], w: [Phasor; 2]| {
            let free = (u[0] * w[0] * zz).re + (u[0] * w[0].conj()).re * size;
            let mixed = (u[0] * w[1] + w[0] * u[1]) * ze
                + (u[0] * w[1].conj() + w[0] * u[1].conj()) * ze_conj;
            let steady = (u[1] * w[1] * ee).re + (u[1] * w[1].conj()).re * duration;
            0.5 * (free + mixed.re + steady)
        };
        let (none, one) = (Phasor::new(0.0, 0.0), Phasor::new(1.0, 0.0));
        let displacement = [one, steady];
        let velocity = [pole, turn * steady];
        let harmonic = (ze + ze_conj.conj() + steady * ee + steady.conj() * duration) * 0.5;
        let once = (end - begin) / turn;
        let absorber = match segment.absorber {
            Absorber::Flying { y, y_velocity } => {
                (end * (y + y_velocity * duration) - begin * y - once * y_velocity) / turn
            }
            Absorber::Carried(side) => harmonic - once * side.sign(),
        };
        Some(Integrals {
            displacement_squared: product(displacement, displacement),
            velocity_squared: product(velocity, velocity),
            work: product(velocity, [none, self.force]),
            oscillator: [harmonic.im, harmonic.re],
            absorber: [absorber.im, absorber.re],
        })
    }
}
