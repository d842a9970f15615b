//! What one trajectory does step by step, by the search of [`crate::numerics::crossing`]: flights about which
//! nothing is proven in panels, oscillators that do not ring, and sustained contact.

use std::f64::consts::TAU;

use super::contact::rebound;
use super::events::{AbsorberMotion, Observer, Segment, Side};
use super::flow::{Kinematics, SmoothMotion};
use super::path::{Parabola, Path, StraightLine};
use super::run::{Mode, Simulation, Stop};
use super::sliding::Sliding;
use super::walls::{self, TOUCH_ULPS};
use crate::numerics::crossing::{
    CrossingBand, Curve, Edge, Sample, Search, first_crossing, first_of,
};
use crate::system::State;

/// Distance over the clearance by which rounding may move the walls before the search gives up.
const LARGEST_TOUCH: f64 = 0.1;
/// Fast time over which one curvature bound is used; shorter bounds are tighter, longer ones save
/// evaluations. A sixth of the natural period is a fair middle.
const HORIZON: f64 = 1.0;
/// Fast time for which friction holds at least: a slip that is left out in it is below `1e-27`, and where forces are
/// just what friction gives the absorber would else be held and released without end.
const SHORTEST_HOLD: f64 = 1e-9;

/// Which of two curves a search found to leave its band: the gap.
const WALL: usize = 0;

impl Simulation {
    /// Flies to the next impact, the next moment at which sliding ends, or the end of the period.
    pub(super) fn fly_step_by_step(&mut self, observer: &mut dyn Observer) -> Result<(), Stop> {
        self.resolves_walls()?;
        let Segment { motion, absorber, .. } = self.flown(&self.stand.at, 0.0);
        let (touch, remaining) = (self.touch(), self.remaining());
        let curve = GapCurve { motion, path: self.path() };
        let from = self.tangential_start(&motion, touch).min(remaining);
        let band = CrossingBand { lower: -1.0, upper: 1.0, touch };
        let (found, which) = if self.sliding.friction == 0.0 {
            (first_crossing(&curve, from, remaining, band), WALL)
        } else {
            self.first_event(&curve, from, remaining, band)
        };
        match self.follow(motion, absorber, found, observer)? {
            Some(_) if which != WALL => self.reverse(observer),
            Some(Edge::Upper) => self.collide(Side::Plus, observer),
            Some(Edge::Lower) => self.collide(Side::Minus, observer),
            None => {}
        }
        Ok(())
    }

    /// What comes first where the absorber rubs: a wall, or that it ceases to slide.
    fn first_event(
        &self,
        gap: &GapCurve,
        from: f64,
        remaining: f64,
        band: CrossingBand,
    ) -> (Search, usize) {
        let GapCurve { motion, path } = gap;
        let (sense, State { x, x_velocity, y_velocity, .. }) =
            (self.stand.at.sense, self.stand.at.state);
        let size = 1.0 + x.abs() + x_velocity.abs() + y_velocity.abs();
        let touch = TOUCH_ULPS * f64::EPSILON * size;
        let slips = if x_velocity == y_velocity { self.first_slip(motion, touch) } else { 0.0 };
        // The slope is positive the way that the absorber slides.
        let slope = CrossingBand { lower: 0.0, upper: f64::INFINITY, touch };
        let samples = |s: f64| {
            let at = motion.at(s);
            let StraightLine { y, velocity } = path.from(s).line;
            let bounds = motion.bounds(s, at, HORIZON);
            let speed = at.v - velocity;
            [
                Sample {
                    value: at.x - y,
                    slope: speed,
                    curvature_bound: path.bound(bounds.acceleration),
                },
                Sample {
                    value: sense * speed,
                    slope: sense * path.bend(motion.acceleration(s, at)),
                    curvature_bound: bounds.jerk,
                },
            ]
        };
        first_of(samples, HORIZON, [from, slips.min(remaining)], remaining, [band, slope])
    }

    /// The flight from here.
    fn path(&self) -> Parabola {
        let State { y, y_velocity, .. } = self.stand.at.state;
        let line = StraightLine { y, velocity: y_velocity };
        Parabola { line, acceleration: self.sliding.acceleration(self.stand.at.sense) }
    }

    /// How long a slip that begins now, without speed and maybe without acceleration, lasts at least: with a jerk `j`
    /// for `3 j / snap bound`.
    fn first_slip(&self, motion: &SmoothMotion, touch: f64) -> f64 {
        let at = motion.at(0.0);
        let sense = self.stand.at.sense;
        let slope = sense * (motion.acceleration(0.0, at) - self.sliding.acceleration(sense));
        let jerk = sense * motion.jerk(0.0, at);
        if slope <= touch && jerk > 0.0 {
            (3.0 * jerk / motion.bounds(0.0, at, HORIZON).snap).min(HORIZON)
        } else {
            0.0
        }
    }

    /// Takes the absorber along, at a wall or held by friction, to its release or the end of the period.
    pub(super) fn tow(&mut self, observer: &mut dyn Observer) -> Result<(), Stop> {
        self.resolves_walls()?;
        let Sliding { gravity, friction, .. } = self.sliding;
        let State { x, x_velocity, .. } = self.stand.at.state;
        let touch = self.force_rounding(&self.stand.at.state);
        // What is just held stays so.
        let held = if friction > 0.0 { friction + touch } else { 0.0 };
        let rest = self.sliding.rest_in_tow();
        let motion = self.carrying.motion_about(rest, x, x_velocity, self.stand.at.phase);
        let (absorber, sign, upper) = match self.mode {
            Mode::Contact(side) => (AbsorberMotion::Carried(side), side.sign(), f64::INFINITY),
            Mode::Held { gap } => (AbsorberMotion::Held { gap }, 1.0, held),
            Mode::Flight => return Ok(()),
        };
        let band = CrossingBand { lower: -held, upper, touch };
        let from = if friction > 0.0 { SHORTEST_HOLD.min(self.remaining()) } else { 0.0 };
        let proven = match self.mode {
            Mode::Contact(side) if friction == 0.0 => self.contact_ends(side, self.remaining()),
            _ => None,
        };
        let force = ContactForce { motion, sign, gravity };
        let search = || first_crossing(&force, from, self.remaining(), band);
        let found = proven.unwrap_or_else(search);
        if let Some(edge) = self.follow(motion, absorber, found, observer)? {
            self.mode = Mode::Flight;
            self.stand.at.sense = if edge == Edge::Upper { sign } else { -sign };
        }
        Ok(())
    }

    /// Moves on to the edge that a search has found, which is returned, or to the end of the period.
    fn follow(
        &mut self,
        motion: SmoothMotion,
        absorber: AbsorberMotion,
        found: Search,
        observer: &mut dyn Observer,
    ) -> Result<Option<Edge>, Stop> {
        let (evaluations, duration, edge) = match found {
            Search::Clear { evaluations } => (evaluations, self.remaining(), None),
            Search::Crossed(crossing) => (crossing.evaluations, crossing.time, Some(crossing.edge)),
            Search::NotFinite(_) => return Err(Stop::NotFinite),
        };
        let at = &mut self.stand.at;
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
        let before = self.stand.at.state;
        let (eps, r) = (self.system.mass_ratio(), self.restitution(side));
        let after = rebound(eps, r, before.x_velocity, before.y_velocity);
        self.stand.at.impacts += 1;
        let when = (self.stand.at.turns, self.stand.at.phase);
        observer.impact(&self.impact(&before, side, &after, when));
        self.stand.at.state = self.rebounded(&before, side, &after);
        self.perhaps_stick(side, observer);
        if self.mode == Mode::Flight {
            self.settle();
        }
    }

    fn remaining(&self) -> f64 {
        (TAU - self.stand.at.phase) / self.system.frequency_ratio()
    }

    /// Distance over the clearance that rounding can move the walls by.
    pub(super) fn touch(&self) -> f64 {
        let State { x, x_velocity, y, y_velocity } = self.stand.at.state;
        walls::touch(x, x_velocity, StraightLine { y, velocity: y_velocity })
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
    fn tangential_start(&self, motion: &SmoothMotion, touch: f64) -> f64 {
        let State { x, x_velocity, y_velocity, .. } = self.stand.at.state;
        let gap = self.stand.at.state.relative_displacement();
        let at = Kinematics { x, v: x_velocity };
        if x_velocity != y_velocity || 1.0 - gap.abs() > touch {
            return 0.0;
        }
        let side = gap.signum();
        let bounds = motion.bounds(0.0, at, HORIZON);
        let own = self.sliding.acceleration(self.stand.at.sense);
        let acceleration = side * (motion.acceleration(0.0, at) - own);
        let jerk = side * motion.jerk(0.0, at);
        let by_acceleration =
            if acceleration < 0.0 { -3.0 * acceleration / bounds.jerk } else { 0.0 };
        let noise = touch * (1.0 + motion.oscillator().decay);
        let by_jerk =
            if acceleration <= noise && jerk < 0.0 { -4.0 * jerk / bounds.snap } else { 0.0 };
        // Neither may outrun the way to the opposite wall.
        let largest = bounds.acceleration + own.abs();
        by_acceleration.max(by_jerk).min((2.0 / largest).sqrt()).min(HORIZON)
    }
}

/// Relative displacement `w = x - y` during a flight.
struct GapCurve {
    motion: SmoothMotion,
    path: Parabola,
}

impl Curve for GapCurve {
    fn sample(&self, s: f64) -> Sample {
        let at = self.motion.at(s);
        let StraightLine { y, velocity } = self.path.from(s).line;
        let largest = self.motion.bounds(s, at, HORIZON).acceleration;
        Sample {
            value: at.x - y,
            slope: at.v - velocity,
            curvature_bound: self.path.bound(largest),
        }
    }
    fn horizon(&self) -> f64 {
        HORIZON
    }
}

/// `x'' - a` of an absorber in tow, times a sign: its acceleration by the forces of wall and friction, of which friction
/// gives up to `f` either way, and a wall any away from it.
struct ContactForce {
    motion: SmoothMotion,
    sign: f64,
    gravity: f64,
}

impl Curve for ContactForce {
    fn sample(&self, s: f64) -> Sample {
        let at = self.motion.at(s);
        Sample {
            value: self.sign * (self.motion.acceleration(s, at) - self.gravity),
            slope: self.sign * self.motion.jerk(s, at),
            curvature_bound: self.motion.bounds(s, at, HORIZON).snap,
        }
    }
    fn horizon(&self) -> f64 {
        HORIZON
    }
}
