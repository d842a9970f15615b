//! The files of a report, put together as by the program's `report`.

use std::path::Path;

use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use vinesink::band::{Survey, SurveySettings};
use vinesink::case::{Case, ExtraFigure};
use vinesink::criteria;
use vinesink::report::document::{self, Source};
use vinesink::report::render::{self, Files};
use vinesink::report::{equations, figures, template, transient as page};
use vinesink::store;
use vinesink::study::fidelity::Plan;
use vinesink::study::plots::Plot;
use vinesink::study::{CaseStudy, StudyEffort};
use vinesink::transient::Study;

use crate::case::plan;
use crate::work::{Work, refused};

/// A report that is not yet written.
pub struct Report {
    files: Files,
    /// Whether its simulations are to be trusted, and what was asked of accuracy holds.
    holds: bool,
}

impl Report {
    /// Writes it, in place of an older one.
    pub fn into(self, folder: &Path) -> PyResult<bool> {
        let written = store::replace_folder(folder, &self.files, render::is_of_report);
        written.map_err(|error| PyOSError::new_err(error.to_string()))?;
        Ok(self.holds)
    }
}

pub fn rendered(case: &Case, name: &str, work: &Work) -> PyResult<Report> {
    if let Some(study) = Study::of_case(case, work).transpose().map_err(refused)? {
        let judged = criteria::judge_transient(case, &study);
        let files = page::files(name, case, &study, &judged).map_err(refused)?;
        return Ok(Report { files, holds: true });
    }
    let effort = StudyEffort::of(&case.simulation);
    let plan = plan(case)?;
    let simulates = plan.as_ref().is_none_or(Plan::needs_simulation);
    let mut study = if simulates {
        work.expect(CaseStudy::steps(&effort));
        CaseStudy::of(&case.system(), effort, &mut |done| work.advance(done)).map_err(refused)?
    } else {
        CaseStudy::without_simulation(&case.system(), effort).map_err(refused)?
    };
    if simulates && case.report.figures.contains(&ExtraFigure::Dissipation) {
        study = study.with_averages().map_err(refused)?;
    }
    if simulates && case.report.deviations {
        study = study.with_deviations(case).map_err(refused)?;
    }
    let survey = |settings: &SurveySettings| {
        Survey::of(&criteria::range(case), settings, work).map_err(refused)
    };
    if case.band.is_some() {
        let mut settings = criteria::settings(case);
        settings.sampling = simulates.then(|| criteria::sampling(case));
        let survey = survey(&settings)?;
        study = study.along(survey.with_detuned(&settings, work).map_err(refused)?);
    }
    let answers =
        plan.map(|plan| plan.answers(study.simulated_motions())).transpose().map_err(refused)?;
    let judged = match &study.band {
        _ if case.criteria.is_empty() => Vec::new(),
        Some(survey) if simulates || !criteria::needs_simulation(&case.criteria) => {
            criteria::judge(case, survey)
        }
        _ => criteria::judge(case, &survey(&criteria::settings(case))?),
    };
    work.goes_on();
    let units = document::units(case);
    let plots = Plot::all(case, &study).map_err(refused)?;
    let drawn = template::worded(figures::all(case, &study, &plots), &units).map_err(refused)?;
    let source = Source {
        name,
        case,
        study: &study,
        judged: &judged,
        answers: answers.as_ref(),
        figures: &drawn,
    };
    let document = document::document(&source);
    let files = render::files(&document, &equations::groups(case, &study), &units, &drawn)
        .map_err(refused)?;
    let trusted = study.simulated_motions().is_none_or(|motions| {
        motions.attractors.iter().all(|found| found.attractor.doubts().is_empty())
    });
    Ok(Report { files, holds: trusted && answers.is_none_or(|answers| answers.enough()) })
}
