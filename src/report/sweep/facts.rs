//! What a sweep's table says, counted: `sweep.json`, and what the page's sentences are made from.

use std::ops::Range;

use serde_json::{Value, json};

use super::grid::Numbers;
use super::kinds::AREAS;
use super::{Swept, SweptCase};
use crate::analysis::Area;
use crate::case::Recorded;
use crate::criteria::Outcome;
use crate::method::Method;
use crate::quantity::Quantity;
use crate::quantity::catalogue::{POINT_SHARE, ROOM};
use crate::regimes::Regime;
use crate::sweep::columns::{Direction, names};

/// Peaks of one motion measured twice differ by less: where it repeats, by what is left of a transient; a
/// motion that does not repeat is told by its regime alone.
const SAME_PEAK: f64 = 0.02;
/// A reduction that is smaller, in dB, is what a transient has left: none.
const NO_REDUCTION: f64 = 0.005;
/// Stretches of one axis that are listed, and those of hysteresis that are told.
const MOST_STRETCHES: usize = 24;
const MOST_TOLD: usize = 3;
/// What is told of the motions of a regime.
const RANGED: [Recorded; 4] =
    [Recorded::ImpactsPerPeriod, Recorded::Peak, Recorded::ReductionDb, Recorded::DecayTime];

/// `vinesink/sweep@2`: counts, and quantities in SI or in a reduced case's units. `at` and `ends` are places on
/// the axes, each with the digits that tell it from its neighbours.
pub(super) fn document(swept: &Swept) -> Value {
    let directions = swept.directions();
    let is_there = |of: &Recorded| {
        let single = [Direction::Single];
        directions.iter().chain(&single).any(|way| swept.cells(&names(*of)[0], *way).is_some())
    };
    let [title, text_hash] = swept.case.heading();
    let recorded = Recorded::ALL.into_iter().filter(is_there).map(Recorded::key);
    let counted: Vec<Counted> = directions.iter().map(|way| Counted::of(swept, *way)).collect();
    let mut document = json!({
        "format": "vinesink/sweep@2",
        "title": title,
        "points": swept.points(),
        "axes": axes(swept),
        // Whether each point is a start of one system.
        "basin": swept.is_basin(),
        "starts": swept.starts,
        "periods": swept.periods,
        "recorded": recorded.collect::<Vec<_>>(),
        "largest_area": largest_area(swept),
        // One for each direction: a single one, or up and down.
        "motions": counted.iter().map(Counted::motions).collect::<Vec<_>>(),
        "hysteresis": hysteresis(&counted),
        "version": env!("CARGO_PKG_VERSION"),
        "case_sha256": text_hash,
        "results_sha256": swept.results_sha256,
    });
    if let SweptCase::Several(case) = swept.case {
        let of = case.sweep.as_ref();
        // From 1; none where each excitation acts, or all absorbers are varied.
        document["excitation"] = json!(of.and_then(|sweep| sweep.load).map(|load| load + 1));
        document["absorber"] = json!(of.and_then(|sweep| sweep.absorber).map(|one| one + 1));
    }
    if let Some(limits) = limits(swept) {
        document["limits"] = limits;
    }
    document
}

fn axes(swept: &Swept) -> Vec<Value> {
    let facts = swept.axes.iter().map(|axis| {
        let values = axis.values.as_slice();
        let mean = (values[values.len() - 1] - values[0]) / (values.len().max(2) - 1) as f64;
        // Written values have some four digits.
        let same = |pair: &[f64]| (pair[1] - pair[0] - mean).abs() < 1e-3 * mean.abs();
        json!({
            "key": axis.parameter.key(),
            "id": axis.kind.id,
            "values": values,
            "logarithmic": axis.logarithmic,
            "even": values.windows(2).all(same),
            "ends": axis.ends(),
            "own": axis.own,
        })
    });
    facts.collect()
}

/// The theory's area of the most points, and its share of those with an area.
fn largest_area(swept: &Swept) -> Option<Value> {
    let areas = swept.areas()?;
    let count = |name: &str| areas.iter().filter(|area| **area == Some(name)).count();
    let all = AREAS.map(|(name, _)| (name, count(name))).into_iter();
    let (name, points) = all.reduce(|best, one| if one.1 > best.1 { one } else { best })?;
    let share = share(points, areas.iter().flatten().count());
    Some(json!({ "name": name, "share": Quantity { method: Method::Theory, ..share } }))
}

/// Where all limits hold: at which share of the points at which they were judged, and where there is the most room, or least is missing.
fn limits(swept: &Swept) -> Option<Value> {
    let outcomes = swept.outcomes()?;
    let count = |of: Outcome| outcomes.iter().filter(|one| **one == Some(of)).count();
    let of_all = |points| share(points, outcomes.iter().flatten().count());
    let rooms = swept.named(ROOM.id, Direction::Single).unwrap_or_default();
    let rooms = rooms.into_iter().enumerate().filter_map(|(point, room)| Some((point, room?)));
    // Of what is not worse by its outcome that with the most room.
    let order = |(point, room): &(usize, f64)| (outcomes[*point], -room);
    let best = rooms.min_by(|a, b| {
        let (a, b) = (order(a), order(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    let best = best.map(|(point, room)| {
        json!({ "of": Quantity::new(&ROOM, room, Method::Simulation), "at": swept.place(point) })
    });
    let (hold, fail) = (count(Outcome::Holds), count(Outcome::Fails));
    let all = outcomes.iter().flatten().count();
    Some(json!({
        "hold": of_all(hold), "fail": of_all(fail), "open": of_all(all - hold - fail),
        "points": hold, "all": all == hold, "best": best,
    }))
}

fn share(points: usize, of: usize) -> Quantity {
    let share = points as f64 / of.max(1) as f64;
    Quantity::new(&POINT_SHARE, share, Method::Simulation)
}

fn quantity(of: Recorded, value: f64) -> Option<Quantity> {
    Some(Quantity::new(of.kind()?, value, Method::Simulation))
}

/// The columns of a direction.
struct Counted<'a> {
    swept: &'a Swept<'a>,
    direction: Direction,
    /// The regime of each point; of none where regimes are not recorded.
    regimes: Vec<Option<Regime>>,
    /// Regimes that occur and their points, the most first.
    present: Vec<(Regime, usize)>,
    /// Those of [`RANGED`] that have values.
    ranged: Vec<(Recorded, Numbers)>,
    /// The largest peaks of any motion.
    largest: Option<Numbers>,
    /// Peaks of the exact orbit where it attracts.
    orbit: Option<Numbers>,
}

impl<'a> Counted<'a> {
    fn of(swept: &'a Swept, direction: Direction) -> Self {
        let regimes = swept.regimes(direction).unwrap_or_else(|| vec![None; swept.points()]);
        let count = |regime| (regime, regimes.iter().filter(|one| **one == Some(regime)).count());
        let mut present = Vec::from(Regime::ALL.map(count));
        present.retain(|(_, points)| *points > 0);
        present.sort_by_key(|(_, points)| std::cmp::Reverse(*points));
        let mut ranged: Vec<(Recorded, Numbers)> =
            RANGED.into_iter().filter_map(|of| Some((of, swept.numbers(of, direction)?))).collect();
        ranged.retain(|(_, column)| column.iter().any(Option::is_some));
        let largest = swept.numbers(Recorded::LargestPeak, direction);
        let orbit = swept.numbers(Recorded::OrbitPeak, Direction::Single);
        Self { swept, direction, regimes, present, ranged, largest, orbit }
    }

    fn motions(&self) -> Value {
        let stretches = self.stretches();
        let mut facts = json!({
            "direction": self.direction,
            "worked_out": self.worked_out(),
            // Quantities of which each regime and stretch has a smallest and a largest value.
            "ranged": self.ranged.iter().filter_map(|(of, _)| Some(of.kind()?.id)).collect::<Vec<_>>(),
            "regimes": self.regimes(),
            "smallest_peak": self.extreme(self.peaks(), -1.0),
            "reduction": self.reduction(),
            "coexistence": self.coexistence(),
            "more_stretches": stretches.len().saturating_sub(MOST_STRETCHES),
            "stretches": stretches.into_iter().take(MOST_STRETCHES).collect::<Vec<_>>(),
            "groups": self.groups(),
            "theory": self.theory(),
            "orbit": self.orbit(),
        });
        if let Some(largest) = self.extreme(Recorded::LargestPeak, 1.0) {
            facts["largest_peak"] = largest;
        }
        if let Some(decay) = self.decay() {
            facts["decay"] = decay;
        }
        facts
    }

    /// Points with a motion.
    fn worked_out(&self) -> usize {
        let rms = self.swept.numbers(Recorded::Rms, self.direction);
        let columns =
            || self.ranged.iter().map(|(_, column)| column).chain(&rms).chain(&self.largest);
        let is_there = |point: &usize| {
            self.regimes[*point].is_some() || columns().any(|column| column[*point].is_some())
        };
        (0..self.swept.points()).filter(is_there).count()
    }

    /// What a point is held against another by: the largest peak of any motion, where it is recorded.
    fn peaks(&self) -> Recorded {
        if self.largest.is_some() { Recorded::LargestPeak } else { Recorded::Peak }
    }

    fn column(&self, of: Recorded) -> Option<&Numbers> {
        if of == Recorded::LargestPeak {
            return self.largest.as_ref();
        }
        self.ranged.iter().find(|(one, _)| *one == of).map(|(_, column)| column)
    }

    /// Points with a regime within some, and those of one regime.
    fn count(&self, of: Regime, within: impl Fn(usize) -> bool) -> [usize; 2] {
        let regimes = self.regimes.iter().enumerate();
        let there = regimes.filter_map(|(point, regime)| (*regime).filter(|_| within(point)));
        there.fold([0, 0], |[all, same], regime| [all + 1, same + usize::from(regime == of)])
    }

    /// Smallest and largest value of each of `ranged` within some points.
    fn ranges(&self, within: impl Fn(&usize) -> bool) -> Vec<Option<[Quantity; 2]>> {
        let range = |(of, column): &(Recorded, Numbers)| {
            let values = || (0..column.len()).filter(&within).filter_map(|point| column[point]);
            let (low, high) = (values().reduce(f64::min)?, values().reduce(f64::max)?);
            Some([quantity(*of, low)?, quantity(*of, high)?])
        };
        self.ranged.iter().map(range).collect()
    }

    fn regimes(&self) -> Vec<Value> {
        let all: usize = self.present.iter().map(|(_, points)| points).sum();
        let facts = |(regime, points): &(Regime, usize)| {
            let ranges = self.ranges(|point| self.regimes[*point] == Some(*regime));
            let share = share(*points, all);
            json!({ "regime": regime, "points": points, "share": share, "ranges": ranges })
        };
        self.present.iter().map(facts).collect()
    }

    /// The largest value, or with a negative sign the smallest, and the first point that has it.
    fn extreme(&self, of: Recorded, sign: f64) -> Option<Value> {
        let there = self.column(of)?.iter().enumerate();
        let there = there.filter_map(|(point, value)| Some((point, (*value)?)));
        let (point, value) =
            there.reduce(|best, one| if sign * one.1 > sign * best.1 { one } else { best })?;
        Some(json!({ "of": quantity(of, value), "at": self.swept.place(point) }))
    }

    /// Where a structure comes to rest first, and where last.
    fn decay(&self) -> Option<Value> {
        let [first, last] = [-1.0, 1.0].map(|sign| self.extreme(Recorded::DecayTime, sign));
        Some(json!({ "first": first?, "last": last? }))
    }

    /// Against the oscillator alone: where it is best and worst, whether the worst is an increase, and at how many
    /// of the points at which it is known there is a reduction.
    fn reduction(&self) -> Option<Value> {
        let known: Vec<f64> =
            self.column(Recorded::ReductionDb)?.iter().flatten().copied().collect();
        let reduced = known.iter().filter(|value| **value >= NO_REDUCTION).count();
        Some(json!({
            "best": self.extreme(Recorded::ReductionDb, 1.0),
            "worst": self.extreme(Recorded::ReductionDb, -1.0),
            "grows": known.iter().any(|value| *value <= -NO_REDUCTION),
            "reduced": reduced, "known": known.len(), "share": share(reduced, known.len()),
        }))
    }

    /// Where several motions exist: how many at most at a point, and the first and last value at which there are
    /// several, on each axis that reaches further.
    fn coexistence(&self) -> Option<Value> {
        let motions = self.swept.numbers(Recorded::Motions, self.direction)?;
        let several = |point: &usize| motions[*point].is_some_and(|count| count > 1.0);
        let indices: Vec<Vec<usize>> =
            (0..motions.len()).filter(several).map(|point| self.swept.indices(point)).collect();
        let axes = self.swept.axes.iter().enumerate();
        let within = axes.filter_map(|(k, axis)| {
            let first = indices.iter().map(|of| of[k]).min()?;
            let last = indices.iter().map(|of| of[k]).max()?;
            let narrower = first > 0 || last + 1 < axis.values.len();
            narrower.then(|| [axis.at(first), axis.at(last)])
        });
        Some(json!({
            "points": indices.len(),
            "share": share(indices.len(), self.worked_out()),
            "most": motions.iter().flatten().fold(0.0, |most: f64, count| most.max(*count)) as usize,
            "within": within.collect::<Vec<_>>(),
        }))
    }

    /// Stretches of a single axis in which neighbours have the same regime.
    fn stretches(&self) -> Vec<Value> {
        let ([axis], [_, ..]) = (self.swept.axes.as_slice(), self.present.as_slice()) else {
            return Vec::new();
        };
        let stretches = runs(&self.regimes).into_iter().map(|within| {
            json!({
                "ends": [axis.at(within.start), axis.at(within.end - 1)],
                "points": within.len(),
                "regime": self.regimes[within.start],
                "ranges": self.ranges(|point| within.contains(point)),
            })
        });
        stretches.collect()
    }

    /// Shares of the regimes, in their order, in each area of the theory, where an exact orbit attracts and where
    /// none does.
    fn groups(&self) -> Vec<Value> {
        if self.swept.is_basin() {
            return Vec::new();
        }
        let group = |name: &str, within: &dyn Fn(usize) -> bool| {
            let counts = self.present.iter().map(|(regime, _)| self.count(*regime, within));
            let counts: Vec<[usize; 2]> = counts.collect();
            let [points, _] = *counts.first()?;
            let shares: Vec<Quantity> =
                counts.iter().map(|[all, same]| share(*same, *all)).collect();
            (points > 0).then(|| json!({ "name": name, "points": points, "shares": shares }))
        };
        let mut all = Vec::new();
        if let Some(areas) = self.swept.areas() {
            all.extend(AREAS.map(|(name, _)| group(name, &|point| areas[point] == Some(name))));
        }
        if let Some(orbit) = &self.orbit {
            all.push(group("orbit", &|point| orbit[point].is_some()));
            all.push(group("no-orbit", &|point| orbit[point].is_none()));
        }
        all.into_iter().flatten().collect()
    }

    /// Share of two symmetric impacts per period inside and outside of area Z3.
    fn theory(&self) -> Option<[Option<Quantity>; 2]> {
        let areas = self.swept.areas()?;
        let shares = [true, false].map(|z3| {
            let within =
                |point: usize| areas[point].is_some_and(|area| (area == Area::Z3.key()) == z3);
            let [all, same] = self.count(Regime::TwoSymmetric, within);
            (all > 0).then(|| share(same, all))
        });
        shares.iter().any(Option::is_some).then_some(shares)
    }

    /// Where an exact orbit attracts: the share of the points; and of these, those with two symmetric impacts per
    /// period, and those at which no start leads to the orbit.
    fn orbit(&self) -> Option<Value> {
        let orbit = self.orbit.as_ref()?;
        let [all, _] = self.count(Regime::TwoSymmetric, |_| true);
        let [points, main] = self.count(Regime::TwoSymmetric, |point| orbit[point].is_some());
        let missed = self.orbit_missed(orbit).map(|missed| share(missed, points));
        let facts =
            json!({ "share": share(points, all), "main": share(main, points), "missed": missed });
        (points > 0).then_some(facts)
    }

    /// Points at which an exact orbit attracts and no start leads to it. Where it is not recorded whether one
    /// does, only a single motion that is another one tells that none does.
    fn orbit_missed(&self, orbit: &Numbers) -> Option<usize> {
        let attracts = (0..orbit.len()).filter(|point| orbit[*point].is_some());
        if let Some(reached) = self.swept.numbers(Recorded::OrbitReached, self.direction) {
            return Some(attracts.filter(|point| reached[*point] == Some(0.0)).count());
        }
        let motions = self.swept.numbers(Recorded::Motions, self.direction)?;
        let another = |point: &usize| {
            let other = self.regimes[*point].is_some_and(|regime| regime != Regime::TwoSymmetric);
            other && motions[*point] == Some(1.0)
        };
        Some(attracts.filter(another).count())
    }

    fn peak(&self, point: usize) -> Option<f64> {
        self.column(Recorded::Peak)?[point]
    }

    /// Whether another motion was found at a point than in the other direction.
    fn differs_from(&self, other: &Self, point: usize) -> bool {
        match self.regimes[point].zip(other.regimes[point]) {
            Some((one, two)) if one != two => return true,
            // These do not repeat.
            Some((Regime::StronglyModulated | Regime::BelowTwo, _)) => return false,
            None if !self.present.is_empty() && !other.present.is_empty() => return false,
            _ => {}
        }
        let peaks = self.peak(point).zip(other.peak(point));
        peaks.is_some_and(|(one, two)| (one - two).abs() > SAME_PEAK * one.max(two))
    }
}

/// Where what was followed up differs from what was followed down; `None` where a motion was not followed.
fn hysteresis(counted: &[Counted]) -> Option<Value> {
    let [up, down] = counted else { return None };
    let both = |known: &dyn Fn(&Counted) -> bool| known(up) && known(down);
    if !both(&|one| !one.present.is_empty()) && !both(&|one| one.column(Recorded::Peak).is_some()) {
        return None;
    }
    let points = up.swept.points();
    let differing: Vec<bool> = (0..points).map(|point| up.differs_from(down, point)).collect();
    let count = differing.iter().filter(|one| **one).count();
    let mut stretches = Vec::new();
    if let [axis] = up.swept.axes.as_slice() {
        let runs = runs(&differing).into_iter().filter(|within| differing[within.start]);
        stretches.extend(runs.map(|Range { start, end }| {
            // What was found in the middle.
            let middle = usize::midpoint(start, end - 1);
            let found = |way: &Counted| {
                let peak = way.peak(middle).and_then(|peak| quantity(Recorded::Peak, peak));
                json!({ "regime": way.regimes[middle], "peak": peak })
            };
            let ends = [axis.at(start), axis.at(end - 1)];
            json!({ "ends": ends, "up": found(up), "down": found(down) })
        }));
    }
    Some(json!({
        "points": count,
        "share": share(count, points),
        "more_stretches": stretches.len().saturating_sub(MOST_TOLD),
        "stretches": stretches.into_iter().take(MOST_TOLD).collect::<Vec<_>>(),
    }))
}

/// The runs of equal values.
fn runs<T: PartialEq>(values: &[T]) -> Vec<Range<usize>> {
    let mut begin = 0;
    let runs = values.chunk_by(|a, b| a == b).map(|run| {
        begin += run.len();
        begin - run.len()..begin
    });
    runs.collect()
}
