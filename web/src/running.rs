//! The simulation that runs beside the sliders: it goes on from where it is when the system changes.

use std::cell::RefCell;

use vinesink::answer::trajectory::{Simulation, Trace};
use vinesink::system::{State, System};

use crate::From;

thread_local! {
    static RUNNING: RefCell<Option<Running>> = const { RefCell::new(None) };
}

/// A simulation and the clearance, in the case's unit, that its lengths are over.
struct Running {
    simulation: Simulation,
    clearance: f64,
}

/// How near to a wall an absorber may be that a smaller cavity pushes inwards, over the clearance.
const BESIDE_THE_WALL: f64 = 0.999;

/// Runs another system.
pub fn change(system: &System, clearance: f64, from: From) -> Result<(), String> {
    RUNNING.with_borrow_mut(|running| {
        let start = match from {
            From::Push => State { y: 0.5, y_velocity: 1.0, ..State::AT_REST },
            From::Rest | From::Here => State::AT_REST,
        };
        let (start, phase) = match running {
            Some(running) if from == From::Here => {
                let state = running.simulation.state();
                (within(scaled(state, running.clearance / clearance)), running.simulation.phase())
            }
            _ => (start, 0.0),
        };
        let simulation =
            Simulation::new(system, start, phase).map_err(|error| error.to_string())?;
        *running = Some(Running { simulation, clearance });
        Ok(())
    })
}

/// The structure without an absorber in its steady motion: displacement over the clearance at phase 0, and a quarter of a
/// period later; none where nothing limits it.
pub fn bare(system: &System) -> Option<[f64; 2]> {
    let State { x, x_velocity, .. } = system.linear_response()?.state(system);
    Some([x, x_velocity / system.frequency_ratio()])
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

/// Appends what happens in the next periods. First come the number of points and, for each, the time in periods since
/// the last change of the system, `x` and `x - y` over the clearance; then for each impact its time and its side, -1
/// or 1.
pub fn go_on(periods: u32, samples: f64, numbers: &mut Vec<f64>) {
    RUNNING.with_borrow_mut(|running| {
        let Some(running) = running else { return };
        let mut trace = Trace::new(samples);
        // An absorber that chatters has infinitely many impacts.
        const AT_MOST: u64 = 100_000;
        running.simulation.run(periods.into(), AT_MOST, &mut trace);
        numbers.push(trace.points.len() as f64);
        for point in &trace.points {
            let State { x, y, .. } = point.state;
            numbers.extend([point.periods, x, x - y]);
        }
        for (periods, impact) in &trace.impacts {
            numbers.extend([*periods, impact.side.sign()]);
        }
    });
}
