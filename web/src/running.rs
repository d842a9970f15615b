//! The simulation that runs beside the sliders: it goes on from where it is when the case changes.

use std::cell::RefCell;
use std::f64::consts::TAU;

use serde::Deserialize;
use vinesink::answer::trajectory::{Simulation, Trace};
use vinesink::simulation::{ModalImpact, ModalObserver, ModalSegment, ModalSimulation};
use vinesink::system::{ModalState, ModalSystem, State, System};

/// How a simulation begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum From {
    /// With the displacements and velocities of the one before.
    Here,
    /// At rest, each absorber in the middle of its cavity.
    Rest,
    /// Each absorber half the way to a wall, with a velocity of one clearance per `1/omega0`.
    Push,
}

enum Running {
    /// Of one mode with one absorber, with the clearance, in the case's unit, that its lengths are over.
    One(Box<Simulation>, f64),
    /// Of several modes or absorbers, in m.
    Several(Box<(ModalSimulation, ModalSystem)>),
}

thread_local! {
    static RUNNING: RefCell<Option<Running>> = const { RefCell::new(None) };
}

/// How near to a wall an absorber may be that a smaller cavity pushes inwards, over the clearance.
const BESIDE_THE_WALL: f64 = 0.999;

/// An absorber that chatters has infinitely many impacts.
const AT_MOST: u64 = 100_000;

/// Runs another system of one mode.
pub fn one(system: &System, clearance: f64, from: From) -> Result<(), String> {
    RUNNING.with_borrow_mut(|running| {
        let (start, phase) = match running {
            Some(Running::One(simulation, before)) if from == From::Here => {
                (within(scaled(simulation.state(), *before / clearance)), simulation.phase())
            }
            _ if from == From::Push => (State { y: 0.5, y_velocity: 1.0, ..State::AT_REST }, 0.0),
            _ => (State::AT_REST, 0.0),
        };
        let simulation =
            Simulation::new(system, start, phase).map_err(|error| error.to_string())?;
        *running = Some(Running::One(Box::new(simulation), clearance));
        Ok(())
    })
}

fn scaled(state: State, by: f64) -> State {
    let State { x, x_velocity, y, y_velocity } = state;
    State { x: by * x, x_velocity: by * x_velocity, y: by * y, y_velocity: by * y_velocity }
}

/// The state with the absorber inside of its cavity.
fn within(state: State) -> State {
    let relative = (state.x - state.y).clamp(-BESIDE_THE_WALL, BESIDE_THE_WALL);
    State { y: state.x - relative, ..state }
}

/// Runs another system of several modes or absorbers.
pub fn several(system: &ModalSystem, from: From) -> Result<(), String> {
    let size = |of: &ModalSystem| [of.modes().len(), of.absorbers().len()];
    let clearances = system.absorbers().iter().map(|one| one.clearance);
    RUNNING.with_borrow_mut(|running| {
        let (mut state, mut phase) = (ModalState::AT_REST, 0.0);
        match running {
            Some(Running::Several(before))
                if from == From::Here && size(&before.1) == size(system) =>
            {
                let (simulation, _) = &**before;
                (state, phase) = (simulation.state(), simulation.phase());
                for (j, b) in clearances.enumerate() {
                    let x = displacement(system, &state, j);
                    let gap = (x - state.absorbers[j][0]) / b;
                    state.absorbers[j][0] = x - b * gap.clamp(-BESIDE_THE_WALL, BESIDE_THE_WALL);
                }
            }
            _ if from == From::Rest => {}
            _ => {
                for (one, b) in state.absorbers.iter_mut().zip(clearances) {
                    *one = [0.5 * b, b];
                }
            }
        }
        let simulation = ModalSimulation::new(system, &state, phase);
        let simulation = simulation.map_err(|error| error.to_string())?;
        *running = Some(Running::Several(Box::new((simulation, system.clone()))));
        Ok(())
    })
}

/// Displacement of the structure at an absorber.
fn displacement(system: &ModalSystem, state: &ModalState, absorber: usize) -> f64 {
    let modes = system.modes().iter().zip(&state.modes);
    modes.map(|(mode, [q, _])| mode.shape[absorber] * q).sum()
}

/// Points of a run at even phases, and its impacts.
struct ModalTrace<'a> {
    system: &'a ModalSystem,
    samples: f64,
    points: Vec<f64>,
    impacts: Vec<f64>,
}

impl ModalObserver for ModalTrace<'_> {
    fn segment(&mut self, segment: &ModalSegment<'_>) {
        let speed = self.system.frequency_ratio() / TAU;
        let begin = segment.turns as f64 + segment.phase / TAU;
        let end = begin + speed * segment.duration;
        let mut k = (begin * self.samples).ceil();
        while k < end * self.samples {
            let state = segment.at((k / self.samples - begin) / speed);
            self.points.push(k / self.samples);
            for (j, absorber) in self.system.absorbers().iter().enumerate() {
                let x = displacement(self.system, &state, j);
                self.points.extend([x, (x - state.absorbers[j][0]) / absorber.clearance]);
            }
            k += 1.0;
        }
    }

    fn impact(&mut self, impact: &ModalImpact) {
        let time = impact.tau * self.system.frequency_ratio() / TAU;
        self.impacts.extend([time, impact.absorber as f64, impact.side.sign()]);
    }
}

/// Appends what happens in the next periods: the number of points; for each the time in periods since the last change of the
/// case, then of each absorber the displacement of its place, over the clearance of one mode or in m of several, and its gap
/// over its clearance; then for each impact its time, its absorber and its side, -1 or 1.
pub fn go_on(periods: u32, samples: f64, numbers: &mut Vec<f64>) {
    RUNNING.with_borrow_mut(|running| match running {
        None => {}
        Some(Running::One(simulation, _)) => {
            let mut trace = Trace::new(samples);
            simulation.run(periods.into(), AT_MOST, &mut trace);
            numbers.push(trace.points.len() as f64);
            for point in &trace.points {
                let State { x, y, .. } = point.state;
                numbers.extend([point.periods, x, x - y]);
            }
            for (periods, impact) in &trace.impacts {
                numbers.extend([*periods, 0.0, impact.side.sign()]);
            }
        }
        Some(Running::Several(several)) => {
            let (simulation, system) = &mut **several;
            let mut trace = ModalTrace { system, samples, points: Vec::new(), impacts: Vec::new() };
            simulation.run(periods.into(), AT_MOST, &mut trace);
            let width = 1 + 2 * system.absorbers().len();
            numbers.push((trace.points.len() / width) as f64);
            numbers.append(&mut trace.points);
            numbers.append(&mut trace.impacts);
        }
    });
}
