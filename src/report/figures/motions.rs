//! A modulated motion on the manifold (Fig. 8), and the manifold at several restitutions (Fig. 9).

use serde_json::json;

use crate::analysis::{Manifold, ManifoldBranch};
use crate::quantity::catalogue as of;
use crate::report::figure::{
    Color, Dash, Figure, Label, Layer, Layout, Marker, Panel, Role, Shape, Style,
};
use crate::study::plots::restitutions::Taken;
use crate::study::plots::{Modulation, Restitutions};
use crate::study::stretches::TraceStretch;

use super::DrawnCase;
use super::parts;

/// A long stretch of a motion, enlarged where it is captured and where it stays.
pub(super) fn modulation(scene: &DrawnCase, data: &Modulation) -> Figure {
    let all = data.projection.line(None);
    let [transition, stay] = data.enlarged;
    let manifold = &scene.study.analysis.manifold;
    let over = |index: usize| all.iter().map(move |at| at[index]);
    let last = 1.08 * over(0).fold(2.0, f64::max);
    let low = over(1).fold(manifold.fold.oscillator_amplitude, f64::min);
    let y = [0.75 * low, 1.12 * over(1).fold(0.0, f64::max)];
    let heading = format!("{} periods", Modulation::PERIODS);
    let mut whole = on_manifold(scene, data, None, [[0.0, last], y]).with_heading(heading);
    let mut parts = Vec::new();
    for (letter, what, stretch) in
        [("b", "into 1:1 resonance", transition), ("c", "in 1:1 resonance", stay)]
    {
        let line = data.projection.line(Some(stretch));
        let [[left, right], [low, high]] = [around(&line, 0), around(&line, 1)];
        let frame = vec![[left, low], [right, low], [right, high], [left, high], [left, low]];
        let frame = Layer::curve(Style::new(Color::Black, 1.0, Dash::Solid), frame);
        whole = whole.with(frame.labelled(Label::near(letter, [right, high])));
        let panel = on_manifold(scene, data, Some(stretch), [[left, right], [low, high]]);
        parts.push(panel.with_heading(format!("{letter}: {what}")));
    }
    let captured: usize = data.captures.iter().map(|capture| capture.periods).sum();
    let facts = json!({
        "captures": data.captures.len(),
        "periods": Modulation::PERIODS,
        "share": captured as f64 / Modulation::PERIODS as f64,
        "transition": Modulation::TRANSITION,
        "away": data.away,
    });
    let cells = [[0, 0, 1, 2], [1, 0, 1, 1], [1, 1, 1, 1]];
    let figure = scene
        .figure("modulation", "captions/modulation", facts)
        .with_size(860, 560)
        .with_layout(Layout::cells(&[5.0, 4.0], &[1.0, 1.0], &cells))
        .with_panel(whole);
    parts.into_iter().fold(figure, Figure::with_panel)
}

fn on_manifold(
    scene: &DrawnCase,
    data: &Modulation,
    stretch: Option<TraceStretch>,
    [x, y]: [[f64; 2]; 2],
) -> Panel {
    let farthest = data.projection.path.iter().map(|(_, at)| at[0]).fold(2.0, f64::max);
    let mut panel = parts::amplitudes(scene, x, y).panel();
    panel.layers.extend(parts::manifold_layers(&scene.study.analysis.manifold, 1.08 * farthest));
    panel = panel.with(Layer::curve(Role::Simulation, data.projection.line(stretch)));
    let Some(stretch) = stretch else { return panel };
    let marks = data.projection.landed.iter().filter(|(at, _)| stretch.holds(*at));
    panel.with(Layer::points(Role::Simulation, marks.map(|(_, at)| *at)))
}

/// The range of one coordinate with some room.
fn around(line: &[[f64; 2]], index: usize) -> [f64; 2] {
    let low = line.iter().map(|at| at[index]).fold(f64::INFINITY, f64::min);
    let high = line.iter().map(|at| at[index]).fold(0.0, f64::max);
    let room = 0.12 * (high - low).max(0.02 * high.max(1e-6));
    [(low - room).max(0.0), high + room]
}

/// The restitutions of Fig. 9, and how they look.
const LOOKS: [(f64, Color, Dash); 5] = [
    (1.0, Color::Vermillion, Dash::LongDashed),
    (0.8, Color::Orange, Dash::Dashed),
    (0.6, Color::BluishGreen, Dash::Solid),
    (0.4, Color::Blue, Dash::DashDot),
    (0.2, Color::Black, Dash::Dotted),
];

/// The manifold, and what it takes from the oscillator.
pub(super) fn restitutions(scene: &DrawnCase, data: &Restitutions) -> Figure {
    let facts = json!({ "level": data.level, "strongest": data.strongest, "best": data.best });
    scene
        .figure("restitutions", "captions/restitutions", facts)
        .with_size(860, 450)
        .with_panel(manifolds(scene, data))
        .with_panel(over_restitution(scene, data))
}

fn manifolds(scene: &DrawnCase, data: &Restitutions) -> Panel {
    let (last, top) = (2.4_f64.max(1.3 + data.level), 1.5_f64.max(1.3 * data.level));
    let chart = parts::amplitudes(scene, [0.0, last], [0.0, top]);
    let rule = Layer::horizontal(data.level, Role::Guide.style().colored(Color::Grey));
    let rule = rule.labelled(Label::near("this case", [0.25 * last, data.level]));
    let mut panel = chart.panel().with_heading("manifolds: stable part thick").with(rule);
    let mut marks = Vec::new();
    for (restitution, color, dash) in LOOKS {
        let [unstable, stable] = parts::manifold(&Manifold::of(restitution), last);
        let thin = Style::new(color, 1.0, dash);
        let thick = Layer::curve(Style { width: 2.6, ..thin }, stable);
        panel = panel.with(Layer::curve(thin, unstable));
        panel = panel.with(thick.labelled(format!("r = {restitution}")));
        let close = |at: &&Taken| (at.restitution - restitution).abs() < 1e-9;
        if let Some(at) = data.taken.iter().find(close) {
            let filled = at.branch == ManifoldBranch::Stable;
            let marker = Marker { filled, ..Marker::hollow(Shape::Circle).sized(8.0) };
            let what = format!("r = {restitution}");
            let mark = scene.mark(&chart, [at.absorber, data.level], &what);
            marks.push(Layer::marked(marker, color, [mark]));
        }
    }
    panel.layers.extend(marks);
    panel
}

/// A value of a point of the manifold.
type ValueOf = fn(&Taken) -> f64;

fn over_restitution(scene: &DrawnCase, data: &Restitutions) -> Panel {
    let highest = data.taken.iter().map(|at| at.harmonic.max(at.damping)).fold(0.0, f64::max);
    let kinds = [&of::RESTITUTION, &of::HARMONIC_AMPLITUDE_RATIO];
    let chart = scene.chart(kinds, [[0.0, 1.0], [0.0, 1.12 * highest]]);
    let mut panel = chart.panel().with_heading("at this amplitude: stable part thick");
    let values: [(&str, Color, ValueOf); 2] = [
        ("E/b", Color::SkyBlue, |at| at.harmonic),
        ("E sin Θ/b", Color::Vermillion, |at| at.damping),
    ];
    for (name, color, value) in values {
        let [thick, thin] = data.lines(value);
        let thin = (Style::new(color, 1.2, Dash::Dashed), thin);
        let layers = parts::branches([thin, (Style::new(color, 2.6, Dash::Solid), thick)], name);
        panel.layers.extend(layers);
    }
    panel
}
