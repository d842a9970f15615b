//! Displacement, acceleration and every impact's strength over some seconds (Fig. 12).

use std::f64::consts::TAU;

use crate::report::figure::{Axis, Color, Dash, Figure, Layer, Layout, Panel, Role, Style};
use crate::report::numbers::{percent, significant};
use crate::simulation::{Trace, TracePoint};
use crate::study::stretches::{Periods, Stretch, impulse};
use crate::study::{StudyError, scenes};
use crate::system::{Excitation, System};

use super::Scene;

/// Periods searched for a typical window.
pub(super) const PERIODS: u64 = 400;
/// Samples per period: enough for smooth displacements.
const DENSITY: f64 = 24.0;
/// Seconds shown, as in the paper; a reduced case shows so many periods.
const SECONDS: f64 = 5.0;
const REDUCED: usize = 42;

/// A motion, the window that is shown of it, and what its periods look like.
pub(super) struct Window {
    pub trace: Trace,
    pub periods: Periods,
    pub window: Stretch,
}

impl Window {
    pub fn of(scene: &Scene) -> Result<Option<Self>, StudyError> {
        let Some(found) = scene.first_drawn() else { return Ok(None) };
        let system = &scene.study.analysis.system;
        let trace = scenes::trace(system, found.attractor.state, PERIODS, DENSITY)?;
        if trace.impacts.len() as u64 > 8 * PERIODS {
            // Nobody could tell so many impacts apart.
            return Ok(None);
        }
        let periods = Periods::of(&trace);
        let second = scene.units.time(system, 1.0);
        let physical = scene.units.time_axis().ends_with("(s)");
        let length = if physical { ((SECONDS / second) as usize).clamp(1, 200) } else { REDUCED };
        let window = periods.typical(length);
        Ok(Some(Self { trace, periods, window }))
    }

    pub fn points(&self, stretch: Stretch) -> impl Iterator<Item = &TracePoint> {
        self.trace.points.iter().filter(move |point| stretch.holds(point.periods))
    }
}

/// Acceleration of the oscillator between impacts, over `omega0^2 b`, by (1).
fn acceleration(system: &System, point: &TracePoint) -> f64 {
    let (sine, cosine) = system.excitation_amplitudes();
    let (sin, cos) = libm::sincos(TAU * point.periods.fract());
    let damping = system.mass_ratio() * system.damping();
    sine * sin + cosine * cos - damping * point.state.x_velocity - point.state.x
}

/// Displacement of the base over the clearance, `F sin(Omega tau)`; for a force the displacement
/// that it would give at rest.
pub(super) fn excitation(system: &System, periods: f64) -> f64 {
    system.mass_ratio() * system.forcing_per_clearance() * libm::sin(TAU * periods.fract())
}

pub(super) fn excitation_name(system: &System) -> &'static str {
    match system.excitation() {
        Excitation::BaseDisplacement => "base",
        Excitation::Force => "force over stiffness",
    }
}

/// The window as a whole.
pub(super) fn figure(scene: &Scene) -> Result<Option<Figure>, StudyError> {
    let Some(shown) = Window::of(scene)? else { return Ok(None) };
    let system = &scene.study.analysis.system;
    let units = &scene.units;
    let start = shown.window.first as f64;
    let time = |periods: f64| units.time(system, periods - start);
    let end = time(shown.window.end() as f64);
    let axis = || Axis::linear(units.time_axis()).with_range(0.0, end);
    let curve = |value: &dyn Fn(&TracePoint) -> f64| -> Vec<[f64; 2]> {
        shown.points(shown.window).map(|point| [time(point.periods), value(point)]).collect()
    };
    let impacts: Vec<_> =
        shown.trace.impacts.iter().filter(|(at, _)| shown.window.holds(*at)).collect();
    let x = curve(&|point| units.length(point.state.x));
    let base = curve(&|point| units.length(excitation(system, point.periods)));
    let top = Panel::new(axis(), Axis::linear(units.length_axis("displacement")))
        .with(Layer::curve(Role::Forcing, base).labelled(excitation_name(system)))
        .with(Layer::curve(Role::Simulation, x).labelled("oscillator"));
    let force = curve(&|point| units.acceleration(acceleration(system, point)));
    let marks = impacts.iter().map(|(at, impact)| {
        let velocity = 0.5 * (impact.x_velocity_before + impact.x_velocity_after);
        let state = crate::system::State {
            x: impact.x,
            x_velocity: velocity,
            y: impact.x - impact.side.sign(),
            y_velocity: 0.0,
        };
        let there = acceleration(system, &TracePoint { periods: *at, state });
        [time(*at), units.acceleration(there)]
    });
    let middle = Panel::new(axis(), Axis::linear(units.acceleration_axis()))
        .with(Layer::curve(Role::Simulation, force))
        .with(Layer::points(Role::Impact, marks).labelled("impacts"));
    let stems = impacts.iter().flat_map(|(at, impact)| {
        let height = units.impulse(impulse(system.mass_ratio(), impact));
        [[time(*at), 0.0], [time(*at), height], [f64::NAN; 2]]
    });
    let style = Style::new(Color::Vermillion, 1.6, Dash::Solid);
    let largest = impacts
        .iter()
        .map(|(_, impact)| units.impulse(impulse(system.mass_ratio(), impact)))
        .fold(0.0, f64::max);
    let impulse_axis = format!("impulse ({})", units.impulse_unit());
    let low =
        Panel::new(axis(), Axis::linear(impulse_axis).with_range(0.0, 1.1 * largest.max(1e-9)))
            .with(Layer::styled(style, stems.collect()));
    let (caption, alt) = words(scene, &shown, largest);
    Ok(Some(
        Figure::new("transfer", "Transfer of energy over some seconds")
            .with_size(860, 620)
            .with_layout(Layout::Column)
            .with_panel(top)
            .with_panel(middle)
            .with_panel(low)
            .with_words(caption, alt),
    ))
}

fn words(scene: &Scene, shown: &Window, largest: f64) -> (String, String) {
    let units = &scene.units;
    let system = &scene.study.analysis.system;
    let window = shown.window;
    let captures = shown.periods.captures();
    let inside =
        |capture: &&Stretch| window.first <= capture.first && capture.end() <= window.end();
    let inside: Vec<&Stretch> = captures.iter().filter(inside).collect();
    let captured: usize = inside.iter().map(|capture| capture.periods).sum();
    let peaks = &shown.periods.peaks[window.first..window.end()];
    let (low, high) = peaks
        .iter()
        .fold((f64::INFINITY, 0.0_f64), |(low, high), peak| (low.min(*peak), high.max(*peak)));
    let caption = format!(
        "At {} the oscillator's peak wanders between {} and {}; {} whole captures in 1:1 resonance take {} of the {} periods shown, \
         and the strongest impact has {} {}.",
        units.place_text(system),
        units.length_text(low),
        units.length_text(high),
        inside.len(),
        percent(captured as f64 / window.periods as f64),
        window.periods,
        significant(largest, 3),
        units.impulse_unit()
    );
    let alt = format!(
        "Three panels over time: displacement of oscillator and base, acceleration of the oscillator with its impacts marked, and the \
         impulse of every impact. {caption}"
    );
    (caption, alt)
}
