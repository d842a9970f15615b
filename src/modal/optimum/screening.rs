//! How candidates are ranked: from few starts at few frequencies.

use crate::case::{Criterion, Load, ModalCase, Relation};
use crate::dampers::missed;
use crate::measure::{Measure, Part};
use crate::modal::ModalAnswer;
use crate::modal::judge::against;
use crate::modal::rest::farthest_at_rest;
use crate::modal::sensors::{measured, parts, sensors};
use crate::motions::{ModalEffort, ModalMotion, modal_motions};
use crate::simulation::Sensor;

/// Starts of a candidate at each frequency, and frequencies along a load beside that at which the case's own absorbers are worst.
const FEW_STARTS: u32 = 2;
const FEW: usize = 13;

/// Candidates as few starts at few frequencies see them.
pub(super) struct Screening<'a> {
    case: &'a ModalCase,
    limits: Vec<Criterion>,
    looked_at: Vec<LookedAt>,
    sensors: Vec<Sensor>,
    /// What the case's own absorbers come to at these frequencies.
    pub own_cost: f64,
}

impl<'a> Screening<'a> {
    pub fn of(case: &'a ModalCase, own: &ModalAnswer) -> Self {
        let limits = limits(case, own);
        let looked_at = frequencies(case, own, &limits);
        let most = |n: usize| looked_at.iter().map(|one| one.over[n]).fold(0.0, f64::max);
        let own_cost = missed(&(0..limits.len()).map(most).collect::<Vec<_>>());
        Self { case, limits, looked_at, sensors: sensors(case), own_cost }
    }

    /// By how much a candidate misses limits, or what it has of them; of one that comes to more than `most` no less than that.
    pub fn cost(&self, candidate: &ModalCase, most: f64) -> f64 {
        let Self { case, limits, .. } = self;
        let few = ModalEffort { starts: FEW_STARTS, periods: 0, patience: 0.0, accuracy: None };
        let at_rest = case.loads.iter().flat_map(|load| farthest_at_rest(candidate, load));
        let at_rest: Vec<ModalMotion> = at_rest.map(|one| one.1).collect();
        let mut over: Vec<f64> = limits.iter().map(|one| over_limit(case, &at_rest, one)).collect();
        for LookedAt { load, at, .. } in &self.looked_at {
            let found = candidate.system(load, *at).ok();
            let found =
                found.and_then(|system| modal_motions(&system, &self.sensors, few, &[]).ok());
            let Some(motions) = found else { return f64::INFINITY };
            for (over, limit) in over.iter_mut().zip(limits) {
                *over = over.max(over_limit(case, &motions, limit));
            }
            if missed(&over) > most {
                break;
            }
        }
        missed(&over)
    }
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
