//! Reads a number, with the unit that its form asks for.

use std::ops::Range;

use toml::de::{DeString, DeValue};

use super::error::Problem;
use super::form::Form;
use super::inputs::Input;
use super::quantity::QuantityError;
use super::reader::Reader;
use super::table::kind;
use super::value::Place;

impl Reader<'_> {
    /// A number, in SI units.
    pub fn number(&mut self, place: &Place, form: &Form) -> Option<f64> {
        let behind_sign = |text: &DeString| text[place.sign..].trim().parse::<f64>().ok();
        let number = match (place.value.get_ref(), form.measurand) {
            (DeValue::String(text), _)
                if form.plain && place.sign > 0 && behind_sign(text).is_some() =>
            {
                behind_sign(text)
            }
            (DeValue::String(text), None) if place.sign > 0 => {
                self.no_number_behind_sign(place, form, text)
            }
            (DeValue::String(text), Some(_))
                if form.plain && behind_sign(text).is_some_and(f64::is_finite) =>
            {
                self.no_per_cent(place, form, text.trim())
            }
            (DeValue::String(text), Some(measurand)) => {
                match measurand.parse(&text[place.sign..]) {
                    Ok(number) => Some(number),
                    Err(error) => self.no_quantity(place, text, error),
                }
            }
            (other, _) => match plain_number(other).filter(|_| form.plain) {
                Some(number) => Some(number),
                None => self.no_number(place, form, other),
            },
        };
        self.bounded(place, form, number?)
    }

    fn no_per_cent(&mut self, place: &Place, form: &Form, number: &str) -> Option<f64> {
        let key = place.key;
        let help =
            format!("write {key} = {number}, or, if per cent is meant, {key} = \"{number} %\"");
        self.refuse(place, "is a number in quotes without %", plain_or_share(form), help);
        None
    }

    fn no_number_behind_sign(&mut self, place: &Place, form: &Form, text: &str) -> Option<f64> {
        let sign = text[..place.sign].trim();
        let problem = format!("is \"{text}\", which is no number behind its sign");
        let expected = format!("expected a plain number {}", form.bound.words());
        let Place { line, key, .. } = place;
        let help = format!("write {line}, or {key} = \"{sign} {}\"", form.example);
        self.refuse(place, &problem, expected, help);
        None
    }

    /// Reports a text that is no quantity; what is to be written instead keeps its sign.
    fn no_quantity(&mut self, place: &Place, text: &DeString, error: QuantityError) -> Option<f64> {
        let range = place.sign + error.range.start..place.sign + error.range.end;
        let span = inside_quotes(self.text, place.value.span(), text, range);
        let corrected = |help: String| match help.strip_prefix("write \"") {
            Some(rest) => format!("write \"{}{rest}", &text[..place.sign]),
            None => help,
        };
        let message = format!("{} {}", place.subject, error.message);
        let problem = Problem::new(self.text, span, message, error.expected);
        self.problems.push(Problem { help: error.help.map(corrected), ..problem });
        None
    }

    /// Reports what is neither text nor a number where one of these belongs.
    fn no_number(&mut self, place: &Place, form: &Form, found: &DeValue) -> Option<f64> {
        let write = format!("write {}", place.line);
        let words = form.bound.words();
        let (problem, expected, help) = match (form.measurand, found) {
            (None, _) => (
                format!("is {}, but it is a plain number", kind(found)),
                format!("expected a number {words}, without quotes or unit"),
                write,
            ),
            (Some(_), _) if form.plain => {
                let help = format!("{write}, or {} = {}", place.key, form.share);
                (format!("is {}", kind(found)), plain_or_share(form), help)
            }
            (Some(measurand), DeValue::Integer(_) | DeValue::Float(_)) => {
                let unit = measurand.example.split_once(' ').map_or(measurand.si, |(_, unit)| unit);
                let written = self.as_written(place.value.span());
                let help = match place.alone {
                    true => {
                        format!("if {unit} is meant, write {} = \"{written} {unit}\"", place.key)
                    }
                    false => format!("if {unit} is meant, write \"{written} {unit}\""),
                };
                ("has no unit".to_owned(), expected_quantity(form), help)
            }
            (Some(_), _) => (format!("is {}", kind(found)), expected_quantity(form), write),
        };
        self.refuse(place, &problem, expected, help);
        None
    }

    /// A number within its bounds, which is kept as an input of the case.
    pub fn bounded(&mut self, place: &Place, form: &Form, number: f64) -> Option<f64> {
        let as_written = self.as_written(place.value.span());
        if number.is_finite() && form.bound.holds(number) {
            if place.alone {
                let (table, name, symbol) =
                    (place.table.to_owned(), place.key, form.symbol.clone());
                let unit = form.unit();
                self.inputs.push(Input { table, name, symbol, value: number, unit, as_written });
            }
            return Some(number);
        }
        let value = if number.is_finite() { "a value" } else { "a finite value" };
        let expected = format!("expected {value} {}", form.bound.words());
        let help = format!("write for example {}", place.line);
        self.refuse(place, &format!("is {as_written}"), expected, help);
        None
    }
}

/// A number without a unit, whole or not.
fn plain_number(value: &DeValue) -> Option<f64> {
    let number = match value {
        DeValue::Float(float) => float.as_str().parse::<f64>().ok()?,
        // A whole number too long for an integer is still a number.
        DeValue::Integer(integer) => {
            match i128::from_str_radix(integer.as_str(), integer.radix()) {
                Ok(whole) => whole as f64,
                Err(_) => integer.as_str().parse::<f64>().ok()?,
            }
        }
        _ => return None,
    };
    // Adding 0 makes -0 an ordinary 0.
    Some(number + 0.0)
}

fn expected_quantity(form: &Form) -> String {
    let name = form.measurand.map_or("a number", |measurand| measurand.name);
    format!("expected {name} such as {}", form.example)
}

fn plain_or_share(form: &Form) -> String {
    let Form { bound, share, .. } = form;
    format!("expected a number {} without quotes, or a share such as {share}", bound.words())
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
