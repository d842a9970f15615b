//! Flights in panels: the oscillator as the sum of two rotating phasors, so that no sine and no
//! exponential is evaluated between impacts.
//!
//! The excitation period is divided into equal panels. At their ends the steady motion comes from a
//! table, exact to rounding for ever; the free motion `Re z`, `z -> z e^{p h}`, is one complex product
//! further. Inside a panel both are reached by short series in small angles.
//!
//! **Nothing is stepped over.** With the relative displacement `w` and its slope `v` known at both
//! ends of a panel of length `h`, and `|w''| <= M` in it, `w` lies below both parabolas
//! `w0 + v0 s + M s^2/2` and `w1 - v1 (h - s) + M (h - s)^2/2`. They meet once, at `s*`, and being
//! convex they exceed their ends nowhere else: if `w0`, `w1` and their common value at `s*` are inside
//! the band, so is all of `w`. If `w1` is outside and `(v0 + v1)/2 - M h/2 > 0` (towards that wall),
//! the slope, which differs from `v0` by at most `M s` and from `v1` by at most `M (h - s)`, is
//! positive everywhere, and `w` crosses once. Any other panel is halved, which quarters the parabolas'
//! excess; below a thousandth of a panel the search of [`crate::numerics::crossing`] takes over.
//!
//! `M` is the larger acceleration at the two ends plus half a panel of the largest jerk,
//! `|p|^3 |z| + Omega^3 F`: `|z|` shrinks.

use std::f64::consts::TAU;

use super::events::Side;
use super::flow::Oscillator;

/// Largest angle by which either phasor turns in a panel; its series below end accordingly.
const LARGEST_ANGLE: f64 = 0.4;
/// Most panels in a period: beyond, the table would not stay near the processor, and the motion is
/// not of the kind that impacts drive.
const MOST_PANELS: usize = 4096;
/// Part of a panel below which nothing is halved further: the slow search takes over.
const SHORTEST: f64 = 1e-3;
/// Distance from a root within which a third-order correction is exact to rounding: the fourth-order
/// term is below `1e-16/24`.
const NEAR: f64 = 1e-4;
/// What a correction may leave, over the fastest time scale: five times this is below rounding.
const LEFT: f64 = 1e-17;
/// Corrections before the slow search takes over; from inverse interpolation two suffice.
const CORRECTIONS: u32 = 6;

/// The steady motion at a panel's end.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Steady {
    x: f64,
    v: f64,
}

/// An underdamped oscillator and its excitation, in panels of the period.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Panels {
    fastest: f64,
    step: f64,
    phase_step: f64,
    frequency: f64,
    inverse_frequency: f64,
    decay: f64,
    ringing: f64,
    stiffness: f64,
    natural_cubed: f64,
    steady_jerk: f64,
    /// `e^{p h}`.
    turn: [f64; 2],
    /// At the beginning of each panel, and at the end of the last.
    steady: Vec<Steady>,
}

/// The absorber's flight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Line {
    /// Displacement at its beginning.
    pub y: f64,
    /// Velocity.
    pub velocity: f64,
}

impl Line {
    /// The rest of it, from a time `s` on.
    fn from(self, s: f64) -> Self {
        Self { y: self.y + self.velocity * s, ..self }
    }
}

/// How a flight ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Landing {
    /// On a wall.
    Impact { side: Side, phase: f64, time: f64, x: f64, v: f64 },
    /// The period is over.
    PeriodEnd { time: f64, x: f64, v: f64 },
    /// Nothing is proven: the slow search must fly it.
    Doubt,
}

/// Oscillator and gap at one moment.
#[derive(Debug, Clone, Copy)]
struct At {
    /// Free phasor.
    z: [f64; 2],
    steady: Steady,
    x: f64,
    v: f64,
    a: f64,
    /// `w = x - y` and its slope.
    gap: f64,
    slope: f64,
}

impl Panels {
    /// The panels of an oscillator; `None` where it does not ring, has no steady motion that could
    /// be subtracted, or would need too many.
    pub(super) fn of(oscillator: &Oscillator) -> Option<Self> {
        let (sine, cosine) = oscillator.steady()?;
        let frequency = oscillator.frequency;
        let root = oscillator.stiffness.sqrt();
        let discriminant = (root - oscillator.decay) * (root + oscillator.decay);
        let ringing = discriminant.max(0.0).sqrt();
        let fastest = root.max(frequency);
        let count = (TAU / frequency * fastest / LARGEST_ANGLE).ceil();
        // A motion that decays within some panels has series of its own.
        let rings = ringing > 0.5 * root;
        if !(rings && count <= MOST_PANELS as f64) {
            return None;
        }
        let phase_step = TAU / count;
        let step = phase_step / frequency;
        let (sin, cos) = libm::sincos(ringing * step);
        let envelope = libm::exp(-oscillator.decay * step);
        let steady = (0..=count as usize)
            .map(|k| {
                // The end of the last panel is the beginning of the first.
                let index = if k == count as usize { 0 } else { k };
                let (sin, cos) = libm::sincos(phase_step * index as f64);
                Steady { x: sine * sin + cosine * cos, v: frequency * (sine * cos - cosine * sin) }
            })
            .collect();
        Some(Self {
            fastest,
            step,
            phase_step,
            frequency,
            inverse_frequency: 1.0 / frequency,
            decay: oscillator.decay,
            ringing,
            stiffness: oscillator.stiffness,
            natural_cubed: root * oscillator.stiffness,
            steady_jerk: frequency * frequency * frequency * libm::hypot(sine, cosine),
            turn: [envelope * cos, envelope * sin],
            steady,
        })
    }

    /// Flies from displacement `x`, velocity `v` at `phase`, with the absorber on `line`, to the first
    /// impact or the end of the period. Evaluations of the motion are added to `evaluations`.
    pub(super) fn fly(
        &self,
        phase: f64,
        x: f64,
        v: f64,
        line: Line,
        evaluations: &mut u64,
    ) -> Landing {
        let last = self.steady.len() - 1;
        let mut k = ((phase / self.phase_step) as usize).min(last - 1);
        let mut offset = (phase - self.phase_step * k as f64) / self.frequency;
        if offset >= self.step {
            (k, offset) = (k + 1, 0.0);
        }
        if k >= last {
            return Landing::Doubt;
        }
        let steady = self.turned(self.steady[k], offset);
        let mut here = self.at(self.free(x - steady.x, v - steady.v), steady, line);
        let mut length = self.step - offset;
        let mut turn = if offset == 0.0 { self.turn } else { self.propagated(length) };
        let size = (here.z[0] * here.z[0] + here.z[1] * here.z[1]).sqrt();
        let jerk = self.natural_cubed * size + self.steady_jerk;
        let mut time = 0.0;
        let first = k;
        loop {
            let there =
                self.at(multiply(here.z, turn), self.steady[k + 1], line.from(time + length));
            let bound = here.a.abs().max(there.a.abs()) + 0.5 * jerk * length;
            if !inside(&here, &there, length, bound)
                && let Some(found) =
                    self.search(here, there, length, jerk, line.from(time), evaluations)
            {
                *evaluations += (k + 1 - first) as u64;
                let begin = self.phase_step * k as f64 + self.frequency * (self.step - length);
                return found.landing(begin, self.frequency, time);
            }
            time += length;
            k += 1;
            if k == last {
                *evaluations += (k - first) as u64;
                return Landing::PeriodEnd { time, x: there.x, v: there.v };
            }
            here = there;
            (length, turn) = (self.step, self.turn);
        }
    }

    /// The first crossing in a panel that is not clear; `None` if there is none after all.
    fn search(
        &self,
        here: At,
        there: At,
        length: f64,
        jerk: f64,
        line: Line,
        evaluations: &mut u64,
    ) -> Option<Found> {
        let bound = here.a.abs().max(there.a.abs()) + 0.5 * jerk * length;
        for side in [Side::Plus, Side::Minus] {
            let sign = side.sign();
            let mean = 0.5 * sign * (here.slope + there.slope);
            if sign * there.gap > 1.0 && mean > 0.5 * bound * length && sign * here.gap < 1.0 {
                return Some(self.root(&here, &there, length, line, side, evaluations));
            }
        }
        if inside(&here, &there, length, bound) {
            return None;
        }
        if length < SHORTEST * self.step {
            return Some(Found::Doubt);
        }
        let half = 0.5 * length;
        let middle = self.after(&here, half, line);
        *evaluations += 1;
        self.search(here, middle, half, jerk, line, evaluations).or_else(|| {
            self.search(middle, there, half, jerk, line.from(half), evaluations)
                .map(|found| found.later(half))
        })
    }

    /// The only crossing in a panel: inverse interpolation, then a correction of third order from
    /// one evaluation.
    fn root(
        &self,
        here: &At,
        there: &At,
        length: f64,
        line: Line,
        side: Side,
        evaluations: &mut u64,
    ) -> Found {
        let wall = side.sign();
        let rise = there.gap - here.gap;
        let part = (wall - here.gap) / rise;
        let rest = 1.0 - part;
        let mut time = length * part * part * (3.0 - 2.0 * part)
            + rise * part * rest * (rest / here.slope - part / there.slope);
        for _ in 0..CORRECTIONS {
            time = time.clamp(0.0, length);
            *evaluations += 1;
            let at = self.after(here, time, line);
            let free_a =
                -2.0 * self.decay * (at.v - at.steady.v) - self.stiffness * (at.x - at.steady.x);
            let squared = self.frequency * self.frequency;
            let a = free_a - squared * at.steady.x;
            let j = -2.0 * self.decay * free_a
                - self.stiffness * (at.v - at.steady.v)
                - squared * at.steady.v;
            let s = -2.0 * self.decay * (j + squared * at.steady.v) - self.stiffness * free_a
                + squared * squared * at.steady.x;
            // w + w' e + w'' e^2/2 + w''' e^3/6 = 0, by the reverted series.
            let newton = (wall - at.gap) / at.slope;
            let (p, q) = (0.5 * a / at.slope, j / (6.0 * at.slope));
            let e = newton * (1.0 - newton * (p - newton * (2.0 * p * p - q)));
            // The series' next term is five times the cube of its first; the expansion about the
            // evaluated point ends with the third order.
            let first = (newton * p).abs() + (newton * newton * q).abs();
            let left = newton.abs() * first * first * first;
            if e.abs() * self.fastest <= NEAR && left * self.fastest <= LEFT {
                return Found::Crossing {
                    side,
                    time: time + e,
                    x: at.x + e * (at.v + e * (0.5 * a + e * (j / 6.0 + e * s / 24.0))),
                    v: at.v + e * (a + e * (0.5 * j + e * s / 6.0)),
                };
            }
            time += e;
        }
        Found::Doubt
    }

    /// Free motion as a phasor.
    fn free(&self, x: f64, v: f64) -> [f64; 2] {
        [x, -(v + self.decay * x) / self.ringing]
    }

    fn at(&self, z: [f64; 2], steady: Steady, line: Line) -> At {
        let free_v = -self.decay * z[0] - self.ringing * z[1];
        let (x, v) = (z[0] + steady.x, free_v + steady.v);
        let a = -2.0 * self.decay * free_v
            - self.stiffness * z[0]
            - self.frequency * self.frequency * steady.x;
        At { z, steady, x, v, a, gap: x - line.y, slope: v - line.velocity }
    }

    /// A time `s`, less than a panel, after `here`, where the absorber's flight `line` begins.
    #[inline]
    fn after(&self, here: &At, s: f64, line: Line) -> At {
        let z = multiply(here.z, self.propagated(s));
        self.at(z, self.turned(here.steady, s), line.from(s))
    }

    /// `e^{p s}` for less than a panel.
    fn propagated(&self, s: f64) -> [f64; 2] {
        let (sin, cos) = small_angle(self.ringing * s);
        let envelope = small_exponential(-self.decay * s);
        [envelope * cos, envelope * sin]
    }

    /// The steady motion less than a panel later.
    fn turned(&self, steady: Steady, s: f64) -> Steady {
        let (sin, cos) = small_angle(self.frequency * s);
        Steady {
            x: steady.x * cos + steady.v * self.inverse_frequency * sin,
            v: steady.v * cos - self.frequency * steady.x * sin,
        }
    }
}

#[derive(Debug, Clone, Copy)]
enum Found {
    Crossing { side: Side, time: f64, x: f64, v: f64 },
    Doubt,
}

impl Found {
    /// The end of the flight that this is, in a panel that begins at `phase`, `time` after it.
    fn landing(self, phase: f64, frequency: f64, time: f64) -> Landing {
        match self {
            Self::Crossing { side, time: after, x, v } => {
                Landing::Impact { side, phase: phase + frequency * after, time: time + after, x, v }
            }
            Self::Doubt => Landing::Doubt,
        }
    }

    fn later(self, by: f64) -> Self {
        match self {
            Self::Crossing { side, time, x, v } => Self::Crossing { side, time: time + by, x, v },
            Self::Doubt => Self::Doubt,
        }
    }
}

/// Whether the gap is proven to stay between the walls, by the parabolas of the module's
/// explanation. It may begin on a wall.
fn inside(here: &At, there: &At, length: f64, bound: f64) -> bool {
    let curve = 0.5 * bound * length * length;
    // A chord is missed by at most M h^2/8.
    if here.gap.abs().max(there.gap.abs()) + 0.25 * curve <= 1.0 {
        return true;
    }
    let reach = bound * length;
    let chord = there.gap - here.gap;
    let turn = there.slope * length;
    let up = ((chord - turn + curve) / (here.slope - there.slope + reach)).clamp(0.0, length);
    let down = ((turn - chord + curve) / (there.slope - here.slope + reach)).clamp(0.0, length);
    let highest = here.gap + up * (here.slope + 0.5 * bound * up);
    let lowest = here.gap + down * (here.slope - 0.5 * bound * down);
    highest <= 1.0 && lowest >= -1.0 && there.gap.abs() <= 1.0
}

fn multiply(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// Sine and cosine of at most [`LARGEST_ANGLE`], to rounding: the first terms left out are below
/// `0.4^15/15! = 8e-19`.
#[inline]
fn small_angle(angle: f64) -> (f64, f64) {
    let q = angle * angle;
    let sin = 1.0
        + q * (-1.0 / 6.0
            + q * (1.0 / 120.0
                + q * (-1.0 / 5040.0
                    + q * (1.0 / 362_880.0
                        + q * (-1.0 / 39_916_800.0 + q * (1.0 / 6_227_020_800.0))))));
    let cos = 1.0
        + q * (-0.5
            + q * (1.0 / 24.0
                + q * (-1.0 / 720.0
                    + q * (1.0 / 40_320.0
                        + q * (-1.0 / 3_628_800.0 + q * (1.0 / 479_001_600.0))))));
    (angle * sin, cos)
}

/// `e^x` for small negative `x`; larger ones are left to the library.
#[inline]
fn small_exponential(x: f64) -> f64 {
    if x < -0.02 {
        return libm::exp(x);
    }
    // 0.02^8/8! is 6e-19.
    1.0 + x
        * (1.0
            + x * (0.5
                + x * (1.0 / 6.0
                    + x * (1.0 / 24.0
                        + x * (1.0 / 120.0 + x * (1.0 / 720.0 + x * (1.0 / 5040.0)))))))
}
