//! The flights of one trajectory, panel by panel: see [`super::phasor`] for the
//! formulas and [`super::certificate`] for the proof.

use std::f64::consts::TAU;

use fearless_simd::{Simd, dispatch};

use super::contact::rebound;
use super::events::{Detail, Impact, Observer, Side};
use super::landing::{Ending, Flight, Landing};
use super::path::{Path, StraightLine};
use super::phasor::Rates;
use super::run::{Moment, Simulation, Stand, Stop, UnderWay};
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
}

/// Why flights ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum FlightEnd {
    /// A limit was reached.
    Limit,
    /// Nothing is proven about the next flight: the slow search must fly it.
    Doubt,
    /// The last impact, on this wall, may be the end of a chattering sequence.
    MayStick(Side),
    /// The absorber has ceased to slide, and friction may hold it.
    Turned,
}

impl Simulation {
    /// Flies from event to event.
    pub(super) fn fly(&mut self, limits: Limits, observer: &mut dyn Observer) -> FlightEnd {
        let Some(rates) = &self.rates else { return FlightEnd::Doubt };
        let (level, sliding) = (self.level, self.sliding);
        let end;
        // Less code in a browser: a straight line is a parabola with the same bits.
        (self.stand, end) = if sliding.straight && cfg!(not(target_arch = "wasm32")) {
            dispatch!(level, simd => self.fly_by(simd, Straight, rates, limits, observer))
        } else {
            dispatch!(level, simd => self.fly_by(simd, sliding, rates, limits, observer))
        };
        end
    }

    /// By the instructions that `simd` stands for.
    #[inline(always)]
    fn fly_by<S: Simd, C: CavityFlight>(
        &self,
        simd: S,
        course: C,
        coarsely: &Rates<f64>,
        limits: Limits,
        observer: &mut dyn Observer,
    ) -> (Stand, FlightEnd) {
        let eps = self.system.mass_ratio();
        let sticking = [Side::Plus, Side::Minus].map(|side| Sticking::of(self, side));
        let detail = observer.detail();
        let mut told = self.stand.at;
        let UnderWay { begun: mut at, mut since } = self.stand.flight();
        // What has just been thrown back leaves its wall.
        let mut leaves = false;
        loop {
            let Moment { state: State { x, x_velocity: v, y, y_velocity }, steady, sense, .. } = at;
            let line = StraightLine { y, velocity: y_velocity };
            let released = !leaves && v == y_velocity && walls::touches(x, v, line);
            if !leaves && !released && walls::blocked(x, v, line) {
                return (self.in_doubt(&told, at, since, observer), FlightEnd::Doubt);
            }
            let (x, path) = course.depart(&at);
            let finely;
            let rates = match at.fine {
                false => coarsely,
                true => {
                    finely = coarsely.finely();
                    &finely
                }
            };
            let (mut here, slack) = rates.begin(x, v, steady, path);
            if released {
                // Of a gap that is rounded up nothing could be proven.
                here.gap = here.gap.signum();
            }
            let mut evaluations = at.evaluations;
            let landing = if course.short(rates, &here) {
                let returns = course.returns();
                returns.then(|| rates.short_return(simd, &here, path, &mut evaluations)).flatten()
            } else {
                let fine = at.fine || !course.returns();
                // What is beyond the end of a run is flown when it goes on.
                let last = limits.turns <= at.turns + 1;
                let until = if last { rates.left(at.phase) } else { f64::INFINITY };
                let flight = Flight { course, sense, path, fine, until };
                rates.fly(simd, here, slack, &flight, &mut evaluations)
            };
            let Some(landing) = landing else {
                at.evaluations = evaluations;
                return (self.in_doubt(&told, at, since, observer), FlightEnd::Doubt);
            };
            let Landing { end, time, x, v, steady } = landing;
            let StraightLine { y, velocity: y_velocity } = path.from(time).line();
            let (x, y) = (course.arrive(sense, x), course.arrive(sense, y));
            if !(x.abs() <= f64::MAX && y.abs() <= f64::MAX) {
                return (self.in_doubt(&told, at, since, observer), FlightEnd::Doubt);
            }
            let begun = at;
            at.fine = matches!(end, Ending::Doubtful);
            if at.fine && time == 0.0 {
                at.evaluations = evaluations;
                continue;
            }
            at.phase += rates.frequency * time;
            at.steady = steady;
            at.evaluations = evaluations;
            let left = rates.left(begun.phase);
            if left < time {
                at.turns += 1;
                at.phase = (at.phase - TAU).max(0.0);
                if rates.renews(at.turns) {
                    at.steady = rates.steady(at.phase);
                }
                let limit = limits.turns <= at.turns;
                // A flight that stood there may go on from it.
                if told.turns < at.turns && (limit || detail > Detail::Nothing) {
                    let (x, v) = rates.period_end(simd, &here, left);
                    let StraightLine { y, velocity: y_velocity } = path.from(left).line();
                    let (x, y) = (course.arrive(sense, x), course.arrive(sense, y));
                    let state = State { x, x_velocity: v, y, y_velocity };
                    told = self.tell_period(&told, &begun, state, since + left, observer, detail);
                    since = -left;
                }
                if limit {
                    return (
                        Stand { at: told, under_way: Some(UnderWay { begun, since }) },
                        FlightEnd::Limit,
                    );
                }
            }
            since += time;
            let before = State { x, x_velocity: v, y, y_velocity };
            if let Ending::Midair | Ending::Doubtful = end {
                at.state = before;
                leaves = false;
                continue;
            }
            if let Ending::Wall(side) = end {
                at.impacts += 1;
                let after = rebound(eps, self.restitution(side), v, y_velocity);
                if detail > Detail::Nothing {
                    let impact = self.impact(&before, side, &after, (at.turns, at.phase));
                    self.tell_impact(&told, since, &impact, observer, detail);
                }
                at.state = self.rebounded(&before, side, &after);
                at.sense = -side.sign();
                (told, since) = (at, 0.0);
                let State { x, x_velocity: v, y, y_velocity } = at.state;
                let line = StraightLine { y, velocity: y_velocity };
                let sticking = &sticking[side.index()];
                if sticking.possible(x, v, line, side.sign()) {
                    return (Stand::new(at), FlightEnd::MayStick(side));
                }
                leaves = y_velocity != v;
            } else {
                at.state = before;
                self.tell_flight(&told, since, observer, detail);
                let acceleration = rates.acceleration(landing.x, v, steady);
                let slides = self.slides_on(&mut at, acceleration, observer);
                (told, since) = (at, 0.0);
                if !slides {
                    return (Stand::new(at), FlightEnd::Turned);
                }
                leaves = false;
            }
            if limits.impacts <= at.impacts {
                return (Stand::new(at), FlightEnd::Limit);
            }
        }
    }

    /// Where a trajectory stands whose next piece of flight is in doubt; observers are told of those before, which took
    /// the time `since`.
    #[inline(never)]
    fn in_doubt(
        &self,
        told: &Moment,
        at: Moment,
        since: f64,
        observer: &mut dyn Observer,
    ) -> Stand {
        // Of a flight from the end of a period there is nothing to tell.
        if at.turns < told.turns {
            return Stand::new(*told);
        }
        let detail = observer.detail();
        self.tell_flight(told, since, observer, detail);
        Stand::new(at)
    }

    /// Tells an observer of the end of the period in which a piece of flight began, `since` after where the flight was told
    /// last; apart from the flights themselves, which it would slow down.
    #[inline(never)]
    pub(super) fn tell_period(
        &self,
        told: &Moment,
        begun: &Moment,
        state: State,
        since: f64,
        observer: &mut dyn Observer,
        detail: Detail,
    ) -> Moment {
        let (turns, steady) =
            (begun.turns + 1, self.rates.map_or(begun.steady, |rates| rates.origin));
        self.tell_flight(told, since, observer, detail);
        if detail > Detail::Nothing {
            observer.period(&state);
        }
        Moment { state, steady, phase: 0.0, turns, fine: false, ..*begun }
    }

    /// Tells an observer of an impact, and of the flight from where it was told last.
    #[inline(never)]
    pub(super) fn tell_impact(
        &self,
        told: &Moment,
        since: f64,
        impact: &Impact,
        observer: &mut dyn Observer,
        detail: Detail,
    ) {
        self.tell_flight(told, since, observer, detail);
        observer.impact(impact);
    }

    /// Tells of the flight of a `duration` from where it was told last.
    fn tell_flight(
        &self,
        told: &Moment,
        duration: f64,
        observer: &mut dyn Observer,
        detail: Detail,
    ) {
        if detail == Detail::Flights && duration > 0.0 {
            observer.segment(&self.flown(told, duration));
        }
    }
}
