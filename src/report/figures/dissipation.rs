//! What the absorber takes in every regime, over the oscillator's amplitude, and the response that follows.

use std::f64::consts::SQRT_2;

use serde_json::{Value, json};

use crate::dissipation::SteadyState;
use crate::motions::Motion;
use crate::quantity::catalogue as of;
use crate::regimes::Regime;
use crate::report::chart::Chart;
use crate::report::figure::{
    Color, Dash, Figure, Layer, Layout, Marker, Panel, Role, Shape, Style,
};
use crate::study::plots::dissipation::{AverageSource, Look, Looks};
use crate::study::plots::{Dissipation, Line};

use super::DrawnCase;
use super::regimes::mark;

/// Both components of the force beside the frequency response.
pub(super) fn figure(scene: &DrawnCase, data: &Dissipation) -> Figure {
    let [_, top] = data.averages.range;
    let kinds = [&of::RESISTANCE, &of::REACTANCE];
    let forces = [0, 1].map(|k| {
        let looks = &data.forces[k];
        let kinds = [&of::OSCILLATOR_AMPLITUDE_RATIO, kinds[k]];
        let chart = scene.chart(kinds, [[0.0, top], range(looks)]);
        let mut panel = chart.panel();
        let error = Style::new(Color::Light, 1.0, Dash::Solid);
        panel = panel.with(Layer::curve(error, data.errors[k].clone()));
        panel.layers.extend(layers(looks, k == 0));
        let place = |state: &SteadyState| {
            let branch = &data.averages.curve.branches[state.branch];
            branch.forces(state.amplitude).map(|(forces, _)| [state.amplitude, forces[k]])
        };
        panel.layers.extend(marks(scene, data, &chart, &place));
        panel
    });
    let cells = [[0, 0, 1, 1], [0, 1, 1, 1], [1, 0, 1, 2]];
    let figure = scene
        .figure("dissipation", "captions/dissipation", facts(scene, data))
        .with_size(860, 560)
        .with_layout(Layout::cells(&[1.0, 1.0], &[1.0, 1.0], &cells));
    forces.into_iter().chain([response(scene, data)]).fold(figure, Figure::with_panel)
}

/// Amplitudes over the frequency, with those of this case and of its simulated motions.
fn response(scene: &DrawnCase, data: &Dissipation) -> Panel {
    let [_, most] = data.averages.range;
    let seen = scene.study.motions.iter().map(|found| (found, amplitude(found)));
    let seen: Vec<_> = seen.filter(|(_, amplitude)| *amplitude < most).collect();
    let held = data.response.values().flatten().map(|at| at[1]);
    let highest = held.chain(seen.iter().map(|(_, at)| *at)).filter(|value| value.is_finite());
    let cycle = data.averages.cycle.map(|cycle| cycle.amplitudes);
    let highest = highest.chain(cycle.map(|[_, largest]| largest));
    let top = 1.08 * highest.fold(0.1, f64::max);
    let kinds = [&of::EXCITATION_FREQUENCY, &of::OSCILLATOR_AMPLITUDE_RATIO];
    let chart = scene.chart(kinds, [data.window, [0.0, top]]);
    let ratio = scene.system().frequency_ratio();
    let mut panel = chart.panel().with_heading("response: unstable parts dashed");
    panel = panel.with(Layer::vertical(ratio, Role::Guide));
    panel.layers.extend(layers(&data.response, false));
    panel.layers.extend(marks(scene, data, &chart, &|state| Some([ratio, state.amplitude])));
    if let Some(ends) = cycle {
        let style = Style::new(mark(Regime::StronglyModulated).1, 5.0, Dash::Solid);
        let bar = Layer::curve(style, ends.map(|amplitude| [ratio, amplitude]).into());
        panel = panel.with(bar.labelled("modulated cycle"));
    }
    let seen = seen.into_iter().map(|(found, amplitude)| {
        scene.mark(&chart, [ratio, amplitude], &format!("simulated, {}", found.regime().words()))
    });
    let cross = Marker::filled(Shape::Cross).sized(8.0);
    panel.with(Layer::marked(cross, Role::Simulation.color(), seen).labelled("simulated"))
}

/// That of a sine with the same root mean square.
fn amplitude(found: &Motion) -> f64 {
    SQRT_2 * found.facts().rms.value
}

/// From below all values to above them, zero included.
fn range(looks: &Looks) -> [f64; 2] {
    let values = || looks.values().flatten().map(|at| at[1]).filter(|value| value.is_finite());
    let (low, high) = (values().fold(0.0, f64::min), values().fold(0.0, f64::max));
    [1.1 * low, (1.1 * high).max(-0.05 * low).max(0.1)]
}

/// Lines of what repeats, thick where it is a closed form, and points of what does not; thin and dashed, or hollow,
/// where it is unstable.
fn layers(looks: &Looks, named: bool) -> Vec<Layer> {
    let layer = |look: &Look, line: &Line| {
        let (marker, color) = mark(look.regime());
        let dash = if look.stable { Dash::Solid } else { Dash::Dashed };
        let width = match look.known {
            _ if !look.stable => 1.0,
            AverageSource::ClosedForm => 3.4,
            _ => 1.8,
        };
        if look.known != AverageSource::Scattered {
            return Layer::curve(Style::new(color, width, dash), line.clone());
        }
        let points = line.iter().copied().filter(|at| at[1].is_finite());
        let marker = Marker { filled: look.stable, ..marker.sized(3.2) };
        Layer::marked(marker, color, points)
    };
    // The longest line of a regime has its name.
    let longest = |regime: Regime| {
        let alike = looks.iter().filter(|(look, _)| look.regime() == regime);
        alike.max_by_key(|(_, line)| line.len()).map(|(look, _)| look)
    };
    let named = |(look, line): (&Look, &Line)| {
        let (regime, layer) = (look.regime(), layer(look, line));
        let named = named && longest(regime) == Some(look);
        if named { layer.labelled(regime.short()) } else { layer }
    };
    looks.iter().map(named).collect()
}

/// The steady amplitudes of the case: stable ones filled, others hollow.
fn marks(
    scene: &DrawnCase,
    data: &Dissipation,
    chart: &Chart,
    place: &dyn Fn(&SteadyState) -> Option<[f64; 2]>,
) -> [Layer; 2] {
    [true, false].map(|stable| {
        let chosen = data.averages.states.iter().filter(|state| state.stable == stable);
        let marks = chosen.filter_map(|state| {
            let is = if stable { "stable" } else { "unstable" };
            let what = format!("{is} amplitude of the averaged flow, {}", state.regime.words());
            Some(scene.mark(chart, place(state)?, &what))
        });
        let marker = Marker { filled: stable, ..Marker::hollow(Shape::Circle).sized(8.0) };
        Layer::marked(marker, Color::Black, marks)
    })
}

/// What a designer remembers: how much of the reduced forcing the absorber takes, over which amplitudes.
fn facts(scene: &DrawnCase, data: &Dissipation) -> Value {
    let averages = &data.averages;
    let fold = scene.study.analysis.manifold.fold.oscillator_amplitude;
    let [least, last] = averages.range;
    let from = fold.max(least);
    let moving = averages.states.iter().filter(|state| state.regime != Regime::AtRest);
    let stable = moving.filter(|state| state.stable);
    let stable: Vec<Value> =
        stable.map(|at| json!({ "amplitude": at.amplitude, "regime": at.regime })).collect();
    json!({
        "from": from,
        "to": last,
        "taken": averages.curve.resistance_range([from, last]),
        "gamma": scene.system().forcing_per_clearance(),
        "depends_on_start": averages.curve.depends_on_start,
        "restitution": averages.curve.restitution,
        "stable": stable,
        "cycle": averages.cycle,
    })
}
