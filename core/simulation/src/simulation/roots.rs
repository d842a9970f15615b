//! When a flight in a panel reaches a wall, and when sliding ends: a guess on the panel's quintic, corrected by one
//! evaluation and a series.

use fearless_simd::Simd;

use super::certificate::{Jet, Quintic};
use super::path::Path;
use super::phasor::{FlightState, NEAR, Rates, Slack, Steady};
use crate::numerics::lanes::{Mask, Real};

/// Most steps of Halley's iteration on a quintic.
const STEPS: u32 = 4;
/// Part of a panel by which a step may move a guess to be the last: they converge with the third power.
const NEXT: f64 = 0.06;
/// What a correction may leave, over the fastest time scale: five times this is below rounding.
const LEFT: f64 = 1e-17;

/// A root, corrected once.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corrected<R: Real> {
    /// Where it was evaluated.
    pub at: FlightState<R>,
    pub time: R,
    pub x: R,
    pub v: R,
    pub steady: Steady<R>,
    /// Whether nothing above rounding is left, and the root is proven to be the first.
    pub exact: R::Mask,
}

impl<R: Real> Rates<R> {
    /// Time at which a panel's gap reaches `wall`, on its quintic: by inverse interpolation with both
    /// slopes, or from the end where the slope is towards the wall, and Newton's iteration. Only `lanes`
    /// matter.
    #[inline(always)]
    pub(super) fn guess(
        here: &impl Jet<R>,
        there: &impl Jet<R>,
        length: R,
        wall: R,
        lanes: R::Mask,
    ) -> R {
        let ([gap, slope, _], [end_gap, end_slope, _]) = (here.jet(), there.jet());
        let rise = end_gap - gap;
        let part = (wall - gap) / rise;
        let rest = -part + 1.0;
        let (v0, v1) = (slope * length, end_slope * length);
        let mut u = part * part * (-(part * 2.0) + 3.0)
            + rise * part * rest * (rest * v1 - part * v0) / (v0 * v1);
        let quintic = Quintic::through(here, there, length);
        let zero = u.like(0.0);
        let (leaves, comes_back) = ((v0 * wall).at_most(zero), (v1 * wall).at_most(zero));
        u = R::choose(comes_back, zero, u);
        u = R::choose(leaves, u.like(1.0), u);
        let mut open = lanes;
        for _ in 0..STEPS {
            let next = quintic.towards(wall, u);
            let far = u.like(NEXT).less((next - u).abs());
            u = R::choose(open, next, u);
            open = open & far;
            if !open.any() {
                break;
            }
        }
        u * length
    }

    /// Corrects the time at which the gap reaches `wall` by one evaluation and the reverted series of
    /// third order.
    #[inline(always)]
    pub(super) fn corrected<S: Simd>(
        &self,
        simd: S,
        here: &FlightState<R>,
        time: R,
        path: impl Path<R>,
        wall: R,
        slack: &Slack<R>,
    ) -> Corrected<R> {
        let at = self.after(simd, here, time, path);
        let [a, j, s] = self.derivatives(&at, path);
        // w + w' e + w'' e^2/2 + w''' e^3/6 = 0; a constant acceleration has no part in w'''.
        let (e, sharp) = reverted(self.fastest, [wall - at.gap, at.slope, at.a, j]);
        let slope = (at.slope + e * at.a) * wall;
        let first_root = e.like(0.0).less(slope) & slack.slope_squared.less(slope * slope);
        self.moved(at, [a, j, s], time, e, first_root & sharp)
    }

    /// Corrects the time at which the slope falls to 0 in the way of `sense`, as [`Self::corrected`] does that of an
    /// impact; `bend_squared` is what the square of the gap's acceleration must exceed.
    #[inline(always)]
    pub(super) fn levelled<S: Simd>(
        &self,
        simd: S,
        here: &FlightState<R>,
        time: R,
        path: impl Path<R>,
        sense: R,
        bend_squared: R,
    ) -> Corrected<R> {
        let at = self.after(simd, here, time, path);
        let [a, j, s] = self.derivatives(&at, path);
        let (e, sharp) = reverted(self.fastest, [-at.slope, at.a, j, s]);
        let bend = -((at.a + e * j) * sense);
        let first_root = e.like(0.0).less(bend) & bend_squared.less(bend * bend);
        self.moved(at, [a, j, s], time, e, first_root & sharp)
    }

    /// The oscillator's second, third and fourth derivative.
    #[inline(always)]
    fn derivatives(&self, at: &FlightState<R>, path: impl Path<R>) -> [R; 3] {
        let (_, v) = self.oscillator(at);
        let a = path.unbend(at.a);
        let free_v = v - at.steady.v;
        let (twice, squared) = (self.twice_decay, self.squared);
        let free_a = a + squared * at.steady.x;
        let j = -(twice * free_a) - self.stiffness * free_v - squared * at.steady.v;
        let s = -(twice * (j + squared * at.steady.v)) - self.stiffness * free_a
            + squared * squared * at.steady.x;
        [a, j, s]
    }

    /// The motion a time `e` after `at`, where its derivatives are known.
    #[inline(always)]
    fn moved(
        &self,
        at: FlightState<R>,
        [a, j, s]: [R; 3],
        time: R,
        e: R,
        exact: R::Mask,
    ) -> Corrected<R> {
        let (x, v) = self.oscillator(&at);
        let squared = self.squared;
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
            x: x + e * (v + e * (a * 0.5 + e * (j * (1.0 / 6.0) + e * s * (1.0 / 24.0)))),
            v: v + e * (a + e * (j * 0.5 + e * s * (1.0 / 6.0))),
            exact,
        }
    }
}

/// Where `f' e + f'' e^2/2 + f''' e^3/6` is `f`, by the reverted series, and whether that is near and leaves
/// nothing above rounding.
#[inline(always)]
pub(super) fn reverted<R: Real>(fastest: R, [f, first, second, third]: [R; 4]) -> (R, R::Mask) {
    let inverse_slope = f.like(1.0) / first;
    let newton = f * inverse_slope;
    let (p, q) = (second * 0.5 * inverse_slope, third * (1.0 / 6.0) * inverse_slope);
    let e = newton * (-(newton * (p - newton * (p * p * 2.0 - q))) + 1.0);
    // The series' next term is five times the cube of its first; the expansion about the
    // evaluated point ends with the fourth order.
    let first = (newton * p).abs() + (newton * newton * q).abs();
    let left = newton.abs() * first * first * first;
    let near = (e.abs() * fastest).at_most(e.like(NEAR));
    (e, near & (left * fastest).at_most(left.like(LEFT)))
}
