//! Integrals along smooth motion, exact to rounding: of flights in closed form, several side by side; of any
//! stretch by quadrature.
//!
//! Free motion and excitation are phasors, `Re Z e^{p s}` and `Re E e^{i Omega s}`, and the steady
//! motion is `Re a E e^{i Omega s}`: every quadratic integral is a sum of five, of `Z^2`, `|Z|^2`, `Z E`,
//! `Z conj E` and `E^2`. The second and the fourth have exponents that may vanish, and are taken from
//! `e^q - 1`, which is exact there.

use std::f64::consts::FRAC_PI_4;
use std::ops::{Add, Mul, Sub};

use fearless_simd::Simd;

use super::events::Segment;
use super::flow::{Kinematics, Oscillator, Phasor};
use super::phasor::Rates;
use super::sliding::Sliding;
use super::small::{angles, exponential_minus_one};
use crate::numerics::lanes::{LANES, Real};
use crate::numerics::{extremes, quadrature};
use crate::operation_count;
use crate::system::{State, System};

/// A complex number for each flight.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turning<R> {
    pub re: R,
    pub im: R,
}

impl<R: Real> Turning<R> {
    #[inline(always)]
    fn conj(self) -> Self {
        Self { re: self.re, im: -self.im }
    }
    #[inline(always)]
    fn times(self, factor: R) -> Self {
        Self { re: self.re * factor, im: self.im * factor }
    }
    #[inline(always)]
    pub(super) fn scaled(self, factor: Phasor) -> Self {
        Self {
            re: self.re * factor.re - self.im * factor.im,
            im: self.re * factor.im + self.im * factor.re,
        }
    }
    /// The real part of the product.
    #[inline(always)]
    fn real(self, factor: Phasor) -> R {
        self.re * factor.re - self.im * factor.im
    }
    #[inline(always)]
    fn size(self) -> R {
        self.re * self.re + self.im * self.im
    }
}

impl<R: Real> Add for Turning<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl<R: Real> Sub for Turning<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}

impl<R: Real> Mul for Turning<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }
}

/// Integrals over a stretch, in fast time; lengths over the clearance.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Integrals<R> {
    /// Of `x^2`.
    pub displacement_squared: R,
    /// Of `x'^2`.
    pub velocity_squared: R,
    /// Of the excitation's force times `x'`.
    pub work: R,
    /// Of `x` times sine and cosine of the excitation's phase.
    pub oscillator: [R; 2],
    /// Of `y` times the same.
    pub absorber: [R; 2],
}

/// The five integrals, and the time that they are over.
#[derive(Debug, Clone, Copy)]
pub(super) struct Five<R> {
    pub zz: Turning<R>,
    pub size: R,
    pub ze: Turning<R>,
    pub ze_conj: Turning<R>,
    pub ee: Turning<R>,
    pub duration: R,
}

/// The integral of `Re(u) Re(w)` of two linear forms, `u[0] Z + u[1] E` and alike, as coefficients of the five.
#[derive(Debug, Clone, Copy)]
pub(super) struct Product {
    zz: Phasor,
    size: f64,
    ze: Phasor,
    ze_conj: Phasor,
    ee: Phasor,
    duration: f64,
}

impl Product {
    pub(super) fn of(u: [Phasor; 2], w: [Phasor; 2]) -> Self {
        Self {
            zz: u[0] * w[0] * 0.5,
            size: 0.5 * (u[0] * w[0].conj()).re,
            ze: (u[0] * w[1] + w[0] * u[1]) * 0.5,
            ze_conj: (u[0] * w[1].conj() + w[0] * u[1].conj()) * 0.5,
            ee: u[1] * w[1] * 0.5,
            duration: 0.5 * (u[1] * w[1].conj()).re,
        }
    }

    #[inline(always)]
    pub(super) fn over<R: Real>(&self, five: &Five<R>) -> R {
        five.zz.real(self.zz)
            + five.size * self.size
            + five.ze.real(self.ze)
            + five.ze_conj.real(self.ze_conj)
            + five.ee.real(self.ee)
            + five.duration * self.duration
    }
}

/// A system's oscillator between impacts, where it rings and is driven to a steady motion.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ringing {
    /// Gravity and friction bend no flight.
    straight: bool,
    pub rates: Rates<f64>,
    /// `p = -d + i w`.
    pub pole: Phasor,
    /// `a`.
    pub steady: Phasor,
    /// `i Omega`.
    pub turn: Phasor,
    pub over: Quotients,
    /// Of `x^2`, `x'^2` and the excitation's work.
    squares: [Product; 3],
}

/// The inverse rates by which four of the five grow, and `E` itself.
#[derive(Debug, Clone, Copy)]
pub(super) struct Quotients {
    pub zz: Phasor,
    pub ze: Phasor,
    /// Not finite without damping and at resonance.
    pub ze_conj: Phasor,
    pub ee: Phasor,
    e: Phasor,
}

/// One flight, or several.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct FlightEnds<R> {
    /// The excitation's phase at either end.
    pub phase: [R; 2],
    /// Displacement and velocity of the oscillator there.
    pub x: [R; 2],
    pub v: [R; 2],
    /// The absorber's displacement at the beginning, and its velocity.
    pub y: R,
    pub y_velocity: R,
    /// The absorber's acceleration, and where the oscillator would rest.
    pub y_acceleration: R,
    pub rest: R,
}

impl FlightEnds<[f64; LANES]> {
    /// Begins the flight of a lane where that of another does.
    pub(super) fn begin_like(&mut self, other: usize, lane: usize) {
        for all in [
            &mut self.phase[0],
            &mut self.x[0],
            &mut self.v[0],
            &mut self.y,
            &mut self.y_velocity,
            &mut self.y_acceleration,
            &mut self.rest,
        ] {
            all[lane] = all[other];
        }
    }
}

impl Ringing {
    /// None where [`Rates::of`] has none.
    pub(super) fn of(system: &System) -> Option<Self> {
        let rates = Rates::of(&Oscillator::alone(system))?;
        let (sine, cosine) = system.excitation_amplitudes();
        let (zero, one) = (Phasor::new(0.0, 0.0), Phasor::new(1.0, 0.0));
        let pole = Phasor::new(-rates.decay, rates.ringing);
        let steady = Phasor::new(rates.origin.x, -rates.origin.v / rates.frequency);
        let turn = Phasor::new(0.0, rates.frequency);
        let (displacement, velocity) = ([one, steady], [pole, turn * steady]);
        let squares = [
            Product::of(displacement, displacement),
            Product::of(velocity, velocity),
            Product::of(velocity, [zero, Phasor::new(cosine, -sine)]),
        ];
        let over = Quotients {
            zz: one / (pole * 2.0),
            ze: one / (pole + turn),
            ze_conj: one / (pole - turn),
            ee: one / (turn * 2.0),
            e: one / turn,
        };
        let straight = Sliding::of(system).straight;
        Some(Self { straight, rates, pole, steady, turn, over, squares })
    }

    /// The excitation at either end of flights.
    #[inline(always)]
    pub(super) fn excitation<R: Real, S: Simd>(
        &self,
        simd: S,
        ends: &FlightEnds<R>,
    ) -> [Turning<R>; 2] {
        let [begin, end] = angles(simd, ends.phase);
        [Turning { re: begin.1, im: begin.0 }, Turning { re: end.1, im: end.0 }]
    }

    /// The integrals over flights, whose motion at the end is not used.
    #[inline(always)]
    pub(super) fn over<R: Real, S: Simd>(
        &self,
        simd: S,
        ends: &FlightEnds<R>,
        [begin, end]: [Turning<R>; 2],
    ) -> Integrals<R> {
        let Rates { frequency, inverse_frequency, decay, ringing, .. } = self.rates;
        let FlightEnds { phase, x: [x, _], v: [v, _], y, y_velocity, rest, .. } = *ends;
        let duration = (phase[1] - phase[0]) * inverse_frequency;
        let steady = begin.scaled(self.steady);
        let (free, velocity) = (x - rest - steady.re, v + steady.im * frequency);
        let z = Turning { re: free, im: -((velocity + free * decay) * (1.0 / ringing)) };
        let [turned, half] =
            angles(simd, [duration * ringing, duration * (0.5 * (ringing - frequency))]);
        // What the envelope loses, and e^q - 1 of Z conj E.
        let lost = exponential_minus_one(-(duration * decay));
        let envelope = lost + 1.0;
        let z_end = z * Turning { re: turned.1, im: turned.0 }.times(envelope);
        let beat = Turning {
            re: lost - half.0 * half.0 * envelope * 2.0,
            im: half.0 * half.1 * envelope * 2.0,
        };
        let over = &self.over;
        // Without damping and at resonance the last two quotients are 0/0, and their limit the duration.
        let fading =
            if decay > 0.0 { (lost * lost + lost * 2.0) * (-0.5 / decay) } else { duration };
        let beating = if self.pole == self.turn {
            Turning { re: duration, im: duration.like(0.0) }
        } else {
            beat.scaled(over.ze_conj)
        };
        let five = Five {
            zz: (z_end * z_end - z * z).scaled(over.zz),
            size: z.size() * fading,
            ze: (z_end * end - z * begin).scaled(over.ze),
            ze_conj: z * begin.conj() * beating,
            ee: (end * end - begin * begin).scaled(over.ee),
            duration,
        };
        let alone = five.ee.scaled(self.steady)
            + Turning { re: duration, im: duration.like(0.0) }.scaled(self.steady.conj());
        let oscillator = (five.ze + five.ze_conj.conj() + alone).times(duration.like(0.5));
        let once = (end - begin).scaled(over.e);
        let absorber =
            (end.times(y + y_velocity * duration) - begin.times(y) - once.times(y_velocity))
                .scaled(over.e);
        let [displacement_squared, velocity_squared, work] = &self.squares;
        let straight = Integrals {
            displacement_squared: displacement_squared.over(&five),
            velocity_squared: velocity_squared.over(&five),
            work: work.over(&five),
            oscillator: [oscillator.im, oscillator.re],
            absorber: [absorber.im, absorber.re],
        };
        if self.straight {
            return straight;
        }
        let swung = (z_end - z).scaled(Phasor::new(1.0, 0.0) / self.pole);
        let displacement = swung.re + once.scaled(self.steady).re;
        self.bent(ends, duration, once, end, displacement, straight)
    }

    /// The integrals over flights, from those without a place of rest and an acceleration of the absorber; `once` is that
    /// of the excitation, `displacement` that of the oscillator from its place of rest.
    #[inline(always)]
    fn bent<R: Real>(
        &self,
        ends: &FlightEnds<R>,
        duration: R,
        once: Turning<R>,
        end: Turning<R>,
        displacement: R,
        straight: Integrals<R>,
    ) -> Integrals<R> {
        let FlightEnds { y_acceleration, rest, .. } = *ends;
        let gained = y_acceleration * duration;
        // By parts: `y = a s^2/2` has the slope `a s`, and that the slope `a`.
        let slope = (end.times(gained) - once.times(y_acceleration)).scaled(self.over.e);
        let absorber = (end.times(gained * duration * 0.5) - slope).scaled(self.over.e);
        let [sine, cosine] = straight.oscillator;
        let [absorber_sine, absorber_cosine] = straight.absorber;
        Integrals {
            displacement_squared: straight.displacement_squared
                + rest * (displacement * 2.0 + rest * duration),
            oscillator: [sine + rest * once.im, cosine + rest * once.re],
            absorber: [absorber_sine + absorber.im, absorber_cosine + absorber.re],
            ..straight
        }
    }
}

/// Takes integrals of any stretch of a system's motion, and its largest displacement.
#[derive(Debug, Clone)]
pub(super) struct Quadrature {
    frequency: f64,
    /// The excitation's force is `Re f E`.
    force: Phasor,
    /// Longest panels, the second where fast decay has not ended.
    panel: f64,
    first_panel: f64,
}

impl Quadrature {
    pub(super) fn of(system: &System) -> Self {
        let (sine, cosine) = system.excitation_amplitudes();
        let oscillating = 1.0_f64.max(system.frequency_ratio());
        let decaying = oscillating.max(system.mass_ratio() * system.damping());
        Self {
            frequency: system.frequency_ratio(),
            panel: FRAC_PI_4 / oscillating,
            first_panel: FRAC_PI_4 / decaying,
            force: Phasor::new(cosine, -sine),
        }
    }

    /// The largest absolute displacement of the oscillator in a stretch.
    pub(super) fn peak(&self, segment: &Segment) -> f64 {
        extremes::largest(segment.duration, self.panel, |s| {
            let Kinematics { x, v } = segment.motion.at(s);
            [x, v]
        })
    }

    /// The integrals over a stretch.
    pub(super) fn over(&self, segment: &Segment) -> Integrals<f64> {
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
}
