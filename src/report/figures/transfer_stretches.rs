//! Three short stretches of a modulated motion: decrease, weak impacts, few impacts (Figs. 12d to
//! 12f).

use crate::report::figure::{Axis, Figure, Layer, Layout, MarkedPoint, Panel, Role};
use crate::report::numbers::{signed, significant};
use crate::simulation::TracePoint;
use crate::study::StudyError;
use crate::study::stretches::{Periods, SHORTEST_CAPTURE, Stretch, impulse};

use super::Scene;
use super::transfer::{PERIODS, Window, excitation, excitation_name};

/// Periods of a short stretch.
const SHORT: usize = 5;

/// A short stretch and what it shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Shown {
    stretch: Stretch,
    /// Last peak over the first one, less 1.
    pub change: f64,
    /// Periods.
    pub periods: usize,
    /// Impacts in them.
    pub impacts: usize,
    /// Mean impulse of these in displayed units; 0 without impacts.
    pub impulse: f64,
}

/// The three stretches, as far as the motion has them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Three {
    /// (d) captured, and yet the amplitude grows.
    pub weak: Option<Shown>,
    /// (e) captured, and the amplitude falls most.
    pub falls: Option<Shown>,
    /// (f) fewest impacts, and the amplitude grows.
    pub sparse: Option<Shown>,
    /// Periods that were searched.
    pub searched: u64,
}

impl Three {
    fn of(scene: &Scene, window: &Window) -> Self {
        let all = Stretch { first: 0, periods: window.periods.count() };
        // The window that is shown as a whole, or else the whole motion that was searched.
        let pick = |choose: &dyn Fn(Stretch) -> Option<Stretch>| {
            let stretch = choose(window.window).or_else(|| choose(all))?;
            Some(Shown::of(scene, window, stretch))
        };
        Self {
            weak: pick(&|outer| weak(&window.periods, outer)),
            falls: pick(&|outer| window.periods.decrease(outer, SHORT)),
            sparse: pick(&|outer| window.periods.sparse(outer, SHORT)),
            searched: PERIODS,
        }
    }
}

/// The stretches of a case's first motion; none where it cannot be shown.
///
/// # Errors
/// As the simulation.
pub(crate) fn three(scene: &Scene) -> Result<Option<Three>, StudyError> {
    Ok(Window::of(scene)?.map(|window| Three::of(scene, &window)))
}

/// The longest stretch, up to the usual one, that grows although captured.
fn weak(periods: &Periods, outer: Stretch) -> Option<Stretch> {
    (SHORTEST_CAPTURE..=SHORT).rev().find_map(|length| periods.weak(outer, length))
}

impl Shown {
    fn of(scene: &Scene, window: &Window, stretch: Stretch) -> Self {
        let eps = scene.study.analysis.system.mass_ratio();
        let inside = window.trace.impacts.iter().filter(|(at, _)| stretch.holds(*at));
        let strengths: Vec<f64> =
            inside.map(|(_, impact)| scene.units.impulse(impulse(eps, impact))).collect();
        Self {
            stretch,
            change: window.periods.growth(stretch) - 1.0,
            periods: stretch.periods,
            impacts: strengths.len(),
            impulse: strengths.iter().sum::<f64>() / strengths.len().max(1) as f64,
        }
    }

    /// What it shows in words.
    fn words(&self, unit: &str) -> String {
        let Self { periods, impacts, .. } = self;
        let each = match impacts {
            0 => String::new(),
            _ => format!(" of {} {unit}", significant(self.impulse, 3)),
        };
        let change = signed(100.0 * self.change, 0);
        format!("{impacts} impacts{each} in {periods} periods, peak {change} %")
    }
}

pub(super) fn figure(scene: &Scene) -> Result<Option<Figure>, StudyError> {
    let Some(window) = Window::of(scene)? else { return Ok(None) };
    let three = Three::of(scene, &window);
    let mut figure = Figure::new("transfer-stretches", "Short stretches of the transfer")
        .with_layout(Layout::Column);
    let mut told = Vec::new();
    for (name, shown) in [
        ("d: captured, yet it grows", three.weak),
        ("e: captured, it falls", three.falls),
        ("f: few impacts, it grows", three.sparse),
    ] {
        let Some(shown) = shown else { continue };
        let words = shown.words(scene.units.impulse_unit());
        told.push(format!("{name}, {words}"));
        let panel = panel(scene, &window, shown.stretch);
        figure = figure.with_panel(panel.with_heading(format!("{name} ({words})")));
    }
    if figure.panels.is_empty() {
        return Ok(None);
    }
    let missing = match three.weak {
        Some(_) => String::new(),
        None => format!(
            " There is no stretch d: in {PERIODS} periods the peak never grows over {SHORTEST_CAPTURE} captured ones."
        ),
    };
    let caption = format!("{}.{missing}", told.join("; "));
    let alt = format!(
        "Displacement of oscillator and base over up to {SHORT} excitation periods, with the impacts marked. {caption}"
    );
    let height = 40 + 210 * figure.panels.len() as u32;
    Ok(Some(figure.with_size(720, height).with_words(caption, alt)))
}

/// Displacement over one stretch.
fn panel(scene: &Scene, window: &Window, stretch: Stretch) -> Panel {
    let system = &scene.study.analysis.system;
    let units = &scene.units;
    // A time axis of its own would hide where in the window the stretch lies.
    let time = |periods: f64| units.time(system, periods - window.window.first as f64);
    let inside = |value: &dyn Fn(&TracePoint) -> f64| -> Vec<[f64; 2]> {
        window.points(stretch).map(|point| [time(point.periods), value(point)]).collect()
    };
    let x = inside(&|point| units.length(point.state.x));
    let base = inside(&|point| units.length(excitation(system, point.periods)));
    let marks =
        window.trace.impacts.iter().filter(|(at, _)| stretch.holds(*at)).map(|(at, impact)| {
            let strength = units.impulse(impulse(system.mass_ratio(), impact));
            MarkedPoint::new(time(*at), units.length(impact.x)).with_tooltip(format!(
                "impact of {} {}",
                significant(strength, 3),
                units.impulse_unit()
            ))
        });
    let (from, to) = (time(stretch.first as f64), time(stretch.end() as f64));
    let axis = Axis::linear(units.time_axis()).with_range(from, to);
    Panel::new(axis, Axis::linear(units.length_axis("x")))
        .with(Layer::curve(Role::Forcing, base).labelled(excitation_name(system)))
        .with(Layer::curve(Role::Simulation, x).labelled("oscillator"))
        .with(Layer::points(Role::Impact, marks).labelled("impacts"))
}
