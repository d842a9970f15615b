//! The case file as a JSON Schema (draft 2020-12), derived from the structs that it is read into.
//!
//! `reader.rs` reads by the same schema: which keys there are, how their values are written, and within
//! which bounds. What JSON Schema has no word for begins with `x-`, and is left out of what is printed:
//! `x-measurand` what a text with a unit measures, `x-parameter` whose units the case's design decides,
//! `x-symbol` the symbol in LaTeX, `x-plain` an example beside `[reduced]`, `x-reduced` what a key of
//! `[excitation]` is in `[reduced]`, `x-keys` the order of keys.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::{LazyLock, Mutex, PoisonError};

use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use schemars::{JsonSchema, Schema};
use serde_json::{Map, Value, json};

use crate::quantity::Dimension;

/// The name under which a case's first line refers to its schema.
pub const FILE_NAME: &str = "vinesink.schema.json";

/// The schema of a whole case file.
pub(super) static SCHEMA: LazyLock<Value> = LazyLock::new(schema_of::<super::CaseFile>);

/// The schema by which a table is read, derived when it is first asked for: a case has four or five of a
/// dozen.
pub(super) fn of_table<T: JsonSchema>() -> &'static Value {
    static DERIVED: Mutex<BTreeMap<Cow<str>, &'static Value>> = Mutex::new(BTreeMap::new());
    let mut derived = DERIVED.lock().unwrap_or_else(PoisonError::into_inner);
    derived.entry(T::schema_id()).or_insert_with(|| Box::leak(Box::new(schema_of::<T>())))
}

/// The schema that is derived from a type.
pub(super) fn schema_of<T: JsonSchema>() -> Value {
    let as_written = RecursiveTransform(|schema: &mut Schema| {
        without_null(schema);
        with_unit(schema);
    });
    let settings = SchemaSettings::draft2020_12()
        .with(|settings| settings.inline_subschemas = true)
        .with_transform(as_written);
    settings.into_generator().into_root_schema_for::<T>().to_value()
}

/// The JSON Schema of a case file: `$defs` has that of a structure of one mode and one absorber, `one`, and that of lists of them,
/// `several`; the keys of a case choose which of them it has to fit.
pub fn schema() -> Value {
    let [mut one, mut several] = [&*SCHEMA, &schema_of::<super::modal::ModalFile>()].map(printed);
    let drafts = [&mut one, &mut several].map(|part| part.as_object_mut()?.remove("$schema"));
    let [of_one, of_several] =
        ["one", "several"].map(|part| json!({ "$ref": format!("#/$defs/{part}") }));
    let has = |key: &str| json!({ "required": [key] });
    let reduced = json!({ "properties": { "reduced": { "anyOf": [has("mode"), has("absorber")] } }, "required": ["reduced"] });
    let listed =
        |name: &str| json!({ "properties": { name: { "type": "array" } }, "required": [name] });
    json!({
        "$schema": drafts[0],
        "title": "vinesink case",
        "description": "A design of a vibro-impact nonlinear energy sink.",
        "type": "object",
        "if": { "anyOf": [has("mode"), has("modes"), listed("absorber"), listed("excitation"), reduced] },
        "then": of_several,
        "else": of_one,
        // Editors complete by what they find here, and do not look behind `if`; anything fits.
        "anyOf": [of_one, of_several, true],
        "$defs": { "one": one, "several": several },
    })
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

/// Gives a table a key for each name of an enum that has one, with the name's own description.
pub(super) fn add_names<T: JsonSchema>(schema: &mut Schema, of: impl Fn(&str) -> Option<Value>) {
    let names = schema_of::<T>();
    let names = names["oneOf"].as_array().into_iter().flatten();
    for name in names {
        let key = name["const"].as_str().unwrap_or_default();
        let Some(mut property) = of(key) else { continue };
        property["description"] = name["description"].clone();
        add_key(schema, key, property);
    }
}

/// Gives a table one more key, behind those of its struct.
pub(super) fn add_key(schema: &mut Schema, key: &str, property: Value) {
    let object = schema.ensure_object();
    object.entry("properties").or_insert_with(|| json!({}))[key] = property;
    let keys = object.entry("x-keys").or_insert_with(|| json!([]));
    keys.as_array_mut().into_iter().for_each(|keys| keys.push(key.into()));
}

/// The number of a parameter, with the unit that it has in the case's own design: none beside
/// `[reduced]`.
pub(super) fn in_design(parameter: &str) -> Value {
    json!({ "anyOf": [{ "type": "number" }, { "type": "string" }], "x-parameter": parameter })
}

/// A decimal number as a regular expression, without a minus: few quantities of a case may be negative.
pub(super) const NUMBER: &str = r"\+?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?";

/// A regular expression for what [`Dimension::parse`] accepts; of what may not be negative, without a minus.
fn pattern(dimension: Dimension, signed: bool) -> String {
    let number = NUMBER.replacen(r"\+?", if signed { "[+-]?" } else { r"\+?" }, 1);
    let units: Vec<String> = dimension.all_units().map(|unit| unit_pattern(unit.symbol)).collect();
    format!(r"^\s*{number}\s*({})\s*$", units.join("|"))
}

fn unit_pattern(symbol: &str) -> String {
    let symbol = symbol.replace('^', r"\^").replace('(', r"\(").replace(')', r"\)");
    let product = symbol.replace(' ', r"(\s+|\s*[*·⋅]\s*)").replace('/', r"\s*/\s*");
    product.replace(['u', 'µ'], "[uµμ]")
}

/// Removes `null`: TOML has none, a key that is not given is left out.
fn without_null(schema: &mut Schema) {
    if let Some(Value::Array(types)) = schema.get_mut("type") {
        types.retain(|name| name != "null");
        let first = types[0].clone();
        schema.insert("type".to_owned(), first);
    }
    // `anyOf: [X, null]` becomes `X`.
    let Some(Value::Array(alternatives)) = schema.get_mut("anyOf") else { return };
    if let [Value::Object(only), null] = alternatives.as_mut_slice()
        && null["type"] == "null"
    {
        let only = std::mem::take(only);
        let object = schema.ensure_object();
        object.remove("anyOf");
        for (key, value) in only {
            object.entry(key).or_insert(value);
        }
    }
}

/// A number that measures something is written as text with a unit; a share, where its example is a plain
/// number, either way.
fn with_unit(schema: &mut Schema) {
    let measured = schema.get("x-measurand").and_then(Value::as_str).and_then(Dimension::named);
    let (Some(dimension), Some("number")) = (measured, schema.get("type").and_then(Value::as_str))
    else {
        return;
    };
    let object = schema.ensure_object();
    let signed = object.get("minimum").and_then(Value::as_f64).is_some_and(|least| least < 0.0);
    object.remove("format");
    object.entry("examples").or_insert_with(|| json!([dimension.words().1]));
    let mut text = Map::new();
    text.insert("type".to_owned(), json!("string"));
    text.insert("pattern".to_owned(), json!(pattern(dimension, signed)));
    if object["examples"][0].is_number() {
        object.remove("type");
        object.insert("anyOf".to_owned(), json!([{ "type": "number" }, text]));
    } else {
        object.append(&mut text);
    }
}
