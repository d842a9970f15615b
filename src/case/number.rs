//! How a number is written, and what it may be; reading one, with the unit that its form asks for.

use std::ops::Range;

use serde_json::Value;
use toml::de::DeValue;

use super::error::Problem;
use super::inputs::Input;
use super::reader::{Reader, kind};
use super::restitution::alternatives;
use super::value::ValuePlace;
use crate::quantity::Dimension;

/// How a number is written, and what it may be.
#[derive(Debug, Clone)]
pub(super) struct Form {
    /// What it measures; a plain number where there is none.
    pub dimension: Option<Dimension>,
    /// Whether its unit is one of that dimension alone, not of another that has the same name.
    pub exact: bool,
    /// Whether it may also be a plain number.
    pub plain: bool,
    /// Whether it is a whole number.
    pub whole: bool,
    pub bound: Bound,
    /// A value as a person might write it, quotes included.
    pub example: String,
    /// The same as a share, where it may be either.
    pub share: String,
    /// The symbol in LaTeX.
    pub symbol: String,
}

impl Form {
    /// That of a schema; `None` for what is no number.
    pub fn of(schema: &'static Value) -> Option<Self> {
        let schema = alternatives(schema).map_or(schema, |[number, _]| number);
        let dimension = schema["x-measurand"].as_str().and_then(Dimension::named);
        let whole = schema["type"] == "integer";
        if dimension.is_none() && !whole && schema["type"] != "number" {
            return None;
        }
        Some(Self {
            dimension,
            exact: false,
            plain: dimension.is_none() || schema["anyOf"].is_array(),
            whole,
            bound: Bound::of(schema),
            example: toml(&schema["examples"][0]),
            share: toml(&schema["examples"][1]),
            symbol: schema["x-symbol"].as_str().unwrap_or_default().to_owned(),
        })
    }

    /// A number of any size, such as `example`.
    pub fn free(dimension: Option<Dimension>, example: &str, symbol: &str) -> Self {
        let [example, symbol] = [example, symbol].map(str::to_owned);
        let (plain, bound, share) = (dimension.is_none(), Bound::default(), String::new());
        Self { dimension, exact: false, plain, whole: false, bound, example, share, symbol }
    }

    /// The unit that values are held in; "1" for a plain number.
    pub fn unit(&self) -> &'static str {
        self.dimension.map_or("1", |dimension| dimension.symbol(true))
    }

    /// What its values may be, angles in degrees.
    fn bound(&self) -> String {
        let Bound { least, most, .. } = self.bound;
        match (self.dimension, least, most) {
            (Some(Dimension::Inclination), Some(least), Some(most)) => {
                let [least, most] = [least, most].map(|end| libm::rint(end.to_degrees()));
                format!("from {least} deg to {most} deg")
            }
            _ => self.bound.words(),
        }
    }

    fn expected(&self) -> String {
        let (words, Self { example, share, .. }) = (self.bound(), self);
        match self.dimension {
            None if self.whole => format!("expected a whole number {words}, without quotes"),
            None => format!("expected a number {words}, without quotes or unit"),
            Some(dimension) if self.plain => {
                let what = dimension.words().0;
                format!("expected a number {words} without quotes, or {what} such as {share}")
            }
            Some(dimension) => format!("expected {} such as {example}", dimension.words().0),
        }
    }
}

/// The values that a number may have, besides being finite.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Bound {
    /// The least, itself excepted.
    above: Option<f64>,
    least: Option<f64>,
    most: Option<f64>,
}

impl Bound {
    pub fn of(schema: &Value) -> Self {
        let [above, least, most] =
            ["exclusiveMinimum", "minimum", "maximum"].map(|word| schema[word].as_f64());
        Self { above, least, most }
    }

    fn holds(self, value: f64) -> bool {
        self.above.is_none_or(|above| value > above)
            && self.least.is_none_or(|least| value >= least)
            && self.most.is_none_or(|most| value <= most)
    }

    fn words(self) -> String {
        match (self.above, self.least, self.most) {
            (Some(above), _, Some(most)) => format!("above {above} and up to {most}"),
            (Some(above), ..) => format!("above {above}"),
            (None, Some(least), Some(most)) => format!("from {least} to {most}"),
            (None, Some(least), None) => format!("{least} or more"),
            _ => "of any size".to_owned(),
        }
    }
}

/// The bytes that one of some signs takes up at the beginning of a text.
pub(super) fn sign_of(text: &str, signs: &[&str]) -> Option<usize> {
    let begun = text.trim_start();
    let sign = signs.iter().find(|sign| begun.starts_with(**sign))?;
    Some(text.len() - begun.len() + sign.len())
}

/// A value as it is written in a case.
pub(super) fn toml(value: &Value) -> String {
    match value {
        Value::Array(items) => {
            format!("[{}]", items.iter().map(toml).collect::<Vec<_>>().join(", "))
        }
        other => other.to_string(),
    }
}

impl Reader<'_> {
    /// A number, in SI units, which is kept as an input of the case.
    pub fn number(&mut self, place: &ValuePlace, form: &Form) -> Option<f64> {
        let text = place.value.get_ref().as_str().unwrap_or_default();
        let of_text = |one: Dimension| if form.exact { one } else { one.of_namesake(text) };
        let dimension = form.dimension.map(of_text);
        let form = &Form { dimension, ..form.clone() };
        let number = match place.value.get_ref() {
            DeValue::Integer(_) if form.plain => plain_number(place.value.get_ref()),
            DeValue::Float(_) if form.plain && !form.whole => plain_number(place.value.get_ref()),
            DeValue::String(text) if !form.whole => self.quoted(place, form, text),
            _ => self.no_number(place, form),
        };
        self.bounded(place, form, number?)
    }

    /// A quantity, or a plain number behind a sign.
    fn quoted(&mut self, place: &ValuePlace, form: &Form, text: &str) -> Option<f64> {
        let ValuePlace { line, key, sign, .. } = place;
        let behind = text[*sign..].trim();
        let plain = behind.parse::<f64>().ok().filter(|_| form.plain);
        match (plain, form.dimension) {
            (Some(number), _) if *sign > 0 => return Some(number),
            (Some(number), Some(_)) if number.is_finite() => {
                let share = form.dimension == Some(Dimension::Share);
                let (problem, help) = match share {
                    true => (
                        "is a number in quotes without %",
                        format!(
                            "write {key} = {behind}, or, if per cent is meant, {key} = \"{behind} %\""
                        ),
                    ),
                    false => (
                        "is a number in quotes without a unit",
                        format!("write {behind} without quotes, or a unit behind it"),
                    ),
                };
                self.refuse(place, problem, form.expected(), help);
            }
            (_, Some(dimension)) => match dimension.parse_behind(text, *sign) {
                Ok(number) => return Some(number),
                Err(error) => {
                    let span = inside_quotes(self.text, place.value.span(), text, error.range);
                    let message = format!("{} {}", place.subject, error.message);
                    let (name, example) = dimension.words();
                    let expected = format!("expected {name} such as \"{example}\"");
                    self.keep(|text| {
                        let problem = Problem::new(text, span, message, expected);
                        match error.help {
                            Some(help) => problem.help(help),
                            None => problem,
                        }
                    });
                }
            },
            (_, None) if *sign > 0 => {
                let problem = format!("is \"{text}\", which is no number behind its sign");
                let expected = format!("expected a plain number {}", form.bound.words());
                let sign = text[..*sign].trim();
                let help = format!("write {line}, or {key} = \"{sign} {}\"", form.example);
                self.refuse(place, &problem, expected, help);
            }
            (_, None) => return self.no_number(place, form),
        }
        None
    }

    /// Reports what is not written as its form says.
    fn no_number(&mut self, place: &ValuePlace, form: &Form) -> Option<f64> {
        let written = self.as_written(place.value.span());
        let kind = kind(place.value.get_ref());
        let mut help = format!("write for example {}", place.line);
        let problem = match form.dimension {
            None if form.whole => format!("is {written}"),
            None => format!("is {kind}, where a plain number belongs"),
            Some(_) if plain_number(place.value.get_ref()).is_some_and(|one| !one.is_finite()) => {
                format!("is {written}, which is not a finite number")
            }
            Some(dimension) if kind == "a number" => {
                // That of the key's own example, else of any.
                let examples = [form.example.trim_matches('"'), dimension.words().1];
                let unit = examples.iter().find_map(|one| Some(one.split_once(' ')?.1));
                let unit = unit.unwrap_or_default();
                let key = if place.alone { format!("{} = ", place.key) } else { String::new() };
                help = format!("if {unit} is meant, write {key}\"{written} {unit}\"");
                "has no unit".to_owned()
            }
            Some(_) => format!("is {kind}"),
        };
        self.refuse(place, &problem, form.expected(), help);
        None
    }

    fn bounded(&mut self, place: &ValuePlace, form: &Form, value: f64) -> Option<f64> {
        let as_written = self.as_written(place.value.span());
        if value.is_finite() && form.bound.holds(value) {
            if place.alone {
                let (table, name) = (place.table.to_owned(), place.key);
                let (symbol, unit) = (form.symbol.clone(), form.unit());
                let span = place.value.span();
                self.inputs.push(Input { table, name, symbol, value, unit, as_written, span });
            }
            return Some(value);
        }
        let (shown, what) = match form.whole {
            true => (as_written.replace('_', ""), "whole number"),
            false if value.is_finite() => (as_written, "value"),
            false => (as_written, "finite value"),
        };
        let expected = format!("expected a {what} {}", form.bound());
        let help = format!("write for example {}", place.line);
        self.refuse(place, &format!("is {shown}"), expected, help);
        None
    }
}

/// A number without a unit, whole or not.
pub(super) fn plain_number(value: &DeValue) -> Option<f64> {
    let number = match value {
        // A whole number too long for an integer is still a number.
        DeValue::Integer(integer) => i128::from_str_radix(integer.as_str(), integer.radix())
            .map_or_else(|_| integer.as_str().parse::<f64>().ok(), |whole| Some(whole as f64)),
        DeValue::Float(float) => float.as_str().parse::<f64>().ok(),
        _ => None,
    };
    // Adding 0 makes -0 an ordinary 0.
    number.map(|number| number + 0.0)
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
