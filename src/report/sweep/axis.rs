//! An axis of a sweep in the units that the case's reader uses.

use serde::{Serialize, Serializer};

use crate::case::{Case, SweepAxis, SweepParameter};
use crate::report::figure::{Axis, Scale, edges};
use crate::report::numbers::{LengthFormat, significant};

/// An axis as it is shown.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AxisShown {
    /// What is varied.
    #[serde(rename = "key", serialize_with = "key")]
    pub parameter: SweepParameter,
    /// What it is: `clearance`.
    pub name: String,
    /// The name with symbol and unit: `clearance b (mm)`.
    pub label: String,
    /// The shown unit; empty for a pure number.
    pub unit: String,
    /// Its values in the shown unit, ascending.
    pub values: Vec<f64>,
    /// Whether each is so many times the one before.
    pub logarithmic: bool,
    /// The case's own value in the shown unit, where the case has one.
    pub own: Option<f64>,
}

impl AxisShown {
    /// An axis of a case's table `[sweep]`.
    pub fn of(case: &Case, axis: &SweepAxis) -> Self {
        let SweepAxis { parameter, ref values, logarithmic } = *axis;
        let (unit, size) = shown_unit(case, axis);
        let [name, symbol] = parameter.words(&case.design);
        Self {
            parameter,
            name: name.to_owned(),
            label: format!("{name} {symbol} ({})", if unit.is_empty() { "1" } else { unit }),
            unit: unit.to_owned(),
            values: values.iter().map(|value| value / size).collect(),
            logarithmic,
            own: parameter.of(&case.design).map(|own| own / size),
        }
    }

    /// Whether it varies where motions start, not the system.
    pub fn is_initial(&self) -> bool {
        self.parameter.is_initial()
    }

    /// The boundaries of the values' cells.
    pub(super) fn edges(&self) -> Vec<f64> {
        edges(&self.values, self.scale())
    }

    const fn scale(&self) -> Scale {
        if self.logarithmic { Scale::Log } else { Scale::Linear }
    }

    /// The axis of a figure, from one value to another.
    pub(super) fn drawn(&self, from: f64, to: f64) -> Axis {
        let axis = Axis::linear(self.label.clone()).with_range(from, to);
        Axis { scale: self.scale(), ..axis }
    }

    /// A value with so many digits that neighbours differ, and its unit.
    pub(super) fn number(&self, index: usize) -> String {
        let value = self.values[index];
        let near = [index.checked_sub(1), Some(index + 1)];
        let step = near
            .into_iter()
            .flatten()
            .filter_map(|k| Some((self.values.get(k)? - value).abs()))
            .fold(f64::INFINITY, f64::min);
        let needed = libm::ceil(libm::log10(value.abs() / step));
        let digits = if needed.is_finite() { needed.clamp(3.0, 6.0) as usize } else { 3 };
        let number = significant(value, digits);
        if self.unit.is_empty() { number } else { format!("{number} {}", self.unit) }
    }

    /// The same with its name.
    pub(super) fn text(&self, index: usize) -> String {
        format!("{} {}", self.name, self.number(index))
    }
}

/// The unit that an axis is shown in, empty for a pure number, and how many of the units of
/// [`SweepAxis::values`] make one of it.
fn shown_unit(case: &Case, axis: &SweepAxis) -> (&'static str, f64) {
    if axis.parameter.is_length(&case.design) {
        let lengths = LengthFormat::of(&case.scales());
        return (lengths.unit, 1.0 / lengths.number(1.0));
    }
    let largest = axis.values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    match axis.parameter {
        ratio if ratio.is_ratio() => ("%", 0.01),
        SweepParameter::AbsorberMass if largest < 1.0 => ("g", 1e-3),
        SweepParameter::Stiffness if largest >= 1e3 => ("kN/m", 1e3),
        other => match other.unit(&case.design) {
            "1" => ("", 1.0),
            unit => (unit, 1.0),
        },
    }
}

fn key<S: Serializer>(parameter: &SweepParameter, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(parameter.key())
}
