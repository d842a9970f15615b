//! The absorber that serves a case best, with what `vinesink optimize` says of it: for the program and for Python.

use serde_json::Value;

use crate::answer::Decided;
use crate::case::{Case, Objective, RewriteError, Rewritten, Rounding};
use crate::case_report::{Report, ReportError};
use crate::criteria;
use crate::excitation::Scene;
use crate::executor::Executor;
use crate::flights::DrivenError;
use crate::measure::Measure;
use crate::operating_range::edges;
use crate::optimize::{Optimization, OptimizeError, Task};
use crate::report::{optimize as page, transient as clearance};
use crate::transient::best_clearance;

/// What was found.
#[derive(Debug, Clone)]
pub struct Optimum {
    /// `vinesink/optimization@4`.
    pub document: Value,
    /// The case with it, where it is better than the case's own and meets all criteria; its comments fit.
    pub better: Option<Rewritten>,
    /// Whether there is one that is better and meets all criteria.
    pub succeeds: bool,
    /// The search, of a case that is driven steadily.
    pub search: Option<Optimization>,
}

/// Why there is no optimum.
#[derive(Debug, thiserror::Error)]
pub enum OptimumError {
    /// There is nothing to choose, or the search.
    #[error(transparent)]
    Search(#[from] OptimizeError),
    /// The case with what was found.
    #[error(transparent)]
    Rewrite(#[from] RewriteError),
    /// What is said of it.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// What is beside it.
    #[error(transparent)]
    Edges(#[from] DrivenError),
}

impl Optimum {
    /// That of a case, whose text `text` is; `objective` instead of what the case says, where it is driven steadily.
    ///
    /// # Errors
    /// [`OptimumError`] where there is nothing to choose, or a motion cannot be followed.
    pub fn of(
        name: &str,
        case: &Case,
        text: &str,
        objective: Option<Objective>,
        on: &dyn Executor,
    ) -> Result<Self, OptimumError> {
        match case.design.scene() {
            Scene::Steady => Self::of_search(&Task::of(case, objective)?, text, on),
            scene => Self::clearance(name, case, text, scene, on),
        }
    }

    fn of_search(task: &Task, text: &str, on: &dyn Executor) -> Result<Self, OptimumError> {
        let found = Optimization::of(task, text, on)?;
        let best = found.best.written.clone();
        let better = found.succeeds().then(|| best.with_fitting_comments(&task.case));
        Ok(Self {
            document: page::document(&task.case, &found),
            better: better.transpose()?,
            succeeds: found.succeeds(),
            search: Some(found),
        })
    }

    /// Of a structure that is not driven steadily the clearance.
    fn clearance(
        name: &str,
        case: &Case,
        text: &str,
        scene: Scene,
        on: &dyn Executor,
    ) -> Result<Self, OptimumError> {
        let Some(best) = best_clearance(case, on) else {
            return Err(OptimizeError::Nowhere.into());
        };
        // A larger one might leave the absorber of a released structure where no wall reaches it; and in a sweep, or under a
        // record, the absorber is lost above the best, where the displacement rises to that of the structure alone.
        let written = case.rewritten(name, text, &best.design, Rounding::Down)?;
        let report = Report::of(name, &written.case, None, Decided::NOTHING, on)?;
        let watched = if scene == Scene::Release { Measure::DecayTime } else { Measure::Peak };
        let beside = edges(&written.case, Some(watched), &written.case.effort(), on)?;
        let document = clearance::optimum(case, &best, &report.document, &beside);
        let found = document["answer"] == "found";
        let better = found.then(|| written.with_fitting_comments(case)).transpose()?;
        let succeeds = found && criteria::all_hold(&report.answer.judged);
        Ok(Self { document, better, succeeds, search: None })
    }
}
