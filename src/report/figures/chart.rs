//! Two quantities as axes: from dimensionless numbers to numbers in the units of the axes.

use crate::quantity::Kind;
use crate::report::figure::{Axis, Layer, Panel, Rule, Scale, Style};

use super::Scene;

/// A range that follows from what is drawn.
pub(super) const FITTED: [f64; 2] = [0.0, f64::NAN];

/// The axes of a panel.
pub(super) struct Chart {
    kinds: [&'static Kind; 2],
    ranges: [[f64; 2]; 2],
    /// Displayed units in one of each dimensionless number.
    factors: [f64; 2],
    axes: [Axis; 2],
}

impl Chart {
    /// Axes of two kinds over two ranges; units and prefixes suit the ends of the ranges.
    pub(super) fn new(scene: &Scene, kinds: [&'static Kind; 2], ranges: [[f64; 2]; 2]) -> Self {
        let largest =
            [0, 1].map(|k| scene.si(kinds[k], ranges[k][1].abs().max(ranges[k][0].abs())));
        let unit = |k: usize| scene.units.axis_unit(kinds[k], largest[k]).size;
        let factors = [0, 1].map(|k| scene.si(kinds[k], 1.0) / unit(k));
        let axes = [0, 1].map(|k| {
            let axis = Axis::linear(scene.units.axis_label(kinds[k], largest[k]));
            let [first, last] = ranges[k].map(|value| value * factors[k]);
            if first.is_finite() && last.is_finite() { axis.with_range(first, last) } else { axis }
        });
        Self { kinds, ranges, factors, axes }
    }

    /// The same with logarithmic axes where that is asked for.
    pub(super) fn with_log(mut self, log: [bool; 2]) -> Self {
        for (axis, log) in self.axes.iter_mut().zip(log) {
            axis.scale = if log { Scale::Log } else { Scale::Linear };
        }
        self
    }

    pub(super) const fn kinds(&self) -> [&'static Kind; 2] {
        self.kinds
    }

    /// The range of an axis: 0 across, 1 up.
    pub(super) const fn range(&self, index: usize) -> [f64; 2] {
        self.ranges[index]
    }

    pub(super) fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [x * self.factors[0], y * self.factors[1]]
    }

    pub(super) fn line<'a>(&self, points: impl IntoIterator<Item = &'a [f64; 2]>) -> Vec<[f64; 2]> {
        points.into_iter().map(|point| self.at(*point)).collect()
    }

    /// A curve in the style of its role, or in one of its own.
    pub(super) fn curve(&self, style: impl Into<Style>, points: &[[f64; 2]]) -> Layer {
        Layer::curve(style, self.line(points))
    }

    /// A line across the panel at an abscissa.
    pub(super) fn vertical(&self, x: f64, style: impl Into<Style>) -> Layer {
        Layer::rule(Rule::Vertical(self.at([x, 0.0])[0]), style)
    }

    /// A line across the panel at an ordinate.
    pub(super) fn horizontal(&self, y: f64, style: impl Into<Style>) -> Layer {
        Layer::rule(Rule::Horizontal(self.at([0.0, y])[1]), style)
    }

    /// An empty panel with these axes.
    pub(super) fn panel(&self) -> Panel {
        let [x, y] = self.axes.clone();
        Panel::new(x, y)
    }
}
