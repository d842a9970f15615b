//! The flights of one trajectory, panel by panel: see [`super::phasor`] for the
//! formulas and [`super::certificate`] for the proof.

use fearless_simd::{Simd, dispatch};

use super::contact::rebound;
use super::events::{Detail, Observer, Side};
use super::landing::{Ending, Flight, Landing};
use super::path::{Path, StraightLine};
use super::phasor::Rates;
use super::run::{Moment, Simulation, Stop};
use super::sliding::{CavityFlight, Straight};
use super::walls::{self, Sticking};
use crate::system::State;

/// How far flights may go on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    /// Whole periods and impacts since the start of the run, at either of which they end.
    pub turns: u64,
    pub impacts: u64,
}

impl Limits {
    /// So many periods or impacts after where a trajectory stands.
    pub(super) fn of(simulation: &Simulation, periods: u64, impacts: u64) -> Self {
        Self {
            turns: simulation.periods() + periods,
            impacts: simulation.impacts().saturating_add(impacts),
        }
    }

    /// Why a trajectory is at its end, if it is.
    pub(super) fn stop(&self, simulation: &Simulation) -> Option<Stop> {
        if self.turns <= simulation.periods() {
            Some(Stop::EndTime)
        } else if self.impacts <= simulation.impacts() {
            Some(Stop::ImpactLimit)
        } else {
            None
        }
    }

    fn reached(&self, at: &Moment) -> bool {
        self.turns <= at.turns || self.impacts <= at.impacts
    }
}

/// Why flights ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum FlightEnd {
    /// A limit was reached.
    Limit,
    /// Nothing is proven about the next flight: the slow search must fly it.
    Doubt,
    /// The next flight is a short return to its wall.
    Return,
    /// The last impact, on this wall, may be the end of a chattering sequence.
    MayStick(Side),
    /// The absorber has ceased to slide, and friction may hold it.
    Turned,
}

impl Simulation {
    /// Flies from event to event: by panels, or as long as flights are short returns.
    pub(super) fn fly(
        &mut self,
        short_returns: bool,
        limits: Limits,
        observer: &mut dyn Observer,
    ) -> FlightEnd {
        let Some(rates) = self.rates else { return FlightEnd::Doubt };
        let (level, sliding) = (self.level, self.sliding);
        let (moment, end) = if short_returns {
            // A straight line is a parabola too, with the same bits.
            dispatch!(level, simd => self.fly_by::<_, _, true>(simd, sliding, &rates, limits, observer))
        } else if sliding.straight {
            dispatch!(level, simd => self.fly_by::<_, _, false>(simd, Straight, &rates, limits, observer))
        } else {
            dispatch!(level, simd => self.fly_by::<_, _, false>(simd, sliding, &rates, limits, observer))
        };
        self.at = moment;
        end
    }

    /// By the instructions that `simd` stands for.
    #[inline(always)]
    fn fly_by<S: Simd, C: CavityFlight, const RETURNS: bool>(
        &self,
        simd: S,
        course: C,
        rates: &Rates<f64>,
        limits: Limits,
        observer: &mut dyn Observer,
    ) -> (Moment, FlightEnd) {
        let eps = self.system.mass_ratio();
        let sticking = [Side::Plus, Side::Minus].map(|side| Sticking::of(self, side));
        let detail = observer.detail();
        let mut at = self.at;
        // What has just been thrown back leaves its wall.
        let mut leaves = false;
        loop {
            let Moment { state: State { x, x_velocity: v, y, y_velocity }, steady, sense, .. } = at;
            let line = StraightLine { y, velocity: y_velocity };
            let released = !leaves && v == y_velocity && walls::touches(x, v, line);
            if !leaves && !released && walls::blocked(x, v, line) {
                return (at, FlightEnd::Doubt);
            }
            let (x, path) = course.depart(&at);
            let (mut here, slack) = rates.begin(x, v, steady, path);
            if released {
                // Of a gap that is rounded up nothing could be proven.
                here.gap = here.gap.signum();
            }
            let flight = Flight { course, sense, path, left: rates.left(at.phase) };
            if course.short(rates, &here) != RETURNS {
                return (at, if RETURNS { FlightEnd::Limit } else { FlightEnd::Return });
            }
            let landing = if RETURNS {
                rates.short_return(simd, &here, path, flight.left, &mut at.evaluations)
            } else {
                rates.fly(simd, here, slack, &flight, &mut at.evaluations)
            };
            let Some(landing) = landing else {
                return (at, FlightEnd::Doubt);
            };
            let Landing { end, time, x, v, steady } = landing;
            let StraightLine { y, velocity: y_velocity } = path.from(time).line();
            let (x, y) = (course.arrive(sense, x), course.arrive(sense, y));
            if !(x.abs() <= f64::MAX && y.abs() <= f64::MAX) {
                return (at, FlightEnd::Doubt);
            }
            let before = State { x, x_velocity: v, y, y_velocity };
            if detail > Detail::Nothing {
                self.tell(at, landing, before, observer, detail);
            }
            at.steady = steady;
            if let Ending::Wall(side) = end {
                at.phase += rates.frequency * time;
                at.impacts += 1;
                let after = rebound(eps, self.restitution(side), v, y_velocity);
                at.state = self.rebounded(&before, side, &after);
                at.sense = -side.sign();
                let State { x, x_velocity: v, y, y_velocity } = at.state;
                let line = StraightLine { y, velocity: y_velocity };
                let sticking = &sticking[side.index()];
                if sticking.possible(x, v, line, side.sign()) {
                    return (at, FlightEnd::MayStick(side));
                }
            } else if let Ending::Turn = end {
                (at.state, at.phase) = (before, at.phase + rates.frequency * time);
                let acceleration = rates.acceleration(landing.x, v, steady);
                if !self.slides_on(&mut at, acceleration, observer) {
                    return (at, FlightEnd::Turned);
                }
            } else {
                (at.state, at.phase, at.turns) = (before, 0.0, at.turns + 1);
            }
            leaves = matches!(end, Ending::Wall(_));
            if limits.reached(&at) {
                return (at, FlightEnd::Limit);
            }
        }
    }

    /// Tells an observer of the flight from `at` and of what it ended with; apart from the flights themselves,
    /// which it would slow down: it gets copies, so that these stay in registers.
    #[inline(never)]
    fn tell(
        &self,
        at: Moment,
        landing: Landing,
        before: State,
        observer: &mut dyn Observer,
        detail: Detail,
    ) {
        let Landing { end, time, .. } = landing;
        if time > 0.0 && detail == Detail::Flights {
            observer.segment(&self.flown(&at, time));
        }
        let side = match end {
            Ending::Wall(side) => side,
            Ending::Turn => return,
            Ending::Period => return observer.period(&before),
        };
        let (eps, r) = (self.system.mass_ratio(), self.restitution(side));
        let after = rebound(eps, r, before.x_velocity, before.y_velocity);
        let when = (at.turns, at.phase + self.alone.frequency * time);
        observer.impact(&self.impact(&before, side, &after, when));
    }
}
