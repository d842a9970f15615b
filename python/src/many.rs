//! Many systems at once: the motions that starts lead to, by the batch engine on all processors.

use numpy::{IntoPyArray, PyArrayMethods as _, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::iter::{IntoParallelIterator as _, IntoParallelRefIterator as _, ParallelIterator as _};
use vinesink::answer::trajectory::{Simulation, Stop};
use vinesink::case;
use vinesink::motions::{Effort, Motion, follow, starts};
use vinesink::quantity::Units;
use vinesink::regimes::Regime;
use vinesink::system::{Parameter, State, System};

use crate::case::Case;
use crate::errors::refused;
use crate::simulate::{numbers, state};
use crate::work::{self, Columns, WorkState};

/// Trajectories side by side, as in a sweep: many times the lanes of a batch, and few enough to stay in a cache.
const TOGETHER: usize = 256;

/// Names of all regimes; their places are the numbers in the results of [`simulate_many`].
#[pyfunction]
pub fn regimes() -> Vec<&'static str> {
    Regime::ALL.map(Regime::key).to_vec()
}

/// One system of many.
type OneOfMany = (System, State, Units);

/// The long-term motion of each element: `values` has a row for each of the names, `initial` one for each element.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "Python's own function has names for them")]
pub fn simulate_many<'py>(
    py: Python<'py>,
    case: &Case,
    names: Vec<String>,
    values: PyReadonlyArray2<'py, f64>,
    initial: Option<PyReadonlyArray2<'py, f64>>,
    periods: u64,
    discard: Option<u64>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Columns<'py>> {
    let case = case.driven_steadily("simulate_many is")?;
    let mut parameters = Vec::new();
    for (row, name) in names.iter().enumerate() {
        let known = |one: &Parameter| case.design.value(*one).is_some();
        let all = || {
            Parameter::ALL
                .into_iter()
                .filter(known)
                .map(Parameter::key)
                .collect::<Vec<_>>()
                .join(", ")
        };
        let unknown =
            || refused(format!("the case has no `{name}` to vary; choose from {}", all()));
        parameters.push((Parameter::of_name(name).filter(known).ok_or_else(unknown)?, row));
    }
    // Ratios are of what the others make the design.
    parameters.sort_by_key(|(parameter, _)| parameter.is_ratio());
    let count = values.as_array().ncols();
    let values = values.as_slice().map_err(refused)?.to_vec();
    let rows =
        initial.map(|rows| rows.as_slice().map(<[f64]>::to_vec)).transpose().map_err(refused)?;
    let starts: Option<Vec<State>> =
        rows.map(|rows| rows.as_chunks().0.iter().copied().map(state).collect());
    let effort = Effort { discard, ..Effort::over(periods) };
    let found = work::done(py, progress, |work| {
        let place = |k| {
            let values =
                parameters.iter().map(|(parameter, row)| (*parameter, values[row * count + k]));
            place(case, values, starts.as_ref().map(|starts| starts[k]))
                .map_err(|why| refused(format!("element {k}{why}")))
        };
        let some = |chunk: usize| {
            work.goes_on();
            let begin = TOGETHER * chunk;
            (begin..count.min(begin + TOGETHER)).map(place).collect()
        };
        let chunks: Vec<PyResult<Vec<OneOfMany>>> =
            (0..count.div_ceil(TOGETHER)).into_par_iter().map(some).collect();
        // The first of several that are wrong, whichever was seen first.
        let places: Vec<Vec<OneOfMany>> = chunks.into_iter().collect::<PyResult<_>>()?;
        motions(&places, &effort, work)
    })?;
    columns(py, &found)
}

/// The system of an element, and where it starts; or what is wrong with it.
fn place(
    case: &case::Case,
    values: impl Iterator<Item = (Parameter, f64)> + Clone,
    start: Option<State>,
) -> Result<OneOfMany, String> {
    let named = || {
        let each =
            values.clone().map(|(parameter, value)| format!("{} = {value}", parameter.key()));
        each.collect::<Vec<_>>().join(", ")
    };
    let of = |error: &dyn std::fmt::Display| match named().as_str() {
        "" => format!(": {error}"),
        named => format!(" ({named}): {error}"),
    };
    let design = values
        .clone()
        .fold(case.design, |design, (parameter, value)| design.with(parameter, value));
    let system = design.system().map_err(|error| of(&error))?;
    let start = start.unwrap_or(starts::FROM_REST);
    Simulation::new(&system, start, 0.0).map_err(|error| of(&error))?;
    Ok((system, start, design.units()))
}

/// A motion with what turns its numbers into units; none where it could not be followed.
type Found = (Option<Motion>, Units);

fn motions(places: &[Vec<OneOfMany>], effort: &Effort, work: &WorkState) -> PyResult<Vec<Found>> {
    work.expect(places.iter().map(|some| some.len() as u64).sum());
    let each = |some: &Vec<OneOfMany>| {
        work.goes_on();
        let starts: Vec<(System, State)> =
            some.iter().map(|(system, start, _)| (*system, *start)).collect();
        let found = follow(&starts, effort).map_err(refused)?;
        work.advance(some.len() as u64);
        let scales = some.iter().map(|(_, _, scales)| *scales);
        Ok(found.into_iter().zip(scales).collect::<Vec<Found>>())
    };
    let chunks: PyResult<Vec<Vec<Found>>> = places.par_iter().map(each).collect();
    Ok(chunks?.concat())
}

fn columns<'py>(py: Python<'py>, found: &[Found]) -> PyResult<Columns<'py>> {
    let dict = PyDict::new(py);
    let numbers_of = |of: fn(&Motion, &Units) -> f64| {
        let each = found
            .iter()
            .map(|(motion, scales)| motion.as_ref().map_or(f64::NAN, |one| of(one, scales)));
        each.collect::<Vec<_>>().into_pyarray(py)
    };
    dict.set_item("peak", numbers_of(|one, scales| scales.length(one.facts().peak.value)))?;
    dict.set_item("peak_error", numbers_of(|one, scales| scales.length(one.facts().peak.error)))?;
    dict.set_item("rms", numbers_of(|one, scales| scales.length(one.facts().rms.value)))?;
    dict.set_item("rms_error", numbers_of(|one, scales| scales.length(one.facts().rms.error)))?;
    dict.set_item("impacts_per_period", numbers_of(|one, _| one.facts().impacts_per_period.value))?;
    dict.set_item(
        "impact_speed",
        numbers_of(|one, scales| scales.velocity(one.facts().impact_speed.value)),
    )?;
    dict.set_item(
        "efficiency",
        numbers_of(|one, _| one.facts().efficiency.map_or(f64::NAN, |one| one.value)),
    )?;
    let whole = |of: fn(&Motion) -> i32, none| {
        let each = found.iter().map(|(motion, _)| motion.as_ref().map_or(none, of));
        each.collect::<Vec<_>>().into_pyarray(py)
    };
    dict.set_item("regime", whole(|one| one.regime().index() as i32, -1))?;
    dict.set_item("repeats_after", whole(|one| one.repeats_after().unwrap_or(0) as i32, 0))?;
    let flag = |of: fn(&Motion) -> bool| {
        let each = found.iter().map(|(motion, _)| motion.as_ref().is_some_and(of));
        each.collect::<Vec<_>>().into_pyarray(py)
    };
    dict.set_item("settled", flag(Motion::settled))?;
    dict.set_item("whole", flag(|one| one.stop() == Stop::EndTime))?;
    let state =
        |(motion, _): &Found| motion.as_ref().map_or([f64::NAN; 4], |one| numbers(one.state()));
    let states: Vec<f64> = found.iter().flat_map(state).collect();
    dict.set_item("state", states.into_pyarray(py).reshape([found.len(), 4])?)?;
    Ok(dict)
}
