//! A motion over time, and projected on the manifold (Figs. 4 and 8).

use crate::regimes::{Attractor, Regime};
use crate::report::figure::{Axis, Figure, Layer, Layout, MarkedPoint, Panel, Role, Rule};
use crate::report::numbers::{percent, significant};
use crate::simulation::Trace;
use crate::study::scenes::{projected, projected_after};
use crate::study::{StudyError, scenes};
use crate::system::System;

use super::Scene;
use super::manifold::branches;

/// Periods shown of a motion that repeats, at least.
const FEW: u64 = 6;
/// Periods shown of a motion that neither repeats nor is modulated much.
const SOME: u64 = 12;
/// The same for one with fewer than two impacts per period, which come irregularly.
const RARE: u64 = 30;
/// Periods shown of a modulated motion: several modulations.
const MANY: u64 = 70;
/// Modulation below this is not what there is to see.
const MODULATED: f64 = 0.1;
/// About so many impacts can be told apart.
const IMPACTS: f64 = 400.0;
/// Up to so many impacts have a tooltip.
const TOOLTIPS: usize = 40;

/// The figure of an attractor; none for rest or for one that could not be followed.
pub(super) fn figure(scene: &Scene, index: usize) -> Result<Option<Figure>, StudyError> {
    let Some(found) = scene.drawn(index) else { return Ok(None) };
    let attractor = &found.attractor;
    let system = &scene.study.analysis.system;
    let periods = shown_periods(attractor);
    let density = if periods > RARE { 24.0 } else { 60.0 };
    let trace = scenes::trace(system, attractor.state, periods, density)?;
    let [top, low] = series(scene, system, &trace);
    let (caption, alt) = words(scene, attractor, periods);
    let number = index + 1;
    let figure = Figure::new(
        format!("motion-{number}"),
        format!("Motion {number}: {}", found.regime().words()),
    )
    .with_size(860, 420)
    .with_layout(Layout::TimeSeriesAndProjection)
    .with_panel(top)
    .with_panel(low)
    .with_panel(projection(scene, system, &trace))
    .with_words(caption, alt);
    Ok(Some(figure))
}

/// So many that the pattern is seen, and no more impacts than can be told apart.
fn shown_periods(attractor: &Attractor) -> u64 {
    let evidence = &attractor.classification.evidence;
    let wanted = match evidence.periodicity {
        Some(repetition) => FEW.max(2 * u64::from(repetition.periods)).min(MANY),
        None if evidence.modulation_depth > MODULATED => MANY,
        None if attractor.classification.regime == Regime::BelowTwo => RARE,
        None => SOME,
    };
    let most = (IMPACTS / evidence.impacts_per_period.max(0.1)).max(1.0);
    wanted.min(most as u64)
}

/// Oscillator and relative displacement over time.
fn series(scene: &Scene, system: &System, trace: &Trace) -> [Panel; 2] {
    let units = &scene.units;
    let time = |periods: f64| units.time(system, periods);
    let end = trace.points.last().map_or(1.0, |point| point.periods);
    let axis = || Axis::linear(units.time_axis()).with_range(0.0, time(end));
    let line = |value: &dyn Fn(usize) -> f64| -> Vec<[f64; 2]> {
        (0..trace.points.len()).map(|k| [time(trace.points[k].periods), value(k)]).collect()
    };
    let x = line(&|k| units.length(trace.points[k].state.x));
    let w = line(&|k| units.length(trace.points[k].state.relative_displacement()));
    let wall = units.length(1.0);
    let many = trace.impacts.len() > TOOLTIPS;
    let impacts = trace.impacts.iter().map(|(periods, impact)| {
        let point = MarkedPoint::new(time(*periods), wall * impact.side.sign());
        if many {
            return point;
        }
        let unit = if units.time_axis().ends_with("(s)") { "s" } else { "T" };
        point.with_tooltip(format!("impact at {} {unit}", significant(time(*periods), 4)))
    });
    let impacts: Vec<MarkedPoint> = impacts.collect();
    let rule = |at| Layer::rule(Rule::Horizontal(at), Role::Guide.style());
    let top = Panel::new(axis(), Axis::linear(units.length_axis("oscillator x")))
        .with(Layer::curve(Role::Simulation, x));
    let low = Panel::new(
        axis(),
        Axis::linear(units.length_axis("gap w = x − y")).with_range(-1.35 * wall, 1.35 * wall),
    )
    .with(rule(wall).labelled("walls at ±b"))
    .with(rule(-wall))
    .with(Layer::curve(Role::Simulation, w))
    .with(Layer::points(Role::Impact, impacts).labelled("impacts"));
    [top, low]
}

/// The motion in the amplitudes of the theory.
fn projection(scene: &Scene, system: &System, trace: &Trace) -> Panel {
    let path: Vec<[f64; 2]> =
        trace.points.iter().map(|point| projected(system, &point.state)).collect();
    let farthest = path.iter().map(|at| at[0]).fold(0.0, f64::max);
    let highest = path.iter().map(|at| at[1]).fold(0.0, f64::max);
    let manifold = &scene.study.analysis.manifold;
    let last = (1.1 * farthest).max(2.2);
    let top = (1.15 * highest).max(1.3 * manifold.symmetry_breaking.oscillator_amplitude);
    let [left, right, stable] = branches(manifold, last);
    // A motion that hardly moves in this plane would be lost without marks.
    let landed = trace.impacts.iter().map(|(_, impact)| projected_after(system, impact));
    let marks = if trace.impacts.len() > TOOLTIPS { Vec::new() } else { landed.collect() };
    Panel::new(
        Axis::linear("absorber amplitude B/b (1)").with_range(0.0, last),
        Axis::linear("oscillator amplitude C/b (1)").with_range(0.0, top),
    )
    .with(left)
    .with(right)
    .with(stable)
    .with(Layer::curve(Role::Simulation, path).labelled("motion"))
    .with(Layer::marked(Role::Simulation.marker().sized(9.0), Role::Simulation.color(), marks))
    .with_heading("on the manifold")
}

fn words(scene: &Scene, attractor: &Attractor, periods: u64) -> (String, String) {
    let evidence = &attractor.classification.evidence;
    let units = &scene.units;
    let peak = units.length_text(attractor.peak);
    let z = significant(evidence.impacts_per_period, 3);
    let caption = match attractor.classification.regime {
        Regime::TwoSymmetric if evidence.periodicity.is_some() => format!(
            "Two impacts per period, half a period apart: the oscillator peaks at {peak} in every period."
        ),
        Regime::TwoAsymmetric if evidence.periodicity.is_some() => format!(
            "Two impacts per period at unequal intervals (they differ by {} of the period); the oscillator peaks at {peak}.",
            percent(evidence.asymmetry)
        ),
        Regime::StronglyModulated => format!(
            "Stretches of 1:1 resonance ({} of the time) alternate with escapes: z = {z} impacts per period on average, \
             and the oscillator's peak, at most {peak}, varies by {}.",
            percent(evidence.captures.share),
            percent(2.0 * evidence.modulation_depth / (1.0 + evidence.modulation_depth))
        ),
        regime => format!(
            "{}{} (z = {z} on average); the oscillator peaks at {peak}.",
            regime.words()[..1].to_uppercase(),
            &regime.words()[1..]
        ),
    };
    let alt = format!(
        "{periods} excitation periods of the oscillator's displacement and of the absorber's displacement between its walls, \
         and the same motion in the plane of the amplitudes. {caption}"
    );
    (caption, alt)
}
