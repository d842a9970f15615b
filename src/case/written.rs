//! What a case says, whole: every key of its file with its value as written, and the files that it names.

use std::collections::BTreeMap;

use serde_json::{Map, Value, json};
use toml::de::{DeTable, DeValue};

use super::{Case, ModalCase, RecordSource, document};

impl Case {
    /// Every key of its file with its value, as JSON.
    pub fn written(&self) -> Value {
        written(&self.text)
    }

    /// The file that it reads, by its name in the case, with the SHA-256 of its text with line ends of one kind.
    pub fn files(&self) -> BTreeMap<String, String> {
        let source = self.recording.as_ref().map(|recording| &recording.source);
        let Some(RecordSource::File { path, read, .. }) = source else { return BTreeMap::new() };
        read.iter().map(|read| (path.clone(), read.sha256.clone())).collect()
    }
}

impl ModalCase {
    /// Every key of its file with its value, as JSON.
    pub fn written(&self) -> Value {
        written(&self.text)
    }

    /// The same of the file of its modes.
    pub fn files(&self) -> BTreeMap<String, String> {
        let name = super::modes_file(&self.text);
        let digest = self.modes_file.as_ref().map(|file| file.sha256.clone());
        name.into_iter().zip(digest).collect()
    }
}

/// A text that was read as a case; none of its keys is left out.
fn written(text: &str) -> Value {
    document::parse(text).map_or(Value::Null, |document| table(&document))
}

fn table(of: &DeTable) -> Value {
    let entry = |(key, value): (&toml::Spanned<std::borrow::Cow<str>>, &toml::Spanned<DeValue>)| {
        (key.get_ref().to_string(), self::value(value.get_ref()))
    };
    Value::Object(of.iter().map(entry).collect::<Map<_, _>>())
}

/// A number is one, whatever its digits, so that 1.0 and 1.00 are the same; text is as written.
fn value(of: &DeValue) -> Value {
    match of {
        DeValue::String(text) => json!(text),
        DeValue::Boolean(flag) => json!(flag),
        DeValue::Integer(number) => {
            let radix = number.radix();
            i64::from_str_radix(number.as_str(), radix)
                .map_or(json!(number.as_str()), |it| json!(it))
        }
        DeValue::Float(number) => {
            let read = number.as_str().parse::<f64>().ok().and_then(serde_json::Number::from_f64);
            read.map_or(json!(number.as_str()), Value::Number)
        }
        DeValue::Datetime(at) => json!(at.to_string()),
        DeValue::Array(items) => items.iter().map(|item| value(item.get_ref())).collect(),
        DeValue::Table(entries) => table(entries),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::schema;

    /// The keys of a schema with an example each, by the tables that they stand in; one of a list of tables is a table.
    fn keys(of: &Value, at: &mut Vec<String>, found: &mut Vec<(Vec<String>, Value)>) {
        let example = || {
            let constants = of["oneOf"].as_array().into_iter().flatten().map(|one| &one["const"]);
            let listed = of["enum"].as_array().into_iter().flatten();
            let given = of["examples"].as_array().into_iter().flatten();
            given.chain(listed).chain(constants).find(|one| !one.is_null()).cloned()
        };
        let tables = of["anyOf"].as_array().into_iter().flatten().chain([of]);
        let table = tables.into_iter().find(|one| one["properties"].is_object());
        match table.map(|one| &one["properties"]) {
            Some(inner) if of["examples"].is_null() => {
                for (key, one) in inner.as_object().into_iter().flatten() {
                    at.push(key.clone());
                    keys(one, at, found);
                    at.pop();
                }
            }
            _ => found.extend(example().map(|example| (at.clone(), example))),
        }
    }

    /// Whatever a case may say is kept, be it a number, a word, a flag, a list or a table.
    #[test]
    fn every_key_of_the_schemas_is_kept() {
        let schema = schema();
        for name in ["one", "several"] {
            let mut all = Vec::new();
            keys(&schema["$defs"][name], &mut Vec::new(), &mut all);
            assert!(all.len() > 60, "{}", all.len());
            for (path, example) in all {
                let (key, tables) = path.split_last().expect("a key");
                let head = if tables.is_empty() {
                    String::new()
                } else {
                    format!("[{}]\n", tables.join("."))
                };
                let inline = |value: &Value| match value {
                    Value::Object(entries) => {
                        let entry = |(key, value): (&String, &Value)| format!("{key:?} = {value}");
                        format!(
                            "{{ {} }}",
                            entries.iter().map(entry).collect::<Vec<_>>().join(", ")
                        )
                    }
                    other => other.to_string(),
                };
                let text = format!("{head}{key} = {}\n", inline(&example));
                let kept = written(&text);
                let found = path.iter().fold(&kept, |inside, key| &inside[key]);
                assert_eq!(found, &example, "{text}");
            }
        }
    }

    #[test]
    fn tables_of_a_list_and_numbers_of_any_form_are_kept() {
        let text = "a = 0x10\nb = 1_000.50\nc = -inf\nd = 1979-05-27\n[[mode]]\nshape = { tip = 1.0 }\n[[mode]]\nshape = { tip = -1 }\n";
        let kept = json!({
            "a": 16, "b": 1000.5, "c": "-inf", "d": "1979-05-27",
            "mode": [{ "shape": { "tip": 1.0 } }, { "shape": { "tip": -1 } }],
        });
        assert_eq!(written(text), kept);
    }
}
