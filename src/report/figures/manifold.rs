//! The slow invariant manifold with the case's fixed points and its observed motions (Fig. 3).

use crate::analysis::motion::read_off;
use crate::analysis::{Branch, FixedPoint, Manifold};
use crate::regimes::{FoundAttractor, Regime};
use crate::report::figure::{Axis, Color, Figure, Layer, MarkedPoint, Panel, Role};
use crate::report::numbers::significant;

use super::Scene;

/// `B/b` up to which the manifold is always shown.
const WIDEST: f64 = 2.5;
/// Beyond this `B/b` both axes are logarithmic, from this on.
const FAR: f64 = 40.0;
const LEAST: f64 = 0.05;
/// Samples of each branch.
const SAMPLES: u32 = 200;

/// The manifold's three branches up to `B/b = last`: left, right, stable.
pub(super) fn branches(manifold: &Manifold, last: f64) -> [Layer; 3] {
    let breaking = manifold.symmetry_breaking.absorber_amplitude;
    let part = |role, first: f64, last: f64| {
        let at = |k: u32| first + (last - first) * f64::from(k) / f64::from(SAMPLES);
        let points = (0..=SAMPLES).map(|k| manifold.point(at(k)));
        Layer::curve(role, points.map(|p| [p.absorber_amplitude, p.oscillator_amplitude]).collect())
    };
    [
        part(Role::Unstable, -1.0, manifold.fold_shift),
        part(Role::Unstable, breaking - 1.0, last.max(breaking) - 1.0),
        part(Role::Stable, manifold.fold_shift, breaking - 1.0),
    ]
}

/// What was observed of an attractor that moves: `[B/b, C/b]` by its first harmonics.
pub(super) fn observed(scene: &Scene, found: &FoundAttractor) -> Option<[f64; 2]> {
    let attractor = &found.attractor;
    let system = &scene.study.analysis.system;
    let seen = read_off(system, attractor.oscillator_harmonic, attractor.absorber_harmonic);
    let finite = seen.absorber_amplitude.is_finite() && seen.oscillator_amplitude.is_finite();
    finite.then_some([seen.absorber_amplitude, seen.oscillator_amplitude])
}

/// A fixed point in words.
pub(super) fn describe(point: &FixedPoint) -> String {
    let stability = if point.stable { "stable" } else { "unstable" };
    let branch = match point.branch {
        Branch::Left => "left branch",
        Branch::Stable => "stable branch",
        Branch::Right => "right branch",
    };
    format!(
        "fixed point, {} of the slow flow on the {branch}, {stability} motion: B/b = {}, C/b = {}",
        point.kind.words(),
        significant(point.absorber_amplitude, 4),
        significant(point.oscillator_amplitude, 4)
    )
}

/// Fixed points: stable ones filled, unstable ones hollow.
pub(super) fn markers(
    points: &[FixedPoint],
    place: &dyn Fn(&FixedPoint) -> [f64; 2],
) -> Vec<Layer> {
    let layer = |role: Role, stable: bool| {
        let chosen = points.iter().filter(|point| point.stable == stable);
        let marks = chosen.map(|at| MarkedPoint::from(place(at)).with_tooltip(describe(at)));
        Layer::marked(role.marker().sized(9.0), role.color(), marks.collect::<Vec<_>>())
    };
    vec![layer(Role::Stable, true), layer(Role::Unstable, false)]
}

/// Fixed points with their names.
fn named_markers(points: &[FixedPoint]) -> Vec<Layer> {
    let count = |stable| points.iter().filter(|point| point.stable == stable).count();
    let names =
        [(true, "stable fixed point"), (false, "unstable fixed point")].map(|(stable, name)| {
            match count(stable) {
                0 => None,
                1 => Some(name.to_owned()),
                _ => Some(format!("{name}s")),
            }
        });
    let layers = markers(points, &|point| [point.absorber_amplitude, point.oscillator_amplitude]);
    layers.into_iter().zip(names).filter_map(|(layer, name)| Some(layer.labelled(name?))).collect()
}

pub(super) fn figure(scene: &Scene) -> Figure {
    let analysis = &scene.study.analysis;
    let manifold = &analysis.manifold;
    let seen: Vec<([f64; 2], Regime)> = scene
        .study
        .attractors
        .iter()
        .enumerate()
        .filter_map(|(index, _)| scene.drawn(index))
        .filter_map(|found| Some((observed(scene, found)?, found.regime())))
        .collect();
    let farthest = analysis
        .fixed_points
        .iter()
        .map(|point| point.absorber_amplitude)
        .chain(seen.iter().map(|(at, _)| at[0]))
        .fold(0.0, f64::max);
    let last = (1.08 * farthest).max(WIDEST);
    let [left, right, stable] = branches(manifold, last);
    let (fold, breaking) = (manifold.fold, manifold.symmetry_breaking);
    let special = [(fold, "fold"), (breaking, "symmetry breaking")].map(|(at, name)| {
        MarkedPoint::new(at.absorber_amplitude, at.oscillator_amplitude)
            .with_label(name)
            .with_tooltip(format!(
                "{name}: B/b = {}, C/b = {}",
                significant(at.absorber_amplitude, 4),
                significant(at.oscillator_amplitude, 4)
            ))
    });
    let mut panel = Panel::new(
        Axis::linear("absorber amplitude B/b (1)").with_range(0.0, last),
        Axis::linear("oscillator amplitude C/b (1)"),
    );
    if last > FAR {
        let bottom = (0.6 * fold.oscillator_amplitude).max(LEAST);
        panel.x = Axis::log(panel.x.label).with_range(LEAST, last);
        panel.y = Axis::log(panel.y.label).with_range(bottom, 1.3 * last);
    }
    let mut panel = panel
        .with(left.labelled("unstable"))
        .with(right)
        .with(stable.labelled("stable"))
        .with(Layer::marked(Role::Guide.marker().sized(6.0), Color::Black, special));
    panel.layers.extend(named_markers(&analysis.fixed_points));
    if !seen.is_empty() {
        let points = seen.iter().map(|(at, regime)| {
            MarkedPoint::from(*at).with_tooltip(format!(
                "simulated, {}: B/b = {}, C/b = {}",
                regime.words(),
                significant(at[0], 4),
                significant(at[1], 4)
            ))
        });
        panel = panel.with(Layer::points(Role::Simulation, points).labelled("simulated"));
    }
    let (caption, alt) = words(scene, &seen);
    Figure::new("sim", "The slow invariant manifold, its fixed points and the observed motions")
        .with_panel(panel)
        .with_words(caption, alt)
}

fn words(scene: &Scene, seen: &[([f64; 2], Regime)]) -> (String, String) {
    let analysis = &scene.study.analysis;
    let predicted = analysis.stable_points().last();
    let count = analysis.fixed_points.len();
    let amplitudes = |c: f64, b: f64| {
        let length = |value| scene.units.length_text(value);
        format!("C = {} and B = {}", length(c), length(b))
    };
    let place = scene.units.place_text(&analysis.system);
    let first = match (predicted, count) {
        (None, 0) => {
            format!("At {place} there is no fixed point: no steady 1:1 motion at any amplitude.")
        }
        (None, 1) => format!(
            "At {place} the only fixed point is unstable (C = {}).",
            scene.units.length_text(analysis.fixed_points[0].oscillator_amplitude)
        ),
        (None, 2) => format!("At {place} both fixed points are unstable."),
        (None, n) => format!("At {place} all {n} fixed points are unstable."),
        (Some(point), n) => format!(
            "At {place} {} a stable motion, with {}.",
            if n == 1 {
                "the only fixed point is".to_owned()
            } else {
                format!("one of {n} fixed points is")
            },
            amplitudes(point.oscillator_amplitude, point.absorber_amplitude)
        ),
    };
    let close = predicted.and_then(|point| {
        let two = seen.iter().filter(|(_, regime)| regime.is_two_per_period());
        let away =
            |at: &[f64; 2]| (at[1] - point.oscillator_amplitude).abs() / point.oscillator_amplitude;
        two.map(|(at, _)| (at, away(at))).min_by(|a, b| a.1.total_cmp(&b.1))
    });
    let second = match close {
        Some((at, away)) => format!(
            " Simulation settles at C = {}, {} {} than predicted.",
            scene.units.length_text(at[1]),
            crate::report::numbers::percent(away),
            if at[1] >= predicted.map_or(0.0, |p| p.oscillator_amplitude) {
                "more"
            } else {
                "less"
            }
        ),
        None => String::new(),
    };
    let (fold, breaking) = (analysis.manifold.fold, analysis.manifold.symmetry_breaking);
    let caption = format!("{first}{second}");
    let alt = format!(
        "The oscillator's amplitude over the absorber's: a curve that falls to a fold at B/b = {} and rises again, stable up to \
         symmetry breaking at B/b = {}. {caption}",
        significant(fold.absorber_amplitude, 3),
        significant(breaking.absorber_amplitude, 3)
    );
    (caption, alt)
}
