//! How far numbers of the case may change, as rows.

use serde_json::{Value, json};

use crate::case::{ModalCase, is_of_absorber};
use crate::method::Method;
use crate::modal::ModalAnswer;
use crate::operating_range::{Uncertain, Varies};
use crate::quantity::Quantity;
use crate::report::document::{range, reliability};
use crate::system::Parameter;

/// A row about a number with which absorber or load it is of, where there are several, and that it is of all modes.
fn placed(case: &ModalCase, number: Parameter, part: Option<usize>, mut row: Value) -> Value {
    let of_absorber = is_of_absorber(number);
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
        let number = case.parameter(found.parameter)?;
        let (row, told) = range(found, case.kind_of(number, found.of), !case.reduced);
        let placed = |row: Value| placed(case, number, found.of, row);
        Some((placed(row), placed(told)))
    });
    each.unzip()
}

/// With which probability its criteria hold; null where that is not known.
pub(super) fn probability(case: &ModalCase, answer: &ModalAnswer) -> Value {
    let told = |one: &Uncertain| {
        let value = case.number(one.parameter, one.of).unwrap_or_default();
        let kind = case.kind_of(one.parameter, one.of);
        let row = json!({ "value": Quantity::new(kind, value, Method::Given) });
        placed(case, one.parameter, one.of, row)
    };
    json!(answer.reliability.as_ref().map(|one| reliability(one, &told)))
}
