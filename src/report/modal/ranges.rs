//! How far numbers of the case may change, as rows.

use serde_json::{Value, json};

use crate::case::ModalCase;
use crate::modal::ModalAnswer;
use crate::operating_range::{HoldsFor, Varied};
use crate::quantity::Kind;
use crate::quantity::catalogue as of;
use crate::report::document::range;

/// What a number is.
fn kind_of(case: &ModalCase, found: &HoldsFor) -> &'static Kind {
    match found.parameter {
        Varied::Amplitude => case.loads[found.of.unwrap_or_default()].amplitude_kind(),
        Varied::NaturalFrequency => &of::NATURAL_FREQUENCY,
        Varied::Damping => &of::DAMPING_RATIO,
        Varied::Mass => &of::OSCILLATOR_MASS,
        Varied::Restitution => &of::RESTITUTION,
        _ => &of::CLEARANCE,
    }
}

/// The ranges of a case: rows as CONTRACT.md has them, and facts of the templates.
pub(super) fn rows(case: &ModalCase, answer: &ModalAnswer) -> (Vec<Value>, Vec<Value>) {
    let each = answer.holds_for.iter().map(|found| {
        let of_part = match found.parameter {
            Varied::Amplitude => Some("load"),
            Varied::Clearance | Varied::Restitution => Some("absorber"),
            _ => None,
        };
        let named = |mut row: Value| {
            match (of_part, found.of) {
                (Some(part), Some(k)) => row[part] = json!(k + 1),
                // The first mode's, and all others in proportion.
                (None, _) if case.modes.len() > 1 => row["of_all_modes"] = json!(true),
                _ => {}
            }
            row
        };
        let (row, told) = range(found, kind_of(case, found), !case.reduced);
        (named(row), named(told))
    });
    each.unzip()
}
