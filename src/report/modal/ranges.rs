//! How far numbers of the case may change, as rows.

use serde_json::{Value, json};

use crate::case::ModalCase;
use crate::method::Method;
use crate::modal::{ModalAnswer, parameter};
use crate::operating_range::Uncertain;
use crate::quantity::catalogue as of;
use crate::quantity::{Kind, Quantity};
use crate::report::document::{range, reliability};
use crate::system::Parameter;

/// What a number is.
fn kind_of(case: &ModalCase, number: Parameter, of: Option<usize>) -> &'static Kind {
    match number {
        Parameter::Amplitude => case.loads[of.unwrap_or_default()].amplitude_kind(),
        Parameter::NaturalFrequency => &of::NATURAL_FREQUENCY,
        Parameter::DampingRatio => &of::DAMPING_RATIO,
        Parameter::Mass => &of::OSCILLATOR_MASS,
        Parameter::Restitution => &of::RESTITUTION,
        Parameter::AbsorberMass => &of::ABSORBER_MASS,
        _ => &of::CLEARANCE,
    }
}

/// A row about a number with which absorber or load it is of, where there are several, and that it is of all modes.
fn placed(case: &ModalCase, number: Parameter, part: Option<usize>, mut row: Value) -> Value {
    let of_absorber =
        matches!(number, Parameter::Clearance | Parameter::Restitution | Parameter::AbsorberMass);
    match part {
        Some(k) if of_absorber => row["absorber"] = json!(k + 1),
        Some(k) => row["load"] = json!(k + 1),
        // The first mode's, and all others in proportion.
        None if !of_absorber && number != Parameter::Amplitude && case.modes.len() > 1 => {
            row["of_all_modes"] = json!(true);
        }
        None => {}
    }
    row
}

/// The ranges of a case: rows as CONTRACT.md has them, and facts of the templates.
pub(super) fn rows(case: &ModalCase, answer: &ModalAnswer) -> (Vec<Value>, Vec<Value>) {
    let each = answer.holds_for.iter().filter_map(|found| {
        let number = parameter(found.parameter)?;
        let (row, told) = range(found, kind_of(case, number, found.of), !case.reduced);
        let placed = |row: Value| placed(case, number, found.of, row);
        Some((placed(row), placed(told)))
    });
    each.unzip()
}

/// With which probability its criteria hold; null where that is not known.
pub(super) fn probability(case: &ModalCase, answer: &ModalAnswer) -> Value {
    let told = |one: &Uncertain| {
        let value = case.number(one.parameter, one.of).unwrap_or_default();
        let kind = kind_of(case, one.parameter, one.of);
        let row = json!({ "value": Quantity::new(kind, value, Method::Given) });
        placed(case, one.parameter, one.of, row)
    };
    json!(answer.reliability.as_ref().map(|one| reliability(one, &told)))
}
