//! How a number is written, and what it may be: what the schema says about a key.

use serde_json::Value;

use super::quantity::Measurand;

/// How a number is written, and what it may be.
#[derive(Debug, Clone)]
pub(super) struct Form {
    /// What it measures; a plain number where there is none.
    pub measurand: Option<&'static Measurand>,
    /// Whether it may also be a plain number.
    pub plain: bool,
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
    pub fn of(schema: &Value) -> Option<Self> {
        let measurand = schema["x-measurand"].as_str().and_then(Measurand::named);
        let plain = measurand.is_none() || schema["anyOf"].is_array();
        if measurand.is_none() && schema["type"] != "number" {
            return None;
        }
        let symbol = schema["x-symbol"].as_str().unwrap_or_default().to_owned();
        let share = toml(&schema["examples"][1]);
        let (bound, example) = (Bound::of(schema), toml(&schema["examples"][0]));
        Some(Self { measurand, plain, bound, example, share, symbol })
    }

    /// A number of any size, such as `example`.
    pub fn free(measurand: Option<&'static Measurand>, example: &str, symbol: &str) -> Self {
        let [example, symbol] = [example, symbol].map(str::to_owned);
        let bound = Bound { above: None, least: None, most: None };
        Self { measurand, plain: measurand.is_none(), bound, example, share: String::new(), symbol }
    }

    /// The unit that values are held in; "1" for a plain number.
    pub fn unit(&self) -> &'static str {
        self.measurand.map_or("1", |measurand| measurand.si)
    }
}

/// The values that a number may have, besides being finite.
#[derive(Debug, Clone, Copy, PartialEq)]
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

    /// Whether there is any.
    pub fn is_any(self) -> bool {
        self.above.is_some() || self.least.is_some() || self.most.is_some()
    }

    pub fn holds(self, value: f64) -> bool {
        self.above.is_none_or(|above| value > above)
            && self.least.is_none_or(|least| value >= least)
            && self.most.is_none_or(|most| value <= most)
    }

    pub fn words(self) -> String {
        match (self.above, self.least, self.most) {
            (Some(above), ..) => format!("above {above}"),
            (None, Some(least), Some(most)) => format!("from {least} to {most}"),
            (None, Some(least), None) => format!("{least} or more"),
            _ => "of any size".to_owned(),
        }
    }
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
