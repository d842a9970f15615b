//! The case file as a JSON Schema (draft 2020-12), derived from the structs that it is read into.
//!
//! `reader.rs` reads by the same schema: which keys there are, how their values are written, and within
//! which bounds. What JSON Schema has no word for begins with `x-`, and is left out of what is printed:
//! `x-measurand` what a text with a unit measures, `x-parameter` whose units the case's design decides,
//! `x-symbol` the symbol in LaTeX, `x-plain` an example beside `[reduced]`, `x-keys` the order of keys.

use std::borrow::Cow;
use std::sync::LazyLock;

use schemars::generate::SchemaSettings;
use schemars::transform::{Transform, transform_subschemas};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde_json::{Value, json};

use super::quantity::{Dimension, Quantity, Share};

/// The name under which a case's first line refers to its schema.
pub const FILE_NAME: &str = "vinesink.schema.json";

/// The schema by which a case is read.
pub(super) static SCHEMA: LazyLock<Value> = LazyLock::new(schema_of::<super::CaseFile>);

/// The schema that is derived from a type.
pub(super) fn schema_of<T: JsonSchema>() -> Value {
    let settings = SchemaSettings::draft2020_12()
        .with(|settings| settings.inline_subschemas = true)
        .with_transform(WithoutNull);
    settings.into_generator().into_root_schema_for::<T>().to_value()
}

/// The JSON Schema of a case file.
pub fn schema() -> Value {
    printed(&SCHEMA)
}

fn printed(schema: &Value) -> Value {
    match schema {
        Value::Object(entries) => entries
            .iter()
            .filter(|(key, _)| !key.starts_with("x-"))
            .map(|(key, value)| (key.clone(), printed(value)))
            .collect(),
        Value::Array(items) => items.iter().map(printed).collect(),
        other => other.clone(),
    }
}

/// One of two keys, for a table's `oneOf`.
pub(super) fn one_of(first: &str, second: &str) -> Value {
    json!([{ "required": [first] }, { "required": [second] }])
}

/// A plain number, or a share with its sign: `0.0077` or `"0.77 %"`.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(transparent)]
pub(super) struct Ratio(pub f64);

impl JsonSchema for Ratio {
    fn schema_name() -> Cow<'static, str> {
        "Ratio".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let share = json!({ "type": "string", "pattern": pattern::<Share>() });
        json_schema!({ "anyOf": [{ "type": "number" }, share], "x-measurand": Share::NAME })
    }
}

/// Gives a table a key for each name of an enum, with the name's own description.
pub(super) fn add_names<T: JsonSchema>(schema: &mut Schema, of: impl Fn(&str) -> Value) {
    let names = schema_of::<T>();
    let names = names["oneOf"].as_array().into_iter().flatten();
    for name in names {
        let key = name["const"].as_str().unwrap_or_default();
        let mut property = of(key);
        property["description"] = name["description"].clone();
        let object = schema.ensure_object();
        object["properties"][key] = property;
        let keys = object.entry("x-keys").or_insert_with(|| json!([]));
        keys.as_array_mut().into_iter().for_each(|keys| keys.push(key.into()));
    }
}

/// The number of a parameter, with the unit that it has in the case's own design: none beside
/// `[reduced]`.
pub(super) fn in_design(parameter: &str) -> Value {
    json!({ "anyOf": [{ "type": "number" }, { "type": "string" }], "x-parameter": parameter })
}

/// A quantity above 0.
pub(super) fn positive<D: Dimension>() -> Value {
    let pattern = pattern::<D>();
    json!({ "type": "string", "pattern": pattern, "x-measurand": D::NAME, "exclusiveMinimum": 0 })
}

impl<D: Dimension> JsonSchema for Quantity<D> {
    fn schema_name() -> Cow<'static, str> {
        D::NAME.into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "type": "string",
            "pattern": pattern::<D>(),
            "examples": [D::OF.example],
            "x-measurand": D::NAME,
        })
    }
}

/// A decimal number as a regular expression, without a sign: no quantity of a case may be negative.
pub(super) const NUMBER: &str = r"\+?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?";

/// A regular expression for what [`Quantity::parse`] accepts, if it is not negative.
pub(super) fn pattern<D: Dimension>() -> String {
    let units: Vec<String> = D::UNITS.iter().map(|unit| unit_pattern(unit.symbol)).collect();
    format!(r"^\s*{NUMBER}\s*({})\s*$", units.join("|"))
}

fn unit_pattern(symbol: &str) -> String {
    let product = symbol.replace(' ', r"(\s+|\s*[*·⋅]\s*)").replace('/', r"\s*/\s*");
    match product.strip_prefix('u') {
        Some(rest) => format!("[uµμ]{rest}"),
        None => product.replace("/\\s*um", r"/\s*[uµμ]m"),
    }
}

/// Removes `null` from types: TOML has none, a key that is not given is left out.
#[derive(Debug, Clone)]
struct WithoutNull;

impl Transform for WithoutNull {
    fn transform(&mut self, schema: &mut Schema) {
        if let Some(Value::Array(types)) = schema.get_mut("type") {
            types.retain(|name| name != "null");
            if let [only] = types.as_slice() {
                let only = only.clone();
                schema.insert("type".to_owned(), only);
            }
        }
        unwrap_alternative_to_null(schema);
        transform_subschemas(self, schema);
    }
}

/// `anyOf: [X, null]` becomes `X`.
fn unwrap_alternative_to_null(schema: &mut Schema) {
    let Some(Value::Array(mut alternatives)) = schema.remove("anyOf") else { return };
    let before = alternatives.len();
    alternatives.retain(|alternative| alternative["type"] != "null");
    match alternatives.as_slice() {
        [Value::Object(only)] if before == 2 => {
            let object = schema.ensure_object();
            only.iter().for_each(|(key, value)| {
                object.entry(key.clone()).or_insert_with(|| value.clone());
            });
        }
        _ => {
            schema.insert("anyOf".to_owned(), alternatives.into());
        }
    }
}
