//! What an absorber and a tuned mass damper come to as the structure's natural frequency drifts, and as the amplitude
//! changes.

use serde_json::Value;

use super::chart::AxisOf;
use super::figure::{Color, Dash, Figure, Layer, Marker, Panel, Role, Shape, Style};
use super::transient::DAMPER;
use crate::alternatives::{Alternatives, Dampers, Which};
use crate::case::Case;
use crate::measure::{Device, Measure};
use crate::operating_range::{Combined, HoldsFor, Together, Varied};
use crate::quantity::catalogue as of;
use crate::quantity::{Kind, Units};

/// A damper in the absorber's room.
const EQUAL: Style = Style::new(Color::SkyBlue, 1.1, Dash::Solid);
/// What is asked.
const LIMIT: Style = Style::new(Color::Vermillion, 1.3, Dash::Dashed);
/// The name of the figure, which stands beside its table.
pub const NAME: &str = "choice";

/// That over the amplitude of what excites the structure.
const AMPLITUDE: &str = "choice-amplitude";

/// That over the amplitude and the natural frequency.
const COMBINED: &str = "choice-combined";
/// What criteria come to, as marks.
const OUTCOMES: [(Together, Marker, Color, &str); 3] = [
    (Together::Hold, Marker::filled(Shape::Circle).sized(11.0), Color::BluishGreen, "all hold"),
    (Together::Undecided, Marker::hollow(Shape::Circle).sized(11.0), Color::Black, "not decided"),
    (Together::Fail, Marker::filled(Shape::Cross).sized(11.0), Color::Vermillion, "one fails"),
];
/// What holds while one number alone changes.
const ALONE: Style = Style::new(Color::BluishGreen, 1.4, Dash::Solid);
/// Room beyond the outermost marks, over their distance.
const ROOM: f64 = 0.12;

/// What was asked over the amplitude, where ranges were looked for and the first criterion is about it: places along the
/// range and beyond it with the absorber, lines in proportion to the amplitude for what is linear.
pub fn over_amplitude(
    case: &Case,
    found: &Alternatives,
    ranges: &[HoldsFor],
    facts: &Value,
) -> Option<Figure> {
    let along = ranges.iter().find(|one| one.parameter == Varied::Amplitude)?;
    let asked = case.criteria.first().filter(|one| one.measure == found.measure)?;
    let parameter = along.parameter.parameter(case)?;
    let (first, last) = (along.reached.first()?[0], along.reached.last()?[0]);
    // A time to come to rest does not grow with the amplitude in proportion.
    let linear = |which: Which| {
        let row = found.row(which, 0.0).filter(|_| found.measure != Measure::DecayTime)?;
        let [value, _] = row.worst;
        Some([first, last].map(|at| [at, value * at / along.value]).to_vec())
    };
    let largest = along.reached.iter().map(|one| one[1]).fold(asked.limit, f64::max);
    let x = AxisOf::si(case.units(), case.design.kind(parameter)).axis([first, last]);
    let kind = found.measure.kind(Device::Absorber)?;
    let y = AxisOf::si(case.units(), kind).axis([0.0, 1.1 * largest]);
    let line = |style: Style, which, name: &str| {
        linear(which).map(|points| Layer::curve(style, points).labelled(name))
    };
    let lines = [
        line(Role::BareOscillator.style(), Which::NoAbsorber, "without absorber"),
        line(DAMPER, Which::Damper, "tuned mass damper"),
    ];
    let panel = lines.into_iter().flatten().fold(Panel::new(x, y), Panel::with);
    // A reduction asks for a share of what the structure does without absorber.
    let steady = case.design.transient().is_none() && found.measure == Measure::Peak;
    let reduction = case.criteria.iter().find(|one| steady && one.measure == Measure::ReductionDb);
    let share = reduction.map(|one| libm::exp10(-one.limit / 20.0));
    let reduced = share.zip(linear(Which::NoAbsorber)).map(|(share, bare)| {
        let points = bare.into_iter().map(|[at, value]| [at, share * value]).collect();
        Layer::curve(LIMIT, points).labelled("limit of the reduction")
    });
    let panel = reduced.into_iter().fold(panel, Panel::with);
    let panel = panel
        .with(Layer::horizontal(asked.limit, LIMIT).labelled("limit"))
        .with(Layer::points(Role::Simulation, along.reached.clone()).labelled("absorber"));
    let here = along.reached.iter().find(|one| one[0] == along.value);
    let panel = match here {
        Some(here) => panel.with(Layer::this_case(*here, None)),
        None => panel,
    };
    Some(
        Figure::new(AMPLITUDE, "")
            .with_panel(panel)
            .with_facts("captions/choice-amplitude", facts.clone()),
    )
}

/// Where criteria hold with another amplitude and another natural frequency at once, numbers of these kinds whose own values are
/// given, and lines along which all hold one at a time; none where that was not looked for.
pub fn combined_panel(
    units: Units,
    kinds: [&'static Kind; 2],
    [amplitude, frequency]: [f64; 2],
    found: &[Combined],
    hold: [Option<[f64; 2]>; 2],
) -> Option<Panel> {
    let (first, last) = (found.first()?, found.last()?);
    let [x, y] = [0, 1].map(|k| {
        let own = [amplitude, frequency][k];
        let ends = [first.at[k].min(own), last.at[k].max(own)];
        let room = ROOM * (ends[1] - ends[0]);
        AxisOf::si(units, kinds[k]).axis([ends[0] - room, ends[1] + room])
    });
    let marks = OUTCOMES.into_iter().map(|(outcome, marker, color, name)| {
        let there = found.iter().filter(|one| one.outcome == outcome).map(|one| one.at);
        Layer::marked(marker, color, there).labelled(name)
    });
    let panel = match hold {
        [Some(amplitudes), Some(frequencies)] => Panel::new(x, y)
            .with(
                Layer::curve(ALONE, amplitudes.map(|end| [end, frequency]).to_vec())
                    .labelled("all hold, one alone"),
            )
            .with(Layer::curve(ALONE, frequencies.map(|end| [amplitude, end]).to_vec())),
        _ => Panel::new(x, y),
    };
    let panel = marks.fold(panel, Panel::with);
    Some(panel.with(Layer::this_case([amplitude, frequency], None)))
}

/// The figure of such panels; none where there are none.
pub fn combined(panels: Vec<Panel>, facts: &Value) -> Option<Figure> {
    let any = !panels.is_empty();
    let figure = panels.into_iter().fold(Figure::new(COMBINED, ""), Figure::with_panel);
    any.then(|| figure.with_facts("captions/choice-combined", facts.clone()))
}

/// The panel of a case of one mode.
pub fn combined_of(case: &Case, found: &[Combined], ranges: &[HoldsFor]) -> Option<Panel> {
    let parameters = Varied::FIRST.map(|varied| varied.parameter(case));
    let [Some(amplitude), Some(frequency)] = parameters else { return None };
    let own = [amplitude, frequency].map(|parameter| case.design.value(parameter));
    let [Some(a), Some(f)] = own else { return None };
    let kinds = [amplitude, frequency].map(|parameter| case.design.kind(parameter));
    let hold = Varied::FIRST.map(|one| ranges.iter().find(|range| range.parameter == one)?.holds);
    combined_panel(case.units(), kinds, [a, f], found, hold)
}

/// The figure over the drift, of a case with such units of pages; none where the frequency of a structure cannot drift.
pub fn figure<D: Dampers>(units: Units, found: &Alternatives<D>, facts: &Value) -> Option<Figure> {
    let over = &found.over_drift;
    let (first, last) = (over.absorber.first()?.0, over.absorber.last()?.0);
    if first == last {
        return None;
    }
    let absorber: Vec<[f64; 2]> =
        over.absorber.iter().map(|(drift, [value, _])| [*drift, *value]).collect();
    let all = over.dampers.iter().flatten().chain(&absorber).map(|one| one[1]);
    let largest = all.chain(found.limit).filter(|one| one.is_finite()).fold(0.0, f64::max);
    let x = AxisOf::si(units, &of::FREQUENCY_DRIFT).axis([first, last]);
    let y = AxisOf::si(units, found.measure.kind(Device::Absorber)?).axis([0.0, 1.1 * largest]);
    let [usual, equal] = over.dampers.clone();
    // Between what is computed at a few places nothing is known.
    let few = usual.len() == absorber.len();
    let line = |style: Style, shape, points: Vec<[f64; 2]>| match few {
        true => Layer::marked(Marker::hollow(shape), style.color, points),
        false => Layer::curve(style, points),
    };
    let several = found.row(Which::Damper, 0.0).and_then(|row| row.damper.as_ref());
    let best = match several.map_or(1, |one| one.each().len()) {
        1 => "tuned mass damper, best for this",
        _ => "tuned mass dampers, best for this",
    };
    let panel = Panel::new(x, y)
        .with(line(DAMPER, Shape::Square, usual).labelled(best))
        .with(line(EQUAL, Shape::Diamond, equal).labelled("in the absorber's room"))
        .with(Layer::points(Role::Simulation, absorber).labelled("absorber"));
    let limit = found.limit.map(|limit| Layer::horizontal(limit, LIMIT).labelled("limit"));
    let panel = limit.into_iter().fold(panel, Panel::with);
    Some(Figure::new(NAME, "").with_panel(panel).with_facts("captions/choice", facts.clone()))
}
