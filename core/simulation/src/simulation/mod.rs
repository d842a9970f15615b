//! Direct, event-driven simulation of the full system, equations (1) and (2): layer 0.
//!
//! Between events the motion is closed form ([`flow`]); events are found by a search that cannot
//! step over one, in panels of two phasors (`phasor`), as the root of a series where a flight comes
//! back to its wall at once (`returns`), or step by step (`numerics/crossing.rs`); what happens at a
//! wall is in [`contact`]; [`Simulation`] strings it together and tells observers. Several modes and several absorbers
//! move by [`ModalSimulation`], with the same proof for each absorber. Nothing here knows
//! of the asymptotic theory.

pub mod batch;
mod certificate;
pub mod contact;
mod contact_end;
mod events;
pub mod flow;
mod history;
mod integrals;
mod landing;
mod modal;
mod panels;
mod path;
mod peaks;
mod phasor;
mod returns;
mod roots;
mod run;
mod shaking;
mod sliding;
mod small;
mod statistics;
mod steps;
mod tangent;
pub mod trust;
mod walls;

pub use contact::ContactTolerance;
pub use events::{AbsorberMotion, Detail, Impact, Observer, Reversal, Segment, Side, StartError};
pub use history::{ImpactLog, Trace, TracePoint};
pub use modal::{
    ModalImpact, ModalMeter, ModalObserver, ModalSegment, ModalSimulation, ModalStartError,
    ModalTrace, Reading, Sensor, SensorRecord,
};
pub use run::{Simulation, Stop};
pub use shaking::ShakingMeter;
#[doc(hidden)]
pub use statistics::{Course, lost_in};
pub use statistics::{Energy, Measurement, PeriodRecord, Statistics, SustainedContact};
pub(crate) use statistics::{WallRun, share_of_impacts};
pub use tangent::Tangent;
pub use trust::{Doubt, doubts};
