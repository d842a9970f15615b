//! Rows as columns with names and units.

use super::Plan;
use super::row::{Main, Row, area_name, strip_name};
use crate::case::Scales;
use crate::regimes::Regime;
use crate::system::Parameter;

/// Values of a column; nothing where a point has none.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Numbers.
    Number(Vec<Option<f64>>),
    /// Whole numbers.
    Whole(Vec<i64>),
    /// Words.
    Text(Vec<Option<&'static str>>),
}

/// A column.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Its name.
    pub name: &'static str,
    /// Its unit; `1` for a pure number, empty for words.
    pub unit: &'static str,
    /// Its values.
    pub values: Values,
}

/// The columns of some rows, in the units of the case.
pub fn columns(plan: &Plan, rows: &[Row]) -> Vec<Column> {
    let scales = &plan.scales;
    let length = scales.length_unit().symbol();
    let mut columns = vec![Column {
        name: "point",
        unit: "1",
        values: Values::Whole(rows.iter().map(|row| row.point as i64).collect()),
    }];
    for (index, axis) in plan.settings.axes.iter().enumerate() {
        let (name, unit) = axis_name(axis.parameter, scales);
        let value = |row: &Row| axis_value(axis.parameter, row.coordinates[index].value, scales);
        columns.push(number(name, unit, rows, |row| Some(value(row))));
    }
    let main = |of: fn(&Main) -> f64| move |row: &Row| row.main.as_ref().map(of);
    let lengths = |of: fn(&Row) -> Option<f64>| {
        move |row: &Row| of(row).map(|over_own| scales.length(over_own))
    };
    columns.push(text("area", rows, |row| Some(area_name(row.zone))));
    columns.push(text("strip", rows, |row| strip_name(row.zone)));
    columns.push(number("orbit_peak", length, rows, lengths(|row| row.orbit_peak)));
    columns.push(number("bare_amplitude", length, rows, lengths(|row| row.bare)));
    columns.push(text("regime", rows, |row| row.main.map(|main| regime_name(main.regime))));
    columns.push(number("impacts_per_period", "1", rows, main(|main| main.impacts_per_period)));
    columns.push(number("peak", length, rows, lengths(|row| row.main.map(|main| main.peak))));
    columns.push(number("rms", length, rows, lengths(|row| row.main.map(|main| main.rms))));
    columns.push(number("share_of_starts", "1", rows, main(|main| main.share)));
    columns.push(number("reduction_db", "dB", rows, |row| {
        row.main.zip(row.bare).map(|(main, bare)| 20.0 * libm::log10(bare / main.peak))
    }));
    columns.push(number("largest_peak", length, rows, lengths(|row| row.largest_peak)));
    columns.push(Column {
        name: "motions",
        unit: "1",
        values: Values::Whole(rows.iter().map(|row| i64::from(row.motions)).collect()),
    });
    columns
}

fn number(
    name: &'static str,
    unit: &'static str,
    rows: &[Row],
    of: impl Fn(&Row) -> Option<f64>,
) -> Column {
    let finite = |row: &Row| of(row).filter(|value| value.is_finite());
    Column { name, unit, values: Values::Number(rows.iter().map(finite).collect()) }
}

fn text(name: &'static str, rows: &[Row], of: impl Fn(&Row) -> Option<&'static str>) -> Column {
    Column { name, unit: "", values: Values::Text(rows.iter().map(of).collect()) }
}

/// Name and unit of an axis.
fn axis_name(parameter: Parameter, scales: &Scales) -> (&'static str, &'static str) {
    let physical = scales.natural_frequency_rad_per_s.is_some();
    match parameter {
        Parameter::Clearance => ("clearance", scales.length_unit().symbol()),
        Parameter::FrequencyRatio if physical => ("frequency", "Hz"),
        Parameter::FrequencyRatio => ("frequency_ratio", "1"),
        // Over the case's own, whatever that is an amplitude of.
        Parameter::Forcing => ("amplitude_over_own", "1"),
        Parameter::Restitution => ("restitution", "1"),
    }
}

fn axis_value(parameter: Parameter, value: f64, scales: &Scales) -> f64 {
    match parameter {
        Parameter::Clearance => scales.length(value),
        Parameter::FrequencyRatio => scales.frequency_hz(value).unwrap_or(value),
        Parameter::Forcing | Parameter::Restitution => value,
    }
}

fn regime_name(regime: Regime) -> &'static str {
    match regime {
        Regime::AtRest => "at-rest",
        Regime::AboveTwo => "above-two",
        Regime::TwoAsymmetric => "two-asymmetric",
        Regime::TwoSymmetric => "two-symmetric",
        Regime::StronglyModulated => "strongly-modulated",
        Regime::BelowTwo => "below-two",
    }
}
