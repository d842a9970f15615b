//! The case among its boundaries (Figs. 5 and 6).

use serde_json::json;

use crate::orbits::Bifurcation;
use crate::quantity::catalogue as of;
use crate::report::chart::{Chart, FITTED};
use crate::report::figure::{
    Color, Dash, Figure, Layer, Layout, MarkedPoint, Marker, Panel, Role, Shape, Style,
};
use crate::study::plots::borders::{Bifurcations, Border, Condition};
use crate::study::plots::{Borders, BoundaryMap};
use crate::validation::AsymptoticError;

use super::DrawnCase;

/// The boundaries that are compared with exact ones.
const COMPARED: [(Bifurcation, Role); 3] = [
    (Bifurcation::SymmetryBreaking, Role::SymmetryBreaking),
    (Bifurcation::NeimarkSacker, Role::Hopf),
    (Bifurcation::SaddleNode, Role::SaddleNode),
];

/// In frequency and clearance, with the theory's errors below.
pub(super) fn map(scene: &DrawnCase, data: &BoundaryMap) -> Figure {
    let (heights, log) = heights(scene, &data.borders);
    let kinds = [&of::EXCITATION_FREQUENCY, &of::CLEARANCE];
    let chart = scene.chart(kinds, [data.window, heights]).with_log([false, log]);
    let mut panel = chart.panel();
    let grazing = data.exact.iter().filter_map(|at| Some([at.frequency_ratio, at.grazing()?]));
    let place = |detuning: f64, gamma: f64| [scene.ratio(detuning), scene.clearance(gamma)];
    panel.layers = data.borders.layers(&place, [heights[1], heights[0]]);
    let mark = |at: [f64; 2], what: &str| scene.mark(&chart, at, what);
    let third = grazing.map(MarkedPoint::from);
    let limits = data.exact.iter().flat_map(|at| {
        let bounds = at.symmetric.limits.iter().filter(|limit| limit.bounds_stability);
        bounds.map(|limit| (at.frequency_ratio, limit))
    });
    let limits: Vec<_> = limits.collect();
    let small = |shape, color: Color, marks: Vec<MarkedPoint>| {
        Layer::marked(Marker::hollow(shape).sized(5.0), color, marks)
    };
    let third = small(Shape::Square, Role::ExactOrbit.color(), third.collect());
    let mut panel = panel.with(third.labelled("Z2 ends (exact)"));
    // Each in the colour of the theory's line that it is the exact one of.
    let color = |kind: Bifurcation| {
        let line = COMPARED.iter().find(|(of, _)| *of == kind);
        line.map_or(Role::ExactOrbit.color(), |(_, role)| role.style().color)
    };
    let mut kinds: Vec<Bifurcation> = Vec::new();
    for (_, limit) in &limits {
        if !kinds.contains(&limit.kind) {
            kinds.push(limit.kind);
        }
    }
    for (k, kind) in kinds.into_iter().enumerate() {
        let of = limits.iter().filter(|(_, limit)| limit.kind == kind);
        let marks = of.map(|(at, limit)| mark([*at, limit.clearance], kind.words()));
        let layer = small(Shape::Circle, color(kind), marks.collect());
        panel = panel.with(if k == 0 { layer.labelled("exact limits") } else { layer });
    }
    let panel = panel.with(scene.star(&chart, [scene.system().frequency_ratio(), 1.0]));
    let below = errors(scene, data);
    let figure = scene.figure("map", "captions/map", json!({ "compared": below.is_some() }));
    match below {
        None => figure.with_panel(panel),
        Some(below) => figure
            .with_size(720, 600)
            .with_layout(Layout::rows(&[3.0, 1.0]))
            .with_panel(panel)
            .with_panel(below),
    }
}

/// Smallest and largest clearance that show the boundaries and the case; logarithmic where a linear axis
/// would hide one of them. A peak higher than five times the middle height of its line is cut.
fn heights(scene: &DrawnCase, borders: &Borders) -> ([f64; 2], bool) {
    let sorted = |value: fn(&Border) -> f64| {
        let all = borders.samples.iter().map(|at| scene.clearance(value(at)));
        let mut finite: Vec<f64> = all.filter(|b| b.is_finite() && *b > 0.0).collect();
        finite.sort_by(f64::total_cmp);
        finite
    };
    let [hopf, saddle, breaking]: [Vec<f64>; 3] =
        [sorted(|at| at.hopf), sorted(|at| at.saddle), sorted(|at| at.breaking)];
    let middle = hopf.get(hopf.len() / 2).copied().unwrap_or(1.0);
    let highest = hopf.last().into_iter().chain(saddle.last()).copied().fold(0.0, f64::max);
    let highest = if highest > 0.0 { highest.min(5.0 * middle) } else { 1.0 };
    let lowest = breaking.first().copied().unwrap_or(1.0);
    if highest < 0.2 || 1.0 < 0.02 * highest {
        ([0.6 * lowest.max(1e-3 * highest).min(1.0), 1.6 * highest.max(1.0)], true)
    } else {
        ([0.0, 1.1 * highest.max(1.15)], false)
    }
}

/// How far each boundary of the theory lies from the exact one; none where there is nothing to compare.
fn errors(scene: &DrawnCase, data: &BoundaryMap) -> Option<Panel> {
    let known = |errors: &[AsymptoticError], kind| {
        let mut bounds = errors.iter().filter(|error| error.bounds_stability);
        bounds.find_map(|error| error.difference.filter(|_| error.kind == kind))
    };
    let line = |kind| -> Vec<[f64; 2]> {
        let of =
            |(ratio, errors): &(f64, Vec<_>)| [*ratio, known(errors, kind).unwrap_or(f64::NAN)];
        data.errors.iter().map(of).collect()
    };
    let lines = COMPARED.map(|(kind, role)| (kind, role, line(kind)));
    let values =
        || lines.iter().flat_map(|(_, _, line)| line).map(|at| at[1]).filter(|at| at.is_finite());
    values().next()?;
    let kinds = [&of::EXCITATION_FREQUENCY, &of::THEORY_ERROR];
    let chart = scene.chart(kinds, [data.window, FITTED]);
    let mut panel = chart
        .panel()
        .with(Layer::vertical(scene.system().frequency_ratio(), Role::Guide))
        .with(Layer::horizontal(0.0, Role::Guide));
    for (kind, role, line) in lines {
        let name = kind.words_in_slow_flow();
        let shown = line.iter().copied().filter(|at| at[1].is_finite());
        let marks = Layer::marked(role.marker().sized(4.0), role.color(), shown);
        panel = panel.with(Layer::curve(role, line).labelled(name)).with(marks);
    }
    Some(panel)
}

/// Frequency ratios that are one: some roundings.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// In the reduced parameters `(sigma, gamma)`.
pub(super) fn plane(scene: &DrawnCase, borders: &Borders) -> Figure {
    let system = scene.system();
    let case = [system.detuning(), system.forcing_per_clearance()];
    let meeting = borders.meeting.map_or(1.0, |at| at[1]);
    // Beyond this ratio between case and P1 a linear axis would hide one of them.
    let log = case[1] > 0.0 && !(1.0 / 15.0..=15.0).contains(&(case[1] / meeting));
    let top = (1.2 * case[1]).max(3.0 * meeting);
    let y = if log { [0.4 * meeting.min(case[1]), 1.5 * top] } else { [0.0, top] };
    let kinds = [&of::DETUNING, &of::FORCING_PER_CLEARANCE];
    let chart = scene.chart(kinds, [borders.window(), y]).with_log([false, log]);
    let mut panel = chart.panel();
    panel.layers = borders.layers(&|detuning, gamma| [detuning, gamma], y);
    // A frequency ratio of 1 but for rounding.
    let resonates = (case[0] * system.mass_ratio()).abs() < ROUNDING;
    let facts = json!({
        "here": [if resonates { 0.0 } else { case[0] }, case[1]],
        "boundaries": scene.study.analysis.boundaries,
        "meeting": borders.meeting,
    });
    scene.figure("plane", "captions/plane", facts).with_panel(panel.with(scene.star(&chart, case)))
}

/// Colour and dashes of the three frequencies; P1's is in the middle.
const STYLES: [Style; 3] = [
    Style::new(Color::Orange, 2.0, Dash::LongDashed),
    Style::new(Color::Black, 2.0, Dash::Solid),
    Style::new(Color::SkyBlue, 2.0, Dash::DashDot),
];

/// What the saddle-node and the Hopf boundary are, and where they lie.
pub(super) fn bifurcations(scene: &DrawnCase, data: &Bifurcations) -> Figure {
    let meeting = scene.study.analysis.boundaries.codimension_two;
    let collisions = data.conditions.iter().filter_map(|at| Some(at.collision?.0));
    let found = data.conditions.iter().map(|at| at.hopf).chain(collisions);
    let highest =
        found.chain([scene.clearance(meeting.forcing_over_clearance)]).fold(0.0, f64::max);
    let y = [0.0, 1.25 * highest];
    let facts = json!({
        "sides": [&data.conditions[0], &data.conditions[2]],
        "meeting": scene.ratio(meeting.detuning),
        "gamma": meeting.forcing_over_clearance,
    });
    scene
        .figure("bifurcations", "captions/bifurcations", facts)
        .with_size(860, 450)
        .with_panel(condition_panel(scene, data, y))
        .with_panel(border_panel(scene, data, y))
}

/// Marks of the Hopf condition and of collisions, at the abscissae of the first and of the second.
fn condition_marks(
    scene: &DrawnCase,
    data: &Bifurcations,
    chart: &Chart,
    x: impl Fn(&Condition) -> [f64; 2],
) -> [Layer; 2] {
    let all = data.conditions.iter();
    let hopf = all.clone().map(|at| scene.mark(chart, [x(at)[0], at.hopf], "Hopf"));
    let collisions =
        all.filter_map(|at| Some(scene.mark(chart, [x(at)[1], at.collision?.0], "saddle-node")));
    let layer = |role: Role, marks: Vec<MarkedPoint>| {
        Layer::marked(role.marker().sized(9.0), role.color(), marks)
    };
    [layer(Role::Hopf, hopf.collect()), layer(Role::SaddleNode, collisions.collect())]
}

/// Which clearance gives a fixed point which amplitude: its top is the collision.
fn condition_panel(scene: &DrawnCase, data: &Bifurcations, y: [f64; 2]) -> Panel {
    let kinds = [&of::ABSORBER_AMPLITUDE_RATIO, &of::CLEARANCE];
    let chart = scene.chart(kinds, [Bifurcations::AMPLITUDES, y]);
    let fold = scene.study.analysis.manifold.fold.absorber_amplitude;
    let mut panel = chart.panel().with_heading("clearance of a fixed point");
    panel = panel.with(Layer::vertical(fold, Role::Guide).labelled("fold"));
    for (at, style) in data.conditions.iter().zip(STYLES) {
        let name = scene.text(&of::EXCITATION_FREQUENCY, at.ratio);
        panel = panel.with(Layer::curve(style, at.line.clone()).labelled(name));
    }
    let [hopf, collisions] = condition_marks(scene, data, &chart, |at| {
        [fold, at.collision.map_or(f64::NAN, |(_, amplitude, _)| amplitude)]
    });
    panel
        .with(hopf.labelled("Hopf: at the fold"))
        .with(collisions.labelled("saddle-node: at the top"))
}

/// The two boundaries around P1, with the same frequencies.
fn border_panel(scene: &DrawnCase, data: &Bifurcations, y: [f64; 2]) -> Panel {
    let kinds = [&of::EXCITATION_FREQUENCY, &of::CLEARANCE];
    let window = data.borders.window().map(|detuning| scene.ratio(detuning));
    let chart = scene.chart(kinds, [window, y]);
    let place = |detuning: f64, gamma: f64| [scene.ratio(detuning), scene.clearance(gamma)];
    let mut panel = chart.panel().with_heading("the boundaries");
    panel.layers = data.borders.layers(&place, [y[1], 0.0]);
    for (at, style) in data.conditions.iter().zip(STYLES) {
        panel.layers.push(Layer::vertical(at.ratio, Style { width: 1.1, ..style }));
    }
    panel.layers.extend(condition_marks(scene, data, &chart, |at| [at.ratio; 2]));
    panel
}
