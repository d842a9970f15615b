//! The case among its boundaries (Figs. 5 and 6).

use serde_json::json;

use crate::analysis::Branch;
use crate::orbits::Bifurcation;
use crate::quantity::catalogue as of;
use crate::report::figure::{
    Axis, Color, Dash, Figure, Layer, Layout, MarkedPoint, Marker, Panel, Role, Shape, Style,
};
use crate::study::margins::Margin;
use crate::study::plots::borders::{Bifurcations, Border, Condition};
use crate::study::plots::{Borders, Map};
use crate::validation::AsymptoticError;

use super::Scene;
use super::chart::Chart;

/// The boundaries that are compared with exact ones.
const COMPARED: [(Bifurcation, Role, &str); 3] = [
    (Bifurcation::SymmetryBreaking, Role::SymmetryBreaking, "symmetry breaking"),
    (Bifurcation::NeimarkSacker, Role::Hopf, "Hopf"),
    (Bifurcation::SaddleNode, Role::SaddleNode, "saddle-node"),
];

/// In frequency and clearance, with the theory's errors below.
pub(super) fn map(scene: &Scene, data: &Map) -> Figure {
    let (heights, log) = heights(scene, &data.borders);
    let kinds = [&of::EXCITATION_FREQUENCY, &of::CLEARANCE];
    let chart = Chart::new(scene, kinds, [data.window, heights]).with_log([false, log]);
    let place =
        |detuning: f64, gamma: f64| chart.at([scene.ratio(detuning), scene.clearance(gamma)]);
    let mut panel = chart.panel();
    let [bottom, top] = heights.map(|height| chart.at([0.0, height])[1]);
    let grazing = data.exact.iter().filter_map(|at| Some([at.frequency_ratio, at.grazing()?]));
    let grazing = chart.line(&grazing.collect::<Vec<_>>());
    panel.layers = data.borders.layers(&place, [top, bottom], &grazing);
    exact_boundaries(scene, data, &chart, &mut panel);
    let case = [scene.system().frequency_ratio(), 1.0];
    let here = scene.mark(&chart, case, "this case");
    panel = panel.with(Layer::this_case(chart.at(case), here.tooltip));
    let below = errors(scene, data, panel.x.clone());
    let figure = scene.figure("map", "captions/map", map_facts(scene, below.is_some()));
    match below {
        None => figure.with_panel(panel),
        Some(below) => figure
            .with_size(720, 600)
            .with_layout(Layout::rows(&[3.0, 1.0]))
            .with_panel(panel)
            .with_panel(below),
    }
}

fn map_facts(scene: &Scene, compared: bool) -> serde_json::Value {
    let study = scene.study;
    let neighbours = study.margins.clearance_neighbours();
    let margin = |at: Option<Margin>| {
        at.map(|at| {
            json!({"kind": at.kind, "at": scene.theory(&of::BOUNDARY, at.factor),
                   "change": scene.theory(&of::MARGIN, at.factor - 1.0)})
        })
    };
    let error = |kind: Bifurcation, name: &str| {
        let mut bounds = study.asymptotic_errors.iter().filter(|error| error.bounds_stability);
        let difference = bounds.find(|error| error.kind == kind)?.difference?;
        Some(json!({"of": name, "error": scene.theory(&of::THEORY_ERROR, difference)}))
    };
    let errors =
        COMPARED.iter().filter(|_| compared).filter_map(|(kind, _, name)| error(*kind, name));
    json!({
        "area": study.area.area,
        "strip": study.analysis.zone.strip,
        "below": margin(neighbours.below),
        "above": margin(neighbours.above),
        "errors": errors.collect::<Vec<_>>(),
    })
}

/// Smallest and largest clearance that show the boundaries and the case; logarithmic where a linear axis
/// would hide one of them. A peak higher than five times the middle height of its line is cut.
fn heights(scene: &Scene, borders: &Borders) -> ([f64; 2], bool) {
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

/// Where the stable exact orbit begins and ends, and where more than two impacts per period begin.
fn exact_boundaries(scene: &Scene, data: &Map, chart: &Chart, panel: &mut Panel) {
    let grazing = data.exact.iter().filter_map(|at| Some([at.frequency_ratio, at.grazing()?]));
    let grazing: Vec<MarkedPoint> = grazing.map(|at| chart.at(at).into()).collect();
    let limits = data.exact.iter().flat_map(|at| {
        let bounds = at.symmetric.limits.iter().filter(|limit| limit.bounds_stability);
        bounds.map(|limit| {
            scene.mark(chart, [at.frequency_ratio, limit.clearance], limit.kind.words())
        })
    });
    let limits: Vec<MarkedPoint> = limits.collect();
    let small = |shape| Marker::hollow(shape).sized(5.0);
    for (name, shape, marks) in
        [("Z2 ends (exact)", Shape::Square, grazing), ("exact limits", Shape::Circle, limits)]
    {
        if !marks.is_empty() {
            let layer = Layer::marked(small(shape), Role::ExactOrbit.color(), marks);
            panel.layers.push(layer.labelled(name));
        }
    }
}

/// How far each boundary of the theory lies from the exact one; none where there is nothing to compare.
fn errors(scene: &Scene, data: &Map, x: Axis) -> Option<Panel> {
    let kinds = [&of::EXCITATION_FREQUENCY, &of::THEORY_ERROR];
    let known = |errors: &[AsymptoticError], kind| {
        let mut bounds = errors.iter().filter(|error| error.bounds_stability);
        bounds.find_map(|error| error.difference.filter(|_| error.kind == kind))
    };
    let (mut range, mut lines) = ([-0.01_f64, 0.01_f64], Vec::new());
    for (kind, role, name) in COMPARED {
        let line: Vec<[f64; 2]> = data
            .errors
            .iter()
            .map(|(ratio, errors)| [*ratio, known(errors, kind).unwrap_or(f64::NAN)])
            .collect();
        for at in line.iter().filter(|at| at[1].is_finite()) {
            range = [range[0].min(at[1]), range[1].max(at[1])];
        }
        lines.push((role, name, line));
    }
    lines.retain(|(_, _, line)| line.iter().any(|at| at[1].is_finite()));
    let span = range[1] - range[0];
    let range = [range[0] - 0.1 * span, range[1] + 0.1 * span];
    let chart = Chart::new(scene, kinds, [data.window, range]);
    let mut panel = Panel { x, ..chart.panel() }
        .with(chart.vertical(scene.system().frequency_ratio(), Role::Guide))
        .with(chart.horizontal(0.0, Role::Guide));
    for (role, name, line) in &lines {
        let shown = line.iter().filter(|at| at[1].is_finite());
        let marks = shown.map(|at| chart.at(*at));
        let marks = Layer::marked(role.marker().sized(4.0), role.color(), marks);
        panel = panel.with(chart.curve(*role, line).labelled(*name)).with(marks);
    }
    (!lines.is_empty()).then_some(panel)
}

/// In the reduced parameters `(sigma, gamma)`.
pub(super) fn plane(scene: &Scene, borders: &Borders) -> Figure {
    let system = scene.system();
    let case = [system.detuning(), system.forcing_per_clearance()];
    let meeting = borders.meeting.map_or(1.0, |at| at[1]);
    // Beyond this ratio between case and P1 a linear axis would hide one of them.
    let log = case[1] > 0.0 && !(1.0 / 15.0..=15.0).contains(&(case[1] / meeting));
    let top = (1.2 * case[1]).max(3.0 * meeting);
    let y = if log { [0.4 * meeting.min(case[1]), 1.5 * top] } else { [0.0, top] };
    let kinds = [&of::DETUNING, &of::FORCING_PER_CLEARANCE];
    let chart = Chart::new(scene, kinds, [borders.window(), y]).with_log([false, log]);
    let mut panel = chart.panel();
    panel.layers = borders.layers(&|detuning, gamma| [detuning, gamma], y, &[]);
    let here = scene.mark(&chart, case, "this case");
    let panel = panel.with(Layer::this_case(case, here.tooltip));
    let at = &scene.study.analysis.boundaries;
    let gamma = |value| scene.theory(&of::FORCING_PER_CLEARANCE, value);
    let facts = json!({
        "gamma": gamma(case[1]),
        "detuning": scene.theory(&of::DETUNING, case[0]),
        "hopf": gamma(at.hopf),
        "breaking": gamma(at.symmetry_breaking),
        "place": if case[1] < at.hopf { "below" } else if case[1] > at.symmetry_breaking { "above" } else { "between" },
        "meeting": borders.meeting.map(|at| json!({
            "detuning": scene.theory(&of::DETUNING, at[0]), "gamma": gamma(at[1])
        })),
    });
    scene.figure("plane", "captions/plane", facts).with_panel(panel)
}

/// Colour and dashes of the three frequencies; P1's is in the middle.
const STYLES: [Style; 3] = [
    Style::new(Color::Orange, 2.0, Dash::LongDashed),
    Style::new(Color::Black, 2.0, Dash::Solid),
    Style::new(Color::SkyBlue, 2.0, Dash::DashDot),
];

/// What the saddle-node and the Hopf boundary are, and where they lie.
pub(super) fn bifurcations(scene: &Scene, data: &Bifurcations) -> Figure {
    let meeting = scene.study.analysis.boundaries.codimension_two;
    let highest = |at: &Condition| at.collision.map_or(at.hopf, |(_, b, _)| b.max(at.hopf));
    let highest = data.conditions.iter().map(highest).fold(0.0, f64::max);
    let y = [0.0, 1.25 * highest.max(scene.clearance(meeting.forcing_over_clearance))];
    let side = |at: &Condition| {
        json!({
            "frequency": scene.theory(&of::EXCITATION_FREQUENCY, scene.ratio(at.detuning)),
            "hopf": scene.theory(&of::BOUNDARY, at.hopf),
            "collision": at.collision.map(|(_, b, branch)| json!({
                "at": scene.theory(&of::BOUNDARY, b),
                "strip": if branch == Branch::Left { "A2" } else { "A1" },
            })),
        })
    };
    let facts = json!({
        "sides": [side(&data.conditions[0]), side(&data.conditions[2])],
        "meeting": scene.theory(&of::EXCITATION_FREQUENCY, scene.ratio(meeting.detuning)),
        "gamma": scene.theory(&of::FORCING_PER_CLEARANCE, meeting.forcing_over_clearance),
    });
    scene
        .figure("bifurcations", "captions/bifurcations", facts)
        .with_size(860, 450)
        .with_panel(condition_panel(scene, data, y))
        .with_panel(border_panel(scene, data, y))
}

/// Marks of the Hopf condition and of collisions.
fn condition_marks(hopf: Vec<MarkedPoint>, collisions: Vec<MarkedPoint>) -> [Layer; 2] {
    [
        Layer::marked(Role::Hopf.marker().sized(9.0), Role::Hopf.color(), hopf),
        Layer::marked(Role::SaddleNode.marker().sized(9.0), Role::SaddleNode.color(), collisions),
    ]
}

/// Which clearance gives a fixed point which amplitude: its top is the collision.
fn condition_panel(scene: &Scene, data: &Bifurcations, y: [f64; 2]) -> Panel {
    let kinds = [&of::ABSORBER_AMPLITUDE_RATIO, &of::CLEARANCE];
    let chart = Chart::new(scene, kinds, [Bifurcations::AMPLITUDES, y]);
    let fold = scene.study.analysis.manifold.fold.absorber_amplitude;
    let mut panel = chart.panel().with_heading("clearance of a fixed point");
    panel = panel.with(chart.vertical(fold, Role::Guide).labelled("fold"));
    for (at, style) in data.conditions.iter().zip(STYLES) {
        let name = scene.text(&of::EXCITATION_FREQUENCY, scene.ratio(at.detuning));
        panel = panel.with(Layer::styled(style, chart.line(&at.line)).labelled(name));
    }
    let hopf = data.conditions.iter().map(|at| scene.mark(&chart, [fold, at.hopf], "Hopf"));
    let collisions = data.conditions.iter().filter_map(|at| at.collision);
    let collisions =
        collisions.map(|(absorber, b, _)| scene.mark(&chart, [absorber, b], "saddle-node"));
    let [hopf, collisions] = condition_marks(hopf.collect(), collisions.collect());
    panel
        .with(hopf.labelled("Hopf: at the fold"))
        .with(collisions.labelled("saddle-node: at the top"))
}

/// The two boundaries around P1, with the same frequencies.
fn border_panel(scene: &Scene, data: &Bifurcations, y: [f64; 2]) -> Panel {
    let kinds = [&of::EXCITATION_FREQUENCY, &of::CLEARANCE];
    let window = data.borders.window().map(|detuning| scene.ratio(detuning));
    let chart = Chart::new(scene, kinds, [window, y]);
    let place =
        |detuning: f64, gamma: f64| chart.at([scene.ratio(detuning), scene.clearance(gamma)]);
    let mut panel = chart.panel().with_heading("the boundaries");
    panel.layers = data.borders.layers(&place, [chart.at(y)[1], 0.0], &[]);
    let (mut hopf, mut collisions) = (Vec::new(), Vec::new());
    for (at, style) in data.conditions.iter().zip(STYLES) {
        let ratio = scene.ratio(at.detuning);
        panel = panel.with(chart.vertical(ratio, Style { width: 1.1, ..style }));
        hopf.push(scene.mark(&chart, [ratio, at.hopf], "Hopf"));
        let collision = at.collision.map(|(_, b, _)| scene.mark(&chart, [ratio, b], "saddle-node"));
        collisions.extend(collision);
    }
    panel.layers.extend(condition_marks(hopf, collisions));
    panel
}
