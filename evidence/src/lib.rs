//! What shows that vinesink can be trusted, and on which it does not depend: the paper's figures compared one by
//! one, every layer at the ends of its ranges, and a reference in 77 decimal digits.
//!
//! For the program `vinesink-evidence` and for tests: everything here may change at any time.
#![warn(missing_docs)]
#![forbid(unsafe_code)]

pub mod extremes;
pub mod paper;
pub mod reference;
