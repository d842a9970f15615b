//! What shows that the product can be trusted, and on which the product does not depend: the paper's figures
//! compared one by one, the simulation at the ends of its range, and a reference in 77 decimal digits.
//!
//! For the program itself: this module may change at any time.

pub mod extremes;
pub mod paper;
pub mod reference;
