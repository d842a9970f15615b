//! Confronts what the theory claims with what simulation shows, claim by claim.
//!
//! Each claim is predicted without simulation and observed without theory. The theory is
//! asymptotic: its error grows in proportion to the mass ratio, and the tolerance of each claim says
//! how. A refuted claim is a result, not an error. Only claims that the case raises are simulated.

pub mod boundaries;
pub mod motions;
pub mod tolerance;

use serde::Serialize;

pub use tolerance::Tolerance;

use crate::analysis::Analysis;
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
    /// In simulation.
    pub observed: Finding,
    /// Relative difference for lengths, absolute for angles.
    pub difference: Option<f64>,
    /// How much difference the theory allows, and why.
    pub tolerance: Tolerance,
    /// The outcome.
    pub verdict: Verdict,
}

/// Confronts the analysis with the attractors that were found, and with the few further simulations
/// that its own claims ask for.
///
/// # Errors
/// [`StartError`] if a predicted motion lies outside the cavity.
pub fn confront(
    analysis: &Analysis,
    attractors: &[FoundAttractor],
    effort: &Effort,
) -> Result<Vec<Claim>, StartError> {
    let mut claims = motions::fixed_points(analysis, effort)?;
    claims.extend(motions::rest(analysis, effort)?);
    claims.extend(motions::area(analysis, attractors));
    claims.extend(boundaries::either_side(analysis, effort)?);
    Ok(claims)
}
