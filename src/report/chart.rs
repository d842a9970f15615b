//! Axes by the kind of quantity that they show: the one place where a drawing gets units, prefixes and labels.
//!
//! What is drawn stays as its source has it, dimensionless or in SI. The axis says what the renderer multiplies
//! it by.

use super::figure::{Axis, AxisScale, Panel};
use crate::quantity::{Kind, Units};

/// A range that follows from what is drawn.
pub(super) const FITTED: [f64; 2] = [0.0, f64::NAN];

/// What an axis shows: a kind of quantity, and what its numbers are counted in.
#[derive(Debug, Clone, Copy)]
pub(super) struct AxisOf<'a> {
    kind: &'a Kind,
    units: Units,
    /// What one of them is in SI, or in the units of a reduced case.
    one: f64,
}

impl<'a> AxisOf<'a> {
    /// Dimensionless numbers: see [`Units::number`].
    pub fn dimensionless(units: Units, kind: &'a Kind) -> Self {
        Self { kind, units, one: units.number(kind.dimension, 1.0) }
    }

    /// Numbers in SI, or in the units of a reduced case.
    pub const fn si(units: Units, kind: &'a Kind) -> Self {
        Self { kind, units, one: 1.0 }
    }

    /// Numbers that count so many of these: periods, where these are times.
    pub fn counting(self, many: f64) -> Self {
        Self { one: many * self.one, ..self }
    }

    /// An axis over a range, with the prefix that suits its ends.
    pub fn axis(self, range: [f64; 2]) -> Axis {
        self.axis_up_to(range[0].abs().max(range[1].abs()), range)
    }

    /// An axis over a range, with the prefix that suits a number of this size.
    pub fn axis_up_to(self, largest: f64, [first, last]: [f64; 2]) -> Axis {
        let Self { kind, units, one } = self;
        let unit = units.unit(kind.dimension, largest * one);
        let name = [kind.name, kind.symbol].join(" ");
        let symbol = if unit.symbol.is_empty() { "1" } else { unit.symbol };
        let axis = Axis::linear(format!("{} ({symbol})", name.trim_end()));
        let axis = axis.with_factor(one / unit.size);
        if first.is_finite() && last.is_finite() { axis.with_range(first, last) } else { axis }
    }
}

/// Two axes that know what they show.
#[derive(Debug, Clone)]
pub(super) struct Chart {
    pub kinds: [&'static Kind; 2],
    pub ranges: [[f64; 2]; 2],
    pub axes: [Axis; 2],
}

impl Chart {
    /// The same with logarithmic axes where that is asked for.
    pub fn with_log(mut self, log: [bool; 2]) -> Self {
        for (axis, log) in self.axes.iter_mut().zip(log) {
            axis.scale = if log { AxisScale::Log } else { AxisScale::Linear };
        }
        self
    }

    /// An empty panel with these axes.
    pub fn panel(&self) -> Panel {
        let [x, y] = self.axes.clone();
        Panel::new(x, y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::catalogue as of;

    #[test]
    fn an_axis_has_name_symbol_and_unit_and_leads_to_it() {
        let units = Units::physical(7.5e-3);
        let axis = AxisOf::dimensionless(units, &of::CLEARANCE).axis([0.5, 3.0]);
        assert_eq!((axis.label.as_str(), axis.range), ("clearance b (mm)", Some((0.5, 3.0))));
        assert!((axis.factor - 7.5).abs() < 1e-12, "{}", axis.factor);
        let axis = AxisOf::si(units, &of::IMPACT_SPEED).axis_up_to(0.02, FITTED);
        assert_eq!((axis.label.as_str(), axis.range), ("impact speed (mm/s)", None));
        let axis = AxisOf::dimensionless(units, &of::DETUNING).counting(2.0).axis([-1.0, 1.0]);
        assert_eq!((axis.label.as_str(), axis.factor), ("detuning σ (1)", 2.0));
    }
}
