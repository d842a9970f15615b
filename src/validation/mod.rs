//! Confronts the layers with one another, claim by claim.
//!
//! What the slow flow claims is checked against the exact orbits of the full system, which need no
//! simulation; what the exact orbits claim is checked by simulations started on them; only what no
//! orbit can decide is left to long simulations. The theory is asymptotic: its error grows in
//! proportion to the mass ratio, and the tolerance of each claim says how. A refuted claim is a
//! result, not an error. Only claims that the case raises are checked.

pub mod asymptotic_error;
pub mod boundaries;
pub mod motions;
pub mod orbits;
pub mod tolerance;

use serde::Serialize;

pub use asymptotic_error::AsymptoticError;
pub use tolerance::Tolerance;

use crate::analysis::Analysis;
use crate::orbits::FullSystem;
use crate::regimes::FoundAttractor;
use crate::regimes::attractor::Effort;
use crate::simulation::StartError;

/// What a comparison came to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Prediction and observation agree within the tolerance.
    Confirmed,
    /// They do not.
    Refuted,
    /// The simulation did not give an answer that could decide.
    Undecided,
}

impl Verdict {
    fn of(holds: bool) -> Self {
        if holds { Self::Confirmed } else { Self::Refuted }
    }

    /// The name in a report.
    pub fn words(self) -> &'static str {
        match self {
            Self::Confirmed => "confirmed",
            Self::Refuted => "refuted",
            Self::Undecided => "undecided",
        }
    }
}

/// The layer that a claim is checked by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Check {
    /// The exact orbits of the full system.
    ExactOrbit,
    /// Direct simulation.
    Simulation,
}

impl Check {
    /// The name in a report.
    pub fn words(self) -> &'static str {
        match self {
            Self::ExactOrbit => "exact orbit",
            Self::Simulation => "simulation",
        }
    }
}

/// What a number in a claim measures; decides its unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Measure {
    /// A length over the clearance.
    LengthOverClearance,
    /// An angle in radians.
    Angle,
}

/// One side of a comparison.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Finding {
    /// A number.
    Number(f64, Measure),
    /// An outcome in words.
    Words(String),
}

/// A claim, what was predicted, what was observed, and what that means.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Claim {
    /// A stable name.
    pub id: String,
    /// What is claimed.
    pub statement: String,
    /// Layer and equation that claim it.
    pub source: &'static str,
    /// By the theory.
    pub predicted: Finding,
    /// By the layer that checks it.
    pub observed: Finding,
    /// That layer.
    pub checked_by: Check,
    /// The error of the claim: predicted minus observed, relative to the observed for lengths, absolute
    /// for angles. How far an orbit misses itself has no sign.
    pub difference: Option<f64>,
    /// How large an error is allowed, and why.
    pub tolerance: Tolerance,
    /// The outcome.
    pub verdict: Verdict,
}

/// Confronts the theory with the exact orbits, and nothing with simulation.
pub fn confront_theory(analysis: &Analysis, exact: &FullSystem) -> Vec<Claim> {
    let mut claims = motions::fixed_points(analysis, exact);
    claims.extend(boundaries::positions(analysis, exact));
    claims
}

/// Confronts the theory with the exact orbits, the exact orbits with simulation, and both with the
/// attractors that were found.
///
/// # Errors
/// [`StartError`] if a predicted motion lies outside the cavity.
pub fn confront(
    analysis: &Analysis,
    exact: &FullSystem,
    attractors: &[FoundAttractor],
    effort: &Effort,
) -> Result<Vec<Claim>, StartError> {
    let mut claims = confront_theory(analysis, exact);
    claims.extend(orbits::simulated(exact)?);
    claims.extend(orbits::limits(exact)?);
    claims.extend(motions::rest(analysis, effort)?);
    claims.extend(motions::area(analysis, attractors));
    Ok(claims)
}
