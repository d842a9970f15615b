//! When a wall lets go of an absorber that it takes along: where the acceleration of both falls to what gravity gives.
//!
//! The second derivative of a linear oscillator's motion is again a free motion and a steady one. Seen from a point that rests
//! a little more than its largest value away it is a gap, and its fall to a value an impact: the search of flights finds it, with
//! the same proof.

use fearless_simd::dispatch;

use super::events::Side;
use super::landing::{Ending, Flight};
use super::path::StraightLine;
use super::phasor::{Rates, Steady};
use super::run::Simulation;
use super::sliding::Straight;
use crate::numerics::crossing::{Crossing, Edge, Search};

/// Largest part of the way between such walls that the acceleration, less that of gravity, moves.
const LARGEST: f64 = 0.25;

impl Simulation {
    /// When the wall on `side` lets go, within a time; none where nothing is proven.
    pub(super) fn contact_ends(&self, side: Side, left: f64) -> Option<Search> {
        let rates = self.towing.filter(|_| self.rates.is_some())?;
        let (state, steady) = (&self.stand.at.state, rates.steady(self.stand.at.phase));
        let (x, v) = (state.x - self.sliding.rest_in_tow() - steady.x, state.x_velocity - steady.v);
        let acceleration = -(rates.twice_decay * v) - rates.stiffness * x;
        let jerk = -(rates.twice_decay * acceleration) - rates.stiffness * v;
        let gravity = self.sliding.gravity;
        let largest = rates.amplitude(acceleration, jerk) + rates.second_steady + gravity.abs();
        let scale = LARGEST / largest;
        let steady_scale = rates.squared * scale;
        let rates = Rates {
            sixth_steady: rates.sixth_steady * steady_scale,
            second_steady: rates.second_steady * steady_scale,
            ..rates
        };
        let steady = Steady { x: -(steady.x * steady_scale), v: -(steady.v * steady_scale) };
        // It meets the other side's wall.
        let y = gravity * scale + side.sign();
        let path = StraightLine { y, velocity: 0.0 };
        let (mut x, mut v) = (acceleration * scale + steady.x, jerk * scale + steady.v);
        let (mut steady, mut time, mut evaluations) = (steady, 0.0, 0);
        loop {
            let (here, slack) = rates.begin(x, v, steady, path);
            let until = left - time;
            let flight = Flight { course: Straight, sense: 0.0, path, fine: true, until };
            let landing = dispatch!(self.level, simd => {
                rates.fly(simd, here, slack, &flight, &mut evaluations)
            })?;
            time += landing.time;
            let evaluations = u32::try_from(evaluations).unwrap_or(u32::MAX);
            if left <= time {
                return Some(Search::Clear { evaluations });
            }
            if let Ending::Wall(_) = landing.end {
                return Some(Search::Crossed(Crossing { time, edge: Edge::Lower, evaluations }));
            }
            (x, v, steady) = (landing.x, landing.v, landing.steady);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::simulation::events::{AbsorberMotion, Observer, Segment};
    use crate::system::{Cavity, Excitation, Parameters, State, System};

    /// How long the absorber is carried at first, and whether by a wall.
    #[derive(Default)]
    struct First(Option<(f64, bool)>);

    impl Observer for First {
        fn segment(&mut self, segment: &Segment) {
            let carried = matches!(segment.absorber, AbsorberMotion::Carried(_));
            self.0 = self.0.or(Some((segment.duration, carried)));
        }
    }

    /// Against the search that goes step by step, in level and in steep cavities, of which some let go never.
    #[test]
    fn walls_let_go_when_a_slow_search_says_so() {
        let (mut proven, mut released, mut kept) = (0, 0, 0);
        for k in 0..600 {
            let gravity = [0.0, 0.03, -0.4, 5.0, -5.0][k % 5];
            let cavity = Cavity { gravity_along: gravity, ..Cavity::IDEAL };
            let system = System::new(Parameters {
                mass_ratio: [0.01, 0.3][k / 5 % 2],
                damping: 1.0,
                restitution: 0.5,
                frequency_ratio: [0.6, 0.97, 1.3][k / 10 % 3],
                forcing_per_clearance: 3.0,
                excitation: Excitation::Force,
                cavity,
            });
            let phase = TAU * k as f64 / 600.0;
            let (x, v) = (2.0 * libm::sin(2.9 * k as f64), libm::cos(1.7 * k as f64));
            let sign = if k / 30 % 2 == 0 { 1.0 } else { -1.0 };
            let start = State { x, x_velocity: v, y: x - sign, y_velocity: v };
            let fast = Simulation::new(&system.expect("valid"), start, phase).expect("at a wall");
            let slow = fast.clone().step_by_step();
            let mut seen = [fast.clone(), slow].map(|mut one| {
                let mut first = First::default();
                one.run(1, 1, &mut first);
                first.0.expect("a segment")
            });
            let left = (TAU - phase) / fast.system.frequency_ratio();
            if !seen[0].1 {
                continue;
            }
            seen.sort_by(|a, b| a.0.total_cmp(&b.0));
            let [(early, _), (late, carried)] = seen;
            // Where the force falls to nothing slowly rounding decides when.
            assert!(carried && late - early < 1e-11, "{k}: {early} {late}");
            if late == left {
                kept += 1
            } else {
                released += 1
            }
            let side = if sign > 0.0 { Side::Plus } else { Side::Minus };
            proven += usize::from(fast.contact_ends(side, left).is_some());
        }
        assert!(released > 50 && kept > 50, "{released} {kept}");
        // Most of the others let go at once.
        assert!(proven * 10 > (released + kept) * 9, "{proven} of {released} and {kept}");
    }
}
