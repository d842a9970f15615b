//! Reads one value of a table as the schema of its key says.

use serde_json::{Value, json};
use toml::Spanned;
use toml::de::{DeArray, DeValue};

use super::modal::axis_form;
use super::number::{Bound, Form, toml};
use super::reader::{Reader, Table, kind};
use super::restitution::alternatives;
use crate::quantity::Dimension;
use crate::system::Parameter;

/// A value, and what to call it.
#[derive(Clone)]
pub(super) struct ValuePlace<'a> {
    /// The last part of its table's name.
    pub table: &'a str,
    pub key: &'static str,
    /// The key in a sentence.
    pub subject: String,
    /// A line that gives the key its example.
    pub line: String,
    pub value: &'a Spanned<DeValue<'a>>,
    /// The bytes that a sign takes up before a number in quotes.
    pub sign: usize,
    /// Whether it stands alone, not in a list.
    pub alone: bool,
}

impl Reader<'_> {
    /// A key's own value.
    pub fn place<'a>(
        &self,
        table: &'a Table,
        key: &'static str,
        value: &'a Spanned<DeValue<'a>>,
    ) -> ValuePlace<'a> {
        let name = table.path.rsplit('.').next().unwrap_or_default();
        let (subject, line) = (format!("`{key}`"), self.line(table, key));
        ValuePlace { table: name, key, subject, line, value, sign: 0, alone: true }
    }

    /// A value that its schema allows, quantities in SI units; `None` for a table, and for what was reported.
    pub fn item(&mut self, place: ValuePlace, schema: &'static Value) -> Option<Value> {
        if let (Some(either), DeValue::Array(_)) = (alternatives(schema), place.value.get_ref()) {
            return self.each(&place, either);
        }
        let place = match (alternatives(schema), place.value.get_ref()) {
            (Some([_, each]), DeValue::Table(_)) => {
                let pair = toml(&each["examples"][0]);
                let line =
                    format!("{}, or {} = {pair} for one value at each wall", place.line, place.key);
                ValuePlace { line, ..place }
            }
            _ => place,
        };
        if let Some(form) = self.form(schema) {
            if schema["x-signed"].is_string() {
                return super::uncertainty::read_error(self, place, form);
            }
            let number = self.number(&place, &form)?;
            return Some(if form.whole { json!(number as u64) } else { json!(number) });
        }
        if !names(schema).is_empty() {
            return self.name(&place, schema);
        }
        let found = place.value.get_ref();
        let (problem, expected) = match (schema["type"].as_str()?, found) {
            ("boolean", DeValue::Boolean(flag)) => return Some(json!(flag)),
            ("string", DeValue::String(text)) if !text.trim().is_empty() => {
                return Some(json!(text));
            }
            ("array", DeValue::Array(items)) if counts(schema, items.len() as u64) => {
                return self.list(&place, items, schema);
            }
            ("boolean", _) => (
                format!("is {}, but it is true or false", kind(found)),
                "true or false, without quotes",
            ),
            ("string", DeValue::String(_)) => ("is empty".to_owned(), "text"),
            ("string", _) => (format!("is {}", kind(found)), "text in quotes"),
            ("array", _) if is_pair(schema) => {
                ("is not a pair".to_owned(), "two values, between brackets")
            }
            ("array", DeValue::Array(_)) => ("is empty".to_owned(), items_of(schema)),
            ("array", _) => (format!("is {}, but it is a list", kind(found)), items_of(schema)),
            _ => return None,
        };
        let help = format!("write for example {}", place.line);
        self.refuse(&place, &problem, format!("expected {expected}"), help);
        None
    }

    /// How a number is written; that of a parameter as in the case's design.
    fn form(&self, schema: &'static Value) -> Option<Form> {
        let parameter = schema["x-parameter"].as_str().or(schema["x-signed"].as_str());
        let Some(parameter) = parameter else {
            return Form::of(schema).map(|one| self.written(one));
        };
        let parameter = Parameter::of_name(parameter)?;
        let mut form = match (&self.design, self.of_several) {
            (Some(design), _) => design.form(parameter)?,
            (None, moves_base) => self.written(axis_form(parameter, moves_base?)?),
        };
        let bound = Bound::of(schema);
        if bound != Bound::default() {
            form.bound = bound;
        }
        if let Some(symbol) = schema["x-symbol"].as_str() {
            form.symbol = symbol.to_owned();
        }
        let fits = |example: &&Value| match form.dimension {
            None => example.is_number(),
            some => example.as_str().and_then(Dimension::of) == some,
        };
        let examples = [&schema["x-plain"][0], &schema["examples"][0]];
        if let Some(own) = examples.into_iter().find(fits) {
            form.example = toml(own);
        }
        Some(form)
    }

    /// A form, or that of a plain number in place of a quantity where these are plain.
    pub fn written(&self, form: Form) -> Form {
        match form.dimension {
            Some(dimension) if self.plain && dimension.symbol(true) != "1" => {
                Form { dimension: None, plain: true, example: "1.5".to_owned(), ..form }
            }
            _ => form,
        }
    }

    /// A line that gives a key its example, in the units of the case's design.
    pub fn line(&self, table: &Table, key: &str) -> String {
        format!("{key} = {}", self.example(table.schema_of(key)))
    }

    fn example(&self, schema: &'static Value) -> String {
        let plain = &schema["x-plain"][0];
        match (&schema["examples"][0], self.form(schema)) {
            _ if self.design.is_some_and(|design| !design.is_physical()) && !plain.is_null() => {
                toml(plain)
            }
            (_, Some(form)) => form.example,
            (Value::Null, None) => match self.form(&schema["items"]) {
                Some(form) => format!("[{}]", form.example),
                None => names(schema).into_iter().next().unwrap_or_default(),
            },
            (example, None) => toml(example),
        }
    }

    /// Reports a value.
    pub fn refuse(&mut self, place: &ValuePlace, problem: &str, expected: String, help: String) {
        let message = format!("{} {problem}", place.subject);
        self.report(place.value.span(), message, expected, help);
    }

    fn name(&mut self, place: &ValuePlace, schema: &Value) -> Option<Value> {
        let names = names(schema);
        let text = place.value.get_ref().as_str().unwrap_or_default();
        let quoted = format!("\"{text}\"");
        if names.contains(&quoted) {
            return Some(text.into());
        }
        let near: Vec<&str> = names.iter().map(String::as_str).collect();
        let help = match nearest(&quoted, &near) {
            Some(near) if !text.is_empty() => format!("did you mean {near}?"),
            _ => format!("write for example {} ({})", place.line, first_sentence(schema)),
        };
        let problem = format!("is {}", &self.text[place.value.span()]);
        self.refuse(place, &problem, format!("expected {}", or(&names)), help);
        None
    }

    /// A list of values, or of pairs of them.
    fn list(
        &mut self,
        place: &ValuePlace,
        items: &DeArray,
        schema: &'static Value,
    ) -> Option<Value> {
        let mut found = Vec::with_capacity(items.len());
        for (k, value) in items.iter().enumerate() {
            let own = schema["prefixItems"].get(k).unwrap_or(&schema["items"]);
            let subject = format!("a value of `{}`", place.key);
            let read = self.item(ValuePlace { subject, value, alone: false, ..place.clone() }, own);
            if let (Some(read), true) = (&read, schema["uniqueItems"] == true)
                && found.contains(read)
            {
                let message = format!("`{}` names {read} twice", place.key);
                self.report(value.span(), message, "expected each once", "remove one of them");
            }
            found.extend(read);
        }
        if found.len() < items.len() {
            return None;
        }
        // A pair has its place by its first number.
        let order = |value: &Value| value.get(0).unwrap_or(value).as_f64();
        let rises = |two: &[Value]| order(&two[0]) < order(&two[1]);
        if schema["x-ascending"] == true && !found.windows(2).all(rises) {
            let message = format!("the values of `{}` do not rise", place.key);
            let help = "sort them, and keep each once";
            self.report(place.value.span(), message, "expected each above the one before", help);
            return None;
        }
        Some(found.into())
    }
}

/// Whether a list may have so many values.
fn counts(schema: &Value, count: u64) -> bool {
    schema["minItems"].as_u64().is_none_or(|least| count >= least)
        && schema["maxItems"].as_u64().is_none_or(|most| count <= most)
}

fn is_pair(schema: &Value) -> bool {
    schema["maxItems"] == 2
}

/// What a list holds.
fn items_of(schema: &Value) -> &'static str {
    match &schema["items"] {
        names_of if !names(names_of).is_empty() => "names in quotes, between brackets",
        pairs if is_pair(pairs) => "pairs, between brackets",
        _ => "values, between brackets",
    }
}

/// What the schema says about a value, in a sentence.
fn first_sentence(schema: &Value) -> String {
    let words = schema["description"].as_str().unwrap_or_default().replace('\n', " ");
    words.split(". ").next().unwrap_or_default().trim_end_matches('.').to_owned()
}

/// The names that a key may hold, in quotes.
fn names(schema: &Value) -> Vec<String> {
    let described = schema["oneOf"].as_array().into_iter().flatten().map(|one| &one["const"]);
    let plain = schema["enum"].as_array().into_iter().flatten();
    described.chain(plain).filter(|name| name.is_string()).map(Value::to_string).collect()
}

/// "or" before the last.
pub(super) fn or(names: &[String]) -> String {
    match names.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => names.concat(),
    }
}

/// The candidate closest to `written`; `None` when nothing is close.
///
/// Another capitalisation counts as closest; otherwise at most a third of the letters, and at
/// most three, may differ.
pub fn nearest<'a>(written: &str, candidates: &[&'a str]) -> Option<&'a str> {
    let lower = written.to_lowercase();
    let distance =
        |candidate: &&str| strsim::damerau_levenshtein(&lower, &candidate.to_lowercase());
    let closest = candidates.iter().copied().min_by_key(distance)?;
    let letters = written.chars().count().max(closest.chars().count());
    (distance(&closest) <= (letters / 3).min(3)).then_some(closest)
}
