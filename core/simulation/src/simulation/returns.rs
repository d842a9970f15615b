//! Short returns: flights back to the wall that they begin on within a small part of a panel, as in a chattering sequence.
//!
//! At the distance `d` from a wall, from which it flies away at the speed `u` while the gap's acceleration towards it is `c`, the
//! absorber would be back after `p = (u + sqrt(u^2 + 2 c d))/c` if nothing changed. The acceleration changes at most at the rate
//! `J`. Where `J p <= c/2` it stays above `c/4` for `3 p/2`: the distance is concave until then, and negative there, so that the
//! absorber comes back exactly once, in between, and gets no further than `d + 3 u p/2`.
//!
//! When is a root of the distance over time, `d/t + d1 + d2 t/2 + d3 t^2/6 + ...`: after an impact, where `d` is nothing, the
//! trivial root is divided out, and nothing is subtracted, however short the flight is.

use fearless_simd::Simd;

use super::events::Side;
use super::landing::{Ending, Landing};
use super::path::Path;
use super::phasor::{FlightState, ON_WALL, Rates};
use crate::numerics::lanes::{Mask, Real};

/// A return is short if its parabola takes less than twice this part of a panel, inverted.
const SHORT_FLIGHT: f64 = 32.0;
/// Distance from a wall, over its rounding, that is none for an absorber that flies away from it.
const ROUNDED: f64 = 4.0 * f64::EPSILON;
/// Derivatives of the gap that its series has: that of the eleventh order is below `4e-17` of the first where flights are short.
const ORDERS: usize = 10;
/// Steps of Halley's iteration from where the first three derivatives have the root: after an impact that is off by `2e-3` of the
/// time at most, and two leave less than `1e-17` of it.
const STEPS: u32 = 4;
/// A step so small, over the time, that the next would be below rounding: it goes with the third power.
const CONVERGED: f64 = 1e-5;

impl<R: Real> Rates<R> {
    /// Where a flight is a short return, unless friction turns it.
    #[inline(always)]
    pub(super) fn short(&self, here: &FlightState<R>) -> R::Mask {
        let on = here.gap.like(ON_WALL).at_most(here.gap.abs());
        let closing = R::choose(here.gap.less(here.gap.like(0.0)), -here.a, here.a);
        on & (here.slope.abs() * SHORT_FLIGHT).less(closing * self.step)
    }

    /// When short returns end, and where that is proven.
    #[inline(always)]
    pub(super) fn return_time(&self, here: &FlightState<R>) -> (R, R::Mask) {
        let (zero, one) = (here.gap.like(0.0), here.gap.like(1.0));
        let wall = R::choose(here.gap.less(zero), -one, one);
        let (speed, closing) = (-(here.slope * wall), here.a * wall);
        let (x, _) = self.oscillator(here);
        let distance = one - here.gap * wall;
        let none = zero.less(speed) & distance.at_most((x.abs() + 1.0) * ROUNDED);
        let distance = R::choose(none, zero, distance);
        let parabola = (speed + (speed * speed + closing * distance * 2.0).sqrt()) / closing;
        let size = (here.z[0] * here.z[0] + here.z[1] * here.z[1]).sqrt();
        let jerk = (self.stiffness * size + self.second_steady) * self.fastest;
        let proven = (jerk * parabola * 2.0).at_most(closing)
            & (parabola * (0.5 * SHORT_FLIGHT)).at_most(self.step)
            & (speed.abs() * parabola).less(one)
            & zero.at_most(distance)
            & zero.less(parabola);
        // Over `k!`, of the order `k + 1`.
        let series = self.series(here, wall);
        let bend = series[2] * parabola / series[1];
        let mut time = parabola * 2.0 / ((bend * 4.0 + 1.0).sqrt() + 1.0);
        let mut open = proven;
        for _ in 0..STEPS {
            let (mut value, mut slope, mut curve) = (series[ORDERS - 1], zero, zero);
            for k in (0..ORDERS - 1).rev() {
                curve = curve * time + slope;
                slope = slope * time + value;
                value = value * time + series[k];
            }
            let inverse = one / time;
            let first = distance * inverse;
            let second = first * inverse;
            (value, slope, curve) = (value + first, slope - second, curve + second * inverse);
            let step = value * slope / (slope * slope - value * curve);
            time = R::choose(open, time - step, time);
            open = open & !step.abs().at_most(time * CONVERGED);
            if !open.any() {
                break;
            }
        }
        (time, proven & !open)
    }

    /// `d1, d2/2, d3/6, ...` of the distance from a wall.
    #[inline(always)]
    fn series(&self, here: &FlightState<R>, wall: R) -> [R; ORDERS] {
        let mut series = [-(here.slope * wall); ORDERS];
        series[1] = -(here.a * wall * 0.5);
        // Of the free motion, the newest two; and of the steady one.
        let (_, v) = self.oscillator(here);
        let mut free = [here.z[0], v - here.steady.v];
        let mut steady = [here.steady.x, here.steady.v];
        let mut factorial = 1.0;
        for k in 0..ORDERS - 1 {
            free = [free[1], -(self.twice_decay * free[1]) - self.stiffness * free[0]];
            steady = [steady[1], -(self.squared * steady[0])];
            factorial *= (k + 2) as f64;
            if k > 0 {
                series[k + 1] = -((free[1] + steady[1]) * wall * (1.0 / factorial));
            }
        }
        series
    }
}

impl Rates<f64> {
    /// Where a short return ends; none where nothing is proven.
    #[inline(never)]
    pub(super) fn short_return<S: Simd>(
        &self,
        simd: S,
        here: &FlightState<f64>,
        path: impl Path<f64>,
        evaluations: &mut u64,
    ) -> Option<Landing> {
        simd.vectorize(
            #[inline(always)]
            || {
                let (time, proven) = self.return_time(here);
                if !proven {
                    return None;
                }
                *evaluations += 1;
                let at = self.after(simd, here, time, path);
                let (x, v) = self.oscillator(&at);
                let end = Ending::Wall(Side::of(here.gap));
                Some(Landing { end, time, x, v, steady: at.steady })
            },
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::flow::Oscillator;
    use crate::simulation::path::StraightLine;
    use crate::system::{Cavity, Excitation, Parameters, System};

    /// The motion itself is nowhere beyond the wall before, and at the wall then: as far as it is known there, to rounding of
    /// displacements.
    #[test]
    fn a_flight_is_back_when_its_series_says_so_and_not_before() {
        let (mut proven, mut longest) = (0, 0.0_f64);
        for k in 0..4000_u32 {
            let part = f64::from(k) / 4000.0;
            let parameters = Parameters {
                mass_ratio: 0.3 * part + 1e-4,
                damping: 2.0 * part,
                restitution: 0.5,
                frequency_ratio: 0.3 + 2.0 * libm::fabs(libm::sin(7.0 * f64::from(k))),
                forcing_per_clearance: 3.0,
                excitation: Excitation::Force,
                cavity: Cavity::IDEAL,
            };
            let oscillator = Oscillator::alone(&System::new(parameters).expect("valid"));
            let rates = Rates::of(&oscillator).expect("it rings");
            let phase = libm::sin(f64::from(k)) + 1.0;
            let (mut x, v) = (3.0 * libm::sin(1.3 * f64::from(k)), libm::cos(2.1 * f64::from(k)));
            let mut motion = oscillator.motion(x, v, phase);
            if k % 2 == 1 {
                // Where the acceleration all but vanishes it changes on the way.
                x += motion.acceleration(0.0, motion.at(0.0)) - 0.3 * libm::exp(-f64::from(k % 14));
                motion = oscillator.motion(x, v, phase);
            }
            let closing = motion.acceleration(0.0, motion.at(0.0));
            let wall = closing.signum();
            let speed = libm::exp(-0.01 - 20.0 * part) * closing.abs() * rates.step / SHORT_FLIGHT;
            let line = StraightLine { y: x - wall, velocity: v + wall * speed };
            let here = rates.begin(x, v, rates.steady(phase), line).0;
            assert!(rates.short(&here), "{k}");
            let (time, known) = rates.return_time(&here);
            if !known {
                continue;
            }
            proven += 1;
            longest = longest.max(time * rates.fastest);
            let gap = |s: f64| motion.at(s).x - line.y - line.velocity * s;
            let rounding = 1e-15 * (2.0 + x.abs() + (v.abs() + speed) * time);
            assert!((gap(time) - wall).abs() < rounding, "{k}: {}", gap(time) - wall);
            for j in 1..20 {
                let inside = wall * gap(time * f64::from(j) / 20.0) - 1.0;
                // A parabola's height there, or half of it.
                let share = f64::from(j) / 20.0;
                let least = 0.25 * closing.abs() * time * time * share * (1.0 - share);
                assert!(inside < rounding - least, "{k} {j}: {inside:e} {least:e}");
            }
        }
        assert!(proven > 3000 && longest > 0.04, "{proven} {longest}");
    }
}
