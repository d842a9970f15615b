//! The case among its boundaries, in frequency and clearance (Figs. 5 and 6c).

use crate::analysis::Strip;
use crate::bifurcation::Bifurcation;
use crate::orbits::boundaries::over_frequency;
use crate::orbits::{Boundaries, Limit};
use crate::report::figure::{
    Axis, Figure, Layer, Layout, MarkedPoint, Marker, Panel, Role, Scale, Shape,
};
use crate::report::numbers::{percent, significant};
use crate::study::StudyError;
use crate::study::margins::Margin;
use crate::system::System;
use crate::validation::tolerance::has_resonance;

use super::Scene;
use super::asymptotic_error;
use super::borders::Borders;
use super::canvas::{Canvas, interpolated};

/// Half the window is at least so many mass ratios ...
const MASS_RATIOS: f64 = 15.0;
/// ... but no more than this share of the natural frequency unless the case asks for it.
const HALF: f64 = 0.5;
/// The case is at least so far from the window's side, compared with its distance from resonance.
const BEYOND_CASE: f64 = 1.4;
/// Beyond this ratio between case and boundaries a linear axis would hide one of them.
const FAR: f64 = 5.0;
/// The same for a case below its boundaries.
const DEEP: f64 = 0.02;
/// A peak higher than this many times the middle height of its line is cut.
const PEAK: f64 = 5.0;
/// Frequencies, less one, at which the exact boundaries are marked.
const EXACT: u32 = 40;

/// The window in frequency ratio.
pub(super) fn window(system: &System) -> (f64, f64) {
    let away = (system.frequency_ratio() - 1.0).abs();
    let half = (MASS_RATIOS * system.mass_ratio()).clamp(1e-9, HALF).max(BEYOND_CASE * away);
    ((1.0 - half).max(0.05_f64.min(0.5 * system.frequency_ratio())), 1.0 + half)
}

/// The window in detuning.
fn detunings(system: &System) -> (f64, f64) {
    let (first, last) = window(system);
    ((first - 1.0) / system.mass_ratio(), (last - 1.0) / system.mass_ratio())
}

pub(super) fn figure(scene: &Scene) -> Result<Option<Figure>, StudyError> {
    let system = &scene.study.analysis.system;
    let gamma = system.forcing_per_clearance();
    if gamma == 0.0 {
        // Without forcing every boundary is at no clearance at all.
        return Ok(None);
    }
    let borders = Borders::over(system, &scene.study.analysis.manifold, detunings(system))?;
    let units = &scene.units;
    let place = |detuning: f64, at: f64| {
        let ratio = 1.0 + system.mass_ratio() * detuning;
        [units.frequency(ratio), units.length(gamma / at)]
    };
    let canvas = canvas(scene, &borders);
    let case = [units.frequency(system.frequency_ratio()), units.length(1.0)];
    let mut y = Axis::linear(units.length_axis("clearance b")).with_range(canvas.y.0, canvas.y.1);
    y.scale = if canvas.log_y { Scale::Log } else { Scale::Linear };
    let x = Axis::linear(units.frequency_axis()).with_range(canvas.x.0, canvas.x.1);
    let mut panel = Panel::new(x.clone(), y);
    panel.layers = borders.layers(&place);
    let exact = exact_boundaries(system);
    let grazing = grazing(scene, &exact);
    if !grazing.is_empty() {
        panel = panel.with(grazed(scene, &grazing).labelled("Z2 ends (exact)"));
    }
    let limits = limits(scene, &exact);
    if !limits.is_empty() {
        let marker = Role::ExactOrbit.marker().sized(5.0);
        let layer = Layer::marked(marker, Role::ExactOrbit.color(), limits);
        panel = panel.with(layer.labelled("exact limits"));
    }
    panel.layers.extend(names(&borders, &place, &grazing, &canvas, case));
    panel = panel.with(Layer::this_case(case, Some(tooltip(scene))));
    let (mut caption, mut alt) = words(scene);
    let below = asymptotic_error::panel(scene, &exact, x)?;
    if let Some(price) = below.as_ref().and_then(|_| asymptotic_error::words(scene)) {
        caption = format!("{caption} {price}");
        alt = format!("{alt} {price}");
    }
    let figure = Figure::new("map", "This case among the boundaries of steady 1:1 resonance")
        .with_panel(panel)
        .with_words(caption, alt);
    Ok(Some(match below {
        Some(below) => {
            figure.with_size(720, 600).with_layout(Layout::rows(&[3.0, 1.0])).with_panel(below)
        }
        None => figure,
    }))
}

/// Axes that show the boundaries and the case.
fn canvas(scene: &Scene, borders: &Borders) -> Canvas {
    let system = &scene.study.analysis.system;
    let gamma = system.forcing_per_clearance();
    let (first, last) = window(system);
    let x = (scene.units.frequency(first), scene.units.frequency(last));
    let heights = |value: &dyn Fn(usize) -> f64| -> Vec<f64> {
        let all = (0..borders.samples.len()).map(|k| gamma / value(k));
        let mut finite: Vec<f64> = all.filter(|b| b.is_finite() && *b > 0.0).collect();
        finite.sort_by(f64::total_cmp);
        finite
    };
    let hopf = heights(&|k| borders.samples[k].hopf);
    let saddle = heights(&|k| borders.samples[k].saddle);
    let breaking = heights(&|k| borders.samples[k].breaking);
    let middle = hopf.get(hopf.len() / 2).copied().unwrap_or(1.0);
    let highest = hopf.last().into_iter().chain(saddle.last()).copied().fold(0.0, f64::max);
    let highest = if highest > 0.0 { highest.min(PEAK * middle) } else { 1.0 };
    let lowest = breaking.first().copied().unwrap_or(1.0);
    let log_y = highest * FAR < 1.0 || 1.0 < DEEP * highest;
    let y = if log_y {
        (0.6 * lowest.max(1e-3 * highest).min(1.0), 1.6 * highest.max(1.0))
    } else {
        (0.0, 1.1 * highest.max(1.15))
    };
    Canvas { x, y: (scene.units.length(y.0), scene.units.length(y.1)), log_y }
}

/// The exact boundaries on evenly spread frequencies of the window.
fn exact_boundaries(system: &System) -> Vec<Boundaries> {
    if !has_resonance(system) {
        return Vec::new();
    }
    let (first, last) = window(system);
    let ratio = |k: u32| first + (last - first) * f64::from(k) / f64::from(EXACT);
    over_frequency(system, &(1..EXACT).map(ratio).collect::<Vec<_>>())
}

/// Where more than two impacts per period begin, `[frequency, clearance]`.
fn grazing(scene: &Scene, exact: &[Boundaries]) -> Vec<[f64; 2]> {
    let units = &scene.units;
    let place =
        |at: &Boundaries| Some([units.frequency(at.frequency_ratio), units.length(at.grazing()?)]);
    exact.iter().filter_map(place).collect()
}

fn grazed(scene: &Scene, grazing: &[[f64; 2]]) -> Layer {
    let unit = scene.units.length_axis("").trim().trim_matches(['(', ')']).to_owned();
    let points = grazing.iter().map(|[f, b]| {
        let words =
            format!("below {} {unit}: more than two impacts per period", significant(*b, 3));
        MarkedPoint::new(*f, *b).with_tooltip(words)
    });
    Layer::marked(Marker::hollow(Shape::Square).sized(5.0), Role::ExactOrbit.color(), points)
}

/// Where the stable exact orbit begins and ends.
fn limits(scene: &Scene, exact: &[Boundaries]) -> Vec<MarkedPoint> {
    let units = &scene.units;
    let point = |at: &Boundaries, limit: &Limit| {
        let place = units.length_text(limit.clearance);
        let words = format!("{} of the exact orbit at {place}", limit.kind.words());
        MarkedPoint::new(units.frequency(at.frequency_ratio), units.length(limit.clearance))
            .with_tooltip(words)
    };
    let bounds = |limit: &&Limit| limit.bounds_stability;
    exact
        .iter()
        .flat_map(|at| at.symmetric.limits.iter().filter(bounds).map(|limit| point(at, limit)))
        .collect()
}

/// The areas' names where they have room.
fn names(
    borders: &Borders,
    place: &dyn Fn(f64, f64) -> [f64; 2],
    grazing: &[[f64; 2]],
    canvas: &Canvas,
    case: [f64; 2],
) -> Vec<Layer> {
    let line = |gamma: &dyn Fn(usize) -> f64| -> Vec<[f64; 2]> {
        (0..borders.samples.len())
            .map(|k| place(borders.samples[k].detuning, gamma(k)))
            .filter(|point| point[1].is_finite())
            .collect()
    };
    let breaking = line(&|k| borders.samples[k].breaking);
    let hopf = line(&|k| borders.samples[k].hopf);
    let outer = line(&|k| borders.samples[k].last);
    let (bottom, top) = (|_: f64| canvas.y.0, |_: f64| canvas.y.1);
    let at = |line: &'_ [[f64; 2]], x: f64| interpolated(line, x);
    let note = |long: &str, short: &str, lower: &dyn Fn(f64) -> f64, upper: &dyn Fn(f64) -> f64| {
        [(long, 9.0), (short, 9.0)].into_iter().find_map(|(words, size)| {
            let width = size * words.chars().count() as f64;
            let room = canvas.roomiest(lower, upper, width, &[case])?;
            (room.height > 20.0).then(|| Layer::note(room.at, words))
        })
    };
    let mut notes = vec![
        note("Z4: no 1:1", "Z4", &|x| at(&outer, x), &top),
        note("Z3: steady 1:1", "Z3", &|x| at(&breaking, x), &|x| at(&hopf, x)),
    ];
    if grazing.len() > 1 {
        notes.push(note("Z2: asymmetric", "Z2", &|x| at(grazing, x), &|x| at(&breaking, x)));
        notes.push(note("Z1: more impacts", "Z1", &bottom, &|x| at(grazing, x)));
    } else {
        notes.push(note("Z1, Z2: not symmetric", "Z1, Z2", &bottom, &|x| at(&breaking, x)));
    }
    notes.into_iter().flatten().collect()
}

fn tooltip(scene: &Scene) -> String {
    let area = area(scene);
    format!("this case: {}; {area}", scene.units.place_text(&scene.study.analysis.system))
}

/// The case's area in words.
fn area(scene: &Scene) -> String {
    let area = scene.study.area.area;
    match scene.study.analysis.zone.strip {
        Some(Strip::A1) => format!("{area:?}, in strip A1 (hysteresis)"),
        Some(Strip::A2) => format!("{area:?}, in strip A2 (beat motion)"),
        None => format!("{area:?}"),
    }
}

fn words(scene: &Scene) -> (String, String) {
    let neighbours = scene.study.margins.clearance_neighbours();
    let units = &scene.units;
    let say = |margin: Margin| {
        let name = match margin.kind {
            Bifurcation::SymmetryBreaking => "symmetry breaking",
            Bifurcation::NeimarkSacker => "the Hopf boundary",
            _ => "the saddle-node boundary",
        };
        let distance = match margin.factor {
            f if f > 2.0 => format!("{} times as large", significant(f, 2)),
            f => format!("{} {}", percent((f - 1.0).abs()), if f > 1.0 { "more" } else { "less" }),
        };
        format!("{name} at {} ({distance})", units.length_text(margin.factor))
    };
    let limits = match (neighbours.below, neighbours.above) {
        (Some(below), Some(above)) => {
            format!("between {} and {}", say(below), say(above))
        }
        (Some(below), None) => format!("above every boundary; the nearest is {}", say(below)),
        (None, Some(above)) => format!("below every boundary; the nearest is {}", say(above)),
        (None, None) => "where the theory has no boundary in clearance".to_owned(),
    };
    let place = units.place_text(&scene.study.analysis.system);
    let caption = format!("This case ({place}) lies in {}, {limits}.", area(scene));
    let alt = format!(
        "Map of frequency against clearance. The line of symmetry breaking peaks near resonance; above it lies Z3, \
         bounded by the higher Hopf and saddle-node lines that meet at P1. {caption}"
    );
    (caption, alt)
}
