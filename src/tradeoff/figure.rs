//! The work-precision diagram: error over operations, both on logarithmic axes.

use serde_json::json;

use super::by_hand::Locate;
use super::page::Page;
use super::{ImpactSearch, MethodGroup, TradeoffMethod};
use crate::quantity::numbers::{asked, operations, relative_error};
use crate::report::figure::{
    Axis, Color, Dash, Figure, Layer as Drawn, MarkedPoint, Marker, Panel, Role, Rule, Shape, Style,
};

/// A group of trials that is drawn alike: name, mark, color, the line that joins what gets better step by
/// step, and which methods it has.
type Series = (&'static str, Marker, Color, Option<Dash>, fn(&TradeoffMethod) -> bool);

/// From the back to the front.
fn series() -> [Series; 8] {
    use Color::{Black, Blue, BluishGreen, Orange, ReddishPurple, Vermillion};
    let (hollow, filled) = (Marker::hollow, Marker::filled);
    [
        ("fixed step, interpolation", hollow(Shape::Square), Orange, Some(Dash::Dotted), |one| {
            matches!(one, TradeoffMethod::FixedStep { locate: Locate::Interpolation, .. })
        }),
        ("fixed step, bisection", filled(Shape::Cross), Vermillion, Some(Dash::Dashed), |one| {
            matches!(one, TradeoffMethod::FixedStep { locate: Locate::Bisection, .. })
        }),
        ("simulation", filled(Shape::Circle), ReddishPurple, Some(Dash::Solid), is_usual),
        (
            "simulation, other tolerance or search",
            hollow(Shape::Diamond),
            ReddishPurple,
            None,
            |one| one.layer() == MethodGroup::Simulation && !is_usual(one),
        ),
        ("slow flow", hollow(Shape::Triangle), BluishGreen, None, |one| {
            one.layer() == MethodGroup::SlowFlow
        }),
        ("averaged flow", filled(Shape::Triangle), BluishGreen, None, |one| {
            one.layer() == MethodGroup::AveragedFlow
        }),
        ("closed form", filled(Shape::Square), Blue, None, |one| {
            one.layer() == MethodGroup::ClosedForm
        }),
        ("exact orbit", hollow(Shape::Circle).sized(10.0), Black, None, |one| {
            one.layer() == MethodGroup::ExactOrbit
        }),
    ]
}

/// Whether it is the event engine as everybody uses it.
fn is_usual(one: &TradeoffMethod) -> bool {
    matches!(one, TradeoffMethod::Simulation { search: ImpactSearch::Panels, excursion: None, .. })
}

/// The diagram.
pub fn figure(page: &Page) -> Figure {
    let tradeoff = page.found;
    let placed: Vec<(TradeoffMethod, MarkedPoint)> = tradeoff
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
    let (best, allowed) = (tradeoff.best.rms_error, page.allowed);
    let x = Axis::log("cost (operations)");
    let y = Axis::log("relative error of the rms displacement (1)");
    let known = Style::new(Color::Grey, 1.2, Dash::DashDot);
    let mut panel = Panel::new(x, y)
        .with(Drawn::rule(Rule::Horizontal(best), known).labelled("error of the best answer"))
        .with(
            Drawn::rule(Rule::Horizontal(allowed), Role::Guide.style())
                .labelled(format!("{} asked for", asked(allowed))),
        );
    for (name, marker, color, dash, has) in series() {
        let of_series = placed.iter().filter(|(method, _)| has(method));
        let points: Vec<MarkedPoint> = of_series.map(|(_, point)| point.clone()).collect();
        if let Some(dash) = dash.filter(|_| !points.is_empty()) {
            let line = points.iter().map(|point| [point.x, point.y]).collect();
            panel.layers.push(Drawn::curve(Style::new(color, 1.2, dash), line));
        }
        if !points.is_empty() {
            panel.layers.push(Drawn::marked(marker, color, points).labelled(name));
        }
    }
    Figure::new("tradeoff", "")
        .with_panel(panel)
        .with_facts("captions/tradeoff", json!({ "page": page.document() }))
}
