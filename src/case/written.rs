//! What a case says, whole: every key of its file with its value as written, and the files that it names.

use std::collections::BTreeMap;

use serde_json::{Map, Value, json};
use toml::de::{DeTable, DeValue};

use super::{Case, ModalCase, RecordSource, document};
use crate::digest::text_sha256;

impl Case {
    /// Every key of its file with its value, as JSON.
    pub fn written(&self) -> Value {
        written(&self.text)
    }

    /// The file that it reads, by its name in the case, with the SHA-256 of its text with line ends of one kind.
    pub fn files(&self) -> BTreeMap<String, String> {
        let source = self.recording.as_ref().map(|recording| &recording.source);
        let Some(RecordSource::File { path, read }) = source else { return BTreeMap::new() };
        read.iter().map(|(digest, _)| (path.clone(), digest.clone())).collect()
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
        let digest = self.modes_file.as_ref().map(|file| text_sha256(&file.text));
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
