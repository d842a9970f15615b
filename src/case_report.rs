//! The report of a case under steady excitation, from its study to its files.
//!
//! For the program itself: this module may change at any time.

use serde_json::Value;

use crate::band::{Survey, SurveySettings};
use crate::case::{Case, ExtraFigure};
use crate::criteria::{self, Judged};
use crate::executor::Executor;
use crate::report::document::{self, Source};
use crate::report::figure::Figure;
use crate::report::render::{self, Files, RenderError};
use crate::report::{equations, figures, template};
use crate::study::fidelity::{Answers, Plan};
use crate::study::plots::Plot;
use crate::study::{CaseStudy, StudyEffort, StudyError};

/// A report: what was found, as data and as figures.
#[derive(Debug, Clone)]
pub struct Report {
    /// What was found.
    pub study: CaseStudy,
    /// The criteria; empty where the case has none.
    pub judged: Vec<Judged>,
    /// Which layer answers, where accuracy was asked for.
    pub answers: Option<Answers>,
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
    /// Studies a case and draws its figures: by the layers that `plan` needs, or all of them. `progress` is told
    /// how much of [`CaseStudy::steps`] was done.
    ///
    /// # Errors
    /// [`ReportError`] where theory or simulation cannot be carried out.
    pub fn of(
        name: &str,
        case: &Case,
        plan: Option<&Plan>,
        executor: &dyn Executor,
        progress: &mut dyn FnMut(u64),
    ) -> Result<Self, ReportError> {
        let simulates = plan.is_none_or(Plan::needs_simulation);
        let study = studied(case, simulates, executor, progress)?;
        let answers = plan.map(|plan| plan.answers(study.simulated_motions())).transpose()?;
        let judged = match &study.band {
            _ if case.criteria.is_empty() => Vec::new(),
            Some(survey) if simulates || !criteria::needs_simulation(&case.criteria) => {
                criteria::judge(case, survey)
            }
            _ => criteria::judge(case, &survey(case, &criteria::settings(case), executor)?),
        };
        let figures = drawn(case, &study)?;
        let document = document::document(&Source {
            name,
            case,
            study: &study,
            judged: &judged,
            answers: answers.as_ref(),
            figures: &figures,
        });
        Ok(Self { study, judged, answers, figures, document })
    }

    /// The files of its folder.
    ///
    /// # Errors
    /// [`RenderError`] says which part cannot be rendered.
    pub fn files(&self, case: &Case) -> Result<Files, RenderError> {
        let equations = equations::groups(case, &self.study);
        render::files(&self.document, &equations, &document::units(case), &self.figures)
    }

    /// Whether every simulation in it is to be trusted; its notes say why not.
    pub fn trusted(&self) -> bool {
        self.study.simulated_motions().is_none_or(|motions| {
            motions.attractors.iter().all(|found| found.attractor.doubts().is_empty())
        })
    }

    /// Whether it is as exact as the case asks for.
    pub fn exact_enough(&self) -> bool {
        self.answers.as_ref().is_none_or(Answers::enough)
    }
}

/// All figures of a report, with their words.
///
/// # Errors
/// [`ReportError`] where theory or simulation cannot be carried out.
pub fn drawn(case: &Case, study: &CaseStudy) -> Result<Vec<Figure>, ReportError> {
    let plots = Plot::all(case, study)?;
    Ok(template::worded(figures::all(case, study, &plots), &document::units(case))?)
}

fn studied(
    case: &Case,
    simulates: bool,
    executor: &dyn Executor,
    progress: &mut dyn FnMut(u64),
) -> Result<CaseStudy, StudyError> {
    let (system, effort) = (case.system(), StudyEffort::of(&case.simulation));
    if !simulates {
        return along_band(CaseStudy::without_simulation(&system, effort)?, case, false, executor);
    }
    let mut study = CaseStudy::of(&system, effort, progress)?;
    if case.report.figures.contains(&ExtraFigure::Dissipation) {
        study = study.with_averages()?;
    }
    if case.report.deviations {
        study = study.with_deviations(case)?;
    }
    along_band(study, case, true, executor)
}

/// The study with what is known along the case's band; simulated if the study is, and also with the structure
/// detuned.
fn along_band(
    study: CaseStudy,
    case: &Case,
    simulates: bool,
    executor: &dyn Executor,
) -> Result<CaseStudy, StudyError> {
    if case.band.is_none() {
        return Ok(study);
    }
    let mut settings = criteria::settings(case);
    settings.sampling = simulates.then(|| criteria::sampling(case));
    let survey = survey(case, &settings, executor)?.with_detuned(&settings, executor)?;
    Ok(study.along(survey))
}

/// The same survey as that of `check`.
fn survey(
    case: &Case,
    settings: &SurveySettings,
    executor: &dyn Executor,
) -> Result<Survey, StudyError> {
    Ok(Survey::of(&criteria::range(case), settings, executor)?)
}
