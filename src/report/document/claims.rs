//! The layers against one another, claim by claim.

use serde::Serialize;

use super::scale::Scale;
use crate::method::Method;
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;
use crate::validation::{Claim, Finding, Reason, Statement, Verdict};

/// A claim and what came of it.
#[derive(Debug, Clone, Serialize)]
pub struct ClaimFacts {
    id: String,
    statement: Statement,
    checked_by: Method,
    predicted: FindingFacts,
    observed: FindingFacts,
    /// Predicted minus observed: relative for lengths, in radians for angles.
    difference: Option<Quantity>,
    tolerance: Quantity,
    reason: Reason,
    verdict: Verdict,
}

/// One side of a comparison: a number, or an outcome.
#[derive(Debug, Clone, Serialize)]
struct FindingFacts {
    number: Option<Quantity>,
    outcome: Option<Finding>,
}

impl FindingFacts {
    /// A simulation is as exact as the claim asks for: relative to lengths, in radians for angles.
    fn of(scale: &Scale, finding: &Finding, method: Method, tolerance: f64) -> Self {
        let tolerance = if method == Method::Simulation { tolerance } else { 0.0 };
        let number = match finding {
            Finding::Length(value) => {
                let errors = [*value, tolerance * value.abs()];
                Some(scale.length_with(&of::CLAIMED_LENGTH, errors, method))
            }
            Finding::Angle(value) => {
                Some(Quantity::new(&of::CLAIMED_ANGLE, *value, method).with_error(tolerance))
            }
            _ => None,
        };
        let outcome = number.is_none().then(|| finding.clone());
        Self { number, outcome }
    }
}

impl ClaimFacts {
    /// Of a claim.
    pub fn of(scale: &Scale, claim: &Claim) -> Self {
        let angle = matches!(claim.predicted, Finding::Angle(_));
        let kind = if angle { &of::ANGLE_ERROR } else { &of::THEORY_ERROR };
        let observed_by = claim.checked_by;
        Self {
            id: claim.id.clone(),
            statement: claim.statement,
            checked_by: claim.checked_by,
            predicted: FindingFacts::of(scale, &claim.predicted, Method::Theory, 0.0),
            observed: FindingFacts::of(scale, &claim.observed, observed_by, claim.tolerance),
            difference: claim.difference.map(|value| {
                let simulated = observed_by == Method::Simulation;
                let error = if simulated { claim.tolerance } else { 0.0 };
                Quantity::new(kind, value, Method::Theory).with_error(error)
            }),
            tolerance: Quantity::new(
                if angle { &of::ANGLE_ERROR } else { &of::TOLERANCE },
                claim.tolerance,
                Method::Theory,
            ),
            reason: claim.reason,
            verdict: claim.verdict,
        }
    }
}
