//! Values of a list in a case file.

use toml::Spanned;
use toml::de::DeValue;

use super::quantity::{Dimension, Quantity};
use super::reader::{Bound, Reader};
use super::table::kind;

/// A key that holds a list of numbers, and what each may be.
#[derive(Clone, Copy)]
pub(super) struct List {
    pub key: &'static str,
    pub bound: Bound,
    /// A list as a person might write it.
    pub example: &'static str,
}

/// Reads a value of a list, and reports one that is none.
pub(super) type Item = fn(&List, &mut Reader, &Spanned<DeValue>) -> Option<f64>;

impl List {
    /// What to do about a value.
    pub fn help(&self) -> String {
        format!("write for example {} = {}", self.key, self.example)
    }

    /// Text with a unit, in SI units.
    pub fn quantity<D: Dimension>(
        &self,
        reader: &mut Reader,
        value: &Spanned<DeValue>,
    ) -> Option<f64> {
        let found = match value.get_ref() {
            DeValue::String(text) => match Quantity::<D>::parse(text) {
                Ok(quantity) => Ok(quantity.si()),
                Err(error) => Err(format!("a value that {}", error.message)),
            },
            DeValue::Integer(_) | DeValue::Float(_) => Err("a number without a unit".to_owned()),
            other => Err(kind(other).to_owned()),
        };
        let expected =
            format!("expected {} {} such as \"{}\"", D::NAME, self.bound.words(), D::EXAMPLE);
        self.bounded(reader, value, found, expected)
    }

    /// A plain number.
    pub fn number(&self, reader: &mut Reader, value: &Spanned<DeValue>) -> Option<f64> {
        let number = match value.get_ref() {
            DeValue::Float(float) => float.as_str().parse::<f64>().ok(),
            DeValue::Integer(integer) => integer.as_str().parse::<f64>().ok(),
            _ => None,
        };
        let found =
            number.ok_or_else(|| format!("{}, but its numbers are plain", kind(value.get_ref())));
        let expected = format!("expected a number {}, without quotes", self.bound.words());
        self.bounded(reader, value, found, expected)
    }

    fn bounded(
        &self,
        reader: &mut Reader,
        value: &Spanned<DeValue>,
        found: Result<f64, String>,
        expected: String,
    ) -> Option<f64> {
        let held = match found {
            Ok(number) if number.is_finite() && self.bound.holds(number) => return Some(number),
            Ok(_) => reader.as_written(value.span()),
            Err(problem) => problem,
        };
        reader.report(value.span(), format!("`{}` holds {held}", self.key), expected, self.help());
        None
    }
}
