//! The boundaries of the theory as clearances.

use crate::analysis::{Analysis, Boundaries};
use crate::orbits::Bifurcation;

/// A boundary as a clearance, over the case's own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundaryAt {
    /// Which one.
    pub kind: Bifurcation,
    /// Whether it ends the two asymmetric impacts, not the symmetric ones.
    pub of_asymmetric: bool,
    /// Its clearance over the case's.
    pub clearance: f64,
}

/// All boundaries at the case's frequency and forcing, by ascending clearance.
pub fn clearances(analysis: &Analysis) -> Vec<BoundaryAt> {
    clearances_of(&analysis.boundaries, analysis.system.forcing_per_clearance())
}

/// The same of boundaries at any frequency, for the forcing per clearance `gamma`.
pub fn clearances_of(boundaries: &Boundaries, gamma: f64) -> Vec<BoundaryAt> {
    let at =
        |of_asymmetric| move |(kind, at)| BoundaryAt { kind, of_asymmetric, clearance: gamma / at };
    let symmetric = boundaries.of_symmetric().map(at(false));
    let all = symmetric.chain(boundaries.of_asymmetric().map(at(true)));
    let mut all: Vec<BoundaryAt> =
        all.filter(|at| at.clearance.is_finite() && at.clearance > 0.0).collect();
    all.sort_by(|a, b| a.clearance.total_cmp(&b.clearance));
    all
}
