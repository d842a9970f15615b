//! Which starts lead to which long-term motion: basins of attraction on a plane of starting states.

use crate::regimes::basins::{Basins, Cell};
use crate::regimes::starts::StartBox;
use crate::regimes::{Effort, Regime, Transient};
use crate::report::figure::{Axis, Color, Figure, Layer, Marker, Panel, Shape};
use crate::report::numbers::percent;
use crate::study::StudyError;
use crate::system::State;

use super::Scene;

/// Starts along either axis: squares that are still seen one by one.
const CELLS: u32 = 40;
/// Enough to recognise the motion; in a shorter window a strongly modulated one may show no capture.
/// Ten impacts per period are recognised as that without going on.
const EFFORT: Effort = Effort { discard: None, periods: 200, most_impacts: 10 };
/// Colour and marker of each motion, so that they can be told apart without colours.
const LOOKS: [(Color, Marker); 5] = [
    (Color::SkyBlue, Marker::filled(Shape::Square).sized(9.0)),
    (Color::Vermillion, Marker::filled(Shape::Circle).sized(6.0)),
    (Color::BluishGreen, Marker::filled(Shape::Triangle).sized(7.0)),
    (Color::ReddishPurple, Marker::filled(Shape::Diamond).sized(7.0)),
    (Color::Orange, Marker::hollow(Shape::Square).sized(6.0)),
];
const OPEN: (Color, Marker) = (Color::Grey, Marker::filled(Shape::Cross).sized(5.0));

pub(super) fn figure(scene: &Scene) -> Result<Option<Figure>, StudyError> {
    let system = &scene.study.analysis.system;
    let reach = StartBox::around(system).reach;
    let middle = |cell: u32| reach * (2.0 * (f64::from(cell) + 0.5) / f64::from(CELLS) - 1.0);
    // The absorber lies at rest in the middle of its cavity.
    let start = |index: u32| {
        let (x, x_velocity) = (middle(index % CELLS), middle(index / CELLS));
        State { x, x_velocity, y: x, y_velocity: 0.0 }
    };
    let starts: Vec<State> = (0..CELLS * CELLS).map(start).collect();
    let known = scene.study.attractors.iter().map(|found| found.attractor.motion).collect();
    let basins = Basins::of(system, &starts, known, &EFFORT, &mut |_| {})?;
    let units = &scene.units;
    let place =
        |index: usize| [units.length(starts[index].x), units.velocity(starts[index].x_velocity)];
    let marks = |wanted: &dyn Fn(Cell) -> bool| -> Vec<[f64; 2]> {
        let all = basins.cells.iter().enumerate();
        all.filter(|(_, cell)| wanted(**cell)).map(|(index, _)| place(index)).collect()
    };
    let (x, y) = (units.length(reach), units.velocity(reach));
    let mut panel = Panel::new(
        Axis::linear(units.length_axis("oscillator displacement x at the start")).with_range(-x, x),
        Axis::linear(units.velocity_axis("oscillator velocity at the start")).with_range(-y, y),
    );
    // Without impacts and damping a free vibration never fades.
    let undamped = system.damping() == 0.0;
    let mut said = Vec::new();
    let share = |count: usize| percent(count as f64 / basins.cells.len() as f64);
    for (index, motion) in basins.motions.iter().enumerate() {
        let marks = marks(&|cell| cell == Cell::Leads(index));
        if marks.is_empty() {
            continue;
        }
        let regime = motion.regime.words();
        let name = if motion.regime == Regime::AtRest && undamped {
            format!("{regime} (peak depends on the start)")
        } else {
            format!("{regime}, peak {}", units.length_text(motion.peak))
        };
        said.push(format!("{} end with {name}", share(marks.len())));
        let (color, marker) = LOOKS[index.min(LOOKS.len() - 1)];
        panel = panel.with(Layer::marked(marker, color, marks).labelled(name));
    }
    let open = marks(&|cell| matches!(cell, Cell::NotSettled));
    if !open.is_empty() {
        said.push(format!("{} have not settled", share(open.len())));
        panel = panel.with(Layer::marked(OPEN.1, OPEN.0, open).labelled("not settled"));
    }
    let caption = format!(
        "Of {} starts with the absorber at rest in the middle of its cavity (excitation phase 0), each followed for at least {} excitation periods, {}.",
        basins.cells.len(),
        Transient::of(system).periods,
        said.join("; ")
    );
    let alt = format!(
        "Plane of the oscillator's displacement and velocity at the start, marked by the motion that each start leads to. {caption}"
    );
    Ok(Some(
        Figure::new("basins", "Which starts lead to which motion")
            .with_size(640, 620)
            .with_panel(panel)
            .with_words(caption, alt),
    ))
}
