//! The work-precision diagram: error over operations, both on logarithmic axes.

use super::words;
use super::{asked, error_text, operations};
use crate::report::figure::{
    Axis, Color, Dash, Figure, Layer as Drawn, MarkedPoint, Marker, Panel, Role, Rule, Shape, Style,
};
use crate::simulation::ContactTolerance;
use crate::study::tradeoff::by_hand::Locate;
use crate::study::tradeoff::{Method, Search, Tradeoff, Trial};

/// A group of trials that is drawn alike.
struct Series {
    name: &'static str,
    holds: fn(Method) -> bool,
    marker: Marker,
    color: Color,
    dash: Option<Dash>,
}

fn is_usual(excursion: f64) -> bool {
    excursion == ContactTolerance::default().excursion
}

const SERIES: [Series; 7] = [
    Series {
        name: "fixed step, interpolation",
        holds: |method| matches!(method, Method::FixedStep { locate: Locate::Interpolation, .. }),
        marker: Marker::hollow(Shape::Square),
        color: Color::Orange,
        dash: Some(Dash::Dotted),
    },
    Series {
        name: "fixed step, bisection",
        holds: |method| matches!(method, Method::FixedStep { locate: Locate::Bisection, .. }),
        marker: Marker::filled(Shape::Cross),
        color: Color::Vermillion,
        dash: Some(Dash::Dashed),
    },
    Series {
        name: "simulation",
        holds: |method| matches!(method, Method::Simulation { search: Search::Panels, excursion, .. } if is_usual(excursion)),
        marker: Marker::filled(Shape::Circle),
        color: Color::ReddishPurple,
        dash: Some(Dash::Solid),
    },
    Series {
        name: "simulation, other tolerance or search",
        holds: |method| {
            matches!(method, Method::Simulation { search, excursion, .. }
                if search == Search::StepByStep || !is_usual(excursion))
        },
        marker: Marker::hollow(Shape::Diamond),
        color: Color::ReddishPurple,
        dash: None,
    },
    Series {
        name: "slow flow",
        holds: |method| matches!(method, Method::SlowFlow { .. }),
        marker: Marker::hollow(Shape::Triangle),
        color: Color::BluishGreen,
        dash: None,
    },
    Series {
        name: "closed form",
        holds: |method| matches!(method, Method::FixedPoints),
        marker: Marker::filled(Shape::Square),
        color: Color::Blue,
        dash: None,
    },
    Series {
        name: "exact orbit",
        holds: |method| {
            matches!(method, Method::SymmetricOrbit | Method::OrbitFromSimulation { .. })
        },
        marker: Marker::hollow(Shape::Circle).sized(10.0),
        color: Color::Black,
        dash: None,
    },
];

/// Room beside the outermost points, as a factor.
const ROOM: f64 = 2.0;

/// The diagram.
pub fn figure(tradeoff: &Tradeoff, allowed: f64) -> Figure {
    let points: Vec<[f64; 2]> = tradeoff.trials.iter().filter_map(place).collect();
    let span = |k: usize, also: &[f64]| {
        let values = points.iter().map(|point| point[k]).chain(also.iter().copied());
        let (low, high) = values
            .fold((f64::INFINITY, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
        (low / ROOM, high * ROOM)
    };
    let (left, right) = span(0, &[]);
    let (low, high) = span(1, &[tradeoff.best.rms_error, allowed]);
    let x = Axis::log("cost (operations)").with_range(left, right);
    let y = Axis::log("relative error of the rms displacement (1)").with_range(low, high);
    let mut panel = Panel::new(x, y)
        .with(
            Drawn::rule(
                Rule::Horizontal(tradeoff.best.rms_error),
                Style::new(Color::Grey, 1.2, Dash::DashDot),
            )
            .labelled("error of the best answer"),
        )
        .with(
            Drawn::rule(Rule::Horizontal(allowed), Role::Guide.style())
                .labelled(format!("{} asked for", asked(allowed))),
        );
    for series in SERIES {
        panel.layers.extend(layers(tradeoff, &series));
    }
    let (caption, alt) = captions(tradeoff, allowed);
    Figure::new("tradeoff", "Error over cost of every layer")
        .with_panel(panel)
        .with_words(caption, alt)
}

fn place(trial: &Trial) -> Option<[f64; 2]> {
    Some([trial.operations.max(1) as f64, trial.rms_error?.value])
}

fn layers(tradeoff: &Tradeoff, series: &Series) -> Vec<Drawn> {
    let trials = tradeoff.trials.iter().filter(|trial| (series.holds)(trial.method));
    let placed: Vec<([f64; 2], &Trial)> =
        trials.filter_map(|trial| Some((place(trial)?, trial))).collect();
    if placed.is_empty() {
        return Vec::new();
    }
    let mut layers = Vec::new();
    if let Some(dash) = series.dash {
        let line = placed.iter().map(|(at, _)| *at).collect();
        layers.push(Drawn::styled(Style::new(series.color, 1.2, dash), line));
    }
    let marks = placed.iter().map(|([x, y], trial)| {
        let error = trial.rms_error.map_or_else(String::new, error_text);
        MarkedPoint::new(*x, *y).with_tooltip(format!(
            "{}: error {error}, {} operations",
            words::method(trial.method),
            operations(trial.operations)
        ))
    });
    layers.push(Drawn::marked(series.marker, series.color, marks).labelled(series.name));
    layers
}

fn captions(tradeoff: &Tradeoff, allowed: f64) -> (String, String) {
    let known = if tradeoff.best.periods.is_some() {
        "The motion does not repeat: errors of simulations are at least two of their standard errors, and none can be seen below that of the best answer. Length helps; smaller steps do not."
    } else {
        "Errors on the lowest line are only known to be below it. A simulation gets better with length, by chance early, for good when its transient is over; a fixed step with smaller steps."
    };
    let caption = format!("{} {known}", words::headline(tradeoff, allowed));
    let alt = format!(
        "Relative error of the rms displacement over the number of operations, one kind of mark for each layer. {caption}"
    );
    (caption, alt)
}
