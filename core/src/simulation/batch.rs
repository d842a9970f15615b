//! Many trajectories at a time, sixteen side by side: [`run`].
//!
//! Each lane flies its own trajectory of its own system by the formulas of `phasor`, in the
//! same order and with the same rounding as [`Simulation::run`], so that the bits agree. Panels are
//! flown in step; a lane that has come to an event waits until enough others have, and the events are
//! dealt with together. What is rare or short, a panel in doubt, a chattering sequence and the
//! sustained contact after it, an oscillator that does not ring, a cavity that is not ideal, is left
//! to [`Simulation`] itself.

mod events;
mod queue;

use std::borrow::BorrowMut;

use fearless_simd::{Level, Simd, dispatch};

use self::queue::{Queue, Trajectory};
use super::certificate::Hull;
use super::events::{Detail, Observer, Side};
use super::panels::Limits;
use super::path::{Path, StraightLine};
use super::phasor::{FlightState, Rates, Slack, Steady};
use super::run::{Moment, Simulation, Stop};
use super::walls::{self, Sticking};
use crate::numerics::lanes::{LANES, Real, Wide, WideMask};
use crate::system::State;

/// Lanes that wait at an event before the events are dealt with: fewer would repeat that costly part
/// too often, more would let too many lanes idle. Measured.
const ENOUGH: u32 = 13;

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
    /// Lanes whose observers need to be told of something.
    observed: u64,
    rates: Rates<Wide<S>>,
    mass_ratio: Wide<S>,
    restitution: Wide<S>,
    sticking: Sticking<Wide<S>>,
    /// State and phase where the flight began.
    x: Wide<S>,
    v: Wide<S>,
    line: StraightLine<Wide<S>>,
    phase: Wide<S>,
    steady: Steady<Wide<S>>,
    /// Time from there until the period is over.
    left: Wide<S>,
    /// The panel under way, the time from the flight's beginning to its own, and the panels before it.
    here: FlightState<Wide<S>>,
    slack: Slack<Wide<S>>,
    time: Wide<S>,
    panels: Wide<S>,
    turns: Wide<S>,
    impacts: Wide<S>,
    evaluations: Wide<S>,
    last_turn: Wide<S>,
    last_impact: Wide<S>,
}

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    fn new(simd: S) -> Self {
        let zero = Wide::splat(simd, 0.0);
        let one = Wide::splat(simd, 1.0);
        let steady = Steady { x: zero, v: zero };
        let here = FlightState { z: [zero; 2], steady, a: zero, gap: zero, slope: one };
        Self {
            simd,
            task: [None; LANES],
            observed: 0,
            rates: Rates::gathered(|_| one),
            mass_ratio: zero,
            restitution: zero,
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
            steady,
            left: zero,
            here,
            slack: Slack { coefficient: zero, slope_squared: zero },
            time: zero,
            panels: zero,
            turns: zero,
            impacts: zero,
            evaluations: zero,
            last_turn: zero,
            last_impact: zero,
        }
    }

    #[inline(always)]
    fn run(mut self, queue: &mut Queue<'_>) {
        self.simd.vectorize(
            #[inline(always)]
            || self.fly_all(queue),
        );
    }

    #[inline(always)]
    fn fly_all(&mut self, queue: &mut Queue<'_>) {
        let mut fresh = 0;
        for lane in 0..LANES {
            if self.next_task(lane, queue) {
                fresh |= 1 << lane;
            }
        }
        let mut active = 0;
        loop {
            active |= self.begin(fresh, queue);
            if active == 0 {
                return;
            }
            let PanelFlight { flying, clear, there } = self.fly_panels(active);
            let resumed;
            (fresh, resumed) = self.deal_with(active & !flying, clear, there, queue);
            active = flying | resumed;
        }
    }

    /// Begins the flights of some lanes; those that do begin.
    #[inline(always)]
    fn begin(&mut self, lanes: u64, queue: &mut Queue<'_>) -> u64 {
        let (mut fresh, mut begun) = (lanes, 0);
        while fresh != 0 {
            let (here, slack) = self.rates.begin(self.x, self.v, self.steady, self.line);
            let blocked = walls::blocked(self.x, self.v, self.line) | self.rates.short(&here);
            let blocked = blocked.bits() & fresh;
            let mask = WideMask::from_bits(self.simd, fresh & !blocked);
            self.here = FlightState::choose(mask, &here, &self.here);
            self.slack = tightened(mask, &slack, &self.slack);
            let zero = self.x.like(0.0);
            self.time = Wide::choose(mask, zero, self.time);
            self.left = Wide::choose(mask, self.rates.left(self.phase), self.left);
            self.panels = Wide::choose(mask, zero, self.panels);
            begun |= fresh & !blocked;
            fresh = self.alone(blocked, queue);
        }
        begun
    }

    /// Lets some lanes' trajectories go on alone, from where their flight began, or take the next in
    /// the queue; those that fly again.
    fn alone(&mut self, lanes: u64, queue: &mut Queue<'_>) -> u64 {
        let mut again = 0;
        for lane in (0..LANES).filter(|lane| lanes >> lane & 1 == 1) {
            let Some(index) = self.task[lane] else { continue };
            queue.tasks[index].simulation.resume(&self.moment(lane));
            if self.step(lane, true, queue) {
                again |= 1 << lane;
            }
        }
        again
    }

    /// After its trajectory was set to where it stands; whether the lane flies again.
    fn step(&mut self, lane: usize, doubt: bool, queue: &mut Queue<'_>) -> bool {
        let Some(index) = self.task[lane] else { return false };
        match queue.tasks[index].alone(doubt) {
            Some(moment) => {
                self.depart(lane, &moment);
                true
            }
            None => self.next_task(lane, queue),
        }
    }

    /// Flies until enough lanes wait at an event.
    #[inline(always)]
    fn fly_panels(&mut self, active: u64) -> PanelFlight<S> {
        let all = active.count_ones();
        let enough = ENOUGH.min(all);
        let Self { simd, rates, line, slack, left, .. } = *self;
        let Self { mut here, mut time, mut panels, .. } = *self;
        let mut flying = WideMask::from_bits(simd, active);
        let mut ended = WideMask::from_bits(simd, 0);
        loop {
            let reach = time + rates.step;
            let there = rates.next(&here, line.from(reach));
            let clear = Hull::of(&here, &there, rates.step, &slack).clear();
            let over = left.at_most(reach);
            ended = ended | flying & clear & over;
            flying = flying & clear & !over;
            if flying.bits().count_ones() + enough <= all {
                (self.here, self.time) =
                    (FlightState::choose(flying, &there, &here), Wide::choose(flying, reach, time));
                self.panels = Wide::choose(flying, panels + 1.0, panels);
                return PanelFlight { flying: flying.bits(), clear: ended.bits(), there };
            }
            here = FlightState::choose(flying, &there, &here);
            time = Wide::choose(flying, reach, time);
            panels = Wide::choose(flying, panels + 1.0, panels);
        }
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
                self.depart(lane, &departure);
                return true;
            }
        }
        false
    }

    /// Sets what stays the same along the trajectory that a lane has taken.
    fn settle(&mut self, lane: usize, tasks: &[Trajectory<'_>]) {
        let one = self.mass_ratio.like(1.0);
        let each = self.task.map(|task| tasks[task?].simulation.rates.as_ref());
        self.rates = Rates::gathered(
            #[inline(always)]
            |rate| {
                let mut all = one;
                for (lane, rates) in each.iter().enumerate() {
                    all[lane] = rates.map_or(1.0, rate);
                }
                all
            },
        );
        let Some(Trajectory { simulation, limits, detail, .. }) =
            self.task[lane].map(|index| &tasks[index])
        else {
            return;
        };
        self.observed = self.observed & !(1 << lane) | u64::from(*detail > Detail::Nothing) << lane;
        self.mass_ratio[lane] = simulation.system.mass_ratio();
        self.restitution[lane] = simulation.system.restitution();
        let sticking = Sticking::of(simulation, Side::Plus);
        self.sticking.decay[lane] = sticking.decay;
        self.sticking.stiffness[lane] = sticking.stiffness;
        self.sticking.largest_force[lane] = sticking.largest_force;
        self.sticking.excursion[lane] = sticking.excursion;
        self.sticking.inverse_loss[lane] = sticking.inverse_loss;
        self.last_turn[lane] = limits.turns as f64;
        self.last_impact[lane] = limits.impacts as f64;
    }

    /// Sets where a trajectory stands.
    fn depart(&mut self, lane: usize, departure: &Moment) {
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
    }
}

/// What flying through panels comes to.
struct PanelFlight<S: Simd> {
    /// The lanes that fly on.
    flying: u64,
    /// Those of the others that wait because their period ends in a panel without impact.
    clear: u64,
    /// The ends of the panels in which those others wait.
    there: FlightState<Wide<S>>,
}

/// The slack of some lanes replaced.
#[inline(always)]
fn tightened<S: Simd>(
    lanes: WideMask<S>,
    new: &Slack<Wide<S>>,
    old: &Slack<Wide<S>>,
) -> Slack<Wide<S>> {
    Slack {
        coefficient: Wide::choose(lanes, new.coefficient, old.coefficient),
        slope_squared: Wide::choose(lanes, new.slope_squared, old.slope_squared),
    }
}

#[cfg(test)]
mod tests;
