//! diffsol's Tsitouras 5(4) with root finding; the state is set back to the root and goes on from
//! there.
//!
//! Its root finding compares signs at both ends of a step. After an impact the gap is put a few ulps
//! inside: on the wall itself the sign would be zero, and the next impact on the same wall, if it came
//! within one step, would be no change of sign.

use diffsol::{NalgebraMat, OdeBuilder, OdeSolverMethod, OdeSolverStopReason};
use vinesink::system::System;

use crate::{Acceleration, Failure, Hit, Run, START, Tool, rebound, timed};

/// Distance from the wall after an impact, over the clearance.
const INSIDE: f64 = 8.0 * f64::EPSILON;

/// The absolute tolerance over the relative one: lengths are some clearances, and the relative one
/// shall decide. Were both the same, the method would be faster, less exact, and miss more.
const ABSOLUTE: f64 = 1e-3;

/// The method with a relative tolerance.
#[derive(Debug, Clone, Copy)]
pub struct Tsit45 {
    pub tolerance: f64,
}

impl Tsit45 {
    fn each(
        &self,
        system: &System,
        periods: u64,
        mut tell: impl FnMut(Hit),
    ) -> Result<(), Failure> {
        let end = periods as f64 * system.period();
        let force = Acceleration::of(system);
        let struck = *system;
        let problem = OdeBuilder::<NalgebraMat<f64>>::new()
            .rtol(self.tolerance)
            .atol([self.tolerance * ABSOLUTE])
            .rhs(move |s: &[f64], _, t, rate: &mut [f64]| {
                rate[0] = s[1];
                rate[1] = force.at(t, s[0], s[1]);
                rate[2] = s[3];
                rate[3] = 0.0;
            })
            .init(
                |_: &[f64], _, s: &mut [f64]| {
                    s.copy_from_slice(&[START.x, START.x_velocity, START.y, START.y_velocity]);
                },
                4,
            )
            .root(
                |s: &[f64], _, _, gap: &mut [f64]| {
                    gap[0] = s[0] - s[2] - 1.0;
                    gap[1] = s[0] - s[2] + 1.0;
                },
                2,
            )
            .reset(move |s: &[f64], _, _, after: &mut [f64]| {
                let side = (s[0] - s[2]).signum();
                let [x_velocity, y_velocity] = rebound(&struck, s[1], s[3]);
                after.copy_from_slice(&[
                    s[0],
                    x_velocity,
                    s[0] - side * (1.0 - INSIDE),
                    y_velocity,
                ]);
            })
            .build()?;
        let mut solver = problem.tsit45()?;
        solver.set_stop_time(end)?;
        loop {
            match solver.step()? {
                OdeSolverStopReason::InternalTimestep => {}
                OdeSolverStopReason::TstopReached => return Ok(()),
                OdeSolverStopReason::RootFound(time, _) => {
                    solver.state_mut_back(time)?;
                    solver.apply_reset()?;
                    let state = solver.state();
                    let (x, y) = (state.y[0], state.y[2]);
                    tell(Hit {
                        time,
                        side: (x - y).signum(),
                        x,
                        x_velocity: state.y[1],
                        y_velocity: state.y[3],
                    });
                }
            }
        }
    }
}

impl Tool for Tsit45 {
    fn name(&self) -> String {
        format!("diffsol 0.18.0 tsit45, {:.0e}", self.tolerance)
    }

    fn run(&mut self, system: &System, periods: u64) -> Result<Run, Failure> {
        timed(|| {
            let mut impacts = 0;
            self.each(system, periods, |_| impacts += 1)?;
            Ok(impacts)
        })
    }

    fn hits(&mut self, system: &System, periods: u64) -> Result<Vec<Hit>, Failure> {
        let mut hits = Vec::new();
        self.each(system, periods, |hit| hits.push(hit))?;
        Ok(hits)
    }
}
