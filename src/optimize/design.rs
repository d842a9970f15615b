//! An absorber as `check` judges it: rounded as it is written, its case surveyed along the whole band, every
//! criterion held against it. What is shown of an optimisation is this and nothing else.

use super::OptimizeError;
use super::task::Task;
use crate::band::{Survey, Worst};
use crate::case::{self, Objective, Relation, Rewritten, Rounding};
use crate::criteria::contact::judge_in_contact;
use crate::criteria::{self, Judged};
use crate::executor::Executor;
use crate::measure::Measure;

/// A judged absorber. Lengths in the units of its design.
#[derive(Debug, Clone, PartialEq)]
pub struct JudgedDesign {
    /// The design with the absorber, rounded as it is written.
    pub choice: case::Design,
    /// Its case file.
    pub written: Rewritten,
    /// The objective: a share, a relative distance, or a length.
    pub value: f64,
    /// How far the value may be off; an amplitude may be larger by that.
    pub error: f64,
    /// The largest displacement over the band, where the band was simulated; over the clearance.
    pub worst: Option<Worst>,
    /// The criteria.
    pub criteria: Vec<Judged>,
    /// What is known along the band; lengths over the clearance.
    pub survey: Survey,
}

impl JudgedDesign {
    /// The score in the order of preference: the more the better, with its error.
    pub fn score(&self, objective: Objective) -> f64 {
        match objective {
            Objective::WorstAmplitude => -(self.value + self.error),
            _ => self.value,
        }
    }

    /// Whether every criterion holds.
    pub fn is_feasible(&self) -> bool {
        criteria::all_hold(&self.criteria)
    }

    /// By how much the criterion that is missed most is missed, over its limit; 0 where all hold.
    pub fn violation(&self) -> f64 {
        missed_by(&self.criteria)
    }

    /// Whether another is preferred: one whose criteria hold, then the higher score.
    pub fn is_worse_than(&self, other: &Self, objective: Objective) -> bool {
        match (self.is_feasible(), other.is_feasible()) {
            (true, false) => false,
            (false, true) => true,
            _ => self.score(objective) < other.score(objective),
        }
    }

    /// Whether another is better by more than nobody builds or measures: only then a case's own absorber is replaced.
    pub fn is_clearly_worse_than(&self, other: &Self, objective: Objective) -> bool {
        let [own, better] = [self, other].map(|one| one.score(objective));
        let clearly = match objective {
            Objective::WorstAmplitude => better > own + CLEARLY[0] * own.abs(),
            _ => better > own + CLEARLY[1],
        };
        let feasible = self.is_feasible() == other.is_feasible();
        self.is_worse_than(other, objective) && (clearly || !feasible)
    }

    /// Whether the worst motion is one that scatters.
    pub fn scatters(&self) -> bool {
        self.worst.as_ref().is_some_and(|worst| worst.motion.repeats_after().is_none())
    }
}

/// Relative improvement of an amplitude, and of a share or margin by itself, that is none.
const CLEARLY: [f64; 2] = [0.01, 1e-3];
/// By how much the criterion that is missed most is missed, over its limit; 0 where all hold.
pub fn missed_by(criteria: &[Judged]) -> f64 {
    criteria.iter().map(violation).fold(0.0, f64::max)
}

/// By how much a criterion is missed, over its limit; what could not be measured by all of it.
fn violation(judged: &Judged) -> f64 {
    let (Some(margin), Some(false)) = (judged.margin, judged.holds) else {
        return if judged.holds == Some(true) { 0.0 } else { 1.0 };
    };
    let missed = match judged.criterion.relation {
        Relation::Equal => margin.abs(),
        _ => judged.error - margin,
    };
    match judged.criterion.measure {
        Measure::NoCoexistence => 1.0,
        _ => missed / judged.criterion.scale(),
    }
}

/// Judges absorbers of one task.
pub struct Judge<'a> {
    /// What is optimised.
    pub task: &'a Task,
    /// The text of its case's file.
    pub text: &'a str,
}

impl Judge<'_> {
    /// The case's own absorber.
    ///
    /// # Errors
    /// As [`Judge::design`].
    pub fn own(&self, executor: &dyn Executor) -> Result<JudgedDesign, OptimizeError> {
        let written = Rewritten { text: self.text.to_owned(), case: self.task.case.clone() };
        self.judged(written, executor)
    }

    /// The absorber at parts of the way between the bounds.
    ///
    /// # Errors
    /// [`OptimizeError`] where it cannot be written into the case, or not be simulated.
    pub fn design(
        &self,
        parts: &[f64],
        executor: &dyn Executor,
    ) -> Result<JudgedDesign, OptimizeError> {
        self.judged(self.rounded(parts)?, executor)
    }

    /// What is written in a case.
    ///
    /// # Errors
    /// [`OptimizeError`] where it cannot be simulated.
    pub fn judged(
        &self,
        written: Rewritten,
        executor: &dyn Executor,
    ) -> Result<JudgedDesign, OptimizeError> {
        let case = &written.case;
        let amplitude = self.task.objective == Objective::WorstAmplitude;
        let mut settings = criteria::settings(case);
        if amplitude {
            settings.effort = Some(case.effort());
        }
        let survey = Survey::of(&case.range(), &settings, None, executor)?;
        let (choice, clearance) = (case.design, case.design.clearance());
        let worst = survey.worst().filter(|_| settings.effort.is_some());
        let (value, error) = match (amplitude, &worst) {
            (true, Some(worst)) => (worst.peak.value * clearance, worst.peak.error * clearance),
            (true, None) => (f64::INFINITY, 0.0),
            _ => (self.task.exact_score(survey.band()).unwrap_or(f64::NAN), 0.0),
        };
        Ok(JudgedDesign {
            choice,
            value,
            error,
            worst,
            criteria: judge_in_contact(case, &survey, case.effort(), |band, settings| {
                Survey::of(band, settings, None, executor)
            })?,
            survey,
            written,
        })
    }

    /// The absorber as it is written: of the roundings that keep to the bounds the best by an exact
    /// objective, otherwise the nearest.
    fn rounded(&self, parts: &[f64]) -> Result<Rewritten, OptimizeError> {
        let choice = self.task.choice(parts);
        let mut best: Option<(f64, Rewritten)> = None;
        for rounding in Rounding::ALL {
            let written =
                self.task.case.rewritten("the optimised case", self.text, &choice, rounding)?;
            let kept = self.task.allows(&written.case.design);
            // Bounds closer together than four digits leave no rounding; the exact value is kept then.
            let last = rounding == Rounding::Exact;
            if !(if last { best.is_none() } else { kept }) {
                continue;
            }
            let exact = self.task.exact_score(&written.case.range());
            let score = exact.unwrap_or(0.0);
            if best.as_ref().is_none_or(|(known, _)| *known < score) {
                best = Some((score, written));
            }
        }
        best.map(|(_, written)| written).ok_or(OptimizeError::Nowhere)
    }
}
