//! The largest displacement under each load, over the frequency and over the amplitude, and the motion that has it over time, drawn.

use serde_json::{Value, json};

use super::{Beside, given, units};
use crate::case::{ActsOn, Load, ModalCase, Of};
use crate::linear::ModalDamper;
use crate::measure::Measure;
use crate::modal::{LoadImpact, ModalAnswer, OverForce, OverTime, linear_peak, linear_places};
use crate::motions::{ModalMotion, Motions};
use crate::quantity::Units;
use crate::quantity::catalogue as of;
use crate::report::chart::{AxisOf, FITTED};
use crate::report::figure::{
    Axis, AxisScale, Color, Dash, Figure, Layer, Layout, MarkedPoint, Marker, Panel, Role, Shape,
    Style,
};
use crate::report::transient::DAMPER;
use crate::simulation::Reading;

/// Several tuned mass dampers.
const DAMPERS: Style = Style::new(Color::SkyBlue, 1.1, Dash::Solid);
/// What is asked.
const LIMIT: Style = Style::new(Color::Vermillion, 1.3, Dash::Dashed);

/// Largest displacement of any place over the frequency, a panel for each load.
pub(super) fn loads(
    case: &ModalCase,
    answer: &ModalAnswer,
    beside: &Beside,
    facts: &Value,
) -> Figure {
    let units = units(case);
    let mut figure = Figure::new("loads", "");
    for (k, along) in answer.along.iter().enumerate() {
        let [from, to] = along.load.range_hz;
        if from == to {
            continue;
        }
        let highest = along.places.iter().flat_map(|one| &one.motions);
        let highest = highest.map(most).fold(0.0, f64::max);
        let limits = limits(case, answer.worst(case, Some(k)).map(|one| one.found.of));
        let top = 1.15 * limits.iter().map(|one| one.0).fold(highest, f64::max);
        let x = AxisOf::si(units, &of::EXCITATION_FREQUENCY).axis([from, to]);
        let y = AxisOf::si(units, &of::PEAK).axis([0.0, top]);
        let curve = |of: &dyn Fn(f64) -> f64| -> Vec<[f64; 2]> {
            linear_places(along.load.range_hz, case).into_iter().map(|at| [at, of(at)]).collect()
        };
        let linear =
            |dampers: &[ModalDamper]| curve(&|at| linear_peak(case, &along.load, at, dampers));
        let mut panel = Panel::new(x, y)
            .with(Layer::curve(Role::BareOscillator, linear(&[])).labelled("without absorbers"));
        for (choice, style) in beside.dampers.iter().zip([DAMPER, DAMPERS]) {
            let dampers = choice.dampers.on(case, 1.0);
            let name = match dampers.len() {
                1 => "one tuned mass damper".to_owned(),
                many => format!("{many} tuned mass dampers"),
            };
            panel = panel.with(Layer::curve(style, linear(&dampers)).labelled(name));
        }
        panel = with_limits(panel, &limits);
        // Not those in which every absorber rests, which are on the line without them.
        let seen = along.places.iter().flat_map(|one| {
            let acts = |motion: &&ModalMotion| !motion.rests();
            one.motions.iter().filter(acts).map(move |motion| [one.at, most(motion)])
        });
        let marker = Marker::filled(Shape::Circle).sized(5.0);
        panel = panel.with(
            Layer::marked(marker, Role::Simulation.color(), seen.collect::<Vec<_>>())
                .labelled("with absorbers"),
        );
        figure = figure.with_panel(panel.with_heading(heading(case, k, &along.load)));
    }
    in_rows(figure).with_facts("captions/loads", facts.clone())
}

/// Width of the bar of an absorber with the free room beside it, over that of the panel.
const BAR: f64 = 0.03;
/// An absorber at work.
const WORKS: Style = Style::new(Color::BluishGreen, 6.0, Dash::Solid);

/// Largest displacement of any place over the amplitude of each load, with a bar between the displacements at which each absorber
/// works.
pub(super) fn forces(
    case: &ModalCase,
    answer: &ModalAnswer,
    beside: &Beside,
    facts: &Value,
) -> Figure {
    let units = units(case);
    let mut figure = Figure::new("forces", "");
    for (k, (load, found)) in case.loads.iter().zip(&beside.forces).enumerate() {
        let Some(OverForce { steps, working, .. }) = found else { continue };
        let [Some(first), Some(last)] = [steps.first(), steps.last()] else { continue };
        let seen = |acts: bool| {
            let each = steps.iter().flat_map(move |step| {
                let motions = step.motions.iter().filter(move |one| !(acts && one.rests()));
                motions.map(move |one| [step.times * load.amplitude, most(one)])
            });
            each.collect::<Vec<_>>()
        };
        let limits = limits(case, answer.worst(case, Some(k)).map(|one| one.found.of));
        // An absorber may work far above what is seen, and how far beyond a limit decides nothing.
        let most = seen(false).into_iter().map(|[_, y]| y).fold(0.0, f64::max);
        let top = 1.15 * limits.last().map_or(most, |(limit, _)| most.clamp(*limit, 3.0 * limit));
        let range = [first.times, last.times].map(|times| times * load.amplitude);
        let mut x = AxisOf::si(units, load.amplitude_kind()).axis(range);
        x.scale = AxisScale::Log;
        let y = AxisOf::si(units, &of::PEAK).axis([0.0, top]);
        let bare = steps.iter().map(|step| [step.times * load.amplitude, step.bare]).collect();
        let mut panel = Panel::new(x, y)
            .with(Layer::curve(Role::BareOscillator, bare).labelled("without absorbers"))
            .with(Layer::vertical(load.amplitude, Role::Forcing).labelled("the load"));
        panel = with_limits(panel, &limits);
        for (j, range_of) in working.iter().enumerate() {
            let Some([from, to]) = range_of.filter(|[from, _]| *from < top) else { continue };
            // From the right edge on, evenly on a logarithmic axis.
            let part = 1.0 - BAR * (1 + j) as f64;
            let at = range[0] * libm::pow(range[1] / range[0], part);
            let bar = Layer::curve(WORKS, vec![[at, from], [at, to]]);
            panel = match case.absorbers.len() {
                1 => panel.with(bar.labelled("the absorber works")),
                _ => panel
                    .with(bar)
                    .with(Layer::note([at, to.min(0.9 * top) + 0.05 * top], (j + 1).to_string())),
            };
        }
        let marker = Marker::filled(Shape::Circle).sized(5.0);
        let points = Layer::marked(marker, Role::Simulation.color(), seen(true));
        panel = panel.with(points.labelled("with absorbers"));
        figure = figure.with_panel(panel.with_heading(heading(case, k, load)));
    }
    in_rows(figure).with_facts("captions/forces", facts.clone())
}

/// Absorbers that are shown together, in turn.
const ABSORBERS: [Color; 4] =
    [Color::ReddishPurple, Color::Blue, Color::BluishGreen, Color::Orange];
/// Up to so many impacts of a panel have a tooltip.
const TOOLTIPS: usize = 40;
/// Room beside the walls, over the clearance.
const BEYOND_WALLS: f64 = 1.35;

/// The motion in which the structure moves farthest under each load, over time: its displacement, and beside that the absorbers between
/// their walls.
pub(super) fn over_time(case: &ModalCase, beside: &Beside, facts: &Value) -> Figure {
    let (units, count) = (units(case), beside.over_time.len());
    let cells: Vec<[usize; 4]> =
        (0..count).flat_map(|row| [[0, row, 1, 1], [1, row, 1, 1]]).collect();
    let height = 50 + 230 * u32::try_from(count.max(1)).unwrap_or(1);
    let mut facts = facts.clone();
    facts["over_time"] = beside.over_time.iter().map(|one| told_over_time(case, one)).collect();
    let figure = Figure::new("motion", "")
        .with_size(860, height)
        .with_layout(Layout::cells(&[1.0, 1.0], &vec![1.0; count.max(1)], &cells))
        .with_facts("captions/motion-of-loads", facts);
    beside.over_time.iter().fold(figure, |figure, one| {
        figure.with_panel(displaced(case, units, one)).with_panel(between_walls(case, units, one))
    })
}

/// What its caption says of one.
fn told_over_time(case: &ModalCase, one: &OverTime) -> Value {
    let absorbers = one.absorbers.iter();
    json!({
        "load": one.load + 1,
        "at": given(&of::EXCITATION_FREQUENCY, one.at),
        "motion": Motions::id(one.motion),
        "is_worst": one.is_worst,
        "place": case.places[one.place],
        "absorbers": absorbers.clone().map(|j| j + 1).collect::<Vec<_>>(),
        "there": absorbers.into_iter().all(|j| case.absorbers[*j].place == one.place),
        "periods": one.periods,
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
    let on = heading(case, *load, &case.loads[*load]);
    Panel::new(time(units, of_motion), AxisOf::si(units, &of::DISPLACEMENT).axis(FITTED))
        .with(Layer::curve(Role::BareOscillator.style().colored(Color::Black), line))
        .with_heading(format!("{}, {on}, {frequency}", case.places[*place]))
}

/// The absorbers between their walls.
fn between_walls(case: &ModalCase, units: Units, of_motion: &OverTime) -> Panel {
    let OverTime { times_s, gaps_m, absorbers, impacts, .. } = of_motion;
    let clearance = |j: usize| case.absorbers[j].clearance_m;
    let widest = BEYOND_WALLS * absorbers.iter().map(|j| clearance(*j)).fold(0.0, f64::max);
    let y = AxisOf::si(units, &of::RELATIVE_DISPLACEMENT).axis([-widest, widest]);
    let mut panel = Panel::new(time(units, of_motion), y);
    let several = absorbers.len() > 1;
    let each = || absorbers.iter().zip(ABSORBERS.into_iter().cycle());
    for (j, color) in each() {
        let style = match several {
            true => Style::new(color, 1.1, Dash::Dashed),
            false => Role::Guide.style(),
        };
        let named = if several { format!("walls of {}", j + 1) } else { "walls".to_owned() };
        panel = panel
            .with(Layer::horizontal(clearance(*j), style).labelled(named))
            .with(Layer::horizontal(-clearance(*j), style));
    }
    for ((j, color), gaps) in each().zip(gaps_m) {
        let line = times_s.iter().zip(gaps).map(|(at, gap)| [*at, *gap]).collect();
        let layer = Layer::curve(Role::Simulation.style().colored(color), line);
        panel = panel.with(match several {
            true => layer.labelled(format!("absorber {}", j + 1)),
            false => layer,
        });
    }
    let few = impacts.len() <= TOOLTIPS;
    let mark = |one: &LoadImpact| {
        let gap = one.side.sign() * clearance(one.absorber - 1);
        let [time, speed] = [(&of::TIME, one.time_s), (&of::IMPACT_SPEED, one.speed())]
            .map(|(kind, value)| units.text(kind, value));
        let tip = format!("impact of absorber {}: t = {time}, {speed}", one.absorber);
        MarkedPoint { tooltip: few.then_some(tip), ..MarkedPoint::new(one.time_s, gap) }
    };
    let marks = Layer::points(Role::Impact, impacts.iter().map(mark)).labelled("impacts");
    let listed: Vec<String> = absorbers.iter().map(|j| (j + 1).to_string()).collect();
    let names = if several { "absorbers" } else { "absorber" };
    panel.with(marks).with_heading(format!("{names} {}", listed.join(", ")))
}

/// The largest displacement of any place.
fn most(motion: &ModalMotion) -> f64 {
    motion.read(Reading::Displacement).map(|one| one.peak).fold(0.0, f64::max)
}

/// With its panels below one another.
pub(super) fn in_rows(figure: Figure) -> Figure {
    let count = figure.panels.len().max(1);
    let height = 90 + 250 * u32::try_from(count).unwrap_or(1);
    figure.with_layout(Layout::rows(&vec![1.0; count])).with_size(720, height)
}

/// Limits of displacements of any place or of the one that moves farthest, with their names, the smallest first: each once, by its
/// place where there is more than one.
fn limits(case: &ModalCase, farthest: Option<Of>) -> Vec<(f64, String)> {
    let peaks = case.criteria.iter().filter(|one| {
        one.measure == Measure::Peak && farthest.is_none_or(|farthest| one.of.holds(farthest))
    });
    let mut found: Vec<(f64, Of)> = peaks.map(|one| (one.limit, one.of)).collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found.dedup_by(|a, b| a.0 == b.0);
    let several = found.len() > 1;
    let named = |(limit, of): (f64, Of)| match of {
        Of::Place(place) if several => (limit, format!("limit at {}", case.places[place])),
        _ => (limit, "limit".to_owned()),
    };
    found.into_iter().map(named).collect()
}

/// With a line for each of them.
fn with_limits(panel: Panel, limits: &[(f64, String)]) -> Panel {
    limits.iter().fold(panel, |panel, (limit, name)| {
        panel.with(Layer::horizontal(*limit, LIMIT).labelled(name.clone()))
    })
}

pub(super) fn heading(case: &ModalCase, number: usize, load: &Load) -> String {
    let on = match load.on {
        ActsOn::Place(place) => format!("force at {}", case.places[place]),
        ActsOn::Mode(mode) => format!("force in mode {}", mode + 1),
        ActsOn::Modes => "forces in all modes".to_owned(),
        ActsOn::Base => "moving base".to_owned(),
    };
    if case.loads.len() > 1 { format!("load {}: {on}", number + 1) } else { on }
}
