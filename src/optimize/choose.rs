//! What is judged, and which of it is best.

use std::sync::Mutex;

use super::OptimizeError;
use super::design::{Judge, JudgedDesign, missed_by};
use super::search::{self, ScoredPlace, SearchEffort, SearchResult, distance, shortlist};
use super::task::Task;
use crate::band::{Survey, SurveySettings};
use crate::case::Objective;
use crate::criteria;
use crate::executor::{Executor, Serial, map};
use crate::motions::{BandEffort, Effort};

/// How thoroughly an exact objective is looked for.
const EXACT: SearchEffort =
    SearchEffort { pieces: 400, particles: 40, steps: 30, width: 1e-7, smooth: true };
/// How thoroughly a coarse survey is: a place costs a thousand times as much.
const SCREENED: SearchEffort =
    SearchEffort { pieces: 96, particles: 16, steps: 12, width: 1e-2, smooth: false };
/// Starts, and periods, of a coarse survey at a single excitation, and along a band.
const AT_ONE: (u32, u64) = (8, 120);
const ALONG: (u32, u64) = (3, 60);

/// Impacts per period there: an absorber that chatters hardly limits an amplitude.
const MOST_IMPACTS: u64 = 4;

/// Weight of missed criteria in the order of candidates: one that misses a limit by a third counts as twice as large.
const MISSED: f64 = 3.0;

/// What the cheap layers propose.
pub struct Proposed {
    /// Every place that was asked for, with its cheap score.
    pub seen: Vec<ScoredPlace>,
    /// The best of them; none where the cheap layer only ranks.
    pub best: Option<Vec<f64>>,
    /// The clearances that are as good as that.
    pub plateau: [f64; 2],
    /// The objective's value over the clearance.
    pub landscape: Vec<(f64, f64)>,
}

/// Looks everywhere between the bounds with the cheap layer.
///
/// # Errors
/// [`OptimizeError::Nowhere`] where the objective has no value.
pub fn propose(task: &Task, executor: &dyn Executor) -> Result<Proposed, OptimizeError> {
    let dimensions = task.bounds.len();
    let found = |effort, score: search::Score| {
        search::everywhere("looking between the bounds", dimensions, &effort, executor, score)
    };
    if task.objective != Objective::WorstAmplitude {
        let score =
            |parts: &[f64]| task.score(&task.choice(parts), &Serial).unwrap_or(f64::NEG_INFINITY);
        let SearchResult { line, seen, best } = found(EXACT, &score);
        let best = best.ok_or(OptimizeError::Nowhere)?;
        let place = |(at, score): &(f64, f64)| (task.bounds[0].at(*at), task.value(*score));
        return Ok(Proposed {
            plateau: best.plateau.map(|part| task.bounds[0].at(part)),
            landscape: line.iter().map(place).collect(),
            best: Some(best.parts),
            seen,
        });
    }
    let amplitudes: Mutex<Vec<ScoredPlace>> = Mutex::default();
    let score = |parts: &[f64]| {
        let screened = screened(task, parts);
        if let (Some([amplitude, _]), Ok(mut all)) = (screened, amplitudes.lock()) {
            all.push((parts.to_vec(), amplitude));
        }
        ranked(screened)
    };
    let SearchResult { line, seen, best } = found(SCREENED, &score);
    if best.is_none() && dimensions > 1 {
        return Err(OptimizeError::Nowhere);
    }
    let amplitudes = amplitudes.into_inner().unwrap_or_default();
    let amplitude = |parts: &[f64]| amplitudes.iter().find(|(there, _)| there == parts);
    let of_line = seen[seen.len() - line.len()..].iter();
    let landscape = of_line.map(|(parts, _)| {
        let value = amplitude(parts).map_or(f64::INFINITY, |(_, amplitude)| *amplitude);
        (task.bounds[0].at(parts[0]), value)
    });
    let plateau = [0.0, 1.0].map(|part| task.bounds[0].at(part));
    Ok(Proposed { plateau, landscape: landscape.collect(), best: None, seen })
}

/// The score of what a coarse survey found.
fn ranked(screened: Option<[f64; 2]>) -> f64 {
    screened.map_or(f64::NEG_INFINITY, |[amplitude, missed]| -amplitude * (1.0 + MISSED * missed))
}

/// Clearances that a short search looks at, and how many of them it judges.
const SHORT: usize = 16;
const JUDGED: usize = 3;

/// Judges the best of a few clearances for the smallest worst amplitude, as `check` does.
///
/// # Errors
/// [`OptimizeError`] of an absorber that cannot be written or simulated.
pub fn few(judge: &Judge, executor: &dyn Executor) -> Result<Vec<JudgedDesign>, OptimizeError> {
    let score = |part: f64| ranked(screened(judge.task, &[part]));
    let mut all = search::scan("looking about the closed form", SHORT, executor, &score);
    all.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut known = KnownDesigns { judge, executor, designs: Vec::new() };
    known.add(all.into_iter().take(JUDGED).map(|(part, _)| vec![part]).collect())?;
    Ok(known.into_designs())
}

/// The worst amplitude of an absorber by a coarse survey, which only ranks, and by how much criteria are missed: what has not
/// settled soon is taken as it is.
fn screened(task: &Task, parts: &[f64]) -> Option<[f64; 2]> {
    let case = task.case.with_design(task.choice(parts))?;
    let (starts, periods) = if case.band.is_some() { ALONG } else { AT_ONE };
    let band = BandEffort::SCREENING;
    let effort =
        Effort { starts, periods, patience: 0.0, most_impacts: MOST_IMPACTS, band, ..task.effort };
    let settings = SurveySettings { effort: Some(effort), ..criteria::settings(&case) };
    let survey = Survey::of(&case.range(), &settings, None, &Serial).ok()?;
    let peak = survey.worst()?.peak;
    let missed = missed_by(&criteria::judge(&case, &survey));
    Some([case.design.clearance() * (peak.value + peak.error), missed])
}

/// Distance of candidates all over the bounds, over the way between them, and how many there are.
const APART: f64 = 0.03;
const EVERYWHERE: usize = 10;
/// How many times as bad as the best a coarse survey may find a candidate that is judged all the same.
const HOPELESS: f64 = 1.5;
/// Distance of those that the cheap layer likes best, and how many.
const CLOSE: f64 = 0.008;
const LIKED: usize = 14;
/// Rounds in which the neighbours of the best are judged, how many best there are, and the distance below
/// which no further neighbour is: of a factor of 60 between the bounds, 0.8 % of the clearance.
const ROUNDS: usize = 8;
const BEST: usize = 2;
const FINEST: f64 = 0.002;

/// Judges what the cheap layers propose, as `check` does: what they like best, candidates all over the
/// bounds where criteria may exclude those, and neighbours of the best.
///
/// # Errors
/// [`OptimizeError`] of an absorber that cannot be written or simulated.
pub fn judged(
    judge: &Judge,
    proposed: &Proposed,
    executor: &dyn Executor,
) -> Result<Vec<JudgedDesign>, OptimizeError> {
    let mut known = KnownDesigns { judge, executor, designs: Vec::new() };
    if let Some(best) = &proposed.best {
        known.add(vec![best.clone()])?;
        if known.designs[0].1.is_feasible() {
            return Ok(known.into_designs());
        }
    }
    let mut chosen: Vec<Vec<f64>> = Vec::new();
    if proposed.best.is_none() {
        chosen.extend(shortlist(&proposed.seen, CLOSE, LIKED).into_iter().map(|seen| seen.0));
    }
    if !judge.task.case.criteria.is_empty() {
        let ranked = proposed.best.is_none();
        let best = proposed.seen.iter().map(|seen| seen.1).fold(f64::NEG_INFINITY, f64::max);
        for (parts, score) in shortlist(&proposed.seen, APART, usize::MAX) {
            let apart = chosen.iter().all(|one| distance(one, &parts) >= APART);
            let hopeless = ranked && score < HOPELESS * best;
            if apart && !hopeless && chosen.len() < LIKED + EVERYWHERE {
                chosen.push(parts);
            }
        }
    }
    known.add(chosen)?;
    for _ in 0..ROUNDS {
        let next = known.neighbours_of_best(&proposed.seen);
        if next.is_empty() {
            break;
        }
        known.add(next)?;
    }
    Ok(known.into_designs())
}

/// The preferred one; of equals the first.
pub fn best(designs: &[JudgedDesign], objective: Objective) -> Option<&JudgedDesign> {
    designs.iter().reduce(|a, b| if a.is_worse_than(b, objective) { b } else { a })
}

/// Designs that are judged, with their places between the bounds.
struct KnownDesigns<'a> {
    judge: &'a Judge<'a>,
    executor: &'a dyn Executor,
    designs: Vec<(Vec<f64>, JudgedDesign)>,
}

impl KnownDesigns<'_> {
    fn add(&mut self, parts: Vec<Vec<f64>>) -> Result<(), OptimizeError> {
        // Many designs side by side, or the survey of a single one.
        let side_by_side = parts.len() > 1;
        let found = map(
            if side_by_side { self.executor } else { &Serial },
            "judging candidates over the band",
            parts.len(),
            |k| self.judge.design(&parts[k], if side_by_side { &Serial } else { self.executor }),
        );
        for (parts, design) in parts.into_iter().zip(found) {
            self.designs.push((parts, design?));
        }
        Ok(())
    }

    /// Places around the best: on a line the middles between them and their neighbours, otherwise what the
    /// cheap layer has seen nearby and liked best.
    fn neighbours_of_best(&self, seen: &[ScoredPlace]) -> Vec<Vec<f64>> {
        let objective = self.judge.task.objective;
        let mut order: Vec<usize> = (0..self.designs.len()).collect();
        order.sort_by(|a, b| {
            let [a, b] = [&self.designs[*a].1, &self.designs[*b].1];
            a.is_worse_than(b, objective).cmp(&b.is_worse_than(a, objective))
        });
        let mut next: Vec<Vec<f64>> = Vec::new();
        for k in order.into_iter().take(BEST) {
            let parts = &self.designs[k].0;
            if parts.len() == 1 {
                next.extend(self.middles_around(parts[0]));
            } else {
                let near: Vec<ScoredPlace> =
                    seen.iter().filter(|one| distance(&one.0, parts) < APART).cloned().collect();
                next.extend(shortlist(&near, CLOSE, 4).into_iter().map(|seen| seen.0));
            }
        }
        next.retain(|one| self.designs.iter().all(|known| distance(&known.0, one) >= FINEST));
        next.dedup();
        next
    }

    fn middles_around(&self, part: f64) -> Vec<Vec<f64>> {
        let all = || self.designs.iter().map(|known| known.0[0]);
        let below = all().filter(|other| *other < part).max_by(f64::total_cmp).unwrap_or(0.0);
        let above = all().filter(|other| *other > part).min_by(f64::total_cmp).unwrap_or(1.0);
        [below, above]
            .into_iter()
            .map(|beside| vec![0.5 * (part + beside)])
            .filter(|middle| (middle[0] - part).abs() >= FINEST)
            .collect()
    }

    fn into_designs(self) -> Vec<JudgedDesign> {
        self.designs.into_iter().map(|(_, design)| design).collect()
    }
}
