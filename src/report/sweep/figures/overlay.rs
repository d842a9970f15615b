//! What is drawn over a map: boundaries of the theory and of exact orbits, areas by name, the case.

use super::super::grid::{Grid, Plane, SweepDirection};
use super::super::kinds::{AREAS, area_words};
use super::contours;
use crate::analysis::Manifold;
use crate::case::{Case, SweepParameter};
use crate::orbits::Limit;
use crate::orbits::boundaries::over_frequency;
use crate::report::figure::{Color, Dash, Label, Layer, MarkedPoint, Role, Style};
use crate::report::figures::borders::Borders;
use crate::report::units::Units;
use crate::validation::tolerance::has_resonance;

/// Frequencies at which the exact boundaries are marked.
const EXACT: u32 = 32;
/// About the width of a panel that has a figure to itself, and of a letter, pixels.
const PANEL: f64 = 560.0;
const LETTER: f64 = 10.0;

/// What lies over a map.
pub(super) struct Overlay {
    pub layers: Vec<Layer>,
    /// What the lines are, for the caption.
    pub words: &'static str,
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

/// The boundaries of a slice.
pub(super) fn boundaries(grid: &Grid, plane: Plane, slice: usize, named: bool) -> Overlay {
    let known = computed(grid, plane).filter(|_| grid.slices() == 1);
    match known {
        Some(layers) => Overlay {
            words: "Lines: boundaries of the theory; circles: ends of the stable exact orbit, at some frequencies.",
            layers,
        },
        None => traced(grid, plane, slice, named),
    }
}

/// Those of closed form and exact orbits themselves, over frequency and clearance.
fn computed(grid: &Grid, plane: Plane) -> Option<Vec<Layer>> {
    let axes = [plane.x.parameter, plane.y.parameter];
    if axes != [SweepParameter::Frequency, SweepParameter::Clearance] {
        return None;
    }
    let case: &Case = grid.swept.case;
    let (system, units) = (case.system(), Units::of(case));
    let gamma = system.forcing_per_clearance();
    if gamma == 0.0 {
        return None;
    }
    let edges = plane.x.edges();
    let own = units.frequency(1.0);
    let [first, last] = [*edges.first()?, *edges.last()?].map(|frequency| frequency / own);
    let detuning = |ratio: f64| (ratio - 1.0) / system.mass_ratio();
    let manifold = Manifold::of(system.restitution());
    let window = (detuning(first), detuning(last));
    let borders = Borders::over(&system, &manifold, window).ok()?;
    let place = |detuning: f64, at: f64| {
        let ratio = 1.0 + system.mass_ratio() * detuning;
        [units.frequency(ratio), units.length(gamma / at)]
    };
    let mut layers: Vec<Layer> = Vec::new();
    for line in borders.lines(&place) {
        let clipped = clip(line, plane);
        layers.extend(cased(clipped));
    }
    layers.extend(borders.meeting_point(&place));
    layers.extend(exact(case, &units, [first, last]));
    Some(layers)
}

/// A line without what lies far beyond the map, which would draw its name away from it.
fn clip(mut layer: Layer, plane: Plane) -> Layer {
    let edges = plane.y.edges();
    if let (Layer::Curve { points, .. }, Some(top)) = (&mut layer, edges.last()) {
        for point in points.iter_mut().filter(|point| point[1] > 3.0 * top) {
            point[1] = f64::NAN;
        }
    }
    layer
}

/// Where the stable exact orbit begins and ends.
fn exact(case: &Case, units: &Units, [first, last]: [f64; 2]) -> Option<Layer> {
    let system = case.system();
    if !has_resonance(&system) {
        return None;
    }
    let ratio = |k: u32| first + (last - first) * (f64::from(k) + 0.5) / f64::from(EXACT);
    let found = over_frequency(&system, &(0..EXACT).map(ratio).collect::<Vec<_>>());
    let bounds = |limit: &&Limit| limit.bounds_stability;
    let points: Vec<MarkedPoint> = found
        .iter()
        .flat_map(|at| {
            at.symmetric.limits.iter().filter(bounds).map(|limit| {
                let place = units.length_text(limit.clearance);
                let words = format!("{} of the exact orbit at {place}", limit.kind.words());
                let [x, y] = [units.frequency(at.frequency_ratio), units.length(limit.clearance)];
                MarkedPoint::new(x, y).with_tooltip(words)
            })
        })
        .collect();
    let marker = Role::ExactOrbit.marker().sized(5.4);
    let layer = Layer::marked(marker, Role::ExactOrbit.color(), points);
    Some(layer.labelled("exact limits"))
}

/// Those that the columns show: between cells whose area differs, and where the exact orbit begins and ends.
fn traced(grid: &Grid, plane: Plane, slice: usize, named: bool) -> Overlay {
    let (x_edges, y_edges) = (plane.x.edges(), plane.y.edges());
    let mut layers = Vec::new();
    let mut drawn = [false; 2];
    if let Some(areas) = grid.text("area", SweepDirection::Single) {
        let curve = contours::between(&plane.cells(areas, slice), &x_edges, &y_edges);
        drawn[0] = !curve.is_empty();
        let layer = Layer::styled(Style::new(Color::Vermillion, 1.7, Dash::Solid), curve);
        layers.extend(cased(label(layer, "areas of the theory", named && drawn[0])));
    }
    if let Some(orbit) = grid.number("orbit_peak", SweepDirection::Single) {
        let attracts: Vec<Option<bool>> =
            plane.cells(&orbit, slice).iter().map(|peak| Some(peak.is_some())).collect();
        let curve = contours::between(&attracts, &x_edges, &y_edges);
        drawn[1] = !curve.is_empty();
        let layer = Layer::styled(Style::new(Color::Black, 1.3, Dash::Dashed), curve);
        layers.extend(cased(label(layer, "exact orbit attracts", named && drawn[1])));
    }
    Overlay {
        layers,
        words: match drawn {
            [true, true] => {
                "Lines, traced between the points of the grid: where the theory's area changes (solid), and where an exact \
                 1:1 orbit begins or ceases to attract (dashed)."
            }
            [true, false] => {
                "Lines, traced between the points of the grid: where the theory's area changes."
            }
            [false, true] => {
                "Dashed lines, traced between the points of the grid: where an exact 1:1 orbit begins or ceases to attract."
            }
            [false, false] => "",
        },
    }
}

fn label(layer: Layer, words: &str, named: bool) -> Layer {
    if named { layer.labelled(Label::from(words)) } else { layer }
}

/// The names of the areas, each in the middle of its largest part, where it has room in a figure with so many
/// columns.
pub(super) fn area_names(grid: &Grid, plane: Plane, slice: usize, columns: usize) -> Vec<Layer> {
    let Some(areas) = grid.text("area", SweepDirection::Single) else { return Vec::new() };
    let cells = plane.cells(areas, slice);
    let (across, up) = (plane.x.values.len(), plane.y.values.len());
    let inside = depths(&cells, across, up);
    let size = PANEL / columns as f64;
    let named = AREAS.iter().filter_map(|(area, _)| {
        let words = area_words(area);
        // Half of what the words take, as a part of the map.
        let half = [0.5 * LETTER * words.len() as f64 / size, LETTER / size];
        let fits = |cell: &usize| (0..2).all(|k| inside[*cell][k] > half[k]);
        let depth = |cell: usize| inside[cell][0].min(inside[cell][1]);
        let here = (0..cells.len()).filter(|cell| cells[*cell] == Some(*area)).filter(fits);
        let middle = here.max_by(|a, b| depth(*a).total_cmp(&depth(*b)).then(b.cmp(a)))?;
        let at = [plane.x.values[middle % across], plane.y.values[middle / across]];
        Some(Layer::note(at, words))
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

/// The case's own point, where the map has one.
pub(super) fn this_case(plane: Plane) -> Option<Layer> {
    let (x, y) = (plane.x.own?, plane.y.own?);
    let within = |value: f64, edges: &[f64]| {
        edges.first().is_some_and(|first| *first <= value)
            && edges.last().is_some_and(|last| value <= *last)
    };
    let inside = within(x, &plane.x.edges()) && within(y, &plane.y.edges());
    inside.then(|| Layer::this_case([x, y], Some("this case".to_owned())))
}
