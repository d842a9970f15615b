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
use crate::analysis::motion::wrapped;
use crate::method::Method;
use crate::orbits::FullSystem;
use crate::regimes::{FoundAttractor, Window};
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
    /// By the layer that checks it.
    pub observed: Finding,
    /// That layer.
    pub checked_by: Method,
    /// The error of the claim: predicted minus observed, relative to the observed for lengths, absolute
    /// for angles. How far an orbit misses itself has no sign.
    pub difference: Option<f64>,
    /// How large an error is allowed, and why.
    pub tolerance: Tolerance,
    /// The outcome.
    pub verdict: Verdict,
}

impl Claim {
    /// About an outcome that either happens or does not: what was predicted and what observed, and `why` that
    /// tells whether it `holds`.
    fn of_outcome(
        [id, statement]: [String; 2],
        source: &'static str,
        [predicted, observed]: [String; 2],
        checked_by: Method,
        why: impl Into<String>,
        holds: bool,
    ) -> Self {
        Self {
            id,
            statement,
            source,
            predicted: Finding::Words(predicted),
            observed: Finding::Words(observed),
            checked_by,
            difference: None,
            tolerance: tolerance::outcome(why),
            verdict: Verdict::of(holds),
        }
    }

    /// About a number: what was predicted and what observed.
    fn of_number(
        [id, statement]: [String; 2],
        source: &'static str,
        [predicted, observed]: [f64; 2],
        measure: Measure,
        checked_by: Method,
        tolerance: Tolerance,
    ) -> Self {
        let difference = match measure {
            Measure::Angle => wrapped(predicted - observed),
            Measure::LengthOverClearance => predicted / observed - 1.0,
        };
        Self {
            id,
            statement,
            source,
            predicted: Finding::Number(predicted, measure),
            observed: Finding::Number(observed, measure),
            checked_by,
            difference: Some(difference),
            verdict: tolerance.judge(difference),
            tolerance,
        }
    }
}

/// Confronts the theory with the exact orbits, and nothing with simulation.
pub fn confront_theory(analysis: &Analysis, exact: &FullSystem) -> Vec<Claim> {
    let mut claims = motions::fixed_points(analysis, exact);
    claims.extend(boundaries::positions(analysis, exact));
    claims
}

/// Confronts the exact orbits with simulation, and them and the theory with the attractors that were found.
///
/// # Errors
/// [`StartError`] if a predicted motion lies outside the cavity.
pub fn confront_simulation(
    analysis: &Analysis,
    exact: &FullSystem,
    attractors: &[FoundAttractor],
    window: &Window,
) -> Result<Vec<Claim>, StartError> {
    let mut claims = orbits::simulated(exact)?;
    claims.extend(orbits::limits(exact)?);
    claims.extend(motions::rest(analysis, window)?);
    claims.extend(motions::area(analysis, attractors));
    Ok(claims)
}
