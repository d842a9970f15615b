//! The work-precision diagram: error over operations, both on logarithmic axes.

use serde_json::json;

use super::by_hand::Locate;
use super::page::TradeoffDocument;
use super::{Method, Search, Tradeoff};
use crate::quantity::numbers::{asked, operations, relative_error};
use crate::report::figure::{
    Axis, Color, Dash, Figure, Layer as Drawn, MarkedPoint, Marker, Panel, Role, Rule, Shape, Style,
};

/// A group of trials that is drawn alike.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Series {
    Interpolation,
    Bisection,
    Simulation,
    OtherSimulation,
    SlowFlow,
    ClosedForm,
    ExactOrbit,
}

/// From the back to the front.
const SERIES: [Series; 7] = [
    Series::Interpolation,
    Series::Bisection,
    Series::Simulation,
    Series::OtherSimulation,
    Series::SlowFlow,
    Series::ClosedForm,
    Series::ExactOrbit,
];

impl Series {
    const fn of(method: Method) -> Self {
        match method {
            Method::FixedStep { locate: Locate::Interpolation, .. } => Self::Interpolation,
            Method::FixedStep { locate: Locate::Bisection, .. } => Self::Bisection,
            Method::Simulation { search: Search::Panels, excursion: None, .. } => Self::Simulation,
            Method::Simulation { .. } => Self::OtherSimulation,
            Method::SlowFlow { .. } => Self::SlowFlow,
            Method::FixedPoints => Self::ClosedForm,
            Method::SymmetricOrbit | Method::OrbitFromSimulation { .. } => Self::ExactOrbit,
        }
    }

    /// Name, mark, color, and the line that joins what gets better step by step.
    fn looks(self) -> (&'static str, Marker, Color, Option<Dash>) {
        use Color::{Black, Blue, BluishGreen, Orange, ReddishPurple, Vermillion};
        let (hollow, filled) = (Marker::hollow, Marker::filled);
        match self {
            Self::Interpolation => {
                ("fixed step, interpolation", hollow(Shape::Square), Orange, Some(Dash::Dotted))
            }
            Self::Bisection => {
                ("fixed step, bisection", filled(Shape::Cross), Vermillion, Some(Dash::Dashed))
            }
            Self::Simulation => {
                ("simulation", filled(Shape::Circle), ReddishPurple, Some(Dash::Solid))
            }
            Self::OtherSimulation => (
                "simulation, other tolerance or search",
                hollow(Shape::Diamond),
                ReddishPurple,
                None,
            ),
            Self::SlowFlow => ("slow flow", hollow(Shape::Triangle), BluishGreen, None),
            Self::ClosedForm => ("closed form", filled(Shape::Square), Blue, None),
            Self::ExactOrbit => ("exact orbit", hollow(Shape::Circle).sized(10.0), Black, None),
        }
    }
}

/// Room beside the outermost points, as a factor.
const ROOM: f64 = 2.0;

/// The diagram.
pub fn figure(tradeoff: &Tradeoff, document: &TradeoffDocument) -> Figure {
    let placed: Vec<(Method, MarkedPoint)> = tradeoff
        .trials
        .iter()
        .filter_map(|trial| {
            let error = trial.rms_error?;
            let point = MarkedPoint::new(trial.operations.max(1) as f64, error.value);
            let tooltip = format!(
                "error {}, {} operations",
                relative_error(error.value, error.below),
                operations(trial.operations)
            );
            Some((trial.method, point.with_tooltip(tooltip)))
        })
        .collect();
    let around = |values: &[f64]| {
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        (low / ROOM, values.iter().copied().fold(0.0, f64::max) * ROOM)
    };
    let (best, allowed) = (tradeoff.best.rms_error, document.allowed);
    let (left, right) = around(&placed.iter().map(|(_, point)| point.x).collect::<Vec<_>>());
    let errors = placed.iter().map(|(_, point)| point.y).chain([best, allowed]);
    let (low, high) = around(&errors.collect::<Vec<_>>());
    let x = Axis::log("cost (operations)").with_range(left, right);
    let y = Axis::log("relative error of the rms displacement (1)").with_range(low, high);
    let known = Style::new(Color::Grey, 1.2, Dash::DashDot);
    let mut panel = Panel::new(x, y)
        .with(Drawn::rule(Rule::Horizontal(best), known).labelled("error of the best answer"))
        .with(
            Drawn::rule(Rule::Horizontal(allowed), Role::Guide.style())
                .labelled(format!("{} asked for", asked(allowed))),
        );
    for series in SERIES {
        let (name, marker, color, dash) = series.looks();
        let of_series = placed.iter().filter(|(method, _)| Series::of(*method) == series);
        let points: Vec<MarkedPoint> = of_series.map(|(_, point)| point.clone()).collect();
        if let Some(dash) = dash.filter(|_| !points.is_empty()) {
            let line = points.iter().map(|point| [point.x, point.y]).collect();
            panel.layers.push(Drawn::styled(Style::new(color, 1.2, dash), line));
        }
        if !points.is_empty() {
            panel.layers.push(Drawn::marked(marker, color, points).labelled(name));
        }
    }
    Figure::new("tradeoff", "")
        .with_panel(panel)
        .with_facts("captions/tradeoff", json!({ "page": document }))
}
