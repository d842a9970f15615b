//! What becomes of a case that is not driven steadily: a structure that is released or struck, and comes to rest
//! ([`DecayStudy`]); one that is swept through its resonance ([`SweepStudy`]); one that a record or noise drives
//! ([`RecordStudy`]).
//!
//! Lengths over the clearance, fast time `tau = omega0 t`, as everywhere. The *amplitude* of the structure at a
//! time is `sqrt(x^2 + x'^2)`, the root of its own energy: that of the vibration that it would go on with alone.
//! What it does depends on where in its cavity the absorber is at the beginning, which nobody knows: it is
//! simulated from places all over the cavity ([`crate::flights`]), and the worst counts. Beside it stand the structure
//! alone and a tuned mass damper of the same mass ([`crate::linear`]), and theory ([`crate::flights::Predicted`]).

mod clearance;
mod flight;
mod passage;
mod record_study;
mod study;

pub use clearance::{Best, RELEASES, best_clearance, looked_at};
pub use flight::Flight;
pub(crate) use passage::worst;
pub use passage::{ByRate, Jump, SweepStart, SweepStudy};
pub use record_study::{Measured, Realisation, RecordStudy, SpectrumPoint};
pub(crate) use study::followed;
pub use study::{Decay, DecayStudy, DecayTime};

use crate::case::Case;
use crate::excitation::Transient;
use crate::executor::Executor;
use crate::flights::DrivenError;
use crate::simulation::StartError;

/// What became of a structure that is not driven steadily.
#[derive(Debug, Clone)]
pub enum Study {
    /// One that was released or struck.
    Release(Box<DecayStudy>),
    /// One that was swept through resonance.
    Sweep(Box<SweepStudy>),
    /// One that a record drove.
    Record(Box<RecordStudy>),
}

impl Study {
    /// Studies a case that is not driven steadily; none for another.
    ///
    /// # Errors
    /// [`DrivenError`] where the motion is so large that rounding hides the walls, or samples are missing.
    pub fn of_case(case: &Case, executor: &dyn Executor) -> Option<Result<Self, DrivenError>> {
        let boxed = |done: Result<Self, StartError>| done.map_err(DrivenError::from);
        match case.design.transient()? {
            Transient::Release(_) => DecayStudy::of_case(case, executor)
                .map(|done| boxed(done.map(|study| Self::Release(Box::new(study))))),
            Transient::Sweep(_) => SweepStudy::of_case(case, executor)
                .map(|done| boxed(done.map(|study| Self::Sweep(Box::new(study))))),
            Transient::Record(_) => RecordStudy::of_case(case, executor)
                .map(|done| done.map(|study| Self::Record(Box::new(study)))),
        }
    }
}

/// Starts that count: where `inactive` is false those alone in which the absorber hits a wall, unless it never does.
fn counted<T>(starts: &[T], inactive: bool, impacts: impl Fn(&T) -> u64) -> Vec<&T> {
    let awake: Vec<&T> = starts.iter().filter(|start| inactive || impacts(start) > 0).collect();
    if awake.is_empty() { starts.iter().collect() } else { awake }
}
