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
        self.entries.get(key).map_or(self.span.clone(), Spanned::span)
    }

    /// " in [band]"; nothing for the top level.
    pub fn place(&self) -> String {
        if self.path.is_empty() { String::new() } else { format!(" in [{}]", self.path) }
    }

    /// What the schema says about a key, which may depend on what another one holds: the amplitude on the
    /// kind of excitation.
    pub fn schema_of(&self, key: &str) -> &'static Value {
        let chosen = |branch: &&'static Map<String, Value>| {
            branch.iter().any(|(key, schema)| {
                let written = self.value(key).and_then(|value| value.get_ref().as_str());
                schema["const"].is_string() && schema["const"].as_str() == written
            })
        };
        let branches = self.schema["oneOf"].as_array().into_iter().flatten();
        let mut branches = branches.filter_map(|one| one["properties"].as_object());
        let own = branches.find(chosen).and_then(|branch| branch.get(key));
        let own = own.filter(|schema| schema["const"].is_null());
        own.unwrap_or(&self.schema["properties"][key])
    }

    /// Whether the schema requires a key.
    pub fn requires(&self, key: &str) -> bool {
        let required = self.schema["required"].as_array();
        required.is_some_and(|required| required.iter().any(|one| one == key))
    }

    /// Pairs of keys of which exactly one must be there.
    pub fn alternatives(&self) -> impl Iterator<Item = [&'static str; 2]> + use<> {
        let groups = self.schema["allOf"].as_array().into_iter().flatten();
        let groups = groups.chain([self.schema]).filter_map(|group| group["oneOf"].as_array());
        groups.filter_map(|group| {
            let [first, second] = group.as_slice() else { return None };
            let key = |one: &'static Value| match one["required"].as_array()?.as_slice() {
                [only] => only.as_str(),
                _ => None,
            };
            Some([key(first)?, key(second)?])
        })
    }
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
