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
pub mod clearances;
pub mod motions;
pub mod orbits;
pub mod tolerance;

pub use asymptotic_error::AsymptoticError;
pub use claim::{Claim, Finding, NearBoundary, ReachedMotion, Reason, Statement, Verdict};

use crate::analysis::Analysis;
use crate::motions::{Measured, Motion, Motions, RestKind, Window};
use crate::orbits::FullSystem;
use crate::simulation::StartError;

/// Confronts the theory with the exact orbits, and nothing with simulation: the theory of the case's own cavity.
pub fn confront_theory(analysis: &Analysis, exact: &FullSystem) -> Vec<Claim> {
    if let Some(cavity) = &analysis.cavity {
        return cavity::fixed_points(cavity, exact);
    }
    let mut claims = motions::fixed_points(analysis, exact);
    claims.extend(boundaries::positions(analysis, exact));
    claims
}

/// Confronts the exact orbits with simulation, and them and the theory with the motions that were found, each of which was
/// measured. Areas are those of an ideal cavity, and claim nothing of another one.
///
/// # Errors
/// [`StartError`] if a predicted motion lies outside the cavity.
pub fn confront_simulation(
    analysis: &Analysis,
    exact: &FullSystem,
    found: &Motions,
    measured: &[Measured],
    window: &Window,
) -> Result<Vec<Claim>, StartError> {
    let mut claims = orbits::simulated(exact)?;
    if !exact.system.cavity().is_ideal() {
        let rest = found.rest().filter(|rest| rest.is_solved());
        claims.extend(match rest.and_then(Motion::rest).map(|known| known.rest) {
            // Ends that differ leave an absorber at rest alone.
            Some(RestKind::Floating) => motions::rest(analysis, window)?,
            _ => cavity::at_rest(&exact.system, rest, window)?,
        });
        return Ok(claims);
    }
    claims.extend(orbits::limits(exact)?);
    claims.extend(motions::rest(analysis, window)?);
    claims.push(motions::area(analysis, found, measured));
    Ok(claims)
}
