//! Analysis, event-driven simulation and design reports for vibro-impact nonlinear energy sinks.
#![warn(missing_docs)]
#![forbid(unsafe_code)]

pub mod analysis;
pub mod band;
pub mod bifurcation;
pub mod case;
pub mod criteria;
pub mod diff;
pub mod digest;
pub mod equations;
pub mod evidence;
pub mod executor;
pub mod method;
mod names;
pub mod numerics;
pub mod operation_count;
pub mod optimize;
pub mod orbits;
pub mod quantity;
pub mod regimes;
pub mod report;
pub mod simulation;
pub mod store;
pub mod study;
pub mod sweep;
pub mod symbolic;
pub mod system;
pub mod validation;
