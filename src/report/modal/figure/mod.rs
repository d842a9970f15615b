//! The largest displacement under each load, and what else is asked, over the frequency and over the amplitude, drawn; beside it the
//! motion that has it over time (`over_time.rs`) and the manifolds of absorbers (`manifold.rs`).

mod manifold;
mod over_time;

use std::cmp::Ordering;

use serde_json::{Value, json};

use super::units;
use crate::case::{ActsOn, Load, ModalCase, Of};
use crate::criteria::Judged;
use crate::linear::ModalDamper;
use crate::measure::{Device, Measure};
use crate::method::Method;
use crate::modal::{
    AlongLoad, AtFrequency, Beside, ModalAnswer, ModalOptimum, OverForce, largest_of, linear_at,
    linear_places,
};
use crate::motions::ModalMotion;
use crate::quantity::catalogue as of;
use crate::report::chart::AxisOf;
use crate::report::figure::{
    AxisScale, Color, Dash, Figure, Layer, Layout, Marker, Panel, Role, Shape, Style,
};
use crate::report::transient::DAMPER;
use crate::simulation::Reading;

pub(super) use manifold::manifolds;
pub(super) use over_time::over_time;

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
