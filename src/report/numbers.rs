//! Numbers as text; they live beside the catalogue.
pub use crate::quantity::numbers::*;
