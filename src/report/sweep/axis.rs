//! An axis of a sweep as a page shows it.

use serde::Serialize;

use crate::case::{Case, ModalCase, SweepAxis};
use crate::method::Method;
use crate::quantity::{Digits, Kind, Quantity, Units};
use crate::report::chart::AxisOf;
use crate::report::figure::{Axis, AxisScale, edges};
use crate::report::modal;
use crate::system::Parameter;

/// An axis as it is shown.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisShown {
    /// What is varied.
    pub parameter: Parameter,
    /// The quantity that it is.
    pub kind: &'static Kind,
    /// Its values in SI, or in a reduced case's units, ascending.
    pub values: Vec<f64>,
    /// Whether each is so many times the one before.
    pub logarithmic: bool,
    /// The case's own value in SI, where the case has one.
    pub own: Option<f64>,
    units: Units,
}

/// A value of an axis, with so many digits that its neighbours differ.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(super) struct At {
    pub of: Quantity,
    pub digits: u8,
}

impl AxisShown {
    /// An axis of a case's table `[sweep]`.
    pub fn of(case: &Case, axis: &SweepAxis) -> Self {
        let SweepAxis { parameter, ref values, logarithmic } = *axis;
        let (kind, own) = (case.design.kind(parameter), case.design.value(parameter));
        Self { parameter, kind, values: values.clone(), logarithmic, own, units: case.units() }
    }

    /// The same of a structure of several modes.
    pub fn of_several(case: &ModalCase, axis: &SweepAxis) -> Self {
        let SweepAxis { parameter, ref values, logarithmic } = *axis;
        let (kind, own) = (case.kind(parameter), case.own_value(parameter));
        let unit = if parameter == Parameter::AbsorberMass { case.mass_unit() } else { 1.0 };
        Self {
            parameter,
            kind,
            values: values.iter().map(|value| value / unit).collect(),
            logarithmic,
            own: own.map(|own| own / unit),
            units: modal::units(case),
        }
    }

    /// The boundaries of the values' cells.
    pub(super) fn edges(&self) -> Vec<f64> {
        edges(&self.values, self.scale())
    }

    const fn scale(&self) -> AxisScale {
        if self.logarithmic { AxisScale::Log } else { AxisScale::Linear }
    }

    /// The axis of a figure, with half a step to either side: single cells have their middle there.
    pub fn drawn(&self) -> Axis {
        let edges = self.edges();
        let axis = AxisOf::si(self.units, self.kind).axis([edges[0], edges[edges.len() - 1]]);
        axis.with_scale(self.scale())
    }

    /// The case's own value, where it lies between the ends.
    pub(super) fn own_within(&self) -> Option<f64> {
        let edges = self.edges();
        self.own.filter(|own| (edges[0]..=edges[edges.len() - 1]).contains(own))
    }

    pub(super) fn at(&self, index: usize) -> At {
        let value = self.values[index];
        let near = [index.checked_sub(1), Some(index + 1)].into_iter().flatten();
        let steps = near.filter_map(|k| Some((self.values.get(k)? - value).abs()));
        let needed = libm::ceil(libm::log10(value.abs() / steps.fold(f64::INFINITY, f64::min)));
        let digits = if needed.is_finite() { needed.clamp(3.0, 6.0) as u8 } else { 3 };
        At { of: Quantity::new(self.kind, value, Method::Given), digits }
    }

    /// First and last value.
    pub(super) fn ends(&self) -> [At; 2] {
        [self.at(0), self.at(self.values.len() - 1)]
    }

    /// A value with its name, for a panel's heading.
    pub(super) fn text(&self, index: usize) -> String {
        let At { of, digits } = self.at(index);
        let number = self.units.with_digits(of.kind, of.value, Digits::Significant(digits));
        format!("{} {number}", of.kind.name)
    }
}
