//! The simulation at the ends of its range.
pub mod measure;
pub use measure::{Comparison, MeasureError, Measured, Run};
