//! The objective over the clearance, and the best clearance of one excitation over its frequency and
//! amplitude.

use super::kind;
use crate::case::{Case, Objective};
use crate::optimize::Optimization;
use crate::optimize::chart::Suited;
use crate::quantity::{Kind, Units, catalogue};
use crate::report::chart::{AxisOf, FITTED};
use crate::report::figure::{
    Axis, AxisScale, Color, Dash, Figure, Fill, Label, Layer, MarkedPoint, Marker, Panel, Role,
    Shape, Style,
};

/// Amplitudes of the chart, over the case's own.
const AMPLITUDES: [f64; 2] = [0.25, 2.0];
/// A line at a place.
const GUIDE: Style = Style::new(Color::Grey, 1.4, Dash::Dotted);

/// Both figures.
pub fn figures(case: &Case, found: &Optimization) -> Vec<Figure> {
    let context = super::context(case, found);
    let drawing = OptimumDrawing { found, units: case.units() };
    let mut figures =
        vec![drawing.landscape().with_facts("captions/optimize-landscape", context.clone())];
    let chart = drawing.chart();
    figures.extend(chart.map(|one| one.with_facts("captions/optimize-chart", context)));
    figures
}

/// The frequency of the chart that is nearest to the case's own and has a best clearance.
pub(super) fn nearest(found: &Optimization) -> Option<&Suited> {
    let own = found.task.case.design.system().ok()?.frequency_ratio();
    let away = |one: &Suited| (one.frequency_ratio - own).abs();
    let suited = found.chart.iter().filter(|one| one.best.is_some());
    suited.min_by(|a, b| away(a).total_cmp(&away(b)))
}

struct OptimumDrawing<'a> {
    found: &'a Optimization,
    units: Units,
}

impl OptimumDrawing<'_> {
    /// An axis of numbers in SI.
    fn axis(&self, kind: &Kind, range: [f64; 2], scale: AxisScale) -> Axis {
        AxisOf::si(self.units, kind).axis(range).with_scale(scale)
    }

    fn landscape(&self) -> Figure {
        let found = self.found;
        let amplitude = found.task.objective == Objective::WorstAmplitude;
        let kind = kind(found.task.objective);
        let values = found.landscape.iter().map(|place| place.1).filter(|value| value.is_finite());
        let largest = values.fold(0.0, f64::max);
        let [low, high] = [found.task.bounds[0].from, found.task.bounds[0].to];
        let x = self.axis(&catalogue::CLEARANCE, [low, high], AxisScale::Log);
        let mut panel = Panel::new(x, AxisOf::si(self.units, kind).axis_up_to(largest, FITTED));
        let finite = found.landscape.iter().filter(|(_, value)| value.is_finite());
        let cheap = finite.map(|(at, value)| [*at, *value]);
        // A coarse survey scatters: nothing is known between its places.
        panel.layers.push(if amplitude {
            let small = Marker::filled(Shape::Circle).sized(2.0);
            Layer::marked(small, Color::Grey, cheap).labelled("coarse survey")
        } else {
            Layer::curve(Role::Stable, cheap.collect()).labelled("as written")
        });
        let own = found.own.choice.clearance();
        let end = found.claim.map(|claim| claim.end_clearance * own);
        let end = (end, "1:1 disappears", Style::new(Color::Vermillion, 1.4, Dash::DashDot));
        for (at, name, style) in [(Some(own), "the case", GUIDE), end] {
            let at = at.filter(|at| low < *at && *at < high);
            panel.layers.extend(at.map(|at| Layer::vertical(at, style).labelled(name)));
        }
        panel.layers.extend(self.judged());
        Figure::new("optimize-landscape", "").with_panel(panel)
    }

    /// What was judged as `check` judges its case, the optimum and the robust one as marks.
    fn judged(&self) -> Vec<Layer> {
        let (found, kind) = (self.found, kind(self.found.task.objective));
        let amplitude = found.task.objective == Objective::WorstAmplitude;
        let mark = |[at, value, error]: [f64; 3], name: &str| {
            let told = self.units.with_error(kind, value, error, kind.digits);
            let clearance = self.units.text(&catalogue::CLEARANCE, at);
            MarkedPoint::new(at, value).with_tooltip(format!("{name}{clearance}: {told}"))
        };
        let mut layers = Vec::new();
        for (feasible, name, shape, color) in [
            (false, "checked, criteria fail", Shape::Square, Color::Vermillion),
            (true, "checked", Shape::Circle, Color::Blue),
        ] {
            let some = found.judged.iter().filter(|one| one.is_feasible() == feasible);
            let some = some.filter(|one| one.value.is_finite() && (amplitude || !feasible));
            let points: Vec<MarkedPoint> =
                some.map(|one| mark([one.choice.clearance(), one.value, one.error], "")).collect();
            if !points.is_empty() {
                layers.push(Layer::marked(Marker::hollow(shape), color, points).labelled(name));
            }
        }
        let best = Some((found.best.choice.clearance(), found.best.value));
        let robust = found.robust.as_ref();
        let robust = robust.map(|one| (one.design.choice.clearance(), one.under[0].expected));
        for (one, name, marker) in [
            (best, "optimum", Marker::filled(Shape::Circle)),
            (robust, "robust, expected", Marker::hollow(Shape::Diamond)),
        ] {
            if let Some((at, value)) = one.filter(|one| one.1.is_finite() && found.reached()) {
                let points = [mark([at, value, 0.0], &format!("{name}, "))];
                layers.push(Layer::marked(marker, Color::Black, points).labelled(name));
            }
        }
        layers
    }

    /// `None` where no clearance suits any of the frequencies.
    fn chart(&self) -> Option<Figure> {
        let found = self.found;
        let clearances = |scale| self.axis(&catalogue::CLEARANCE, FITTED, scale);
        let suited = |of: &dyn Fn(&Suited) -> Option<f64>| -> Vec<[f64; 2]> {
            found.chart.iter().filter_map(|one| Some([one.frequency_ratio, of(one)?])).collect()
        };
        let best = suited(&|one| one.best);
        let largest = best.iter().map(|point| point[1]).max_by(f64::total_cmp)?;
        let smallest = best.iter().map(|point| point[1]).min_by(f64::total_cmp)?;
        let ends = [0, 1].map(|k| {
            let mut line = suited(&|one| Some(one.stable?[k]));
            line.iter_mut().for_each(|at| at[1] = at[1].clamp(0.3 * smallest, 2.0 * largest));
            line
        });
        let range = [found.chart.first()?, found.chart.last()?].map(|one| one.frequency_ratio);
        let x = AxisOf::dimensionless(self.units, &catalogue::EXCITATION_FREQUENCY).axis(range);
        let tint = Fill::tint(Color::SkyBlue);
        let mut over_frequency = Panel::new(x, clearances(AxisScale::Log))
            .with(Layer::between(&ends[0], &ends[1], tint).labelled("stable 1:1"))
            .with(Layer::curve(Role::Stable, best).labelled("best"));
        if found.reached() {
            let chosen = Layer::horizontal(found.best.choice.clearance(), GUIDE);
            over_frequency.layers.push(chosen.labelled("chosen"));
        }
        let here = nearest(found)?;
        let line = |at: f64| AMPLITUDES.map(|factor| [factor, at * factor]).to_vec();
        let x = self.axis(&catalogue::AMPLITUDE_OVER_OWN, AMPLITUDES, AxisScale::Linear);
        let mut over_amplitude = Panel::new(x, clearances(AxisScale::Linear));
        if let Some([low, high]) = here.stable {
            let area = Layer::between(&line(low), &line(high), tint);
            over_amplitude = over_amplitude.with(area.labelled(Label::from("stable 1:1")));
        }
        let own = [1.0, found.own.choice.clearance()];
        let over_amplitude = over_amplitude
            .with(Layer::curve(Role::Stable, line(here.best?)).labelled("best"))
            .with(Layer::this_case(own, None));
        Some(
            Figure::new("optimize-chart", "").with_panel(over_frequency).with_panel(over_amplitude),
        )
    }
}
