//! The motion in which the structure moves farthest over time, drawn.

use serde_json::{Value, json};

use super::{heading, place};
use crate::case::ModalCase;
use crate::modal::{Beside, LoadImpact, OverTime};
use crate::motions::Motions;
use crate::quantity::Units;
use crate::quantity::catalogue as of;
use crate::report::chart::{AxisOf, FITTED};
use crate::report::figure::{Axis, Figure, Layer, Layout, MarkedPoint, Panel, Role};
use crate::report::modal::{given, units};

/// Up to so many impacts of a panel have a tooltip.
const TOOLTIPS: usize = 40;
/// Range of a panel over the clearance: its walls have some room behind them.
const BEHIND_WALLS: f64 = 1.35;
/// Height of a panel, in that of one of several absorbers of a load: where there is one.
const OF_ONE: f64 = 1.4;

/// The motion in which the structure moves farthest under each load, over time: its displacement, and beside that each absorber between
/// its walls.
pub(in crate::report::modal) fn over_time(
    case: &ModalCase,
    beside: &Beside,
    facts: &Value,
) -> Figure {
    let units = units(case);
    let mut facts = facts.clone();
    facts["over_time"] = beside.over_time.iter().map(|one| told_over_time(case, one)).collect();
    let mut figure = Figure::new("motion", "").with_facts("captions/motion-of-loads", facts);
    let (mut cells, mut heights) = (Vec::new(), Vec::new());
    for one in &beside.over_time {
        let (row, count) = (heights.len(), one.absorbers.len());
        heights.extend(vec![if count > 1 { 1.0 } else { OF_ONE }; count]);
        cells.push([0, row, 1, count]);
        cells.extend((0..count).map(|k| [1, row + k, 1, 1]));
        figure = figure.with_panel(displaced(case, units, one));
        let each = (0..count).map(|k| between_walls(case, units, one, k, row + k == 0));
        figure = each.fold(figure, Figure::with_panel);
    }
    let height = 50.0 + 165.0 * heights.iter().sum::<f64>();
    figure.with_size(860, height as u32).with_layout(Layout::cells(&[1.0; 2], &heights, &cells))
}

/// What its caption says of one.
fn told_over_time(case: &ModalCase, one: &OverTime) -> Value {
    let absorbers = one.absorbers.iter();
    json!({
        "load": one.load + 1,
        "at": given(&of::EXCITATION_FREQUENCY, one.at),
        "motion": Motions::id(one.motion),
        "is_worst": one.is_worst,
        "repeats": one.repeats,
        "place": case.places[one.place],
        "absorbers": absorbers.clone().map(|j| j + 1).collect::<Vec<_>>(),
        "there": absorbers.clone().all(|j| case.absorbers[*j].place == one.place),
        "periods": one.periods,
        "impacts": one.impacts.len(),
    })
}

/// An axis of time.
fn time(units: Units, of_motion: &OverTime) -> Axis {
    let end = of_motion.times_s.last().copied().unwrap_or(1.0);
    AxisOf::si(units, &of::TIME).axis([0.0, end])
}

/// The displacement of the place that moves farthest.
fn displaced(case: &ModalCase, units: Units, of_motion: &OverTime) -> Panel {
    let OverTime { times_s, displacement_m, load, at, place, .. } = of_motion;
    let line = times_s.iter().zip(displacement_m).map(|(at, x)| [*at, *x]).collect();
    let frequency = units.text(&of::EXCITATION_FREQUENCY, *at);
    // Beside several others its number is enough.
    let on = match case.loads.len() {
        1 => heading(case, *load, &case.loads[*load]),
        _ => format!("load {}", load + 1),
    };
    Panel::new(time(units, of_motion), AxisOf::si(units, &of::DISPLACEMENT).axis(FITTED))
        .with(Layer::curve(Role::Simulation, line))
        .with_heading(format!("{}, {on}, {frequency}", self::place(case, *place)))
}

/// One of the absorbers that are shown between its walls; what is drawn is `named` in one panel.
fn between_walls(
    case: &ModalCase,
    units: Units,
    of_motion: &OverTime,
    index: usize,
    named: bool,
) -> Panel {
    let OverTime { times_s, gaps_m, absorbers, impacts, .. } = of_motion;
    let number = absorbers[index];
    let clearance = case.absorbers[number].clearance_m;
    let most = BEHIND_WALLS * clearance;
    let y = AxisOf::si(units, &of::RELATIVE_DISPLACEMENT).axis([-most, most]);
    let line = times_s.iter().zip(&gaps_m[index]).map(|(at, gap)| [*at, *gap]).collect();
    let own: Vec<&LoadImpact> = impacts.iter().filter(|one| one.absorber == number + 1).collect();
    let mark = |one: &&LoadImpact| {
        let [time, speed] = [(&of::TIME, one.time_s), (&of::IMPACT_SPEED, one.speed())]
            .map(|(kind, value)| units.text(kind, value));
        let tip = (own.len() <= TOOLTIPS).then(|| format!("impact: t = {time}, speed {speed}"));
        let mark = MarkedPoint::new(one.time_s, one.side.sign() * clearance);
        MarkedPoint { tooltip: tip, ..mark }
    };
    let marks = Layer::points(Role::Impact, own.iter().map(mark));
    let wall = Layer::horizontal(clearance, Role::Guide);
    let [wall, marks] = match named {
        true => [wall.labelled("walls"), marks.labelled("impacts")],
        false => [wall, marks],
    };
    Panel::new(time(units, of_motion), y)
        .with(wall)
        .with(Layer::horizontal(-clearance, Role::Guide))
        .with(Layer::curve(Role::Simulation, line))
        .with(marks)
        .with_heading(format!("absorber {}", number + 1))
}
