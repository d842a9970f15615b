//! The slow invariant manifold and what lies on it (Figs. 3, 5 and 7).

use serde_json::{Value, json};

use crate::quantity::catalogue as of;
use crate::regimes::Regime;
use crate::report::figure::{
    Color, Dash, Figure, Label, Layer, Layout, Marker, Panel, Role, Shape, Style,
};
use crate::study::plots::responses::BAND;
use crate::study::plots::restitutions::observed;
use crate::study::plots::{Areas, Responses, drawn};

use super::parts;
use super::{DrawnCase, Ends};

/// Beyond this `B/b` the plane of the manifold is logarithmic.
const FAR: f64 = 40.0;

/// With the case's fixed points and its observed motions.
pub(super) fn manifold(scene: &DrawnCase) -> Figure {
    let analysis = &scene.study.analysis;
    let manifold = &analysis.manifold;
    let seen: Vec<([f64; 2], Regime)> = (0..scene.study.motions.len())
        .filter_map(|index| drawn(scene.study, index))
        .filter_map(|(motion, found)| Some((observed(scene.study, found)?, motion.regime())))
        .collect();
    let reached = analysis.fixed_points.iter().map(|point| point.absorber_amplitude);
    let farthest = reached.chain(seen.iter().map(|(at, _)| at[0])).fold(0.0, f64::max);
    let last = (1.08 * farthest).max(2.5);
    let [fold, breaking] = [manifold.fold, manifold.symmetry_breaking];
    let log = last > FAR;
    let bottom = (0.6 * fold.oscillator_amplitude).max(0.05);
    let ranges =
        if log { [[0.05, last], [bottom, 1.3 * last]] } else { [[0.0, last], [0.0, f64::NAN]] };
    let chart = parts::amplitudes(scene, ranges[0], ranges[1]).with_log([log; 2]);
    let special = [(fold, "fold"), (breaking, "symmetry breaking")].map(|(at, name)| {
        let at = [at.absorber_amplitude, at.oscillator_amplitude];
        scene.mark(&chart, at, name).with_label(name)
    });
    let [unstable, stable] = parts::manifold_layers(manifold, last);
    let mut panel = chart
        .panel()
        .with(unstable.labelled("unstable"))
        .with(stable.labelled("stable"))
        .with(Layer::marked(Role::Guide.marker().sized(6.0), Color::Black, special));
    let looks = parts::own_points();
    let points = parts::fixed_points(scene, &analysis.fixed_points, looks, &|point| {
        [point.absorber_amplitude, point.oscillator_amplitude]
    });
    for (layer, stable) in points.into_iter().zip([true, false]) {
        let count = analysis.fixed_points.iter().filter(|point| point.stable == stable).count();
        let what = if stable { "stable" } else { "unstable" };
        let plural = if count == 1 { "" } else { "s" };
        panel = panel.with(layer.labelled(format!("{what} fixed point{plural}")));
    }
    if !seen.is_empty() {
        let marks = seen.iter().map(|(at, regime)| scene.mark(&chart, *at, regime.words()));
        panel = panel.with(Layer::points(Role::Simulation, marks).labelled("simulated"));
    }
    scene.figure("sim", "captions/sim", manifold_facts(scene, &seen)).with_panel(panel)
}

/// The predicted stable motion, and the simulated 1:1 motion next to it.
fn manifold_facts(scene: &DrawnCase, seen: &[([f64; 2], Regime)]) -> Value {
    let analysis = &scene.study.analysis;
    let predicted = analysis.stable_points().last();
    let two = seen.iter().filter(|(_, regime)| regime.is_two_per_period());
    let close = predicted.and_then(|point| {
        let change = |at: &[f64; 2]| at[1] / point.oscillator_amplitude - 1.0;
        two.map(|(at, _)| (at[1], change(at))).min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
    });
    let [fold, breaking] = [analysis.manifold.fold, analysis.manifold.symmetry_breaking];
    json!({
        "stable": predicted.map(|at| [at.oscillator_amplitude, at.absorber_amplitude]),
        "seen": close,
        "fold": fold.absorber_amplitude,
        "breaking": breaking.absorber_amplitude,
    })
}

/// Colours and dashes of the responses, from the smallest clearance to the largest; the case's own is black.
const STYLES: [(Color, Dash); 4] = [
    (Color::Orange, Dash::Dotted),
    (Color::BluishGreen, Dash::Dashed),
    (Color::SkyBlue, Dash::DashDot),
    (Color::Blue, Dash::LongDashed),
];

/// Frequency responses beside the manifold.
pub(super) fn figure(scene: &DrawnCase, data: &Responses) -> Figure {
    let analysis = &scene.study.analysis;
    let log = data.heights[0] > 0.0;
    let last = 2.0 * data.heights[1] + if data.own { 1.0 } else { 0.0 };
    let reach = last.min(data.heights[1] + 1.0);
    let left = parts::amplitudes(scene, [0.0, last], data.heights).with_log([false, log]);
    let kinds = [&of::EXCITATION_FREQUENCY, &of::OSCILLATOR_AMPLITUDE_RATIO];
    let right = scene.chart(kinds, [data.window, data.heights]).with_log([false, log]);
    let [unstable, stable] = parts::manifold_layers(&analysis.manifold, reach);
    let mut first = left.panel().with_heading("manifold");
    first.layers.extend(parts::levels(&data.levels, &left));
    first = first.with(unstable.labelled("unstable")).with(stable.labelled("stable"));
    let mut second = right.panel().with_heading("responses");
    second.layers.extend(parts::levels(&data.levels, &right));
    for (k, member) in data.members.iter().enumerate() {
        let own = data.own && k + 1 == data.members.len();
        let (color, dash) =
            if own { (Color::Black, Dash::Dashed) } else { STYLES[k % STYLES.len()] };
        let [stable, unstable] = member.lines.clone();
        let width = if own { 3.4 } else { 2.2 };
        let name = scene.at_clearance(member.clearance);
        let name = if own { format!("{name}, this case") } else { name };
        let thin = (Style::new(color, 1.1, dash), unstable);
        let layers = parts::branches([thin, (Style::new(color, width, Dash::Solid), stable)], name);
        second.layers.extend(layers);
    }
    if data.own {
        let ratio = scene.system().frequency_ratio();
        second.layers.insert(0, Layer::vertical(ratio, Role::Guide));
        let (points, looks) = (&analysis.fixed_points, parts::own_points());
        first.layers.extend(parts::fixed_points(scene, points, looks, &|point| {
            [point.absorber_amplitude, point.oscillator_amplitude]
        }));
        second.layers.extend(parts::fixed_points(scene, points, looks, &|point| {
            [ratio, point.oscillator_amplitude]
        }));
    }
    let name = if data.own { "response" } else { "forcing-responses" };
    let template = if data.own { "captions/response" } else { "captions/forcing-responses" };
    scene
        .figure(name, template, response_facts(scene, data))
        .with_size(860, 450)
        .with_layout(Layout::columns(&[2.0, 3.0]))
        .with_panel(first)
        .with_panel(second)
}

fn response_facts(scene: &DrawnCase, data: &Responses) -> Value {
    let analysis = &scene.study.analysis;
    let band = [-BAND, BAND].map(|at| scene.ratio(at));
    let shares: Vec<[f64; 2]> = data.members.iter().map(|at| [at.clearance, at.share]).collect();
    json!({
        "stable": analysis.stable_points().last().map(|at| at.oscillator_amplitude),
        "band": band,
        "shares": shares,
    })
}

/// The areas along the manifold, and how the fixed points move as the clearance grows.
pub(super) fn areas(scene: &DrawnCase, data: &Areas) -> Figure {
    let manifold = &scene.study.analysis.manifold;
    let Ends { breaking, hopf, last, .. } = scene.ends;
    let top = manifold.point(Areas::WIDEST - 1.0).oscillator_amplitude;
    let reach = 1.12 * last.map_or(hopf, |last| last.max(hopf));
    let left = parts::amplitudes(scene, [0.0, Areas::WIDEST], [0.0, top]);
    let kinds = [&of::CLEARANCE, &of::OSCILLATOR_AMPLITUDE_RATIO];
    let right = scene.chart(kinds, [[0.4 * breaking, reach], [0.0, top]]);
    let mut first = left.panel().with_heading("on the manifold");
    first.layers.extend(parts::levels(&data.levels, &left));
    first.layers.extend(parts::manifold_layers(manifold, Areas::WIDEST));
    let mut second = right.panel().with_heading("over the clearance");
    second.layers.extend(parts::levels(&data.levels, &right));
    let [stable, unstable] = &data.lines;
    let near =
        |at, height| Label::near(height, [at, if height == "Hopf" { 0.6 } else { 0.8 } * top]);
    second = second
        .with(Layer::curve(Role::Unstable, unstable.clone()).labelled("unstable"))
        .with(Layer::curve(Role::Stable, stable.clone()).labelled("stable"))
        .with(Layer::vertical(hopf, Role::Hopf).labelled(near(hopf, "Hopf")));
    if let Some(last) = last {
        second =
            second.with(Layer::vertical(last, Role::SaddleNode).labelled(near(last, "collision")));
    }
    chosen(scene, data, [&mut first, &mut second]);
    scene
        .figure("areas", "captions/areas", json!({ "levels": data.levels }))
        .with_size(860, 450)
        .with_panel(first)
        .with_panel(second)
}

/// Colours and shapes of the clearances that show the way.
const LOOKS: [(Color, Shape); 5] = [
    (Color::Black, Shape::Circle),
    (Color::Orange, Shape::Square),
    (Color::BluishGreen, Shape::Triangle),
    (Color::SkyBlue, Shape::Diamond),
    (Color::ReddishPurple, Shape::Circle),
];

/// The fixed points of some clearances in both panels: stable ones filled, others hollow.
fn chosen(scene: &DrawnCase, data: &Areas, panels: [&mut Panel; 2]) {
    for ((clearance, points), (color, shape)) in data.chosen.iter().zip(LOOKS) {
        let looks = [Marker::filled(shape), Marker::hollow(shape)].map(|marker| (marker, color));
        let [left, right] = [0, 1].map(|k| {
            parts::fixed_points(scene, points, looks, &|point| {
                let x = if k == 0 { point.absorber_amplitude } else { *clearance };
                [x, point.oscillator_amplitude]
            })
        });
        let named = usize::from(points.iter().all(|point| !point.stable));
        let name = |(k, layer): (usize, Layer)| {
            if k == named { layer.labelled(scene.at_clearance(*clearance)) } else { layer }
        };
        panels[0].layers.extend(left.into_iter().enumerate().map(name));
        panels[1].layers.extend(right);
    }
}
