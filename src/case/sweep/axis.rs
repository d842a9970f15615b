//! An axis of a sweep: the values of one parameter.

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::Value;

use super::super::reader::{Reader, Table};
use crate::excitation::Scene;
use crate::system::Parameter;
use vinesink_core::names;

/// A parameter and its values, ascending, in SI units or as plain numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepAxis {
    /// What is varied.
    pub parameter: Parameter,
    /// Its values.
    pub values: Vec<f64>,
    /// Whether each is so many times the one before, not so much more.
    pub logarithmic: bool,
}

names! { name:
    /// How values are spread between the ends of an axis.
    #[derive(schemars::JsonSchema)]
    pub(super) enum Spacing {
        /// Evenly.
        Linear = "linear",
        /// Each so many times the one before.
        Logarithmic = "logarithmic",
    }
}

/// Values of a parameter: two ends, both among the values, and a count; or a list.
#[derive(Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct AxisTable {
    /// The first value, with its unit; a plain number for a ratio and beside [reduced].
    #[schemars(with = "Option<Value>", example = &"5 mm")]
    from: Option<f64>,
    /// The last value, above `from`.
    #[schemars(with = "Option<Value>", example = &"40 mm")]
    to: Option<f64>,
    /// How many values.
    #[schemars(range(min = 2, max = 1_000_000), extend("x-symbol" = "n"), example = 100)]
    count: Option<u64>,
    /// How they are spread: evenly unless given.
    scale: Option<Spacing>,
    /// The values themselves, ascending, in place of ends and count.
    #[schemars(with = "Option<Vec<Value>>", length(min = 1), extend("x-ascending" = true))]
    values: Option<Vec<f64>>,
}

/// Reads the axis of a parameter.
pub(super) fn read(reader: &mut Reader, sweep: &Table, parameter: Parameter) -> Option<SweepAxis> {
    let name = parameter.key();
    let table = reader.table::<AxisTable>(sweep, name)?;
    if let Some(design) = reader.design.filter(|design| design.form(parameter).is_none()) {
        let structure = format!("a structure that is {}", design.scene().words());
        let writing = design.writing();
        let other = (design.counterpart(parameter), design.carried(parameter), design.scene());
        let (this, other) = match other {
            (Some(other), ..) => (writing.words, other.key()),
            (_, Some(carried), _) => (carried, "clearance"),
            (.., Scene::Steady) => (writing.words, writing.steady),
            _ => (structure.as_str(), "clearance"),
        };
        reader.report(
            table.span_of(""),
            format!("{this} has no `{name}` to vary"),
            "expected a number that the design has",
            format!("vary {other} instead, or remove the axis"),
        );
        return None;
    }
    let of_ends = ["from", "to", "count", "scale"].into_iter().filter(|key| table.has(key));
    if let (Some(key), true) = (of_ends.clone().next(), table.has("values")) {
        let message = format!("`{key}` and `values` both say what the axis holds");
        let expected = "expected a list, or two ends and a count";
        reader.report(table.span_of(key), message, expected, "remove one of the two");
        return None;
    }
    if !table.has("values") {
        for key in ["from", "to", "count"].into_iter().filter(|key| !table.has(key)) {
            let message = format!("`{key}` is missing in [sweep.{name}]");
            let expected = "expected two ends and how many values the axis has, or a list `values`";
            let help = format!("add for example {}", reader.line(&table, key));
            reader.report(table.span_of(key), message, expected, help);
        }
    }
    let read = reader.read::<AxisTable>(&table)?;
    if let Some(values) = read.values {
        return Some(SweepAxis { parameter, values, logarithmic: false });
    }
    let (from, to, count) = (read.from?, read.to?, read.count?);
    let logarithmic = read.scale == Some(Spacing::Logarithmic);
    if from >= to {
        let help = "write the smaller end first";
        let message = format!("`from` of [sweep.{name}] is not below its `to`");
        reader.report(table.span_of_value("to"), message, "expected `to` above `from`", help);
        return None;
    }
    if logarithmic && from <= 0.0 {
        let help = "write scale = \"linear\", or begin above 0";
        let message = "a logarithmic axis does not begin above 0";
        reader.report(table.span_of_value("from"), message, "expected `from` above 0", help);
        return None;
    }
    let values = spread(from, to, count, logarithmic);
    Some(SweepAxis { parameter, values, logarithmic })
}

/// `count` values from one end to the other, both among them.
fn spread(from: f64, to: f64, count: u64, logarithmic: bool) -> Vec<f64> {
    let last = (count - 1) as f64;
    let at = |k: u64| {
        let part = k as f64 / last;
        let value = match logarithmic {
            false => from * (1.0 - part) + to * part,
            true => from * libm::pow(to / from, part),
        };
        value.clamp(from, to)
    };
    (0..count).map(at).collect()
}
