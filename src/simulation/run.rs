//! One trajectory: from event to event, period by period.
//!
//! Time is kept as a count of whole excitation periods and a phase within the period, so that a
//! phase is as accurate after a million periods as in the first one.

use std::f64::consts::TAU;

use fearless_simd::Level;
use serde::Serialize;

use super::contact::{AtWall, ContactTolerance, Rebound, rebound};
use super::events::{Absorber, Impact, Observer, Segment, Side, StartError};
use super::flow::{Kinematics, Motion, Oscillator};
use super::panels::{FlightEnd, Limits};
use super::phasor::{Line, Rates, Steady};
use super::walls::{self, TOUCH_ULPS, inverse_loss};
use crate::numerics::crossing::{Band, Curve, Edge, Sample, Search, first_crossing};
use crate::system::{State, System};

/// Distance over the clearance by which rounding may move the walls before the search gives up.
const LARGEST_TOUCH: f64 = 0.1;
/// Fast time over which one curvature bound is used; shorter bounds are tighter, longer ones save
/// evaluations. A sixth of the natural period is a fair middle.
const HORIZON: f64 = 1.0;

/// Operations of one panel of the fast search: two complex products, the motion at its end, and the
/// six coefficients that bound it.
pub(super) const PANEL: u64 = 45;
/// Operations of what a flight costs beside its panels: its beginning, the guess and the series that
/// locate an impact, and the impact itself.
const FLIGHT: u64 = 240;

/// Why a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stop {
    /// All periods asked for were simulated.
    EndTime,
    /// The limit on the number of impacts was reached first.
    ImpactLimit,
    /// A number overflowed.
    NotFinite,
    /// Rounding moves the walls by more than a tenth of the clearance.
    WallsUnresolved,
}

impl Stop {
    /// The reason in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::EndTime => "its end time",
            Self::ImpactLimit => "its limit on the number of impacts",
            Self::NotFinite => "a number that overflowed",
            Self::WallsUnresolved => "a motion so large that rounding hides the walls",
        }
    }
}

/// Where a trajectory stands between two flights.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moment {
    pub state: State,
    pub steady: Steady<f64>,
    pub phase: f64,
    pub turns: u64,
    pub impacts: u64,
    pub evaluations: u64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Mode {
    Flight,
    Contact(Side),
}

/// A trajectory that can be continued.
#[derive(Debug, Clone)]
pub struct Simulation {
    system: System,
    alone: Oscillator,
    carrying: Oscillator,
    rates: Option<Rates<f64>>,
    /// The best instructions that the processor has.
    level: Level,
    /// The oscillator's steady motion at the present phase, where flights are through panels.
    steady: Option<Steady<f64>>,
    tolerance: ContactTolerance,
    state: State,
    mode: Mode,
    turns: u64,
    phase: f64,
    impacts: u64,
    evaluations: u64,
}

impl Simulation {
    /// A trajectory from `start` at excitation phase `phase` (radians, reduced to one period).
    ///
    /// A start on a wall is accepted: moving outwards it collides at once, moving inwards it flies.
    ///
    /// # Errors
    /// [`StartError`] when the absorber would be outside its cavity or a number is not finite.
    pub fn new(system: &System, start: State, phase: f64) -> Result<Self, StartError> {
        let numbers = [start.x, start.x_velocity, start.y, start.y_velocity, phase];
        if numbers.iter().any(|number| !number.is_finite()) {
            return Err(StartError::NotFinite { state: start });
        }
        if start.relative_displacement().abs()
            > 1.0 + TOUCH_ULPS * f64::EPSILON * (1.0 + start.x.abs())
        {
            return Err(StartError::OutsideCavity { gap: start.relative_displacement() });
        }
        let mut simulation = Self {
            system: *system,
            alone: Oscillator::alone(system),
            carrying: Oscillator::carrying_absorber(system),
            rates: Rates::of(&Oscillator::alone(system)),
            level: Level::new(),
            steady: None,
            tolerance: ContactTolerance::default(),
            state: start,
            mode: Mode::Flight,
            turns: 0,
            phase: phase.rem_euclid(TAU),
            impacts: 0,
            evaluations: 0,
        };
        // A start on a wall, without relative velocity, is sustained contact if the wall pushes.
        let touching = 1.0 - start.relative_displacement().abs() <= simulation.touch();
        if touching && start.x_velocity == start.y_velocity {
            let side = if start.relative_displacement() > 0.0 { Side::Plus } else { Side::Minus };
            simulation.perhaps_stick(side, &mut ());
        }
        Ok(simulation)
    }

    /// Finds every event by the slow, finer search alone: what the fast one is measured against.
    pub fn step_by_step(mut self) -> Self {
        self.rates = None;
        self
    }

    /// Flies by other instructions than the best.
    #[cfg(test)]
    pub(super) fn at_level(mut self, level: Level) -> Self {
        self.level = level;
        self
    }

    /// Replaces the tolerance that ends chattering sequences.
    pub fn with_tolerance(mut self, tolerance: ContactTolerance) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// Where the trajectory stands.
    pub fn state(&self) -> State {
        self.state
    }

    /// Whole excitation periods since the start of the trajectory.
    pub fn periods(&self) -> u64 {
        self.turns
    }

    /// Impacts since the start of the trajectory.
    pub fn impacts(&self) -> u64 {
        self.impacts
    }

    /// Evaluations of the closed form, one state at one time each, that flights have cost so far.
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// What flights and impacts have cost so far, in operations as [`crate::operation_count`] counts them;
    /// what observers do is not in it.
    pub fn operations(&self) -> u64 {
        PANEL * self.evaluations + FLIGHT * (self.impacts + self.turns)
    }

    /// The system that moves.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// Continues to the end of the `periods`-th excitation period from here, or until
    /// `impact_limit` further impacts have happened.
    pub fn run(&mut self, periods: u64, impact_limit: u64, observer: &mut impl Observer) -> Stop {
        let limits = Limits::of(self, periods, impact_limit);
        loop {
            if let Some(stop) = limits.stop(self) {
                return stop;
            }
            if let Err(stop) = self.step(limits, observer) {
                return stop;
            }
        }
    }

    /// Continues by one impact, release or end of a period, or several within the limits.
    pub(super) fn step<O: Observer>(
        &mut self,
        limits: Limits,
        observer: &mut O,
    ) -> Result<(), Stop> {
        if let Mode::Contact(side) = self.mode {
            return self.carry(side, observer);
        }
        let Some(departure) = self.departure() else { return self.fly_step_by_step(observer) };
        let (moment, pause) = self.fly_in_panels(self.level, departure, limits, observer);
        self.resume(&moment);
        match pause {
            FlightEnd::Limit => {}
            FlightEnd::MayStick(side) => self.perhaps_stick(side, observer),
            FlightEnd::Doubt => self.fly_step_by_step(observer)?,
        }
        Ok(())
    }

    /// What turns its phasors, if it flies by any.
    pub(super) fn rates(&self) -> Option<&Rates<f64>> {
        self.rates.as_ref()
    }

    /// What ends chattering sequences.
    pub(super) fn tolerance(&self) -> ContactTolerance {
        self.tolerance
    }

    /// Largest force on the oscillator without absorber.
    pub(super) fn largest_force(&self) -> f64 {
        self.alone.largest_force()
    }

    /// Where it stands, if its next flight can be through panels.
    pub(super) fn departure(&self) -> Option<Moment> {
        let rates = self.rates.as_ref()?;
        (self.mode == Mode::Flight).then(|| Moment {
            state: self.state,
            steady: self.steady.unwrap_or_else(|| rates.steady(self.phase)),
            phase: self.phase,
            turns: self.turns,
            impacts: self.impacts,
            evaluations: self.evaluations,
        })
    }

    /// Puts it where a flight elsewhere has brought it.
    pub(super) fn resume(&mut self, at: &Moment) {
        let Moment { state, steady, phase, turns, impacts, evaluations } = *at;
        (self.state, self.steady) = (state, Some(steady));
        (self.phase, self.mode) = (phase, Mode::Flight);
        (self.turns, self.impacts, self.evaluations) = (turns, impacts, evaluations);
    }

    /// The flight from `begin` that lasted `duration`.
    pub(super) fn flown(&self, begin: &Moment, duration: f64) -> Segment {
        let State { x, x_velocity, y, y_velocity } = begin.state;
        Segment {
            motion: self.alone.motion(x, x_velocity, begin.phase),
            absorber: Absorber::Flying { y, y_velocity },
            turns: begin.turns,
            phase: begin.phase,
            duration,
        }
    }

    fn remaining(&self) -> f64 {
        (TAU - self.phase) / self.system.frequency_ratio()
    }

    /// Fast time since the start of the run at phase `phase` after `turns` whole periods.
    pub(super) fn tau(&self, turns: u64, phase: f64) -> f64 {
        (turns as f64 * TAU + phase) / self.system.frequency_ratio()
    }

    fn fly_step_by_step(&mut self, observer: &mut impl Observer) -> Result<(), Stop> {
        self.resolves_walls()?;
        let start = self.state;
        let motion = self.alone.motion(start.x, start.x_velocity, self.phase);
        let curve = Gap { motion, y: start.y, y_velocity: start.y_velocity };
        let touch = self.touch();
        let band = Band { lower: -1.0, upper: 1.0, touch };
        let remaining = self.remaining();
        let from = self.tangential_start(&motion, touch).min(remaining);
        let absorber = Absorber::Flying { y: start.y, y_velocity: start.y_velocity };
        match first_crossing(&curve, from, remaining, band) {
            Search::Clear { evaluations } => {
                self.evaluations += u64::from(evaluations);
                self.advance(motion, absorber, remaining, observer)?;
                self.complete_period(observer);
            }
            Search::Crossed(crossing) => {
                self.evaluations += u64::from(crossing.evaluations);
                self.advance(motion, absorber, crossing.time, observer)?;
                let side = match crossing.edge {
                    Edge::Upper => Side::Plus,
                    Edge::Lower => Side::Minus,
                };
                self.collide(side, observer);
            }
            Search::NotFinite(_) => return Err(Stop::NotFinite),
        }
        Ok(())
    }

    fn carry(&mut self, side: Side, observer: &mut impl Observer) -> Result<(), Stop> {
        self.resolves_walls()?;
        let motion = self.carrying.motion(self.state.x, self.state.x_velocity, self.phase);
        let curve = ContactForce { motion, side };
        let scale = self.alone.largest_force() + self.state.x.abs() + self.state.x_velocity.abs();
        let band =
            Band { lower: 0.0, upper: f64::INFINITY, touch: TOUCH_ULPS * f64::EPSILON * scale };
        let remaining = self.remaining();
        match first_crossing(&curve, 0.0, remaining, band) {
            Search::Clear { evaluations } => {
                self.evaluations += u64::from(evaluations);
                self.advance(motion, Absorber::Carried(side), remaining, observer)?;
                self.complete_period(observer);
            }
            Search::Crossed(crossing) => {
                self.evaluations += u64::from(crossing.evaluations);
                self.advance(motion, Absorber::Carried(side), crossing.time, observer)?;
                self.mode = Mode::Flight;
            }
            Search::NotFinite(_) => return Err(Stop::NotFinite),
        }
        Ok(())
    }

    /// Distance over the clearance that rounding can move the walls by.
    fn touch(&self) -> f64 {
        let State { x, x_velocity, y, y_velocity } = self.state;
        walls::touch(x, x_velocity, Line { y, velocity: y_velocity })
    }

    /// A search among walls that rounding moves about would not end.
    fn resolves_walls(&self) -> Result<(), Stop> {
        // The steady part may dwarf the motion that it is a part of.
        let (sine, cosine) = self.alone.steady().unwrap_or_default();
        let steady = TOUCH_ULPS * f64::EPSILON * libm::hypot(sine, cosine);
        // What is not a number resolves nothing.
        if self.touch() + steady <= LARGEST_TOUCH { Ok(()) } else { Err(Stop::WallsUnresolved) }
    }

    /// After a release, or an impact with `r = 0`, the absorber leaves the wall tangentially, and
    /// the parabola that bounds the next step has no room. Third and fourth derivatives have: with
    /// closing acceleration `a <= 0` the gap stays open for `3 |a| / jerk bound`, and with `a = 0`
    /// and closing jerk `j < 0` for `4 |j| / snap bound`.
    fn tangential_start(&self, motion: &Motion, touch: f64) -> f64 {
        let gap = self.state.relative_displacement();
        let at = Kinematics { x: self.state.x, v: self.state.x_velocity };
        if self.state.x_velocity != self.state.y_velocity || 1.0 - gap.abs() > touch {
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

    fn advance(
        &mut self,
        motion: Motion,
        absorber: Absorber,
        duration: f64,
        observer: &mut impl Observer,
    ) -> Result<(), Stop> {
        let segment = Segment { motion, absorber, turns: self.turns, phase: self.phase, duration };
        self.state = segment.at(duration);
        self.steady = None;
        self.phase += self.system.frequency_ratio() * duration;
        if !(self.state.x.is_finite() && self.state.y.is_finite()) {
            return Err(Stop::NotFinite);
        }
        if duration > 0.0 {
            observer.segment(&segment);
        }
        Ok(())
    }

    fn complete_period(&mut self, observer: &mut impl Observer) {
        self.turns += 1;
        self.phase = 0.0;
        observer.period(&self.state);
    }

    fn collide(&mut self, side: Side, observer: &mut impl Observer) {
        let before = self.state;
        let after = rebound(
            self.system.mass_ratio(),
            self.system.restitution(),
            before.x_velocity,
            before.y_velocity,
        );
        self.impacts += 1;
        observer.impact(&self.impact(&before, side, &after, self.turns, self.phase));
        self.state = self.rebounded(&before, side, &after);
        self.perhaps_stick(side, observer);
    }

    /// An impact as observers are told of it.
    #[inline(always)]
    pub(super) fn impact(
        &self,
        before: &State,
        side: Side,
        after: &Rebound,
        turns: u64,
        phase: f64,
    ) -> Impact {
        Impact {
            tau: self.tau(turns, phase),
            phase,
            side,
            x: before.x,
            x_velocity_before: before.x_velocity,
            x_velocity_after: after.x_velocity,
            y_velocity_before: before.y_velocity,
            y_velocity_after: after.y_velocity,
            loss: after.loss,
            penetration: (before.relative_displacement().abs() - 1.0).max(0.0),
        }
    }

    /// The state after an impact: on the wall.
    #[inline(always)]
    pub(super) fn rebounded(&self, before: &State, side: Side, after: &Rebound) -> State {
        // With `r = 0` the relative velocity is zero, not what rounding leaves of it.
        let follows = self.system.restitution() == 0.0;
        State {
            x: before.x,
            x_velocity: after.x_velocity,
            y: before.x - side.sign(),
            y_velocity: if follows { after.x_velocity } else { after.y_velocity },
        }
    }

    pub(super) fn perhaps_stick(&mut self, side: Side, observer: &mut impl Observer) {
        let State { x, x_velocity, y_velocity, .. } = self.state;
        let opening = -side.sign() * (x_velocity - y_velocity);
        // Rounding adds up to a touch to each excursion, an impact takes the share 1 - r^2 of it:
        // where the two balance a sequence would never end.
        let r = self.system.restitution();
        let floor = self.touch() * inverse_loss(r);
        let excursion = self.tolerance.excursion.max(floor);
        let tolerance = ContactTolerance { excursion, ..self.tolerance };
        let alone = &self.alone;
        let largest = alone.largest_force()
            + 2.0 * alone.decay * x_velocity.abs()
            + alone.stiffness * x.abs();
        if opening * opening > 2.0 * excursion * largest {
            // Whatever the acceleration is, the gap opens further than that.
            return;
        }
        let at = Kinematics { x, v: x_velocity };
        let wall = AtWall {
            separation_speed: opening.max(0.0),
            closing_acceleration: side.sign() * alone.acceleration(self.phase, at),
            speed: x_velocity.abs(),
            force_rate: alone.frequency * alone.largest_force(),
            damping: 2.0 * alone.decay,
            stiffness: alone.stiffness,
        };
        // A gap that opens by less than rounding is none, elastic or not.
        let unresolved = wall.closing_acceleration > 0.0
            && opening * opening <= 2.0 * wall.closing_acceleration * self.touch();
        if unresolved || tolerance.sticks(r, &wall) {
            let eps = self.system.mass_ratio();
            let common = (x_velocity + eps * y_velocity) / (1.0 + eps);
            self.state.x_velocity = common;
            self.state.y_velocity = common;
            self.mode = Mode::Contact(side);
            observer.sticks(0.5 * eps * opening * opening / (1.0 + eps));
        }
    }
}

/// Relative displacement `w = x - y` during a flight.
struct Gap {
    motion: Motion,
    y: f64,
    y_velocity: f64,
}

impl Curve for Gap {
    fn sample(&self, s: f64) -> Sample {
        let at = self.motion.at(s);
        let bounds = self.motion.bounds(s, at, HORIZON);
        Sample {
            value: at.x - (self.y + self.y_velocity * s),
            slope: at.v - self.y_velocity,
            curvature_bound: bounds.acceleration,
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
