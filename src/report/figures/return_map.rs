//! Return map of the time between impacts (Fig. 11).

use crate::regimes::return_map::pairs;
use crate::report::figure::{
    Axis, Color, Figure, Label, Layer, MarkedPoint, Marker, Panel, Role, Rule,
};
use crate::report::numbers::{percent, significant};

use super::Scene;

/// At most so many points, the last ones.
const POINTS: usize = 600;
/// Points that differ by less in both coordinates are one.
const SAME: f64 = 2e-3;
/// Up to so many points are drawn large and with a tooltip.
const SINGLE: usize = 12;
/// Axes end here or at the data.
const LEAST_END: f64 = 1.25;
const LARGEST_END: f64 = 4.0;

/// The figure of an attractor; none where there are too few impacts.
pub(super) fn figure(scene: &Scene, index: usize) -> Option<Figure> {
    let attractor = &scene.drawn(index)?.attractor;
    let period = scene.study.analysis.system.period();
    let first = attractor.impacts.len().saturating_sub(POINTS + 2);
    let all = pairs(&attractor.impacts[first..], period);
    if all.is_empty() {
        return None;
    }
    let points = distinct(&all);
    let largest = points.iter().flatten().copied().fold(0.0, f64::max);
    let end = (1.08 * largest).clamp(LEAST_END, LARGEST_END);
    let axis = |label: &str| Axis::linear(label).with_range(0.0, end);
    let line = Role::Guide.style().colored(Color::Grey);
    let sloped = |through, slope| Layer::rule(Rule::Sloped { through, slope }, line);
    let few = points.len() <= SINGLE;
    let marker = if few { Marker::dot().sized(8.0) } else { Marker::dot().sized(3.6) };
    let marks = points.iter().map(|[x, y]| {
        let mark = MarkedPoint::new(*x, *y);
        if !few {
            return mark;
        }
        let [x, y] = [*x, *y].map(|value| significant(value, 3));
        mark.with_tooltip(format!("{x} T, then {y} T"))
    });
    let wide = end < 2.0;
    let (sum, equal) = if wide { ("L1: sum is T", "L4: equal") } else { ("L1", "L4") };
    let near = |part: f64| 0.94 * end * part;
    let panel =
        Panel::new(axis("time between impacts Δtₖ/T (1)"), axis("the next one Δtₖ₊₁/T (1)"))
            .with(sloped([0.0, 1.0], -1.0).labelled(Label::near(sum, [0.7, 0.35])))
            .with(
                Layer::rule(Rule::Vertical(1.0), line)
                    .labelled(Label::near("L2", [1.0, near(1.0)])),
            )
            .with(
                Layer::rule(Rule::Horizontal(1.0), line)
                    .labelled(Label::near("L3", [near(1.0), 1.0])),
            )
            .with(sloped([0.0, 0.0], 1.0).labelled(Label::near(equal, [near(0.95), near(0.95)])))
            .with(Layer::marked(marker, Role::Simulation.color(), marks))
            .with_equal_aspect();
    let number = index + 1;
    let z = attractor.classification.evidence.impacts_per_period;
    let (caption, alt) = words(&all, &points, z, largest > LARGEST_END);
    let figure = Figure::new(
        format!("return-map-{number}"),
        format!("Times between impacts of motion {number}"),
    )
    .with_size(480, 450)
    .with_panel(panel)
    .with_words(caption, alt);
    Some(figure)
}

/// The points without those that coincide with an earlier one.
fn distinct(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut kept: Vec<[f64; 2]> = Vec::new();
    for point in points {
        let same = |other: &[f64; 2]| (0..2).all(|i| (point[i] - other[i]).abs() < SAME);
        if !kept.iter().any(same) {
            kept.push(*point);
        }
    }
    kept
}

fn words(all: &[[f64; 2]], distinct: &[[f64; 2]], z: f64, cut: bool) -> (String, String) {
    let on_line = all.iter().filter(|[x, y]| (x + y - 1.0).abs() < 0.02).count();
    let share = match on_line {
        0 => "none lies".to_owned(),
        _ => format!("{} lie", percent(on_line as f64 / all.len() as f64)),
    };
    let z = format!("z = {} impacts per period", significant(z, 3));
    let t = |value: f64| format!("{} T", significant(value, 3));
    let mut caption = match distinct {
        [[x, _]] => {
            format!("A single point: the impacts follow each other evenly, every {}.", t(*x))
        }
        [[x, y], _] => format!(
            "Two points: intervals of {} and {} take turns, so that the impacts are uneven.",
            t(*x),
            t(*y)
        ),
        // Each of them seen several times.
        _ if distinct.len() <= SINGLE && all.len() >= 4 * distinct.len() => {
            let least = distinct.iter().map(|point| point[0]).fold(f64::INFINITY, f64::min);
            let most = distinct.iter().map(|point| point[0]).fold(0.0, f64::max);
            format!(
                "{} points that repeat, with {z}: intervals from {} to {}.",
                distinct.len(),
                t(least),
                t(most)
            )
        }
        _ => format!(
            "Many different intervals, with {z}: {share} on L1 (within 0.02 T), where two intervals make one period."
        ),
    };
    if cut {
        caption.push_str(&format!(" Intervals above {} are not shown.", t(LARGEST_END)));
    }
    let alt = format!(
        "Each interval between impacts against the next one, in excitation periods T, with four guiding lines. {caption}"
    );
    (caption, alt)
}
