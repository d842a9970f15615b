//! One piece of flight in each lane of a batch: as [`Rates::fly`] for one trajectory.

use fearless_simd::Simd;

use super::Lanes;
use crate::numerics::lanes::{Mask, Real, Wide, WideMask};
use crate::simulation::certificate::Hull;
use crate::simulation::landing::{CORRECTIONS, PANELS};
use crate::simulation::path::{Path, StraightLine};
use crate::simulation::phasor::{FlightState, Rates, Slack, Steady};
use crate::simulation::walls;

/// What pieces of flight end with.
pub(super) struct PieceEnds<S: Simd> {
    /// What they begin with.
    pub begin: FlightState<Wide<S>>,
    /// Where that is known to rounding.
    pub good: WideMask<S>,
    /// Where it is at a wall.
    pub impact: WideMask<S>,
    pub time: Wide<S>,
    pub x: Wide<S>,
    pub v: Wide<S>,
    pub y: Wide<S>,
    pub y_velocity: Wide<S>,
    pub steady: Steady<Wide<S>>,
    pub wall: Wide<S>,
    pub evaluations: Wide<S>,
    /// Where nothing is proven about the next panel.
    pub doubtful: WideMask<S>,
}

/// The panels in which flights may end.
struct PanelSearch<S: Simd> {
    there: FlightState<Wide<S>>,
    slack: Slack<Wide<S>>,
    wall: Wide<S>,
    /// Where a wall is met.
    crossing: WideMask<S>,
}

impl<S: Simd> Lanes<S> {
    /// Flies a piece of some lanes.
    #[inline(always)]
    pub(super) fn pieces(&self, active: WideMask<S>) -> PieceEnds<S> {
        let (rates, path) = (self.rates, self.path());
        let zero = self.x.like(0.0);
        let (begin, slack) = rates.begin(self.x, self.v, self.steady, path);
        let active = active & !walls::blocked(self.x, self.v, self.line);
        let short = active & rates.short(&begin);
        let through = active & !short;

        // All fly on; where each was before the panel about which nothing is proven is kept beside, so that no panel waits
        // for the proof of the one before.
        let (mut at, mut reach, mut flying) = (begin, zero, through);
        let (mut here, mut time, mut panels) = (begin, zero, zero);
        for _ in 0..PANELS {
            reach = reach + rates.step;
            let next = rates.next(&at, path.from(reach));
            flying = flying & Hull::of(&at, &next, rates.step, &slack).clear();
            if !flying.any() {
                break;
            }
            here = FlightState::choose(flying, &next, &here);
            time = Wide::choose(flying, reach, time);
            panels = Wide::choose(flying, panels + 1.0, panels);
            at = next;
        }
        let there = rates.next(&here, path.from(time + rates.step));

        let open = through & !flying;
        // A short return ends where it began.
        let wall = Wide::choose(open, nearest(&there), nearest(&here));
        let crossing = open & Hull::of(&here, &there, rates.step, &slack).meets(wall);
        let panel = PanelSearch { there, slack, wall, crossing };
        let mut found = self.roots(short, &begin, &here, time, &panel);
        let one = zero + 1.0;
        let evaluations = panels + Wide::choose(open, one, zero) + found.evaluations;
        // Where nothing ends the flight it goes on from where its panels end.
        let midair = through & !found.exact;
        if midair.any() {
            let (x, v) = rates.oscillator(&here);
            found.x = Wide::choose(midair, x, found.x);
            found.v = Wide::choose(midair, v, found.v);
            found.steady.x = Wide::choose(midair, here.steady.x, found.steady.x);
            found.steady.v = Wide::choose(midair, here.steady.v, found.steady.v);
            found.time = Wide::choose(midair, time, found.time);
        }
        let StraightLine { y, velocity } = path.from(found.time).line();
        let good = (midair | found.exact) & found.x.is_finite() & y.is_finite();
        PieceEnds {
            begin,
            good,
            impact: good & found.exact,
            time: found.time,
            x: found.x,
            v: found.v,
            y,
            y_velocity: velocity,
            steady: found.steady,
            wall,
            evaluations,
            doubtful: good & midair & !flying,
        }
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
        let PanelSearch { there, slack, wall, crossing } = panel;
        let (simd, path, length) = (self.simd, self.path().from(time), self.rates.step);
        let zero = time.like(0.0);
        let mut at = Rates::guess(here, there, length, *wall, *crossing);
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
            at = at.larger(zero).smaller(length);
            let found = self.rates.corrected(simd, here, at, path, *wall, slack);
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
