//! Two quantities as axes: from dimensionless numbers to numbers in the units of the axes.

use crate::quantity::Kind;
use crate::report::figure::{Axis, Layer, Panel, Rule, Scale, Style};

use super::Scene;

/// The axes of a panel.
pub(super) struct Chart {
    axes: [Measure; 2],
}

/// One axis.
struct Measure {
    kind: &'static Kind,
    label: String,
    /// Displayed units in one of the dimensionless number.
    factor: f64,
    range: [f64; 2],
    scale: Scale,
}

impl Chart {
    /// Axes of two kinds over two ranges; units and prefixes suit the ends of the ranges.
    pub(super) fn new(scene: &Scene, kinds: [&'static Kind; 2], [x, y]: [[f64; 2]; 2]) -> Self {
        let measure = |kind: &'static Kind, range: [f64; 2]| {
            let largest = scene.si(kind, range[1].abs().max(range[0].abs()));
            let unit = scene.units.axis_unit(kind, largest);
            let label = scene.units.axis_label(kind, largest);
            let factor = scene.si(kind, 1.0) / unit.size;
            Measure { kind, label, factor, range, scale: Scale::Linear }
        };
        Self { axes: [measure(kinds[0], x), measure(kinds[1], y)] }
    }

    /// The same with logarithmic axes where that is asked for.
    pub(super) fn with_log(mut self, log: [bool; 2]) -> Self {
        for (axis, log) in self.axes.iter_mut().zip(log) {
            axis.scale = if log { Scale::Log } else { Scale::Linear };
        }
        self
    }

    pub(super) fn kinds(&self) -> [&'static Kind; 2] {
        [self.axes[0].kind, self.axes[1].kind]
    }

    /// The range of an axis: 0 across, 1 up.
    pub(super) fn range(&self, index: usize) -> [f64; 2] {
        self.axes[index].range
    }

    pub(super) fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [x * self.axes[0].factor, y * self.axes[1].factor]
    }

    pub(super) fn line<'a>(&self, points: impl IntoIterator<Item = &'a [f64; 2]>) -> Vec<[f64; 2]> {
        points.into_iter().map(|point| self.at(*point)).collect()
    }

    /// A curve in the style of its role, or in one of its own.
    pub(super) fn curve(&self, style: impl Into<Style>, points: &[[f64; 2]]) -> Layer {
        Layer::styled(style.into(), self.line(points))
    }

    /// A line across the panel at an abscissa.
    pub(super) fn vertical(&self, x: f64, style: impl Into<Style>) -> Layer {
        Layer::rule(Rule::Vertical(self.at([x, 0.0])[0]), style.into())
    }

    /// A line across the panel at an ordinate.
    pub(super) fn horizontal(&self, y: f64, style: impl Into<Style>) -> Layer {
        Layer::rule(Rule::Horizontal(self.at([0.0, y])[1]), style.into())
    }

    /// An empty panel with these axes.
    pub(super) fn panel(&self) -> Panel {
        let axis = |of: &Measure| {
            let [first, last] = of.range.map(|value| value * of.factor);
            let axis = Axis { scale: of.scale, ..Axis::linear(of.label.clone()) };
            if first.is_finite() && last.is_finite() { axis.with_range(first, last) } else { axis }
        };
        Panel::new(axis(&self.axes[0]), axis(&self.axes[1]))
    }
}
