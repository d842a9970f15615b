//! Flights that are not steady, of the structure with its absorber: released or struck ([`Ringdown`]), swept through
//! resonance ([`Passage`]), driven by a record piece by piece ([`follow`]).
//!
//! Lengths over the clearance, fast time `tau = omega0 t`, as everywhere. Each flight is one start of the event engine;
//! where in its cavity the absorber is at the beginning nobody knows, so that many are flown ([`share_above`]). Beside
//! them stand the places from which no wall ever reaches the absorber ([`Inactive`]), and theory ([`Predicted`]).
//! Nothing here knows of case files; the structure without absorber is in [`crate::linear`].

mod driven;
mod inactive;
mod places;
mod ringdown;
mod sweep;
mod theory;

pub use driven::follow_from;
pub use driven::{DrivenError, follow};
pub use inactive::Inactive;
pub use inactive::inactive;
pub use places::{Measure, Places, even, survey};
pub use places::{share_above, with_closer, worst_of_places};
pub use ringdown::Ringdown;
pub use theory::Predicted;

pub use crate::linear::{Passage, Response, STEPS};
use crate::system::{InvalidParameter, Parameters, System};

/// A system without excitation, whose "period" is a step of time.
fn unforced(system: &System, step: f64) -> Result<System, InvalidParameter> {
    System::new(Parameters {
        forcing_per_clearance: 0.0,
        frequency_ratio: std::f64::consts::TAU / step,
        ..system.parameters()
    })
}
