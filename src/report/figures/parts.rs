//! What several figures draw alike.

use super::regimes::mark;
use crate::analysis::{FixedPoint, Manifold};
use crate::quantity::catalogue as of;
use crate::regimes::Regime;
use crate::report::chart::Chart;
use crate::report::figure::{Color, Fill, Hatch, Label, Layer, MarkedPoint, Marker, Role, Style};
use crate::study::plots::{Levels, Line};

use super::DrawnCase;

const fn tint(color: Color, opacity: f64) -> Fill {
    Fill { color, opacity, hatch: Hatch::None }
}
/// The areas of Fig. 5a.
pub(super) const Z1: Fill = tint(Color::Vermillion, 0.1);
pub(super) const Z2: Fill = tint(Color::Yellow, 0.2);
pub(super) const Z3: Fill = tint(Color::BluishGreen, 0.12);
pub(super) const Z4: Fill = tint(Color::Light, 0.15);

/// Samples of each branch of the manifold.
const SAMPLES: u32 = 200;

/// The plane of the manifold up to these amplitudes.
pub(super) fn amplitudes(scene: &DrawnCase, x: [f64; 2], y: [f64; 2]) -> Chart {
    scene.chart([&of::ABSORBER_AMPLITUDE_RATIO, &of::OSCILLATOR_AMPLITUDE_RATIO], [x, y])
}

/// The manifold between two values of `B/b - 1`.
pub(super) fn manifold_part(manifold: &Manifold, [first, last]: [f64; 2]) -> Line {
    let at = |k: u32| first + (last - first) * f64::from(k) / f64::from(SAMPLES);
    let points = (0..=SAMPLES).map(|k| manifold.point(at(k)));
    points.map(|point| [point.absorber_amplitude, point.oscillator_amplitude]).collect()
}

/// The manifold up to `B/b = last`: what is not stable, and the stable branch.
pub(in crate::report) fn manifold(manifold: &Manifold, last: f64) -> [Line; 2] {
    let breaking = manifold.symmetry_breaking.absorber_amplitude;
    let left = manifold_part(manifold, [-1.0, manifold.fold_shift]);
    let right = manifold_part(manifold, [breaking - 1.0, last.max(breaking) - 1.0]);
    let stable = manifold_part(manifold, [manifold.fold_shift, breaking - 1.0]);
    [[left, right].join(&[f64::NAN; 2]), stable]
}

/// The manifold's curves, unstable parts first.
pub(super) fn manifold_layers(of: &Manifold, last: f64) -> [Layer; 2] {
    let [unstable, stable] = manifold(of, last);
    [Layer::curve(Role::Unstable, unstable), Layer::curve(Role::Stable, stable)]
}

/// The unstable and the stable part of a curve, of which one has a name.
pub(super) fn branches(parts: [(Style, Line); 2], name: impl Into<Label>) -> [Layer; 2] {
    let named = usize::from(!parts[1].1.is_empty());
    let mut layers = parts.map(|(style, line)| Layer::curve(style, line));
    layers[named] = layers[named].clone().labelled(name);
    layers
}

/// Fixed points by their places: the stable and the unstable ones, in the looks of these.
pub(super) fn fixed_points(
    scene: &DrawnCase,
    points: &[FixedPoint],
    looks: [(Marker, Color); 2],
    place: &dyn Fn(&FixedPoint) -> [f64; 2],
) -> [Layer; 2] {
    let layer = |stable: bool| {
        let (marker, color) = looks[usize::from(!stable)];
        let chosen = points.iter().filter(|point| point.stable == stable);
        let marks = chosen.map(|point| fixed_point(scene, point, place(point)));
        Layer::marked(marker.sized(9.0), color, marks)
    };
    [layer(true), layer(false)]
}

/// How a case's own fixed points look.
pub(in crate::report) fn own_points() -> [(Marker, Color); 2] {
    [Role::Stable, Role::Unstable].map(|role| (role.marker(), role.color()))
}

/// A fixed point's mark.
fn fixed_point(scene: &DrawnCase, point: &FixedPoint, at: [f64; 2]) -> MarkedPoint {
    let stability = if point.stable { "stable" } else { "unstable" };
    let what = format!("{stability} fixed point, {} of the slow flow", point.kind.words());
    let amplitudes = [
        (&of::ABSORBER_AMPLITUDE_RATIO, point.absorber_amplitude),
        (&of::OSCILLATOR_AMPLITUDE_RATIO, point.oscillator_amplitude),
    ];
    MarkedPoint::from(at).with_tooltip(scene.tip(&what, &amplitudes))
}

/// Simulated motions by regime.
pub(super) fn by_regime(found: &[(Regime, MarkedPoint)], named: bool) -> Vec<Layer> {
    let layer = |regime: Regime| {
        let (marker, _) = mark(regime);
        let marks = found.iter().filter(|(one, _)| *one == regime).map(|(_, mark)| mark.clone());
        let marker = marker.sized(1.6 * marker.diameter);
        let layer = Layer::marked(marker, Role::Simulation.color(), marks);
        if named { layer.labelled(regime.short()) } else { layer }
    };
    Regime::ALL.map(layer).into()
}

/// The areas as bands of `C/b` over the whole of a panel.
pub(super) fn levels(levels: &Levels, chart: &Chart) -> Vec<Layer> {
    let [[first, last], [bottom, top]] = chart.ranges;
    let band = |name: &str, low: f64, high: f64, fill| {
        let side = |y| [[first, y], [last, y]];
        (low < high.min(top))
            .then(|| Layer::between(&side(low), &side(high.min(top)), fill).labelled(name))
    };
    let beyond = match levels.grazing {
        Some(level) => [band("Z2", levels.breaking, level, Z2), band("Z1", level, top, Z1)],
        None => [band("Z1", levels.breaking, top, Z1), None],
    };
    let below = [band("Z4", bottom, levels.fold, Z4), band("Z3", levels.fold, levels.breaking, Z3)];
    below.into_iter().chain(beyond).flatten().collect()
}
