//! The manifolds of absorbers, drawn.

use serde_json::Value;

use super::{heading, in_rows, place};
use crate::case::ModalCase;
use crate::modal::{AbsorberManifold, Beside, ExactAmplitude, GroupTheory, LoadTheory};
use crate::quantity::catalogue as of;
use crate::report::chart::AxisOf;
use crate::report::figure::{Color, Dash, Figure, Layer, Marker, Panel, Role, Shape, Style};
use crate::report::figures::parts::{manifold, own_points};
use crate::report::modal::units;

/// How far the manifold is drawn beyond symmetry breaking and all points, over the absorber's own clearance.
const BEYOND: f64 = 1.15;
/// Colours of the manifolds of several absorbers.
const MANIFOLDS: [Color; 4] = [Color::Blue, Color::BluishGreen, Color::Orange, Color::Vermillion];

/// The manifolds of the absorbers in the modes that loads drive, with the fixed points of these and exact orbits; a panel for each.
pub(in crate::report::modal) fn manifolds(
    case: &ModalCase,
    beside: &Beside,
    facts: &Value,
) -> Figure {
    let mut figure = Figure::new("sim", "");
    for found in &beside.theory {
        let Some(group) = &found.group else { continue };
        figure = figure.with_panel(manifold_panel(case, found, group));
    }
    in_rows(figure).with_facts("captions/sim-of-loads", facts.clone())
}

fn manifold_panel(case: &ModalCase, found: &LoadTheory, group: &GroupTheory) -> Panel {
    let units = units(case);
    let amplitudes = group.points.iter().map(|(amplitude, _)| *amplitude);
    let highest = amplitudes.chain(found.exact.iter().map(|one| one.amplitude)).fold(0.0, f64::max);
    // Points of the manifold, of fixed points and of orbits with the absorber's own amplitude.
    let of_point =
        |one: &AbsorberManifold, amplitude: f64| Some([one.absorber_at(amplitude)?, amplitude]);
    let of_orbit =
        |one: &AbsorberManifold, of: &ExactAmplitude| [of.absorbers[one.absorber], of.amplitude];
    let curves = group.manifolds.iter().map(|one| {
        let breaking = one.manifold.symmetry_breaking.absorber_amplitude;
        let reached = one.manifold.stable_absorber(highest / one.seen).unwrap_or_default();
        let orbits = found.exact.iter().map(|of| of_orbit(one, of)[0] / one.clearance);
        let last = BEYOND * orbits.chain([breaking, reached]).fold(0.0, f64::max);
        manifold(&one.manifold, last)
            .map(|line| line.into_iter().map(|at| one.at(at)).collect::<Vec<_>>())
    });
    let curves: Vec<[Vec<[f64; 2]>; 2]> = curves.collect();
    let right = curves.iter().flatten().flatten().map(|[x, _]| *x).fold(0.0, f64::max);
    let top = curves.iter().flatten().flatten().map(|[_, y]| *y).fold(0.0, f64::max);
    let x = AxisOf::si(units, &of::ABSORBER_AMPLITUDE).axis([0.0, right]);
    let y = AxisOf::si(units, &of::OSCILLATOR_AMPLITUDE).axis([0.0, top]);
    let at = units.text(&of::EXCITATION_FREQUENCY, found.at);
    let on = heading(case, found.load, &case.loads[found.load]);
    let mut panel = Panel::new(x, y).with_heading(format!(
        "{on}, {at}: mode {} at {}",
        found.mode + 1,
        place(case, found.place)
    ));
    for (k, ([unstable, stable], one)) in curves.into_iter().zip(&group.manifolds).enumerate() {
        let (thin, thick, name) = match case.absorbers.len() {
            1 => (Role::Unstable.style(), Role::Stable.style(), "stable".to_owned()),
            _ => {
                let color = MANIFOLDS[k % MANIFOLDS.len()];
                let style = |width, dash| Style::new(color, width, dash);
                let name = format!("absorber {}", one.absorber + 1);
                (style(1.1, Dash::Dashed), style(2.2, Dash::Solid), name)
            }
        };
        panel = panel
            .with(Layer::curve(thin, unstable))
            .with(Layer::curve(thick, stable).labelled(name));
    }
    for (stable, (marker, color)) in [true, false].into_iter().zip(own_points()) {
        let what = if stable { "stable" } else { "unstable" };
        let points = group.points.iter().filter(|(_, one)| *one == stable);
        let points = points.flat_map(|(amplitude, _)| {
            group.manifolds.iter().filter_map(|one| of_point(one, *amplitude))
        });
        let points: Vec<[f64; 2]> = points.collect();
        if !points.is_empty() {
            let layer = Layer::marked(marker.sized(9.0), color, points);
            panel = panel.with(layer.labelled(format!("{what} fixed point")));
        }
    }
    for attracts in [true, false] {
        let orbits = found.exact.iter().filter(|one| one.attracts == attracts);
        let orbits = orbits.flat_map(|of| group.manifolds.iter().map(|one| of_orbit(one, of)));
        let orbits: Vec<[f64; 2]> = orbits.collect();
        if !orbits.is_empty() {
            let what = if attracts { "stable" } else { "unstable" };
            let (marker, filled) = (Marker::hollow(Shape::Circle), Marker::filled(Shape::Circle));
            let marker = if attracts { filled } else { marker };
            let layer = Layer::marked(marker.sized(6.0), Role::ExactOrbit.color(), orbits);
            panel = panel.with(layer.labelled(format!("{what} exact orbit")));
        }
    }
    panel
}
