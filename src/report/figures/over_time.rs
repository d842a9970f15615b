//! Motions over time (Figs. 4 and 12).

use std::f64::consts::TAU;

use serde_json::{Value, json};

use crate::quantity::{Kind, catalogue as of};
use crate::regimes::Amplitudes;
use crate::report::chart::FITTED;
use crate::report::figure::{
    Color, Dash, Figure, Fill, Hatch, Layer, Layout, MarkedPoint, Marker, Panel, Role, Style,
};
use crate::simulation::{Impact, Trace, TracePoint};
use crate::study::plots::traces::Part;
use crate::study::plots::{MotionTrace, Transfer, first_drawn};
use crate::study::stretches::{TraceStretch, impulse};
use crate::system::{Excitation, State, System};

use super::DrawnCase;
use super::parts;

/// Up to so many impacts have a tooltip.
const TOOLTIPS: usize = 40;

/// A quantity over time between two periods; the axis counts from `start`.
struct TimeSeries<'a> {
    trace: &'a Trace,
    /// Still empty.
    panel: Panel,
    window: [f64; 2],
    start: f64,
}

impl<'a> TimeSeries<'a> {
    fn new(
        scene: &DrawnCase,
        trace: &'a Trace,
        (kind, range): (&'static Kind, [f64; 2]),
        window: [f64; 2],
        start: f64,
    ) -> Self {
        let time = scene.axis(&of::TIME, window.map(|at| at - start));
        Self { trace, panel: Panel::new(time, scene.axis(kind, range)), window, start }
    }

    /// A line of what `value` says of each sample.
    fn curve(&self, role: Role, value: &dyn Fn(&TracePoint) -> f64) -> Layer {
        let [first, last] = self.window;
        let inside = self.trace.points.iter();
        let inside = inside.filter(|point| (first..=last).contains(&point.periods));
        let points = inside.map(|point| [point.periods - self.start, value(point)]);
        Layer::curve(role, points.collect())
    }

    fn impacts(&self) -> impl Iterator<Item = (f64, &'a Impact)> {
        let ([first, last], start) = (self.window, self.start);
        let inside = self.trace.impacts.iter().filter(move |(at, _)| (first..=last).contains(at));
        inside.map(move |(at, impact)| (*at - start, impact))
    }

    /// Impacts where `value` says, with their impulse as tooltip if there are few.
    fn marks(&self, scene: &DrawnCase, value: &dyn Fn(f64, &Impact) -> f64) -> Layer {
        let few = self.impacts().count() <= TOOLTIPS;
        let marks = self.impacts().map(|(time, impact)| {
            let strength = impulse(scene.system().mass_ratio(), impact);
            let tip = scene.tip("impact", &[(&of::TIME, time), (&of::IMPULSE, strength)]);
            let mark = MarkedPoint::new(time, value(time + self.start, impact));
            MarkedPoint { tooltip: few.then_some(tip), ..mark }
        });
        Layer::points(Role::Impact, marks)
    }
}

/// A motion: oscillator and relative displacement over time, and both amplitudes on the manifold.
pub(super) fn motion(scene: &DrawnCase, data: &MotionTrace) -> Figure {
    let window = [0.0, data.trace.points.last().map_or(1.0, |point| point.periods)];
    let series = |kind, range| TimeSeries::new(scene, &data.trace, (kind, range), window, 0.0);
    let top = series(&of::DISPLACEMENT, FITTED);
    let low = series(&of::RELATIVE_DISPLACEMENT, [-1.35, 1.35]);
    let first = top.panel.clone().with(top.curve(Role::Simulation, &|point| point.state.x));
    let gap = low.curve(Role::Simulation, &|point| point.state.relative_displacement());
    let second = low
        .panel
        .clone()
        .with(Layer::horizontal(1.0, Role::Guide).labelled("walls at ±b"))
        .with(Layer::horizontal(-1.0, Role::Guide))
        .with(gap)
        .with(low.marks(scene, &|_, impact| impact.side.sign()).labelled("impacts"));
    let number = data.index + 1;
    scene
        .figure(&format!("motion-{number}"), "captions/motion", motion_facts(scene, data))
        .with_size(860, 420)
        .with_layout(Layout::cells(
            &[1.15, 1.0],
            &[1.0, 1.0],
            &[[0, 0, 1, 1], [0, 1, 1, 1], [1, 0, 1, 2]],
        ))
        .with_panel(first)
        .with_panel(second)
        .with_panel(projection(scene, data))
}

fn projection(scene: &DrawnCase, data: &MotionTrace) -> Panel {
    let path = data.projection.line(None);
    let [farthest, highest] =
        [0, 1].map(|index| path.iter().map(|at| at[index]).fold(0.0, f64::max));
    let manifold = &scene.study.analysis.manifold;
    let last = (1.1 * farthest).max(2.2);
    let top = (1.15 * highest).max(1.3 * manifold.symmetry_breaking.oscillator_amplitude);
    let chart = parts::amplitudes(scene, [0.0, last], [0.0, top]);
    let mut panel = chart.panel().with_heading("on the manifold");
    panel.layers.extend(parts::manifold_layers(manifold, last));
    panel = panel.with(Layer::curve(Role::Simulation, path).labelled("motion"));
    // A motion that hardly moves in this plane would be lost without marks.
    let landed = &data.projection.landed;
    if landed.len() > TOOLTIPS {
        return panel;
    }
    let marks = landed.iter().map(|(_, at)| *at);
    let marker = Role::Simulation.marker().sized(9.0);
    panel.with(Layer::marked(marker, Role::Simulation.color(), marks))
}

/// What the motion's own facts do not say.
fn motion_facts(scene: &DrawnCase, data: &MotionTrace) -> Value {
    let evidence = &scene.study.measured[data.index].classification.evidence;
    json!({
        "index": data.index,
        "periods": data.periods,
        "repeats": evidence.periodicity.is_some(),
        "asymmetry": evidence.asymmetry,
    })
}

/// Periods of captures shown: a dozen captures, each still wide enough to be seen.
const CAPTURES: usize = 150;

/// The amplitudes `C` and `E` of equation (17) period by period (section 4.2 of Li, Seguy, Berlioz 2016).
pub(super) fn captures(scene: &DrawnCase) -> Option<Figure> {
    let (_, found) = first_drawn(scene.study)?;
    let all = &found.amplitudes;
    let shown = &all[all.len().saturating_sub(CAPTURES)..];
    if shown.iter().all(|one| one.captured) || shown.iter().all(|one| !one.captured) {
        return None;
    }
    let absorber =
        capture_panel(scene, shown, &of::HARMONIC_AMPLITUDE, |one| one.absorber_amplitude);
    let oscillator =
        capture_panel(scene, shown, &of::OSCILLATOR_AMPLITUDE, |one| one.oscillator_amplitude);
    let evidence = &found.classification.evidence;
    let (captures, amplitude) = (&evidence.captures, &evidence.absorber_amplitude);
    let facts = json!({
        "captures": captures,
        "amplitude": amplitude,
    });
    Some(
        scene
            .figure("captures", "captions/captures", facts)
            .with_size(860, 520)
            .with_layout(Layout::rows(&[1.0; 2]))
            .with_panel(absorber)
            .with_panel(oscillator),
    )
}

/// One amplitude over time, the captures shaded. A period's amplitudes belong to its middle.
fn capture_panel(
    scene: &DrawnCase,
    shown: &[Amplitudes],
    kind: &'static Kind,
    value: fn(&Amplitudes) -> f64,
) -> Panel {
    let line: Vec<[f64; 2]> =
        shown.iter().enumerate().map(|(k, one)| [k as f64 + 0.5, value(one)]).collect();
    let top = 1.1 * line.iter().map(|at| at[1]).fold(0.0, f64::max);
    let time = scene.axis(&of::TIME, [0.0, shown.len() as f64]);
    let mut panel = Panel::new(time, scene.axis(kind, [0.0, top]));
    let mut first = 0;
    for run in shown.chunk_by(|a, b| a.captured == b.captured) {
        let ends = [first, first + run.len()].map(|period| period as f64);
        if run[0].captured {
            let fill = Fill { color: Color::BluishGreen, opacity: 0.15, hatch: Hatch::None };
            let side = |y: f64| ends.map(|x| [x, y]);
            panel.layers.push(Layer::between(&side(0.0), &side(top), fill));
        }
        first += run.len();
    }
    panel = panel.with(Layer::curve(Role::Simulation, line.clone()));
    let named = kind.id == of::HARMONIC_AMPLITUDE.id;
    for (captured, name) in [(true, "in a capture"), (false, "between captures")] {
        let chosen = line.iter().zip(shown).filter(|(_, one)| one.captured == captured);
        let marker = Marker { filled: captured, ..Role::Simulation.marker().sized(3.6) };
        let layer = Layer::marked(marker, Role::Simulation.color(), chosen.map(|(at, _)| *at));
        panel = panel.with(if named { layer.labelled(name) } else { layer });
    }
    panel
}

/// Acceleration of the oscillator between impacts, over `omega0^2 b`, by (1).
fn acceleration(system: &System, periods: f64, state: &State) -> f64 {
    let (sine, cosine) = system.excitation_amplitudes();
    let (sin, cos) = libm::sincos(TAU * periods.fract());
    let damping = system.mass_ratio() * system.damping();
    sine * sin + cosine * cos - damping * state.x_velocity - state.x
}

/// Displacement of the base over the clearance, `F sin(Omega tau)`; for a force the displacement that it would
/// give at rest.
fn excitation(scene: &DrawnCase, series: &TimeSeries) -> Layer {
    let system = scene.system();
    let amplitude = system.mass_ratio() * system.forcing_per_clearance();
    let name = match system.excitation() {
        Excitation::BaseDisplacement => "base",
        Excitation::Force => "force over stiffness",
    };
    let value = |point: &TracePoint| amplitude * libm::sin(TAU * point.periods.fract());
    series.curve(Role::Forcing, &value).labelled(name)
}

/// Displacement, acceleration and every impact's strength over some seconds.
pub(super) fn transfer(scene: &DrawnCase, data: &Transfer) -> Figure {
    let system = scene.system();
    let window = [data.window.first, data.window.end()].map(|period| period as f64);
    let series =
        |kind, range| TimeSeries::new(scene, &data.trace, (kind, range), window, window[0]);
    let top = series(&of::DISPLACEMENT, FITTED);
    let first = top
        .panel
        .clone()
        .with(excitation(scene, &top))
        .with(top.curve(Role::Simulation, &|point| point.state.x).labelled("oscillator"));
    // In the middle of its jump.
    let struck = |periods: f64, impact: &Impact| {
        let x_velocity = 0.5 * (impact.x_velocity_before + impact.x_velocity_after);
        acceleration(system, periods, &State { x: impact.x, x_velocity, y: 0.0, y_velocity: 0.0 })
    };
    let middle = series(&of::ACCELERATION, FITTED);
    let smooth = |point: &TracePoint| acceleration(system, point.periods, &point.state);
    let second = middle
        .panel
        .clone()
        .with(middle.curve(Role::Simulation, &smooth))
        .with(middle.marks(scene, &struck).labelled("impacts"));
    let strength = |impact: &Impact| impulse(system.mass_ratio(), impact);
    let largest = top.impacts().map(|(_, impact)| strength(impact)).fold(0.0, f64::max);
    let low = series(&of::IMPULSE, [0.0, 1.1 * largest.max(1e-12)]);
    let stems: Vec<[f64; 2]> = low
        .impacts()
        .flat_map(|(time, impact)| [[time, 0.0], [time, strength(impact)], [f64::NAN; 2]])
        .collect();
    let style = Style::new(Color::Vermillion, 1.6, Dash::Solid);
    let third = low.panel.clone().with(Layer::curve(style, stems));
    scene
        .figure("transfer", "captions/transfer", transfer_facts(scene, data, largest))
        .with_size(860, 620)
        .with_layout(Layout::rows(&[1.0; 3]))
        .with_panel(first)
        .with_panel(second)
        .with_panel(third)
}

fn transfer_facts(scene: &DrawnCase, data: &Transfer, largest: f64) -> Value {
    let window = data.window;
    let captures = data.periods.captures();
    let whole =
        |capture: &&TraceStretch| window.first <= capture.first && capture.end() <= window.end();
    let inside: Vec<&TraceStretch> = captures.iter().filter(whole).collect();
    let captured: usize = inside.iter().map(|capture| capture.periods).sum();
    let peaks = &data.periods.peaks[window.first..window.end()];
    json!({
        "low": peaks.iter().copied().fold(f64::INFINITY, f64::min),
        "high": peaks.iter().copied().fold(0.0, f64::max),
        "captures": inside.len(),
        "share": captured as f64 / window.periods as f64,
        "periods": window.periods,
        "largest": scene.si(&of::IMPULSE, largest),
    })
}

/// Three short stretches of it: weak impacts, decrease, few impacts (Figs. 12d to 12f).
pub(super) fn stretches(scene: &DrawnCase, data: &Transfer) -> Option<Figure> {
    let names = ["d: captured, yet it grows", "e: captured, it falls", "f: few impacts, it grows"];
    let shown = names.into_iter().zip(data.parts).filter_map(|(name, part)| Some((name, part?)));
    let shown: Vec<(&str, Part)> = shown.collect();
    let facts = json!({
        "parts": shown,
        "impulse": scene.si(&of::IMPULSE, 1.0),
        "weak": data.parts[0].is_some(),
        "searched": Transfer::PERIODS,
        "longest": Transfer::SHORT,
    });
    let figure = scene
        .figure("transfer-stretches", "captions/transfer-stretches", facts)
        .with_size(720, 40 + 210 * shown.len() as u32)
        .with_layout(Layout::rows(&vec![1.0; shown.len()]));
    let panels = shown.iter().map(|(name, part)| stretch_panel(scene, data, name, part));
    let figure = panels.fold(figure, Figure::with_panel);
    (!shown.is_empty()).then_some(figure)
}

/// Displacement over one stretch. A time axis of its own would hide where in the window it lies.
fn stretch_panel(scene: &DrawnCase, data: &Transfer, name: &str, part: &Part) -> Panel {
    let window = [part.stretch.first, part.stretch.end()].map(|period| period as f64);
    let kind = (&of::DISPLACEMENT, FITTED);
    let series = TimeSeries::new(scene, &data.trace, kind, window, data.window.first as f64);
    series
        .panel
        .clone()
        .with_heading(name)
        .with(excitation(scene, &series))
        .with(series.curve(Role::Simulation, &|point| point.state.x).labelled("oscillator"))
        .with(series.marks(scene, &|_, impact| impact.x).labelled("impacts"))
}
