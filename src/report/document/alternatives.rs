//! What else could be done, as data: rows by device, room and drift, a table of them, and who wins.

use serde::Serialize;
use serde_json::{Value, json};

use super::scale::Scale;
use crate::alternatives::{Alternatives, Room, Row};
use crate::answer::Answer;
use crate::case::Case;
use crate::measure::{Device, Measure};
use crate::method::Method::{self, ClosedForm};
use crate::operating_range::HoldsFor;
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;
use crate::system::Parameter;

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
    fn of(absorber: &Row, damper: &Row) -> Self {
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

impl Alternatives {
    fn kind(&self, device: Device) -> &'static crate::quantity::Kind {
        self.measure.kind(device).unwrap_or(&of::PEAK)
    }

    fn worst(&self, row: &Row) -> Quantity {
        let method = if row.device == Device::Absorber { Method::Simulation } else { ClosedForm };
        Quantity::new(self.kind(row.device), row.worst[0], method).with_error(row.worst[1])
    }
}

/// Gives a document of a case what decides whether its absorber is taken: rows as CONTRACT.md has them, and the facts of
/// the templates.
pub fn decide(document: &mut Value, case: &Case, answer: &Answer) {
    // As it was not asked for.
    if answer.alternatives.is_none() && answer.holds_for.is_empty() {
        return;
    }
    let choice = answer.alternatives.as_ref().map(|one| alternatives(case, one));
    document["alternatives"] = choice.as_ref().map_or(Value::Null, |one| one["rows"].clone());
    document["choice"] = choice.map_or(Value::Null, |mut one| {
        one.as_object_mut().into_iter().for_each(|one| drop(one.remove("rows")));
        one
    });
    let ranges = holds_for(case, &answer.holds_for);
    document["holds_for"] = ranges.iter().map(|one| one["row"].clone()).collect();
    document["ranges"] = json!(ranges);
}

/// What else could be done.
fn alternatives(case: &Case, found: &Alternatives) -> Value {
    let drifts: Vec<f64> = found
        .rows
        .iter()
        .filter(|row| row.device == Device::Absorber)
        .map(|row| row.drift)
        .collect();
    let at = |device, room, drift: f64| found.row(device, room, drift);
    let winner = |room, drift| {
        let absorber = at(Device::Absorber, Room::AsDesigned, drift)?;
        Some(Winner::of(absorber, at(Device::Damper, room, drift)?))
    };
    let robust = |drift: f64| {
        let absorber = at(Device::Absorber, Room::AsDesigned, drift)?;
        let damper = found.rows.iter().find(|row| row.robust_for == drift && drift > 0.0)?;
        Some(Winner::of(absorber, damper))
    };
    let with = |is: fn(&Row) -> bool| {
        let damper = found.rows.iter().find(|row| row.drift == 0.0 && is(row))?;
        Some(Winner::of(at(Device::Absorber, Room::AsDesigned, 0.0)?, damper))
    };
    let drift = |value: f64| Quantity::new(&of::FREQUENCY_DRIFT, value, Method::Given);
    // From the first on from which it wins at all that are further.
    let lost =
        drifts.iter().rposition(|one| winner(Room::AsDesigned, *one) != Some(Winner::Absorber));
    let wins_from = drifts.get(lost.map_or(0, |last| last + 1));
    json!({
        "measure": if found.measure == Measure::DecayTime { "decay-time" } else if found.measure == Measure::Rms { "rms" } else { "peak" },
        "inactive": found.inactive,
        "rows": found.rows.iter().map(|row| told(case, found, row)).collect::<Vec<_>>(),
        "drifts": drifts.iter().skip(1).map(|one| drift(*one)).collect::<Vec<_>>(),
        "table": table(case, found, &drifts),
        "winner": winner(Room::AsDesigned, 0.0),
        "winner_in_equal_room": winner(Room::Equal, 0.0),
        "winner_without_medium": with(|row| row.given_damping.is_some()),
        "winner_changed": with(|row| row.changed),
        // The least drift from which on the absorber is the better one.
        "wins_from": wins_from.map(|one| drift(*one)),
        "robust_winner": drifts.last().and_then(|last| robust(*last)),
    })
}

/// A row as CONTRACT.md has it.
fn told(case: &Case, found: &Alternatives, row: &Row) -> Value {
    let units = case.units();
    let [value, error] = row.worst;
    let symbol = |kind: &'static crate::quantity::Kind| kind.dimension.symbol(units.physical);
    json!({
        "device": row.device.word(),
        "dampers": u8::from(row.device == Device::Damper),
        "room": row.room,
        "robust_for": row.robust_for,
        "damping": if row.given_damping.is_some() { "given" } else { "designed" },
        "drift": row.drift,
        "worst": { "value": finite(value), "error": error, "unit": symbol(found.kind(row.device)) },
        "stroke": row.stroke.map(|stroke| json!({ "value": finite(stroke), "unit": symbol(&of::DAMPER_STROKE) })),
        "tuning": row.damper.map(|one| one.tuning),
        "damping_ratio": row.damper.map(|one| one.damping_ratio),
    })
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// Devices as rows, what was asked at each drift as columns; the stroke is that without drift.
fn table(case: &Case, found: &Alternatives, drifts: &[f64]) -> Vec<Value> {
    let key = |row: &Row| {
        (
            row.device as u8,
            row.room as u8,
            row.robust_for > 0.0,
            row.given_damping.map(f64::to_bits),
            row.changed,
        )
    };
    let mut keys = Vec::new();
    for row in &found.rows {
        if !keys.contains(&key(row)) {
            keys.push(key(row));
        }
    }
    let scale = Scale::of(case);
    let of_key = |one| {
        let rows: Vec<&Row> = found.rows.iter().filter(|row| key(row) == one).collect();
        let first = rows[0];
        let cell =
            |drift: &f64| rows.iter().find(|row| row.drift == *drift).map(|row| found.worst(row));
        let stroke = match first.device {
            Device::Absorber => Some(case.units().quantity(&of::CLEARANCE, 1.0, Method::Given)),
            _ => first.stroke.map(|stroke| Quantity::new(&of::DAMPER_STROKE, stroke, ClosedForm)),
        };
        json!({
            "device": first.device.word(),
            "room": first.room,
            "robust": first.robust_for > 0.0,
            "given_damping": first.given_damping,
            "changed": first.changed,
            "stroke": stroke,
            "frequency": first.damper.map(|one| scale.damper_frequency(one.tuning)),
            "damping_ratio": first.damper.map(|one| {
                Quantity::new(&of::DAMPER_DAMPING_RATIO, one.damping_ratio, ClosedForm)
            }),
            "cells": drifts.iter().map(cell).collect::<Vec<_>>(),
        })
    };
    keys.into_iter().map(of_key).collect()
}

/// How far the promise holds: for each number its row as CONTRACT.md has it, and quantities for a page.
fn holds_for(case: &Case, found: &[HoldsFor]) -> Vec<Value> {
    let physical = case.units().physical;
    let row = |one: &HoldsFor| {
        let kind = match one.parameter.parameter(case) {
            Some(Parameter::Stiffness) | None => &of::NATURAL_FREQUENCY,
            Some(parameter) => case.design.kind(parameter),
        };
        let quantity = |value: f64| Quantity::new(kind, value, Method::Simulation);
        json!({
            "value": quantity(one.value),
            "from": quantity(one.range[0]),
            "to": quantity(one.range[1]),
            "undecided": one.undecided.iter().map(|ends| ends.map(quantity)).collect::<Vec<_>>(),
            "row": {
                "parameter": one.parameter,
                "unit": kind.dimension.symbol(physical),
                "value": one.value,
                "from": one.range[0],
                "to": one.range[1],
                "from_open": one.open[0],
                "to_open": one.open[1],
                "undecided": one.undecided,
                "further": [],
            },
        })
    };
    found.iter().map(row).collect()
}
