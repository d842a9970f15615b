//! Reads one value of a table as the schema of its key says.

use serde_json::{Value, json};
use toml::Spanned;
use toml::de::DeValue;

use super::Design;
use super::form::{Bound, Form, toml};
use super::quantity::Measurand;
use super::reader::Reader;
use super::suggest::nearest;
use super::sweep::SweepParameter;
use super::table::{Table, kind};

/// A value, and what to call it.
#[derive(Clone)]
pub(super) struct Place<'a> {
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
    /// The value of a key, quantities in SI units; `None` for a table, and for what was reported.
    pub fn value(
        &mut self,
        table: &Table,
        key: &'static str,
        value: &Spanned<DeValue>,
    ) -> Option<Value> {
        let place = self.place(table, key, value);
        self.item(place, table.schema_of(key))
    }

    /// A key's own value.
    pub fn place<'a>(
        &self,
        table: &'a Table,
        key: &'static str,
        value: &'a Spanned<DeValue<'a>>,
    ) -> Place<'a> {
        let name = table.path.rsplit('.').next().unwrap_or_default();
        let (subject, line) = (format!("`{key}`"), self.line(table, key));
        Place { table: name, key, subject, line, value, sign: 0, alone: true }
    }

    fn item(&mut self, mut place: Place, schema: &'static Value) -> Option<Value> {
        if schema["x-signed"].is_string() {
            return super::uncertainty::read_error(self, place, self.form(schema)?);
        }
        if let Some(form) = self.form(schema) {
            return self.number(&place, &form).map(Value::from);
        }
        if !names(schema).is_empty() {
            return self.name(&place, schema);
        }
        match schema["type"].as_str()? {
            "array" => {
                place.alone = false;
                self.list(&place, schema)
            }
            "integer" => self.whole_number(&place, schema),
            "boolean" => self.flag(&place),
            "string" => self.plain_text(&place),
            _ => None,
        }
    }

    /// How a number is written; that of a parameter as in the case's design.
    fn form(&self, schema: &'static Value) -> Option<Form> {
        let parameter = schema["x-parameter"].as_str().or(schema["x-signed"].as_str());
        let Some(parameter) = parameter else { return Form::of(schema) };
        let mut form = SweepParameter::of_name(parameter)?.form(self.design.as_ref()?)?;
        let bound = Bound::of(schema);
        form.bound = if bound.is_any() { bound } else { form.bound };
        if let Some(symbol) = schema["x-symbol"].as_str() {
            form.symbol = symbol.to_owned();
        }
        let plain =
            [&schema["x-plain"][0], &schema["examples"][0]].into_iter().find(|one| one.is_number());
        let own = match form.measurand {
            None => plain,
            Some(of) => Some(&schema["examples"][0])
                .filter(|one| one.as_str().and_then(Measurand::of) == Some(of)),
        };
        form.example = own.map_or(form.example, toml);
        Some(form)
    }

    /// A line that gives a key its example, in the units of the case's design.
    pub fn line(&self, table: &Table, key: &str) -> String {
        format!("{key} = {}", self.example(table.schema_of(key)))
    }

    fn example(&self, schema: &'static Value) -> String {
        let plain = &schema["x-plain"][0];
        match (&schema["examples"][0], self.form(schema)) {
            _ if matches!(self.design, Some(Design::Reduced(_))) && !plain.is_null() => toml(plain),
            (_, Some(form)) => form.example,
            (Value::Null, None) => match self.form(&schema["items"]) {
                Some(form) => format!("[{}]", form.example),
                None => names(schema).into_iter().next().unwrap_or_default(),
            },
            (example, None) => toml(example),
        }
    }

    /// Reports a value.
    pub fn refuse(&mut self, place: &Place, problem: &str, expected: String, help: String) {
        let message = format!("{} {problem}", place.subject);
        self.report(place.value.span(), message, expected, help);
    }

    fn whole_number(&mut self, place: &Place, schema: &Value) -> Option<Value> {
        let help = format!("write for example {}", place.line);
        let DeValue::Integer(integer) = place.value.get_ref() else {
            let problem = format!("is {}", self.as_written(place.value.span()));
            self.refuse(
                place,
                &problem,
                "expected a whole number, without quotes".to_owned(),
                help,
            );
            return None;
        };
        let bound = Bound::of(schema);
        let whole = i128::from_str_radix(integer.as_str(), integer.radix()).ok();
        let whole = whole.and_then(|whole| u64::try_from(whole).ok());
        let Some(number) = whole.filter(|whole| bound.holds(*whole as f64)) else {
            let expected = format!("expected a whole number {}", bound.words());
            self.refuse(place, &format!("is {integer}"), expected, help);
            return None;
        };
        let symbol = schema["x-symbol"].as_str().unwrap_or_default();
        let form = Form { bound, ..Form::free(None, "", symbol) };
        self.bounded(place, &form, number as f64).map(|_| number.into())
    }

    fn flag(&mut self, place: &Place) -> Option<Value> {
        let value = place.value.get_ref();
        if let DeValue::Boolean(flag) = value {
            return Some(Value::Bool(*flag));
        }
        let problem = format!("is {}, but it is true or false", kind(value));
        let expected = "expected true or false, without quotes".to_owned();
        self.refuse(place, &problem, expected, format!("write for example {}", place.line));
        None
    }

    /// Text that must not be blank.
    fn plain_text(&mut self, place: &Place) -> Option<Value> {
        let (problem, expected) = match place.value.get_ref() {
            DeValue::String(text) if !text.trim().is_empty() => return Some(json!(text)),
            DeValue::String(_) => ("is empty".to_owned(), "expected text"),
            other => (format!("is {}", kind(other)), "expected text in quotes"),
        };
        self.refuse(place, &problem, expected.to_owned(), format!("write {}", place.line));
        None
    }

    fn name(&mut self, place: &Place, schema: &Value) -> Option<Value> {
        let names = names(schema);
        let text = place.value.get_ref().as_str().unwrap_or_default();
        let quoted = format!("\"{text}\"");
        if names.contains(&quoted) {
            return Some(text.into());
        }
        let written = self.text[place.value.span()].to_owned();
        let near: Vec<&str> = names.iter().map(String::as_str).collect();
        let help = match nearest(&quoted, &near) {
            Some(near) if !text.is_empty() => format!("did you mean {near}?"),
            _ => format!("write for example {} ({})", place.line, first_sentence(schema)),
        };
        self.refuse(place, &format!("is {written}"), format!("expected {}", or(&names)), help);
        None
    }

    /// A list of values, or of pairs of them.
    fn list(&mut self, place: &Place, schema: &'static Value) -> Option<Value> {
        let help = format!("write for example {}", place.line);
        let DeValue::Array(items) = place.value.get_ref() else {
            let problem = match is_pair(schema) {
                true => "is not a pair".to_owned(),
                false => format!("is {}, but it is a list", kind(place.value.get_ref())),
            };
            self.refuse(place, &problem, expected_items(schema), help);
            return None;
        };
        let count = items.len() as u64;
        let few = schema["minItems"].as_u64().is_some_and(|least| count < least);
        if few || schema["maxItems"].as_u64().is_some_and(|most| count > most) {
            let problem = if is_pair(schema) { "is not a pair" } else { "is empty" };
            self.refuse(place, problem, expected_items(schema), help);
            return None;
        }
        let mut found = Vec::with_capacity(items.len());
        for (k, item) in items.iter().enumerate() {
            let own = schema["prefixItems"].get(k).unwrap_or(&schema["items"]);
            let subject = format!("a value of `{}`", place.key);
            let read = self.item(Place { subject, value: item, ..place.clone() }, own);
            if let (Some(read), true) = (&read, schema["uniqueItems"] == true)
                && found.contains(read)
            {
                let message = format!("`{}` names {read} twice", place.key);
                self.report(item.span(), message, "expected each once", "remove one of them");
            }
            found.extend(read);
        }
        if found.len() < items.len() {
            return None;
        }
        self.ascending(place, schema, &found)?;
        Some(found.into())
    }

    /// Reports numbers that do not rise, where the schema says that they do.
    fn ascending(&mut self, place: &Place, schema: &Value, found: &[Value]) -> Option<()> {
        // A pair has its place by its first number.
        let order = |value: &Value| value.get(0).unwrap_or(value).as_f64();
        let rises = |two: &[Value]| order(&two[0]) < order(&two[1]);
        if schema["x-ascending"] != true || found.windows(2).all(rises) {
            return Some(());
        }
        let message = format!("the values of `{}` do not rise", place.key);
        let help = "sort them, and keep each once";
        self.report(place.value.span(), message, "expected each above the one before", help);
        None
    }
}

fn is_pair(schema: &Value) -> bool {
    schema["maxItems"] == 2
}

fn expected_items(schema: &Value) -> String {
    let items = match &schema["items"] {
        _ if is_pair(schema) => "two values",
        names_of if !names(names_of).is_empty() => "names in quotes",
        pairs if is_pair(pairs) => "pairs",
        _ => "values",
    };
    format!("expected {items}, between brackets")
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
