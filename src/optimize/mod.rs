//! The absorber that serves a case best: clearance, and on request restitution and mass.
//!
//! The objective is built on what is exact: areas of the theory and stability of orbits as roots, the
//! orbit's amplitude; simulation where no orbit attracts ([`task`], [`amplitude`]). It is looked for
//! everywhere between the bounds and then narrowed down ([`search`]), once as written and once expected
//! over what is uncertain ([`expected`]). Where simulation has a part in the objective, the best
//! candidates are simulated thoroughly before one is chosen ([`shortlist`]).

pub mod amplitude;
pub mod expected;
pub mod search;
pub mod task;

pub use search::{InTurn, Spread};
pub use task::{Bounds, Deviation, Task, TaskError, Variable};

pub mod chart;
pub mod claim;
pub mod confirm;
pub mod sensitivity;
pub mod shortlist;

use serde::Serialize;

use crate::case::{Case, Choice, Objective, RewriteError, Rewritten, Rounding};
use crate::simulation::StartError;
use search::{Effort, Seen};

/// Why a case cannot be optimised.
#[derive(Debug, thiserror::Error)]
pub enum OptimizeError {
    /// There is nothing to choose.
    #[error(transparent)]
    Task(#[from] TaskError),
    /// The chosen absorber cannot be written into the case.
    #[error(transparent)]
    Rewrite(#[from] RewriteError),
    /// A simulation cannot begin.
    #[error(transparent)]
    Start(#[from] StartError),
    /// The objective has a value nowhere between the bounds.
    #[error("the objective cannot be evaluated anywhere between the bounds")]
    Nowhere,
}

/// How thoroughly the objective is looked for.
const NOMINAL: Effort = Effort { pieces: 400, particles: 40, steps: 30, width: 1e-7 };
/// How thoroughly its expectation is, which costs as many evaluations as there are deviations.
const ROBUST: Effort = Effort { pieces: 80, particles: 16, steps: 12, width: 1e-4 };

/// An absorber, rounded as it is written, and what it achieves. Scores: the more the better.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Chosen {
    /// The absorber.
    pub choice: Choice,
    /// Its score.
    pub score: f64,
    /// Its expected score; none where nothing is uncertain.
    pub expected: Option<f64>,
    /// Its score as simulated from many starts, where simulation has a part in the objective.
    pub simulated: Option<f64>,
    /// Clearances that are as good, all else held, before rounding.
    pub plateau: [f64; 2],
}

impl Chosen {
    /// The score that counts: as simulated where it was.
    pub fn judged(&self) -> f64 {
        self.simulated.unwrap_or(self.score)
    }
}

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Optimization {
    /// What was looked for.
    pub task: Task,
    /// The best as written.
    pub nominal: Chosen,
    /// The best in expectation, where something is uncertain.
    pub robust: Option<Chosen>,
    /// The case's own absorber.
    pub own: Chosen,
    /// The case file with the best absorber, and with the robust one.
    pub written: Rewritten,
    /// See [`Optimization::written`].
    pub robust_written: Option<Rewritten>,
    /// The score over the clearance, with the best restitution and mass.
    pub landscape: Vec<(f64, f64)>,
    /// The expected score over the clearance; empty where nothing is uncertain.
    pub robust_landscape: Vec<(f64, f64)>,
    /// What a change of each parameter does at the best.
    pub sensitivities: Vec<sensitivity::Sensitivity>,
    /// The candidates that were simulated before one was chosen, in the order of the search; empty where
    /// simulation has no part in the objective.
    pub candidates: Vec<shortlist::Candidate>,
    /// What simulation says of the best.
    pub confirmed: Vec<confirm::Place>,
    /// The paper's claim on the case itself.
    pub claim: Option<claim::Claim>,
    /// The best clearance of one excitation alone.
    pub chart: Vec<chart::Suited>,
}

impl Optimization {
    /// Optimises a case, `text` being its file's.
    ///
    /// # Errors
    /// [`OptimizeError`] where there is nothing to choose, the text is not the case's, or the objective
    /// has no value.
    pub fn of(
        case: &Case,
        text: &str,
        task: &Task,
        spread: &dyn Spread,
    ) -> Result<Self, OptimizeError> {
        let search = Search::new(case, text, task, spread);
        let (found, scanned) = search.best(&NOMINAL, "objective", &|one| search.score(one), &[])?;
        let nominal = search.nominal(&found)?;
        let robust = search.robust(&nominal)?;
        let own = Choice::of(&case.design);
        let own = Chosen { choice: own, plateau: [own.clearance; 2], ..nominal.chosen };
        let choice = nominal.chosen.choice;
        let landscape = match task.bounds.len() {
            1 => scanned,
            _ => search.landscape(&choice),
        };
        let (robust, robust_written, robust_landscape) = match robust {
            Some((chosen, written, scanned)) => (Some(chosen), Some(written), scanned),
            None => (None, None, Vec::new()),
        };
        Ok(Self {
            own: search.measured(Chosen { score: search.score(&own.choice), ..own }, None)?,
            robust: robust.map(|chosen| search.measured(chosen, None)).transpose()?,
            nominal: search.measured(nominal.chosen, Some(&nominal.places))?,
            written: nominal.written,
            robust_written,
            landscape,
            robust_landscape,
            sensitivities: sensitivity::of(task, &choice),
            candidates: nominal.candidates.into_iter().map(|(one, _)| one).collect(),
            confirmed: nominal.places,
            claim: claim::Claim::of(&case.system()),
            chart: chart::chart(task, &choice, spread),
            task: task.clone(),
        })
    }

    /// Whether anything was reached: a share or margin above 0, an amplitude that is a number.
    pub fn reached(&self) -> bool {
        self.nominal.judged().is_finite() && self.nominal.judged() != 0.0
    }
}

type OfChoice<'f> = &'f (dyn Fn(&Choice) -> f64 + Sync);
type Landscape = Vec<(f64, f64)>;

/// What every part of the search needs.
struct Search<'a> {
    case: &'a Case,
    text: &'a str,
    task: &'a Task,
    spread: &'a dyn Spread,
    /// What is averaged over.
    deviations: Vec<(Deviation, f64)>,
}

impl<'a> Search<'a> {
    fn new(case: &'a Case, text: &'a str, task: &'a Task, spread: &'a dyn Spread) -> Self {
        Self { case, text, task, spread, deviations: task.deviations() }
    }

    fn score(&self, choice: &Choice) -> f64 {
        self.task.score(choice, &Deviation::default()).unwrap_or(f64::NEG_INFINITY)
    }

    fn expected(&self, choice: &Choice) -> f64 {
        let found = self.task.expected(choice, &self.deviations, self.spread);
        found.unwrap_or(f64::NEG_INFINITY)
    }

    /// The winner as written: the best of the search, or the best candidate as simulated.
    fn nominal(&self, found: &search::Best) -> Result<shortlist::Judged, OptimizeError> {
        let score = |choice: &Choice| self.score(choice);
        if self.task.objective == Objective::WorstAmplitude {
            return shortlist::judged(self.task, &found.seen, self.spread, &|parts| {
                self.rounded(parts, [parts[0]; 2], &score)
            });
        }
        let (chosen, written) = self.rounded(&found.parts, found.plateau, &score)?;
        let places = confirm::confirm(self.task, &chosen.choice)?;
        Ok(shortlist::Judged { chosen, written, places, candidates: Vec::new() })
    }

    /// The best in expectation with its landscape, looked for from the best as written; `None` where
    /// nothing is uncertain.
    fn robust(
        &self,
        nominal: &shortlist::Judged,
    ) -> Result<Option<(Chosen, Rewritten, Landscape)>, OptimizeError> {
        if !self.task.uncertainty.is_any() {
            return Ok(None);
        }
        if !nominal.candidates.is_empty() {
            return Ok(self.robust_candidate(&nominal.candidates));
        }
        let expected = |choice: &Choice| self.expected(choice);
        let known = [self.task.parts(&nominal.chosen.choice)];
        let (found, scanned) = self.best(&ROBUST, "expected objective", &expected, &known)?;
        let (chosen, written) = self.rounded(&found.parts, found.plateau, &expected)?;
        Ok(Some((Chosen { score: self.score(&chosen.choice), ..chosen }, written, scanned)))
    }

    /// Of candidates that were simulated the best in expectation, which counts as no better than what
    /// simulation finds as written; and their expectations over the clearance.
    fn robust_candidate(
        &self,
        candidates: &[(shortlist::Candidate, Rewritten)],
    ) -> Option<(Chosen, Rewritten, Landscape)> {
        let expected: Vec<f64> =
            candidates.iter().map(|(one, _)| self.expected(&one.choice)).collect();
        let judged = |k: usize| expected[k].min(candidates[k].0.simulated);
        let best =
            (0..candidates.len()).reduce(|a, b| if judged(b) > judged(a) { b } else { a })?;
        let (one, written) = &candidates[best];
        let chosen = Chosen {
            choice: one.choice,
            score: one.score,
            expected: None,
            simulated: Some(one.simulated),
            plateau: [one.choice.clearance; 2],
        };
        let mut landscape: Landscape =
            candidates.iter().map(|(one, _)| one.choice.clearance).zip(expected).collect();
        landscape.sort_by(|a, b| a.0.total_cmp(&b.0));
        Some((chosen, written.clone(), landscape))
    }

    /// With its expectation, and as simulated where that counts; `places` where it was simulated
    /// already.
    fn measured(
        &self,
        chosen: Chosen,
        places: Option<&[confirm::Place]>,
    ) -> Result<Chosen, OptimizeError> {
        let choice = chosen.choice;
        let expected = self.task.uncertainty.is_any().then(|| self.expected(&choice));
        let simulated = if self.task.objective != Objective::WorstAmplitude {
            None
        } else if let Some(places) = places {
            Some(shortlist::simulated(chosen.score, places))
        } else {
            Some(shortlist::simulated(chosen.score, &confirm::confirm(self.task, &choice)?))
        };
        Ok(Chosen { expected, simulated, ..chosen })
    }

    /// The best between the bounds, and the scan over the clearance that it began with.
    fn best(
        &self,
        effort: &Effort,
        what: &'static str,
        score: OfChoice,
        known: &[Vec<f64>],
    ) -> Result<(search::Best, Landscape), OptimizeError> {
        let task = self.task;
        let own = task.parts(&Choice::of(&task.design));
        let beside = known.first().unwrap_or(&own);
        let at = |part: f64| -> Vec<f64> {
            std::iter::once(part).chain(beside[1..].iter().copied()).collect()
        };
        let on_line = |part: f64| score(&task.choice(&at(part)));
        let scanned = search::scan(what, effort.pieces, self.spread, &on_line);
        let places =
            scanned.iter().map(|(part, score)| (task.bounds[0].at(*part), *score)).collect();
        let line = search::on_line(&scanned, effort.width, &on_line);
        let dimensions = task.bounds.len();
        if dimensions == 1 {
            return line.map(|best| (best, places)).ok_or(OptimizeError::Nowhere);
        }
        let mut known = known.to_vec();
        known.extend(line.map(|line| at(line.parts[0])));
        let asked = |parts: &[f64]| score(&task.choice(parts));
        let mut found =
            search::in_box(&known, dimensions, effort, &asked).ok_or(OptimizeError::Nowhere)?;
        let on_line = scanned.iter().map(|(part, score)| -> Seen { (at(*part), *score) });
        found.seen.extend(on_line);
        Ok((found, places))
    }

    /// The absorber as it is written: of the roundings that keep to the bounds, the best.
    fn rounded(
        &self,
        parts: &[f64],
        plateau: [f64; 2],
        score: OfChoice,
    ) -> Result<(Chosen, Rewritten), OptimizeError> {
        let task = self.task;
        let choice = task.choice(parts);
        let mut found: Option<(Chosen, Rewritten)> = None;
        let plateau = plateau.map(|part| task.bounds[0].at(part));
        for rounding in Rounding::ALL {
            let written =
                self.case.rewritten("the optimised case", self.text, &choice, rounding)?;
            let choice = Choice::of(&written.case.design);
            // Bounds closer together than four digits leave no rounding; the exact value is kept then.
            let last = rounding == Rounding::EXACT;
            if !(if last { found.is_none() } else { task.allows(&choice) }) {
                continue;
            }
            let score = score(&choice);
            if found.as_ref().is_none_or(|(known, _)| known.score < score) {
                let chosen = Chosen { choice, score, expected: None, simulated: None, plateau };
                found = Some((chosen, written));
            }
        }
        found.ok_or(OptimizeError::Nowhere)
    }

    /// The score over the clearance, all else held.
    fn landscape(&self, choice: &Choice) -> Landscape {
        let bounds = self.task.bounds[0];
        let at = |part: f64| Choice { clearance: bounds.at(part), ..*choice };
        let score = |part: f64| self.score(&at(part));
        let scanned = search::scan("landscape", NOMINAL.pieces, self.spread, &score);
        scanned.into_iter().map(|(part, score)| (bounds.at(part), score)).collect()
    }
}
