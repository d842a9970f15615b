//! What happens to the lanes of a batch that have come to an event.

use fearless_simd::Simd;

use super::queue::{Queue, Trajectory};
use super::{Lanes, tightened};
use crate::numerics::lanes::{LANES, Mask, Real, Wide, WideMask};
use crate::simulation::certificate::Hull;
use crate::simulation::contact::{Rebound, rebound};
use crate::simulation::events::{Detail, Side};
use crate::simulation::landing::CORRECTIONS;
use crate::simulation::path::{Path, StraightLine};
use crate::simulation::phasor::{FlightState, Rates, Slack, Steady};
use crate::system::State;

/// Halvings of panels side by side; what needs more goes on alone.
const HALVINGS: u32 = 3;

impl<S: Simd> Lanes<S> {
    /// Deals with the lanes that wait in panels that end `there`, some of which are clear: those that begin
    /// another flight, and those that fly on after a shorter panel.
    #[inline(always)]
    pub(super) fn deal_with(
        &mut self,
        events: u64,
        clear: u64,
        there: FlightState<Wide<S>>,
        queue: &mut Queue<'_>,
    ) -> (u64, u64) {
        let panel = self.narrowed(events, clear, there);
        let end = self.end(&panel);
        let event = self.event(&panel, &end);
        self.tell(&event, queue);
        self.stand(&event, &end);
        let stuck = event.impact & self.sticking.possible(self.x, self.v, self.line, panel.wall);
        let through = self.last_turn.at_most(self.turns) | self.last_impact.at_most(self.impacts);
        let on = panel.on;
        if on.any() {
            self.here = FlightState::choose(on, &panel.there, &self.here);
            self.time = Wide::choose(on, self.time + panel.length, self.time);
            self.panels = Wide::choose(on, self.panels + 1.0, self.panels);
        }
        let (good, stuck, resumed) = (event.good, stuck.bits(), on.bits());
        let doubt = events & !good.bits() & !resumed;
        let special = (stuck | (good & through).bits()) & events;
        let mut again = events & !doubt & !special & !resumed;
        again |= self.alone(doubt, queue);
        for lane in (0..LANES).filter(|lane| special >> lane & 1 == 1) {
            let Some(index) = self.task[lane] else { continue };
            let task = &mut queue.tasks[index];
            task.simulation.resume(&self.moment(lane));
            if stuck >> lane & 1 == 1 {
                task.simulation.perhaps_stick(side(panel.wall[lane]), task.observer);
            }
            if self.step(lane, false, queue) {
                again |= 1 << lane;
            }
        }
        (again, resumed)
    }

    /// The panels of the waiting lanes, halved where nothing is proven about them and they are not `clear`.
    #[inline(always)]
    fn narrowed(
        &mut self,
        events: u64,
        clear: u64,
        mut there: FlightState<Wide<S>>,
    ) -> PanelSearch<S> {
        let (simd, rates) = (self.simd, self.rates);
        let waiting = WideMask::from_bits(simd, events);
        let mut clear = WideMask::from_bits(simd, clear);
        let mut length = rates.step;
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
            slack = tightened(open, &slack.part(0.5), &slack);
            let middle = rates.after(simd, &self.here, length, self.line.from(self.time));
            there = FlightState::choose(open, &middle, &there);
            self.panels = Wide::choose(open, self.panels + 1.0, self.panels);
            wall = Wide::choose(open, nearest(&there), wall);
            let hull = Hull::of(&self.here, &there, length, &slack);
            clear = clear | (open & hull.clear());
            crossing = crossing | (open & hull.meets(wall));
        }
        let on = waiting & clear & !self.left.at_most(self.time + length);
        PanelSearch { there, length, slack, wall, crossing, over: clear & !on, on }
    }

    /// What the flights end with.
    #[inline(always)]
    fn event(&self, panel: &PanelSearch<S>, end: &PanelEnd<S>) -> FlightEvents<S> {
        let StraightLine { y, velocity } = self.line;
        let flight = Wide::choose(end.over, self.left, self.time + end.time);
        let (x, v, y) = (end.x, end.v, y + velocity * flight);
        let good = end.exact & x.is_finite() & y.is_finite();
        let phase = self.phase + self.rates.frequency * flight;
        FlightEvents {
            good,
            impact: good & !end.over,
            flight,
            x,
            v,
            y,
            phase: Wide::choose(good & end.over, x.like(0.0), phase),
            wall: panel.wall,
            after: rebound(self.mass_ratio, self.restitution, v, velocity),
        }
    }

    /// Lets the lanes stand where their flights have ended.
    #[inline(always)]
    fn stand(&mut self, event: &FlightEvents<S>, end: &PanelEnd<S>) {
        let FlightEvents { good, impact, x, v, y, wall, after, .. } = event;
        let (good, impact, over) = (*good, *impact, *good & end.over);
        let follows = self.restitution.at_most(x.like(0.0));
        let follows = Wide::choose(follows, after.x_velocity, after.y_velocity);
        self.x = Wide::choose(good, *x, self.x);
        self.v = Wide::choose(good, Wide::choose(impact, after.x_velocity, *v), self.v);
        self.line.y = Wide::choose(good, Wide::choose(impact, *x - *wall, *y), self.line.y);
        self.line.velocity = Wide::choose(impact, follows, self.line.velocity);
        self.phase = Wide::choose(good, event.phase, self.phase);
        let Steady { x: ended_x, v: ended_v } = self.rates.origin;
        let (steady_x, steady_v) =
            (Wide::choose(over, ended_x, end.steady.x), Wide::choose(over, ended_v, end.steady.v));
        self.steady.x = Wide::choose(good, steady_x, self.steady.x);
        self.steady.v = Wide::choose(good, steady_v, self.steady.v);
        let evaluations = self.evaluations + self.panels + end.evaluations + 1.0;
        self.evaluations = Wide::choose(good, evaluations, self.evaluations);
        self.turns = Wide::choose(over, self.turns + 1.0, self.turns);
        self.impacts = Wide::choose(impact, self.impacts + 1.0, self.impacts);
    }

    /// Where the flights end within their panels: at a wall, or with the period in lanes that are
    /// clear until then or cross later.
    #[inline(always)]
    fn end(&self, panel: &PanelSearch<S>) -> PanelEnd<S> {
        let PanelSearch { there, length, slack, wall, crossing, over: clear, .. } = *panel;
        let line = self.line.from(self.time);
        let (zero, none) = (self.x.like(0.0), WideMask::from_bits(self.simd, 0));
        let guess = Rates::guess(&self.here, &there, length, wall, crossing);
        let guess = guess.larger(zero).smaller(length);
        let rest = self.left - self.time;
        let mut time = guess;
        let mut end = PanelEnd {
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
    fn tell(&self, event: &FlightEvents<S>, queue: &mut Queue<'_>) {
        let (good, impact) = (event.good.bits() & self.observed, event.impact.bits());
        for lane in (0..LANES).filter(|lane| good >> lane & 1 == 1) {
            let Some(index) = self.task[lane] else { continue };
            let Trajectory { simulation, observer, detail, .. } = &mut queue.tasks[index];
            let flight = event.flight[lane];
            if flight > 0.0 && *detail == Detail::Flights {
                observer.segment(&simulation.flown(&self.moment(lane), flight));
            }
            let at = State {
                x: event.x[lane],
                x_velocity: event.v[lane],
                y: event.y[lane],
                y_velocity: self.line.velocity[lane],
            };
            if impact >> lane & 1 == 0 {
                observer.period(&at);
                continue;
            }
            let after = Rebound {
                x_velocity: event.after.x_velocity[lane],
                y_velocity: event.after.y_velocity[lane],
                loss: event.after.loss[lane],
            };
            let when = (self.turns[lane] as u64, event.phase[lane]);
            let side = side(event.wall[lane]);
            observer.impact(&simulation.impact(&at, side, &after, when));
        }
    }
}

/// What flights ended with.
struct FlightEvents<S: Simd> {
    /// Where that is known to rounding.
    good: WideMask<S>,
    /// Where it is at a wall.
    impact: WideMask<S>,
    flight: Wide<S>,
    x: Wide<S>,
    v: Wide<S>,
    y: Wide<S>,
    phase: Wide<S>,
    wall: Wide<S>,
    after: Rebound<Wide<S>>,
}

/// Where flights may end.
struct PanelSearch<S: Simd> {
    there: FlightState<Wide<S>>,
    length: Wide<S>,
    slack: Slack<Wide<S>>,
    wall: Wide<S>,
    /// Where a wall is met.
    crossing: WideMask<S>,
    /// Where it is clear until the period is over.
    over: WideMask<S>,
    /// Where it is clear, and the flight goes on.
    on: WideMask<S>,
}

/// Where flights end within their panels, times from the panel's beginning.
struct PanelEnd<S: Simd> {
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
fn nearest<S: Simd>(there: &FlightState<Wide<S>>) -> Wide<S> {
    let one = there.gap.like(1.0);
    Wide::choose(there.gap.like(0.0).less(there.gap), one, -one)
}
