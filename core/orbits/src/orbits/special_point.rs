//! Where a branch of orbits bifurcates.

use serde::Serialize;

use super::orbit::Orbit;
use crate::bifurcation::Bifurcation;

/// A located bifurcation on a branch.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SpecialPoint {
    /// Which.
    pub kind: Bifurcation,
    /// Value of the branch's parameter.
    pub value: f64,
    /// Values of the parameter between which it was located.
    pub bracket: [f64; 2],
    /// Width, over the parameter, to which it was located.
    pub precision: f64,
    /// The test function before, at and after it.
    pub test: [f64; 3],
    /// Whether the test function really vanishes there, rather than jump.
    pub converged: bool,
    /// The sequence of walls beyond, where an impact appears or disappears and Newton's method found
    /// the orbit that goes on.
    pub sequence_beyond: Option<String>,
    /// The orbit there.
    pub orbit: Orbit,
}
