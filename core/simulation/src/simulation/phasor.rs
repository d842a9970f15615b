//! The oscillator as the sum of two rotating phasors, so that no sine and no exponential is evaluated
//! between impacts; for one trajectory or for several side by side, with the same bits.
//!
//! A flight is divided into equal panels, from its beginning on. From one end of a panel to the other
//! the free motion `Re z`, `z -> z e^{p h}`, and the steady motion are turned by constant factors, a
//! complex product each; inside a panel both are reached by short series in small angles. What
//! rounding adds to the steady motion is forgotten every few periods, where it is taken from the phase.
//! That no impact is stepped over is proven in [`super::certificate`].

use std::f64::consts::TAU;

use fearless_simd::Simd;

use super::flow::Oscillator;
use super::path::{Path, StraightLine};
use super::small::{LARGEST_ANGLE, small_angles, small_exponential, spiral};
use crate::numerics::lanes::{Mask, Real, Wide};

/// Part of the clearance from which on a flight begins on a wall.
pub(super) const ON_WALL: f64 = 1.0 - 1e-9;
/// Most panels between moments at which the steady motion is taken from the phase: each may turn it too far by `1e-16` of
/// itself.
const MOST_PANELS: f64 = 64.0;
/// Short panels in a long one.
const FINER: f64 = 4.0;
/// Most periods between such moments.
const MOST_PERIODS: f64 = 8.0;
/// Distance from a root within which a correction to the fourth order is exact to rounding: the next
/// term is below `1e-20/120`.
pub(super) const NEAR: f64 = 1e-4;
/// Steps of Newton towards a turning point; more are of no use where it hardly is one.
const TURNING_STEPS: u32 = 8;

/// The steady motion at one moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Steady<R> {
    pub x: R,
    pub v: R,
}

/// How well a panel's quintic is known.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slack<R> {
    /// `S/7200`.
    pub coefficient: R,
    /// What the square of the slope at a root must exceed.
    pub slope_squared: R,
}

impl<R: Real> Slack<R> {
    /// What the square of the acceleration must exceed where the slope changes its sign in a panel: `M'` is at most the
    /// fastest rate times `M`, and `4 M S/960` is fifteen times what the slope's square must exceed.
    #[inline(always)]
    pub(super) fn bend_squared(&self, fastest: R, length: R) -> R {
        self.slope_squared * fastest * 15.0 / length
    }

    /// That of a part of a panel.
    #[inline(always)]
    pub(super) fn part(self, of: f64) -> Self {
        let cube = of * of * of;
        let part = cube * cube;
        Self { coefficient: self.coefficient * part, slope_squared: self.slope_squared * part }
    }
}

/// Oscillator and gap at one moment.
#[derive(Debug, Clone, Copy)]
pub(super) struct FlightState<R> {
    /// Free phasor.
    pub z: [R; 2],
    pub steady: Steady<R>,
    /// `w = x - y`, its slope and its acceleration, which is the oscillator's where the absorber has none.
    pub a: R,
    pub gap: R,
    pub slope: R,
}

/// What turns the phasors of an underdamped oscillator and its excitation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rates<R> {
    pub fastest: R,
    /// Length `h` of a panel.
    pub step: R,
    /// After so many periods the steady motion is taken from the phase.
    pub renewal: R,
    pub frequency: R,
    pub inverse_frequency: R,
    /// Its square.
    pub squared: R,
    pub decay: R,
    pub twice_decay: R,
    pub ringing: R,
    pub inverse_ringing: R,
    pub stiffness: R,
    /// What the free phasor and the steady motion contribute to `S/7200`, and the latter to `M`.
    pub sixth_free: R,
    pub sixth_steady: R,
    pub second_steady: R,
    /// `e^{p h}`.
    pub turn: [R; 2],
    /// `cos`, `sin/Omega` and `Omega sin` of `Omega h`.
    pub swing: [R; 3],
    /// The steady motion at phase 0.
    pub origin: Steady<R>,
}

impl Rates<f64> {
    /// Those of an oscillator; `None` where it does not ring, has no steady motion that could be
    /// subtracted, or would need too many panels.
    pub(super) fn of(oscillator: &Oscillator) -> Option<Self> {
        let (sine, cosine) = oscillator.steady?;
        let frequency = oscillator.frequency;
        let root = oscillator.stiffness.sqrt();
        let discriminant = (root - oscillator.decay) * (root + oscillator.decay);
        let ringing = discriminant.max(0.0).sqrt();
        let fastest = root.max(frequency);
        // The exponential's series below reaches no further.
        let rings = ringing > 0.5 * root;
        let renewal = MOST_PANELS * LARGEST_ANGLE * frequency / (TAU * fastest);
        if !(rings && 1.0 <= renewal) {
            return None;
        }
        let size = libm::hypot(sine, cosine);
        let rates = Self {
            fastest,
            step: 0.0,
            renewal: renewal.min(MOST_PERIODS).floor(),
            frequency,
            inverse_frequency: 1.0 / frequency,
            squared: frequency * frequency,
            decay: oscillator.decay,
            twice_decay: 2.0 * oscillator.decay,
            ringing,
            inverse_ringing: 1.0 / ringing,
            stiffness: oscillator.stiffness,
            sixth_free: 0.0,
            sixth_steady: 0.0,
            second_steady: frequency * frequency * size,
            turn: [1.0, 0.0],
            swing: [1.0, 0.0, 0.0],
            origin: Steady { x: cosine, v: frequency * sine },
        };
        Some(rates.by(LARGEST_ANGLE / fastest))
    }

    /// The same in panels of another length.
    fn by(self, step: f64) -> Self {
        let Self { decay, ringing, frequency, stiffness, second_steady, .. } = self;
        let (sin, cos) = libm::sincos(ringing * step);
        let envelope = libm::exp(-decay * step);
        let (swing_sin, swing_cos) = libm::sincos(frequency * step);
        let (free, steady) = (stiffness.sqrt() * step, frequency * step);
        Self {
            step,
            sixth_free: sixth(free) / 7200.0,
            sixth_steady: steady * steady * steady * steady * step * step / 7200.0 * second_steady,
            turn: [envelope * cos, envelope * sin],
            swing: [swing_cos, swing_sin / frequency, swing_sin * frequency],
            ..self
        }
    }

    /// The same in short panels, for pieces of flight about which nothing is proven in long ones.
    pub(super) fn finely(self) -> Self {
        self.by(self.step / FINER)
    }

    /// Whether the steady motion is to be taken from the phase after so many periods.
    #[inline(always)]
    pub(super) fn renews(&self, turns: u64) -> bool {
        turns.is_multiple_of(self.renewal as u64)
    }

    /// The amplitude of a free motion with this displacement and velocity.
    pub(super) fn amplitude(&self, x: f64, v: f64) -> f64 {
        let [real, imaginary] = self.free(x, v);
        libm::hypot(real, imaginary)
    }

    /// The steady motion at a phase.
    pub(super) fn steady(&self, phase: f64) -> Steady<f64> {
        let (sin, cos) = libm::sincos(phase);
        let Steady { x, v } = self.origin;
        Steady { x: x * cos + v / self.frequency * sin, v: v * cos - self.frequency * x * sin }
    }
}

impl<R> Rates<R> {
    /// Those of several oscillators: `of` puts together what a function takes from each.
    #[inline(always)]
    pub(super) fn gathered(of: impl Fn(fn(&Rates<f64>) -> f64) -> R) -> Self {
        Self {
            fastest: of(|one| one.fastest),
            step: of(|one| one.step),
            renewal: of(|one| one.renewal),
            frequency: of(|one| one.frequency),
            inverse_frequency: of(|one| one.inverse_frequency),
            squared: of(|one| one.squared),
            decay: of(|one| one.decay),
            twice_decay: of(|one| one.twice_decay),
            ringing: of(|one| one.ringing),
            inverse_ringing: of(|one| one.inverse_ringing),
            stiffness: of(|one| one.stiffness),
            sixth_free: of(|one| one.sixth_free),
            sixth_steady: of(|one| one.sixth_steady),
            second_steady: of(|one| one.second_steady),
            turn: [of(|one| one.turn[0]), of(|one| one.turn[1])],
            swing: [of(|one| one.swing[0]), of(|one| one.swing[1]), of(|one| one.swing[2])],
            origin: Steady { x: of(|one| one.origin.x), v: of(|one| one.origin.v) },
        }
    }
}

impl<S: Simd> Rates<Wide<S>> {
    /// Replaces those of one oscillator.
    pub(super) fn set(&mut self, lane: usize, of: &Rates<f64>) {
        self.fastest[lane] = of.fastest;
        self.step[lane] = of.step;
        self.renewal[lane] = of.renewal;
        self.frequency[lane] = of.frequency;
        self.inverse_frequency[lane] = of.inverse_frequency;
        self.squared[lane] = of.squared;
        self.decay[lane] = of.decay;
        self.twice_decay[lane] = of.twice_decay;
        self.ringing[lane] = of.ringing;
        self.inverse_ringing[lane] = of.inverse_ringing;
        self.stiffness[lane] = of.stiffness;
        self.sixth_free[lane] = of.sixth_free;
        self.sixth_steady[lane] = of.sixth_steady;
        self.second_steady[lane] = of.second_steady;
        self.origin.x[lane] = of.origin.x;
        self.origin.v[lane] = of.origin.v;
        for k in 0..2 {
            self.turn[k][lane] = of.turn[k];
        }
        for k in 0..3 {
            self.swing[k][lane] = of.swing[k];
        }
    }
}

impl<R: Real> FlightState<R> {
    /// `yes` where `mask`, else `no`.
    #[inline(always)]
    pub(super) fn choose(mask: R::Mask, yes: &Self, no: &Self) -> Self {
        Self {
            z: [R::choose(mask, yes.z[0], no.z[0]), R::choose(mask, yes.z[1], no.z[1])],
            steady: Steady {
                x: R::choose(mask, yes.steady.x, no.steady.x),
                v: R::choose(mask, yes.steady.v, no.steady.v),
            },
            a: R::choose(mask, yes.a, no.a),
            gap: R::choose(mask, yes.gap, no.gap),
            slope: R::choose(mask, yes.slope, no.slope),
        }
    }
}

impl<R: Real> Rates<R> {
    /// The displacement at which the velocity vanishes in a panel between velocities of either sign,
    /// seen from a base at rest; `time` is roughly when. Only `lanes` matter.
    #[inline(always)]
    pub(super) fn turning_point<S: Simd>(
        &self,
        simd: S,
        here: &FlightState<R>,
        base: StraightLine<R>,
        mut time: R,
        length: R,
        lanes: R::Mask,
    ) -> R {
        let zero = time.like(0.0);
        let (mut open, mut height) = (lanes, here.gap);
        for _ in 0..TURNING_STEPS {
            let at = self.after(simd, here, time.larger(zero).smaller(length), base);
            let ahead = -(at.slope / at.a);
            let near = (ahead.abs() * self.fastest).less(time.like(NEAR));
            let level = R::choose(near, at.gap + at.slope * ahead * 0.5, at.gap);
            height = R::choose(open, level, height);
            open = open & !near;
            if !open.any() {
                break;
            }
            time = time + ahead;
        }
        height
    }

    /// Time from a phase until the period is over.
    #[inline(always)]
    pub(super) fn left(&self, phase: R) -> R {
        (-phase + TAU) * self.inverse_frequency
    }

    /// The beginning of a flight, and how well the quintics of its panels are known.
    #[inline(always)]
    pub(super) fn begin(
        &self,
        x: R,
        v: R,
        steady: Steady<R>,
        path: impl Path<R>,
    ) -> (FlightState<R>, Slack<R>) {
        let z = self.free(x - steady.x, v - steady.v);
        let size = (z[0] * z[0] + z[1] * z[1]).sqrt();
        let coefficient = self.sixth_free * size + self.sixth_steady;
        let bend = path.bound(self.stiffness * size + self.second_steady);
        // 4 M S/14340 with S = 7200 times the coefficient.
        let slope_squared = bend * coefficient * 2.01;
        // Of nearly equal numbers the differences are exact here, and not from phasors.
        let StraightLine { y, velocity } = path.line();
        let here = FlightState { gap: x - y, slope: v - velocity, ..self.at(z, steady, path) };
        (here, Slack { coefficient, slope_squared })
    }

    /// A whole panel after `here`, where the absorber is at the beginning of `path`.
    #[inline(always)]
    pub(super) fn next(&self, here: &FlightState<R>, path: impl Path<R>) -> FlightState<R> {
        let [cos, fall, rise] = self.swing;
        let steady = Steady {
            x: here.steady.x * cos + here.steady.v * fall,
            v: here.steady.v * cos - here.steady.x * rise,
        };
        self.at(multiply(here.z, self.turn), steady, path)
    }

    /// The free motion's velocity, backwards.
    #[inline(always)]
    fn slowing(&self, z: [R; 2]) -> R {
        self.decay * z[0] + self.ringing * z[1]
    }

    /// Displacement and velocity of the oscillator.
    #[inline(always)]
    pub(super) fn oscillator(&self, at: &FlightState<R>) -> (R, R) {
        (at.z[0] + at.steady.x, at.steady.v - self.slowing(at.z))
    }

    /// The oscillator's acceleration, from displacement, velocity and steady motion.
    #[inline(always)]
    pub(super) fn acceleration(&self, x: R, v: R, steady: Steady<R>) -> R {
        let slowing = steady.v - v;
        self.twice_decay * slowing - self.stiffness * (x - steady.x) - self.squared * steady.x
    }

    /// Free motion as a phasor.
    #[inline(always)]
    fn free(&self, x: R, v: R) -> [R; 2] {
        [x, -((v + self.decay * x) * self.inverse_ringing)]
    }

    /// Oscillator and gap where the free phasor is `z`, the steady motion `steady`, and the absorber
    /// at the beginning of `path`.
    #[inline(always)]
    pub(super) fn at(&self, z: [R; 2], steady: Steady<R>, path: impl Path<R>) -> FlightState<R> {
        let slowing = self.slowing(z);
        let (x, v) = (z[0] + steady.x, steady.v - slowing);
        let a = self.twice_decay * slowing - self.stiffness * z[0] - self.squared * steady.x;
        let StraightLine { y, velocity } = path.line();
        FlightState { z, steady, a: path.bend(a), gap: x - y, slope: v - velocity }
    }

    /// Displacement and velocity of the oscillator at the end of the period, a time `left` after `here`.
    #[inline(always)]
    pub(super) fn period_end<S: Simd>(&self, simd: S, here: &FlightState<R>, left: R) -> (R, R) {
        let turn = spiral(simd, -(self.decay * left), self.ringing * left);
        let z = multiply(here.z, turn);
        (z[0] + self.origin.x, self.origin.v - self.slowing(z))
    }

    /// A time `s`, less than a panel, after `here`, where the absorber's flight `path` begins.
    #[inline(always)]
    pub(super) fn after<S: Simd>(
        &self,
        simd: S,
        here: &FlightState<R>,
        s: R,
        path: impl Path<R>,
    ) -> FlightState<R> {
        let [(sin, cos), (swing_sin, swing_cos)] =
            small_angles(simd, [self.ringing * s, self.frequency * s]);
        let envelope = small_exponential(-(self.decay * s));
        let z = multiply(here.z, [envelope * cos, envelope * sin]);
        let Steady { x, v } = here.steady;
        let steady = Steady {
            x: x * swing_cos + v * self.inverse_frequency * swing_sin,
            v: v * swing_cos - self.frequency * x * swing_sin,
        };
        self.at(z, steady, path.from(s))
    }
}

/// The sixth power.
fn sixth(x: f64) -> f64 {
    x * x * x * x * x * x
}

#[inline(always)]
pub(super) fn multiply<R: Real>(a: [R; 2], b: [R; 2]) -> [R; 2] {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}
