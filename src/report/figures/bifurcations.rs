//! What the saddle-node and the Hopf boundary are (Figs. 6a and 6b), and where they lie.

use crate::analysis::{AnalysisError, Boundaries, Branch, FixedPointCurve, Manifold};
use crate::report::figure::{
    Axis, Color, Dash, Figure, Layer, Layout, MarkedPoint, Marker, Panel, Role, Rule, Shape, Style,
};
use crate::report::numbers::significant;
use crate::study::StudyError;
use crate::system::System;

use super::Scene;
use super::borders::Borders;

/// Amplitudes `B/b` that are shown: both boundaries lie far inside.
const RANGE: (f64, f64) = (0.5, 1.75);
const SAMPLES: u32 = 240;
/// The window in detuning reaches so many times as far from P1 as the case.
const BEYOND_CASE: f64 = 1.5;
/// Least distance of a neighbouring frequency from P1, in detuning.
const LEAST: f64 = 0.8;

/// One frequency: where a fixed point is at the fold, and where two collide.
struct Condition {
    detuning: f64,
    color: Color,
    style: Style,
    /// `[B/b, clearance]`.
    line: Vec<[f64; 2]>,
    hopf: f64,
    /// `B/b`, clearance, branch.
    collision: Option<(f64, f64, Branch)>,
}

pub(super) fn figure(scene: &Scene) -> Result<Option<Figure>, StudyError> {
    let analysis = &scene.study.analysis;
    let (system, manifold) = (&analysis.system, &analysis.manifold);
    let meeting = analysis.boundaries.codimension_two;
    let known = meeting.forcing_over_clearance > 0.0 && meeting.detuning.is_finite();
    if system.forcing_per_clearance() == 0.0 || !known || manifold.fold.oscillator_amplitude == 0.0
    {
        return Ok(None);
    }
    let away = system.detuning() - meeting.detuning;
    let away = if away.abs() < LEAST { LEAST.copysign(away) } else { away };
    let mut conditions = Vec::new();
    for (part, color, dash) in [
        (-1.0, Color::Orange, Dash::LongDashed),
        (0.0, Color::Black, Dash::Solid),
        (1.0, Color::SkyBlue, Dash::DashDot),
    ] {
        let detuning = meeting.detuning + part * away;
        let style = Style::new(color, 2.0, dash);
        let Ok(there) = system.with_detuning(detuning) else { return Ok(None) };
        conditions.push(condition(scene, &there, manifold, style)?);
    }
    let units = &scene.units;
    let gamma = system.forcing_per_clearance();
    let highest = conditions
        .iter()
        .map(|at| at.collision.map_or(at.hopf, |(_, clearance, _)| clearance.max(at.hopf)))
        .fold(0.0, f64::max);
    let top = 1.25 * highest.max(gamma / meeting.forcing_over_clearance);
    let y = || Axis::linear(units.length_axis("clearance b")).with_range(0.0, units.length(top));
    let first = first(scene, manifold, &conditions, y());
    let second = second(scene, &conditions, away.abs(), y())?;
    let (caption, alt) = words(scene, &conditions);
    Ok(Some(
        Figure::new("bifurcations", "Saddle-node and Hopf condition, and the boundaries they give")
            .with_size(860, 450)
            .with_layout(Layout::columns(&[1.0, 1.0]))
            .with_panel(first)
            .with_panel(second)
            .with_words(caption, alt),
    ))
}

fn condition(
    scene: &Scene,
    there: &System,
    manifold: &Manifold,
    style: Style,
) -> Result<Condition, AnalysisError> {
    let curve = FixedPointCurve::of(there, manifold);
    let gamma = there.forcing_per_clearance();
    let mut line = Vec::new();
    for k in 0..=SAMPLES {
        let ratio = RANGE.0 + (RANGE.1 - RANGE.0) * f64::from(k) / f64::from(SAMPLES);
        line.push([ratio, scene.units.length(gamma / curve.forcing_squared(ratio).sqrt())]);
    }
    let boundaries = Boundaries::of(there, manifold);
    let outer = boundaries.saddle_node;
    Ok(Condition {
        detuning: there.detuning(),
        color: style.color,
        style,
        line,
        hopf: gamma / boundaries.hopf,
        collision: outer.map(|node| {
            (node.absorber_amplitude, gamma / node.forcing_over_clearance, node.branch)
        }),
    })
}

/// Which clearance gives a fixed point which amplitude: its top is the collision.
fn first(scene: &Scene, manifold: &Manifold, conditions: &[Condition], y: Axis) -> Panel {
    let units = &scene.units;
    let fold = manifold.fold.absorber_amplitude;
    let x = Axis::linear("absorber amplitude B/b (1)").with_range(RANGE.0, RANGE.1);
    let mut panel = Panel::new(x, y)
        .with_heading("clearance of a fixed point")
        .with(Layer::rule(Rule::Vertical(fold), Role::Guide.style()).labelled("fold"));
    for at in conditions {
        let name = frequency(scene, at);
        panel = panel.with(Layer::styled(at.style, at.line.clone()).labelled(name));
    }
    let hopf = conditions.iter().map(|at| {
        let text = format!("Hopf at {}: b = {}", frequency(scene, at), units.length_text(at.hopf));
        MarkedPoint::new(fold, units.length(at.hopf)).with_tooltip(text)
    });
    let collisions = conditions.iter().filter_map(|at| {
        let (absorber, clearance, _) = at.collision?;
        let text = units.length_text(clearance);
        let text = format!("saddle-node at {}: b = {text}", frequency(scene, at));
        Some(MarkedPoint::new(absorber, units.length(clearance)).with_tooltip(text))
    });
    panel
        .with(
            Layer::marked(Role::Hopf.marker().sized(9.0), Role::Hopf.color(), hopf)
                .labelled("Hopf: at the fold"),
        )
        .with(
            Layer::marked(
                Marker::filled(Shape::Cross).sized(9.0),
                Role::SaddleNode.color(),
                collisions,
            )
            .labelled("saddle-node: at the top"),
        )
}

/// The two boundaries around P1, with the same frequencies.
fn second(
    scene: &Scene,
    conditions: &[Condition],
    away: f64,
    y: Axis,
) -> Result<Panel, AnalysisError> {
    let analysis = &scene.study.analysis;
    let (system, units) = (&analysis.system, &scene.units);
    let middle = analysis.boundaries.codimension_two.detuning;
    let lowest = -0.95 / system.mass_ratio();
    let window = ((middle - BEYOND_CASE * away).max(lowest), middle + BEYOND_CASE * away);
    let borders = Borders::over(system, &analysis.manifold, window)?;
    let gamma = system.forcing_per_clearance();
    let at = |detuning: f64| units.frequency(1.0 + system.mass_ratio() * detuning);
    let x = Axis::linear(units.frequency_axis()).with_range(at(window.0), at(window.1));
    let mut panel = Panel::new(x, y).with_heading("the boundaries");
    panel.layers =
        borders.layers(&|detuning, forcing| [at(detuning), units.length(gamma / forcing)]);
    for condition in conditions {
        let style = Style { width: 1.1, ..condition.style };
        panel = panel.with(Layer::rule(Rule::Vertical(at(condition.detuning)), style));
        let mark = |marker, color, clearance: f64| {
            let point = MarkedPoint::new(at(condition.detuning), units.length(clearance));
            Layer::marked(marker, color, [point])
        };
        panel =
            panel.with(mark(Role::Hopf.marker().sized(9.0), Role::Hopf.color(), condition.hopf));
        if let Some((_, clearance, _)) = condition.collision {
            let cross = Marker::filled(Shape::Cross).sized(9.0);
            panel = panel.with(mark(cross, Role::SaddleNode.color(), clearance));
        }
    }
    debug_assert!(conditions.iter().all(|at| at.color == at.style.color));
    Ok(panel)
}

fn frequency(scene: &Scene, at: &Condition) -> String {
    let ratio = 1.0 + scene.study.analysis.system.mass_ratio() * at.detuning;
    scene.units.frequency_text(ratio)
}

fn words(scene: &Scene, conditions: &[Condition]) -> (String, String) {
    let units = &scene.units;
    let say = |at: &Condition| {
        let collision = match at.collision {
            Some((_, clearance, Branch::Left)) => {
                format!("saddle-node at {} on the left branch (A2)", units.length_text(clearance))
            }
            Some((_, clearance, _)) => {
                format!("saddle-node at {} on the stable branch (A1)", units.length_text(clearance))
            }
            None => "no saddle-node".to_owned(),
        };
        format!("{}: Hopf at {}, {collision}", frequency(scene, at), units.length_text(at.hopf))
    };
    let sides: Vec<String> =
        conditions.iter().filter(|at| at.color != Color::Black).map(say).collect();
    let meeting = scene.study.analysis.boundaries.codimension_two;
    let ratio = 1.0 + scene.study.analysis.system.mass_ratio() * meeting.detuning;
    let caption = format!(
        "{}. The two conditions are one at P1: {}, γ = {}.",
        sides.join("; "),
        units.frequency_text(ratio),
        significant(meeting.forcing_over_clearance, 4)
    );
    let alt = format!(
        "Left, the clearance at which a fixed point has a given amplitude, for three frequencies: its top is the saddle-node, its height \
         at the fold the Hopf condition. Right, both boundaries in frequency and clearance. {caption}"
    );
    (caption, alt)
}
