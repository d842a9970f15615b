//! A long stretch of the motion on the manifold, enlarged where it is captured and where it stays
//! (Fig. 8).

use crate::analysis::Branch;
use crate::report::figure::{
    Axis, Cell, Color, Dash, Figure, Label, Layer, Layout, Panel, Role, Style,
};
use crate::report::numbers::{percent, significant};
use crate::simulation::Trace;
use crate::study::scenes::{projected, projected_after};
use crate::study::stretches::{Periods, Stretch};
use crate::study::{StudyError, scenes};
use crate::system::System;

use super::Scene;
use super::manifold::branches;

/// Periods followed: a dozen captures of a strongly modulated response.
const PERIODS: u64 = 150;
/// Between impacts only `C` changes, and slowly.
const DENSITY: f64 = 4.0;
/// Periods at the beginning of a capture that belong to the transition.
const TRANSITION: usize = 3;

/// How far from the stable branch a case's first motion is while captured, relative in `C` (rms).
///
/// # Errors
/// As the simulation.
pub(crate) fn away_from_branch(scene: &Scene) -> Result<Option<f64>, StudyError> {
    let Some(found) = scene.first_drawn() else { return Ok(None) };
    let system = &scene.study.analysis.system;
    let trace = scenes::trace(system, found.attractor.state, PERIODS, DENSITY)?;
    let captures = Periods::of(&trace).captures();
    Ok(distance(scene, &landed(system, &trace), &captures))
}

/// Where every impact leaves the motion, with its time in periods.
fn landed(system: &System, trace: &Trace) -> Vec<(f64, [f64; 2])> {
    let impacts = trace.impacts.iter();
    impacts.map(|(at, impact)| (*at, projected_after(system, impact))).collect()
}

pub(super) fn figure(scene: &Scene) -> Result<Option<Figure>, StudyError> {
    let Some(found) = scene.first_drawn() else { return Ok(None) };
    let analysis = &scene.study.analysis;
    let (system, manifold) = (&analysis.system, &analysis.manifold);
    let trace = scenes::trace(system, found.attractor.state, PERIODS, DENSITY)?;
    let captures = Periods::of(&trace).captures();
    // A transition needs periods before it, a stay some after it.
    let arrival = |capture: &&Stretch| capture.first >= TRANSITION;
    let Some(longest) =
        captures.iter().filter(arrival).max_by_key(|capture| capture.periods).copied()
    else {
        return Ok(None);
    };
    let transition =
        Stretch { first: longest.first - TRANSITION, periods: 2 * TRANSITION.min(longest.periods) };
    let skipped = TRANSITION.min(longest.periods - 1);
    let stay = Stretch { first: longest.first + skipped, periods: longest.periods - skipped };
    let path = |within: &dyn Fn(f64) -> bool| -> Vec<[f64; 2]> {
        let inside = trace.points.iter().filter(|point| within(point.periods));
        inside.map(|point| projected(system, &point.state)).collect()
    };
    let all = path(&|_| true);
    let landed = landed(system, &trace);
    let away = distance(scene, &landed, &captures);
    let last = 1.08 * all.iter().map(|at| at[0]).fold(2.0, f64::max);
    let top = 1.12 * all.iter().map(|at| at[1]).fold(0.0, f64::max);
    let bottom =
        0.75 * all.iter().map(|at| at[1]).fold(manifold.fold.oscillator_amplitude, f64::min);
    let panel = |heading: &str, stretch: Option<Stretch>| {
        let line = match stretch {
            Some(stretch) => path(&|at| stretch.holds(at)),
            None => all.clone(),
        };
        let (x, y) = match stretch {
            Some(_) => (around(&line, 0), around(&line, 1)),
            None => ((0.0, last), (bottom, top)),
        };
        let [left, right, stable] = branches(manifold, last);
        let mut panel = Panel::new(
            Axis::linear("absorber amplitude B/b (1)").with_range(x.0, x.1),
            Axis::linear("oscillator amplitude C/b (1)").with_range(y.0, y.1),
        )
        .with_heading(heading);
        panel.layers.extend([left, right, stable]);
        panel = panel.with(Layer::curve(Role::Simulation, line));
        if let Some(stretch) = stretch {
            let marks = landed.iter().filter(|(at, _)| stretch.holds(*at)).map(|(_, at)| *at);
            panel = panel.with(Layer::points(Role::Simulation, marks));
        }
        panel
    };
    let mut whole = panel(&format!("{PERIODS} periods"), None);
    for (name, stretch) in [("b", transition), ("c", stay)] {
        let part = path(&|at| stretch.holds(at));
        whole = whole.with(outline(&part, name));
    }
    let (caption, alt) = words(scene, system, &trace, &captures, away);
    let cell = |column, row, rows| Cell { column, row, columns: 1, rows };
    Ok(Some(
        Figure::new("modulation", "The modulated motion on the manifold")
            .with_size(860, 560)
            .with_layout(Layout::Cells {
                widths: vec![5.0, 4.0],
                heights: vec![1.0, 1.0],
                cells: vec![cell(0, 0, 2), cell(1, 0, 1), cell(1, 1, 1)],
            })
            .with_panel(whole)
            .with_panel(panel("b: into 1:1 resonance", Some(transition)))
            .with_panel(panel("c: in 1:1 resonance", Some(stay)))
            .with_words(caption, alt),
    ))
}

/// The range of one coordinate with some room.
fn around(line: &[[f64; 2]], index: usize) -> (f64, f64) {
    let (low, high) = line.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), at| {
        (low.min(at[index]), high.max(at[index]))
    });
    let room = 0.12 * (high - low).max(0.02 * high.max(1e-6));
    ((low - room).max(0.0), high + room)
}

/// A frame around an enlarged part.
fn outline(part: &[[f64; 2]], name: &str) -> Layer {
    let ((left, right), (low, high)) = (around(part, 0), around(part, 1));
    let corners = vec![[left, low], [right, low], [right, high], [left, high], [left, low]];
    let style = Style::new(Color::Black, 1.0, Dash::Solid);
    Layer::styled(style, corners).labelled(Label::near(name, [right, high]))
}

/// Root mean square of the relative distance in `C` between impacts of the captures on the stable
/// branch, their first periods left out, and the manifold at the same `B`.
fn distance(scene: &Scene, landed: &[(f64, [f64; 2])], captures: &[Stretch]) -> Option<f64> {
    let manifold = &scene.study.analysis.manifold;
    let settled = |at: f64| {
        captures
            .iter()
            .any(|capture| (capture.first + TRANSITION) as f64 <= at && at <= capture.end() as f64)
    };
    let squares: Vec<f64> = landed
        .iter()
        .filter(|(at, [absorber, _])| {
            settled(*at) && manifold.branch(absorber - 1.0) == Branch::Stable
        })
        .map(|(_, [absorber, oscillator])| {
            let on = manifold.point(absorber - 1.0).oscillator_amplitude;
            let relative = (oscillator - on) / on;
            relative * relative
        })
        .collect();
    let count = squares.len();
    (count > 0).then(|| (squares.iter().sum::<f64>() / count as f64).sqrt())
}

fn words(
    scene: &Scene,
    system: &System,
    trace: &Trace,
    captures: &[Stretch],
    away: Option<f64>,
) -> (String, String) {
    let captured: usize = captures.iter().map(|capture| capture.periods).sum();
    let end = trace.points.last().map_or(1.0, |point| point.periods);
    let follows = match away {
        Some(away) => format!(
            "while captured for more than {TRANSITION} periods it follows the stable branch within {} of C (rms)",
            percent(away)
        ),
        None => "no capture lasts long enough to follow the stable branch".to_owned(),
    };
    let caption = format!(
        "At {} the motion is captured {} times in {} periods, {} of the time; {follows}.",
        scene.units.place_text(system),
        captures.len(),
        significant(end, 3),
        percent(captured as f64 / end)
    );
    let alt = format!(
        "The motion in the plane of the amplitudes, with two enlargements: an impact moves it sideways, forcing and damping move it up \
         and down between impacts. {caption}"
    );
    (caption, alt)
}
