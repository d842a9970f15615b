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

pub use driven::{DrivenError, follow, follow_from};
pub use inactive::{Inactive, inactive};
pub use places::{PlaceReading, Places, even, share_above, survey, with_closer, worst_of_places};
pub use ringdown::Ringdown;
pub use theory::Predicted;

use crate::excitation::Scene;
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

/// Seconds for an oscillation on the way to rest, a period of a sweep or a piece of a record from one place of the
/// absorber, measured in the release profile on one core of an ARM server: 2.8, 1.6 and 0.3 us with some impacts each.
pub const fn seconds_of(scene: Scene) -> f64 {
    match scene {
        Scene::Release => 3e-6,
        Scene::Steady | Scene::Sweep => 1.6e-6,
        Scene::Record => 0.4e-6,
    }
}
