//! The layers against one another, claim by claim.

use serde::Serialize;

use super::scale::Scale;
use crate::method::Method;
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;
use crate::validation::{Claim, Finding, Measure, Verdict};

/// A claim and what came of it.
#[derive(Debug, Clone, Serialize)]
pub struct ClaimFacts {
    id: String,
    statement: String,
    source: &'static str,
    checked_by: Method,
    predicted: FindingFacts,
    observed: FindingFacts,
    /// Predicted minus observed: relative for lengths, in radians for angles.
    difference: Option<Quantity>,
    tolerance: Quantity,
    reason: String,
    verdict: Verdict,
}

/// One side of a comparison: a number, or an outcome.
#[derive(Debug, Clone, Serialize)]
struct FindingFacts {
    number: Option<Quantity>,
    words: Option<String>,
}

impl FindingFacts {
    fn of(scale: &Scale, finding: &Finding, method: Method) -> Self {
        let number = match finding {
            Finding::Number(value, Measure::LengthOverClearance) => {
                Some(scale.length(&of::CLAIMED_LENGTH, *value, method))
            }
            Finding::Number(value, Measure::Angle) => {
                Some(Quantity::new(&of::CLAIMED_ANGLE, *value, method))
            }
            Finding::Words(_) => None,
        };
        let words = match finding {
            Finding::Words(words) => Some(words.clone()),
            Finding::Number(..) => None,
        };
        Self { number, words }
    }
}

impl ClaimFacts {
    /// Of a claim.
    pub fn of(scale: &Scale, claim: &Claim) -> Self {
        let angle = matches!(claim.predicted, Finding::Number(_, Measure::Angle));
        let kind = if angle { &of::ANGLE_ERROR } else { &of::THEORY_ERROR };
        let observed_by = claim.checked_by;
        Self {
            id: claim.id.clone(),
            statement: claim.statement.clone(),
            source: claim.source,
            checked_by: claim.checked_by,
            predicted: FindingFacts::of(scale, &claim.predicted, Method::Theory),
            observed: FindingFacts::of(scale, &claim.observed, observed_by),
            difference: claim.difference.map(|value| Quantity::new(kind, value, Method::Theory)),
            tolerance: Quantity::new(
                if angle { &of::ANGLE_ERROR } else { &of::TOLERANCE },
                claim.tolerance.value,
                Method::Theory,
            ),
            reason: claim.tolerance.reason.clone(),
            verdict: claim.verdict,
        }
    }
}
