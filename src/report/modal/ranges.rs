//! How far numbers of the case may change, as rows.

use serde_json::{Value, json};

use super::figure::{heading, in_rows};
use super::units;
use crate::case::{ModalCase, is_of_absorber};
use crate::method::Method;
use crate::modal::ModalAnswer;
use crate::operating_range::{Combined, Uncertain, Varied, Varies};
use crate::quantity::{Kind, Quantity};
use crate::report::choice;
use crate::report::document::{range, reliability, together};
use crate::report::figure::Figure;
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

/// What holds where the amplitude of a load and the natural frequencies change at once.
pub(super) fn combined(case: &ModalCase, answer: &ModalAnswer) -> Vec<Value> {
    let row = |found: &Combined| {
        let number = Parameter::Amplitude;
        placed(case, number, found.of, together(found, kinds(case, found.of)))
    };
    answer.combined.iter().map(row).collect()
}

/// What an amplitude of a load and the natural frequencies are.
fn kinds(case: &ModalCase, of: Option<usize>) -> [&'static Kind; 2] {
    [(Parameter::Amplitude, of), (Parameter::NaturalFrequency, None)]
        .map(|(number, of)| case.kind_of(number, of))
}

/// The same drawn, a panel for each load; none where that was not looked for.
pub(super) fn figure(case: &ModalCase, answer: &ModalAnswer, facts: &Value) -> Option<Figure> {
    let mut panels = Vec::new();
    for along in answer.holds_for.iter().filter(|one| one.parameter == Varied::Amplitude) {
        let here = answer.combined.iter().filter(|one| one.of == along.of).copied();
        let here: Vec<Combined> = here.collect();
        let own = [along.value, case.number(Parameter::NaturalFrequency, None)?];
        let frequency =
            answer.holds_for.iter().find(|one| one.parameter == Varied::NaturalFrequency);
        let hold = [along.holds, frequency.and_then(|one| one.holds)];
        let kinds = kinds(case, along.of);
        let k = along.of.unwrap_or_default();
        let panel = choice::combined_panel(units(case), kinds, own, &here, hold);
        panels.extend(panel.map(|panel| panel.with_heading(heading(case, k, &case.loads[k]))));
    }
    choice::combined(panels, facts).map(in_rows)
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
