//! The amplitudes `C` and `E` of equation (17) period by period, with the captures in 1:1 resonance:
//! section 4.2 of Li, Seguy, Berlioz 2016 on a simulated motion.

use crate::regimes::modulation::Amplitudes;
use crate::report::figure::{Axis, Color, Figure, Fill, Hatch, Layer, Layout, Marker, Panel, Role};
use crate::report::numbers::{percent, significant};

use super::Scene;

/// Periods shown: a dozen captures, each still wide enough to be seen.
const PERIODS: usize = 150;

pub(super) fn figure(scene: &Scene) -> Option<Figure> {
    let found = scene.first_drawn()?;
    let all = &found.attractor.amplitudes;
    let shown = &all[all.len().saturating_sub(PERIODS)..];
    let comes_and_goes =
        shown.iter().any(|one| one.captured) && shown.iter().any(|one| !one.captured);
    if !comes_and_goes {
        return None;
    }
    let absorber = panel(scene, shown, "absorber amplitude E", |one| one.absorber_amplitude, true);
    let oscillator =
        panel(scene, shown, "oscillator amplitude C", |one| one.oscillator_amplitude, false);
    let (caption, alt) = words(scene)?;
    Some(
        Figure::new("captures", "Captures in 1:1 resonance, and what the amplitudes do in them")
            .with_size(860, 520)
            .with_layout(Layout::Column)
            .with_panel(absorber)
            .with_panel(oscillator)
            .with_words(caption, alt),
    )
}

/// One amplitude over time; `named` says whether its marks are.
fn panel(
    scene: &Scene,
    shown: &[Amplitudes],
    name: &str,
    value: fn(&Amplitudes) -> f64,
    named: bool,
) -> Panel {
    let units = &scene.units;
    let system = &scene.study.analysis.system;
    // A period's amplitudes belong to its middle.
    let time = |period: usize| units.time(system, period as f64 + 0.5);
    let edge = |period: usize| units.time(system, period as f64);
    let line: Vec<[f64; 2]> =
        shown.iter().enumerate().map(|(k, one)| [time(k), units.length(value(one))]).collect();
    let top = 1.1 * line.iter().map(|at| at[1]).fold(0.0, f64::max);
    let mut layers = Vec::new();
    let mut first = 0;
    for run in shown.chunk_by(|a, b| a.captured == b.captured) {
        let end = first + run.len();
        if run[0].captured {
            let fill = Fill { color: Color::BluishGreen, opacity: 0.15, hatch: Hatch::None };
            let low = [[edge(first), 0.0], [edge(end), 0.0]];
            layers.push(Layer::between(&low, &low.map(|[x, _]| [x, top]), fill));
        }
        first = end;
    }
    layers.push(Layer::curve(Role::Simulation, line.clone()));
    let marks = |captured: bool| {
        let chosen = line.iter().zip(shown).filter(move |(_, one)| one.captured == captured);
        chosen.map(|(at, _)| *at).collect::<Vec<_>>()
    };
    let marker = Role::Simulation.marker().sized(3.6);
    let hollow = Marker { filled: false, ..marker };
    for (marker, captured, name) in
        [(marker, true, "in a capture"), (hollow, false, "between captures")]
    {
        let layer = Layer::marked(marker, Role::Simulation.color(), marks(captured));
        layers.push(if named { layer.labelled(name) } else { layer });
    }
    let x = Axis::linear(units.time_axis()).with_range(0.0, edge(shown.len()));
    Panel { layers, ..Panel::new(x, Axis::linear(units.length_axis(name)).with_range(0.0, top)) }
}

fn words(scene: &Scene) -> Option<(String, String)> {
    let found = scene.first_drawn()?;
    let evidence = &found.attractor.classification.evidence;
    let (captures, amplitude) = (&evidence.captures, &evidence.absorber_amplitude);
    let units = &scene.units;
    let mean = |value: Option<f64>| value.map(|value| units.length_text(value));
    let means = match (mean(amplitude.in_captures), mean(amplitude.between)) {
        (Some(inside), Some(between)) => {
            format!("E averages {inside} in captures and {between} between them")
        }
        _ => "E has no mean on one side of the captures".to_owned(),
    };
    let growth = match amplitude.correlation_with_growth {
        Some(value) => {
            let number = significant(value, 2);
            let says = if value < 0.0 {
                "a large E goes with a decreasing vibration, as section 4.2 of the paper has it"
            } else {
                "a large E does not go with a decreasing vibration here, other than section 4.2 of \
                 the paper has it"
            };
            format!("its correlation with the growth of C is {number}: {says}")
        }
        None => "C hardly changes".to_owned(),
    };
    let caption = format!(
        "The motion is captured {} of the time, {} periods on average and up to {}; {means}; {growth}.",
        percent(captures.share),
        significant(captures.mean, 2),
        captures.longest
    );
    let alt = format!(
        "Two panels over time: amplitude E of the absorber and C of the oscillator in every period, the captures shaded. {caption}"
    );
    Some((caption, alt))
}
