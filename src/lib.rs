//! Analysis, event-driven simulation and design reports for vibro-impact nonlinear energy sinks.
#![warn(missing_docs)]
#![forbid(unsafe_code)]

pub mod report;
pub mod system;
