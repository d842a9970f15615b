//! Many trajectories at a time, [`LANES`] side by side: [`run`].
//!
//! Each lane flies its own trajectory of its own system by the formulas of `phasor`, in the
//! same order and with the same rounding as [`Simulation::run`], so that the bits agree. Panels are
//! flown in step; a lane that has come to an event waits until enough others have, and the events are
//! dealt with together. What is rare, a panel in doubt, sustained contact, the end of a chattering
//! sequence, an oscillator that does not ring, is left to [`Simulation`] itself.

use fearless_simd::{Level, Simd, dispatch};

use super::contact::{Rebound, rebound};
use super::events::{Impact, Observer, Side};
use super::panels::{CORRECTIONS, Limits};
use super::phasor::{self, At, Hull, Line, Rates, Slack, Steady};
use super::run::{Moment, Simulation, Stop};
use crate::numerics::lanes::{LANES, Mask, Real, Wide, WideMask};
use crate::system::State;

/// Lanes that wait at an event before the events are dealt with: fewer would repeat that costly part
/// too often, more would let too many lanes idle. Measured.
const ENOUGH: u32 = 13;

/// Halvings of panels side by side; what needs more goes on alone.
const HALVINGS: u32 = 3;

/// Continues every trajectory by `periods` excitation periods, or until `impact_limit` further impacts
/// of its own; `observers[k]` is told of `simulations[k]`. The result is that of [`Simulation::run`]
/// for each, to the bit.
///
/// # Panics
/// If there are not as many observers as trajectories.
pub fn run<O: Observer>(
    simulations: &mut [Simulation],
    periods: u64,
    impact_limit: u64,
    observers: &mut [O],
) -> Vec<Stop> {
    assert_eq!(simulations.len(), observers.len(), "one observer for each trajectory");
    run_at(Level::new(), simulations, periods, impact_limit, observers)
}

fn run_at<O: Observer>(
    level: Level,
    simulations: &mut [Simulation],
    periods: u64,
    impact_limit: u64,
    observers: &mut [O],
) -> Vec<Stop> {
    let tasks = simulations
        .iter_mut()
        .zip(observers)
        .map(|(simulation, observer)| Task::new(simulation, observer, periods, impact_limit))
        .collect();
    let mut queue = Queue { tasks, next: 0 };
    dispatch!(level, simd => Lanes::new(simd).run(&mut queue));
    queue.tasks.into_iter().map(|task| task.stop.unwrap_or(Stop::EndTime)).collect()
}

/// A trajectory on its way.
struct Task<'a, O> {
    simulation: &'a mut Simulation,
    observer: &'a mut O,
    last_turn: u64,
    last_impact: u64,
    stop: Option<Stop>,
}

impl<'a, O: Observer> Task<'a, O> {
    fn new(
        simulation: &'a mut Simulation,
        observer: &'a mut O,
        periods: u64,
        impact_limit: u64,
    ) -> Self {
        Self {
            last_turn: simulation.periods() + periods,
            last_impact: simulation.impacts().saturating_add(impact_limit),
            simulation,
            observer,
            stop: None,
        }
    }

    /// Goes on alone until the trajectory flies through panels, or has ended; at least one step if
    /// `doubt`.
    fn alone(&mut self, mut doubt: bool) -> Option<Moment> {
        loop {
            if self.simulation.periods() >= self.last_turn {
                self.stop = Some(Stop::EndTime);
                return None;
            }
            if self.simulation.impacts() >= self.last_impact {
                self.stop = Some(Stop::ImpactLimit);
                return None;
            }
            if !doubt && let Some(departure) = self.simulation.departure() {
                return Some(departure);
            }
            doubt = false;
            let one = Limits {
                turns: self.simulation.periods() + 1,
                impacts: self.simulation.impacts() + 1,
            };
            if let Err(stop) = self.simulation.go_on(one, self.observer) {
                self.stop = Some(stop);
                return None;
            }
        }
    }
}

struct Queue<'a, O> {
    tasks: Vec<Task<'a, O>>,
    next: usize,
}

/// Flights side by side.
struct Lanes<S: Simd> {
    simd: S,
    /// Which task each lane flies; none where the queue has run dry.
    task: [Option<usize>; LANES],
    rates: Rates<Wide<S>>,
    mass_ratio: Wide<S>,
    restitution: Wide<S>,
    /// `1/(1 - r^2)`, and what else tells whether an impact could be the end of a chattering sequence.
    inverse_loss: Wide<S>,
    excursion: Wide<S>,
    largest_force: Wide<S>,
    /// State and phase where the flight began.
    x: Wide<S>,
    v: Wide<S>,
    line: Line<Wide<S>>,
    phase: Wide<S>,
    steady: Steady<Wide<S>>,
    /// Time from there until the period is over.
    left: Wide<S>,
    /// The panel under way, the time from the flight's beginning to its own, and the panels before it.
    here: At<Wide<S>>,
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
        let here = At { z: [zero; 2], steady, a: zero, gap: zero, slope: one };
        Self {
            simd,
            task: [None; LANES],
            rates: Rates {
                fastest: one,
                step: one,
                frequency: one,
                inverse_frequency: one,
                squared: one,
                decay: zero,
                twice_decay: zero,
                ringing: one,
                inverse_ringing: one,
                stiffness: one,
                sixth_free: zero,
                sixth_steady: zero,
                second_steady: zero,
                turn: [one, zero],
                swing: [one, zero, zero],
                origin: steady,
            },
            mass_ratio: zero,
            restitution: zero,
            inverse_loss: one,
            excursion: zero,
            largest_force: zero,
            x: zero,
            v: zero,
            line: Line { y: zero, velocity: zero },
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
    fn run<O: Observer>(mut self, queue: &mut Queue<'_, O>) {
        self.simd.vectorize(
            #[inline(always)]
            || self.fly_all(queue),
        );
    }

    #[inline(always)]
    fn fly_all<O: Observer>(&mut self, queue: &mut Queue<'_, O>) {
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
            let (flying, clear) = self.fly_panels(active);
            let resumed;
            (fresh, resumed) = self.deal_with(active & !flying, clear, queue);
            active = flying | resumed;
        }
    }

    /// Begins the flights of some lanes; those that do begin.
    #[inline(always)]
    fn begin<O: Observer>(&mut self, lanes: u64, queue: &mut Queue<'_, O>) -> u64 {
        let (mut fresh, mut begun) = (lanes, 0);
        while fresh != 0 {
            let (here, slack) = self.rates.begin(self.x, self.v, self.steady, self.line);
            let blocked = phasor::blocked(self.x, self.v, self.line) | self.rates.short(&here);
            let blocked = blocked.bits() & fresh;
            let mask = WideMask::from_bits(self.simd, fresh & !blocked);
            self.here = advanced(mask, &here, &self.here);
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
    fn alone<O: Observer>(&mut self, lanes: u64, queue: &mut Queue<'_, O>) -> u64 {
        let mut again = 0;
        for lane in (0..LANES).filter(|lane| lanes >> lane & 1 == 1) {
            let Some(index) = self.task[lane] else { continue };
            queue.tasks[index].simulation.stand(&self.moment(lane));
            if self.go_on(lane, true, queue) {
                again |= 1 << lane;
            }
        }
        again
    }

    /// After its trajectory was set to where it stands; whether the lane flies again.
    fn go_on<O: Observer>(&mut self, lane: usize, doubt: bool, queue: &mut Queue<'_, O>) -> bool {
        let Some(index) = self.task[lane] else { return false };
        match queue.tasks[index].alone(doubt) {
            Some(moment) => {
                self.depart(lane, &moment);
                true
            }
            None => self.next_task(lane, queue),
        }
    }

    /// Flies until enough lanes wait at an event; those that fly on, and those of the others that wait
    /// because their period ends in a panel without impact.
    #[inline(always)]
    fn fly_panels(&mut self, active: u64) -> (u64, u64) {
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
                    (advanced(flying, &there, &here), Wide::choose(flying, reach, time));
                self.panels = Wide::choose(flying, panels + 1.0, panels);
                return (flying.bits(), ended.bits());
            }
            here = advanced(flying, &there, &here);
            time = Wide::choose(flying, reach, time);
            panels = Wide::choose(flying, panels + 1.0, panels);
        }
    }

    /// Deals with the lanes that wait, in some of them with a panel that is clear: those that begin
    /// another flight, and those that fly on after a shorter panel.
    #[inline(always)]
    fn deal_with<O: Observer>(
        &mut self,
        events: u64,
        clear: u64,
        queue: &mut Queue<'_, O>,
    ) -> (u64, u64) {
        let (simd, rates) = (self.simd, self.rates);
        let zero = self.x.like(0.0);
        let waiting = WideMask::from_bits(simd, events);
        let mut clear = WideMask::from_bits(simd, clear);
        let mut length = rates.step;
        let mut there = rates.next(&self.here, self.line.from(self.time + length));
        let mut slack = self.slack;
        let mut wall = nearest(&there);
        let hull = Hull::of(&self.here, &there, length, &slack);
        let mut crossing = waiting & !clear & hull.meets(wall);
        for _ in 0..HALVINGS {
            let open = waiting & !clear & !crossing;
            if !open.any() {
                break;
            }
            length = Wide::choose(open, length * 0.5, length);
            slack = tightened(open, &slack.halved(), &slack);
            let middle = rates.after(simd, &self.here, length, self.line.from(self.time));
            there = advanced(open, &middle, &there);
            self.panels = Wide::choose(open, self.panels + 1.0, self.panels);
            wall = Wide::choose(open, nearest(&there), wall);
            let hull = Hull::of(&self.here, &there, length, &slack);
            clear = clear | (open & hull.clear());
            crossing = crossing | (open & hull.meets(wall));
        }
        let on = waiting & clear & !self.left.at_most(self.time + length);
        let guess = Rates::guess(&self.here, &there, length, wall, crossing);
        let guess = guess.larger(zero).smaller(length);
        let panel = Panel { guess, length, slack, wall };
        let end = self.end(&panel, crossing, clear & !on);
        let flight = Wide::choose(end.over, self.left, self.time + end.time);
        let Line { y, velocity } = self.line;
        let (x, v, y) = (end.x, end.v, y + velocity * flight);
        let good = end.exact & x.is_finite() & y.is_finite();
        let (impact, over) = (good & !end.over, good & end.over);
        let phase = Wide::choose(over, zero, self.phase + rates.frequency * flight);
        let after = rebound(self.mass_ratio, self.restitution, v, velocity);
        let approach = velocity;
        self.tell(good, impact, &Event { flight, x, v, y, approach, phase, wall, after }, queue);
        // Where they stand now.
        let follows =
            Wide::choose(self.restitution.at_most(zero), after.x_velocity, after.y_velocity);
        self.x = Wide::choose(good, x, self.x);
        self.v = Wide::choose(good, Wide::choose(impact, after.x_velocity, v), self.v);
        self.line.y = Wide::choose(good, Wide::choose(impact, x - wall, y), self.line.y);
        self.line.velocity = Wide::choose(impact, follows, velocity);
        self.phase = Wide::choose(good, phase, self.phase);
        for (mine, (ended, crossed)) in [
            (&mut self.steady.x, (rates.origin.x, end.steady.x)),
            (&mut self.steady.v, (rates.origin.v, end.steady.v)),
        ] {
            *mine = Wide::choose(good, Wide::choose(over, ended, crossed), *mine);
        }
        let evaluations = self.evaluations + self.panels + end.evaluations + 1.0;
        self.evaluations = Wide::choose(good, evaluations, self.evaluations);
        self.turns = Wide::choose(over, self.turns + 1.0, self.turns);
        self.impacts = Wide::choose(impact, self.impacts + 1.0, self.impacts);
        let stuck = impact
            & phasor::may_stick(
                self.x,
                self.v,
                self.line,
                wall,
                &phasor::Sticking {
                    rates: &self.rates,
                    largest_force: self.largest_force,
                    excursion: self.excursion,
                    inverse_loss: self.inverse_loss,
                },
            );
        let through = self.last_turn.at_most(self.turns) | self.last_impact.at_most(self.impacts);
        if on.any() {
            self.here = advanced(on, &there, &self.here);
            self.time = Wide::choose(on, self.time + length, self.time);
            self.panels = Wide::choose(on, self.panels + 1.0, self.panels);
        }
        let resumed = on.bits();
        let doubt = events & !good.bits() & !resumed;
        let stuck = stuck.bits();
        let special = (stuck | (good & through).bits()) & events;
        let mut again = events & !doubt & !special & !resumed;
        again |= self.alone(doubt, queue);
        for lane in (0..LANES).filter(|lane| special >> lane & 1 == 1) {
            let Some(index) = self.task[lane] else { continue };
            let task = &mut queue.tasks[index];
            task.simulation.stand(&self.moment(lane));
            if stuck >> lane & 1 == 1 {
                task.simulation.perhaps_stick(side(wall[lane]), task.observer);
            }
            if self.go_on(lane, false, queue) {
                again |= 1 << lane;
            }
        }
        (again, resumed)
    }

    /// Where the flights end within their panels: at a wall, or with the period in lanes that are
    /// `clear` until then or cross later.
    #[inline(always)]
    fn end(&self, panel: &Panel<S>, crossing: WideMask<S>, clear: WideMask<S>) -> End<S> {
        let Panel { guess, length, slack, wall } = *panel;
        let line = self.line.from(self.time);
        let (zero, none) = (self.x.like(0.0), WideMask::from_bits(self.simd, 0));
        let rest = self.left - self.time;
        let mut time = guess;
        let mut end = End {
            over: clear,
            time: zero,
            x: zero,
            v: zero,
            steady: self.steady,
            exact: none,
            evaluations: zero,
        };
        // A guess after the end of the period is not tried before the end is.
        let mut ahead = crossing & rest.less(guess);
        for _ in 0..CORRECTIONS {
            let open = (crossing | clear) & !end.exact;
            if !open.any() {
                break;
            }
            let at_end = end.over | ahead;
            let inside = time.larger(zero).smaller(length);
            let at = Wide::choose(at_end, rest, inside);
            let found = self.rates.corrected(self.simd, &self.here, at, line, wall, &slack);
            let (x, v) = self.rates.oscillator(&found.at);
            let over = open & (end.over | (ahead & slack.before(&found.at, wall)));
            let late = rest.less(found.time);
            let met = open & !at_end & found.exact & !late;
            time = Wide::choose(ahead, time, found.time);
            end.time = Wide::choose(met, found.time, end.time);
            end.x = Wide::choose(met, found.x, Wide::choose(over, x, end.x));
            end.v = Wide::choose(met, found.v, Wide::choose(over, v, end.v));
            end.steady.x = Wide::choose(met, found.steady.x, end.steady.x);
            end.steady.v = Wide::choose(met, found.steady.v, end.steady.v);
            end.evaluations = Wide::choose(open, end.evaluations + 1.0, end.evaluations);
            end.exact = end.exact | met | over;
            end.over = end.over | over | (open & !at_end & found.exact & late);
            ahead = ahead & !open;
        }
        end
    }

    /// Tells observers of what has happened to their lanes.
    #[inline(always)]
    fn tell<O: Observer>(
        &self,
        good: WideMask<S>,
        impact: WideMask<S>,
        event: &Event<S>,
        queue: &mut Queue<'_, O>,
    ) {
        let (good, impact) = (good.bits(), impact.bits());
        for lane in 0..LANES {
            let Some(index) = self.task[lane] else { continue };
            if good >> lane & 1 == 0 {
                continue;
            }
            let Task { simulation, observer, .. } = &mut queue.tasks[index];
            let flight = event.flight[lane];
            if O::SEGMENTS && flight > 0.0 {
                observer.segment(&simulation.flown(&self.moment(lane), flight));
            }
            if impact >> lane & 1 == 1 {
                let (x, y) = (event.x[lane], event.y[lane]);
                let phase = event.phase[lane];
                observer.impact(&Impact {
                    tau: simulation.tau(self.turns[lane] as u64, phase),
                    phase,
                    side: side(event.wall[lane]),
                    x,
                    x_velocity_before: event.v[lane],
                    x_velocity_after: event.after.x_velocity[lane],
                    y_velocity_before: event.approach[lane],
                    y_velocity_after: event.after.y_velocity[lane],
                    loss: event.after.loss[lane],
                    penetration: ((x - y).abs() - 1.0).max(0.0),
                });
            } else {
                observer.period(&State {
                    x: event.x[lane],
                    x_velocity: event.v[lane],
                    y: event.y[lane],
                    y_velocity: event.approach[lane],
                });
            }
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
            turns: self.turns[lane] as u64,
            impacts: self.impacts[lane] as u64,
            evaluations: self.evaluations[lane] as u64,
        }
    }

    /// Takes the next trajectory that flies into a lane.
    fn next_task<O: Observer>(&mut self, lane: usize, queue: &mut Queue<'_, O>) -> bool {
        self.task[lane] = None;
        while queue.next < queue.tasks.len() {
            let index = queue.next;
            queue.next += 1;
            if let Some(departure) = queue.tasks[index].alone(false) {
                self.task[lane] = Some(index);
                self.settle(lane, &queue.tasks[index]);
                self.depart(lane, &departure);
                return true;
            }
        }
        false
    }

    /// Sets what stays the same along a trajectory.
    fn settle<O: Observer>(&mut self, lane: usize, task: &Task<'_, O>) {
        let Some(of) = task.simulation.rates() else { return };
        let rates = &mut self.rates;
        rates.fastest[lane] = of.fastest;
        rates.step[lane] = of.step;
        rates.frequency[lane] = of.frequency;
        rates.inverse_frequency[lane] = of.inverse_frequency;
        rates.squared[lane] = of.squared;
        rates.decay[lane] = of.decay;
        rates.twice_decay[lane] = of.twice_decay;
        rates.ringing[lane] = of.ringing;
        rates.inverse_ringing[lane] = of.inverse_ringing;
        rates.stiffness[lane] = of.stiffness;
        rates.sixth_free[lane] = of.sixth_free;
        rates.sixth_steady[lane] = of.sixth_steady;
        rates.second_steady[lane] = of.second_steady;
        for k in 0..2 {
            rates.turn[k][lane] = of.turn[k];
        }
        for k in 0..3 {
            rates.swing[k][lane] = of.swing[k];
        }
        rates.origin.x[lane] = of.origin.x;
        rates.origin.v[lane] = of.origin.v;
        let system = task.simulation.system();
        let r = system.restitution();
        self.mass_ratio[lane] = system.mass_ratio();
        self.restitution[lane] = r;
        self.inverse_loss[lane] = 1.0 / ((1.0 - r) * (1.0 + r));
        self.excursion[lane] = task.simulation.tolerance().excursion;
        self.largest_force[lane] = task.simulation.largest_force();
        self.last_turn[lane] = task.last_turn as f64;
        self.last_impact[lane] = task.last_impact as f64;
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

/// What flights ended with.
struct Event<S: Simd> {
    flight: Wide<S>,
    x: Wide<S>,
    v: Wide<S>,
    y: Wide<S>,
    /// Velocity of the absorber until then.
    approach: Wide<S>,
    phase: Wide<S>,
    wall: Wide<S>,
    after: Rebound<Wide<S>>,
}

/// Where flights may end.
struct Panel<S: Simd> {
    /// When, nearly.
    guess: Wide<S>,
    length: Wide<S>,
    slack: Slack<Wide<S>>,
    wall: Wide<S>,
}

/// Where flights end within their panels, times from the panel's beginning.
struct End<S: Simd> {
    /// With the period, not at a wall.
    over: WideMask<S>,
    time: Wide<S>,
    x: Wide<S>,
    v: Wide<S>,
    steady: Steady<Wide<S>>,
    /// Whether it is known to rounding.
    exact: WideMask<S>,
    evaluations: Wide<S>,
}

fn side(wall: f64) -> Side {
    if wall > 0.0 { Side::Plus } else { Side::Minus }
}

/// The wall on whose side each gap is.
#[inline(always)]
fn nearest<S: Simd>(there: &At<Wide<S>>) -> Wide<S> {
    let one = there.gap.like(1.0);
    Wide::choose(there.gap.like(0.0).less(there.gap), one, -one)
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

/// Some lanes moved on.
#[inline(always)]
fn advanced<S: Simd>(moved: WideMask<S>, there: &At<Wide<S>>, here: &At<Wide<S>>) -> At<Wide<S>> {
    At {
        z: [Wide::choose(moved, there.z[0], here.z[0]), Wide::choose(moved, there.z[1], here.z[1])],
        steady: Steady {
            x: Wide::choose(moved, there.steady.x, here.steady.x),
            v: Wide::choose(moved, there.steady.v, here.steady.v),
        },
        a: Wide::choose(moved, there.a, here.a),
        gap: Wide::choose(moved, there.gap, here.gap),
        slope: Wide::choose(moved, there.slope, here.slope),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::{ImpactLog, Nobody};
    use crate::system::{Excitation, Parameters, System};

    fn simulations() -> Vec<Simulation> {
        (0..40)
            .map(|k| {
                let part = f64::from(k) / 40.0;
                let system = System::new(Parameters {
                    mass_ratio: 0.01 + 0.2 * part,
                    damping: 3.0 * part,
                    restitution: 0.3 + 0.6 * part,
                    frequency_ratio: 0.7 + part,
                    forcing_per_clearance: 20.0,
                    excitation: Excitation::BaseDisplacement,
                })
                .expect("valid");
                let start = State { x: part, x_velocity: 0.3, y: 0.2, y_velocity: -0.5 * part };
                Simulation::new(&system, start, 0.0).expect("inside the cavity")
            })
            .collect()
    }

    /// No instruction that another processor lacks, or rounds otherwise, has a say in a result.
    #[test]
    fn every_set_of_instructions_gives_the_same_bits() {
        let by = |level: Level| {
            let (mut together, mut alone) = (simulations(), simulations());
            let mut logs: Vec<ImpactLog> = together.iter().map(|_| ImpactLog::default()).collect();
            run_at(level, &mut together, 60, u64::MAX, &mut logs);
            for simulation in &mut alone {
                *simulation = simulation.clone().at_level(level);
                simulation.run(60, u64::MAX, &mut Nobody);
            }
            let states = |all: Vec<Simulation>| all.iter().map(Simulation::state).collect();
            let impacts: Vec<Vec<Impact>> = logs.into_iter().map(|log| log.impacts).collect();
            let states: [Vec<State>; 2] = [states(together), states(alone)];
            (impacts, states)
        };
        let (impacts, states) = by(Level::new());
        assert!(impacts.iter().map(Vec::len).sum::<usize>() > 1000);
        assert_eq!(states[0], states[1]);
        assert_eq!((impacts, states), by(Level::baseline()));
    }
}
