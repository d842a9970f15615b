//! Absorbers that serve a structure best under all of its loads: their clearances, and on request restitution, places and how
//! they share their mass.
//!
//! Evenly spread candidates, then some around the best, are flown from few starts at few frequencies, those first at which the
//! case's own absorbers are worst; one that is seen to be worse than the best of a round before is left. Where exact orbits decide what
//! is looked for they score instead. Of the best, what they do is found as `check` finds it; where numbers are uncertain, which of them
//! is best on average.

use std::cmp::Ordering;

use super::along::AlongEffort;
use super::cost::cost;
use super::judge::{against, unflown};
use super::rest::farthest_at_rest;
use super::sensors::{measured, parts, sensors};
use super::{ModalAnswer, ModalError};
use crate::case::{
    Bounds, Criterion, Load, ModalCase, Objective, PlacedAbsorber, Relation, Rounding,
};
use crate::criteria::{Judged, Outcome};
use crate::executor::{Executor, Serial, map};
use crate::measure::{Measure, Part};
use crate::motions::{ModalEffort, ModalMotion, modal_motions};
use crate::operating_range::{Varies, drawn};
use crate::optimize::robust::{
    UnderDeviations, WeightedErrors, combinations, corners, nodes_simulated,
};
use crate::optimize::search::{shortlist, spread_out};
use crate::simulation::Sensor;

/// Candidates of the first round for each number that is chosen, and most of them.
const CANDIDATES: usize = 24;
const MOST_CANDIDATES: usize = 96;
/// Starts of a candidate at each frequency, and frequencies along a load beside that at which the case's own absorbers are worst.
const FEW_STARTS: u32 = 2;
const FEW: usize = 13;
/// Candidates that are judged in full, and how far they are apart, over the bounds.
const JUDGED: usize = 3;
const APART: f64 = 0.04;
/// Candidates of which the limits on motions are looked at where exact orbits score them.
const BY_ORBITS: usize = 12;
/// Most combinations of deviations, and so many draws where there were more.
const DRAWN: u32 = 27;
/// Least share of the mass that an absorber may have, over an even one.
const LEAST_SHARE: f64 = 0.25;

/// What absorbers are looked for by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aim {
    /// That all criteria hold with the most room: the largest share that any motion has of what one allows.
    Room,
    /// The smallest displacement, or the largest share or margin of exact orbits.
    Of(Objective),
}

impl Aim {
    /// That of a case, unless another objective is asked for.
    pub fn of(case: &ModalCase, objective: Option<Objective>) -> Self {
        match objective.or(case.bounds.objective) {
            Some(objective) => Self::Of(objective),
            None if case.criteria.is_empty() => Self::Of(Objective::WorstAmplitude),
            None => match Objective::asked(&case.criteria) {
                Objective::WorstAmplitude => Self::Room,
                exact => Self::Of(exact),
            },
        }
    }

    /// What exact orbits are asked for, if they decide.
    fn of_orbits(self) -> Option<Measure> {
        match self {
            Self::Of(Objective::StableShare) => Some(Measure::StableShare),
            Self::Of(Objective::Margin) => Some(Measure::MarginClearance),
            _ => None,
        }
    }

    /// What exact orbits of a case come to; none where motions decide.
    fn exact(self, case: &ModalCase) -> Option<f64> {
        let asked = Criterion::at_most(self.of_orbits()?, 0.0)?;
        ModalAnswer::of_loads(unflown(case)).judge(case, &asked).found
    }

    /// What absorbers come to, with its error; what they use of criteria with their errors, or as they are found.
    fn value(self, case: &ModalCase, answer: &ModalAnswer, errors: bool) -> [f64; 2] {
        let lost = [f64::INFINITY, 0.0];
        match self {
            Self::Room => [cost(&reaches(case, answer, errors)), 0.0],
            Self::Of(_) => match self.exact(case) {
                Some(value) => [value, 0.0],
                None => {
                    answer.worst(case, None).map_or(lost, |one| [one.found.value, one.found.error])
                }
            },
        }
    }

    /// The more the better: of a value with its error.
    fn score(self, [value, error]: [f64; 2]) -> f64 {
        if self.of_orbits().is_some() { value } else { -(value + error) }
    }
}

/// The most that any motion may have of what each criterion is about, over what that allows; without criteria the largest displacement
/// over that of the structure alone.
fn reaches(case: &ModalCase, answer: &ModalAnswer, errors: bool) -> Vec<f64> {
    let of = |error: f64| if errors { error } else { 0.0 };
    let reach = |one: &Judged| {
        let room = one.margin.map(|room| room - of(one.error));
        room.map_or(f64::INFINITY, |room| 1.0 - room / one.criterion.scale())
    };
    match case.criteria.is_empty() {
        true => {
            let worst = answer.worst(case, None).map(|worst| worst.found);
            vec![worst.map_or(f64::INFINITY, |one| (one.value + of(one.error)) / answer.bare())]
        }
        false => answer.judged.iter().map(reach).collect(),
    }
}

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
    /// What they are looked for by, with its error: a share of what criteria allow, a displacement in m that may be larger by the error,
    /// a share of ranges, or a relative distance.
    pub value: [f64; 2],
}

/// The best on average, where numbers are uncertain.
#[derive(Debug, Clone, PartialEq)]
pub struct RobustAbsorbers {
    /// The absorbers.
    pub design: JudgedAbsorbers,
    /// What they, and the best as written, come to under deviations.
    pub under: [UnderDeviations; 2],
    /// Combinations of deviations that were averaged.
    pub combinations: usize,
}

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalOptimum {
    /// What was looked for.
    pub aim: Aim,
    /// The case's own absorbers.
    pub own: JudgedAbsorbers,
    /// The best of the others, the best first.
    pub best: Vec<JudgedAbsorbers>,
    /// Candidates that were looked at.
    pub candidates: usize,
    /// The best on average, where something is uncertain.
    pub robust: Option<RobustAbsorbers>,
}

impl JudgedAbsorbers {
    fn of(case: ModalCase, text: String, aim: Aim, on: &dyn Executor) -> Result<Self, ModalError> {
        let answer = ModalAnswer::of(&case, on)?;
        let (reaches, value) = (reaches(&case, &answer, true), aim.value(&case, &answer, true));
        Ok(Self { case, text, answer, reaches, value })
    }

    /// Whether every criterion holds; true without criteria.
    pub fn is_feasible(&self) -> bool {
        self.case.criteria.is_empty() || self.answer.all_hold()
    }

    /// First how many criteria are missed, then how many are not known to hold, then by what is looked for.
    fn order(&self, other: &Self, aim: Aim) -> Ordering {
        let count = |one: &Self, which: fn(Outcome) -> bool| {
            one.answer.judged.iter().filter(|one| which(one.outcome())).count()
        };
        let fails: fn(Outcome) -> bool = |one| matches!(one, Outcome::Fails | Outcome::NotMeasured);
        let open: fn(Outcome) -> bool = |one| one != Outcome::Holds;
        let by = |which| count(self, which).cmp(&count(other, which));
        let of_aim = || aim.score(other.value).total_cmp(&aim.score(self.value));
        by(fails).then(by(open)).then_with(of_aim)
    }
}

impl ModalOptimum {
    /// The best of all, the case's own among them.
    pub fn nearest(&self) -> &JudgedAbsorbers {
        let better = self.best.first().filter(|one| one.order(&self.own, self.aim).is_lt());
        better.unwrap_or(&self.own)
    }

    /// Whether what was looked for is anywhere at all: a displacement, or a share or margin above 0.
    pub fn reached(&self) -> bool {
        let [value, _] = self.nearest().value;
        value.is_finite() && (value != 0.0 || self.aim.of_orbits().is_none())
    }

    /// Whether absorbers were found that reach what was looked for, are better than the case's own, and meet all criteria.
    pub fn succeeds(&self) -> bool {
        let succeeds =
            |one: &JudgedAbsorbers| one.order(&self.own, self.aim).is_lt() && one.is_feasible();
        self.reached() && self.best.first().is_some_and(succeeds)
    }

    /// The best absorbers of a case, whose file has this text, by its own objective unless another is asked for.
    ///
    /// # Errors
    /// [`ModalError`] where a motion cannot be flown, or the text is not the case's.
    pub fn of(
        case: &ModalCase,
        text: &str,
        objective: Option<Objective>,
        on: &dyn Executor,
    ) -> Result<Self, ModalError> {
        let aim = Aim::of(case, objective);
        let own = JudgedAbsorbers::of(case.clone(), text.to_owned(), aim, on)?;
        let screening = Screening::of(case, &own.answer);
        let score = |parts: &[f64], best: f64| {
            let candidate = candidate(case, parts);
            match aim.of_orbits() {
                Some(_) => aim.exact(&candidate).unwrap_or(f64::NEG_INFINITY),
                None => -screening.cost(&candidate, -best.max(-screening.own_cost)),
            }
        };
        let count = numbers(case);
        let first = (CANDIDATES * count).min(MOST_CANDIDATES);
        let seen = spread_out("candidates", count, first, on, &score);
        let seen = seen.map(|one| one.seen).unwrap_or_default();
        let mut chosen = match aim.of_orbits() {
            None => shortlist(&seen, APART, JUDGED),
            Some(_) => {
                // Orbits say nothing of limits on motions.
                let mut chosen = shortlist(&seen, APART, BY_ORBITS);
                let misses = |parts: &[f64]| screening.cost(&candidate(case, parts), 1.0) > 1.0;
                chosen.sort_by_cached_key(|(parts, _)| !case.criteria.is_empty() && misses(parts));
                chosen
            }
        };
        chosen.truncate(JUDGED);
        let judged = chosen.into_iter().map(|(parts, _)| {
            let (text, case) = case.rewritten(text, &candidate(case, &parts).absorbers)?;
            JudgedAbsorbers::of(case, text, aim, on)
        });
        let mut best = judged.collect::<Result<Vec<_>, _>>()?;
        best.sort_by(|one, other| one.order(other, aim));
        let mut found = Self { aim, own, best, candidates: seen.len(), robust: None };
        found.robust = RobustAbsorbers::of(&found, on)?;
        Ok(found)
    }
}

impl RobustAbsorbers {
    /// Of those that were judged and meet as many criteria as the best as written; none where nothing is uncertain.
    fn of(found: &ModalOptimum, on: &dyn Executor) -> Result<Option<Self>, ModalError> {
        let (aim, nominal) = (found.aim, found.nearest());
        let (average, corners) = deviations(&nominal.case);
        if average.is_empty() || !found.reached() {
            return Ok(None);
        }
        let under = |one: &JudgedAbsorbers| under(&one.case, aim, &average, &corners, on);
        let of_nominal = under(nominal)?;
        let mut best = (nominal, of_nominal);
        let missed = |one: &JudgedAbsorbers| {
            one.answer.judged.iter().filter(|one| one.outcome() != Outcome::Holds).count()
        };
        let others = found.best.iter().chain([&found.own]);
        for one in others.filter(|one| *one != nominal && missed(one) == missed(nominal)) {
            let there = under(one)?;
            if aim.score([there.expected, 0.0]) > aim.score([best.1.expected, 0.0]) {
                best = (one, there);
            }
        }
        let (design, of_best) = best;
        let under = [of_best, of_nominal];
        Ok(Some(Self { design: design.clone(), under, combinations: average.len() }))
    }
}

/// Deviations that are averaged with their weights, and those of which the worst counts: nodes of a quadrature and all corners, or where
/// these are many draws that cover each number evenly. Empty where nothing is uncertain.
fn deviations(case: &ModalCase) -> (Vec<WeightedErrors>, Vec<WeightedErrors>) {
    let uncertain = case.uncertain();
    let nodes = nodes_simulated(uncertain.len());
    match uncertain.len() {
        0 => (Vec::new(), Vec::new()),
        count if libm::pow(nodes as f64, count as f64) <= f64::from(DRAWN) => {
            (combinations(&uncertain, nodes), corners(&uncertain))
        }
        _ => {
            let all = drawn(&uncertain, DRAWN).into_iter();
            let all: Vec<_> = all.map(|errors| (errors, 1.0 / f64::from(DRAWN))).collect();
            (all.clone(), all)
        }
    }
}

/// What absorbers come to under deviations, by fewer starts and frequencies than `check` takes and without their errors, which are
/// larger then; as bad as can be where one leaves no structure.
fn under(
    case: &ModalCase,
    aim: Aim,
    average: &[WeightedErrors],
    corners: &[WeightedErrors],
    on: &dyn Executor,
) -> Result<UnderDeviations, ModalError> {
    let lost = if aim.of_orbits().is_some() { 0.0 } else { f64::INFINITY };
    let all: Vec<&WeightedErrors> = average.iter().chain(corners).collect();
    let come_to = |k: usize| {
        let Some(there) = Varies::deviating(case, &all[k].0) else { return Ok(lost) };
        if let Some(value) = aim.exact(&there) {
            return Ok(value);
        }
        let answer = ModalAnswer::with(&there, &AlongEffort::SCREENING, &[], &Serial)?;
        let [value, _] = aim.value(&there, &answer, false);
        Ok(value)
    };
    let values = map(on, "deviations", all.len(), come_to);
    let values = values.into_iter().collect::<Result<Vec<f64>, ModalError>>()?;
    let (averaged, ends) = values.split_at(average.len());
    let expected = averaged.iter().zip(average).map(|(value, (_, weight))| value * weight).sum();
    let worst =
        ends.iter().copied().min_by(|a, b| aim.score([*a, 0.0]).total_cmp(&aim.score([*b, 0.0])));
    Ok(UnderDeviations { expected, worst_corner: worst.unwrap_or(lost) })
}

/// Candidates as few starts at few frequencies see them.
struct Screening<'a> {
    case: &'a ModalCase,
    limits: Vec<Criterion>,
    looked_at: Vec<LookedAt>,
    sensors: Vec<Sensor>,
    /// What the case's own absorbers come to at these frequencies.
    own_cost: f64,
}

impl<'a> Screening<'a> {
    fn of(case: &'a ModalCase, own: &ModalAnswer) -> Self {
        let limits = limits(case, own);
        let looked_at = frequencies(case, own, &limits);
        let most = |n: usize| looked_at.iter().map(|one| one.over[n]).fold(0.0, f64::max);
        let own_cost = cost(&(0..limits.len()).map(most).collect::<Vec<_>>());
        Self { case, limits, looked_at, sensors: sensors(case), own_cost }
    }

    /// By how much a candidate misses limits, or what it has of them; of one that comes to more than `most` no less than that.
    fn cost(&self, candidate: &ModalCase, most: f64) -> f64 {
        let Self { case, limits, .. } = self;
        let few = ModalEffort { starts: FEW_STARTS, periods: 0, patience: 0.0 };
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
            if cost(&over) > most {
                break;
            }
        }
        cost(&over)
    }
}

/// How often one `check` of the case a search of its absorbers takes, at most.
pub fn checks(case: &ModalCase) -> f64 {
    let (first, few) = ((CANDIDATES * numbers(case)).min(MOST_CANDIDATES), 0.2);
    let (average, corners) = deviations(case);
    let under = (average.len() + corners.len()) * (JUDGED + 1);
    (first + under) as f64 * few + (JUDGED + 1) as f64
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
    let Bounds { clearance_m, restitution, places, split_mass, .. } = &case.bounds;
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
