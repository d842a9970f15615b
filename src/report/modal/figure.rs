//! The largest displacement under each load, over the frequency and over the amplitude, and the motion that has it over time, drawn.

use std::cmp::Ordering;

use serde_json::{Value, json};

use super::{Beside, given, units};
use crate::case::{ActsOn, Load, ModalCase, Of};
use crate::criteria::Judged;
use crate::linear::ModalDamper;
use crate::measure::{Device, Measure};
use crate::method::Method;
use crate::modal::{
    AbsorberManifold, AlongLoad, AtFrequency, ExactAmplitude, GroupTheory, LoadImpact, LoadTheory,
    ModalAnswer, ModalOptimum, OverForce, OverTime, largest_of, linear_at, linear_places,
};
use crate::motions::{ModalMotion, Motions};
use crate::quantity::Units;
use crate::quantity::catalogue as of;
use crate::report::chart::{AxisOf, FITTED};
use crate::report::figure::{
    Axis, AxisScale, Color, Dash, Figure, Layer, Layout, MarkedPoint, Marker, Panel, Role, Shape,
    Style,
};
use crate::report::figures::parts::{manifold, own_points};
use crate::report::transient::DAMPER;
use crate::simulation::Reading;

/// Several tuned mass dampers.
const DAMPERS: Style = Style::new(Color::SkyBlue, 1.1, Dash::Solid);
/// What is asked.
const LIMIT: Style = Style::new(Color::Vermillion, 1.3, Dash::Dashed);

/// Largest displacement of any place over the frequency, and what else criteria ask of a place; a panel for each load.
pub(super) fn loads(
    case: &ModalCase,
    answer: &ModalAnswer,
    beside: &Beside,
    facts: &Value,
) -> Vec<Figure> {
    let mut asked: Vec<(String, Measure)> = vec![("loads".to_owned(), Measure::Peak)];
    for one in case.criteria.iter().filter(|one| one.measure.is_of_sines()) {
        if !asked.iter().any(|(_, known)| *known == one.measure) {
            asked.push((format!("loads-{}", one.key.replace('_', "-")), one.measure));
        }
    }
    let drawn = |(name, measure): (String, Measure)| {
        of_loads(case, answer, beside, facts, (&name, measure))
    };
    asked.into_iter().map(drawn).collect()
}

/// The figure of a name and a measure.
fn of_loads(
    case: &ModalCase,
    answer: &ModalAnswer,
    beside: &Beside,
    facts: &Value,
    (name, measure): (&str, Measure),
) -> Figure {
    let mut figure = Figure::new(name, "");
    for (k, along) in answer.along.iter().enumerate() {
        let [from, to] = along.load.range_hz;
        if from == to {
            continue;
        }
        let worst = worst(case, answer, k, measure);
        let limits = limits(case, measure, worst.map(|one| one.of));
        let mut panel = over_frequency(case, &[along], measure, &limits);
        for (choice, style) in beside.dampers.iter().zip([DAMPER, DAMPERS]) {
            let dampers = choice.dampers.on(case, 1.0);
            let name = match dampers.len() {
                1 => "one tuned mass damper".to_owned(),
                many => format!("{many} tuned mass dampers"),
            };
            let curve = without(case, &along.load, &dampers, measure);
            panel = panel.with(Layer::curve(style, curve).labelled(name));
        }
        panel = with_limits(panel, &limits);
        let marker = Marker::filled(Shape::Circle).sized(5.0);
        panel = panel.with(
            Layer::marked(marker, Role::Simulation.color(), seen(case, along, measure))
                .labelled("with absorbers"),
        );
        if let Some(Where { at: Some([at, value]), rests: true, .. }) = worst {
            // On the line without them, where it would not be seen as the worst.
            let marker = Marker::hollow(Shape::Circle).sized(7.0);
            let layer = Layer::marked(marker, Role::Simulation.color(), vec![[at, value]]);
            panel = panel.with(layer.labelled("worst: at rest"));
        }
        figure = figure.with_panel(panel.with_heading(heading(case, k, &along.load)));
    }
    let mut facts = facts.clone();
    facts["drawn"] = json!(measure.kind(Device::Absorber).map(|kind| kind.name));
    in_rows(figure).with_facts("captions/loads", facts)
}

/// Where a measure is worst under a load.
#[derive(Clone, Copy)]
struct Where {
    /// Which place has it.
    of: Of,
    /// At which frequency, and what it is there.
    at: Option<[f64; 2]>,
    /// Whether every absorber rests there.
    rests: bool,
}

/// Where a measure is worst under a load: the displacement of any place, or what criteria ask of others.
fn worst(case: &ModalCase, answer: &ModalAnswer, load: usize, measure: Measure) -> Option<Where> {
    if measure == Measure::Peak {
        let worst = answer.worst(case, Some(load))?.found;
        let at = worst.at.map(|at| [at, worst.value]);
        return Some(Where { of: worst.of, at, rests: worst.rests() });
    }
    let own = |one: &&Judged| one.criterion.measure == measure && one.load == load;
    let worst = answer.judged.iter().filter(own);
    let worst = worst.max_by(|a, b| a.found.partial_cmp(&b.found).unwrap_or(Ordering::Equal))?;
    let rests = worst.inactive.is_some() && worst.decided_by == Method::ClosedForm;
    Some(Where { of: worst.of, at: worst.at.zip(worst.found).map(<[f64; 2]>::from), rests })
}

/// The same with the absorbers of a case and with the best others that were found.
pub(super) fn optimum(case: &ModalCase, found: &ModalOptimum, facts: &Value) -> Figure {
    let mut figure = Figure::new("optimize-loads", "");
    let best = found.best.first();
    for (k, own) in found.own.answer.along.iter().enumerate() {
        let [from, to] = own.load.range_hz;
        if from == to {
            continue;
        }
        let other = best.and_then(|best| best.answer.along.get(k));
        let both: Vec<&AlongLoad> = [Some(own), other].into_iter().flatten().collect();
        let measure = Measure::Peak;
        let limits =
            limits(case, measure, worst(case, &found.own.answer, k, measure).map(|one| one.of));
        let mut panel = with_limits(over_frequency(case, &both, measure, &limits), &limits);
        let hollow = Marker::hollow(Shape::Circle).sized(5.0);
        panel = panel.with(
            Layer::marked(hollow, Color::Grey, seen(case, own, measure))
                .labelled("the case's own absorbers"),
        );
        if let Some(other) = other {
            let filled = Marker::filled(Shape::Circle).sized(5.0);
            let name = if found.succeeds() { "the best" } else { "the best of the others" };
            panel = panel.with(
                Layer::marked(filled, Role::Simulation.color(), seen(case, other, measure))
                    .labelled(name),
            );
        }
        figure = figure.with_panel(panel.with_heading(heading(case, k, &own.load)));
    }
    in_rows(figure).with_facts("captions/optimize-loads", facts.clone())
}

/// A panel over the range of a load, high enough for all motions that were found along it and for limits, with what the structure does
/// without absorbers.
fn over_frequency(
    case: &ModalCase,
    along: &[&AlongLoad],
    measure: Measure,
    limits: &[(f64, String)],
) -> Panel {
    let (units, load) = (units(case), &along[0].load);
    let motions = along.iter().flat_map(|one| &one.places).flat_map(|one| &one.motions);
    let found = motions.filter_map(|one| largest_of(case, one, measure, Of::Any));
    let highest = found.map(|one| one[0]).fold(0.0, f64::max);
    let top = 1.15 * limits.iter().map(|one| one.0).fold(highest, f64::max);
    let x = AxisOf::si(units, &of::EXCITATION_FREQUENCY).axis(load.range_hz);
    let kind = measure.kind(Device::Absorber).unwrap_or(&of::PEAK);
    let y = AxisOf::si(units, kind).axis([0.0, top]);
    let bare = Layer::curve(Role::BareOscillator, without(case, load, &[], measure));
    Panel::new(x, y).with(bare.labelled("without absorbers"))
}

/// The largest of a measure of any place over the range of a load without absorbers, with dampers in their place.
fn without(
    case: &ModalCase,
    load: &Load,
    dampers: &[ModalDamper],
    measure: Measure,
) -> Vec<[f64; 2]> {
    let at = linear_places(load.range_hz, case).into_iter();
    at.map(|at| [at, linear_at(case, load, at, dampers, measure)]).collect()
}

/// The largest of a measure in each motion along a load, but for those in which every absorber rests: these are as without them.
fn seen(case: &ModalCase, along: &AlongLoad, measure: Measure) -> Vec<[f64; 2]> {
    let of = |one: &AtFrequency| {
        let acts = one.motions.iter().filter(|motion| !motion.rests());
        let found = acts.filter_map(|motion| largest_of(case, motion, measure, Of::Any));
        found.map(|[value, _]| [one.at, value]).collect::<Vec<_>>()
    };
    along.places.iter().flat_map(of).collect()
}

/// Width of the bar of an absorber with the free room beside it, over that of the panel.
const BAR: f64 = 0.03;
/// What the axis of amplitudes goes on beyond the first and the last, as a factor: marks on its ends would be cut.
const EDGE: f64 = 1.04;
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
        let measure = Measure::Peak;
        let limits = limits(case, measure, worst(case, answer, k, measure).map(|one| one.of));
        // An absorber may work far above what is seen, and how far beyond a limit decides nothing.
        let most = seen(false).into_iter().map(|[_, y]| y).fold(0.0, f64::max);
        let top = 1.15 * limits.last().map_or(most, |(limit, _)| most.clamp(*limit, 3.0 * limit));
        let range = [first.times / EDGE, last.times * EDGE].map(|times| times * load.amplitude);
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

/// Up to so many impacts of a panel have a tooltip.
const TOOLTIPS: usize = 40;
/// Range of a panel over the clearance: its walls have some room behind them.
const BEHIND_WALLS: f64 = 1.35;
/// Height of a panel, in that of one of several absorbers of a load: where there is one.
const OF_ONE: f64 = 1.4;

/// The motion in which the structure moves farthest under each load, over time: its displacement, and beside that each absorber between
/// its walls.
pub(super) fn over_time(case: &ModalCase, beside: &Beside, facts: &Value) -> Figure {
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

/// How far the manifold is drawn beyond symmetry breaking and all points, over the absorber's own clearance.
const BEYOND: f64 = 1.15;
/// Colours of the manifolds of several absorbers.
const MANIFOLDS: [Color; 4] = [Color::Blue, Color::BluishGreen, Color::Orange, Color::Vermillion];

/// The manifolds of the absorbers in the modes that loads drive, with the fixed points of these and exact orbits; a panel for each.
pub(super) fn manifolds(case: &ModalCase, beside: &Beside, facts: &Value) -> Figure {
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

/// Limits of a measure of any place or of the one that has most of it, with their names, the smallest first: each once, by its
/// place where there is more than one.
fn limits(case: &ModalCase, measure: Measure, farthest: Option<Of>) -> Vec<(f64, String)> {
    let peaks = case.criteria.iter().filter(|one| {
        one.measure == measure && farthest.is_none_or(|farthest| one.of.holds(farthest))
    });
    let mut found: Vec<(f64, Of)> = peaks.map(|one| (one.limit, one.of)).collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found.dedup_by(|a, b| a.0 == b.0);
    let several = found.len() > 1 || case.places.len() > 1;
    let named = |(limit, of): (f64, Of)| match of {
        Of::Place(place) if several => (limit, format!("limit at {}", self::place(case, place))),
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

/// Most characters of a place's name in a drawing.
const NAME: usize = 16;

/// The name of a place, cut where it is too long for a drawing.
fn place(case: &ModalCase, number: usize) -> String {
    let name = &case.places[number];
    if name.chars().count() <= NAME {
        return name.clone();
    }
    name.chars().take(NAME - 1).chain(['…']).collect()
}

pub(super) fn heading(case: &ModalCase, number: usize, load: &Load) -> String {
    let on = match load.on {
        ActsOn::Place(place) => format!("force at {}", self::place(case, place)),
        ActsOn::Mode(mode) => format!("force in mode {}", mode + 1),
        ActsOn::Modes => "forces in all modes".to_owned(),
        ActsOn::Base => "moving base".to_owned(),
    };
    if case.loads.len() > 1 { format!("load {}: {on}", number + 1) } else { on }
}
