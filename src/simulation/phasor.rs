//! The oscillator as the sum of two rotating phasors, so that no sine and no exponential is evaluated
//! between impacts; for one trajectory or for several side by side, with the same bits.
//!
//! A flight is divided into equal panels, from its beginning on. From one end of a panel to the other
//! the free motion `Re z`, `z -> z e^{p h}`, and the steady motion are turned by constant factors, a
//! complex product each; inside a panel both are reached by short series in small angles. What
//! rounding adds to the steady motion is forgotten at the end of each period, where its value is known.
//!
//! **Nothing is stepped over.** At both ends of a panel the relative displacement `w`, its slope and
//! its acceleration are known, and with them a quintic from which `w` differs by at most
//! `S u^3 (1-u)^3/720` at the part `u` of the panel, `S = (|p|^6 |z| + Omega^6 F) h^6` with `|z|`, which
//! shrinks, at the beginning of the flight. In Bernstein's form the quintic has the six coefficients
//! `b0..b5` of [`Hull`], and as `u^3 (1-u)^3 <= u^3 (1-u)^2`, which is a tenth of the form's fourth
//! polynomial, `w` lies between the quintics whose `b3` is smaller and larger by `S/7200`. A quintic lies
//! between its smallest and largest coefficient: if these are inside the band, so is all of `w`.
//!
//! If `b5` is beyond a wall and no other coefficient beyond the opposite one, and from some place on
//! all coefficients of the outer quintic are beyond and none before, it is beyond the wall from some
//! `s*` on and not before (Descartes' rule). Its distance from `w` being less than `S/14340`, a root of
//! `w` at which the slope `v` satisfies `v^2 > 4 M S/14340`, `|w''| <= M`, is the first: between an earlier
//! one and it `w` would fall by `v^2/(2 M)`, and the outer quintic back inside.
//!
//! Any other panel is halved, which divides `S` by 64; below a thousandth of a panel the search of
//! [`crate::numerics::crossing`] takes over.

use std::f64::consts::TAU;

use fearless_simd::{Level, Simd, dispatch};

use super::flow::Oscillator;
use crate::numerics::lanes::{Mask, Real};

/// Largest angle by which either phasor turns in a panel; its series below end accordingly.
const LARGEST_ANGLE: f64 = 0.8;
/// Part of the clearance from which on a flight begins on a wall.
const ON_WALL: f64 = 1.0 - 1e-9;
/// A flight is short if its parabola comes back within twice this part of a panel, inverted.
const SHORT_FLIGHT: f64 = 32.0;
/// Most panels in a period: each may turn the steady motion too far by `1e-16` of itself.
const MOST_PANELS: f64 = 64.0;
/// Distance from a root within which a correction to the fourth order is exact to rounding: the next
/// term is below `1e-20/120`.
const NEAR: f64 = 1e-4;
/// Steps of Newton towards a turning point; more are of no use where it hardly is one.
const TURNING_STEPS: u32 = 8;
/// Steps of Newton from an end of a panel in which the slope changes sign, before the one that every root
/// gets.
const STEPS_FROM_END: u32 = 3;
/// What a correction may leave, over the fastest time scale: five times this is below rounding.
const LEFT: f64 = 1e-17;

/// The steady motion at one moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Steady<R> {
    pub x: R,
    pub v: R,
}

/// The absorber's flight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Line<R> {
    /// Displacement at its beginning.
    pub y: R,
    /// Velocity.
    pub velocity: R,
}

impl<R: Real> Line<R> {
    /// The rest of it, from a time `s` on.
    #[inline(always)]
    pub(super) fn from(self, s: R) -> Self {
        Self { y: self.y + self.velocity * s, ..self }
    }
}

/// Oscillator and gap at one moment.
#[derive(Debug, Clone, Copy)]
pub(super) struct At<R> {
    /// Free phasor.
    pub z: [R; 2],
    pub steady: Steady<R>,
    pub a: R,
    /// `w = x - y` and its slope.
    pub gap: R,
    pub slope: R,
}

/// What turns the phasors of an underdamped oscillator and its excitation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rates<R> {
    pub fastest: R,
    /// Length `h` of a panel.
    pub step: R,
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

/// How well a panel's quintic is known.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slack<R> {
    /// `S/7200`.
    pub coefficient: R,
    /// What the square of the slope at a root must exceed.
    pub slope_squared: R,
}

impl<R: Real> Slack<R> {
    /// Whether a moment in a panel that meets a wall is proven to be before.
    #[inline(always)]
    pub(super) fn before(&self, at: &At<R>, wall: R) -> R::Mask {
        // Twice S/14340.
        (at.gap * wall + self.coefficient * 1.005).at_most(wall.like(1.0))
    }

    /// That of half a panel.
    #[inline(always)]
    pub(super) fn halved(self) -> Self {
        let part = 1.0 / 64.0;
        Self { coefficient: self.coefficient * part, slope_squared: self.slope_squared * part }
    }
}

/// A root, corrected once.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corrected<R: Real> {
    /// Where it was evaluated.
    pub at: At<R>,
    pub time: R,
    pub x: R,
    pub v: R,
    pub steady: Steady<R>,
    /// Whether nothing above rounding is left, and the root is proven to be the first.
    pub exact: R::Mask,
}

impl Rates<f64> {
    /// Those of an oscillator; `None` where it does not ring, has no steady motion that could be
    /// subtracted, or would need too many panels.
    pub(super) fn of(oscillator: &Oscillator) -> Option<Self> {
        let (sine, cosine) = oscillator.steady()?;
        let frequency = oscillator.frequency;
        let root = oscillator.stiffness.sqrt();
        let discriminant = (root - oscillator.decay) * (root + oscillator.decay);
        let ringing = discriminant.max(0.0).sqrt();
        let fastest = root.max(frequency);
        // The exponential's series below reaches no further.
        let rings = ringing > 0.5 * root;
        if !(rings && TAU * fastest <= MOST_PANELS * LARGEST_ANGLE * frequency) {
            return None;
        }
        let step = LARGEST_ANGLE / fastest;
        let (sin, cos) = libm::sincos(ringing * step);
        let envelope = libm::exp(-oscillator.decay * step);
        let size = libm::hypot(sine, cosine);
        let (swing_sin, swing_cos) = libm::sincos(frequency * step);
        Some(Self {
            fastest,
            step,
            frequency,
            inverse_frequency: 1.0 / frequency,
            squared: frequency * frequency,
            decay: oscillator.decay,
            twice_decay: 2.0 * oscillator.decay,
            ringing,
            inverse_ringing: 1.0 / ringing,
            stiffness: oscillator.stiffness,
            sixth_free: sixth(root * step) / 7200.0,
            sixth_steady: sixth(frequency * step) / 7200.0 * size,
            second_steady: frequency * frequency * size,
            turn: [envelope * cos, envelope * sin],
            swing: [swing_cos, swing_sin / frequency, swing_sin * frequency],
            origin: Steady { x: cosine, v: frequency * sine },
        })
    }

    /// The displacement at which the velocity vanishes in a panel between velocities of either sign,
    /// seen from a line at rest.
    pub(super) fn turning_point(&self, here: &At<f64>, there: &At<f64>, length: f64) -> f64 {
        let base = Line { y: 0.0, velocity: 0.0 };
        let part = here.slope / (here.slope - there.slope);
        let mut time = part * length;
        let mut at = *here;
        for _ in 0..TURNING_STEPS {
            at = self.later(here, time.clamp(0.0, length), base);
            let ahead = -at.slope / at.a;
            if ahead.abs() * self.fastest < NEAR {
                return at.gap + 0.5 * at.slope * ahead;
            }
            time += ahead;
        }
        at.gap
    }

    /// As [`Self::after`], by the instructions that every processor has.
    pub(super) fn later(&self, here: &At<f64>, s: f64, line: Line<f64>) -> At<f64> {
        dispatch!(Level::baseline(), simd => self.after(simd, here, s, line))
    }

    /// The steady motion at a phase.
    pub(super) fn steady(&self, phase: f64) -> Steady<f64> {
        let (sin, cos) = libm::sincos(phase);
        let Steady { x, v } = self.origin;
        Steady { x: x * cos + v / self.frequency * sin, v: v * cos - self.frequency * x * sin }
    }
}

impl<R: Real> Rates<R> {
    /// Time from a phase until the period is over.
    #[inline(always)]
    pub(super) fn left(&self, phase: R) -> R {
        (-phase + TAU) * self.inverse_frequency
    }

    /// The beginning of a flight, and how well the quintics of its panels are known.
    #[inline(always)]
    pub(super) fn begin(&self, x: R, v: R, steady: Steady<R>, line: Line<R>) -> (At<R>, Slack<R>) {
        let z = self.free(x - steady.x, v - steady.v);
        let size = (z[0] * z[0] + z[1] * z[1]).sqrt();
        let coefficient = self.sixth_free * size + self.sixth_steady;
        let bend = self.stiffness * size + self.second_steady;
        // 4 M S/14340 with S = 7200 times the coefficient.
        let slope_squared = bend * coefficient * 2.01;
        (self.at(z, steady, line), Slack { coefficient, slope_squared })
    }

    /// Whether a flight comes back to the wall that it begins on within a small part of a panel, as in
    /// a chattering sequence: its parabola alone, from which the step-by-step search begins, is then
    /// nearer than any halving.
    #[inline(always)]
    pub(super) fn short(&self, here: &At<R>) -> R::Mask {
        let one = here.gap.like(1.0);
        let wall = R::choose(here.gap.less(here.gap.like(0.0)), -one, one);
        let on = here.gap.like(ON_WALL).at_most(here.gap.abs());
        on & (here.slope.abs() * SHORT_FLIGHT).less(here.a * wall * self.step)
    }

    /// A whole panel after `here`, where the absorber is at the beginning of `line`.
    #[inline(always)]
    pub(super) fn next(&self, here: &At<R>, line: Line<R>) -> At<R> {
        let [cos, fall, rise] = self.swing;
        let steady = Steady {
            x: here.steady.x * cos + here.steady.v * fall,
            v: here.steady.v * cos - here.steady.x * rise,
        };
        self.at(multiply(here.z, self.turn), steady, line)
    }

    /// Time at which a panel's gap reaches `wall`, on its quintic: by inverse interpolation with both
    /// slopes, or from the end where the slope is towards the wall, and Newton's iteration. Only `lanes`
    /// matter.
    #[inline(always)]
    pub(super) fn guess(here: &At<R>, there: &At<R>, length: R, wall: R, lanes: R::Mask) -> R {
        let rise = there.gap - here.gap;
        let part = (wall - here.gap) / rise;
        let rest = -part + 1.0;
        let (v0, v1) = (here.slope * length, there.slope * length);
        let mut u = part * part * (-(part * 2.0) + 3.0)
            + rise * part * rest * (rest * v1 - part * v0) / (v0 * v1);
        let quintic = Quintic::through(here, there, length);
        let zero = u.like(0.0);
        let (leaves, comes_back) = ((v0 * wall).at_most(zero), (v1 * wall).at_most(zero));
        let turns = lanes & (leaves | comes_back);
        if turns.any() {
            let mut from_end = R::choose(leaves, u.like(1.0), zero);
            for _ in 0..STEPS_FROM_END {
                from_end = quintic.towards(wall, from_end);
            }
            u = R::choose(turns, from_end, u);
        }
        quintic.towards(wall, quintic.towards(wall, u)) * length
    }

    /// Corrects the time at which the gap reaches `wall` by one evaluation and the reverted series of
    /// third order.
    #[inline(always)]
    pub(super) fn corrected<S: Simd>(
        &self,
        simd: S,
        here: &At<R>,
        time: R,
        line: Line<R>,
        wall: R,
        slack: &Slack<R>,
    ) -> Corrected<R> {
        let at = self.after(simd, here, time, line);
        let (x, v) = self.oscillator(&at);
        let free_v = v - at.steady.v;
        let (twice, squared) = (self.twice_decay, self.squared);
        let free_a = at.a + squared * at.steady.x;
        let j = -(twice * free_a) - self.stiffness * free_v - squared * at.steady.v;
        let s = -(twice * (j + squared * at.steady.v)) - self.stiffness * free_a
            + squared * squared * at.steady.x;
        // w + w' e + w'' e^2/2 + w''' e^3/6 = 0, by the reverted series.
        let inverse_slope = time.like(1.0) / at.slope;
        let newton = (wall - at.gap) * inverse_slope;
        let (p, q) = (at.a * 0.5 * inverse_slope, j * (1.0 / 6.0) * inverse_slope);
        let e = newton * (-(newton * (p - newton * (p * p * 2.0 - q))) + 1.0);
        // The series' next term is five times the cube of its first; the expansion about the
        // evaluated point ends with the fourth order.
        let first = (newton * p).abs() + (newton * newton * q).abs();
        let left = newton.abs() * first * first * first;
        let slope = (at.slope + e * at.a) * wall;
        let first_root = e.like(0.0).less(slope) & slack.slope_squared.less(slope * slope);
        let near = (e.abs() * self.fastest).at_most(e.like(NEAR));
        let Steady { x: from, v: rate } = at.steady;
        let (bend, turn) = (-(squared * from), -(squared * rate));
        let steady = Steady {
            x: from + e * (rate + e * (bend * 0.5 + e * turn * (1.0 / 6.0))),
            v: rate + e * (bend + e * (turn * 0.5 - e * squared * bend * (1.0 / 6.0))),
        };
        Corrected {
            at,
            steady,
            time: time + e,
            x: x + e * (v + e * (at.a * 0.5 + e * (j * (1.0 / 6.0) + e * s * (1.0 / 24.0)))),
            v: v + e * (at.a + e * (j * 0.5 + e * s * (1.0 / 6.0))),
            exact: near & first_root & (left * self.fastest).at_most(left.like(LEFT)),
        }
    }

    /// The free motion's velocity, backwards.
    #[inline(always)]
    fn slowing(&self, z: [R; 2]) -> R {
        self.decay * z[0] + self.ringing * z[1]
    }

    /// Displacement and velocity of the oscillator.
    #[inline(always)]
    pub(super) fn oscillator(&self, at: &At<R>) -> (R, R) {
        (at.z[0] + at.steady.x, at.steady.v - self.slowing(at.z))
    }

    /// Free motion as a phasor.
    #[inline(always)]
    fn free(&self, x: R, v: R) -> [R; 2] {
        [x, -((v + self.decay * x) * self.inverse_ringing)]
    }

    /// Oscillator and gap where the free phasor is `z`, the steady motion `steady`, and the absorber
    /// at the beginning of `line`.
    #[inline(always)]
    pub(super) fn at(&self, z: [R; 2], steady: Steady<R>, line: Line<R>) -> At<R> {
        let slowing = self.slowing(z);
        let (x, v) = (z[0] + steady.x, steady.v - slowing);
        let a = self.twice_decay * slowing - self.stiffness * z[0] - self.squared * steady.x;
        At { z, steady, a, gap: x - line.y, slope: v - line.velocity }
    }

    /// A time `s`, less than a panel, after `here`, where the absorber's flight `line` begins.
    #[inline(always)]
    pub(super) fn after<S: Simd>(&self, simd: S, here: &At<R>, s: R, line: Line<R>) -> At<R> {
        let [(sin, cos), (swing_sin, swing_cos)] =
            small_angles(simd, [self.ringing * s, self.frequency * s]);
        let envelope = small_exponential(-(self.decay * s));
        let z = multiply(here.z, [envelope * cos, envelope * sin]);
        let Steady { x, v } = here.steady;
        let steady = Steady {
            x: x * swing_cos + v * self.inverse_frequency * swing_sin,
            v: v * swing_cos - self.frequency * x * swing_sin,
        };
        self.at(z, steady, line.from(s))
    }
}

/// A polynomial in the part of a panel, lowest power first.
struct Quintic<R>([R; 6]);

impl<R: Real> Quintic<R> {
    /// The one with the gap's values, slopes and curvatures at both ends.
    #[inline(always)]
    fn through(here: &At<R>, there: &At<R>, length: R) -> Self {
        let half = length * length * 0.5;
        let (v0, c2) = (here.slope * length, here.a * half);
        let bend = there.a * half - c2;
        let d = there.gap - here.gap - v0 - c2;
        let e = there.slope * length - v0 - c2 * 2.0;
        let c3 = d * 10.0 - e * 4.0 + bend;
        let c4 = e * 7.0 - d * 15.0 - bend * 2.0;
        let c5 = d * 6.0 - e * 3.0 + bend;
        Self([here.gap, v0, c2, c3, c4, c5])
    }

    /// One step of Newton from `u` towards `value`.
    #[inline(always)]
    fn towards(&self, value: R, u: R) -> R {
        let [c0, c1, c2, c3, c4, c5] = self.0;
        let at = c0 + u * (c1 + u * (c2 + u * (c3 + u * (c4 + u * c5))));
        let slope = c1 + u * (c2 * 2.0 + u * (c3 * 3.0 + u * (c4 * 4.0 + u * c5 * 5.0)));
        u + (value - at) / slope
    }
}

/// The coefficients of a panel's quintic in Bernstein's form, but for the first, which the panel before
/// has answered for.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hull<R> {
    inner: [R; 4],
    last: R,
    slack: R,
}

impl<R: Real> Hull<R> {
    #[inline(always)]
    pub(super) fn of(here: &At<R>, there: &At<R>, length: R, slack: &Slack<R>) -> Self {
        let part = length * 0.2;
        let curve = length * length * 0.05;
        let (v0, v1) = (here.slope * part, there.slope * part);
        Self {
            inner: [
                here.gap + v0,
                here.gap + v0 * 2.0 + here.a * curve,
                there.gap - v1 * 2.0 + there.a * curve,
                there.gap - v1,
            ],
            last: there.gap,
            slack: slack.coefficient,
        }
    }

    /// Where the gap is proven to stay between the walls. It may begin on one.
    #[inline(always)]
    pub(super) fn clear(&self) -> R::Mask {
        let [b1, b2, b3, b4] = self.inner;
        let one = b1.like(1.0);
        let highest = b1.larger(b2).larger(b3 + self.slack).larger(b4);
        let lowest = b1.smaller(b2).smaller(b3 - self.slack).smaller(b4);
        highest.at_most(one) & (-one).at_most(lowest) & self.last.abs().at_most(one)
    }

    /// Where it leaves the band through the wall nearest to its end, `wall`, and not before through
    /// the other: once, if the slope at the root is steep enough.
    #[inline(always)]
    pub(super) fn meets(&self, wall: R) -> R::Mask {
        let one = wall.like(1.0);
        let [b1, b2, b3, b4] = self.inner;
        let (b1, b2, b3, b4) = (b1 * wall, b2 * wall, b3 * wall, b4 * wall);
        let lowest = b1.smaller(b2).smaller(b3 - self.slack).smaller(b4);
        let b3 = b3 + self.slack;
        let beyond = [one.less(b1), one.less(b2), one.less(b3), one.less(b4)];
        one.less(self.last * wall)
            & (-one).at_most(lowest)
            & (!beyond[0] | beyond[1])
            & (!beyond[1] | beyond[2])
            & (!beyond[2] | beyond[3])
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

/// Units in the last place of the largest length involved that count as touching a wall.
pub(super) const TOUCH_ULPS: f64 = 16.0;

/// Distance over the clearance that rounding can move the walls by.
#[inline(always)]
pub(super) fn touch<R: Real>(x: R, v: R, line: Line<R>) -> R {
    let scale = x.abs() + 1.0 + v.abs() + line.y.abs() + line.velocity.abs();
    scale * (TOUCH_ULPS * f64::EPSILON)
}

/// Where a flight does not begin between the walls, nor leaves one.
#[inline(always)]
pub(super) fn blocked<R: Real>(x: R, v: R, line: Line<R>) -> R::Mask {
    let (gap, slope) = (x - line.y, v - line.velocity);
    let touch = touch(x, v, line);
    let beyond = (touch + 1.0).less(gap.abs());
    let on = (-touch + 1.0).at_most(gap.abs());
    beyond | (on & gap.like(0.0).at_most(gap * slope))
}

/// What tells whether an impact may be the end of a chattering sequence.
pub(super) struct Sticking<'a, R> {
    pub rates: &'a Rates<R>,
    pub largest_force: R,
    /// Tolerated opening of the gap.
    pub excursion: R,
    /// `1/(1 - r^2)`.
    pub inverse_loss: R,
}

/// Where the gap need not open further than tolerated after an impact on `wall`, whatever the
/// acceleration is.
#[inline(always)]
pub(super) fn may_stick<R: Real>(
    x: R,
    v: R,
    line: Line<R>,
    wall: R,
    by: &Sticking<'_, R>,
) -> R::Mask {
    let opening = -wall * (v - line.velocity);
    let excursion = by.excursion.larger(touch(x, v, line) * by.inverse_loss);
    let largest = by.largest_force + by.rates.decay * 2.0 * v.abs() + by.rates.stiffness * x.abs();
    (opening * opening).at_most(excursion * 2.0 * largest)
}

/// `c[0] + x (c[1] + x (...))`.
#[inline(always)]
fn series<R: Real, const N: usize>(x: R, coefficients: [f64; N]) -> R {
    let mut sum = x.like(coefficients[N - 1]);
    for k in (0..N - 1).rev() {
        sum = sum * x + coefficients[k];
    }
    sum
}

/// `1/k!` with the signs of a cosine's or sine's series, from `k = first` in steps of two.
const fn alternating(first: usize) -> [f64; 9] {
    let mut coefficients = [1.0; 9];
    let mut k = 1;
    while k < 9 {
        let place = (2 * k + first) as f64;
        coefficients[k] = -coefficients[k - 1] / (place * (place - 1.0));
        k += 1;
    }
    coefficients
}

/// Sine and cosine of two angles of at most [`LARGEST_ANGLE`], to rounding: the first terms left out are
/// below `0.8^18/18! = 3e-18`.
#[inline(always)]
fn small_angles<R: Real, S: Simd>(simd: S, [a, b]: [R; 2]) -> [(R, R); 2] {
    const SERIES: [[f64; 4]; 9] = {
        let (sine, cosine) = (alternating(1), alternating(0));
        let mut series = [[0.0; 4]; 9];
        let mut k = 0;
        while k < 9 {
            series[k] = [sine[k], cosine[k], sine[k], cosine[k]];
            k += 1;
        }
        series
    };
    let (a_squared, b_squared) = (a * a, b * b);
    let squared = [a_squared, a_squared, b_squared, b_squared];
    let [a_sin, a_cos, b_sin, b_cos] = R::polynomials(simd, squared, &SERIES);
    [(a * a_sin, a_cos), (b * b_sin, b_cos)]
}

/// `e^x` for `-0.78 < x <= 0`: an oscillator that rings decays no more in a panel.
#[inline(always)]
fn small_exponential<R: Real>(x: R) -> R {
    const INVERSE_FACTORIALS: [f64; 18] = {
        let mut coefficients = [1.0; 18];
        let mut k = 1;
        while k < 18 {
            coefficients[k] = coefficients[k - 1] / k as f64;
            k += 1;
        }
        coefficients
    };
    let [c0, c1, c2, c3, c4, c5, c6, c7, ..] = INVERSE_FACTORIALS;
    // 0.02^8/8! is 6e-19, and 0.78^18/18! is 2e-18.
    let short = series(x, [c0, c1, c2, c3, c4, c5, c6, c7]);
    let far = x.less(x.like(-0.02));
    if far.any() {
        return R::choose(far, series(x, INVERSE_FACTORIALS), short);
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{Excitation, Parameters, System};

    #[test]
    fn small_series_are_exact_to_rounding() {
        for k in 0..=400 {
            let part = f64::from(k) / 400.0;
            let angle = LARGEST_ANGLE * part;
            let [(sin, cos), other] =
                dispatch!(Level::baseline(), simd => small_angles(simd, [angle, -angle]));
            assert_eq!(other, (-sin, cos));
            assert!((sin - libm::sin(angle)).abs() <= 2.0 * f64::EPSILON * angle);
            assert!((cos - libm::cos(angle)).abs() <= f64::EPSILON);
            let decay = -0.78 * part;
            assert!((small_exponential(decay) - libm::exp(decay)).abs() <= f64::EPSILON);
        }
    }

    fn oscillator(mass_ratio: f64, damping: f64, frequency_ratio: f64) -> Oscillator {
        let parameters = Parameters {
            mass_ratio,
            damping,
            restitution: 0.5,
            frequency_ratio,
            forcing_per_clearance: 0.7 / mass_ratio,
            excitation: Excitation::Force,
        };
        Oscillator::alone(&System::new(parameters).expect("valid"))
    }

    /// A panel's quintic, in Bernstein's form.
    fn quintic(here: &At<f64>, hull: &Hull<f64>, u: f64) -> f64 {
        let [b1, b2, b3, b4] = hull.inner;
        let row = [here.gap, b1, b2, b3, b4, hull.last];
        let weights = [1.0, 5.0, 10.0, 10.0, 5.0, 1.0];
        (0..6).fold(0.0, |sum, k| {
            let power = libm::pow(u, k as f64) * libm::pow(1.0 - u, 5.0 - k as f64);
            sum + row[k] * weights[k] * power
        })
    }

    /// The remainder that the proof stands on, against the motion itself; and that it is no giant.
    #[test]
    fn the_gap_is_as_near_to_its_quintic_as_the_proof_says() {
        let mut nearest = 0.0_f64;
        for (eps, lambda, omega) in [
            (0.01, 1.0, 1.0),
            (0.3, 0.0, 0.4),
            (0.5, 3.0, 4.0),
            (0.01, 90.0, 0.97),
            (0.1, 1.0, 1.3),
        ] {
            let rates = Rates::of(&oscillator(eps, lambda, omega)).expect("it rings");
            for k in 0..40 {
                let phase = TAU * f64::from(k) / 40.0;
                let line = Line { y: 0.2, velocity: 0.3 };
                let (x, v) = (libm::sin(3.0 * phase), 1.5 * libm::cos(5.0 * phase));
                let (here, slack) = rates.begin(x, v, rates.steady(phase), line);
                let there = rates.next(&here, line.from(rates.step));
                let hull = Hull::of(&here, &there, rates.step, &slack);
                for j in 1..20 {
                    let u = f64::from(j) / 20.0;
                    let at = rates.later(&here, u * rates.step, line);
                    let off = (at.gap - quintic(&here, &hull, u)).abs();
                    let cubed = libm::pow(u * (1.0 - u), 3.0);
                    // Ten times the coefficient is S/720; the gap is rounded at the size of `x`.
                    let bound = 10.0 * slack.coefficient * cubed;
                    assert!(
                        off <= bound + 1e-14,
                        "{eps} {lambda} {omega} {k} {u}: {off:e} {bound:e}"
                    );
                    nearest = nearest.max(off / bound);
                }
            }
        }
        assert!(nearest > 0.5, "{nearest}: the bound is never nearly reached");
    }

    #[test]
    fn coefficients_say_where_a_gap_stays_and_where_it_leaves() {
        let hull = |inner: [f64; 4], last: f64| Hull { inner, last, slack: 0.01 };
        assert!(hull([0.9, -0.9, 0.98, 0.0], 1.0).clear());
        assert!(!hull([0.9, -0.9, 0.995, 0.0], 1.0).clear(), "within the slack");
        assert!(!hull([0.9, -0.9, -0.995, 0.0], 1.0).clear(), "within the slack");
        for outside in 0..4 {
            for wall in [1.0, -1.0] {
                let mut inner = [0.0; 4];
                inner[outside] = 1.1 * wall;
                assert!(!hull(inner, 0.5).clear() && !hull(inner, 0.5).meets(wall));
                // Out, in again, and out at last: or out for good.
                assert_eq!(hull(inner, 1.1 * wall).meets(wall), outside == 3);
                // Or by way of the other wall.
                assert!(!hull(inner, -1.1 * wall).meets(-wall));
            }
        }
        assert!(hull([0.5, 0.9, 1.1, 1.2], 1.3).meets(1.0));
        assert!(hull([-0.5, -0.9, -1.1, -1.2], -1.3).meets(-1.0));
        assert!(!hull([0.5, 1.2, 0.995, 1.2], 1.3).meets(-1.0));
        assert!(!hull([0.5, 1.2, 0.98, 1.2], 1.3).meets(1.0));
        assert!(hull([0.5, 1.2, 0.995, 1.2], 1.3).meets(1.0), "the outer quintic is beyond");
        assert!(!hull([0.5, 0.6, 0.7, 0.8], 0.9).meets(1.0));
        assert!(!hull([0.5, f64::NAN, 0.7, 0.8], f64::NAN).clear());
    }
}
