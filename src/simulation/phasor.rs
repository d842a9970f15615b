//! The oscillator as the sum of two rotating phasors, so that no sine and no exponential is evaluated
//! between impacts; for one trajectory or for several side by side, with the same bits.
//!
//! A flight is divided into equal panels, from its beginning on. From one end of a panel to the other
//! the free motion `Re z`, `z -> z e^{p h}`, and the steady motion are turned by constant factors, a
//! complex product each; inside a panel both are reached by short series in small angles. What
//! rounding adds to the steady motion is forgotten at the end of each period, where its value is known.
//!
//! **Nothing is stepped over.** The relative displacement `w`, its slope `v` and its acceleration `a`
//! are known at both ends of a panel of length `h`, and `|w'''| <= J` in it: `J = |p|^3 |z| +
//! Omega^3 F` at the beginning of the flight, as `|z|` shrinks. So `w'' <= A`, the larger of the two
//! accelerations (towards the upper wall, say) plus `J h/2`, or 0 if that is negative, and `w` lies
//! below both parabolas `w0 + v0 s + A s^2/2` and `w1 - v1 (h - s) + A (h - s)^2/2`. They meet once, at
//! `s*`, and being convex they exceed their ends nowhere else: if `w0`, `w1` and their common value at
//! `s*` are inside the band, so is all of `w`.
//!
//! If `w1` is outside, `w` crosses once and once only in two cases: it *rises*, when both slopes exceed
//! `J h^2/8`, by which the slope can differ from its chord; or it *dips*, when it begins inwards or
//! inside and the mean of the two accelerations exceeds `J h/2`, for then `w` is convex, and as it lies
//! above both its tangents, where these meet must not be beyond the other wall.
//!
//! Any other panel is halved, which quarters the parabolas' excess; below a thousandth of a panel the
//! search of [`crate::numerics::crossing`] takes over.

use std::f64::consts::TAU;

use super::flow::Oscillator;
use crate::numerics::lanes::{Mask, Real};

/// Largest angle by which either phasor turns in a panel; its series below end accordingly.
const LARGEST_ANGLE: f64 = 0.6;
/// Most panels in a period: each may turn the steady motion too far by `1e-16` of itself.
const MOST_PANELS: f64 = 64.0;
/// Distance from a root within which a correction to the fourth order is exact to rounding: the next
/// term is below `1e-20/120`.
const NEAR: f64 = 1e-4;
/// Steps of Newton from the end of a panel in which the gap dips, before the one that every root gets.
const DIP_STEPS: u32 = 3;
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
    pub decay: R,
    pub ringing: R,
    pub inverse_ringing: R,
    pub stiffness: R,
    pub natural_cubed: R,
    pub steady_jerk: R,
    /// `e^{p h}`.
    pub turn: [R; 2],
    /// `cos`, `sin/Omega` and `Omega sin` of `Omega h`.
    pub swing: [R; 3],
    /// The steady motion at phase 0.
    pub origin: Steady<R>,
}

/// How the gap meets a wall in a panel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Crosses<M> {
    /// With a slope that is towards it everywhere.
    pub rises: M,
    /// With an acceleration that is towards it everywhere.
    pub dips: M,
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
    /// Whether nothing above rounding is left.
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
        let (swing_sin, swing_cos) = libm::sincos(frequency * step);
        Some(Self {
            fastest,
            step,
            frequency,
            inverse_frequency: 1.0 / frequency,
            decay: oscillator.decay,
            ringing,
            inverse_ringing: 1.0 / ringing,
            stiffness: oscillator.stiffness,
            natural_cubed: root * oscillator.stiffness,
            steady_jerk: frequency * frequency * frequency * libm::hypot(sine, cosine),
            turn: [envelope * cos, envelope * sin],
            swing: [swing_cos, swing_sin / frequency, swing_sin * frequency],
            origin: Steady { x: cosine, v: frequency * sine },
        })
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

    /// The beginning of a flight, and a bound on the jerk from there on.
    #[inline(always)]
    pub(super) fn begin(&self, x: R, v: R, steady: Steady<R>, line: Line<R>) -> (At<R>, R) {
        let z = self.free(x - steady.x, v - steady.v);
        let here = self.at(z, steady, line);
        let size = (z[0] * z[0] + z[1] * z[1]).sqrt();
        (here, self.natural_cubed * size + self.steady_jerk)
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

    /// Where the gap meets the wall at `sign`, 1 or -1, in a panel once and once only, and
    /// not the other wall before.
    #[inline(always)]
    pub(super) fn crosses(
        here: &At<R>,
        there: &At<R>,
        length: R,
        jerk: R,
        sign: R,
    ) -> Crosses<R::Mask> {
        let one = length.like(1.0);
        let slack = jerk * length * length * 0.125;
        let beyond = one.less(there.gap * sign);
        let below = (here.gap * sign).less(one);
        let rises = beyond & below & slack.less(here.slope * sign) & slack.less(there.slope * sign);
        if !(beyond & !rises).any() {
            return Crosses { rises, dips: !(rises | !rises) };
        }
        let falls = (here.slope * sign).less(length.like(0.0));
        let convex = (jerk * length).less((here.a + there.a) * sign);
        let returns = extreme(here, there, length, length.like(0.0), -sign).at_most(one);
        Crosses { rises, dips: beyond & !rises & convex & (falls | below) & returns }
    }

    /// Time at which a panel's gap reaches `wall`, on the quintic that has the gap's values, slopes
    /// and curvatures at both ends: by inverse interpolation with both slopes, or from the panel's end
    /// if it dips, and Newton's iteration.
    #[inline(always)]
    pub(super) fn guess(here: &At<R>, there: &At<R>, length: R, wall: R, dips: R::Mask) -> R {
        let rise = there.gap - here.gap;
        let part = (wall - here.gap) / rise;
        let rest = -part + 1.0;
        let (v0, v1) = (here.slope * length, there.slope * length);
        let mut u = part * part * (-(part * 2.0) + 3.0)
            + rise * part * rest * (rest * v1 - part * v0) / (v0 * v1);
        let quintic = Quintic::through(here, there, length);
        if dips.any() {
            let mut last = u.like(1.0);
            for _ in 0..DIP_STEPS {
                last = quintic.towards(wall, last);
            }
            u = R::choose(dips, last, u);
        }
        quintic.towards(wall, u) * length
    }

    /// Corrects the time at which the gap reaches `wall` by one evaluation and the reverted series of
    /// third order.
    #[inline(always)]
    pub(super) fn corrected(&self, here: &At<R>, time: R, line: Line<R>, wall: R) -> Corrected<R> {
        let at = self.after(here, time, line);
        let (x, v) = self.oscillator(&at);
        let free_v = v - at.steady.v;
        let twice = self.decay * 2.0;
        let squared = self.frequency * self.frequency;
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
            exact: near & (left * self.fastest).at_most(left.like(LEFT)),
        }
    }

    /// Displacement and velocity of the oscillator.
    #[inline(always)]
    pub(super) fn oscillator(&self, at: &At<R>) -> (R, R) {
        let free_v = -(self.decay * at.z[0]) - self.ringing * at.z[1];
        (at.z[0] + at.steady.x, free_v + at.steady.v)
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
        let free_v = -(self.decay * z[0]) - self.ringing * z[1];
        let (x, v) = (z[0] + steady.x, free_v + steady.v);
        let a = -(self.decay * 2.0 * free_v)
            - self.stiffness * z[0]
            - self.frequency * self.frequency * steady.x;
        At { z, steady, a, gap: x - line.y, slope: v - line.velocity }
    }

    /// A time `s`, less than a panel, after `here`, where the absorber's flight `line` begins.
    #[inline(always)]
    pub(super) fn after(&self, here: &At<R>, s: R, line: Line<R>) -> At<R> {
        let z = multiply(here.z, self.propagated(s));
        self.at(z, self.turned(here.steady, s), line.from(s))
    }

    /// `e^{p s}` for less than a panel.
    #[inline(always)]
    fn propagated(&self, s: R) -> [R; 2] {
        let (sin, cos) = small_angle(self.ringing * s);
        let envelope = small_exponential(-(self.decay * s));
        [envelope * cos, envelope * sin]
    }

    /// The steady motion less than a panel later.
    #[inline(always)]
    fn turned(&self, steady: Steady<R>, s: R) -> Steady<R> {
        let (sin, cos) = small_angle(self.frequency * s);
        Steady {
            x: steady.x * cos + steady.v * self.inverse_frequency * sin,
            v: steady.v * cos - self.frequency * steady.x * sin,
        }
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

/// Where the gap is seen at once to stay between the walls: it begins there, or leaves a wall, and one
/// of the two parabolas alone stays below each wall.
#[inline(always)]
pub(super) fn clear<R: Real>(here: &At<R>, there: &At<R>, length: R, jerk: R) -> R::Mask {
    let one = length.like(1.0);
    let [up, down] = bounds(here, there, length, jerk);
    let half = length * length * 0.5;
    let (before, after) = (here.gap + here.slope * length, there.gap - there.slope * length);
    let (up, down) = (up * half, down * half);
    let below = (before + up).at_most(one) | (after + up).at_most(one);
    let above = (-one).at_most(before - down) | (-one).at_most(after - down);
    below & above & there.gap.abs().at_most(one)
}

/// Bounds on the gap's acceleration towards the upper and the lower wall, 0 at least.
#[inline(always)]
fn bounds<R: Real>(here: &At<R>, there: &At<R>, length: R, jerk: R) -> [R; 2] {
    let (zero, slack) = (length.like(0.0), jerk * length * 0.5);
    let up = here.a.larger(there.a) + slack;
    let down = (-here.a).larger(-there.a) + slack;
    [up.larger(zero), down.larger(zero)]
}

/// Where the gap is proven to stay between the walls, by both parabolas of the module's explanation.
/// It may begin on a wall.
#[inline(always)]
pub(super) fn inside<R: Real>(here: &At<R>, there: &At<R>, length: R, jerk: R) -> R::Mask {
    let one = length.like(1.0);
    let [up, down] = bounds(here, there, length, jerk);
    extreme(here, there, length, up, one).at_most(one)
        & extreme(here, there, length, down, -one).at_most(one)
        & there.gap.abs().at_most(one)
}

/// What the gap times `sign` does not exceed inside a panel, unless at its ends, if `bound >= 0` is one
/// on its second derivative: where the two parabolas meet.
#[inline(always)]
fn extreme<R: Real>(here: &At<R>, there: &At<R>, length: R, bound: R, sign: R) -> R {
    let (w0, w1) = (here.gap * sign, there.gap * sign);
    let (v0, v1) = (here.slope * sign, there.slope * sign);
    let reach = bound * length;
    let at = (w1 - w0 - v1 * length + reach * length * 0.5) / (v0 - v1 + reach);
    let at = at.larger(length.like(0.0)).smaller(length);
    w0 + at * (v0 + bound * at * 0.5)
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
const fn alternating(first: usize) -> [f64; 8] {
    let mut coefficients = [1.0; 8];
    let mut k = 1;
    while k < 8 {
        let place = (2 * k + first) as f64;
        coefficients[k] = -coefficients[k - 1] / (place * (place - 1.0));
        k += 1;
    }
    coefficients
}

/// Sine and cosine of at most [`LARGEST_ANGLE`], to rounding: the first terms left out are below
/// `0.6^16/16! = 2e-17`.
#[inline(always)]
fn small_angle<R: Real>(angle: R) -> (R, R) {
    const COSINE: [f64; 8] = alternating(0);
    const SINE: [f64; 8] = alternating(1);
    let squared = angle * angle;
    (angle * series(squared, SINE), series(squared, COSINE))
}

/// `e^x` for `-0.55 < x <= 0`: an oscillator that rings decays no more in a panel.
#[inline(always)]
fn small_exponential<R: Real>(x: R) -> R {
    const INVERSE_FACTORIALS: [f64; 16] = {
        let mut coefficients = [1.0; 16];
        let mut k = 1;
        while k < 16 {
            coefficients[k] = coefficients[k - 1] / k as f64;
            k += 1;
        }
        coefficients
    };
    let [c0, c1, c2, c3, c4, c5, c6, c7, ..] = INVERSE_FACTORIALS;
    // 0.02^8/8! is 6e-19, and 0.55^16/16! is 3e-18.
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

    #[test]
    fn small_series_are_exact_to_rounding() {
        for k in 0..=400 {
            let part = f64::from(k) / 400.0;
            let angle = LARGEST_ANGLE * part;
            let (sin, cos) = small_angle(angle);
            assert!((sin - libm::sin(angle)).abs() <= 2.0 * f64::EPSILON * angle);
            assert!((cos - libm::cos(angle)).abs() <= f64::EPSILON);
            let decay = -0.55 * part;
            assert!((small_exponential(decay) - libm::exp(decay)).abs() <= f64::EPSILON);
        }
    }
}
