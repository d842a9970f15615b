//! The layers against one another, claim by claim.

use serde_json::{Value, json};

use crate::method::Method::{self, Simulation, Theory};
use crate::quantity::catalogue as of;
use crate::quantity::{Quantity, Units};
use crate::validation::{Claim, Finding};

/// A claim and what came of it. The difference is predicted minus observed: relative for lengths, in radians
/// for angles.
pub fn claim(units: &Units, claim: &Claim) -> Value {
    let angle = matches!(claim.predicted, Finding::Angle(_));
    let [kind, allowed] =
        if angle { [&of::ANGLE_ERROR; 2] } else { [&of::THEORY_ERROR, &of::TOLERANCE] };
    let (by, tolerance) = (claim.checked_by, claim.tolerance);
    let error = if by == Simulation { tolerance } else { 0.0 };
    let difference = claim.difference.map(|value| Quantity::new(kind, value, Theory));
    json!({
        "id": claim.id,
        "statement": claim.statement,
        "checked_by": by,
        "predicted": finding(units, &claim.predicted, Theory, 0.0),
        "observed": finding(units, &claim.observed, by, error),
        "difference": difference.map(|difference| difference.with_error(error)),
        "tolerance": Quantity::new(allowed, tolerance, Theory),
        "reason": claim.reason,
        "verdict": claim.verdict,
    })
}

/// One side of a comparison: a number, or an outcome. A simulation is as exact as the claim asks for: relative
/// to lengths, in radians for angles.
fn finding(units: &Units, finding: &Finding, method: Method, error: f64) -> Value {
    match finding {
        Finding::Length(value) => {
            let errors = [*value, error * value.abs()];
            json!({ "number": units.quantity_with(&of::CLAIMED_LENGTH, errors, method), "outcome": null })
        }
        Finding::Angle(value) => {
            let angle = Quantity::new(&of::CLAIMED_ANGLE, *value, method).with_error(error);
            json!({ "number": angle, "outcome": null })
        }
        outcome => json!({ "number": null, "outcome": outcome }),
    }
}
