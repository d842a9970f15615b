//! What the layers of `vinesink-core` share: systems, equations and numerical methods.
//!
//! For `vinesink-core` and the program: use that crate, which has all of this under the same names. Modules here may change
//! at any time.
#![warn(missing_docs)]
#![forbid(unsafe_code)]

pub mod bifurcation;
pub mod equations;
pub mod executor;
pub mod method;
#[doc(hidden)]
pub mod names;
#[doc(hidden)]
pub mod numerics;
pub mod operation_count;
pub mod symbolic;
pub mod system;
