//! The proof that a panel of a flight has no impact, or exactly one.
//!
//! At both ends of a panel the relative displacement `w`, its slope and
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
//! Where the absorber rubs a panel also has to keep the sign of `w'`, [`Hull::rises`], or to change it once,
//! [`Hull::turns`]. `w'` differs from the quintic's derivative by less than `S/(1920 h)`, so that a root of `w'` at which
//! `w''^2 > 4 M' S/(960 h)`, `abs(w^(3)) <= M'`, is then the first, by the same argument.
//!
//! Where friction turns a flight early, a panel is first cut to what its parabola says: a part `q` has `q^6 S`.
//! Any other panel is halved, which divides `S` by 64; below a thousandth of a panel the search of
//! [`crate::numerics::crossing`] takes over.

use super::phasor::{FlightState, Slack};
use crate::numerics::lanes::Real;

/// Steps of Newton towards a level place: from the secant, off by some percent of a panel, two leave less
/// than what the quintic is off.
const LEVELLING: u32 = 2;

/// A curve at one moment, as far as a quintic asks.
pub(super) trait Jet<R> {
    /// Value, slope and second derivative.
    fn jet(&self) -> [R; 3];
}

impl<R: Real> Jet<R> for FlightState<R> {
    #[inline(always)]
    fn jet(&self) -> [R; 3] {
        [self.gap, self.slope, self.a]
    }
}

/// A polynomial in the part of a panel, lowest power first.
pub(super) struct Quintic<R>([R; 6]);

impl<R: Real> Quintic<R> {
    /// The one with the gap's values, slopes and curvatures at both ends.
    #[inline(always)]
    pub(super) fn through(here: &impl Jet<R>, there: &impl Jet<R>, length: R) -> Self {
        let ([gap, slope, a], [end_gap, end_slope, end_a]) = (here.jet(), there.jet());
        let half = length * length * 0.5;
        let (v0, c2) = (slope * length, a * half);
        let bend = end_a * half - c2;
        let d = end_gap - gap - v0 - c2;
        let e = end_slope * length - v0 - c2 * 2.0;
        let c3 = d * 10.0 - e * 4.0 + bend;
        let c4 = e * 7.0 - d * 15.0 - bend * 2.0;
        let c5 = d * 6.0 - e * 3.0 + bend;
        Self([gap, v0, c2, c3, c4, c5])
    }

    /// One step of Halley's iteration from `u` towards `value`.
    #[inline(always)]
    pub(super) fn towards(&self, value: R, u: R) -> R {
        let [c0, c1, c2, c3, c4, c5] = self.0;
        let off = c0 + u * (c1 + u * (c2 + u * (c3 + u * (c4 + u * c5)))) - value;
        let slope = self.slope(u);
        let bend = c2 + u * (c3 * 3.0 + u * (c4 * 6.0 + u * c5 * 10.0));
        u - off * slope / (slope * slope - off * bend)
    }
}

/// Where a panel's quintic is level.
#[derive(Debug, Clone, Copy)]
pub(super) struct TurningPoint<R> {
    /// Part of the panel.
    pub at: R,
    /// Its absolute value, and its slope, which rounding or a double root may have left.
    height: R,
    slope: R,
}

impl<R: Real> TurningPoint<R> {
    /// What the motion does not exceed there.
    #[inline(always)]
    pub(super) fn highest(&self, slack: &Slack<R>) -> R {
        // S/46080, a sixteenth of S/720 to the third power, and what the slope may reach in a panel.
        self.height + self.slope.abs() + slack.coefficient * (7200.0 / 46080.0)
    }
}

impl<R: Real> Quintic<R> {
    #[inline(always)]
    fn slope(&self, u: R) -> R {
        let [_, c1, c2, c3, c4, c5] = self.0;
        c1 + u * (c2 * 2.0 + u * (c3 * 3.0 + u * (c4 * 4.0 + u * c5 * 5.0)))
    }

    /// Where it is level, by Newton's iteration from `u`.
    #[inline(always)]
    pub(super) fn level(&self, mut u: R) -> R {
        let [_, _, c2, c3, c4, c5] = self.0;
        for _ in 0..LEVELLING {
            let bend = c2 * 2.0 + u * (c3 * 6.0 + u * (c4 * 12.0 + u * c5 * 20.0));
            u = (u - self.slope(u) / bend).larger(u.like(0.0)).smaller(u.like(1.0));
        }
        u
    }

    /// Where it is level, if its slopes at both ends differ in sign: from where their secant is.
    #[inline(always)]
    pub(super) fn turning_point(&self) -> TurningPoint<R> {
        let [c0, c1, c2, c3, c4, c5] = self.0;
        let u = self.level(c1 / (c1 - self.slope(c0.like(1.0))));
        let height = c0 + u * (c1 + u * (c2 + u * (c3 + u * (c4 + u * c5))));
        TurningPoint { at: u, height: height.abs(), slope: self.slope(u) }
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
    pub(super) fn of(here: &impl Jet<R>, there: &impl Jet<R>, length: R, slack: &Slack<R>) -> Self {
        let ([gap, slope, a], [end_gap, end_slope, end_a]) = (here.jet(), there.jet());
        let part = length * 0.2;
        let curve = length * length * 0.05;
        let (v0, v1) = (slope * part, end_slope * part);
        Self {
            inner: [
                gap + v0,
                gap + v0 * 2.0 + a * curve,
                end_gap - v1 * 2.0 + end_a * curve,
                end_gap - v1,
            ],
            last: end_gap,
            slack: slack.coefficient,
        }
    }

    /// What the curve's absolute value does not exceed after its beginning.
    #[inline(always)]
    pub(super) fn highest(&self) -> R {
        let [b1, b2, b3, b4] = self.inner;
        let outer = b1.abs().larger(b2.abs()).larger(b4.abs());
        outer.larger(b3.abs() + self.slack).larger(self.last.abs())
    }

    /// Where the gap is proven to stay between the walls. It may begin on one.
    #[inline(always)]
    pub(super) fn clear(&self) -> R::Mask {
        let [b1, b2, b3, b4] = self.inner;
        let one = b1.like(1.0);
        b1.abs().at_most(one)
            & b2.abs().at_most(one)
            & (b3.abs() + self.slack).at_most(one)
            & b4.abs().at_most(one)
            & self.last.abs().at_most(one)
    }

    /// Where `w'`, with these values at the ends, is proven to keep the sign `sense` in between: the derivative's
    /// coefficients in Bernstein's form are differences, and `w'` differs from it by at most `S u^2 (1-u)^2/120` over
    /// the length of the panel, which its middle one takes up.
    #[inline(always)]
    pub(super) fn rises(&self, sense: R, begin: R, end: R) -> R::Mask {
        let [b1, b2, b3, b4] = self.inner;
        let zero = b1.like(0.0);
        let keeps = [(b2 - b1) * sense, (b4 - b3) * sense, begin * sense, end * sense];
        (self.slack * 2.0).at_most((b3 - b2) * sense)
            & zero.at_most(keeps[0])
            & zero.at_most(keeps[1])
            & zero.at_most(keeps[2])
            & zero.less(keeps[3])
    }

    /// Where `w'` is proven to change its sign from `sense` once, but for a time in which it is next to 0: Descartes' rule
    /// for the derivative, as low and as high as it may be.
    #[inline(always)]
    pub(super) fn turns(&self, sense: R, begin: R, end: R) -> R::Mask {
        let [b1, b2, b3, b4] = self.inner;
        let zero = b1.like(0.0);
        let (d1, d2, d3) = ((b2 - b1) * sense, (b3 - b2) * sense, (b4 - b3) * sense);
        let off = self.slack * 2.0;
        zero.at_most(begin * sense)
            & (end * sense).less(zero)
            & (zero.at_most(d1) | (d2 + off).at_most(zero))
            & (zero.at_most(d2 - off) | d3.at_most(zero))
    }

    /// Where it leaves the band through the wall nearest to its end, `wall`, and not before through
    /// the other: once, if the slope at the root is steep enough.
    #[inline(always)]
    pub(super) fn meets(&self, wall: R) -> R::Mask {
        let one = wall.like(1.0);
        let [b1, b2, b3, b4] = self.inner;
        let (b1, b2, b3, b4) = (b1 * wall, b2 * wall, b3 * wall, b4 * wall);
        let inside = (-one).at_most(b1)
            & (-one).at_most(b2)
            & (-one).at_most(b3 - self.slack)
            & (-one).at_most(b4);
        let b3 = b3 + self.slack;
        let beyond = [one.less(b1), one.less(b2), one.less(b3), one.less(b4)];
        one.less(self.last * wall)
            & inside
            & (!beyond[0] | beyond[1])
            & (!beyond[1] | beyond[2])
            & (!beyond[2] | beyond[3])
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use fearless_simd::{Level, dispatch};

    use super::*;
    use crate::simulation::flow::Oscillator;
    use crate::simulation::path::{Path, StraightLine};
    use crate::simulation::phasor::{FlightState, Rates};
    use crate::system::{Cavity, Excitation, Parameters, System};

    fn oscillator(mass_ratio: f64, damping: f64, frequency_ratio: f64) -> Oscillator {
        let parameters = Parameters {
            mass_ratio,
            damping,
            restitution: 0.5,
            frequency_ratio,
            forcing_per_clearance: 0.7 / mass_ratio,
            excitation: Excitation::Force,
            cavity: Cavity::IDEAL,
        };
        Oscillator::alone(&System::new(parameters).expect("valid"))
    }

    /// A panel's quintic, in Bernstein's form.
    fn quintic(here: &FlightState<f64>, hull: &Hull<f64>, u: f64) -> f64 {
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
        // In panels, and in parts of them.
        let mut nearest = [0.0_f64; 2];
        for (eps, lambda, omega) in [
            (0.01, 1.0, 1.0),
            (0.3, 0.0, 0.4),
            (0.5, 3.0, 4.0),
            (0.01, 90.0, 0.97),
            (0.1, 1.0, 1.3),
        ] {
            let rates = Rates::of(&oscillator(eps, lambda, omega)).expect("it rings");
            for k in 0..80 {
                let phase = TAU * k as f64 / 80.0;
                let line = StraightLine { y: 0.2, velocity: 0.3 };
                let (x, v) = (libm::sin(3.0 * phase), 1.5 * libm::cos(5.0 * phase));
                let (here, slack) = rates.begin(x, v, rates.steady(phase), line);
                let moment = |s: f64| {
                    dispatch!(Level::baseline(), simd => {
                        rates.after(simd, &here, s, line)
                    })
                };
                let (length, there, slack) = match k % 2 {
                    0 => (rates.step, rates.next(&here, line.from(rates.step)), slack),
                    _ => (0.6 * rates.step, moment(0.6 * rates.step), slack.part(0.6)),
                };
                let hull = Hull::of(&here, &there, length, &slack);
                for j in 1..20 {
                    let u = f64::from(j) / 20.0;
                    let at = moment(u * length);
                    let off = (at.gap - quintic(&here, &hull, u)).abs();
                    let cubed = libm::pow(u * (1.0 - u), 3.0);
                    // Ten times the coefficient is S/720; the gap is rounded at the size of `x`.
                    let bound = 10.0 * slack.coefficient * cubed;
                    assert!(
                        off <= bound + 1e-14,
                        "{eps} {lambda} {omega} {k} {u}: {off:e} {bound:e}"
                    );
                    nearest[k % 2] = nearest[k % 2].max(off / bound);
                }
            }
        }
        assert!(nearest[0].min(nearest[1]) > 0.5, "{nearest:?}: the bound is never nearly reached");
    }

    /// A level gap of 0.995 has `b3 = 0.995`: nothing is proven where the motion may be 0.01 off its quintic.
    #[test]
    fn a_panel_is_no_clearer_than_its_quintic_is_known() {
        struct Level;
        impl Jet<f64> for Level {
            fn jet(&self) -> [f64; 3] {
                [0.995, 0.0, 0.0]
            }
        }
        let clear = |coefficient: f64| {
            Hull::of(&Level, &Level, 1.0, &Slack { coefficient, slope_squared: 0.0 }).clear()
        };
        assert!(clear(0.004) && !clear(0.01));
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

    /// Where the velocity changes sign, the motion reaches no higher than its quintic allows, and hardly
    /// less.
    #[test]
    fn a_turning_point_is_no_higher_than_its_quintic_allows() {
        let mut turns = 0;
        for (eps, lambda, omega) in [(0.01, 1.0, 1.0), (0.3, 0.0, 0.4), (0.5, 3.0, 4.0)] {
            let rates = Rates::of(&oscillator(eps, lambda, omega)).expect("it rings");
            for k in 0..800 {
                let phase = TAU * f64::from(k) / 800.0;
                let base = StraightLine { y: 0.0, velocity: 0.0 };
                let (x, v) = (libm::sin(3.0 * phase), 1.5 * libm::cos(5.0 * phase));
                let (here, slack) = rates.begin(x, v, rates.steady(phase), base);
                let there = rates.next(&here, base);
                if here.slope * there.slope >= 0.0 {
                    continue;
                }
                turns += 1;
                let turn = Quintic::through(&here, &there, rates.step).turning_point();
                let length = rates.step;
                let height = dispatch!(Level::baseline(), simd => {
                    rates.turning_point(simd, &here, base, turn.at * length, length, true)
                })
                .abs();
                let above = turn.highest(&slack) - height;
                // Rounded at the size of `x`; what two steps of Newton leave only costs an evaluation.
                assert!((-1e-15..=0.01).contains(&above), "{above} {eps} {omega} {phase}");
            }
        }
        assert!(turns > 200, "{turns}");
    }
}
