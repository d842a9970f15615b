//! Absorbers that serve a structure best under all of its loads: their clearances, and on request restitution, places and how
//! they share their mass.
//!
//! Evenly spread candidates, then some around the best, are flown from few starts at few frequencies, those first at which the
//! case's own absorbers are worst; one that is seen to be worse than the best of a round before is left. Where exact orbits decide what
//! is looked for they score instead. Of the best, what they do is found as `check` finds it; where numbers are uncertain, which of them
//! is best on average.

mod aim;
mod candidate;
mod judged;
mod robust;
mod screening;

use super::ModalError;
use crate::case::{ModalCase, Objective};
use crate::executor::Executor;
use crate::optimize::search::{shortlist, spread_out};
use candidate::{candidate, numbers};
use robust::deviations;
use screening::Screening;

pub use aim::Aim;
pub use candidate::clearance_bounds;
pub use judged::JudgedAbsorbers;
pub use robust::RobustAbsorbers;

/// Candidates of the first round for each number that is chosen, and most of them.
const CANDIDATES: usize = 24;
const MOST_CANDIDATES: usize = 96;
/// Candidates that are judged in full, and how far they are apart, over the bounds.
const JUDGED: usize = 3;
const APART: f64 = 0.04;
/// Candidates of which the limits on motions are looked at where exact orbits score them.
const BY_ORBITS: usize = 12;

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
        let others: Vec<&JudgedAbsorbers> = found.best.iter().chain([&found.own]).collect();
        if found.reached() {
            found.robust = RobustAbsorbers::of(found.nearest(), &others, aim, on)?;
        }
        Ok(found)
    }
}

/// How often one `check` of the case a search of its absorbers takes, at most.
pub fn checks(case: &ModalCase) -> f64 {
    let (first, few) = ((CANDIDATES * numbers(case)).min(MOST_CANDIDATES), 0.2);
    let (average, corners) = deviations(case);
    let under = (average.len() + corners.len()) * (JUDGED + 1);
    (first + under) as f64 * few + (JUDGED + 1) as f64
}
