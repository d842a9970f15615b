//! Frequency response beside the manifold, for four forcings per clearance (Fig. 7).

use crate::analysis::FixedPoint;
use crate::analysis::frequency_response::ResponsePoint;
use crate::report::figure::{
    Axis, Color, Dash, Figure, Layer, Layout, Panel, Role, Rule, Scale, Style,
};
use crate::study::StudyError;
use crate::system::{Parameters, System};

use super::Scene;
use super::branches::{Piece, branches_of, joined};
use super::manifold::{branches, describe};
use super::map::window;

/// The responses show so many symmetry-breaking amplitudes, unless the case lies above.
const ABOVE_BREAKING: f64 = 1.6;
/// Beyond this many symmetry-breaking amplitudes a linear axis would hide the stable branch.
const FAR: f64 = 5.0;
/// The other responses are drawn up to this `B/b`.
const OTHERS: f64 = 15.0;
/// Forcings closer than this to the case's would be drawn over it.
const DISTINCT: f64 = 0.18;

pub(super) fn figure(scene: &Scene) -> Result<Option<Figure>, StudyError> {
    let analysis = &scene.study.analysis;
    let (system, manifold) = (&analysis.system, &analysis.manifold);
    let gamma = system.forcing_per_clearance();
    let breaking = manifold.symmetry_breaking;
    let others = others(gamma, analysis.boundaries.symmetry_breaking, analysis.boundaries.hopf);
    if gamma == 0.0 || others.is_empty() {
        return Ok(None);
    }
    let highest =
        analysis.fixed_points.iter().map(|point| point.oscillator_amplitude).fold(0.0, f64::max);
    let top = (1.15 * highest).max(ABOVE_BREAKING * breaking.oscillator_amplitude);
    let log = top > FAR * breaking.oscillator_amplitude;
    let bottom = if log { (0.7 * manifold.fold.oscillator_amplitude).max(1e-5 * top) } else { 0.0 };
    let axis = || {
        let axis = Axis::linear("oscillator amplitude C/b (1)").with_range(bottom, top);
        Axis { scale: if log { Scale::Log } else { Scale::Linear }, ..axis }
    };
    // On the right branch C exceeds B - b, whatever the restitution.
    let last = top + 1.0;
    let [left, right, stable] = branches(manifold, last);
    let fixed = |place: &dyn Fn(&FixedPoint) -> [f64; 2]| {
        super::manifold::markers(&analysis.fixed_points, place)
    };
    let mut first = Panel::new(
        Axis::linear("absorber amplitude B/b (1)").with_range(0.0, last.min(2.0 * top + 1.0)),
        axis(),
    )
    .with(left.labelled("unstable"))
    .with(right)
    .with(stable.labelled("stable"))
    .with_heading("manifold");
    first.layers.extend(fixed(&|p| [p.absorber_amplitude, p.oscillator_amplitude]));

    let units = &scene.units;
    let (from, to) = window(system);
    let x =
        Axis::linear(units.frequency_axis()).with_range(units.frequency(from), units.frequency(to));
    let here =
        Layer::rule(Rule::Vertical(units.frequency(system.frequency_ratio())), Role::Guide.style());
    let mut second = Panel::new(x, axis()).with(here).with_heading("response at four clearances");
    let colors = [Color::Orange, Color::BluishGreen, Color::SkyBlue];
    let mut drawn: Vec<(f64, Color)> = others.into_iter().zip(colors).collect();
    drawn.push((gamma, Color::Black));
    for (at, color) in drawn {
        let emphasis = if color == Color::Black { 1.3 } else { 0.8 };
        let there = with_forcing(system, at);
        let Some(there) = there else { continue };
        // The samples are spread evenly: a curve that matters only below must not be coarse there.
        let reach = if at == gamma { last } else { last.min(OTHERS) };
        let place = |point: &ResponsePoint| {
            [units.frequency(1.0 + there.mass_ratio() * point.detuning), point.oscillator_amplitude]
        };
        let pieces = branches_of(&there, manifold, reach, &place)?;
        let own = if color == Color::Black { ", this case" } else { "" };
        let name = format!("b = {}{own}", units.length_text(gamma / at));
        second.layers.extend(curves(&pieces, color, emphasis, name));
    }
    let ratio = system.frequency_ratio();
    second.layers.extend(fixed(&|p| [units.frequency(ratio), p.oscillator_amplitude]));
    let (caption, alt) = words(scene);
    Ok(Some(
        Figure::new("response", "Frequency response beside the manifold")
            .with_size(860, 420)
            .with_layout(Layout::columns(&[2.0, 3.0]))
            .with_panel(first)
            .with_panel(second)
            .with_words(caption, alt),
    ))
}

/// Three forcings per clearance that show the areas, apart from the case's.
fn others(case: f64, breaking: f64, hopf: f64) -> Vec<f64> {
    let wanted = [1.4 * breaking, (breaking * hopf).sqrt(), 0.75 * hopf];
    let apart = |gamma: f64| {
        let distance = libm::log(gamma / case);
        if distance.abs() > DISTINCT {
            gamma
        } else {
            case * libm::exp(1.5 * DISTINCT.copysign(distance))
        }
    };
    let usable = wanted.into_iter().filter(|gamma| gamma.is_finite() && *gamma > 0.0);
    usable.map(apart).collect()
}

fn with_forcing(system: &System, gamma: f64) -> Option<System> {
    let there = Parameters { forcing_per_clearance: gamma, ..system.parameters() };
    System::new(there).ok()
}

/// One layer for what is stable and one for what is not; the name goes to the stable part.
fn curves(pieces: &[Piece], color: Color, emphasis: f64, name: String) -> Vec<Layer> {
    let [stable, unstable] = [true, false].map(|stable| joined(pieces, stable));
    let style = |role: Role| {
        let style = role.style().colored(color);
        Style { width: style.width * emphasis, ..style }
    };
    let dashed = Style { dash: Dash::Dashed, ..style(Role::Unstable) };
    let mut layers =
        vec![Layer::styled(dashed, unstable), Layer::styled(style(Role::Stable), stable.clone())];
    let named = usize::from(!stable.is_empty());
    layers[named] = layers[named].clone().labelled(name);
    layers
}

fn words(scene: &Scene) -> (String, String) {
    let analysis = &scene.study.analysis;
    let units = &scene.units;
    let gamma = analysis.system.forcing_per_clearance();
    let place = units.place_text(&analysis.system);
    let widest = units.length_text(gamma / analysis.boundaries.hopf);
    let narrowest = units.length_text(gamma / analysis.boundaries.symmetry_breaking);
    let stable = analysis.stable_points().last();
    let case = match stable {
        Some(point) => format!(
            "At {place} the stable response has C = {}",
            units.length_text(point.oscillator_amplitude)
        ),
        None => format!("Nothing is stable at {place}"),
    };
    let caption = format!(
        "{case}; at this frequency the response is stable for clearances from {narrowest} to about {widest}."
    );
    let points: Vec<String> = analysis.fixed_points.iter().map(describe).collect();
    let alt = format!(
        "Left, the manifold; right, the oscillator's amplitude over frequency for four clearances, stable only between fold and \
         symmetry breaking. Marked: {}. {caption}",
        if points.is_empty() { "no fixed point".to_owned() } else { points.join("; ") }
    );
    (caption, alt)
}
