//! Theory of first order and exact periodic orbits: the layers of `vinesink-core` that simulate nothing.
//!
//! For `vinesink-core` and the program: use that crate, which has all of this under the same names. Modules here may change
//! at any time.
#![warn(missing_docs)]
#![forbid(unsafe_code)]

pub mod analysis;
pub mod cavity;
pub mod orbits;

use vinesink_base::{
    bifurcation, equations, executor, numerics, operation_count, symbolic, system,
};
