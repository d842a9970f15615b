//! One piece of flight in each lane of a batch: as [`Rates::fly`] for one trajectory.

use fearless_simd::Simd;

use super::Lanes;
use crate::numerics::lanes::{Mask, Real, Wide, WideMask};
use crate::simulation::certificate::Hull;
use crate::simulation::landing::{CORRECTIONS, PANELS};
use crate::simulation::path::{Path, StraightLine};
use crate::simulation::phasor::{FlightState, Rates, Slack, Steady};
use crate::simulation::walls;

/// Halvings of panels side by side; what needs more goes on alone.
const HALVINGS: u32 = 3;

/// What pieces of flight end with.
pub(super) struct PieceEnds<S: Simd> {
    /// Where that is known to rounding.
    pub good: WideMask<S>,
    /// Where it is at a wall.
    pub impact: WideMask<S>,
    pub time: Wide<S>,
    pub x: Wide<S>,
    pub v: Wide<S>,
    pub y: Wide<S>,
    pub steady: Steady<Wide<S>>,
    pub wall: Wide<S>,
    pub evaluations: Wide<S>,
}

/// The panels in which flights may end.
struct PanelSearch<S: Simd> {
    there: FlightState<Wide<S>>,
    length: Wide<S>,
    slack: Slack<Wide<S>>,
    wall: Wide<S>,
    /// Where a wall is met.
    crossing: WideMask<S>,
    /// Where none is.
    clear: WideMask<S>,
    evaluations: Wide<S>,
}

impl<S: Simd> Lanes<S> {
    /// Flies a piece of some lanes.
    #[inline(always)]
    pub(super) fn pieces(&self, active: WideMask<S>) -> PieceEnds<S> {
        let Self { rates, line, .. } = *self;
        let zero = self.x.like(0.0);
        let (begin, slack) = rates.begin(self.x, self.v, self.steady, line);
        let active = active & !walls::blocked(self.x, self.v, line);
        let short = active & rates.short(&begin);
        let through = active & !short;

        let (mut here, mut there, mut time, mut panels) = (begin, begin, zero, zero);
        let mut flying = through;
        for _ in 0..PANELS {
            let reach = time + rates.step;
            there = rates.next(&here, line.from(reach));
            flying = flying & Hull::of(&here, &there, rates.step, &slack).clear();
            if !flying.any() {
                break;
            }
            here = FlightState::choose(flying, &there, &here);
            time = Wide::choose(flying, reach, time);
            panels = Wide::choose(flying, panels + 1.0, panels);
        }

        let open = through & !flying;
        let panel = self.narrowed(open, &here, there, time, &slack);
        let mut evaluations = panels + panel.evaluations;
        let mut found = self.roots(short, &begin, &here, time, &panel);
        evaluations = evaluations + found.evaluations;
        // Where nothing ends the flight it goes on from where its panels end.
        let midair = flying | panel.clear;
        if midair.any() {
            let at = FlightState::choose(flying, &here, &panel.there);
            let (x, v) = rates.oscillator(&at);
            found.x = Wide::choose(midair, x, found.x);
            found.v = Wide::choose(midair, v, found.v);
            found.steady.x = Wide::choose(midair, at.steady.x, found.steady.x);
            found.steady.v = Wide::choose(midair, at.steady.v, found.steady.v);
            let end = Wide::choose(flying, time, time + panel.length);
            found.time = Wide::choose(midair, end, found.time);
        }
        let StraightLine { y, .. } = line.from(found.time);
        let good = (midair | found.exact) & found.x.is_finite() & y.is_finite();
        PieceEnds {
            good,
            impact: good & found.exact,
            time: found.time,
            x: found.x,
            v: found.v,
            y,
            steady: found.steady,
            wall: panel.wall,
            evaluations,
        }
    }

    /// The panels of some lanes, halved where nothing is proven about them.
    #[inline(always)]
    fn narrowed(
        &self,
        waiting: WideMask<S>,
        here: &FlightState<Wide<S>>,
        mut there: FlightState<Wide<S>>,
        time: Wide<S>,
        slack: &Slack<Wide<S>>,
    ) -> PanelSearch<S> {
        let (simd, rates) = (self.simd, self.rates);
        let zero = time.like(0.0);
        let mut length = rates.step;
        let mut slack = *slack;
        let mut wall = nearest(&there);
        // A short return ends where it began.
        wall = Wide::choose(waiting, wall, nearest(here));
        let mut evaluations = Wide::choose(waiting, zero + 1.0, zero);
        let hull = Hull::of(here, &there, length, &slack);
        let mut crossing = waiting & hull.meets(wall);
        let mut clear = waiting & !waiting;
        for _ in 0..HALVINGS {
            let open = waiting & !clear & !crossing;
            if !open.any() {
                break;
            }
            length = Wide::choose(open, length * 0.5, length);
            slack = slack.chosen(open, &slack.part(0.5));
            let middle = rates.after(simd, here, length, self.line.from(time));
            there = FlightState::choose(open, &middle, &there);
            evaluations = Wide::choose(open, evaluations + 1.0, evaluations);
            wall = Wide::choose(open, nearest(&there), wall);
            let hull = Hull::of(here, &there, length, &slack);
            clear = clear | (open & hull.clear());
            crossing = crossing | (open & !clear & hull.meets(wall));
        }
        PanelSearch { there, length, slack, wall, crossing, clear, evaluations }
    }

    /// When some lanes come back to their walls, and when others meet one in their panels.
    #[inline(always)]
    fn roots(
        &self,
        short: WideMask<S>,
        begin: &FlightState<Wide<S>>,
        here: &FlightState<Wide<S>>,
        time: Wide<S>,
        panel: &PanelSearch<S>,
    ) -> PanelEnd<S> {
        let PanelSearch { there, length, slack, wall, crossing, .. } = panel;
        let (simd, line) = (self.simd, self.line.from(time));
        let zero = time.like(0.0);
        let mut at = Rates::guess(here, there, *length, *wall, *crossing);
        let mut open = *crossing;
        if short.any() {
            let (back, known) = self.rates.return_time(begin);
            at = Wide::choose(short, back, at);
            open = open | (short & known);
        }
        let mut end = PanelEnd {
            time,
            x: self.x,
            v: self.v,
            steady: self.steady,
            exact: open & !open,
            evaluations: zero,
        };
        for _ in 0..CORRECTIONS {
            if !open.any() {
                break;
            }
            at = at.larger(zero).smaller(*length);
            let found = self.rates.corrected(simd, here, at, line, *wall, slack);
            let met = open & (found.exact | short);
            let (mut x, mut v, mut steady, mut after) =
                (found.x, found.v, found.steady, found.time);
            if short.any() {
                let (own_x, own_v) = self.rates.oscillator(&found.at);
                x = Wide::choose(short, own_x, x);
                v = Wide::choose(short, own_v, v);
                steady.x = Wide::choose(short, found.at.steady.x, steady.x);
                steady.v = Wide::choose(short, found.at.steady.v, steady.v);
                after = Wide::choose(short, at, after);
            }
            end.time = Wide::choose(met, time + after, end.time);
            end.x = Wide::choose(met, x, end.x);
            end.v = Wide::choose(met, v, end.v);
            end.steady.x = Wide::choose(met, steady.x, end.steady.x);
            end.steady.v = Wide::choose(met, steady.v, end.steady.v);
            end.evaluations = Wide::choose(open, end.evaluations + 1.0, end.evaluations);
            end.exact = end.exact | met;
            open = open & !met;
            at = found.time;
        }
        end
    }
}

/// Where flights end.
struct PanelEnd<S: Simd> {
    time: Wide<S>,
    x: Wide<S>,
    v: Wide<S>,
    steady: Steady<Wide<S>>,
    /// Whether it is known to rounding.
    exact: WideMask<S>,
    evaluations: Wide<S>,
}

/// The wall on whose side each gap is.
#[inline(always)]
fn nearest<S: Simd>(there: &FlightState<Wide<S>>) -> Wide<S> {
    let one = there.gap.like(1.0);
    Wide::choose(there.gap.like(0.0).less(there.gap), one, -one)
}
