//! One trajectory: from event to event, period by period.
//!
//! Time is kept as a count of whole excitation periods and a phase within the period, so that a
//! phase is as accurate after a million periods as in the first one.

use std::f64::consts::TAU;

use fearless_simd::Level;
use serde::Serialize;

use super::contact::{AtWall, ContactTolerance, Rebound};
use super::events::{AbsorberMotion, Impact, Observer, Segment, Side, StartError};
use super::flow::Oscillator;
use super::history::ImpactLog;
use super::panels::{FlightEnd, Limits};
use super::path::StraightLine;
use super::phasor::{Rates, Steady};
use super::sliding::Sliding;
use super::walls::{Sticking, TOUCH_ULPS};
use crate::system::{State, System};

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
    /// The oscillator's steady motion at this phase, where flights are through panels.
    pub steady: Steady<f64>,
    pub phase: f64,
    /// Sign of `x' - y'` in the flight from here, where the absorber rubs.
    pub sense: f64,
    pub turns: u64,
    pub impacts: u64,
    pub evaluations: u64,
    /// Whether the flight from here is to be in short panels.
    pub fine: bool,
}

/// Where a trajectory stands.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stand {
    pub at: Moment,
    /// The piece of flight that is under way at the end of a period.
    pub under_way: Option<UnderWay>,
}

/// A piece of flight from which a trajectory goes on, so that it does not matter where a run was interrupted.
#[derive(Debug, Clone, Copy)]
pub(super) struct UnderWay {
    pub begun: Moment,
    /// Time from where the trajectory stands, up to which observers were told, to where it began; negative if that is before.
    pub since: f64,
}

impl Stand {
    /// Where no flight is under way.
    pub(super) fn new(at: Moment) -> Self {
        Self { at, under_way: None }
    }

    /// The piece of flight that is to be flown.
    pub(super) fn flight(&self) -> UnderWay {
        self.under_way.unwrap_or(UnderWay { begun: self.at, since: 0.0 })
    }
}

/// What the absorber does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Mode {
    Flight,
    Contact(Side),
    /// Friction holds it where `x - y` is `gap`.
    Held {
        gap: f64,
    },
}

/// A trajectory that can be continued.
///
/// Without excitation and damping an absorber that flies at the velocity 0.1 needs a time of 10 to the wall, where it
/// hands over momentum:
///
/// ```
/// use vinesink_core::simulation::{Simulation, Stop};
/// use vinesink_core::system::{Cavity, Excitation, Parameters, State, System};
///
/// let (mass_ratio, restitution) = (0.01, 0.6);
/// let system = System::new(Parameters {
///     mass_ratio,
///     restitution,
///     damping: 0.0,
///     frequency_ratio: 0.5, // one period is 4 pi = 12.6
///     forcing_per_clearance: 0.0,
///     excitation: Excitation::Force,
///     cavity: Cavity::IDEAL,
/// })?;
/// let start = State { y_velocity: 0.1, ..State::AT_REST };
/// let mut simulation = Simulation::new(&system, start, 0.0)?;
/// assert_eq!(simulation.run(1, u64::MAX, &mut ()), Stop::EndTime);
/// assert_eq!(simulation.impacts(), 1);
/// let speed = 0.1 * (mass_ratio - restitution) / (1.0 + mass_ratio);
/// assert!((simulation.state().y_velocity - speed).abs() < 1e-15);
/// // A start outside of the cavity is refused.
/// assert!(Simulation::new(&system, State { y: 1.5, ..start }, 0.0).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Simulation {
    pub(super) system: System,
    pub(super) alone: Oscillator,
    pub(super) carrying: Oscillator,
    pub(super) sliding: Sliding,
    restitutions: [f64; 2],
    /// What turns its phasors, if it flies by any.
    pub(super) rates: Option<Rates<f64>>,
    /// The same with the absorber in tow, once it was.
    pub(super) towing: Option<Rates<f64>>,
    /// The best instructions that the processor has.
    pub(super) level: Level,
    pub(super) tolerance: ContactTolerance,
    pub(super) mode: Mode,
    pub(super) stand: Stand,
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
        let alone = Oscillator::alone(system);
        let (rates, phase) = (Rates::of(&alone), phase.rem_euclid(TAU));
        let steady = rates.map_or(Steady { x: 0.0, v: 0.0 }, |rates| rates.steady(phase));
        let mut simulation = Self {
            system: *system,
            alone,
            carrying: Oscillator::carrying_absorber(system),
            sliding: Sliding::of(system),
            restitutions: system.restitutions(),
            rates,
            towing: None,
            level: Level::new(),
            tolerance: ContactTolerance::default(),
            mode: Mode::Flight,
            stand: Stand::new(Moment {
                state: start,
                steady,
                phase,
                sense: 0.0,
                turns: 0,
                impacts: 0,
                evaluations: 0,
                fine: false,
            }),
        };
        // A start on a wall, without relative velocity, is sustained contact if the wall pushes.
        let touching = 1.0 - start.relative_displacement().abs() <= simulation.touch();
        if touching && start.x_velocity == start.y_velocity {
            let side = if start.relative_displacement() > 0.0 { Side::Plus } else { Side::Minus };
            simulation.perhaps_stick(side, &mut ());
        }
        if simulation.mode == Mode::Flight {
            simulation.settle();
        }
        Ok(simulation)
    }

    /// Finds every event by the slow, finer search alone: what the fast one is measured against.
    pub fn step_by_step(mut self) -> Self {
        self.rates = None;
        self.stand.under_way = None;
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
        self.stand.at.state
    }

    /// Phase of the excitation, 0 to 2 pi: 0 after a run to the end of a period.
    pub fn phase(&self) -> f64 {
        self.stand.at.phase
    }

    /// Whole excitation periods since the start of the trajectory.
    pub fn periods(&self) -> u64 {
        self.stand.at.turns
    }

    /// Impacts since the start of the trajectory.
    pub fn impacts(&self) -> u64 {
        self.stand.at.impacts
    }

    /// Evaluations of the closed form, one state at one time each, that flights have cost so far.
    pub fn evaluations(&self) -> u64 {
        self.stand.at.evaluations
    }

    /// What flights and impacts have cost so far, in operations as [`crate::operation_count`] counts them;
    /// what observers do is not in it.
    pub fn operations(&self) -> u64 {
        PANEL * self.stand.at.evaluations + FLIGHT * (self.stand.at.impacts + self.stand.at.turns)
    }

    /// The system that moves.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// Continues to the end of the `periods`-th excitation period from here, or until
    /// `impact_limit` further impacts have happened (`u64::MAX` for no limit); says which. `&mut ()` observes
    /// nothing. What was measured of a run that did not reach its [`Stop::EndTime`] is that of a part.
    pub fn run(&mut self, periods: u64, impact_limit: u64, observer: &mut dyn Observer) -> Stop {
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

    /// Continues to the next impact, which is returned, or by so many excitation periods if there is none.
    pub fn next_impact(&mut self, periods: u64) -> Option<Impact> {
        let mut seen = ImpactLog::default();
        self.run(periods, 1, &mut seen);
        seen.impacts.first().copied()
    }

    /// Continues by one impact, release or end of a period, or several within the limits.
    pub(super) fn step(&mut self, limits: Limits, observer: &mut dyn Observer) -> Result<(), Stop> {
        if self.mode != Mode::Flight {
            return self.tow(observer);
        }
        if self.rates.is_none() {
            return self.fly_step_by_step(observer);
        }
        match self.fly(limits, observer) {
            FlightEnd::Limit => {}
            FlightEnd::MayStick(side) => self.perhaps_stick(side, observer),
            FlightEnd::Turned => self.reverse(observer),
            FlightEnd::Doubt => self.fly_step_by_step(observer)?,
        }
        Ok(())
    }

    /// Whether its flights can be beside others: through panels, and not turned by friction.
    pub(super) fn flies_beside_others(&self) -> bool {
        self.sliding.friction == 0.0 && self.rates.is_some()
    }

    /// Where it stands, if its next flight can be beside others.
    pub(super) fn departure(&self) -> Option<Stand> {
        (self.flies_beside_others() && self.mode == Mode::Flight).then_some(self.stand)
    }

    /// Puts it where a flight elsewhere has brought it.
    pub(super) fn resume(&mut self, stand: Stand) {
        (self.stand, self.mode) = (stand, Mode::Flight);
    }

    /// The flight from `begin` that lasted `duration`.
    pub(super) fn flown(&self, begin: &Moment, duration: f64) -> Segment {
        let State { x, x_velocity, y, y_velocity } = begin.state;
        let y_acceleration = self.sliding.acceleration(begin.sense);
        let rest = self.sliding.rest(begin.sense);
        Segment {
            motion: self.alone.motion_about(rest, x, x_velocity, begin.phase),
            absorber: AbsorberMotion::Flying { y, y_velocity, y_acceleration },
            turns: begin.turns,
            phase: begin.phase,
            duration,
        }
    }

    /// Fast time since the start.
    #[inline(always)]
    pub(super) fn tau(&self, turns: u64, phase: f64) -> f64 {
        (turns as f64 * TAU + phase) / self.system.frequency_ratio()
    }

    /// The restitution of a wall.
    #[inline(always)]
    pub(super) fn restitution(&self, side: Side) -> f64 {
        self.restitutions[side.index()]
    }

    /// An impact as observers are told of it.
    #[inline(always)]
    pub(super) fn impact(
        &self,
        before: &State,
        side: Side,
        after: &Rebound,
        (turns, phase): (u64, f64),
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
        let follows = self.restitution(side) == 0.0;
        State {
            x: before.x,
            x_velocity: after.x_velocity,
            y: before.x - side.sign(),
            y_velocity: if follows { after.x_velocity } else { after.y_velocity },
        }
    }

    pub(super) fn perhaps_stick(&mut self, side: Side, observer: &mut dyn Observer) {
        let State { x, x_velocity, y, y_velocity } = self.stand.at.state;
        let (r, line) = (self.restitution(side), StraightLine { y, velocity: y_velocity });
        let sticking = Sticking::of(self, side);
        if !sticking.possible(x, x_velocity, line, side.sign()) {
            return;
        }
        let excursion = sticking.tolerated(x, x_velocity, line);
        let tolerance = ContactTolerance { excursion, ..self.tolerance };
        let (alone, opening) = (&self.alone, -side.sign() * (x_velocity - y_velocity));
        let [slowing, closing_acceleration] = self.closing(side);
        let wall = AtWall {
            separation_speed: opening.max(0.0),
            closing_acceleration,
            speed: x_velocity.abs(),
            force_rate: alone.frequency * alone.largest_force,
            damping: 2.0 * alone.decay,
            stiffness: alone.stiffness,
        };
        // A gap that opens by less than rounding is none, elastic or not.
        let unresolved = slowing > 0.0 && opening * opening <= 2.0 * slowing * self.touch();
        if unresolved || tolerance.sticks(r, &wall) {
            let eps = self.system.mass_ratio();
            let common = (x_velocity + eps * y_velocity) / (1.0 + eps);
            self.stand.at.state.x_velocity = common;
            self.stand.at.state.y_velocity = common;
            self.mode = Mode::Contact(side);
            self.towing = self.towing.or_else(|| Rates::of(&self.carrying));
            observer.sticks(0.5 * eps * opening * opening / (1.0 + eps));
        }
    }
}
