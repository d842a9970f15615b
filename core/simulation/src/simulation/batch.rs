//! Many trajectories at a time, eight side by side: [`run`].
//!
//! Each lane flies its own trajectory of its own system by the formulas of `phasor`, in the
//! same order and with the same rounding as [`Simulation::run`], so that the bits agree. All lanes fly one piece of flight
//! in a round; none waits for another. A level cavity flies as a tilted one does: a straight line is a parabola with the same
//! bits. What is rare, a panel in doubt, the end of a chattering sequence and the sustained contact after it, an oscillator that
//! does not ring, a cavity that rubs, is left to [`Simulation`] itself.

mod piece;
mod queue;

use std::borrow::BorrowMut;
use std::f64::consts::TAU;

use fearless_simd::{Level, Simd, dispatch};

use self::piece::PieceEnds;
use self::queue::{Queue, Trajectory};
use super::contact::{Rebound, rebound};
use super::events::{Detail, Observer, Side};
use super::panels::Limits;
use super::path::{Parabola, Path, StraightLine};
use super::phasor::{Rates, Steady};
use super::run::{Moment, Simulation, Stand, Stop, UnderWay};
use super::walls::Sticking;
use crate::numerics::lanes::{LANES, Real, Wide, WideMask};
use crate::system::State;

/// How far a trajectory goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Extent {
    /// By so many excitation periods,
    pub periods: u64,
    /// or until so many further impacts.
    pub impacts: u64,
}

/// Continues every trajectory by `periods` excitation periods, or until `impact_limit` further impacts
/// of its own; `observers[k]` is told of `simulations[k]`. The result is that of [`Simulation::run`]
/// for each, to the bit.
///
/// Three clearances side by side, and one of them alone:
///
/// ```
/// # use vinesink_core::system::{Cavity, Excitation, Parameters, System};
/// # let system = System::new(Parameters {
/// #     mass_ratio: 0.032 / 4.168, damping: 1.799, restitution: 0.6, frequency_ratio: 8.0 / 8.349,
/// #     forcing_per_clearance: 4.3417, excitation: Excitation::BaseDisplacement,
/// #     cavity: Cavity::IDEAL,
/// # })?;
/// use vinesink_core::simulation::{Simulation, batch};
/// use vinesink_core::system::State;
///
/// let start = State { y: 0.5, ..State::AT_REST };
/// let wider = [1.0, 1.2, 1.4].map(|factor| system.with_clearance_scaled(factor).expect("positive"));
/// let mut together = Vec::new();
/// for system in &wider {
///     together.push(Simulation::new(system, start, 0.0)?);
/// }
/// let mut alone = together[1].clone();
/// batch::run(&mut together, 200, u64::MAX, &mut [(); 3]);
/// alone.run(200, u64::MAX, &mut ());
/// assert_eq!(together[1].state(), alone.state());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Panics
/// If there are not as many observers as trajectories.
pub fn run<S: BorrowMut<Simulation>, O: Observer>(
    simulations: &mut [S],
    periods: u64,
    impact_limit: u64,
    observers: &mut [O],
) -> Vec<Stop> {
    let extents = vec![Extent { periods, impacts: impact_limit }; simulations.len()];
    run_each(simulations, &extents, observers)
}

/// The same, each trajectory as far as its own `extents[k]`.
///
/// # Panics
/// If there are not as many extents and observers as trajectories.
pub fn run_each<S: BorrowMut<Simulation>, O: Observer>(
    simulations: &mut [S],
    extents: &[Extent],
    observers: &mut [O],
) -> Vec<Stop> {
    assert_eq!(simulations.len(), observers.len(), "one observer for each trajectory");
    assert_eq!(simulations.len(), extents.len(), "one extent for each trajectory");
    run_at(Level::new(), simulations, extents, observers)
}

fn run_at<S: BorrowMut<Simulation>, O: Observer>(
    level: Level,
    simulations: &mut [S],
    extents: &[Extent],
    observers: &mut [O],
) -> Vec<Stop> {
    let tasks = simulations
        .iter_mut()
        .map(BorrowMut::borrow_mut)
        .zip(observers)
        .zip(extents)
        .map(|((simulation, observer), Extent { periods, impacts })| Trajectory {
            limits: Limits::of(simulation, *periods, *impacts),
            simulation,
            detail: observer.detail(),
            observer,
            stop: None,
        })
        .collect();
    let mut queue = Queue { tasks, next: 0 };
    fly(level, &mut queue);
    queue.tasks.into_iter().map(|task| task.stop.unwrap_or(Stop::EndTime)).collect()
}

/// Flies all of a queue. It does not depend on the type of observers: there is one copy for each set of
/// instructions, and none in a crate that uses this one.
fn fly(level: Level, queue: &mut Queue<'_>) {
    dispatch!(level, simd => Lanes::new(simd).run(queue));
}

/// Flights side by side.
struct Lanes<S: Simd> {
    simd: S,
    /// Which task each lane flies; none where the queue has run dry.
    task: [Option<usize>; LANES],
    /// Lanes whose observers need to be told of something, those of which they are told of flights, and up to where.
    observed: u64,
    flights: u64,
    told: [Moment; LANES],
    /// Time from there to where the piece of flight begins, where flights are told.
    since: [f64; LANES],
    /// Lanes that fly in short panels.
    fine: u64,
    rates: Rates<Wide<S>>,
    mass_ratio: Wide<S>,
    gravity: Wide<S>,
    /// Of either wall, the plus side first.
    restitution: [Wide<S>; 2],
    inverse_loss: [Wide<S>; 2],
    sticking: Sticking<Wide<S>>,
    /// State and phase where the flight began.
    x: Wide<S>,
    v: Wide<S>,
    line: StraightLine<Wide<S>>,
    phase: Wide<S>,
    steady: Steady<Wide<S>>,
    turns: Wide<S>,
    impacts: Wide<S>,
    evaluations: Wide<S>,
    /// Whole periods after which the steady motion is taken from the phase.
    renewal: Wide<S>,
    last_turn: Wide<S>,
    last_impact: Wide<S>,
}

/// Lanes, one bit for each.
fn lanes(bits: u64) -> impl Iterator<Item = usize> {
    (0..LANES).filter(move |lane| bits >> lane & 1 == 1)
}

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    fn new(simd: S) -> Self {
        let zero = Wide::splat(simd, 0.0);
        let one = Wide::splat(simd, 1.0);
        let steady = Steady { x: 0.0, v: 0.0 };
        let nowhere = Moment {
            state: State::AT_REST,
            steady,
            phase: 0.0,
            sense: 0.0,
            turns: 0,
            impacts: 0,
            evaluations: 0,
            fine: false,
        };
        Self {
            simd,
            task: [None; LANES],
            observed: 0,
            flights: 0,
            told: [nowhere; LANES],
            since: [0.0; LANES],
            fine: 0,
            rates: Rates::gathered(|_| one),
            mass_ratio: zero,
            gravity: zero,
            restitution: [zero; 2],
            inverse_loss: [one; 2],
            sticking: Sticking {
                decay: zero,
                stiffness: one,
                largest_force: zero,
                excursion: zero,
                inverse_loss: one,
            },
            x: zero,
            v: zero,
            line: StraightLine { y: zero, velocity: zero },
            phase: zero,
            steady: Steady { x: zero, v: zero },
            turns: zero,
            impacts: zero,
            evaluations: zero,
            renewal: zero,
            last_turn: zero,
            last_impact: zero,
        }
    }

    #[inline(always)]
    fn run(mut self, queue: &mut Queue<'_>) {
        self.simd.vectorize(
            #[inline(always)]
            || {
                let mut active = 0;
                for lane in 0..LANES {
                    active |= u64::from(self.next_task(lane, queue)) << lane;
                }
                while active != 0 {
                    active = self.round(active, queue);
                }
            },
        );
    }

    /// One piece of flight in some lanes, and what it ends with; those that fly on.
    #[inline(always)]
    fn round(&mut self, active: u64, queue: &mut Queue<'_>) -> u64 {
        let piece = self.pieces(WideMask::from_bits(self.simd, active));
        let PieceEnds { begin, good, impact, time, x, v, y, y_velocity, steady, wall, .. } = piece;
        let PieceEnds { evaluations, doubtful, .. } = piece;
        let fine = doubtful.bits();
        let doubt = active & !good.bits() | fine & self.fine;
        let stands = doubt | (doubtful & time.at_most(time.like(0.0))).bits();
        let good = good & !WideMask::from_bits(self.simd, stands);
        let left = self.rates.left(self.phase);
        let phase = self.phase + self.rates.frequency * time;
        let over = good & left.less(time);
        let since = (phase - TAU).larger(phase.like(0.0));
        let phase = Wide::choose(over, since, phase);
        let turns = Wide::choose(over, self.turns + 1.0, self.turns);

        let limit = (over & self.last_turn.at_most(turns)).bits();
        let ended = over.bits() & (limit | self.observed);
        if ended != 0 {
            let (x, v) = self.rates.period_end(self.simd, &begin, left);
            let StraightLine { y, velocity } = self.path().from(left).line();
            for lane in lanes(ended) {
                let state = State {
                    x: x[lane],
                    x_velocity: v[lane],
                    y: y[lane],
                    y_velocity: velocity[lane],
                };
                self.end_period(lane, state, left[lane], limit >> lane & 1 == 1, queue);
            }
        }
        let plus = y.like(0.0).less(wall);
        let restitution = Wide::choose(plus, self.restitution[0], self.restitution[1]);
        let after = rebound(self.mass_ratio, restitution, v, y_velocity);
        let told = impact.bits() & self.observed & !limit;
        for lane in lanes(told) {
            let Some(index) = self.task[lane] else { continue };
            let Trajectory { simulation, observer, detail, .. } = &mut queue.tasks[index];
            let before =
                State { x: x[lane], x_velocity: v[lane], y: y[lane], y_velocity: y_velocity[lane] };
            let after = Rebound {
                x_velocity: after.x_velocity[lane],
                y_velocity: after.y_velocity[lane],
                loss: after.loss[lane],
            };
            let (turns, phase) = (turns[lane] as u64, phase[lane]);
            let impact = simulation.impact(&before, Side::of(wall[lane]), &after, (turns, phase));
            let since = self.since[lane] + time[lane];
            simulation.tell_impact(&self.told[lane], since, &impact, *observer, *detail);
        }
        let follows = restitution.at_most(x.like(0.0));
        let follows = Wide::choose(follows, after.x_velocity, after.y_velocity);
        self.x = Wide::choose(good, x, self.x);
        self.v = Wide::choose(good, Wide::choose(impact, after.x_velocity, v), self.v);
        self.line.y = Wide::choose(good, Wide::choose(impact, x - wall, y), self.line.y);
        let velocity = Wide::choose(impact, follows, y_velocity);
        self.line.velocity = Wide::choose(good, velocity, self.line.velocity);
        self.phase = Wide::choose(good, phase, self.phase);
        self.steady.x = Wide::choose(good, steady.x, self.steady.x);
        self.steady.v = Wide::choose(good, steady.v, self.steady.v);
        // What is in doubt is flown once more.
        let flown = WideMask::from_bits(self.simd, active & !doubt);
        self.evaluations = Wide::choose(flown, self.evaluations + evaluations, self.evaluations);
        self.turns = turns;
        self.impacts = Wide::choose(impact, self.impacts + 1.0, self.impacts);
        for lane in lanes((over & self.renewal.at_most(turns)).bits()) {
            self.renew(lane, queue);
        }
        for lane in lanes(good.bits() & self.flights) {
            self.since[lane] += time[lane];
            if told >> lane & 1 == 1 {
                (self.told[lane], self.since[lane]) = (self.moment(lane), 0.0);
            }
        }
        for lane in lanes(active & (fine ^ self.fine) & !doubt) {
            self.set_panels(lane, fine >> lane & 1 == 1, queue);
        }

        self.sticking.inverse_loss = Wide::choose(plus, self.inverse_loss[0], self.inverse_loss[1]);
        let stuck = impact & self.sticking.possible(self.x, self.v, self.line, wall);
        let through = self.last_impact.at_most(self.impacts);
        let special = (stuck | (impact & through)).bits() & !limit;
        let mut again = active & !(doubt | special | limit);
        if doubt | special | limit != 0 {
            for lane in lanes(doubt | special | limit) {
                let flies = match limit >> lane & 1 == 1 {
                    true => self.next_task(lane, queue),
                    false => {
                        let stuck = (stuck.bits() >> lane & 1 == 1).then(|| Side::of(wall[lane]));
                        self.alone(lane, doubt >> lane & 1 == 1, stuck, queue)
                    }
                };
                again |= u64::from(flies) << lane;
            }
        }
        again
    }

    /// Ends the period of a lane, for who is to be told; it may be the last.
    fn end_period(
        &mut self,
        lane: usize,
        state: State,
        left: f64,
        last: bool,
        queue: &mut Queue<'_>,
    ) {
        let Some(index) = self.task[lane] else { return };
        let Trajectory { simulation, observer, detail, stop, .. } = &mut queue.tasks[index];
        if !last && *detail == Detail::Events {
            if self.told[lane].turns <= self.turns[lane] as u64 {
                observer.period(&state);
            }
            return;
        }
        let (begun, told) = (self.moment(lane), &mut self.told[lane]);
        // A flight that stood there may go on from it.
        if told.turns <= begun.turns {
            let since = &mut self.since[lane];
            *told = simulation.tell_period(told, &begun, state, *since + left, *observer, *detail);
            *since = -left;
        }
        if last {
            let under_way = Some(UnderWay { begun, since: -left });
            simulation.resume(Stand { at: *told, under_way });
            *stop = Some(Stop::EndTime);
        }
    }

    /// Lets a lane fly in short panels, or in long ones.
    fn set_panels(&mut self, lane: usize, fine: bool, queue: &Queue<'_>) {
        let rates = self.task[lane].and_then(|index| queue.tasks[index].simulation.rates);
        let Some(rates) = rates else { return };
        self.fine = self.fine & !(1 << lane) | u64::from(fine) << lane;
        self.rates.set(lane, &if fine { rates.finely() } else { rates });
    }

    /// Takes the steady motion of a lane from its phase.
    fn renew(&mut self, lane: usize, queue: &Queue<'_>) {
        let rates = self.task[lane].and_then(|index| queue.tasks[index].simulation.rates);
        let Some(rates) = rates else { return };
        let Steady { x, v } = rates.steady(self.phase[lane]);
        (self.steady.x[lane], self.steady.v[lane]) = (x, v);
        self.renewal[lane] = self.turns[lane] + rates.renewal;
    }

    /// Lets a lane's trajectory go on alone from where its flight began, or take the next in the queue; whether the lane
    /// flies again.
    fn alone(
        &mut self,
        lane: usize,
        doubt: bool,
        stuck: Option<Side>,
        queue: &mut Queue<'_>,
    ) -> bool {
        let Some(index) = self.task[lane] else { return false };
        let task = &mut queue.tasks[index];
        let (told, at) = (self.told[lane], self.moment(lane));
        // A flight of which not all was told, or that went on from the end of a period.
        let untold = self.flights >> lane & 1 == 1 || at.turns < told.turns;
        let under_way = UnderWay { begun: at, since: self.since[lane] };
        let stand = match doubt && untold {
            true => Stand { at: told, under_way: Some(under_way) },
            false => Stand::new(at),
        };
        task.simulation.resume(stand);
        if let Some(side) = stuck {
            task.simulation.perhaps_stick(side, task.observer);
        }
        match task.alone(doubt) {
            Some(departure) => {
                self.set_panels(lane, departure.flight().begun.fine, queue);
                self.depart(lane, &departure);
                true
            }
            None => self.next_task(lane, queue),
        }
    }

    /// The absorbers' flights.
    #[inline(always)]
    fn path(&self) -> Parabola<Wide<S>> {
        Parabola { line: self.line, acceleration: self.gravity }
    }

    /// Where a lane's flight began.
    #[inline(always)]
    fn moment(&self, lane: usize) -> Moment {
        Moment {
            state: State {
                x: self.x[lane],
                x_velocity: self.v[lane],
                y: self.line.y[lane],
                y_velocity: self.line.velocity[lane],
            },
            steady: Steady { x: self.steady.x[lane], v: self.steady.v[lane] },
            phase: self.phase[lane],
            sense: 0.0,
            turns: self.turns[lane] as u64,
            impacts: self.impacts[lane] as u64,
            evaluations: self.evaluations[lane] as u64,
            fine: self.fine >> lane & 1 == 1,
        }
    }

    /// Takes the next trajectory that flies into a lane.
    fn next_task(&mut self, lane: usize, queue: &mut Queue<'_>) -> bool {
        self.task[lane] = None;
        while queue.next < queue.tasks.len() {
            let index = queue.next;
            queue.next += 1;
            if let Some(departure) = queue.tasks[index].alone(false) {
                self.task[lane] = Some(index);
                self.settle(lane, &queue.tasks);
                self.set_panels(lane, departure.flight().begun.fine, queue);
                self.depart(lane, &departure);
                return true;
            }
        }
        false
    }

    /// Sets what stays the same along the trajectory that a lane has taken.
    fn settle(&mut self, lane: usize, tasks: &[Trajectory<'_>]) {
        let Some(Trajectory { simulation, limits, detail, .. }) =
            self.task[lane].map(|index| &tasks[index])
        else {
            return;
        };
        let set = |bits: u64, on: bool| bits & !(1 << lane) | u64::from(on) << lane;
        self.observed = set(self.observed, *detail > Detail::Nothing);
        self.flights = set(self.flights, *detail == Detail::Flights);
        self.mass_ratio[lane] = simulation.system.mass_ratio();
        self.gravity[lane] = simulation.sliding.gravity;
        for side in [Side::Plus, Side::Minus] {
            self.restitution[side.index()][lane] = simulation.restitution(side);
            self.inverse_loss[side.index()][lane] = Sticking::of(simulation, side).inverse_loss;
        }
        let sticking = Sticking::of(simulation, Side::Plus);
        self.sticking.decay[lane] = sticking.decay;
        self.sticking.stiffness[lane] = sticking.stiffness;
        self.sticking.largest_force[lane] = sticking.largest_force;
        self.sticking.excursion[lane] = sticking.excursion;
        self.last_turn[lane] = limits.turns as f64;
        self.last_impact[lane] = limits.impacts as f64;
    }

    /// Sets where a trajectory stands.
    fn depart(&mut self, lane: usize, stand: &Stand) {
        self.told[lane] = stand.at;
        let UnderWay { begun: departure, since } = stand.flight();
        self.since[lane] = since;
        let State { x, x_velocity, y, y_velocity } = departure.state;
        self.x[lane] = x;
        self.v[lane] = x_velocity;
        self.line.y[lane] = y;
        self.line.velocity[lane] = y_velocity;
        self.steady.x[lane] = departure.steady.x;
        self.steady.v[lane] = departure.steady.v;
        self.phase[lane] = departure.phase;
        self.turns[lane] = departure.turns as f64;
        self.impacts[lane] = departure.impacts as f64;
        self.evaluations[lane] = departure.evaluations as f64;
        let renewal = self.rates.renewal[lane];
        self.renewal[lane] = ((self.turns[lane] / renewal).floor() + 1.0) * renewal;
    }
}

#[cfg(test)]
mod tests;
