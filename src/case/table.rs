//! One table of a case file: reads values of the kinds a case has, and reports those that are not.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use super::error::Problem;
use super::inputs::Input;
use super::quantity::{Dimension, Quantity, Share};
use super::reader::{Field, Reader};

/// One table of the file; `name` is empty for the top level.
pub(super) struct Table<'t> {
    name: &'static str,
    span: Range<usize>,
    entries: &'t DeTable<'t>,
    /// Keys whose misspelling was reported, and which are therefore not reported missing.
    misspelled: Vec<&'static str>,
}

impl<'t> Table<'t> {
    pub fn new(
        name: &'static str,
        span: Range<usize>,
        entries: &'t DeTable<'t>,
        misspelled: Vec<&'static str>,
    ) -> Self {
        Self { name, span, entries, misspelled }
    }

    /// A key with its value.
    pub fn entry(
        &self,
        key: &str,
    ) -> Option<(&'t Spanned<DeString<'t>>, &'t Spanned<DeValue<'t>>)> {
        self.entries.get_key_value(key)
    }

    /// Whether the key is there, or a misspelling of it.
    pub fn has(&self, key: &'static str) -> bool {
        self.entries.contains_key(key) || self.misspelled.contains(&key)
    }

    /// Where the table, or one of its keys, stands.
    pub fn span_of(&self, key: &str) -> Range<usize> {
        self.entries.get_key_value(key).map_or(self.span.clone(), |(key, _)| key.span())
    }

    /// The bytes of a key's value, to point at; the table's name when there is none.
    pub fn span_of_value(&self, key: &str) -> Range<usize> {
        self.entries.get(key).map_or(self.span.clone(), Spanned::span)
    }

    fn required(
        &self,
        reader: &mut Reader,
        key: &'static str,
        line: &str,
    ) -> Option<&'t Spanned<DeValue<'t>>> {
        let value = self.entries.get(key);
        if value.is_none() && !self.misspelled.contains(&key) {
            let (message, expected) = self.missing(&format!("`{key}`"));
            reader.report(self.span.clone(), message, expected, format!("add the line {line}"));
        }
        value
    }

    fn missing(&self, what: &str) -> (String, String) {
        match self.name {
            "" => (format!("{what} is missing"), format!("expected {what} before the first table")),
            name => {
                (format!("{what} is missing in [{name}]"), format!("expected {what} in this table"))
            }
        }
    }

    /// Text that must be there and must not be blank.
    pub fn text(&self, reader: &mut Reader, key: &'static str, help: &str) -> Option<&'t str> {
        let value = self.required(reader, key, help)?;
        let (message, expected) = match value.get_ref() {
            DeValue::String(text) if !text.trim().is_empty() => return Some(text),
            DeValue::String(_) => (format!("`{key}` is empty"), "expected text".to_owned()),
            other => (format!("`{key}` is {}", kind(other)), "expected text in quotes".to_owned()),
        };
        reader.report(value.span(), message, expected, format!("write {help}"));
        None
    }

    /// A number with a unit that must be there, in SI units.
    pub fn quantity<D: Dimension>(&self, reader: &mut Reader, field: Field) -> Option<f64> {
        self.quantity_behind::<D>(reader, field, 0)
    }

    /// The same, behind a sign that takes up the first `sign` bytes of its text.
    pub fn quantity_behind<D: Dimension>(
        &self,
        reader: &mut Reader,
        field: Field,
        sign: usize,
    ) -> Option<f64> {
        let value = self.required(reader, field.key, &field.line())?;
        let DeValue::String(text) = value.get_ref() else {
            self.not_text::<D>(reader, field, value);
            return None;
        };
        let (before, quantity) = text.split_at(sign);
        match Quantity::<D>::parse(quantity) {
            Ok(quantity) => self.bounded(reader, field, value, quantity.si(), D::SI),
            Err(error) => {
                let range = sign + error.range.start..sign + error.range.end;
                let span = inside_quotes(reader.text, value.span(), text, range);
                let message = format!("`{}` {}", field.key, error.message);
                // What is to be written instead keeps its sign.
                let corrected = |help: String| match help.strip_prefix("write \"") {
                    Some(rest) => format!("write \"{before}{rest}"),
                    None => help,
                };
                let problem = Problem::new(reader.text, span, message, error.expected);
                reader.problems.push(problem.maybe_help(error.help.map(corrected)));
                None
            }
        }
    }

    fn not_text<D: Dimension>(&self, reader: &mut Reader, field: Field, value: &Spanned<DeValue>) {
        let written = reader.as_written(value.span());
        let expected = format!("expected {} such as {}", D::NAME, field.example);
        let key = field.key;
        let (message, help) = match value.get_ref() {
            DeValue::Integer(_) | DeValue::Float(_) => {
                let unit = D::EXAMPLE.split_once(' ').map_or(D::SI, |(_, unit)| unit);
                (
                    format!("`{key}` has no unit"),
                    format!("if {unit} is meant, write {key} = \"{written} {unit}\""),
                )
            }
            other => (format!("`{key}` is {}", kind(other)), format!("write {}", field.line())),
        };
        reader.report(value.span(), message, expected, help);
    }

    /// A plain number that must be there.
    pub fn number(&self, reader: &mut Reader, field: Field) -> Option<f64> {
        let value = self.required(reader, field.key, &field.line())?;
        let number = match value.get_ref() {
            DeValue::Float(float) => float.as_str().parse::<f64>().ok(),
            // A whole number too long for an integer is still a number.
            DeValue::Integer(integer) => match as_integer(integer) {
                Some(whole) => Some(whole as f64),
                None => integer.as_str().parse::<f64>().ok(),
            },
            _ => None,
        };
        if let Some(number) = number {
            return self.bounded(reader, field, value, number + 0.0, "1");
        }
        let message =
            format!("`{}` is {}, but it is a plain number", field.key, kind(value.get_ref()));
        let expected = format!("expected a number {}, without quotes or unit", field.bound.words());
        reader.report(value.span(), message, expected, format!("write {}", field.line()));
        None
    }

    /// A ratio that must be there: a plain number, or a share with % as text, such as `share`.
    pub fn ratio(&self, reader: &mut Reader, field: Field, share: &str) -> Option<f64> {
        let Field { key, bound, .. } = field;
        let value = self.required(reader, key, &field.line())?;
        let problem = match value.get_ref() {
            DeValue::Integer(_) | DeValue::Float(_) => return self.number(reader, field),
            DeValue::String(text) if !text.trim().parse::<f64>().is_ok_and(f64::is_finite) => {
                return self.quantity::<Share>(reader, field);
            }
            DeValue::String(_) => "a number in quotes without %",
            other => kind(other),
        };
        let help = match value.get_ref() {
            DeValue::String(text) => {
                let number = text.trim();
                format!("write {key} = {number}, or, if per cent is meant, {key} = \"{number} %\"")
            }
            _ => format!("write {}, or {key} = \"{share}\"", field.line()),
        };
        let expected = format!(
            "expected a number {} without quotes, or a share such as \"{share}\"",
            bound.words()
        );
        reader.report(value.span(), format!("`{key}` is {problem}"), expected, help);
        None
    }

    /// The same as [`Table::number`], or as text behind a sign that takes up the first `sign` bytes of it,
    /// if it takes up any.
    pub fn number_behind(&self, reader: &mut Reader, field: Field, sign: usize) -> Option<f64> {
        if sign == 0 {
            return self.number(reader, field);
        }
        let value = self.required(reader, field.key, &field.line())?;
        let text = value.get_ref().as_str().unwrap_or("");
        if let Ok(number) = text[sign..].trim().parse::<f64>() {
            return self.bounded(reader, field, value, number + 0.0, "1");
        }
        let message = format!("`{}` is \"{text}\", which is no number behind its sign", field.key);
        let expected = format!("expected a plain number {}", field.bound.words());
        let sign = text[..sign].trim();
        let help =
            format!("write {}, or {} = \"{sign} {}\"", field.line(), field.key, field.example);
        reader.report(value.span(), message, expected, help);
        None
    }

    fn bounded(
        &self,
        reader: &mut Reader,
        field: Field,
        value: &Spanned<DeValue>,
        number: f64,
        unit: &'static str,
    ) -> Option<f64> {
        let as_written = reader.as_written(value.span());
        if number.is_finite() && field.bound.holds(number) {
            let Field { key: name, symbol, .. } = field;
            let table = self.name;
            reader.inputs.push(Input { table, name, symbol, value: number, unit, as_written });
            return Some(number);
        }
        let message = format!("`{}` is {as_written}", field.key);
        let value_words = if number.is_finite() { "a value" } else { "a finite value" };
        let expected = format!("expected {value_words} {}", field.bound.words());
        reader.report(
            value.span(),
            message,
            expected,
            format!("write for example {}", field.line()),
        );
        None
    }

    /// A whole number that may be left out.
    pub fn whole_number(
        &self,
        reader: &mut Reader,
        field: Field,
        range: std::ops::RangeInclusive<u64>,
    ) -> Option<u64> {
        let value = self.entries.get(field.key)?;
        let DeValue::Integer(integer) = value.get_ref() else {
            let written = reader.as_written(value.span());
            let message = format!("`{}` is {written}", field.key);
            let help = format!("write for example {}", field.line());
            reader.report(value.span(), message, "expected a whole number, without quotes", help);
            return None;
        };
        let within = as_integer(integer).and_then(|whole| u64::try_from(whole).ok());
        let Some(number) = within.filter(|number| range.contains(number)) else {
            let message = format!("`{}` is {integer}", field.key);
            let expected =
                format!("expected a whole number from {} to {}", range.start(), range.end());
            reader.report(
                value.span(),
                message,
                expected,
                format!("write for example {}", field.line()),
            );
            return None;
        };
        self.bounded(reader, field, value, number as f64, "1").map(|_| number)
    }

    /// True or false, which may be left out.
    pub fn flag(&self, reader: &mut Reader, key: &'static str) -> Option<bool> {
        let value = self.entries.get(key)?;
        if let DeValue::Boolean(flag) = value.get_ref() {
            return Some(*flag);
        }
        let message = format!("`{key}` is {}, but it is true or false", kind(value.get_ref()));
        let expected = "expected true or false, without quotes";
        reader.report(value.span(), message, expected, format!("write for example {key} = true"));
        None
    }

    /// Which of two alternative keys is there; reports both and neither.
    pub fn either(&self, reader: &mut Reader, first: Field, second: Field) -> Option<&'static str> {
        match (self.has(first.key), self.has(second.key)) {
            (true, false) => Some(first.key),
            (false, true) => Some(second.key),
            (true, true) => {
                let later = [first.key, second.key]
                    .into_iter()
                    .max_by_key(|key| self.span_of(key).start)?;
                let message =
                    format!("`{}` and `{}` say the same thing twice", first.key, second.key);
                let expected = "expected only one of the two";
                reader.report(
                    self.span_of(later),
                    message,
                    expected,
                    "remove one of the two lines",
                );
                None
            }
            (false, false) => {
                let (message, expected) =
                    self.missing(&format!("`{}` or `{}`", first.key, second.key));
                let help = format!("add the line {}  or  {}", first.line(), second.line());
                reader.report(self.span.clone(), message, expected, help);
                None
            }
        }
    }
}

fn as_integer(integer: &toml::de::DeInteger) -> Option<i128> {
    i128::from_str_radix(integer.as_str(), integer.radix()).ok()
}

/// Where `range` of a string's content stands in the file; the whole value when escapes hide it.
fn inside_quotes(
    text: &str,
    value: Range<usize>,
    content: &str,
    range: Range<usize>,
) -> Range<usize> {
    let raw = &text[value.clone()];
    match raw.get(1..raw.len().saturating_sub(1)) {
        Some(inner) if inner == content && !range.is_empty() && range.len() < content.len() => {
            value.start + 1 + range.start..value.start + 1 + range.end
        }
        _ => value,
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
