//! Confronts the layers with one another, claim by claim.
//!
//! What the slow flow claims is checked against the exact orbits of the full system, which need no
//! simulation; what the exact orbits claim is checked by simulations started on them; only what no
//! orbit can decide is left to long simulations. The theory is asymptotic: its error grows in
//! proportion to the mass ratio, and the tolerance of each claim says how. A refuted claim is a
//! result, not an error. Only claims that the case raises are checked. Their words are in
//! `templates/components.tera`.
//!
//! For the program itself: this module may change at any time.

pub mod asymptotic_error;
pub mod boundaries;
pub mod cavity;
mod claim;
pub mod motions;
pub mod orbits;
pub mod tolerance;

pub use asymptotic_error::AsymptoticError;
pub use claim::{Claim, Finding, NearBoundary, Reached, Reason, Statement, Verdict};

use crate::analysis::Analysis;
use crate::band::Inactive;
use crate::band::inactive::Rest;
use crate::orbits::FullSystem;
use crate::regimes::{FoundAttractor, Window};
use crate::simulation::StartError;

/// Confronts the theory with the exact orbits, and nothing with simulation: the theory of the case's own cavity.
pub fn confront_theory(analysis: &Analysis, exact: &FullSystem) -> Vec<Claim> {
    if !exact.system.cavity().is_ideal() {
        return cavity::fixed_points(exact);
    }
    let mut claims = motions::fixed_points(analysis, exact);
    claims.extend(boundaries::positions(analysis, exact));
    claims
}

/// Confronts the exact orbits with simulation, and them and the theory with the attractors that were found. Areas are
/// those of an ideal cavity, and claim nothing of another one.
///
/// # Errors
/// [`StartError`] if a predicted motion lies outside the cavity.
pub fn confront_simulation(
    analysis: &Analysis,
    exact: &FullSystem,
    inactive: Option<&Inactive>,
    attractors: &[FoundAttractor],
    window: &Window,
) -> Result<Vec<Claim>, StartError> {
    let mut claims = orbits::simulated(exact)?;
    if !exact.system.cavity().is_ideal() {
        claims.extend(match inactive.map(|known| known.rest) {
            // Ends that differ leave an absorber at rest alone.
            Some(Rest::Floating) => motions::rest(analysis, window)?,
            _ => cavity::inactive(&exact.system, inactive, window)?,
        });
        return Ok(claims);
    }
    claims.extend(orbits::limits(exact)?);
    claims.extend(motions::rest(analysis, window)?);
    claims.push(motions::area(analysis, attractors));
    Ok(claims)
}
