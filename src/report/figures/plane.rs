//! The case among its boundaries in the reduced parameters `(sigma, gamma)`.

use crate::report::figure::{Axis, Figure, Layer, Panel, Scale};
use crate::report::numbers::significant;
use crate::study::StudyError;

use super::Scene;
use super::borders::{Border, Borders};
use super::canvas::{Canvas, interpolated};

/// Half the window in detuning is at least this, and this many times the case's detuning.
const HALF: f64 = 6.0;
const BEYOND_CASE: f64 = 1.35;
/// The window in forcing reaches this many times the case's and P1's.
const ABOVE_CASE: f64 = 1.2;
const ABOVE_MEETING: f64 = 3.0;
/// Beyond this ratio between case and P1 a linear axis would hide one of them.
const FAR: f64 = 15.0;

pub(super) fn figure(scene: &Scene) -> Result<Figure, StudyError> {
    let analysis = &scene.study.analysis;
    let system = &analysis.system;
    let case = [system.detuning(), system.forcing_per_clearance()];
    let half = HALF.max(BEYOND_CASE * case[0].abs());
    // A lower frequency than none is not possible.
    let lowest = -0.95 / system.mass_ratio();
    let x = ((-half).max(lowest.min(case[0])), half);
    let borders = Borders::over(system, &analysis.manifold, x)?;
    let meeting = borders.meeting.map_or(1.0, |at| at[1]);
    let log_y = case[1] > 0.0 && (case[1] > FAR * meeting || case[1] * FAR < meeting);
    let top = (ABOVE_CASE * case[1]).max(ABOVE_MEETING * meeting);
    let y = if log_y { (0.4 * meeting.min(case[1]), 1.5 * top) } else { (0.0, top) };
    let canvas = Canvas { x, y, log_y };
    let mut axis = Axis::linear("forcing per clearance γ = G/b (1)").with_range(y.0, y.1);
    axis.scale = if log_y { Scale::Log } else { Scale::Linear };
    let mut panel = Panel::new(Axis::linear("detuning σ (1)").with_range(x.0, x.1), axis);
    panel.layers = borders.layers(&|detuning, gamma| [detuning, gamma]);
    panel.layers.extend(names(&borders, &canvas, case));
    let numbers = format!("σ = {}, γ = {}", significant(case[0], 3), significant(case[1], 3));
    panel = panel.with(Layer::this_case(case, Some(format!("this case: {numbers}"))));
    let (caption, alt) = words(scene, &borders, &numbers);
    Ok(Figure::new("plane", "This case among the boundaries in detuning and forcing")
        .with_panel(panel)
        .with_words(caption, alt))
}

fn names(borders: &Borders, canvas: &Canvas, case: [f64; 2]) -> Vec<Layer> {
    let line = |value: fn(&Border) -> f64| -> Vec<[f64; 2]> {
        let points = borders.samples.iter().map(|at| [at.detuning, value(at)]);
        points.filter(|point| point[1].is_finite()).collect()
    };
    let [breaking, hopf] = [line(|at| at.breaking), line(|at| at.hopf)];
    let outer = line(|at| at.last);
    let note = |words: &str, lower: &dyn Fn(f64) -> f64, upper: &dyn Fn(f64) -> f64| {
        let room = canvas.roomiest(lower, upper, 9.0 * words.chars().count() as f64, &[case])?;
        (room.height > 20.0).then(|| Layer::note(room.at, words))
    };
    let either =
        |[long, short]: [&str; 2], lower: &dyn Fn(f64) -> f64, upper: &dyn Fn(f64) -> f64| {
            note(long, lower, upper).or_else(|| note(short, lower, upper))
        };
    let (bottom, top) = (|_: f64| canvas.y.0, |_: f64| canvas.y.1);
    [
        either(["Z4: no 1:1", "Z4"], &bottom, &|x| interpolated(&outer, x)),
        either(["Z3: steady 1:1", "Z3"], &|x| interpolated(&hopf, x), &|x| {
            interpolated(&breaking, x)
        }),
        either(["Z1, Z2: not symmetric", "Z1, Z2"], &|x| interpolated(&breaking, x), &top),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn words(scene: &Scene, borders: &Borders, numbers: &str) -> (String, String) {
    let boundaries = &scene.study.analysis.boundaries;
    let gamma = scene.study.analysis.system.forcing_per_clearance();
    let verdict = if gamma < boundaries.hopf {
        "less: too little forcing, or too large a clearance"
    } else if gamma > boundaries.symmetry_breaking {
        "more: too much forcing, or too small a clearance"
    } else {
        "between them"
    };
    let meeting = borders.meeting.map_or_else(String::new, |at| {
        format!(
            " The strips A1 and A2 meet at P1, σ = {}, γ = {}.",
            significant(at[0], 3),
            significant(at[1], 3)
        )
    });
    let caption = format!(
        "At {} steady 1:1 resonance needs γ from {} (Hopf) to {} (symmetry breaking); the case has {numbers}, \
         {verdict}.{meeting}",
        scene.units.frequency_text(scene.study.analysis.system.frequency_ratio()),
        significant(boundaries.hopf, 3),
        significant(boundaries.symmetry_breaking, 3)
    );
    let alt = format!(
        "Plane of detuning and forcing per clearance. Three boundaries are lowest near resonance and rise to both sides. {caption}"
    );
    (caption, alt)
}
