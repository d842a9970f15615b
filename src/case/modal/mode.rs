//! The tables `[[mode]]`, and shapes by the names of places.

use std::ops::Range;

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::Value;
use toml::Spanned;
use toml::de::DeValue;

use super::StructuralMode;
use super::alike::alike;
use super::table::Modes;
use crate::case::number::Form;
use crate::case::reader::{Reader, Table};
use crate::case::value::{ValuePlace, nearest};
use crate::system::LARGEST_DAMPING_RATIO;

/// A mode of the structure.
#[derive(Deserialize, JsonSchema)]
#[schemars(extend("additionalProperties" = false))]
pub(super) struct ModeTable {
    /// f_k, its natural frequency, above 0.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0), example = "1.1 Hz")]
    frequency: f64,
    /// zeta_k, its damping ratio, from 0 to 0.85.
    #[schemars(extend("x-measurand" = "a share", "minimum" = 0, "maximum" = LARGEST_DAMPING_RATIO), example = 0.005, example = "0.5 %")]
    damping_ratio: f64,
    /// M_k, its modal mass by the scale of the shape, above 0.
    #[schemars(extend("x-measurand" = "a mass", "exclusiveMinimum" = 0), example = "30 kg")]
    mass: f64,
    /// phi_k, its shape: the displacement at each place where the modal coordinate is 1.
    #[schemars(with = "Value", extend("type" = "object", "additionalProperties" = { "type": "number" }))]
    #[expect(dead_code, reason = "read by its own names")]
    #[serde(default)]
    shape: (),
    /// Gamma_k, its participation in the motion of the base; needed where the base moves.
    #[schemars(example = 1.3)]
    participation: Option<f64>,
}

/// Places and modes of some tables, each by `read_one`, and where each says its damping ratio.
pub(super) fn read_modes(
    reader: &mut Reader,
    tables: Vec<Table>,
    read_one: fn(&mut Reader, &Table) -> Option<(StructuralMode, Shape)>,
    damping: &mut Vec<Range<usize>>,
) -> Modes {
    let mut places: Vec<String> = Vec::new();
    let mut modes = Vec::new();
    for (table, mode) in tables.iter().filter_map(|one| Some((one, read_one(reader, one)?))) {
        for (name, _) in &mode.1.1 {
            if !places.contains(name) {
                places.push(name.clone());
            }
        }
        modes.push(mode);
        damping.push(table.span_of_value("damping_ratio"));
    }
    let shapes: Vec<Shape> = modes.iter().map(|(_, shape)| shape.clone()).collect();
    let modes: Vec<StructuralMode> = modes
        .into_iter()
        .map(|(mode, shape)| StructuralMode {
            shape: places.iter().map(|name| value_at(&shape, name)).collect(),
            ..mode
        })
        .collect();
    for Missing { span, name, written } in missing(&shapes, &places) {
        let message = format!("the shape has no value at \"{name}\", where another mode has one");
        let help = match written {
            Some(written) => format!("did you mean \"{name}\" where \"{written}\" is written?"),
            None => format!("write shape = {{ {name} = 1.0, ... }}; 0 where the mode has a node"),
        };
        reader.report(span, message, "expected every place in the shape of every mode", help);
    }
    let found: Vec<(f64, &[f64])> =
        modes.iter().map(|mode| (mode.frequency_hz, mode.shape.as_slice())).collect();
    for pair in alike(&found) {
        let [first, second] = [&modes[pair.first], &modes[pair.second]].map(|one| one.frequency_hz);
        let [line, span] = [pair.first, pair.second].map(|k| shapes[k].0.clone());
        let line = reader.line_of(line.start);
        let words = pair.words();
        let unit = if reader.plain { "times the first" } else { "Hz" };
        let message = format!(
            "mode {} at {second} {unit} has {words} frequency and one shape with mode {}, at {first} {unit} in line {line}",
            pair.second + 1,
            pair.first + 1,
        );
        let help = "remove one of them, where they are one mode that was written twice";
        match pair.equal {
            true => reader.report(span, message, "expected each mode once", help),
            false => reader.warn(span, message, "each of them takes its part of a load", help),
        }
    }
    (places, modes)
}

/// The values of a shape by their places, and where it stands.
pub(super) type Shape = (Range<usize>, Vec<(String, f64)>);

fn value_at((_, shape): &Shape, name: &str) -> f64 {
    shape.iter().find(|(key, _)| key == name).map_or(0.0, |(_, value)| *value)
}

/// A place that a mode says nothing of.
struct Missing {
    /// Where its shape stands.
    span: Range<usize>,
    /// The place.
    name: String,
    /// What it has in its place, which is most likely a misspelling of it.
    written: Option<String>,
}

/// Places that modes say nothing of. Of two names that are nearly one that is misspelled which fewer modes have, of as many the later;
/// a misspelled one is missing nowhere.
fn missing(shapes: &[Shape], places: &[String]) -> Vec<Missing> {
    let has = |shape: &Shape, name: &str| shape.1.iter().any(|(key, _)| key == name);
    let shapes: Vec<&Shape> = shapes.iter().filter(|shape| !shape.1.is_empty()).collect();
    let rank = |name: &str| {
        let modes = shapes.iter().filter(|shape| has(shape, name)).count();
        (modes, std::cmp::Reverse(places.iter().position(|one| one == name)))
    };
    let are_apart =
        |one: &str, other: &str| !shapes.iter().any(|all| has(all, one) && has(all, other));
    let near = |name: &str, among: &[&str]| {
        let others: Vec<&str> =
            among.iter().copied().filter(|one| *one != name && are_apart(one, name)).collect();
        nearest(name, &others).map(str::to_owned)
    };
    let all: Vec<&str> = places.iter().map(String::as_str).collect();
    let is_misspelled =
        |name: &&String| near(name, &all).is_some_and(|other| rank(&other) > rank(name));
    let known: Vec<&String> = places.iter().filter(|name| !is_misspelled(name)).collect();
    let of = |shape: &&Shape| {
        let own: Vec<&str> = shape.1.iter().map(|(key, _)| key.as_str()).collect();
        let absent = known.iter().filter(|name| !has(shape, name));
        let told = absent.map(|name| Missing {
            span: shape.0.clone(),
            name: (*name).clone(),
            written: near(name, &own),
        });
        told.collect::<Vec<_>>()
    };
    shapes.iter().flat_map(of).collect()
}

/// A mode and its shape.
pub(super) fn read_mode(reader: &mut Reader, table: &Table) -> Option<(StructuralMode, Shape)> {
    let read = reader.read::<ModeTable>(table);
    let shape = read_shape(reader, table)?;
    let read = read?;
    let mode = StructuralMode {
        frequency_hz: read.frequency,
        damping_ratio: read.damping_ratio,
        mass_kg: read.mass,
        shape: Vec::new(),
        participation: read.participation.unwrap_or(f64::NAN),
        forcing: 0.0,
    };
    Some((mode, shape))
}

/// The key `shape` of a mode.
pub(super) fn read_shape(reader: &mut Reader, table: &Table) -> Option<Shape> {
    let help = "write shape = { tip = 1.0 }: a name and a number for each place";
    let expected = "expected the displacement at each place, as a table";
    let span = table.span_of("shape");
    let Some(DeValue::Table(entries)) = table.value("shape").map(Spanned::get_ref) else {
        if !table.misspelled.contains(&"shape") {
            reader.report(span, "a mode has no `shape`", expected, help);
        }
        return None;
    };
    let mut shape = Vec::new();
    for (name, value) in entries {
        let name = name.get_ref().as_ref();
        let place = ValuePlace {
            table: "mode",
            key: "shape",
            subject: format!("`{name}` of `shape`"),
            line: "shape = { tip = 1.0 }".to_owned(),
            value,
            sign: 0,
            alone: false,
        };
        let number = reader.number(&place, &Form::free(None, "1.0", ""))?;
        shape.push((name.to_owned(), number));
    }
    if shape.iter().all(|(_, value)| *value == 0.0) {
        reader.report(span, "the shape of a mode is 0 everywhere", expected, help);
        return None;
    }
    Some((span, shape))
}
