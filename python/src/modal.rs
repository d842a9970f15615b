//! A case of several modes or absorbers: read, and what the program's commands say of it.

use std::path::PathBuf;

use pyo3::prelude::*;
use vinesink::answer::Decided;
use vinesink::answer::several::{self, LeftOut};
use vinesink::case::ModalCase as Inner;
use vinesink::case_input::{self, AnyCase};
use vinesink::modal::{Beside, ModalAnswer, ModalOptimum, orbits, usual_periods};
use vinesink::report::modal::{analysis, checked, files, optimum, simulation};
use vinesink::report::render::Files;

use crate::case::{Case, reach};
use crate::decide;
use crate::errors::{not_read, refused, warned};
use crate::report;
use crate::simulate::of_several;
use crate::work::{self, Columns, WorkState, json};

/// A case as it was read.
#[pyclass(frozen, module = "vinesink._vinesink")]
pub struct ModalCase {
    inner: Inner,
    text: String,
    /// The stem of its file; empty for a case from a text.
    stem: String,
}

#[pymethods]
impl ModalCase {
    #[getter]
    fn title(&self) -> &str {
        &self.inner.title
    }

    #[getter]
    fn source(&self) -> &str {
        &self.inner.source
    }

    #[getter]
    fn text(&self) -> &str {
        &self.text
    }

    #[getter]
    fn stem(&self) -> &str {
        &self.stem
    }

    /// What is probably a slip in it, as the program says it of the text.
    fn warnings(&self) -> Vec<String> {
        let name = if self.stem.is_empty() { "text" } else { &self.stem };
        warned(name, &self.text, &self.inner.warnings)
    }

    #[getter]
    fn places(&self) -> Vec<String> {
        self.inner.places.clone()
    }

    /// As `vinesink analyze --format json`.
    fn analyze(&self, py: Python<'_>, progress: Option<Py<PyAny>>) -> PyResult<String> {
        work::done(py, progress, |work| {
            json(&analysis(&self.inner, &orbits(&self.inner, work).map_err(refused)?))
        })
    }

    /// As `vinesink simulate --format json`, and the impacts that `--impacts` writes, of so many excitation periods.
    fn simulate<'py>(
        &self,
        py: Python<'py>,
        periods: Option<u64>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(String, Columns<'py>)> {
        let periods = periods.unwrap_or_else(|| usual_periods(&self.inner));
        let (text, impacts) = work::done(py, progress, |work| {
            let answer = self.answer(work)?;
            answer.observe(work);
            let impacts = answer.impacts(&self.inner, periods).map_err(refused)?;
            Ok((json(&simulation(&self.stem, &self.inner, &answer))?, impacts))
        })?;
        Ok((text, of_several(py, &self.inner, &impacts)?))
    }

    /// As `vinesink check --format json` says it of this case.
    fn check(
        &self,
        py: Python<'_>,
        criteria_only: bool,
        long: bool,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<String> {
        if self.inner.criteria.is_empty() {
            return Err(refused("the case has no criteria: give it a table [criteria]"));
        }
        let told = if criteria_only { Decided::NOTHING } else { Decided::CHECKED };
        work::done(py, progress, |work| {
            let answer = self.decided(told, long, work)?;
            answer.observe(work);
            json(&checked(&self.stem, &self.stem, &self.inner, &answer).document)
        })
    }

    /// As `vinesink optimize --format json`, the text of the better case, and whether it is a success.
    fn optimize(
        &self,
        py: Python<'_>,
        objective: Option<&str>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(String, Option<String>, bool)> {
        let objective = objective.map(decide::objective_of_several).transpose()?;
        work::done(py, progress, |work| {
            let found =
                ModalOptimum::of(&self.inner, &self.text, objective, work).map_err(refused)?;
            let better = found.best.first().filter(|_| found.succeeds());
            let better = better.map(|best| best.text.clone());
            Ok((json(&optimum(&self.inner, &found))?, better, found.succeeds()))
        })
    }

    /// The columns of `vinesink sweep`, and their units.
    fn sweep<'py>(
        &self,
        py: Python<'py>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(Columns<'py>, Columns<'py>)> {
        let found = work::done(py, progress, |work| decide::swept_several(&self.inner, work))?;
        decide::lists(py, &found)
    }

    /// Writes the files of `vinesink report` into a folder.
    fn report(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        name: &str,
        long: bool,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<()> {
        let files = work::done(py, progress, |work| self.rendered(name, long, work))?;
        report::write(&folder, &files)
    }
}

impl ModalCase {
    fn answer(&self, work: &WorkState) -> PyResult<ModalAnswer> {
        ModalAnswer::of(&self.inner, work).map_err(refused)
    }

    /// The files of its report.
    pub fn rendered(&self, name: &str, long: bool, work: &WorkState) -> PyResult<Files> {
        let answer = self.decided(Decided::ALL, long, work)?;
        let beside = Beside::of(&self.inner, &answer, work).map_err(refused)?;
        files(name, &self.inner, &answer, &beside).map_err(refused)
    }

    /// The same with what is told beside its criteria, as far as that is ordinary work, or any is asked for.
    fn decided(&self, told: Decided, long: bool, work: &WorkState) -> PyResult<ModalAnswer> {
        let affords = |_: LeftOut, _: f64, is_ordinary: bool| long || is_ordinary;
        let answer = self.answer(work)?;
        several::decided(&self.inner, answer, told, &affords, work).map_err(refused)
    }
}

/// A case of either kind.
#[derive(FromPyObject)]
pub enum OfAny {
    /// Of one mode with one absorber.
    One(Py<Case>),
    /// Of several.
    Several(Py<ModalCase>),
}

impl OfAny {
    /// The files of the report that a comparison reads.
    fn files(&self, work: &WorkState) -> PyResult<Files> {
        match self {
            Self::One(case) => decide::of_one(&case.get().inner, work),
            Self::Several(case) => case.get().rendered(decide::COMPARED, false, work),
        }
    }
}

/// What changed from one case to another: the document of `vinesink diff`, and Markdown.
#[pyfunction]
pub fn compare(
    py: Python<'_>,
    old: OfAny,
    new: OfAny,
    progress: Option<Py<PyAny>>,
) -> PyResult<(String, String)> {
    work::done(py, progress, |work| decide::compared(&old.files(work)?, &new.files(work)?))
}

/// A case of either kind from its text; files that it names are below `folder`, unless they may be anywhere.
#[pyfunction]
pub fn parse(
    py: Python<'_>,
    name: &str,
    text: &str,
    folder: PathBuf,
    allow_outside: bool,
) -> PyResult<Py<PyAny>> {
    let case = case_input::parse_any(name, text, &folder, reach(allow_outside));
    let case = case.map_err(|error| not_read(py, &error))?;
    of_either(py, case, text.to_owned(), name.to_owned(), String::new())
}

/// The same from its file.
#[pyfunction]
pub fn read(py: Python<'_>, path: PathBuf, allow_outside: bool) -> PyResult<Py<PyAny>> {
    let read = case_input::read_any(&path, reach(allow_outside));
    let (case, text) = read.map_err(|error| not_read(py, &error))?;
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    of_either(py, case, text, path.display().to_string(), stem)
}

fn of_either(
    py: Python<'_>,
    case: AnyCase,
    text: String,
    name: String,
    stem: String,
) -> PyResult<Py<PyAny>> {
    Ok(match case {
        AnyCase::Several(inner) => Py::new(py, ModalCase { inner: *inner, text, stem })?.into_any(),
        AnyCase::One(inner) => Py::new(py, Case::of(*inner, text, name, stem))?.into_any(),
    })
}
