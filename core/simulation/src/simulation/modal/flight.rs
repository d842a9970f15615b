//! Flights of all absorbers from event to event: each one's first root is proven by itself, and the least is the event.

use super::motion::{Constants, Gap, Phasors, longer, longest};
use super::{Limits, STILL, Told};
use crate::numerics::crossing::{
    Crossing, CrossingBand, Curve, Edge, Sample, Search, first_crossing,
};
use crate::simulation::certificate::Hull;
use crate::simulation::contact::ContactTolerance;
use crate::simulation::landing::CORRECTIONS;
use crate::simulation::path::{Path, StraightLine};
use crate::simulation::phasor::{Rates, Slack};
use crate::simulation::roots::reverted;
use crate::simulation::{Detail, Side, Stop};

/// Part of a panel below which it is not halved further: the slow search takes over.
const SHORTEST: f64 = 1e-3;
/// Of the time in which an absorber that leaves a wall comes back, what is looked at first.
const BEYOND_RETURN: f64 = 1.4;
/// Rounding that hides the walls, over the clearance.
pub(super) const LARGEST_TOUCH: f64 = 0.1;

/// Where a trajectory stands between two flights. Lengths of absorbers are over their clearances.
#[derive(Debug, Clone, Copy)]
pub(super) struct Standing<const N: usize, const M: usize> {
    pub phasors: Phasors<N>,
    pub lines: [StraightLine<f64>; M],
    /// The wall, +1 or -1, that an absorber stands on to the last bit; 0 where it does not.
    pub walls: [f64; M],
    pub phase: f64,
    pub turns: u64,
    pub impacts: u64,
    pub evaluations: u64,
}

/// Why flights ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum FlightEnd {
    /// A limit was reached.
    Limit,
    /// The last impact may be the end of a chattering sequence.
    MayStick,
}

/// Where a flight ends.
struct Landing<const N: usize> {
    /// Time from its beginning, or from that of the panel.
    time: f64,
    /// The absorber that meets a wall; none at the end of a period.
    wall: Option<(usize, f64)>,
    at: Phasors<N>,
}

/// What one absorber's flight begins with.
#[derive(Debug, Clone, Copy)]
struct Watched {
    slack: Slack<f64>,
    /// Bound on the gap's acceleration.
    bend: f64,
    touch: f64,
    /// Time for which nothing happens although it leaves a wall without speed.
    clear: f64,
    /// Length of the first part of the first panel that is looked at.
    first: f64,
}

impl<const N: usize, const M: usize> Constants<N, M> {
    /// The gap of an absorber.
    #[inline(always)]
    pub fn gap(&self, j: usize, at: &Phasors<N>, line: StraightLine<f64>) -> Gap {
        Gap::of(self.seen(&self.views[j], &self.free(at), at.rotor), line)
    }

    /// Flies from event to event until a limit.
    pub fn fly(
        &self,
        at: &mut Standing<N, M>,
        limits: Limits,
        slow: bool,
        told: &mut Told<'_>,
    ) -> Result<FlightEnd, Stop> {
        loop {
            let begin = *at;
            let (landing, may_stick) = self.flight(at, slow)?;
            if told.detail == Detail::Flights && landing.time > 0.0 {
                told.flown(&begin, &landing.at, landing.time);
            }
            for line in &mut at.lines {
                *line = line.from(landing.time);
            }
            at.phasors = landing.at;
            let Some((j, wall)) = landing.wall else {
                (at.phase, at.turns, at.walls) = (0.0, at.turns + 1, [0.0; M]);
                at.phasors.rotor = [0.0, 1.0];
                if told.detail > Detail::Nothing {
                    told.period(at);
                }
                if limits.reached(at.turns, at.impacts) {
                    return Ok(FlightEnd::Limit);
                }
                continue;
            };
            at.phase += self.frequency * landing.time;
            if landing.time > 0.0 {
                at.walls = [0.0; M];
            }
            let before = *at;
            let opening = self.collide(at, j, wall);
            if told.detail > Detail::Nothing {
                told.impact(&before, at, j, wall);
            }
            // Opened by what it leaves the wall with: the rest is looked at where it is rare.
            let [excursion, bend] = may_stick[j];
            let largest = bend + self.kicks[j].bend * opening;
            if opening * opening <= 2.0 * excursion * largest {
                return Ok(FlightEnd::MayStick);
            }
            if limits.reached(at.turns, at.impacts) {
                return Ok(FlightEnd::Limit);
            }
        }
    }

    /// The impact of an absorber that stands at a wall; the speed at which its gap opens, in the units of the structure.
    #[inline(always)]
    pub fn collide(&self, at: &mut Standing<N, M>, j: usize, wall: f64) -> f64 {
        let Gap { gap, slope, .. } = self.gap(j, &at.phasors, at.lines[j]);
        let x = gap + at.lines[j].y;
        self.strike(j, slope, &mut at.phasors, &mut at.lines[j].velocity);
        if self.kicks[j].restitution == 0.0 {
            at.lines[j].velocity = self.gap(j, &at.phasors, STILL).slope;
        }
        at.lines[j].y = x - wall;
        at.walls[j] = wall;
        at.impacts += 1;
        self.kicks[j].restitution * slope.abs()
    }

    /// The next event, and what tells whether an impact may be the end of a chattering sequence: the opening of the gap that
    /// is tolerated, and a bound on its acceleration.
    #[inline(always)]
    fn flight(
        &self,
        at: &mut Standing<N, M>,
        slow: bool,
    ) -> Result<(Landing<N>, [[f64; 2]; M]), Stop> {
        let left = self.left(at.phase);
        let mut here = at.phasors;
        let free = self.free(&here);
        let sizes = self.sizes(&here);
        let mut gaps = [Gap { gap: 0.0, slope: 0.0, a: 0.0 }; M];
        let nothing = Slack { coefficient: 0.0, slope_squared: 0.0 };
        let mut watched =
            [Watched { slack: nothing, bend: 0.0, touch: 0.0, clear: 0.0, first: self.step }; M];
        let mut may_stick = [[0.0; 2]; M];
        let mut at_once = None;
        for j in 0..M {
            let (view, line, wall) = (&self.views[j], at.lines[j], at.walls[j]);
            let mut gap = Gap::of(self.seen(view, &free, here.rotor), line);
            let (slack, bend) = self.slack(view, &sizes);
            let touch = self.touch(view, &sizes, line);
            if touch.is_nan() || touch > LARGEST_TOUCH {
                return Err(Stop::WallsUnresolved);
            }
            let side = if wall == 0.0 { gap.gap.signum() } else { wall };
            let (on, outwards) = (wall != 0.0 || gap.gap.abs() >= 1.0 - touch, gap.slope * side);
            if on && outwards > 0.0 && at_once.is_none() {
                at_once = Some((j, side));
            }
            let one = &mut watched[j];
            (one.slack, one.bend, one.touch) = (slack, bend, touch);
            if wall != 0.0 {
                gap.gap = wall;
                if outwards == 0.0 {
                    let [jerk, _] = self.further(view, &free, here.rotor);
                    let bounds = [3, 4].map(|order| self.bound(view, &sizes, order));
                    one.clear = clear_of_wall([gap.a * wall, jerk * wall], bend, bounds, touch);
                } else if outwards < 0.0 && gap.a * wall > 0.0 {
                    let back = -2.0 * BEYOND_RETURN * outwards / (gap.a * wall);
                    one.first = self.step.min(back);
                }
            }
            gaps[j] = gap;
            let tolerated = ContactTolerance::default().excursion;
            may_stick[j] = [tolerated.max(touch * self.kicks[j].inverse_loss), bend];
        }
        if at_once.is_some() {
            return Ok((Landing { time: 0.0, wall: at_once, at: here }, may_stick));
        }
        let (mut time, mut lines) = (0.0, at.lines);
        let slack = watched.iter().map(|one| one.slack.coefficient);
        let most = if slow { 0 } else { longest(slack) };
        let mut length = most;
        loop {
            if length > 0 {
                // As far as nothing is near a wall.
                let (times, there) = (longer(length), self.next(&here, length));
                let (free, step) = (self.free(&there), self.step * times);
                let (reach, mut ends, mut clear) = (time + step, gaps, true);
                at.evaluations += 1;
                for j in 0..M {
                    let line = at.lines[j].from(reach);
                    ends[j] = Gap::of(self.seen(&self.views[j], &free, there.rotor), line);
                    let slack = watched[j].slack.part(times);
                    clear &= Hull::of(&gaps[j], &ends[j], step, &slack).clear();
                }
                if !clear {
                    length -= 1;
                    continue;
                }
                if left <= reach {
                    at.evaluations += 1;
                    let at = self.far_after(&here, left - time);
                    return Ok((Landing { time: left, wall: None, at }, may_stick));
                }
                (here, time, gaps) = (there, reach, ends);
                continue;
            }
            for (line, from) in lines.iter_mut().zip(&at.lines) {
                *line = from.from(time);
            }
            let there = self.next(&here, 0);
            let free = self.free(&there);
            at.evaluations += 1;
            let reach = time + self.step;
            let mut ends = gaps;
            let mut doubt = [slow; M];
            for j in 0..M {
                let line = at.lines[j].from(reach);
                ends[j] = Gap::of(self.seen(&self.views[j], &free, there.rotor), line);
                doubt[j] |= !Hull::of(&gaps[j], &ends[j], self.step, &watched[j].slack).clear();
            }
            let mut limit = self.step.min(left - time);
            if doubt != [false; M] {
                let mut found: Option<Landing<N>> = None;
                for j in 0..M {
                    if !doubt[j] {
                        continue;
                    }
                    let panel = Panel { here: &here, line: lines[j], ends: [gaps[j], ends[j]] };
                    let watched = if time == 0.0 {
                        watched[j]
                    } else {
                        Watched { clear: 0.0, first: self.step, ..watched[j] }
                    };
                    let root =
                        self.first_root(j, &panel, &watched, limit, slow, &mut at.evaluations)?;
                    if let Some(root) = root.filter(|root| root.time < limit) {
                        limit = root.time;
                        found = Some(root);
                    }
                }
                if let Some(found) = found {
                    let landing = Landing { time: time + found.time, ..found };
                    return Ok((landing, may_stick));
                }
                length = most;
            }
            if left <= reach {
                at.evaluations += 1;
                let at = self.after(&here, left - time);
                return Ok((Landing { time: left, wall: None, at }, may_stick));
            }
            (here, time, gaps) = (there, reach, ends);
        }
    }

    /// The first time in a panel, up to a limit, at which an absorber meets a wall.
    #[inline(never)]
    fn first_root(
        &self,
        j: usize,
        panel: &Panel<'_, N>,
        watched: &Watched,
        limit: f64,
        slow: bool,
        evaluations: &mut u64,
    ) -> Result<Option<Landing<N>>, Stop> {
        let begin = if slow {
            0.0
        } else {
            match self.proven_root(j, panel, watched, limit, evaluations) {
                Proof::Root(root) => return Ok(Some(root)),
                Proof::None => return Ok(None),
                Proof::UpTo(begin) => begin,
            }
        };
        let moment = |s: f64| self.after(panel.here, s);
        let gap = |at: &Phasors<N>, s: f64| self.gap(j, at, panel.line.from(s));
        let curve =
            GapCurve { of: |s| gap(&moment(s), s).sample(watched.bend), horizon: self.step };
        let band = CrossingBand { lower: -1.0, upper: 1.0, touch: watched.touch };
        match first_crossing(&curve, begin.max(watched.clear.min(limit)), limit, band) {
            Search::Clear { evaluations: made } => {
                *evaluations += u64::from(made);
                Ok(None)
            }
            Search::NotFinite(_) => Err(Stop::NotFinite),
            Search::Crossed(Crossing { time, edge, evaluations: made }) => {
                *evaluations += u64::from(made);
                let wall = if edge == Edge::Upper { 1.0 } else { -1.0 };
                // A correction backwards may lead to just before the panel.
                let at = moment(time.max(0.0));
                Ok(Some(Landing { time: time.max(0.0), wall: Some((j, wall)), at }))
            }
        }
    }

    /// The same by quintics: where nothing is proven any more, up to where it was.
    #[inline(always)]
    fn proven_root(
        &self,
        j: usize,
        panel: &Panel<'_, N>,
        watched: &Watched,
        limit: f64,
        evaluations: &mut u64,
    ) -> Proof<N> {
        let (mut begin, mut end, mut here) = (0.0, watched.first, panel.ends[0]);
        let moment = |s: f64| self.after(panel.here, s);
        let gap = |at: &Phasors<N>, s: f64| self.gap(j, at, panel.line.from(s));
        let mut there = panel.ends[1];
        if end < self.step {
            there = gap(&moment(end), end);
            *evaluations += 1;
        }
        let shortest = SHORTEST * end;
        loop {
            let length = end - begin;
            let slack = watched.slack.part(length / self.step);
            let hull = Hull::of(&here, &there, length, &slack);
            if hull.clear() {
                if end >= limit {
                    return Proof::None;
                }
                (begin, end, here, there) = (end, self.step, there, panel.ends[1]);
                continue;
            }
            let wall = if there.gap > 0.0 { 1.0 } else { -1.0 };
            if hull.meets(wall) {
                let mut s = Rates::guess(&here, &there, length, wall, true);
                for _ in 0..CORRECTIONS {
                    *evaluations += 1;
                    let from = begin + s.max(0.0).min(length);
                    let at = moment(from);
                    let free = self.free(&at);
                    let view = &self.views[j];
                    let Gap { gap, slope, a } =
                        Gap::of(self.seen(view, &free, at.rotor), panel.line.from(from));
                    let [jerk, _] = self.further(view, &free, at.rotor);
                    let (e, sharp) = reverted(self.fastest, [wall - gap, slope, a, jerk]);
                    let outwards = (slope + e * a) * wall;
                    if sharp && outwards > 0.0 && outwards * outwards > slack.slope_squared {
                        let (time, at) = (from + e, self.nearby(&at, e));
                        return Proof::Root(Landing { time, wall: Some((j, wall)), at });
                    }
                    s = from + e - begin;
                }
            }
            if length < shortest {
                return Proof::UpTo(begin);
            }
            end = begin + 0.5 * length;
            there = gap(&moment(end), end);
            *evaluations += 1;
        }
    }
}

/// What quintics prove of a panel.
enum Proof<const N: usize> {
    Root(Landing<N>),
    /// There is no root.
    None,
    /// There is none before.
    UpTo(f64),
}

/// One absorber's share of a panel.
struct Panel<'a, const N: usize> {
    here: &'a Phasors<N>,
    /// Its line, from the panel's beginning.
    line: StraightLine<f64>,
    ends: [Gap; 2],
}

struct GapCurve<F> {
    of: F,
    horizon: f64,
}

impl<F: Fn(f64) -> Sample> Curve for GapCurve<F> {
    fn sample(&self, s: f64) -> Sample {
        (self.of)(s)
    }
    fn horizon(&self) -> f64 {
        self.horizon
    }
}

/// How long an absorber that leaves a wall without speed is clear of it. With a closing acceleration `a <= 0` the gap stays
/// open for `3 abs(a)/jerk bound`, with `a = 0` and a closing jerk `j < 0` for `4 abs(j)/snap bound`; neither may outrun the
/// way to the opposite wall.
pub(super) fn clear_of_wall([a, jerk]: [f64; 2], bend: f64, bounds: [f64; 2], touch: f64) -> f64 {
    let by_acceleration = if a < 0.0 { -3.0 * a / bounds[0] } else { 0.0 };
    let by_jerk =
        if a <= touch * bend.max(1.0) && jerk < 0.0 { -4.0 * jerk / bounds[1] } else { 0.0 };
    by_acceleration.max(by_jerk).min((2.0 / bend).sqrt())
}

/// A wall by its sign.
pub(super) fn side(wall: f64) -> Side {
    if wall > 0.0 { Side::Plus } else { Side::Minus }
}

impl<const N: usize, const M: usize> Standing<N, M> {
    /// With what the modes and absorbers of another one have come to, as far as there are any here.
    #[must_use]
    pub fn with<const K: usize, const L: usize>(mut self, from: &Standing<K, L>) -> Self {
        for k in 0..N.min(K) {
            self.phasors.z[k] = from.phasors.z[k];
        }
        for j in 0..M.min(L) {
            (self.lines[j], self.walls[j]) = (from.lines[j], from.walls[j]);
        }
        self.phasors.rotor = from.phasors.rotor;
        (self.phase, self.turns) = (from.phase, from.turns);
        (self.impacts, self.evaluations) = (from.impacts, from.evaluations);
        self
    }

    /// At rest in the middle, at phase 0.
    pub const START: Self = Self {
        phasors: Phasors { z: [[0.0; 2]; N], rotor: [0.0, 1.0] },
        lines: [STILL; M],
        walls: [0.0; M],
        phase: 0.0,
        turns: 0,
        impacts: 0,
        evaluations: 0,
    };
}

/// The wall that an absorber rests on, if it does.
pub(super) fn resting(stuck: f64) -> Option<Side> {
    (stuck != 0.0).then(|| side(stuck))
}
