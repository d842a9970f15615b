//! The key `restitution`: one number for both walls, or one for each.

use serde::Deserialize;
use serde_json::{Value, json};
use toml::Spanned;
use toml::de::DeValue;

use super::inputs::Input;
use super::number::toml;
use super::reader::Reader;
use super::value::ValuePlace;

/// Restitution at both walls, or at the walls x - y = +b and x - y = -b.
#[derive(Deserialize, Clone, Copy)]
#[serde(untagged)]
pub(super) enum Restitution {
    Both(f64),
    Each([f64; 2]),
}

impl Restitution {
    pub fn mean(self) -> f64 {
        match self {
            Self::Both(both) => both,
            Self::Each([plus, minus]) => 0.5 * (plus + minus),
        }
    }

    /// That at x - y = +b less that at x - y = -b.
    pub fn difference(self) -> f64 {
        match self {
            Self::Both(_) => 0.0,
            Self::Each([plus, minus]) => plus - minus,
        }
    }
}

/// What the key may hold: a number, or a pair of them.
pub(super) fn one_or_each() -> Value {
    let number = json!({ "type": "number", "minimum": 0.0, "maximum": 1.0 });
    let mut one = number.clone();
    (one["x-symbol"], one["examples"]) = (json!("r"), json!([0.6]));
    json!([one, {
        "type": "array", "items": number, "minItems": 2, "maxItems": 2, "examples": [[0.65, 0.55]],
    }])
}

/// A key's number, and its pair, where it may hold either.
pub(super) fn alternatives(schema: &'static Value) -> Option<[&'static Value; 2]> {
    let [one, each] = schema["anyOf"].as_array()?.as_slice() else { return None };
    (each["type"] == "array").then_some([one, each])
}

impl Reader<'_> {
    /// Reads the pair, which is one input of the case: its value is the mean.
    pub fn each(&mut self, place: &ValuePlace, [one, each]: [&'static Value; 2]) -> Option<Value> {
        let line = format!("{} = {}", place.key, toml(&each["examples"][0]));
        let read = self.item(ValuePlace { line, ..place.clone() }, each)?;
        let mean = serde_json::from_value::<Restitution>(read.clone()).ok()?.mean();
        let span = Spanned::<DeValue>::span(place.value);
        self.inputs.push(Input {
            table: place.table.to_owned(),
            name: place.key,
            symbol: one["x-symbol"].as_str().unwrap_or_default().to_owned(),
            value: mean,
            unit: "1",
            as_written: self.as_written(span.clone()),
            span,
        });
        Some(read)
    }
}
