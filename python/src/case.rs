//! A case, of one mode with one absorber or of several: read, and what the program's commands say of it.

use std::path::PathBuf;

use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use vinesink::case;
use vinesink::case_input::{self, AnyCase};
use vinesink::excitation::Scene;
use vinesink::store::Reach;
use vinesink::system::Parameter;

use crate::errors::{not_read, refused, warned};
use crate::simulate::{self, Told, Wanted};
use crate::work::{self, Columns, WorkState, json};
use crate::{analyze, branch, decide, report};

/// A case as it was read.
#[pyclass(frozen, module = "vinesink._vinesink")]
pub struct Case {
    pub inner: AnyCase,
    text: String,
    /// As messages say it, and the stem of its file.
    name: String,
    stem: String,
}

#[pymethods]
impl Case {
    #[getter]
    fn title(&self) -> &str {
        match &self.inner {
            AnyCase::One(case) => &case.title,
            AnyCase::Several(case) => &case.title,
        }
    }

    #[getter]
    fn source(&self) -> &str {
        match &self.inner {
            AnyCase::One(case) => &case.source,
            AnyCase::Several(case) => &case.source,
        }
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

    /// Whether it is driven steadily, as several modes are by every load.
    #[getter]
    fn steady(&self) -> bool {
        match &self.inner {
            AnyCase::One(case) => case.design.scene() == Scene::Steady,
            AnyCase::Several(_) => true,
        }
    }

    /// The places at which modes have a shape; none of one mode with one absorber.
    #[getter]
    fn places(&self) -> Vec<String> {
        match &self.inner {
            AnyCase::One(_) => Vec::new(),
            AnyCase::Several(case) => case.places.clone(),
        }
    }

    /// What is probably a slip in it, as the program says it of the text.
    fn warnings(&self) -> Vec<String> {
        let warnings = match &self.inner {
            AnyCase::One(case) => case.warnings(),
            AnyCase::Several(case) => &case.warnings,
        };
        warned(&self.name, &self.text, warnings)
    }

    /// Clearance, natural frequency and mass, which turn dimensionless numbers into the case's units.
    fn scales<'py>(&self, py: Python<'py>) -> PyResult<Columns<'py>> {
        let case = self.one()?;
        let scales = case.units();
        let dict = PyDict::new(py);
        dict.set_item("physical", scales.physical)?;
        dict.set_item("length", scales.length(1.0))?;
        dict.set_item("time", scales.time(1.0))?;
        dict.set_item("velocity", scales.velocity(1.0))?;
        dict.set_item("energy", scales.energy(1.0))?;
        dict.set_item("frequency", scales.frequency(1.0))?;
        dict.set_item("period", scales.time(case.system().period()))?;
        Ok(dict)
    }

    /// As `vinesink analyze --format json`.
    fn analyze(&self, py: Python<'_>, progress: Option<Py<PyAny>>) -> PyResult<String> {
        let analysed = |work: &WorkState| analyze::analysed(&self.inner, &self.stem, work);
        work::done(py, progress, |work| json(&analysed(work)?))
    }

    /// All exact orbits with two impacts per period: the document of each, and its sequence of walls.
    fn orbits(&self, py: Python<'_>) -> PyResult<String> {
        let case = self.driven_steadily("a list of orbits is")?;
        work::done(py, None, |_| json(&branch::orbits(case)))
    }

    /// Refuses `periods`, or what else was asked of a run, where the case itself says what is flown.
    fn needs_run(&self, periods: bool, other: bool) -> PyResult<()> {
        match &self.inner {
            AnyCase::Several(_) if other => Err(refused(
                "the structure has several modes or absorbers, whose starts are those of the search; call simulate(), or simulate(periods=...)",
            )),
            AnyCase::One(_) if !self.steady() && (periods || other) => Err(refused(
                "the structure is not driven steadily: the case itself says what becomes of it; call simulate()",
            )),
            _ => Ok(()),
        }
    }

    /// As `vinesink simulate --format json`; the impacts that `--impacts` writes, and where one steady motion starts.
    fn simulate<'py>(
        &self,
        py: Python<'py>,
        periods: Option<u64>,
        discard: Option<u64>,
        initial: Option<[f64; 4]>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Told<'py>> {
        match &self.inner {
            AnyCase::Several(case) => simulate::of_several(py, case, &self.stem, periods, progress),
            AnyCase::One(case) if !self.steady() => {
                simulate::unsteady(py, case, &self.stem, progress)
            }
            AnyCase::One(case) => {
                simulate::steady(py, case, &Wanted::of(case, periods, discard, initial), progress)
            }
        }
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
        let case = self.driven_steadily("a list of impacts is")?;
        let wanted = Wanted::of(case, periods, discard, Some(initial));
        work::done(py, progress, |work| simulate::flown(case, &wanted, work))?.columns(py)
    }

    /// The states of a trajectory at times in excitation periods, ascending from 0: a row of four each.
    fn trajectory<'py>(
        &self,
        py: Python<'py>,
        initial: [f64; 4],
        times: Vec<f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let case = self.driven_steadily("a trajectory is")?;
        let start = simulate::state(initial);
        let found = work::done(py, None, |work| simulate::sampled(case, start, times, work))?;
        Ok(found.into_pyarray(py))
    }

    /// Writes the files of `vinesink report` into a folder; whether what was asked for holds.
    fn report(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        name: &str,
        long: bool,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<bool> {
        let render = |work: &WorkState| report::rendered(&self.inner, name, long, work);
        let (files, holds) = work::done(py, progress, render)?;
        report::write(&folder, &files)?;
        Ok(holds)
    }

    /// As `vinesink check --format json` says it of this case.
    fn check(
        &self,
        py: Python<'_>,
        criteria_only: bool,
        long: bool,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<String> {
        let (case, stem) = (&self.inner, &self.stem);
        work::done(py, progress, |work| decide::checked(case, stem, criteria_only, long, work))
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
        self.one()?;
        let text = self.text.strip_prefix('\u{feff}').unwrap_or(&self.text);
        let read: serde_json::Value = toml::from_str(text).map_err(refused)?;
        json(&read)
    }

    /// A number of the case by its name, in SI or the units of a reduced case; none of what it has not.
    fn value(&self, name: &str) -> PyResult<Option<f64>> {
        let case = self.one()?;
        Ok(Parameter::of_name(name).and_then(|known| case.design.value(known)))
    }

    /// The unit in which numbers of this name are, "1" for a plain number.
    fn unit(&self, name: &str) -> PyResult<&'static str> {
        let (case, known) = (self.one()?, Parameter::of_name(name));
        let known = known.ok_or_else(|| refused(format!("there is no `{name}` to vary")))?;
        Ok(case.design.unit(known))
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
        let case = self.driven_steadily("a branch is")?;
        let followed = || branch::followed(case, parameter, range, orbit, most_points);
        let found = work::done(py, None, |_| followed())?;
        Ok((found.columns(py)?, json(&found.told)?))
    }
}

impl Case {
    /// What only a structure of one mode with one absorber can be asked.
    fn one(&self) -> PyResult<&case::Case> {
        match &self.inner {
            AnyCase::One(case) => Ok(case),
            AnyCase::Several(_) => Err(refused(
                "the structure has several modes or absorbers: analyze, simulate, motions, check, optimize, sweep and report tell of it",
            )),
        }
    }

    /// The same where it has to be driven steadily.
    pub fn driven_steadily(&self, what: &str) -> PyResult<&case::Case> {
        let case = self.one()?;
        match case.design.scene() {
            Scene::Steady => Ok(case),
            other => Err(refused(format!(
                "its structure is {}, and {what} about one that is driven steadily",
                other.words()
            ))),
        }
    }
}

fn reach(allow_outside: bool) -> Reach {
    if allow_outside { Reach::Anywhere } else { Reach::Folder }
}

/// A case from its text; files that it names are below `folder`, unless they may be anywhere.
#[pyfunction]
pub fn parse(
    py: Python<'_>,
    name: String,
    text: String,
    folder: PathBuf,
    allow_outside: bool,
) -> PyResult<Case> {
    let inner = case_input::parse_any(&name, &text, &folder, reach(allow_outside));
    let inner = inner.map_err(|error| not_read(py, &error))?;
    Ok(Case { inner, text, name, stem: String::new() })
}

/// The same from its file.
#[pyfunction]
pub fn read(py: Python<'_>, path: PathBuf, allow_outside: bool) -> PyResult<Case> {
    let read = case_input::read_any(&path, reach(allow_outside));
    let (inner, text) = read.map_err(|error| not_read(py, &error))?;
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    Ok(Case { inner, text, name: path.display().to_string(), stem })
}

/// What changed from one case to another: the document of `vinesink diff`, and Markdown.
#[pyfunction]
pub fn compare(
    py: Python<'_>,
    old: &Case,
    new: &Case,
    progress: Option<Py<PyAny>>,
) -> PyResult<(String, String)> {
    work::done(py, progress, |work| decide::compared(&old.inner, &new.inner, work))
}

/// The JSON Schema of a case file.
#[pyfunction]
pub fn schema() -> String {
    case::schema().to_string()
}
