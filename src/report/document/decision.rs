//! What decides whether an absorber is taken, as data: the devices beside it and who wins, how far each number may change,
//! with which probability the criteria hold, and edges.

use serde::Serialize;
use serde_json::{Map, Value, json};

use super::criteria::criterion;
use super::scale::Scale;
use crate::alternatives::{Alternatives, Dampers, Row, Which};
use crate::answer::Answer;
use crate::case::Case;
use crate::criteria::kept_without_absorber;
use crate::linear::TunedMassDamper;
use crate::measure::{Device, Measure};
use crate::method::Method::{self, ClosedForm};
use crate::operating_range::{Combined, Edge, HoldsFor, Reliability, Uncertain, Varied};
use crate::quantity::catalogue as of;
use crate::quantity::{Kind, Quantity};

/// Relative difference up to which two devices are as good as each other: half a decibel.
const AS_GOOD: f64 = 0.05;

/// Which of two devices is the better one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
enum Winner {
    Absorber,
    Damper,
    /// Neither by more than half a decibel, or by more than its error.
    Neither,
}

impl Winner {
    fn of<D>(absorber: &Row<D>, damper: &Row<D>) -> Self {
        let [worst, error] = absorber.worst;
        let other = damper.worst[0];
        if worst + error < other * (1.0 - AS_GOOD) {
            Self::Absorber
        } else if worst > other * (1.0 + AS_GOOD) {
            Self::Damper
        } else {
            Self::Neither
        }
    }
}

impl<D> Alternatives<D> {
    fn kind(&self, device: Device) -> &'static Kind {
        self.measure.kind(device).unwrap_or(&of::PEAK)
    }

    fn worst(&self, row: &Row<D>) -> Quantity {
        let method = if row.device == Device::Absorber { Method::Simulation } else { ClosedForm };
        Quantity::new(self.kind(row.device), row.worst[0], method).with_error(row.worst[1])
    }
}

/// Gives a document of a case what decides whether its absorber is taken: rows as CONTRACT.md has them, and the facts of
/// the templates.
pub fn decide(document: &mut Value, case: &Case, answer: &Answer) {
    // As it was not asked for.
    let decided = answer.alternatives.is_some() || answer.reliability.is_some();
    if !decided && answer.holds_for.is_empty() {
        return;
    }
    let physical = case.units().physical;
    let damper = |row: &Row| damper(&Scale::of(case), row);
    let of = Devices { physical, kept_alone: kept_without_absorber(case), damper: &damper };
    let found = answer.alternatives.as_ref().map(|found| alternatives(found, &of));
    (document["alternatives"], document["choice"]) = found.unwrap_or_default();
    let ranges = answer.holds_for.iter();
    let ranges = ranges.map(|one| range(one, kind_of(case, one.parameter), physical));
    let (rows, ranges): (Vec<Value>, Vec<Value>) = ranges.unzip();
    document["holds_for"] = json!(rows);
    let kinds = Varied::FIRST.map(|varied| kind_of(case, varied));
    document["combined"] = answer.combined.iter().map(|one| together(one, kinds)).collect();
    document["ranges"] = json!(ranges);
    let told = |one: &Uncertain| {
        let value = case.design.value(one.parameter).unwrap_or_default();
        json!({ "value": Quantity::new(case.design.kind(one.parameter), value, Method::Given) })
    };
    document["reliability"] = json!(answer.reliability.as_ref().map(|one| reliability(one, &told)));
}

/// What alternatives are of.
pub struct Devices<'a, D> {
    /// Whether it is in SI.
    pub physical: bool,
    /// Whether all limits are kept without any device.
    pub kept_alone: bool,
    /// What is said of the dampers of a row beside what they do.
    pub damper: &'a dyn Fn(&Row<D>) -> Map<String, Value>,
}

/// The devices beside the absorbers as CONTRACT.md has them, and who wins where.
pub fn alternatives<D: Dampers>(found: &Alternatives<D>, of: &Devices<'_, D>) -> (Value, Value) {
    (found.rows.iter().map(|row| told(found, row, of)).collect(), choice(found, of))
}

/// Which device wins where.
fn choice<D: Dampers>(found: &Alternatives<D>, of: &Devices<'_, D>) -> Value {
    let mut devices: Vec<(Which, usize)> = Vec::new();
    for one in found.rows.iter().map(|row| (row.which(), count(row))) {
        if !devices.contains(&one) {
            devices.push(one);
        }
    }
    let own = |drift| found.row(Which::Absorber, drift);
    let all = found.rows.iter().filter(|row| row.which() == Which::Absorber);
    let drifts: Vec<f64> = all.map(|row| row.drift).collect();
    let winner = |which, drift| Some(Winner::of(own(drift)?, found.row(which, drift)?));
    let robust = |drift: f64| winner(Which::RobustDamper, drift).filter(|_| drift > 0.0);
    let drift = |value: f64| Quantity::new(&of::FREQUENCY_DRIFT, value, Method::Given);
    // From the first on from which it wins at all that are further.
    let lost = drifts.iter().rposition(|one| winner(Which::Damper, *one) != Some(Winner::Absorber));
    let harms = |one: &f64| winner(Which::NoAbsorber, *one) == Some(Winner::Damper);
    let harmful: Vec<f64> = drifts.iter().skip(1).copied().filter(harms).collect();
    // To be better than a damper is nothing where no device is better still.
    let wins_from = drifts.get(lost.map_or(0, |last| last + 1)).filter(|one| !harms(one));
    let kind = found.kind(Device::Absorber);
    let usual = found.row(Which::Damper, 0.0).map_or(0, count);
    let mut choice = json!({
        "of_time": found.measure == Measure::DecayTime,
        "limit": found.limit.map(|limit| Quantity::new(kind, limit, Method::Given)),
        "strokes": devices.iter().map(|one| largest_stroke(found, *one)).collect::<Vec<_>>(),
        // Of the damper that is best for the case.
        "damper_stroke": largest_stroke(found, (Which::Damper, usual)),
        "kept_alone": of.kept_alone,
        "inactive": found.inactive,
        "devices": devices.iter().map(|(which, _)| which).collect::<Vec<_>>(),
        "drifts": drifts.iter().skip(1).map(|one| drift(*one)).collect::<Vec<_>>(),
        "winner": winner(Which::Damper, 0.0),
        "winner_in_equal_room": winner(Which::DamperInEqualRoom, 0.0),
        "winner_without_medium": winner(Which::DamperWithoutMedium, 0.0),
        "winner_changed": winner(Which::DamperOfChangedFrequency, 0.0),
        // The least drift from which on the absorber is the better one.
        "wins_from": wins_from.map(|one| drift(*one)),
        // Those at which it is worse than no device.
        "harmful": harmful.into_iter().map(drift).collect::<Vec<_>>(),
        "robust_winner": drifts.last().and_then(|last| robust(*last)),
    });
    if devices.iter().any(|(_, dampers)| *dampers > 1) {
        // How many each of the devices is.
        choice["dampers"] = devices.iter().map(|(_, dampers)| *dampers).collect();
    }
    choice
}

/// How many dampers a row is of.
fn count<D: Dampers>(row: &Row<D>) -> usize {
    row.damper.as_ref().map_or(0, |one| one.each().len())
}

/// A row as CONTRACT.md has it; its numbers are quantities, by which two reports are compared.
fn told<D: Dampers>(found: &Alternatives<D>, row: &Row<D>, of: &Devices<'_, D>) -> Value {
    let with_unit = |quantity: Quantity| with_unit(quantity, of.physical);
    let mut told = json!({
        "which": row.which(),
        "device": row.device.word(),
        "dampers": count(row),
        "room": row.room,
        "robust_for": row.robust_for,
        "damping": if row.given_damping.is_some() { "given" } else { "designed" },
        "drift": row.drift,
        "worst": with_unit(found.worst(row)),
        "stroke": stroke(row).map(with_unit),
    });
    told.as_object_mut().into_iter().for_each(|of_row| of_row.extend((of.damper)(row)));
    told
}

/// What is said of the damper of a row of one mode.
fn damper(scale: &Scale, row: &Row) -> Map<String, Value> {
    let damping_ratio = |damper: TunedMassDamper| {
        let ratio = |method| Quantity::new(&of::DAMPER_DAMPING_RATIO, damper.damping_ratio, method);
        match row.given_damping {
            Some(_) => ratio(Method::Given),
            None => designed::<TunedMassDamper>(ratio(ClosedForm)),
        }
    };
    let frequency =
        |one: TunedMassDamper| designed::<TunedMassDamper>(scale.damper_frequency(one.tuning));
    let fields = [
        ("frequency", json!(row.damper.map(frequency))),
        ("damping_ratio", json!(row.damper.map(damping_ratio))),
        // What it is where the search for it ended at a bound.
        ("at_bound", json!(row.at_bound())),
    ];
    fields.map(|(key, value)| (key.to_owned(), value)).into_iter().collect()
}

/// A number of dampers, with the error of their design.
pub fn designed<D: Dampers>(quantity: Quantity) -> Quantity {
    quantity.with_error(D::DESIGN * quantity.value)
}

fn with_unit(quantity: Quantity, physical: bool) -> Value {
    let mut told = json!(quantity);
    told["unit"] = json!(quantity.kind.dimension.symbol(physical));
    told
}

/// Displacement of a device against the structure: an absorber has its clearance.
fn stroke<D: Dampers>(row: &Row<D>) -> Option<Quantity> {
    let stroke = row.stroke?;
    Some(match row.device {
        Device::Absorber => Quantity::new(&of::CLEARANCE, stroke, Method::Given),
        _ => designed::<D>(Quantity::new(&of::DAMPER_STROKE, stroke, ClosedForm)),
    })
}

/// The stroke of a device where the structure is off by as much as makes it largest.
fn largest_stroke<D: Dampers>(
    found: &Alternatives<D>,
    (which, dampers): (Which, usize),
) -> Option<Quantity> {
    let rows = found.rows.iter().filter(|row| row.which() == which && count(row) == dampers);
    rows.filter_map(stroke).max_by(|a, b| a.value.total_cmp(&b.value))
}

/// With which probability all criteria hold, and what makes most designs fail: each of these as `told`, with how many.
pub fn reliability(found: &Reliability, told: &dyn Fn(&Uncertain) -> Value) -> Value {
    let probability = |value| Quantity::new(&of::PROBABILITY, value, Method::Simulation);
    let (share, interval) = found.probability();
    let error = interval.map(|end| (end - share).abs()).into_iter().fold(0.0, f64::max);
    let cause = |(one, times): &(Uncertain, u32)| {
        let mut row = told(one);
        row["parameter"] = json!(one.parameter.key());
        row["failures"] = json!(times);
        row
    };
    json!({
        "probability": probability(share).with_error(error),
        "interval": interval.map(probability),
        "samples": found.samples,
        "hold": found.hold,
        "undecided": found.undecided,
        "fail": found.samples - found.hold - found.undecided,
        "examined": found.examined,
        "causes": found.causes.iter().map(cause).collect::<Vec<_>>(),
    })
}

/// What a number of a case is whose range is looked for.
fn kind_of(case: &Case, varied: Varied) -> &'static Kind {
    varied.parameter(case).map_or(&of::NATURAL_FREQUENCY, |one| case.design.kind(one))
}

/// Edges of a case: the number, where it is and where a criterion fails, what that comes to there and in the case, and
/// what was asked; an empty text where nobody did.
pub fn edges(case: &Case, found: &[Edge]) -> Value {
    let row = |edge: &Edge| {
        let number = |value| Quantity::new(kind_of(case, edge.parameter), value, Method::Given);
        let value = |value: f64, error: f64| {
            let kind = edge.fails.criterion.measure.kind_under(edge.fails.records)?;
            Some(Quantity::new(kind, value, edge.fails.decided_by).with_error(error))
        };
        let told = criterion(case, &edge.fails);
        json!({
            "parameter": edge.parameter,
            "value": with_unit(number(edge.value), case.units().physical),
            "at": with_unit(number(edge.at), case.units().physical),
            "criterion": told["name"],
            "asked": told["asked"],
            "limit": told["limit"],
            "found": edge.fails.found.and_then(|found| value(found, edge.fails.error)),
            "instead": edge.instead.and_then(|found| value(found, 0.0)),
        })
    };
    found.iter().map(row).collect()
}

/// What holds for another amplitude and another natural frequency at once, numbers of these kinds.
pub fn together(found: &Combined, kinds: [&'static Kind; 2]) -> Value {
    let [amplitude, frequency] =
        [0, 1].map(|k| Quantity::new(kinds[k], found.at[k], Method::Given));
    json!({
        "amplitude": amplitude,
        "natural_frequency": frequency,
        "promised": found.promised,
        "outcome": found.outcome,
    })
}

/// How far the promise holds for a number: its row as CONTRACT.md has it, and quantities for a page.
pub fn range(found: &HoldsFor, kind: &'static Kind, physical: bool) -> (Value, Value) {
    let quantity = |value: f64| Quantity::new(kind, value, Method::Simulation);
    let change =
        |end: f64| Quantity::new(&of::RELATIVE_CHANGE, end / found.value - 1.0, Method::Simulation);
    let row = json!({
        "parameter": found.parameter,
        "unit": kind.dimension.symbol(physical),
        "value": found.value,
        "from": found.range[0],
        "to": found.range[1],
        "from_open": found.open[0],
        "to_open": found.open[1],
        "holds": found.holds,
        "tried": found.tried,
        "undecided": found.undecided,
        "further": [],
    });
    let told = json!({
        "parameter": found.parameter,
        "value": quantity(found.value),
        "from": quantity(found.range[0]),
        "to": quantity(found.range[1]),
        "from_open": found.open[0],
        "to_open": found.open[1],
        "holds": found.holds.map(|ends| ends.map(quantity)),
        // Designs that were judged as the case itself, in what holds.
        "tried": found.tried.len(),
        // By how much of itself the number may be off.
        "off": found.holds.filter(|_| found.value != 0.0).map(|ends| ends.map(change)),
        "only_here": found.holds == Some([found.value; 2]),
        // At its ends.
        "kept_alone": found.kept_alone,
        "undecided": found.undecided.iter().map(|ends| ends.map(quantity)).collect::<Vec<_>>(),
    });
    (row, told)
}
