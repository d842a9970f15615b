//! A case: read, and what the program's commands say of it.

use std::path::PathBuf;

use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use vinesink::answer::{Answer, Asked};
use vinesink::case;
use vinesink::excitation::Scene;
use vinesink::motions::Effort;
use vinesink::report::console::Analysed;
use vinesink::report::document::Content;
use vinesink::report::transient as page;
use vinesink::store::Reach;
use vinesink::study::fidelity::LayerPlan;
use vinesink::system::{Parameter, State};

use crate::errors::{refused, warned};
use crate::simulate::{self, Impacts, Wanted};
use crate::work::{self, Columns, WorkState, json};
use crate::{branch, decide, report};

/// A case as it was read.
#[pyclass(frozen, module = "vinesink._vinesink")]
pub struct Case {
    pub inner: case::Case,
    text: String,
    /// As messages say it, and the stem of its file.
    name: String,
    stem: String,
}

impl Case {
    /// A case that was read from its text, or the file of a name.
    pub fn of(inner: vinesink::case::Case, text: String, name: String, stem: String) -> Self {
        Self { inner, text, name, stem }
    }
}

#[pymethods]
impl Case {
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

    /// The stem of its file; empty for a case from a text.
    #[getter]
    fn stem(&self) -> &str {
        &self.stem
    }

    /// Whether it is driven steadily.
    #[getter]
    fn steady(&self) -> bool {
        self.inner.design.scene() == Scene::Steady
    }

    /// What is probably a slip in it, as the program says it of the text.
    fn warnings(&self) -> Vec<String> {
        warned(&self.name, &self.text, self.inner.warnings())
    }

    /// Clearance, natural frequency and mass, which turn dimensionless numbers into the case's units.
    fn scales<'py>(&self, py: Python<'py>) -> PyResult<Columns<'py>> {
        let scales = self.inner.units();
        let dict = PyDict::new(py);
        dict.set_item("physical", scales.physical)?;
        dict.set_item("length", scales.length(1.0))?;
        dict.set_item("time", scales.time(1.0))?;
        dict.set_item("velocity", scales.velocity(1.0))?;
        dict.set_item("energy", scales.energy(1.0))?;
        dict.set_item("frequency", scales.frequency(1.0))?;
        dict.set_item("period", scales.time(self.inner.system().period()))?;
        Ok(dict)
    }

    /// As `vinesink analyze --format json`.
    fn analyze(&self, py: Python<'_>, progress: Option<Py<PyAny>>) -> PyResult<String> {
        work::done(py, progress, |work| json(&self.analysed(work)?))
    }

    /// All exact orbits with two impacts per period: the document of each, and its sequence of walls.
    fn orbits(&self, py: Python<'_>) -> PyResult<String> {
        self.needs_steady("a list of orbits is")?;
        work::done(py, None, |_| json(&branch::orbits(&self.inner)))
    }

    /// As `vinesink simulate --format json`; the impacts of the measured window and its start.
    fn simulate<'py>(
        &self,
        py: Python<'py>,
        periods: Option<u64>,
        discard: Option<u64>,
        initial: Option<[f64; 4]>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(String, Columns<'py>, [f64; 4])> {
        if !self.steady() {
            let text = work::done(py, progress, |work| {
                let answer = Answer::of(&self.inner, Asked::Motions, None, work);
                json(&self.unsteady(&answer.map_err(refused)?, Content::Simulation))
            })?;
            return Ok((text, PyDict::new(py), [f64::NAN; 4]));
        }
        let wanted = self.wanted(periods, discard, initial);
        let (text, impacts, start) = work::done(py, progress, |work| {
            let (document, impacts, start) = simulate::measured(&self.inner, &wanted, work)?;
            Ok((json(&document)?, Impacts::of(&impacts), start))
        })?;
        Ok((text, impacts.columns(py)?, simulate::numbers(start)))
    }

    /// The impacts of one trajectory, without measuring it.
    fn fly<'py>(
        &self,
        py: Python<'py>,
        periods: Option<u64>,
        discard: Option<u64>,
        initial: [f64; 4],
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Columns<'py>> {
        self.needs_steady("a list of impacts is")?;
        let wanted = self.wanted(periods, discard, Some(initial));
        work::done(py, progress, |work| simulate::flown(&self.inner, &wanted, work))?.columns(py)
    }

    /// The states of a trajectory at times in excitation periods, ascending from 0: a row of four each.
    fn trajectory<'py>(
        &self,
        py: Python<'py>,
        initial: [f64; 4],
        times: Vec<f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.needs_steady("a trajectory is")?;
        let start = simulate::state(initial);
        let found =
            work::done(py, None, |work| simulate::sampled(&self.inner, start, times, work))?;
        Ok(found.into_pyarray(py))
    }

    /// Writes the files of `vinesink report` into a folder; whether what was asked for holds.
    fn report(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        name: &str,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<bool> {
        let render = |work: &WorkState| report::rendered(&self.inner, name, work);
        let (files, holds) = work::done(py, progress, render)?;
        report::write(&folder, &files)?;
        Ok(holds)
    }

    /// As `vinesink check --format json` says it of this case.
    fn check(
        &self,
        py: Python<'_>,
        criteria_only: bool,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<String> {
        let check =
            |work: &WorkState| decide::checked(&self.inner, &self.stem, criteria_only, work);
        work::done(py, progress, check)
    }

    /// As `vinesink optimize --format json`, the text of the better case, and whether it is a success.
    fn optimize(
        &self,
        py: Python<'_>,
        objective: Option<&str>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(String, Option<String>, bool)> {
        let optimum = |work: &WorkState| decide::optimum(&self.inner, &self.text, objective, work);
        work::done(py, progress, optimum)
    }

    /// The columns of `vinesink sweep`, and their units.
    fn sweep<'py>(
        &self,
        py: Python<'py>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(Columns<'py>, Columns<'py>)> {
        let found = work::done(py, progress, |work| decide::swept(&self.inner, work))?;
        decide::lists(py, &found)
    }

    /// The tables of its text, as JSON.
    fn document(&self) -> PyResult<String> {
        let text = self.text.strip_prefix('\u{feff}').unwrap_or(&self.text);
        let read: serde_json::Value = toml::from_str(text).map_err(refused)?;
        json(&read)
    }

    /// A number of the case by its name, in SI or the units of a reduced case; none of what it has not.
    fn value(&self, name: &str) -> Option<f64> {
        self.inner.design.value(Parameter::of_name(name)?)
    }

    /// The unit in which numbers of this name are, "1" for a plain number.
    fn unit(&self, name: &str) -> PyResult<&'static str> {
        let known = Parameter::of_name(name);
        let known = known.ok_or_else(|| refused(format!("there is no `{name}` to vary")))?;
        Ok(self.inner.design.unit(known))
    }

    /// A branch of exact orbits: its points as columns, bifurcations and ends as JSON.
    fn branch<'py>(
        &self,
        py: Python<'py>,
        parameter: &str,
        range: [f64; 2],
        orbit: Option<usize>,
        most_points: usize,
    ) -> PyResult<(Columns<'py>, String)> {
        self.needs_steady("a branch is")?;
        let followed = || branch::followed(&self.inner, parameter, range, orbit, most_points);
        let found = work::done(py, None, |_| followed())?;
        Ok((found.columns(py)?, json(&found.told)?))
    }
}

impl Case {
    pub fn needs_steady(&self, what: &str) -> PyResult<()> {
        match self.inner.design.scene() {
            Scene::Steady => Ok(()),
            other => Err(refused(format!(
                "its structure is {}, and {what} about one that is driven steadily",
                other.words()
            ))),
        }
    }

    fn wanted(
        &self,
        periods: Option<u64>,
        discard: Option<u64>,
        initial: Option<[f64; 4]>,
    ) -> Wanted {
        let asked = self.inner.effort();
        let (periods, discard) = (periods.unwrap_or(asked.periods), discard.or(asked.discard));
        Wanted { effort: Effort { periods, discard, ..asked }, start: initial.map(simulate::state) }
    }

    /// What becomes of a structure that is not driven steadily; none of another.
    fn unsteady(&self, answer: &Answer, content: Content) -> Option<serde_json::Value> {
        let study = answer.transient.as_ref()?;
        Some(page::document(&self.stem, &self.inner, study, &[], content))
    }

    fn analysed(&self, work: &WorkState) -> PyResult<serde_json::Value> {
        let case = &self.inner;
        let plan = LayerPlan::of_case(case, None).map_err(refused)?;
        let answer = Answer::of(case, Asked::Analysis, plan.as_ref(), work).map_err(refused)?;
        if let Some(document) = self.unsteady(&answer, Content::Analysis) {
            return Ok(document);
        }
        let none = || refused("the case was not analysed");
        Ok(Analysed::of(case, &answer).ok_or_else(none)?.document())
    }
}

/// A state that is given as four numbers.
pub fn states(initial: &[[f64; 4]]) -> Vec<State> {
    initial.iter().copied().map(simulate::state).collect()
}

pub fn reach(allow_outside: bool) -> Reach {
    if allow_outside { Reach::Anywhere } else { Reach::Folder }
}

/// The JSON Schema of a case file.
#[pyfunction]
pub fn schema() -> String {
    vinesink::case::schema().to_string()
}
