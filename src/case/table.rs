//! One table of a case file, beside what its schema says about it.

use std::ops::Range;

use serde_json::{Map, Value};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// One table of the file.
pub(super) struct Table<'t> {
    /// As its author has to write it, `band` or `sweep.clearance`; empty for the top level.
    pub path: String,
    pub schema: &'static Value,
    /// Every key that it may have, in the order in which they are documented.
    pub keys: Vec<&'static str>,
    pub entries: &'t DeTable<'t>,
    pub span: Range<usize>,
    /// Keys whose misspelling was reported, and which are therefore not reported missing.
    pub misspelled: Vec<&'static str>,
}

impl<'t> Table<'t> {
    /// The value of a key.
    pub fn value(&self, key: &str) -> Option<&'t Spanned<DeValue<'t>>> {
        self.entries.get(key)
    }

    /// Whether the key is there, or a misspelling of it.
    pub fn has(&self, key: &str) -> bool {
        self.entries.contains_key(key) || self.misspelled.contains(&key)
    }

    /// Where a key stands, or else the table's name.
    pub fn span_of(&self, key: &str) -> Range<usize> {
        self.entries.get_key_value(key).map_or(self.span.clone(), |(key, _)| key.span())
    }

    /// Where a key's value stands, or else the table's name.
    pub fn span_of_value(&self, key: &str) -> Range<usize> {
        self.value(key).map_or(self.span.clone(), Spanned::span)
    }

    /// " in [band]"; nothing for the top level.
    pub fn place(&self) -> String {
        if self.path.is_empty() { String::new() } else { format!(" in [{}]", self.path) }
    }

    /// What the schema says about a key, which may depend on what another one holds: the amplitude on the
    /// kind of excitation.
    pub fn schema_of(&self, key: &str) -> &'static Value {
        let says = |(key, schema): (&String, &Value)| {
            let written = self.value(key).and_then(|value| value.get_ref().as_str());
            schema["const"].as_str().is_some_and(|name| Some(name) == written)
        };
        let mut branches = list(&self.schema["oneOf"]).map(|branch| &branch["properties"]);
        let chosen = branches.find(|keys| keys.as_object().into_iter().flatten().any(says));
        let own = chosen.and_then(|keys| keys.get(key)).filter(|own| own["const"].is_null());
        own.unwrap_or(&self.schema["properties"][key])
    }

    /// Keys of which exactly one must be there: those that are required, and pairs of alternatives.
    pub fn groups(&self) -> impl Iterator<Item = Vec<&'static str>> + use<> {
        let required =
            list(&self.schema["required"]).filter_map(Value::as_str).map(|one| vec![one]);
        let pairs = list(&self.schema["allOf"]).chain([self.schema]).filter_map(|group| {
            // Nothing but the one key.
            let key = |branch: &'static Value| {
                branch["required"][0]
                    .as_str()
                    .filter(|_| branch.as_object().map(Map::len) == Some(1))
            };
            list(&group["oneOf"]).map(key).collect::<Option<Vec<_>>>()
        });
        required.chain(pairs.filter(|pair| pair.len() == 2))
    }
}

fn list(value: &'static Value) -> impl Iterator<Item = &'static Value> {
    value.as_array().into_iter().flatten()
}

/// What a TOML value is, with its article.
pub(super) fn kind(value: &DeValue) -> &'static str {
    match value {
        DeValue::String(_) => "text",
        DeValue::Integer(_) | DeValue::Float(_) => "a number",
        DeValue::Boolean(_) => "true or false",
        DeValue::Datetime(_) => "a date or time",
        DeValue::Array(_) => "a list",
        DeValue::Table(_) => "a table",
    }
}
