//! What one would write by hand: the classical Runge-Kutta method with steps of a fixed part of the
//! period, and bisection of the step that ends outside.

use vinesink::system::{State, System};

use crate::{Acceleration, Failure, Hit, Run, START, Tool, rebound, timed};

/// Halvings of a step that locate an impact to rounding.
const HALVINGS: u32 = 50;

/// The method with a number of steps in a period.
#[derive(Debug, Clone, Copy)]
pub struct RungeKutta {
    pub steps: u32,
}

fn step(force: &Acceleration, time: f64, at: &State, h: f64) -> State {
    let (x, v) = (at.x, at.x_velocity);
    let half = 0.5 * h;
    let a1 = force.at(time, x, v);
    let v2 = v + half * a1;
    let a2 = force.at(time + half, x + half * v, v2);
    let v3 = v + half * a2;
    let a3 = force.at(time + half, x + half * v2, v3);
    let v4 = v + h * a3;
    let a4 = force.at(time + h, x + h * v3, v4);
    State {
        x: x + h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4),
        x_velocity: v + h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4),
        y: at.y + at.y_velocity * h,
        y_velocity: at.y_velocity,
    }
}

impl RungeKutta {
    fn each(&self, system: &System, periods: u64, mut tell: impl FnMut(Hit)) {
        let force = Acceleration::of(system);
        let h = system.period() / f64::from(self.steps);
        let mut state = START;
        for k in 0..periods * u64::from(self.steps) {
            let (mut time, mut left) = (k as f64 * h, h);
            loop {
                let next = step(&force, time, &state, left);
                let outwards =
                    next.relative_displacement() * (next.x_velocity - next.y_velocity) > 0.0;
                if next.relative_displacement().abs() <= 1.0 || !outwards {
                    state = next;
                    break;
                }
                let (mut before, mut after) = (0.0, left);
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (before + after);
                    if step(&force, time, &state, middle).relative_displacement().abs() > 1.0 {
                        after = middle;
                    } else {
                        before = middle;
                    }
                }
                let at = step(&force, time, &state, after);
                let side = at.relative_displacement().signum();
                let [x_velocity, y_velocity] = rebound(system, at.x_velocity, at.y_velocity);
                state = State { x: at.x, x_velocity, y: at.x - side, y_velocity };
                time += after;
                left -= after;
                tell(Hit { time, side, x: at.x, x_velocity, y_velocity });
            }
        }
    }
}

impl Tool for RungeKutta {
    fn name(&self) -> String {
        format!("hand-written RK4 with bisection (Rust), T/{}", self.steps)
    }

    fn run(&mut self, system: &System, periods: u64) -> Result<Run, Failure> {
        timed(|| {
            let mut impacts = 0;
            self.each(system, periods, |_| impacts += 1);
            Ok(impacts)
        })
    }

    fn hits(&mut self, system: &System, periods: u64) -> Result<Vec<Hit>, Failure> {
        let mut hits = Vec::new();
        self.each(system, periods, |hit| hits.push(hit));
        Ok(hits)
    }
}
