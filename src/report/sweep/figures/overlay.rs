//! What is drawn over a map: boundaries of the theory and of exact orbits, and areas by name.

use serde::Serialize;

use super::super::grid::Plane;
use super::super::kinds::AREAS;
use super::super::{Swept, SweptCase};
use super::contours;
use crate::analysis::Manifold;
use crate::case::Recorded;
use crate::quantity::catalogue::CLEARANCE;
use crate::report::figure::{Color, Dash, Layer, MarkedPoint, Role, Style};
use crate::report::figures::borders::Borders;
use crate::sweep::columns::Direction;
use crate::sweep::limits::StabilityLimit;
use crate::system::Parameter;

/// About the width of a panel that has a figure to itself, and of a letter, pixels.
const PANEL: f64 = 560.0;
const LETTER: f64 = 10.0;

/// The lines over a map.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub(super) struct Lines {
    /// Those of closed form and of exact orbits themselves.
    computed: bool,
    /// Traced between points of the grid: where the theory's area changes,
    areas: bool,
    /// and where an exact orbit begins or ceases to attract.
    orbit: bool,
}

/// The boundaries of a slice; traced ones have names where `named`.
pub(super) fn boundaries(
    swept: &Swept,
    plane: Plane,
    slice: usize,
    named: bool,
) -> (Vec<Layer>, Lines) {
    match computed(swept, plane).filter(|_| swept.slices() == 1) {
        Some(layers) => (layers, Lines { computed: true, ..Lines::default() }),
        None => traced(swept, plane, slice, named),
    }
}

/// Those of closed form and exact orbits themselves, over frequency and clearance.
fn computed(swept: &Swept, plane: Plane) -> Option<Vec<Layer>> {
    let axes = [plane.x.parameter, plane.y.parameter];
    let SweptCase::One(case) = swept.case else { return None };
    let (system, units) = (case.system(), case.units());
    let gamma = system.forcing_per_clearance();
    if axes != [Parameter::Frequency, Parameter::Clearance] || gamma == 0.0 {
        return None;
    }
    let (edges, top) = (plane.x.edges(), *plane.y.edges().last()?);
    let detuning = |edge: f64| (units.frequency_ratio(edge) - 1.0) / system.mass_ratio();
    let window = (detuning(edges[0]), detuning(edges[edges.len() - 1]));
    let borders = Borders::over(&system, &Manifold::of(system.restitution()), window);
    let place = |detuning: f64, at: f64| {
        let x = units.frequency(1.0 + system.mass_ratio() * detuning);
        let y = units.length(gamma / at);
        // What lies far beyond the map would draw the line's name away from it.
        [x, if y > 3.0 * top { f64::NAN } else { y }]
    };
    let mut layers: Vec<Layer> = borders.lines(&place).into_iter().flat_map(cased).collect();
    layers.extend(borders.meeting_point(&place));
    layers.extend(exact(swept));
    Some(layers)
}

/// Where the stable exact orbit begins and ends, at some frequencies.
fn exact(swept: &Swept) -> Option<Layer> {
    let units = swept.units();
    let point = |at: &StabilityLimit| {
        let clearance = units.length(at.limit.clearance);
        let place = units.text(&CLEARANCE, clearance);
        let words = format!("{} of the exact orbit at {place}", at.limit.kind.words());
        MarkedPoint::new(units.frequency(at.frequency_ratio), clearance).with_tooltip(words)
    };
    let points: Vec<MarkedPoint> = swept.limits.iter().map(point).collect();
    let marker = Role::ExactOrbit.marker().sized(5.4);
    let layer = || Layer::marked(marker, Role::ExactOrbit.color(), points.clone());
    (!points.is_empty()).then(|| layer().labelled("exact limits"))
}

/// Those that the columns show: between cells whose area differs, and where the exact orbit begins and ends.
fn traced(swept: &Swept, plane: Plane, slice: usize, named: bool) -> (Vec<Layer>, Lines) {
    let (x_edges, y_edges) = (plane.x.edges(), plane.y.edges());
    let line = |curve: Vec<[f64; 2]>, style: Style, name: &str| {
        let named = named && !curve.is_empty();
        let layer = Layer::curve(style, curve);
        cased(if named { layer.labelled(name) } else { layer })
    };
    let areas = swept.areas().map_or_else(Vec::new, |areas| {
        contours::between(&plane.cells(&areas, slice), &x_edges, &y_edges)
    });
    let peaks = swept.numbers(Recorded::OrbitPeak, Direction::Single);
    let orbit = peaks.map_or_else(Vec::new, |peaks| {
        let cells = plane.cells(&peaks, slice);
        let attracts: Vec<_> = cells.iter().map(|peak| Some(peak.is_some())).collect();
        contours::between(&attracts, &x_edges, &y_edges)
    });
    let lines = Lines { computed: false, areas: !areas.is_empty(), orbit: !orbit.is_empty() };
    let solid = Style::new(Color::Vermillion, 1.7, Dash::Solid);
    let dashed = Style::new(Color::Black, 1.3, Dash::Dashed);
    let mut layers = Vec::from(line(areas, solid, "areas of the theory"));
    layers.extend(line(orbit, dashed, "exact orbit attracts"));
    (layers, lines)
}

/// A white line below a coloured one, so that it shows on any tint.
fn cased(layer: Layer) -> [Layer; 2] {
    let mut below = layer.clone();
    if let Layer::Curve { style, label, .. } = &mut below {
        *style = Style::new(Color::White, style.width + 2.4, Dash::Solid);
        *label = None;
    }
    [below, layer]
}

/// The names of the areas, each in the middle of its largest part, where it has room in a figure with so many
/// columns.
pub(super) fn area_names(swept: &Swept, plane: Plane, slice: usize, columns: usize) -> Vec<Layer> {
    let Some(areas) = swept.areas() else { return Vec::new() };
    let cells = plane.cells(&areas, slice);
    let (across, up) = (plane.x.values.len(), plane.y.values.len());
    let inside = depths(&cells, across, up);
    let size = PANEL / columns as f64;
    let named = AREAS.iter().filter_map(|(area, _)| {
        // Half of what the words take, as a part of the map.
        let half = [0.5 * LETTER * area.len() as f64 / size, LETTER / size];
        let fits = |cell: &usize| (0..2).all(|k| inside[*cell][k] > half[k]);
        let depth = |cell: usize| inside[cell][0].min(inside[cell][1]);
        let here = (0..cells.len()).filter(|cell| cells[*cell] == Some(*area)).filter(fits);
        let middle = here.max_by(|a, b| depth(*a).total_cmp(&depth(*b)).then(b.cmp(a)))?;
        let at = [plane.x.values[middle % across], plane.y.values[middle / across]];
        Some(Layer::note(at, *area))
    });
    named.collect()
}

/// How far each cell is from one that is another, or from the edge of the map, along its row and its column, as
/// a part of the map.
fn depths(cells: &[Option<&str>], across: usize, up: usize) -> Vec<[f64; 2]> {
    let mut inside = vec![[0.0; 2]; cells.len()];
    let mut line = |axis: usize, count: usize, index: &dyn Fn(usize) -> usize| {
        let mut from = 0;
        while from < count {
            let same = |k: &usize| cells[index(*k)] == cells[index(from)];
            let to = (from..count).take_while(same).last().unwrap_or(from) + 1;
            for k in from..to {
                inside[index(k)][axis] = ((k - from).min(to - 1 - k) as f64 + 0.5) / count as f64;
            }
            from = to;
        }
    };
    for row in 0..up {
        line(0, across, &|k| row * across + k);
    }
    for column in 0..across {
        line(1, up, &|k| k * across + column);
    }
    inside
}
