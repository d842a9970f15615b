//! Claims about the boundaries around the case: where they lie.

use super::asymptotic_error::{AsymptoticError, asymptotic_errors};
use super::tolerance::{SAYS_NOTHING, asymptotic_error};
use super::{Claim, Reason, Statement};
use crate::analysis::{Analysis, Boundaries};
use crate::orbits::{Bifurcation, FullSystem};

/// Boundaries further than this factor in clearance are not this case's business.
const FAR: f64 = 3.0;

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

/// Where each boundary of steady 1:1 resonance lies, against the exact one.
pub fn positions(analysis: &Analysis, exact: &FullSystem) -> Vec<Claim> {
    let tolerance = 2.0 * asymptotic_error(&analysis.system);
    let reason = Reason::TwoConditions { says_nothing: tolerance > SAYS_NOTHING };
    let near = |boundary: &AsymptoticError| (1.0 / FAR..FAR).contains(&boundary.place());
    asymptotic_errors(analysis, exact)
        .into_iter()
        .filter(|boundary| boundary.bounds_stability || boundary.of_asymmetric)
        .filter(near)
        .filter_map(|boundary| {
            let statement = Statement::Boundary { bifurcation: boundary.kind };
            let places = [boundary.theory?, boundary.exact?];
            Some(Claim::of_number(statement, places, tolerance, reason))
        })
        .collect()
}
