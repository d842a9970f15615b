//! What one trajectory does step by step, by the search of [`crate::numerics::crossing`]: flights about which
//! nothing is proven in panels, oscillators that do not ring, and sustained contact.

use std::f64::consts::TAU;

use super::contact::rebound;
use super::events::{Absorber, Observer, Segment, Side};
use super::flow::{Kinematics, Motion};
use super::phasor::Line;
use super::run::{Mode, Simulation, Stop};
use super::walls::{self, TOUCH_ULPS};
use crate::numerics::crossing::{Band, Curve, Edge, Sample, Search, first_crossing};
use crate::system::State;

/// Distance over the clearance by which rounding may move the walls before the search gives up.
const LARGEST_TOUCH: f64 = 0.1;
/// Fast time over which one curvature bound is used; shorter bounds are tighter, longer ones save
/// evaluations. A sixth of the natural period is a fair middle.
const HORIZON: f64 = 1.0;

impl Simulation {
    /// Flies to the next impact or the end of the period.
    pub(super) fn fly_step_by_step(&mut self, observer: &mut dyn Observer) -> Result<(), Stop> {
        self.resolves_walls()?;
        let State { x, x_velocity, y, y_velocity } = self.at.state;
        let motion = self.alone.motion(x, x_velocity, self.at.phase);
        let touch = self.touch();
        let remaining = self.remaining();
        let from = self.tangential_start(&motion, touch).min(remaining);
        let curve = Gap { motion, line: Line { y, velocity: y_velocity } };
        let found =
            first_crossing(&curve, from, remaining, Band { lower: -1.0, upper: 1.0, touch });
        match self.follow(motion, Absorber::Flying { y, y_velocity }, found, observer)? {
            Some(Edge::Upper) => self.collide(Side::Plus, observer),
            Some(Edge::Lower) => self.collide(Side::Minus, observer),
            None => {}
        }
        Ok(())
    }

    /// Carries the absorber to its release or the end of the period.
    pub(super) fn carry(&mut self, side: Side, observer: &mut dyn Observer) -> Result<(), Stop> {
        self.resolves_walls()?;
        let State { x, x_velocity, .. } = self.at.state;
        let motion = self.carrying.motion(x, x_velocity, self.at.phase);
        let scale = self.alone.largest_force + x.abs() + x_velocity.abs();
        let band =
            Band { lower: 0.0, upper: f64::INFINITY, touch: TOUCH_ULPS * f64::EPSILON * scale };
        let found = first_crossing(&ContactForce { motion, side }, 0.0, self.remaining(), band);
        if self.follow(motion, Absorber::Carried(side), found, observer)?.is_some() {
            self.mode = Mode::Flight;
        }
        Ok(())
    }

    /// Moves on to the edge that a search has found, which is returned, or to the end of the period.
    fn follow(
        &mut self,
        motion: Motion,
        absorber: Absorber,
        found: Search,
        observer: &mut dyn Observer,
    ) -> Result<Option<Edge>, Stop> {
        let (evaluations, duration, edge) = match found {
            Search::Clear { evaluations } => (evaluations, self.remaining(), None),
            Search::Crossed(crossing) => (crossing.evaluations, crossing.time, Some(crossing.edge)),
            Search::NotFinite(_) => return Err(Stop::NotFinite),
        };
        let at = &mut self.at;
        let segment = Segment { motion, absorber, turns: at.turns, phase: at.phase, duration };
        at.evaluations += u64::from(evaluations);
        at.state = segment.at(duration);
        at.phase += self.system.frequency_ratio() * duration;
        if !(at.state.x.is_finite() && at.state.y.is_finite()) {
            return Err(Stop::NotFinite);
        }
        if duration > 0.0 {
            observer.segment(&segment);
        }
        if edge.is_none() {
            (at.turns, at.phase) = (at.turns + 1, 0.0);
            observer.period(&at.state);
        }
        if let Some(rates) = &self.rates {
            at.steady = rates.steady(at.phase);
        }
        Ok(edge)
    }

    /// An impact where the absorber stands, and the end of a chattering sequence if it is one.
    fn collide(&mut self, side: Side, observer: &mut dyn Observer) {
        let before = self.at.state;
        let (eps, r) = (self.system.mass_ratio(), self.system.restitution());
        let after = rebound(eps, r, before.x_velocity, before.y_velocity);
        self.at.impacts += 1;
        let when = (self.at.turns, self.at.phase);
        observer.impact(&self.impact(&before, side, &after, when));
        self.at.state = self.rebounded(&before, side, &after);
        self.perhaps_stick(side, observer);
    }

    fn remaining(&self) -> f64 {
        (TAU - self.at.phase) / self.system.frequency_ratio()
    }

    /// Distance over the clearance that rounding can move the walls by.
    pub(super) fn touch(&self) -> f64 {
        let State { x, x_velocity, y, y_velocity } = self.at.state;
        walls::touch(x, x_velocity, Line { y, velocity: y_velocity })
    }

    /// A search among walls that rounding moves about would not end.
    fn resolves_walls(&self) -> Result<(), Stop> {
        // The steady part may dwarf the motion that it is a part of.
        let (sine, cosine) = self.alone.steady.unwrap_or_default();
        let steady = TOUCH_ULPS * f64::EPSILON * libm::hypot(sine, cosine);
        // What is not a number resolves nothing.
        if self.touch() + steady <= LARGEST_TOUCH { Ok(()) } else { Err(Stop::WallsUnresolved) }
    }

    /// After a release, or an impact with `r = 0`, the absorber leaves the wall tangentially, and
    /// the parabola that bounds the next step has no room. Third and fourth derivatives have: with
    /// closing acceleration `a <= 0` the gap stays open for `3 |a| / jerk bound`, and with `a = 0`
    /// and closing jerk `j < 0` for `4 |j| / snap bound`.
    fn tangential_start(&self, motion: &Motion, touch: f64) -> f64 {
        let State { x, x_velocity, y_velocity, .. } = self.at.state;
        let gap = self.at.state.relative_displacement();
        let at = Kinematics { x, v: x_velocity };
        if x_velocity != y_velocity || 1.0 - gap.abs() > touch {
            return 0.0;
        }
        let side = gap.signum();
        let bounds = motion.bounds(0.0, at, HORIZON);
        let acceleration = side * motion.acceleration(0.0, at);
        let jerk = side * motion.jerk(0.0, at);
        let by_acceleration =
            if acceleration < 0.0 { -3.0 * acceleration / bounds.jerk } else { 0.0 };
        let noise = touch * (1.0 + motion.oscillator().decay);
        let by_jerk =
            if acceleration <= noise && jerk < 0.0 { -4.0 * jerk / bounds.snap } else { 0.0 };
        // Neither may outrun the way to the opposite wall.
        by_acceleration.max(by_jerk).min((2.0 / bounds.acceleration).sqrt()).min(HORIZON)
    }
}

/// Relative displacement `w = x - y` during a flight.
struct Gap {
    motion: Motion,
    line: Line<f64>,
}

impl Curve for Gap {
    fn sample(&self, s: f64) -> Sample {
        let at = self.motion.at(s);
        Sample {
            value: at.x - (self.line.y + self.line.velocity * s),
            slope: at.v - self.line.velocity,
            curvature_bound: self.motion.bounds(s, at, HORIZON).acceleration,
        }
    }
    fn horizon(&self) -> f64 {
        HORIZON
    }
}

/// Acceleration of the wall towards the absorber during sustained contact; the contact force is
/// `eps` times it, and the absorber is released when it vanishes.
struct ContactForce {
    motion: Motion,
    side: Side,
}

impl Curve for ContactForce {
    fn sample(&self, s: f64) -> Sample {
        let at = self.motion.at(s);
        Sample {
            value: self.side.sign() * self.motion.acceleration(s, at),
            slope: self.side.sign() * self.motion.jerk(s, at),
            curvature_bound: self.motion.bounds(s, at, HORIZON).snap,
        }
    }
    fn horizon(&self) -> f64 {
        HORIZON
    }
}
