//! Exact orbits and branches of them, where a user follows one along a parameter.

pub use crate::orbits::branch::{BranchDirection, Settings, follow};
pub use crate::orbits::{Branch, BranchEnd, FullSystem, ImpactMap, Orbit, Peaks};
