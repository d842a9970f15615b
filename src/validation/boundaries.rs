//! Claims about the boundaries around the case: where they lie.

use super::asymptotic_error::{AsymptoticError, asymptotic_errors};
use super::tolerance::{SAYS_NOTHING, asymptotic_error};
use super::{Claim, Reason, Statement};
use crate::analysis::Analysis;
use crate::orbits::FullSystem;

/// Boundaries further than this factor in clearance are not this case's business.
const FAR: f64 = 3.0;

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
