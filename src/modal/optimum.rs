//! Absorbers that serve a structure best under all of its loads: their clearances, and on request restitution, places and how
//! they share their mass.
//!
//! Evenly spread candidates, then some around the best, are flown from few starts at few frequencies, those first at which the
//! case's own absorbers are worst; one that is seen to be worse than the best of a round before is left. Of the best, what
//! they do is found as `check` finds it.

use std::cmp::Ordering;

use super::cost::cost;
use super::judge::against;
use super::rest::farthest_at_rest;
use super::sensors::{measured, parts, sensors};
use super::{ModalAnswer, ModalError};
use crate::case::{Bounds, Criterion, Load, ModalCase, PlacedAbsorber, Relation, Rounding};
use crate::criteria::{Judged, Outcome};
use crate::executor::Executor;
use crate::measure::{Measure, Part};
use crate::motions::{ModalEffort, ModalMotion, modal_motions};
use crate::optimize::search::{shortlist, spread_out};

/// Candidates of the first round for each number that is chosen, and most of them.
const CANDIDATES: usize = 24;
const MOST_CANDIDATES: usize = 96;
/// Starts of a candidate at each frequency, and frequencies along a load beside that at which the case's own absorbers are worst.
const FEW_STARTS: u32 = 2;
const FEW: usize = 13;
/// Candidates that are judged in full, and how far they are apart, over the bounds.
const JUDGED: usize = 3;
const APART: f64 = 0.04;
/// Least share of the mass that an absorber may have, over an even one.
const LEAST_SHARE: f64 = 0.25;

/// Absorbers and what they do.
#[derive(Debug, Clone, PartialEq)]
pub struct JudgedAbsorbers {
    /// The case with them.
    pub case: ModalCase,
    /// Its file.
    pub text: String,
    /// What they do, as `check` finds it.
    pub answer: ModalAnswer,
    /// The most that any motion may have of what each criterion is about, over what that allows; without criteria the largest
    /// displacement over that of the structure alone.
    pub reaches: Vec<f64>,
}

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalOptimum {
    /// The case's own absorbers.
    pub own: JudgedAbsorbers,
    /// The best of the others, the best first.
    pub best: Vec<JudgedAbsorbers>,
    /// Candidates that were looked at.
    pub candidates: usize,
}

impl JudgedAbsorbers {
    fn of(case: ModalCase, text: String, on: &dyn Executor) -> Result<Self, ModalError> {
        let answer = ModalAnswer::of(&case, on)?;
        let reach = |one: &Judged| {
            let room = one.margin.map(|room| room - one.error);
            room.map_or(f64::INFINITY, |room| 1.0 - room / one.criterion.scale())
        };
        let reaches = match case.criteria.is_empty() {
            true => {
                let worst = answer.worst(&case, None).map(|worst| worst.found);
                vec![worst.map_or(f64::INFINITY, |one| (one.value + one.error) / answer.bare())]
            }
            false => answer.judged.iter().map(reach).collect(),
        };
        Ok(Self { case, text, answer, reaches })
    }

    /// First how many criteria are missed, then how many are not known to hold, then how far it may move.
    fn order(&self, other: &Self) -> Ordering {
        let count = |one: &Self, which: fn(Outcome) -> bool| {
            one.answer.judged.iter().filter(|one| which(one.outcome())).count()
        };
        let fails: fn(Outcome) -> bool = |one| matches!(one, Outcome::Fails | Outcome::NotMeasured);
        let open: fn(Outcome) -> bool = |one| one != Outcome::Holds;
        let by = |which| count(self, which).cmp(&count(other, which));
        by(fails).then(by(open)).then(cost(&self.reaches).total_cmp(&cost(&other.reaches)))
    }
}

impl ModalOptimum {
    /// The best of all, the case's own among them.
    pub fn nearest(&self) -> &JudgedAbsorbers {
        let better = self.best.first().filter(|one| one.order(&self.own).is_lt());
        better.unwrap_or(&self.own)
    }

    /// Whether absorbers were found that are better than the case's own, and meet all criteria.
    pub fn succeeds(&self) -> bool {
        let succeeds = |one: &JudgedAbsorbers| {
            one.order(&self.own).is_lt() && (one.case.criteria.is_empty() || one.answer.all_hold())
        };
        self.best.first().is_some_and(succeeds)
    }

    /// The best absorbers of a case, whose file has this text.
    ///
    /// # Errors
    /// [`ModalError`] where a motion cannot be flown, or the text is not the case's.
    pub fn of(case: &ModalCase, text: &str, on: &dyn Executor) -> Result<Self, ModalError> {
        let own = JudgedAbsorbers::of(case.clone(), text.to_owned(), on)?;
        let limits = limits(case, &own.answer);
        let looked_at = frequencies(case, &own.answer, &limits);
        let most = |n: usize| looked_at.iter().map(|one| one.over[n]).fold(0.0, f64::max);
        let own_cost = cost(&(0..limits.len()).map(most).collect::<Vec<_>>());
        let (count, sensors) = (numbers(case), sensors(case));
        let few = ModalEffort { starts: FEW_STARTS, periods: 0, patience: 0.0 };
        let score = |parts: &[f64], best: f64| {
            let candidate = candidate(case, parts);
            let at_rest = case.loads.iter().flat_map(|load| farthest_at_rest(&candidate, load));
            let at_rest: Vec<ModalMotion> = at_rest.map(|one| one.1).collect();
            let known = best.max(-own_cost);
            let mut over: Vec<f64> =
                limits.iter().map(|one| over_limit(case, &at_rest, one)).collect();
            for LookedAt { load, at, .. } in &looked_at {
                let found = candidate.system(load, *at).ok();
                let found =
                    found.and_then(|system| modal_motions(&system, &sensors, few, &[]).ok());
                let Some(motions) = found else { return f64::NEG_INFINITY };
                for (over, limit) in over.iter_mut().zip(&limits) {
                    *over = over.max(over_limit(case, &motions, limit));
                }
                if -cost(&over) < known {
                    break;
                }
            }
            -cost(&over)
        };
        let first = (CANDIDATES * count).min(MOST_CANDIDATES);
        let seen = spread_out("candidates", count, first, on, &score);
        let seen = seen.map(|one| one.seen).unwrap_or_default();
        let chosen = shortlist(&seen, APART, JUDGED).into_iter();
        let judged = chosen.map(|(parts, _)| {
            let (text, case) = case.rewritten(text, &candidate(case, &parts).absorbers)?;
            JudgedAbsorbers::of(case, text, on)
        });
        let mut best = judged.collect::<Result<Vec<_>, _>>()?;
        best.sort_by(JudgedAbsorbers::order);
        Ok(Self { own, best, candidates: seen.len() })
    }
}

/// How often one `check` of the case a search of its absorbers takes, at most.
pub fn checks(case: &ModalCase) -> f64 {
    let (first, few) = ((CANDIDATES * numbers(case)).min(MOST_CANDIDATES), 0.2);
    first as f64 * few + (JUDGED + 1) as f64
}

/// What criteria allow of single motions; of a case without such ones the displacement that it has without absorbers.
fn limits(case: &ModalCase, answer: &ModalAnswer) -> Vec<Criterion> {
    let of_motions = case.criteria.iter().filter(|one| one.measure.part() != Part::Whole);
    let limits: Vec<Criterion> = of_motions.map(|one| in_amplitudes(case, one)).collect();
    match limits.is_empty() {
        true => Criterion::at_most(Measure::Peak, answer.bare()).into_iter().collect(),
        false => limits,
    }
}

/// A limit of a reduction as one of the amplitude.
fn in_amplitudes(case: &ModalCase, asked: &Criterion) -> Criterion {
    let turned = match asked.relation {
        Relation::AtLeast => Relation::AtMost,
        Relation::AtMost => Relation::AtLeast,
        Relation::Equal => Relation::Equal,
    };
    match asked.measure.against() {
        None => asked.clone(),
        Some(_) => Criterion {
            measure: Measure::Peak,
            relation: turned,
            limit: against(case, asked) * libm::pow(10.0, -asked.limit / 20.0),
            ..asked.clone()
        },
    }
}

/// The worst of any motion that counts as a part of what is allowed.
fn over_limit(case: &ModalCase, motions: &[ModalMotion], limit: &Criterion) -> f64 {
    let counting = motions.iter().filter(|one| one.counts(case.count_inactive));
    let each = counting.flat_map(|motion| {
        let parts = parts(case, limit.measure, limit.of);
        parts.filter_map(|of| measured(case, motion, of, limit.measure))
    });
    each.map(|[value, _]| limit.part(value)).fold(0.0, f64::max)
}

/// A load and a frequency that candidates are flown at.
struct LookedAt {
    load: Load,
    /// In Hz.
    at: f64,
    /// What the case's own absorbers come to there, over each limit.
    over: Vec<f64>,
}

/// Where candidates are flown, those first where the case's own absorbers are worst.
fn frequencies(case: &ModalCase, own: &ModalAnswer, limits: &[Criterion]) -> Vec<LookedAt> {
    let mut found = Vec::new();
    for along in &own.along {
        let over = |k: usize, one: &Criterion| over_limit(case, &along.places[k].motions, one);
        let moving = |k: usize, one: &Criterion| {
            let all = along.places[k].motions.iter().filter(|one| !one.rests());
            over_limit(case, &all.cloned().collect::<Vec<_>>(), one)
        };
        let last = along.places.len() - 1;
        let [from, to] = along.load.range_hz;
        let nearest = |at: f64| {
            let off = |k: &usize| (along.places[*k].at - at).abs();
            (0..=last).min_by(|a, b| off(a).total_cmp(&off(b)))
        };
        let even = (0..FEW).map(|k| from + (to - from) * k as f64 / (FEW - 1) as f64);
        let mut chosen: Vec<usize> = even.filter_map(nearest).collect();
        for one in limits {
            let most = |of: &dyn Fn(usize, &Criterion) -> f64| {
                (0..=last).max_by(|a, b| of(*a, one).total_cmp(&of(*b, one)))
            };
            // Where others rest is told for each by itself.
            chosen.extend(most(&over).into_iter().chain(most(&moving)));
        }
        let resonant =
            |k: &usize| case.modes.iter().any(|one| one.frequency_hz == along.places[*k].at);
        chosen.extend((0..=last).filter(resonant));
        chosen.sort_unstable();
        chosen.dedup();
        found.extend(chosen.into_iter().map(|k| LookedAt {
            load: along.load,
            at: along.places[k].at,
            over: limits.iter().map(|one| over(k, one)).collect(),
        }));
    }
    let worst = |one: &LookedAt| one.over.iter().copied().fold(0.0, f64::max);
    found.sort_by(|a, b| worst(b).total_cmp(&worst(a)));
    found
}

/// How many numbers are chosen.
fn numbers(case: &ModalCase) -> usize {
    let Bounds { restitution, places, split_mass, .. } = &case.bounds;
    let absorbers = case.absorbers.len();
    let splits = usize::from(*split_mass && absorbers > 1) * absorbers;
    let moves = usize::from(places.len() > 1) * absorbers;
    absorbers + usize::from(restitution.is_some()) + moves + splits
}

/// The case with other absorbers, by parts of the way between the bounds.
fn candidate(case: &ModalCase, parts: &[f64]) -> ModalCase {
    let mut parts = parts.iter().copied();
    let mut part = || parts.next().unwrap_or(0.5);
    let Bounds { clearance_m, restitution, places, split_mass } = &case.bounds;
    let mut absorbers = case.absorbers.clone();
    for one in &mut absorbers {
        let [from, to] = clearance_bounds(*clearance_m, one);
        one.clearance_m = Rounding::Nearest.of(from * libm::pow(to / from, part()));
    }
    if let Some([from, to]) = restitution {
        let restitution = libm::rint(1e3 * (from + (to - from) * part())) / 1e3;
        absorbers.iter_mut().for_each(|one| one.restitution = restitution);
    }
    if places.len() > 1 {
        for one in &mut absorbers {
            let number = (part() * places.len() as f64) as usize;
            one.place = places[number.min(places.len() - 1)];
        }
    } else if let [place] = places[..] {
        absorbers.iter_mut().for_each(|one| one.place = place);
    }
    if *split_mass && absorbers.len() > 1 {
        let together: f64 = absorbers.iter().map(|one| one.mass_kg).sum();
        let shares: Vec<f64> = absorbers.iter().map(|_| LEAST_SHARE + part()).collect();
        let sum: f64 = shares.iter().sum();
        for (one, share) in absorbers.iter_mut().zip(shares) {
            one.mass_kg = Rounding::Nearest.of(together * share / sum);
        }
    }
    ModalCase { absorbers, ..case.clone() }
}

/// The bounds of an absorber's clearance in m.
pub fn clearance_bounds(bounds: Option<[f64; 2]>, absorber: &PlacedAbsorber) -> [f64; 2] {
    bounds.unwrap_or([absorber.clearance_m / 3.0, absorber.clearance_m * 3.0])
}
