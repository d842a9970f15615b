//! Numbers with their meaning: what a number is stands once in the [`catalogue`], how it is written in
//! [`units`]. Pages, tables, axes, criteria and files take name, symbol, unit and digits from there.
//!
//! For the program itself: this module may change at any time.

pub mod catalogue;
pub mod numbers;
pub mod unit;
pub mod units;

use serde::ser::{Serialize, SerializeStruct, Serializer};

pub use catalogue::{Digits, Dimension, ErrorKind, Kind};
pub use units::Units;

use crate::method::Method;

/// A number, how far it may be off, and what gave it. In SI; for a case in reduced units, in those of an
/// oscillator with m1 = k1 = 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantity {
    /// What it is.
    pub kind: &'static Kind,
    /// The value; infinite where nothing limits it, NaN where it is unknown.
    pub value: f64,
    /// How far it may be off, in the same unit; 0 where it is exact to rounding.
    pub error: f64,
    /// What gave it.
    pub method: Method,
}

impl Quantity {
    /// A number without error.
    pub const fn new(kind: &'static Kind, value: f64, method: Method) -> Self {
        Self { kind, value, error: 0.0, method }
    }

    /// The same with an error.
    #[must_use]
    pub const fn with_error(self, error: f64) -> Self {
        Self { error, ..self }
    }
}

/// As `{id, value, error, method}`. JSON has no infinite number: `value` is then `null`.
impl Serialize for Quantity {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = serializer.serialize_struct("Quantity", 4)?;
        fields.serialize_field("id", self.kind.id)?;
        fields.serialize_field("value", &Some(self.value).filter(|value| value.is_finite()))?;
        fields.serialize_field("error", &self.error)?;
        fields.serialize_field("method", &self.method)?;
        fields.end()
    }
}
