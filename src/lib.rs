//! Analysis, event-driven simulation and design reports for vibro-impact nonlinear energy sinks.
#![warn(missing_docs)]
#![forbid(unsafe_code)]

pub mod analysis;
#[cfg(feature = "case")]
pub mod band;
pub mod bifurcation;
#[cfg(feature = "case")]
pub mod case;
#[cfg(feature = "case")]
pub mod criteria;
#[cfg(feature = "report")]
pub mod diff;
#[cfg(feature = "case")]
pub mod digest;
pub mod equations;
#[cfg(feature = "report")]
pub mod evidence;
pub mod executor;
pub mod method;
mod names;
pub mod numerics;
pub mod operation_count;
#[cfg(feature = "case")]
pub mod optimize;
pub mod orbits;
pub mod quantity;
pub mod regimes;
#[cfg(feature = "report")]
pub mod report;
pub mod simulation;
#[cfg(feature = "report")]
pub mod store;
#[cfg(feature = "case")]
pub mod study;
#[cfg(feature = "sweep")]
pub mod sweep;
pub mod symbolic;
pub mod system;
pub mod validation;
