//! Flights from impact to impact, and what they come to: the layer of simulation of `vinesink-core`.
//!
//! For `vinesink-core` and the program: use that crate, which has all of this under the same names. Modules here may change
//! at any time.
#![warn(missing_docs)]
#![forbid(unsafe_code)]

pub mod regimes;
pub mod simulation;

use vinesink_base::{numerics, operation_count, system};
