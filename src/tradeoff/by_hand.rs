//! The baseline: a fixed-step integrator as people write it by hand, and the impacts that it gets
//! wrong.
//!
//! The classical Runge-Kutta method in equal parts of the excitation period. A step that ends outside
//! of the cavity holds an impact; nothing is looked for between the ends of steps. It shares no code
//! with the event engine, except for what it is compared with.

use serde::Serialize;

use crate::operation_count::{self, ELEMENTARY};
use crate::simulation::{Impact, Side, Simulation, StartError};
use crate::system::{State, System};

/// Halvings of a step that locate an impact to rounding.
const HALVINGS: u32 = 50;
/// Impacts in one step after which the rest of the step is flown without looking: a chattering
/// sequence never ends in a scheme without sustained contact.
const MOST_IN_STEP: u32 = 50;

/// How an impact is located within the step that it was noticed in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Locate {
    /// By bisection, repeating the step with half the length each time.
    Bisection,
    /// By linear interpolation of the gap between the ends of the step.
    Interpolation,
}

/// A fixed-step integrator of a system.
#[derive(Debug, Clone, Copy)]
pub struct ByHand {
    system: System,
    damping: f64,
    force: [f64; 2],
    steps: u32,
    locate: Locate,
}

/// What an integrator makes of some periods.
#[derive(Debug, Clone)]
pub struct IntegratorRun {
    /// Where it ends.
    pub end: State,
    /// When each impact took place, and the state after it.
    pub impacts: Vec<(f64, State)>,
    /// Sum of the squared displacement at the ends of steps.
    pub squares: f64,
}

impl ByHand {
    /// With so many steps in an excitation period.
    pub fn new(system: &System, steps: u32, locate: Locate) -> Self {
        let (sine, cosine) = system.excitation_amplitudes();
        let damping = system.mass_ratio() * system.damping();
        Self { system: *system, damping, force: [sine, cosine], steps, locate }
    }

    /// Steps in an excitation period.
    pub fn steps_per_period(&self) -> u64 {
        u64::from(self.steps)
    }

    fn acceleration(&self, time: f64, x: f64, v: f64) -> f64 {
        let (sin, cos) = libm::sincos(self.system.frequency_ratio() * time);
        self.force[0] * sin + self.force[1] * cos - self.damping * v - x
    }

    fn advanced(&self, time: f64, at: &State, h: f64) -> State {
        operation_count::note(4 * (2 * ELEMENTARY + 7) + 36);
        let (x, v) = (at.x, at.x_velocity);
        let half = 0.5 * h;
        let a1 = self.acceleration(time, x, v);
        let v2 = v + half * a1;
        let a2 = self.acceleration(time + half, x + half * v, v2);
        let v3 = v + half * a2;
        let a3 = self.acceleration(time + half, x + half * v2, v3);
        let v4 = v + h * a3;
        let a4 = self.acceleration(time + h, x + h * v3, v4);
        State {
            x: x + h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4),
            x_velocity: v + h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4),
            y: at.y + at.y_velocity * h,
            y_velocity: at.y_velocity,
        }
    }

    /// Part of a step of length `h`, from `at` to `end`, at which the wall is met.
    fn located(&self, time: f64, at: &State, end: &State, h: f64) -> f64 {
        match self.locate {
            Locate::Interpolation => {
                let wall = end.relative_displacement().signum();
                let part = (wall - at.relative_displacement())
                    / (end.relative_displacement() - at.relative_displacement());
                h * part.clamp(0.0, 1.0)
            }
            Locate::Bisection => {
                let (mut before, mut after) = (0.0, h);
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (before + after);
                    if self.advanced(time, at, middle).relative_displacement().abs() > 1.0 {
                        after = middle;
                    } else {
                        before = middle;
                    }
                }
                after
            }
        }
    }

    fn collided(&self, mut at: State) -> State {
        let (eps, r) = (self.system.mass_ratio(), self.system.restitution());
        let exchanged = (1.0 + r) * (at.x_velocity - at.y_velocity) / (1.0 + eps);
        // The mass is put on the wall, where linear interpolation leaves it short of it.
        at.y = at.x - at.relative_displacement().signum();
        at.x_velocity -= eps * exchanged;
        at.y_velocity += exchanged;
        at
    }

    /// Integrates so many excitation periods from `start` at phase 0.
    pub fn run(&self, start: State, periods: u64) -> IntegratorRun {
        let h = self.system.period() / f64::from(self.steps);
        let mut run = IntegratorRun { end: start, impacts: Vec::new(), squares: 0.0 };
        for step in 0..periods * u64::from(self.steps) {
            // The phase starts afresh in every period, as careful people do.
            let in_period = (step % u64::from(self.steps)) as f64 * h;
            let period = (step / u64::from(self.steps)) as f64 * self.system.period();
            self.step(&mut run, in_period, period, h);
            run.squares += run.end.x * run.end.x;
        }
        run
    }

    fn step(&self, run: &mut IntegratorRun, mut time: f64, period: f64, mut left: f64) {
        for _ in 0..MOST_IN_STEP {
            let state = run.end;
            let next = self.advanced(time, &state, left);
            let outwards = next.relative_displacement() * (next.x_velocity - next.y_velocity) > 0.0;
            if next.relative_displacement().abs() <= 1.0 || !outwards {
                run.end = next;
                return;
            }
            let passed = self.located(time, &state, &next, left);
            run.end = self.collided(self.advanced(time, &state, passed));
            time += passed;
            left -= passed;
            run.impacts.push((period + time, run.end));
        }
        run.end = self.advanced(time, &run.end, left);
    }
}

/// Flights of an integrator against the exact next impact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Flights {
    /// Flights compared.
    pub compared: u64,
    /// The exact flight ends in an impact that the integrator flew past.
    pub missed: u64,
    /// The integrator has an impact where the exact flight has none.
    pub invented: u64,
}

/// Difference between the ends of two flights, in steps of the integrator, up to which they are the
/// same impact: it cannot tell when in a step it happened, and not whether it was in this one.
const SAME_IMPACT: f64 = 2.0;
/// Flights after which no further period is looked at.
const MOST_FLIGHTS: usize = 20_000;
/// Excitation periods after which an exact flight without impact is given up.
const PATIENCE: u64 = 50;

impl Flights {
    /// From the state after each impact of the integrator, for so many periods from `start`: the event
    /// engine says what the next impact is.
    ///
    /// # Errors
    /// [`StartError`] if the integrator's state is not finite.
    pub fn of(hand: &ByHand, start: State, periods: u64) -> Result<Self, StartError> {
        let (mut impacts, mut state) = (Vec::new(), start);
        for period in 0..periods {
            // A scheme without sustained contact may hit a wall in every step.
            if impacts.len() > MOST_FLIGHTS {
                break;
            }
            let run = hand.run(state, 1);
            let begin = period as f64 * hand.system.period();
            impacts.extend(run.impacts.iter().map(|(time, state)| (begin + time, *state)));
            state = run.end;
        }
        let width = SAME_IMPACT * hand.system.period() / f64::from(hand.steps);
        let mut found = Self::default();
        for pair in impacts.windows(2) {
            let [(before, state), (after, end)] = [pair[0], pair[1]];
            let phase = before * hand.system.frequency_ratio();
            let exact = next(&hand.system, state, phase)?;
            found.compared += 1;
            let took = after - before;
            let side = if end.relative_displacement() > 0.0 { Side::Plus } else { Side::Minus };
            match exact {
                Some(exact) if exact.side == side && (exact.tau - took).abs() <= width => {}
                Some(exact) if exact.tau < took => found.missed += 1,
                _ => found.invented += 1,
            }
        }
        Ok(found)
    }
}

/// The exact next impact, its `tau` counted from the state given.
fn next(system: &System, state: State, phase: f64) -> Result<Option<Impact>, StartError> {
    let mut simulation = Simulation::new(system, state, phase)?;
    let turned = phase.rem_euclid(std::f64::consts::TAU) / system.frequency_ratio();
    let next = simulation.next_impact(PATIENCE);
    Ok(next.map(|impact| Impact { tau: impact.tau - turned, ..impact }))
}
