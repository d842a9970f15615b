//! The areas along the manifold, and how the fixed points move as the clearance grows (Fig. 5).

use crate::analysis::{Branch, FixedPoint, FixedPointCurve, Kind, Manifold, fixed_points};
use crate::report::figure::{
    Axis, Color, Figure, Label, Layer, Layout, MarkedPoint, Marker, Panel, Role, Rule, Shape,
};
use crate::report::numbers::significant;
use crate::study::StudyError;
use crate::system::System;

use super::Scene;
use super::levels::Levels;
use super::manifold::{branches, describe};

/// The manifold is shown up to this `B/b`, and as far as its right branch goes in `C/b`.
const WIDEST: f64 = 2.6;
/// Samples of the fixed points' line.
const SAMPLES: u32 = 1200;
/// The smallest clearance shown over that of symmetry breaking.
const SMALLEST: f64 = 0.5;

/// The boundaries at the case's frequency as clearances over the case's.
struct Route {
    breaking: f64,
    hopf: f64,
    /// Where the last fixed points collide, and on which branch.
    last: Option<(f64, Branch)>,
}

pub(super) fn figure(scene: &Scene) -> Result<Option<Figure>, StudyError> {
    let analysis = &scene.study.analysis;
    let (system, manifold) = (&analysis.system, &analysis.manifold);
    let gamma = system.forcing_per_clearance();
    if gamma == 0.0 || manifold.fold.oscillator_amplitude == 0.0 {
        return Ok(None);
    }
    let route = route(scene);
    let chosen = chosen(&route);
    let levels = Levels::of(system, manifold)?;
    let top = manifold.point(WIDEST - 1.0).oscillator_amplitude;
    let y = || Axis::linear("oscillator amplitude C/b (1)").with_range(0.0, top);
    let [left, right, stable] = branches(manifold, WIDEST);
    let x = Axis::linear("absorber amplitude B/b (1)").with_range(0.0, WIDEST);
    let mut first = Panel::new(x, y()).with_heading("on the manifold");
    first.layers.extend(levels.layers((0.0, WIDEST), top, 0.92 * WIDEST));
    first.layers.extend([left, right, stable]);

    let units = &scene.units;
    let reach = 1.12 * route.last.map_or(route.hopf, |(last, _)| last.max(route.hopf));
    let (from, to) = (units.length(0.8 * SMALLEST * route.breaking), units.length(reach));
    let x = Axis::linear(units.length_axis("clearance b")).with_range(from, to);
    let mut second = Panel::new(x, y()).with_heading("over the clearance");
    second.layers.extend(levels.layers((from, to), top, from + 0.93 * (to - from)));
    let place = |clearance: f64, c: f64| [units.length(clearance), c];
    for (role, stable) in [(Role::Unstable, false), (Role::Stable, true)] {
        let line = line(system, manifold, stable, &place);
        let name = if stable { "stable" } else { "unstable" };
        second = second.with(Layer::curve(role, line).labelled(name));
    }
    second = second.with(
        Layer::rule(Rule::Vertical(units.length(route.hopf)), Role::Hopf.style())
            .labelled(Label::near("Hopf", [units.length(route.hopf), 0.6 * top])),
    );
    if let Some((last, _)) = route.last {
        let at = units.length(last);
        let rule = Layer::rule(Rule::Vertical(at), Role::SaddleNode.style());
        second = second.with(rule.labelled(Label::near("collision", [at, 0.8 * top])));
    }
    let colors =
        [Color::Black, Color::Orange, Color::BluishGreen, Color::SkyBlue, Color::ReddishPurple];
    let shapes = [Shape::Circle, Shape::Square, Shape::Triangle, Shape::Diamond, Shape::Circle];
    for ((clearance, color), shape) in chosen.into_iter().zip(colors).zip(shapes) {
        let Ok(there) = system.with_clearance_scaled(clearance) else { continue };
        let points = fixed_points::solve(&there, manifold)?;
        let name = format!("b = {}", units.length_text(clearance));
        first.layers.extend(marks(&points, color, shape, Some(&name), &|p| {
            [p.absorber_amplitude, p.oscillator_amplitude]
        }));
        second.layers.extend(marks(&points, color, shape, None, &|p| {
            place(clearance, p.oscillator_amplitude)
        }));
    }
    let (caption, alt) = words(scene, &route, &levels);
    Ok(Some(
        Figure::new("areas", "Areas along the manifold, and the way of the fixed points")
            .with_size(860, 450)
            .with_layout(Layout::columns(&[1.0, 1.0]))
            .with_panel(first)
            .with_panel(second)
            .with_words(caption, alt),
    ))
}

fn route(scene: &Scene) -> Route {
    let boundaries = &scene.study.analysis.boundaries;
    let gamma = scene.study.analysis.system.forcing_per_clearance();
    let outer = boundaries.saddle_node;
    Route {
        breaking: gamma / boundaries.symmetry_breaking,
        hopf: gamma / boundaries.hopf,
        last: outer.map(|node| (gamma / node.forcing_over_clearance, node.branch)),
    }
}

/// Clearances that show the way: one in each area, and two on the way to the collision.
fn chosen(route: &Route) -> Vec<f64> {
    let Route { breaking, hopf, .. } = *route;
    let last = route.last.map_or(1.3 * hopf, |(last, _)| last);
    let between = |part: f64| hopf + part * (last - hopf);
    vec![0.75 * breaking, (breaking * hopf).sqrt(), 0.93 * hopf, between(0.5), between(0.97)]
}

/// Fixed points over the clearance, stable ones or others, in pieces: at a given amplitude the
/// clearance is explicit. A fixed point is a saddle where `gamma^2` falls with the amplitude.
fn line(
    system: &System,
    manifold: &Manifold,
    stable: bool,
    place: &dyn Fn(f64, f64) -> [f64; 2],
) -> Vec<[f64; 2]> {
    let curve = FixedPointCurve::of(system, manifold);
    let mut shifts: Vec<f64> = (1..=SAMPLES)
        .map(|k| WIDEST * f64::from(k) / f64::from(SAMPLES) - 1.0)
        .chain([manifold.fold_shift, manifold.symmetry_breaking.absorber_amplitude - 1.0])
        .collect();
    shifts.sort_by(f64::total_cmp);
    let forcing = |shift: f64| (shift, curve.forcing_squared(1.0 + shift).sqrt());
    let samples: Vec<(f64, f64)> = shifts.into_iter().map(forcing).collect();
    let gamma = system.forcing_per_clearance();
    let at = |(shift, forcing): (f64, f64)| {
        place(gamma / forcing, manifold.point(shift).oscillator_amplitude)
    };
    let mut points = Vec::new();
    for pair in samples.windows(2) {
        let within = manifold.branch(pair[0].0) == Branch::Stable
            && manifold.branch(pair[1].0) == Branch::Stable;
        if (within && pair[1].1 > pair[0].1) == stable {
            if points.last() != Some(&at(pair[0])) {
                points.extend([[f64::NAN; 2], at(pair[0])]);
            }
            points.push(at(pair[1]));
        }
    }
    points
}

/// The fixed points of one clearance: stable ones filled, others hollow.
fn marks(
    points: &[FixedPoint],
    color: Color,
    shape: Shape,
    name: Option<&str>,
    place: &dyn Fn(&FixedPoint) -> [f64; 2],
) -> Vec<Layer> {
    let layer = |stable: bool| {
        let marker = if stable { Marker::filled(shape) } else { Marker::hollow(shape) };
        let chosen = points.iter().filter(|point| point.stable == stable);
        let marks: Vec<MarkedPoint> =
            chosen.map(|at| MarkedPoint::from(place(at)).with_tooltip(describe(at))).collect();
        (!marks.is_empty()).then(|| Layer::marked(marker.sized(9.0), color, marks))
    };
    let mut layers: Vec<Layer> = [true, false].into_iter().filter_map(layer).collect();
    if let (Some(first), Some(name)) = (layers.first_mut(), name) {
        *first = first.clone().labelled(name);
    }
    layers
}

fn words(scene: &Scene, route: &Route, levels: &Levels) -> (String, String) {
    let units = &scene.units;
    let system = &scene.study.analysis.system;
    let frequency = units.frequency_text(system.frequency_ratio());
    let text = |clearance| units.length_text(clearance);
    let way = match route.last {
        Some((last, Branch::Stable)) => format!(
            "two fixed points on the stable branch, a stable one and a saddle, collide at {} and leave nothing; from {} on, where \
             another point passes the fold (Hopf), a modulated response coexists",
            text(last),
            text(route.hopf)
        ),
        Some((last, _)) => format!(
            "the fixed point passes the fold at {} (Hopf) and is unstable from there on; it meets the other one on the left branch at {}",
            text(route.hopf),
            text(last)
        ),
        None => format!("the fixed point passes the fold at {} (Hopf)", text(route.hopf)),
    };
    let saddles = scene.study.analysis.fixed_points.iter().any(|p| p.kind == Kind::Saddle);
    let grazing = match levels.grazing {
        Some(level) => format!(", Z2 up to C/b = {} (simulated)", significant(level, 3)),
        None => String::new(),
    };
    let caption = format!(
        "At {frequency} two impacts are symmetric from {} on; as the clearance grows, {way}.",
        text(route.breaking)
    );
    let alt = format!(
        "Left, the manifold with fixed points at five clearances; right, the fixed points' amplitude over the clearance. Z4 lies below \
         C/b = {}, Z3 up to {}{grazing}{}. {caption}",
        significant(levels.fold, 3),
        significant(levels.breaking, 3),
        if saddles { ", with a saddle at this case's clearance" } else { "" }
    );
    (caption, alt)
}
