//! The optional table `[sweep]`: which parameters `vinesink sweep` varies, and how each point is simulated.

use std::ops::RangeInclusive;

use super::Design;
use super::band::Units;
use super::quantity::Length;
use super::reader::{Bound, Field, Reader};
use super::suggest::nearest;
use super::table::Table;
use crate::system::Parameter;

/// A parameter and its values, ascending: a clearance or an amplitude over the case's own, a frequency
/// ratio, a restitution.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepAxis {
    /// What is varied.
    pub parameter: Parameter,
    /// Its values.
    pub values: Vec<f64>,
}

/// What the case says about its sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepSettings {
    /// The axes; the last of them varies fastest.
    pub axes: Vec<SweepAxis>,
    /// Starts at each point, that from rest among them.
    pub starts: u32,
    /// Excitation periods measured where a motion is not seen to repeat.
    pub periods: u64,
}

pub(super) const TABLE: &str = "sweep";
pub(super) const KEYS: &[&str] =
    &["clearance", "frequency", "amplitude", "restitution", "starts", "periods"];
/// The tables of the axes, such as `[sweep.clearance]`, and their keys.
pub(super) const AXES: [&str; 4] = ["clearance", "frequency", "amplitude", "restitution"];
pub(super) const AXIS_KEYS: &[&str] = &["from", "to", "count", "scale"];

const STARTS: RangeInclusive<u64> = 1..=1000;
const PERIODS: RangeInclusive<u64> = 48..=1_000_000;
/// Most values of an axis; the product of all axes is bounded by [`MOST_POINTS`].
const COUNT: RangeInclusive<u64> = 2..=1_000_000;
/// Most points of a sweep.
const MOST_POINTS: f64 = 1e12;
const DEFAULT_STARTS: u32 = 4;
const DEFAULT_PERIODS: u64 = 250;

/// How values are spread between the ends of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Scale {
    Linear,
    Logarithmic,
}

const SCALES: [(&str, Scale); 2] = [("linear", Scale::Linear), ("logarithmic", Scale::Logarithmic)];

/// Reads the table, which may be missing.
pub(super) fn read(
    reader: &mut Reader,
    root: &Table,
    design: Option<&Design>,
) -> Option<SweepSettings> {
    let table = reader.table(root, TABLE)?;
    let units = Units::of(design?);
    let starts = table.whole_number(reader, Field::new("starts", "N", Bound::Any, "4"), STARTS);
    let periods =
        table.whole_number(reader, Field::new("periods", "n", Bound::Any, "250"), PERIODS);
    let mut axes = Vec::new();
    for name in AXES.into_iter().filter(|name| table.has(name)) {
        let axis = reader.table(&table, name)?;
        axes.push(read_axis(reader, &axis, name, &units)?);
    }
    if axes.is_empty() {
        reader.report(
            root.span_of(TABLE),
            "the sweep varies nothing",
            "expected at least one of [sweep.clearance], [sweep.frequency], [sweep.amplitude], \
             [sweep.restitution]",
            "write for example clearance = { from = \"5 mm\", to = \"40 mm\", count = 100 }",
        );
        return None;
    }
    let points: f64 = axes.iter().map(|axis: &SweepAxis| axis.values.len() as f64).product();
    if points > MOST_POINTS {
        reader.report(
            root.span_of(TABLE),
            format!("the sweep has {points:e} points"),
            "expected at most 1e12",
            "lower the count of an axis",
        );
        return None;
    }
    Some(SweepSettings {
        axes,
        starts: starts.map_or(DEFAULT_STARTS, |starts| starts as u32),
        periods: periods.unwrap_or(DEFAULT_PERIODS),
    })
}

fn read_axis(
    reader: &mut Reader,
    table: &Table,
    name: &'static str,
    units: &Units,
) -> Option<SweepAxis> {
    let count = Field::new("count", "n", Bound::Any, "100");
    let count = table.whole_number(reader, count, COUNT);
    if count.is_none() && !table.has("count") {
        reader.report(
            table.span_of("count"),
            format!("`count` is missing in [sweep.{name}]"),
            "expected how many values the axis has",
            "add for example count = 100",
        );
    }
    let scale = read_scale(reader, table)?;
    let parameter = match name {
        "clearance" => Parameter::Clearance,
        "frequency" => Parameter::FrequencyRatio,
        "amplitude" => Parameter::Forcing,
        _ => Parameter::Restitution,
    };
    let ends = ["from", "to"].map(|key| match parameter {
        Parameter::Clearance => units.clearance(reader, table, key),
        Parameter::FrequencyRatio => units.frequency(reader, table, key, "f"),
        Parameter::Forcing => units.amplitude(reader, table, key, "F"),
        Parameter::Restitution => table.number(reader, Field::new(key, "r", Bound::UpToOne, "0.6")),
    });
    let ([from, to], count) = ([ends[0]?, ends[1]?], count?);
    if from >= to {
        let help = "write the smaller end first";
        let message = format!("`from` of [sweep.{name}] is not below its `to`");
        reader.report(table.span_of_value("to"), message, "expected `to` above `from`", help);
        return None;
    }
    if scale == Scale::Logarithmic && from <= 0.0 {
        let help = "write scale = \"linear\", or begin above 0";
        let message = "a logarithmic axis begins at 0";
        reader.report(table.span_of_value("from"), message, "expected `from` above 0", help);
        return None;
    }
    Some(SweepAxis { parameter, values: spread(from, to, count, scale) })
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

impl Units<'_> {
    /// A clearance over the case's own.
    fn clearance(&self, reader: &mut Reader, table: &Table, key: &'static str) -> Option<f64> {
        Some(match self.design() {
            Design::Physical(physical) => {
                let field = Field::new(key, "b", Bound::Positive, "\"7.5 mm\"");
                table.quantity::<Length>(reader, field)? / physical.clearance_m
            }
            Design::Reduced(reduced) => {
                let field = Field::new(key, "b", Bound::Positive, "0.5");
                table.number(reader, field)? / reduced.clearance
            }
        })
    }
}

/// Which parameters `vinesink sweep` varies, and how each point is simulated. The table may be left out.
#[derive(schemars::JsonSchema)]
#[schemars(deny_unknown_fields)]
#[expect(dead_code, reason = "describes the table to editors; read() is what reads it")]
pub(super) struct SweepTable {
    /// Clearances.
    clearance: Option<AxisTable>,
    /// Frequencies of the excitation, or frequency ratios beside [reduced].
    frequency: Option<AxisTable>,
    /// Amplitudes of the excitation, as in [excitation].
    amplitude: Option<AxisTable>,
    /// Restitutions.
    restitution: Option<AxisTable>,
    /// Starts at each point, that from rest among them; 4 unless given.
    #[schemars(range(min = 1, max = 1000), example = 4)]
    starts: Option<u64>,
    /// Excitation periods measured where a motion is not seen to repeat; 250 unless given.
    #[schemars(range(min = 48, max = 1_000_000), example = 250)]
    periods: Option<u64>,
}

/// Values of a parameter, both ends among them.
#[derive(schemars::JsonSchema)]
#[schemars(deny_unknown_fields)]
#[expect(dead_code, reason = "describes the table to editors; read() is what reads it")]
struct AxisTable {
    /// The first value, with its unit; a plain number for a restitution and beside [reduced].
    #[schemars(example = "5 mm")]
    from: serde_json::Value,
    /// The last value, above `from`.
    #[schemars(example = "40 mm")]
    to: serde_json::Value,
    /// How many values.
    #[schemars(range(min = 2, max = 1_000_000), example = 100)]
    count: u64,
    /// How they are spread: evenly unless given.
    scale: Option<AxisScale>,
}

#[derive(schemars::JsonSchema)]
#[schemars(rename_all = "kebab-case")]
#[expect(dead_code, reason = "describes a key to editors")]
enum AxisScale {
    Linear,
    Logarithmic,
}
