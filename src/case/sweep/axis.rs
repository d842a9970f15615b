//! An axis of a sweep: the values of one parameter.

use std::ops::RangeInclusive;

use toml::Spanned;
use toml::de::DeValue;

use super::super::Design;
use super::super::list::List;
use super::super::quantity::{Damping, Force, Frequency, Length, Mass, Stiffness, Velocity};
use super::super::reader::{Bound, Field, Reader};
use super::super::suggest::nearest;
use super::super::table::Table;
use super::parameter::{Form, SweepParameter, Written};

/// A parameter and its values, ascending, in SI units or as plain numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepAxis {
    /// What is varied.
    pub parameter: SweepParameter,
    /// Its values.
    pub values: Vec<f64>,
    /// Whether each is so many times the one before, not so much more.
    pub logarithmic: bool,
}

pub(in super::super) const KEYS: &[&str] = &["from", "to", "count", "scale", "values"];

/// Most values of an axis; the product of all axes is bounded elsewhere.
const COUNT: RangeInclusive<u64> = 2..=1_000_000;

/// How values are spread between the ends of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Scale {
    Linear,
    Logarithmic,
}

const SCALES: [(&str, Scale); 2] = [("linear", Scale::Linear), ("logarithmic", Scale::Logarithmic)];

/// Reads the axis of a parameter.
pub(super) fn read(
    reader: &mut Reader,
    table: &Table,
    parameter: SweepParameter,
    design: &Design,
) -> Option<SweepAxis> {
    let name = parameter.key();
    let Some(form) = parameter.form(design) else {
        let (this, other) = match design {
            Design::Physical(_) => ("[oscillator], [absorber] and [excitation]", "frequency"),
            Design::Reduced(_) => ("[reduced]", "mass_ratio or damping"),
        };
        reader.report(
            table.span_of(""),
            format!("a design in {this} has no `{name}` to vary"),
            "expected a number that the design has",
            format!("vary {other} instead, or remove the axis"),
        );
        return None;
    };
    if table.has("values") {
        let also = ["from", "to", "count", "scale"].into_iter().find(|key| table.has(key));
        if let Some(key) = also {
            let message = format!("`{key}` and `values` both say what the axis holds");
            let expected = "expected a list, or two ends and a count";
            reader.report(table.span_of(key), message, expected, "remove one of the two");
            return None;
        }
        let values = read_list(reader, table, form)?;
        return Some(SweepAxis { parameter, values, logarithmic: false });
    }
    let count = Field::new("count", "n", Bound::Any, "100");
    let count = table.whole_number(reader, count, COUNT);
    if count.is_none() && !table.has("count") {
        reader.report(
            table.span_of("count"),
            format!("`count` is missing in [sweep.{name}]"),
            "expected how many values the axis has, or a list `values`",
            "add for example count = 100",
        );
    }
    let scale = read_scale(reader, table)?;
    let ends = ["from", "to"].map(|key| form.value(reader, table, key, parameter));
    let ([from, to], count) = ([ends[0]?, ends[1]?], count?);
    if from >= to {
        let help = "write the smaller end first";
        let message = format!("`from` of [sweep.{name}] is not below its `to`");
        reader.report(table.span_of_value("to"), message, "expected `to` above `from`", help);
        return None;
    }
    if scale == Scale::Logarithmic && from <= 0.0 {
        let help = "write scale = \"linear\", or begin above 0";
        let message = "a logarithmic axis does not begin above 0";
        reader.report(table.span_of_value("from"), message, "expected `from` above 0", help);
        return None;
    }
    let values = spread(from, to, count, scale);
    Some(SweepAxis { parameter, values, logarithmic: scale == Scale::Logarithmic })
}

/// `count` values from one end to the other, both among them.
fn spread(from: f64, to: f64, count: u64, scale: Scale) -> Vec<f64> {
    let last = (count - 1) as f64;
    let at = |k: u64| {
        let part = k as f64 / last;
        let value = match scale {
            Scale::Linear => from * (1.0 - part) + to * part,
            Scale::Logarithmic => from * libm::pow(to / from, part),
        };
        value.clamp(from, to)
    };
    (0..count).map(at).collect()
}

fn read_list(reader: &mut Reader, table: &Table, form: Form) -> Option<Vec<f64>> {
    let (_, value) = table.entry("values")?;
    let list = List { key: "values", bound: form.bound, example: form.list_example() };
    let DeValue::Array(items) = value.get_ref() else {
        let written = reader.as_written(value.span());
        let message = format!("`values` is {written}");
        reader.report(value.span(), message, "expected a list, between brackets", list.help());
        return None;
    };
    let mut values = Vec::with_capacity(items.len());
    for item in items {
        values.push(form.item(&list, reader, item)?);
    }
    if values.is_empty() || values.windows(2).any(|two| two[0] >= two[1]) {
        let message = match values.is_empty() {
            true => "`values` is empty",
            false => "the numbers of `values` do not rise",
        };
        let help = "sort them, and keep each once";
        reader.report(value.span(), message, "expected each above the one before", help);
        return None;
    }
    Some(values)
}

fn read_scale(reader: &mut Reader, table: &Table) -> Option<Scale> {
    if !table.has("scale") {
        return Some(Scale::Linear);
    }
    let written = table.text(reader, "scale", "scale = \"linear\"")?;
    let found = SCALES.iter().find(|(name, _)| *name == written);
    if found.is_none() {
        let names = SCALES.map(|(name, _)| name);
        let help = match nearest(written, &names) {
            Some(near) => format!("did you mean \"{near}\"?"),
            None => "write for example scale = \"linear\"".to_owned(),
        };
        let message = format!("`scale` is \"{written}\"");
        let expected = "expected \"linear\" or \"logarithmic\"";
        reader.report(table.span_of_value("scale"), message, expected, help);
    }
    found.map(|(_, scale)| *scale)
}

impl Form {
    /// The value of a key, in SI units.
    fn value(
        self,
        reader: &mut Reader,
        table: &Table,
        key: &'static str,
        parameter: SweepParameter,
    ) -> Option<f64> {
        let field = Field::new(key, parameter.symbol(), self.bound, self.example);
        match self.written {
            Written::Number => table.number(reader, field),
            Written::Length => table.quantity::<Length>(reader, field),
            Written::Mass => table.quantity::<Mass>(reader, field),
            Written::Frequency => table.quantity::<Frequency>(reader, field),
            Written::Stiffness => table.quantity::<Stiffness>(reader, field),
            Written::Damping => table.quantity::<Damping>(reader, field),
            Written::Force => table.quantity::<Force>(reader, field),
            Written::Velocity => table.quantity::<Velocity>(reader, field),
        }
    }

    /// A value of a list, in SI units.
    fn item(self, list: &List, reader: &mut Reader, value: &Spanned<DeValue>) -> Option<f64> {
        match self.written {
            Written::Number => list.number(reader, value),
            Written::Length => list.quantity::<Length>(reader, value),
            Written::Mass => list.quantity::<Mass>(reader, value),
            Written::Frequency => list.quantity::<Frequency>(reader, value),
            Written::Stiffness => list.quantity::<Stiffness>(reader, value),
            Written::Damping => list.quantity::<Damping>(reader, value),
            Written::Force => list.quantity::<Force>(reader, value),
            Written::Velocity => list.quantity::<Velocity>(reader, value),
        }
    }

    fn list_example(self) -> &'static str {
        match self.written {
            Written::Number => "[0.5, 0.6]",
            Written::Length => "[\"5 mm\", \"7.5 mm\"]",
            Written::Mass => "[\"20 g\", \"32 g\"]",
            Written::Frequency => "[\"8 Hz\", \"8.5 Hz\"]",
            Written::Stiffness => "[\"11 kN/m\", \"12 kN/m\"]",
            Written::Damping => "[\"1 N s/m\", \"3 N s/m\"]",
            Written::Force => "[\"1 N\", \"3 N\"]",
            Written::Velocity => "[\"0 m/s\", \"0.2 m/s\"]",
        }
    }
}

/// Values of a parameter: two ends, both among the values, and a count; or a list.
#[derive(schemars::JsonSchema)]
#[schemars(deny_unknown_fields)]
#[expect(dead_code, reason = "describes the table to editors; read() is what reads it")]
pub(super) struct AxisTable {
    /// The first value, with its unit; a plain number for a ratio and beside [reduced].
    #[schemars(example = &"5 mm")]
    from: Option<serde_json::Value>,
    /// The last value, above `from`.
    #[schemars(example = &"40 mm")]
    to: Option<serde_json::Value>,
    /// How many values.
    #[schemars(range(min = 2, max = 1_000_000), example = 100)]
    count: Option<u64>,
    /// How they are spread: evenly unless given.
    scale: Option<AxisScale>,
    /// The values themselves, ascending, in place of ends and count.
    values: Option<Vec<serde_json::Value>>,
}

#[derive(schemars::JsonSchema)]
#[schemars(rename_all = "kebab-case")]
#[expect(dead_code, reason = "describes a key to editors")]
enum AxisScale {
    Linear,
    Logarithmic,
}
