//! One trajectory from a start, where a user wants to see that and nothing else.

use crate::motions::Effort;
pub use crate::motions::{Measured, Window, orbit_of};
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
