//! The report of a case, from what is known of it to its files.
//!
//! For the program itself: this module may change at any time.

use serde_json::Value;

use crate::answer::{Answer, Asked, Decided};
use crate::case::Case;
use crate::executor::Executor;
use crate::report::document::{self, Source};
use crate::report::figure::Figure;
use crate::report::render::{self, Files, RenderError};
use crate::report::{choice, equations, figures, template, transient};
use crate::study::fidelity::LayerPlan;
use crate::study::plots::Plot;
use crate::study::{CaseStudy, StudyError};

/// A report: what was found, as data and as figures.
#[derive(Debug, Clone)]
pub struct Report {
    /// What was found.
    pub answer: Answer,
    /// The figures with their words.
    pub figures: Vec<Figure>,
    /// `report.json`.
    pub document: Value,
}

/// Why there is no report of a case.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// The case cannot be studied.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// What was found cannot be written down.
    #[error(transparent)]
    Render(#[from] RenderError),
}

impl Report {
    /// Studies a case and draws its figures: by the layers that `plan` needs, or all of them; `decides` with what else could
    /// be done and how far criteria hold.
    ///
    /// # Errors
    /// [`ReportError`] where theory or simulation cannot be carried out.
    pub fn of(
        name: &str,
        case: &Case,
        plan: Option<&LayerPlan>,
        decides: Decided,
        executor: &dyn Executor,
    ) -> Result<Self, ReportError> {
        let answer = Answer::of(case, Asked::Report, plan, executor)?;
        let answer = answer.decided(case, decides, executor)?;
        if let Some(study) = &answer.transient {
            let (mut document, mut figures) = transient::drawn(name, case, study, &answer.judged)?;
            decide(&mut document, &mut figures, case, &answer)?;
            return Ok(Self { answer, figures, document });
        }
        let mut figures = drawn(case, answer.studied()?, executor)?;
        let mut document = document::document(&Source {
            name,
            case,
            study: answer.studied()?,
            judged: &answer.judged,
            answers: answer.answers.as_ref(),
            figures: &figures,
        });
        decide(&mut document, &mut figures, case, &answer)?;
        Ok(Self { answer, figures, document })
    }

    /// The files of its folder.
    ///
    /// # Errors
    /// [`ReportError`] says which part cannot be rendered.
    pub fn files(&self, case: &Case, on: &dyn Executor) -> Result<Files, ReportError> {
        if let Some(study) = &self.answer.transient {
            return Ok(transient::files(case, study, &self.document, &self.figures)?);
        }
        let equations = equations::groups(case, self.answer.studied()?);
        let units = case.units();
        let files = render::files(
            "steady.md",
            &self.document,
            Some(&equations),
            &units,
            &self.figures,
            on,
        )?;
        Ok(render::with_document(files, &self.document))
    }
}

/// Gives a document what decides, with its figure.
fn decide(
    document: &mut Value,
    figures: &mut Vec<Figure>,
    case: &Case,
    answer: &Answer,
) -> Result<(), ReportError> {
    document::decide(document, case, answer);
    let drawn = answer.alternatives.as_ref().map(|found| {
        let ranges = &answer.holds_for;
        [
            choice::figure(case.units(), found, document),
            choice::over_amplitude(case, found, ranges, document),
        ]
    });
    let panel = choice::combined_of(case, &answer.combined, &answer.holds_for);
    let combined = choice::combined(panel.into_iter().collect(), document);
    let drawn = drawn.into_iter().flatten().chain([combined]).flatten().collect();
    for figure in template::worded(drawn, &case.units())? {
        let row = document::figure_row(&figure);
        document["figures"].as_array_mut().into_iter().for_each(|rows| rows.push(row.clone()));
        figures.push(figure);
    }
    Ok(())
}

/// All figures of a report, with their words.
///
/// # Errors
/// [`ReportError`] where theory or simulation cannot be carried out.
pub fn drawn(
    case: &Case,
    study: &CaseStudy,
    on: &dyn Executor,
) -> Result<Vec<Figure>, ReportError> {
    let plots = Plot::all(case, study, on)?;
    Ok(template::worded(figures::all(case, study, &plots), &case.units())?)
}
