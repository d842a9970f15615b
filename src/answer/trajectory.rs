//! One trajectory from a start, where a user wants to see that and nothing else.

use crate::motions::Effort;
pub use crate::motions::{Measured, Window, orbit_of};
use crate::simulation::Measurement;
pub use crate::simulation::{
    Detail, Impact, ImpactLog, Observer, Segment, Simulation, StartError, Stop, Trace, batch,
};
use crate::system::{State, System};

/// The motion that a start leads to, measured over the window of an effort, its impacts kept in `log`: seen, not proven.
///
/// # Errors
/// [`StartError`] for an impossible start.
pub fn followed(
    system: &System,
    start: State,
    effort: &Effort,
    log: &mut ImpactLog,
) -> Result<Measured, StartError> {
    let mut simulation = Simulation::new(system, start, 0.0)?;
    Ok(Measured::of(&mut simulation, &effort.window(system), log))
}

/// Excitation periods that a measured trajectory is flown, part by part of at most so many impacts, until `goes_on` says
/// no, or it cannot be followed.
pub fn flown_while(
    system: &System,
    start: State,
    impacts: u64,
    mut goes_on: impl FnMut() -> bool,
) -> u64 {
    let Ok(mut simulation) = Simulation::new(system, start, 0.0) else { return 0 };
    let mut measurement = Measurement::begin(system, start);
    let followed = |stop| matches!(stop, Stop::EndTime | Stop::ImpactLimit);
    while goes_on() && followed(simulation.run(1, impacts, &mut measurement)) {}
    simulation.periods()
}
