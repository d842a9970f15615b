//! The absorber that serves a case best: clearance, and on request restitution and mass.
//!
//! The objective is built on what is exact: areas of the theory and stability of orbits as roots, the
//! orbit's amplitude; simulation where no orbit attracts ([`task`], [`amplitude`]). It is looked for
//! everywhere between the bounds and then narrowed down ([`search`]), once as written and once expected
//! over what is uncertain ([`expected`]).

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

use serde::Serialize;

use crate::case::{Case, Choice, RewriteError, Rewritten, Rounding};
use crate::simulation::StartError;
use search::Effort;

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
const NOMINAL: Effort = Effort { pieces: 400, particles: 40, steps: 30 };
/// How thoroughly its expectation is, which costs as many evaluations as there are deviations.
const ROBUST: Effort = Effort { pieces: 80, particles: 16, steps: 12 };

/// An absorber, rounded as it is written, and what it achieves. Scores: the more the better.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Chosen {
    /// The absorber.
    pub choice: Choice,
    /// Its score.
    pub score: f64,
    /// Its expected score; none where nothing is uncertain.
    pub expected: Option<f64>,
    /// Clearances that are as good, all else held, before rounding.
    pub plateau: [f64; 2],
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
        let nothing = Deviation::default();
        let score = |choice: &Choice| task.score(choice, &nothing).unwrap_or(f64::NEG_INFINITY);
        let expected = |choice: &Choice| task.expected(choice).unwrap_or(f64::NEG_INFINITY);
        let (parts, scanned) = best(task, &NOMINAL, "objective", spread, &score, &[])?;
        let (nominal, written) = rounded(case, text, task, &parts, &score)?;
        let uncertain = task.uncertainty.is_any();
        let mut robust = None;
        let mut robust_landscape = Vec::new();
        if uncertain {
            let known = [parts.parts.clone()];
            let (parts, scanned) =
                best(task, &ROBUST, "expected objective", spread, &expected, &known)?;
            robust = Some(rounded(case, text, task, &parts, &expected)?);
            robust_landscape = scanned;
        }
        let with_expectation = |choice: Choice, plateau: [f64; 2]| Chosen {
            choice,
            score: score(&choice),
            expected: uncertain.then(|| expected(&choice)),
            plateau,
        };
        let nominal = with_expectation(nominal.choice, nominal.plateau);
        let own = Choice::of(&case.design);
        let landscape = match task.bounds.len() {
            1 => scanned,
            _ => landscape(task, &nominal.choice, spread, &score),
        };
        let (robust, robust_written) = match robust {
            Some((chosen, written)) => {
                (Some(with_expectation(chosen.choice, chosen.plateau)), Some(written))
            }
            None => (None, None),
        };
        Ok(Self {
            nominal,
            robust,
            own: with_expectation(own, [own.clearance; 2]),
            written,
            robust_written,
            landscape,
            robust_landscape,
            sensitivities: sensitivity::of(task, &nominal.choice),
            confirmed: confirm::confirm(task, &nominal.choice)?,
            claim: claim::Claim::of(&case.system()),
            chart: chart::chart(task, &nominal.choice, spread),
            task: task.clone(),
        })
    }

    /// Whether anything was reached: a share or margin above 0, an amplitude that is a number.
    pub fn reached(&self) -> bool {
        self.nominal.score.is_finite() && self.nominal.score != 0.0
    }
}

type OfChoice<'f> = &'f (dyn Fn(&Choice) -> f64 + Sync);

/// The best between the bounds, and the scan over the clearance that it began with.
fn best(
    task: &Task,
    effort: &Effort,
    what: &'static str,
    spread: &dyn Spread,
    score: OfChoice,
    known: &[Vec<f64>],
) -> Result<(search::Best, Vec<(f64, f64)>), OptimizeError> {
    let own = task.parts(&Choice::of(&task.design));
    let on_line = |part: f64| {
        let mut parts = known.first().unwrap_or(&own).clone();
        parts[0] = part;
        score(&task.choice(&parts))
    };
    let scanned = search::scan(what, effort.pieces, spread, &on_line);
    let places = scanned.iter().map(|(part, score)| (task.bounds[0].at(*part), *score)).collect();
    let line = search::on_line(&scanned, &on_line);
    let dimensions = task.bounds.len();
    let found = if dimensions == 1 {
        line
    } else {
        let mut known = known.to_vec();
        if let Some(line) = line {
            known.push(std::iter::once(line.parts[0]).chain(own[1..].iter().copied()).collect());
        }
        let asked = |parts: &[f64]| score(&task.choice(parts));
        search::in_box(&known, dimensions, effort, &asked)
    };
    found.map(|best| (best, places)).ok_or(OptimizeError::Nowhere)
}

/// The absorber as it is written: of the roundings that keep to the bounds, the best.
fn rounded(
    case: &Case,
    text: &str,
    task: &Task,
    best: &search::Best,
    score: OfChoice,
) -> Result<(Chosen, Rewritten), OptimizeError> {
    let choice = task.choice(&best.parts);
    let mut found: Option<(Chosen, Rewritten)> = None;
    let plateau = best.plateau.map(|part| task.bounds[0].at(part));
    for rounding in Rounding::ALL {
        let written = case.rewritten("the optimised case", text, &choice, rounding)?;
        let choice = Choice::of(&written.case.design);
        let better = |known: &(Chosen, Rewritten)| known.0.score < score(&choice);
        // Bounds closer together than four digits leave no rounding; the exact value is kept then.
        let last = rounding == Rounding::EXACT;
        let kept = if last { found.is_none() } else { task.allows(&choice) };
        if kept && found.as_ref().is_none_or(better) {
            let chosen = Chosen { choice, score: score(&choice), expected: None, plateau };
            found = Some((chosen, written));
        }
    }
    found.ok_or(OptimizeError::Nowhere)
}

/// The score over the clearance, all else held.
fn landscape(
    task: &Task,
    choice: &Choice,
    spread: &dyn Spread,
    score: OfChoice,
) -> Vec<(f64, f64)> {
    let bounds = task.bounds[0];
    let at = |part: f64| Choice { clearance: bounds.at(part), ..*choice };
    let scanned = search::scan("landscape", NOMINAL.pieces, spread, &|part| score(&at(part)));
    scanned.into_iter().map(|(part, score)| (bounds.at(part), score)).collect()
}
