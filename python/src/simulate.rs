//! One trajectory, or the search for all motions: as the program's `simulate`, of any case.

use numpy::IntoPyArray;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::Value;
use vinesink::answer::trajectory::{
    Detail, Impact, ImpactLog, Observer, Segment, Simulation, Stop, followed,
};
use vinesink::answer::{Answer, Asked};
use vinesink::case::{Case, ModalCase};
use vinesink::modal::{LoadImpact, ModalAnswer, usual_periods};
use vinesink::motions::{Effort, Motion, Motions};
use vinesink::report::console::Simulated;
use vinesink::report::document::Content;
use vinesink::report::modal::simulation;
use vinesink::system::State;

use crate::analyze;
use crate::errors::refused;
use crate::work::{self, Columns, WorkState, json};

/// Impacts after which a run is ended, as by the program.
const IMPACT_LIMIT: u64 = 200_000_000;
/// Excitation periods between two looks at whether to go on: a millisecond or so.
const STRETCH: u64 = 1000;

/// A document, impacts, and where one steady motion starts; of another NaN.
pub type Told<'py> = (String, Columns<'py>, [f64; 4]);

/// What is to be followed.
pub struct Wanted {
    effort: Effort,
    start: Option<State>,
}

impl Wanted {
    /// What a case asks for, where nothing else is given.
    pub fn of(
        case: &Case,
        periods: Option<u64>,
        discard: Option<u64>,
        initial: Option<[f64; 4]>,
    ) -> Self {
        let asked = case.effort();
        let (periods, discard) = (periods.unwrap_or(asked.periods), discard.or(asked.discard));
        Self { effort: Effort { periods, discard, ..asked }, start: initial.map(state) }
    }
}

pub fn state([x, x_velocity, y, y_velocity]: [f64; 4]) -> State {
    State { x, x_velocity, y, y_velocity }
}

pub fn numbers(State { x, x_velocity, y, y_velocity }: State) -> [f64; 4] {
    [x, x_velocity, y, y_velocity]
}

/// Impacts as columns, named as in the file that `--impacts` writes.
#[derive(Default)]
pub struct Impacts {
    side: Vec<i8>,
    numbers: [Vec<f64>; 6],
}

const NAMES: [&str; 6] = ["tau", "x", "xdot_before", "xdot_after", "ydot_before", "ydot_after"];

impl Impacts {
    pub fn of(all: &[Impact]) -> Self {
        let mut columns = Self::default();
        columns.side.reserve_exact(all.len());
        columns.numbers.iter_mut().for_each(|one| one.reserve_exact(all.len()));
        all.iter().for_each(|one| columns.impact(one));
        columns
    }

    pub fn columns(self, py: Python<'_>) -> PyResult<Columns<'_>> {
        let dict = PyDict::new(py);
        let [tau, rest @ ..] = self.numbers;
        dict.set_item("tau", tau.into_pyarray(py))?;
        dict.set_item("side", self.side.into_pyarray(py))?;
        for (name, column) in NAMES[1..].iter().zip(rest) {
            dict.set_item(name, column.into_pyarray(py))?;
        }
        Ok(dict)
    }
}

/// The same of several modes or absorbers.
fn impacts_of_several<'py>(
    py: Python<'py>,
    case: &ModalCase,
    all: &[LoadImpact],
) -> PyResult<Columns<'py>> {
    let rows: Vec<[f64; 6]> = all.iter().map(|one| one.over_clearance(case)).collect();
    let number = |k: usize| rows.iter().map(|row| row[k]).collect::<Vec<_>>().into_pyarray(py);
    let whole = |of: &dyn Fn(&LoadImpact) -> usize| {
        all.iter().map(|one| of(one) as i64).collect::<Vec<_>>().into_pyarray(py)
    };
    let dict = PyDict::new(py);
    dict.set_item("tau", number(0))?;
    let sides: Vec<i8> = all.iter().map(|one| one.side.sign() as i8).collect();
    dict.set_item("side", sides.into_pyarray(py))?;
    dict.set_item("absorber", whole(&|one| one.absorber))?;
    for (k, name) in NAMES.iter().enumerate().skip(1) {
        dict.set_item(name, number(k))?;
    }
    dict.set_item("load", whole(&|one| one.load))?;
    let at: Vec<f64> = all.iter().map(|one| one.at).collect();
    dict.set_item("frequency", at.into_pyarray(py))?;
    let ids: Vec<String> = all.iter().map(|one| Motions::id(one.motion)).collect();
    dict.set_item("motion", ids)?;
    Ok(dict)
}

impl Observer for Impacts {
    fn detail(&self) -> Detail {
        Detail::Events
    }
    fn impact(&mut self, one: &Impact) {
        self.side.push(one.side.sign() as i8);
        let values = [
            one.tau,
            one.x,
            one.x_velocity_before,
            one.x_velocity_after,
            one.y_velocity_before,
            one.y_velocity_after,
        ];
        self.numbers.iter_mut().zip(values).for_each(|(column, value)| column.push(value));
    }
}

/// What `vinesink simulate` says of a structure that is driven steadily, and the impacts of the measured window.
pub fn steady<'py>(
    py: Python<'py>,
    case: &Case,
    wanted: &Wanted,
    progress: Option<Py<PyAny>>,
) -> PyResult<Told<'py>> {
    let (text, impacts, start) = work::done(py, progress, |work| {
        let (document, impacts, start) = measured(case, wanted, work)?;
        Ok((json(&document)?, Impacts::of(&impacts), start))
    })?;
    Ok((text, impacts.columns(py)?, numbers(start)))
}

/// The same of one that is not: its document alone.
pub fn unsteady<'py>(
    py: Python<'py>,
    case: &Case,
    stem: &str,
    progress: Option<Py<PyAny>>,
) -> PyResult<Told<'py>> {
    let text = work::done(py, progress, |work| {
        let answer = Answer::of(case, Asked::Motions, None, work).map_err(refused)?;
        json(&analyze::unsteady(case, stem, &answer, Content::Simulation))
    })?;
    Ok((text, PyDict::new(py), [f64::NAN; 4]))
}

/// The same of several modes or absorbers, and the impacts of so many excitation periods under each load.
pub fn of_several<'py>(
    py: Python<'py>,
    case: &ModalCase,
    stem: &str,
    periods: Option<u64>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Told<'py>> {
    let periods = periods.unwrap_or_else(|| usual_periods(case));
    let (text, impacts) = work::done(py, progress, |work| {
        let answer = ModalAnswer::of(case, work).map_err(refused)?;
        answer.observe(work);
        let impacts = answer.impacts(case, periods).map_err(refused)?;
        Ok((json(&simulation(stem, case, &answer))?, impacts))
    })?;
    Ok((text, impacts_of_several(py, case, &impacts)?, [f64::NAN; 4]))
}

/// The document, the impacts of the measured window, and where the measured trajectory starts.
fn measured(
    case: &Case,
    wanted: &Wanted,
    work: &WorkState,
) -> PyResult<(Value, Vec<Impact>, State)> {
    let (system, effort) = (case.system(), wanted.effort);
    let mut log = ImpactLog::default();
    let (measured, start, found) = match wanted.start {
        Some(start) => (followed(&system, start, &effort, &mut log).map_err(refused)?, start, None),
        None => {
            let answer = Answer::with(case, Asked::Motions, None, effort, work).map_err(refused)?;
            let measured = answer.main(case, &mut log).map_err(refused)?;
            let main = answer.motions.as_ref().and_then(Motions::main).map(Motion::state);
            let none = || refused("no start led anywhere; ask for more than 0 starts");
            let (measured, start) = measured.zip(main).ok_or_else(none)?;
            (measured, start, answer.motions)
        }
    };
    let told = Simulated { case, measured: &measured, found: found.as_ref() };
    Ok((told.document(), log.impacts, start))
}

/// The impacts of a trajectory, nothing measured.
pub fn flown(case: &Case, wanted: &Wanted, work: &WorkState) -> PyResult<Impacts> {
    let system = case.system();
    let start = wanted.start.unwrap_or(State::AT_REST);
    let mut simulation = Simulation::new(&system, start, 0.0).map_err(refused)?;
    let [before, measured] = [wanted.effort.left_out(&system), wanted.effort.periods];
    work.expect(before + measured);
    run(&mut simulation, before, &mut (), work)?;
    let mut impacts = Impacts::default();
    run(&mut simulation, measured, &mut impacts, work)?;
    Ok(impacts)
}

/// Goes on by so many periods, in stretches, which do not change a bit of it.
fn run(
    simulation: &mut Simulation,
    periods: u64,
    observer: &mut dyn Observer,
    work: &WorkState,
) -> PyResult<()> {
    let mut left = periods;
    while left > 0 {
        let some = left.min(STRETCH);
        let stop = simulation.run(some, IMPACT_LIMIT, observer);
        if stop != Stop::EndTime {
            let after = simulation.periods();
            return Err(refused(format!(
                "the run ended by {} after {after} periods",
                stop.words()
            )));
        }
        left -= some;
        work.advance(some);
    }
    Ok(())
}

/// The states at some times, one after the other.
pub fn sampled(case: &Case, start: State, times: Vec<f64>, work: &WorkState) -> PyResult<Vec<f64>> {
    let ascend = times.windows(2).all(|pair| pair[0] <= pair[1]);
    let last = times.last().copied().unwrap_or_default();
    let begins = times.first().is_none_or(|first| *first >= 0.0);
    if !(ascend && begins && last.is_finite()) {
        let message =
            "times must be finite numbers of excitation periods, 0 or more, in ascending order";
        return Err(refused(message));
    }
    let mut simulation = Simulation::new(&case.system(), start, 0.0).map_err(refused)?;
    let (begun, states) = (simulation.state(), Vec::with_capacity(4 * times.len()));
    let mut samples = Samples { times, states };
    // What is at the very beginning needs no flight.
    let zeros = samples.times.iter().take_while(|time| **time == 0.0).count();
    samples.states.extend(numbers(begun).repeat(zeros));
    run(&mut simulation, last.ceil() as u64, &mut samples, work)?;
    // The last stretch may end a rounding too early.
    let missing = samples.times.len() - samples.states.len() / 4;
    samples.states.extend(numbers(simulation.state()).repeat(missing));
    Ok(samples.states)
}

/// Keeps the states at some times in excitation periods; at the moment of an impact that before it.
struct Samples {
    times: Vec<f64>,
    states: Vec<f64>,
}

impl Observer for Samples {
    fn segment(&mut self, segment: &Segment) {
        let frequency = segment.motion.oscillator().frequency;
        while let Some(time) = self.times.get(self.states.len() / 4) {
            // Whole periods first: what is left is as exact after a million periods as in the first.
            let phase = (time - segment.turns as f64) * std::f64::consts::TAU;
            let after = (phase - segment.phase) / frequency;
            if after > segment.duration {
                return;
            }
            self.states.extend(numbers(segment.at(after)));
        }
    }
}
