//! The tables `[[excitation]]`: what may drive a structure of several modes, one at a time.

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::{Value, json};

use super::place::find_place;
use super::{ActsOn, Load, StructuralMode};
use crate::case::excitation_kinds;
use crate::case::reader::{Reader, Table};
use vinesink_core::names;

names! { name:
    /// What moves the structure.
    #[derive(schemars::JsonSchema)]
    pub(super) enum LoadKind {
        /// A force P sin(omega t), at a place or in one mode alone.
        Force = "force",
        /// The base moves by F sin(omega t).
        BaseDisplacement = "base-displacement",
    }
}

/// A harmonic excitation; of several `[[excitation]]` one acts at a time.
#[derive(Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields, extend("oneOf" = loads()))]
pub(super) struct LoadTable {
    /// "force" or "base-displacement".
    kind: LoadKind,
    /// Where the force acts: a place of the shapes. May be left out where they have one.
    #[schemars(example = &"tip")]
    place: Option<String>,
    /// The mode in which alone the force acts, from 1, instead of a place.
    #[schemars(range(min = 1, max = 8), example = 2)]
    mode: Option<u64>,
    /// P, the amplitude of the force, or F, the displacement amplitude of the base; above 0.
    #[schemars(with = "String", example = "14 N")]
    amplitude: f64,
    /// f, its frequency, above 0; or give a range, `from` and `to`.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0), example = "6.9 Hz")]
    frequency: Option<f64>,
    /// Where its range of frequencies begins, above 0.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0), example = "6 Hz")]
    from: Option<f64>,
    /// Where it ends, above `from`.
    #[schemars(extend("x-measurand" = "a frequency", "exclusiveMinimum" = 0), example = "8 Hz")]
    to: Option<f64>,
}

/// How the amplitude of each kind is written.
fn loads() -> Value {
    let kind = |name: &str, measured: &str, example: &str| {
        let amplitude = json!({ "type": "number", "x-measurand": measured, "exclusiveMinimum": 0, "examples": [example] });
        let mut keys = json!({ "kind": { "const": name }, "amplitude": amplitude });
        for key in ["frequency", "from", "to"] {
            keys[key] = json!(true);
        }
        if name == LoadKind::Force.name() {
            (keys["place"], keys["mode"]) = (json!(true), json!(true));
        }
        json!({ "properties": keys })
    };
    json!([
        kind(LoadKind::Force.name(), "a force", "14 N"),
        kind(LoadKind::BaseDisplacement.name(), "a length", "0.25 mm"),
    ])
}

/// What it acts on, how far and at which frequencies, of a structure with so many modes in its file; none where something was reported.
pub(super) fn read_load(
    reader: &mut Reader,
    table: &Table,
    places: &[String],
    modes: &[StructuralMode],
    count: usize,
) -> Option<Load> {
    if refuse_kind(reader, table) {
        return None;
    }
    let read = reader.read::<LoadTable>(table)?;
    let mut refused = |key: &str, message: String, expected: &str, help: &str| {
        reader.report(table.span_of_value(key), message, expected, help);
        None
    };
    let on = match (read.kind, read.mode, &read.place) {
        (LoadKind::BaseDisplacement, ..) => {
            if let Some(k) = modes.iter().position(|mode| mode.participation.is_nan()) {
                let message = format!("the base moves, and mode {} has no `participation`", k + 1);
                let help =
                    "write participation = 1.3, the mode's participation factor, in each [[mode]]";
                return refused("kind", message, "expected a participation of every mode", help);
            }
            ActsOn::Base
        }
        (_, Some(_), Some(_)) => {
            let message = "`mode` and `place` both say where the force acts".to_owned();
            return refused(
                "mode",
                message,
                "expected only one of the two",
                "remove one of the two lines",
            );
        }
        // Of one that could not be read that was said.
        (_, Some(mode), None) if mode as usize > count => {
            let message = format!("`mode` is {mode}, and there are {count}");
            let expected = format!("expected the number of a mode, from 1 to {count}");
            return refused("mode", message, &expected, "name another mode");
        }
        (_, Some(mode), None) => ActsOn::Mode(mode as usize - 1),
        // Of one that could not be read that was said, too.
        (_, None, None) if table.has("place") => return None,
        (..) => ActsOn::Place(find_place(
            reader,
            table.span_of_value("place"),
            read.place.as_deref(),
            places,
        )?),
    };
    let range_hz = read_range(reader, table, "frequency", [read.frequency, read.from, read.to])?;
    Some(Load { on, amplitude: read.amplitude, range_hz })
}

/// Whether the kind of a load is one of a structure of one mode alone; reported then.
fn refuse_kind(reader: &mut Reader, table: &Table) -> bool {
    let written = table.value("kind").and_then(|value| value.get_ref().as_str());
    let of_one = excitation_kinds()
        .filter(|kind| LoadKind::ALL.iter().all(|known| known.name() != *kind))
        .find(|kind| Some(*kind) == written);
    let Some(kind) = of_one else { return false };
    let message = format!("kind = \"{kind}\" has no meaning with several modes or absorbers");
    let help = "several are driven at steady frequencies alone; a structure of one mode and one absorber, [oscillator] and \
                [absorber], may be let go, struck, swept or driven by a record";
    let expected = "expected \"force\" or \"base-displacement\"";
    reader.report(table.span_of_value("kind"), message, expected, help);
    true
}

/// The frequencies of a load: of one frequency that twice; reported where they are none.
pub(super) fn read_range(
    reader: &mut Reader,
    table: &Table,
    key: &str,
    [at, from, to]: [Option<f64>; 3],
) -> Option<[f64; 2]> {
    let there = [key, "from", "to"].map(|key| table.has(key));
    let (at, from, to) = match (there, at, from, to) {
        ([true, false, false], Some(at), ..) => return Some([at; 2]),
        ([false, true, true], _, Some(from), Some(to)) if from < to => return Some([from, to]),
        ([false, true, true], _, Some(_), Some(_)) => {
            let help = "swap `from` and `to`, or write a larger `to`";
            let message = "the range ends where it begins, or before";
            reader.report(table.span_of_value("to"), message, "expected `to` above `from`", help);
            return None;
        }
        (there, ..) => there.into(),
    };
    let place = table.place();
    let expected = format!("expected `{key}` alone, or `from` and `to`");
    let [one, range] = match key {
        "frequency" => ["6.9 Hz", "6 Hz\" and to = \"8 Hz"].map(|text| format!("\"{text}\"")),
        _ => ["1.02", "0.9 and to = 1.1"].map(str::to_owned),
    };
    match (at, from, to) {
        (true, ..) if from || to => {
            let message =
                format!("`{key}` and a range both say at which frequencies it acts{place}");
            let help = format!("remove `{key}`, or `from` and `to`");
            reader.report(table.span_of(key), message, expected, help);
        }
        (false, false, false) => {
            let message = format!("there is neither `{key}` nor a range{place}");
            let help = format!("write {key} = {one}, or from = {range}");
            reader.report(table.span.clone(), message, expected, help);
        }
        (false, from, to) if from != to => {
            let [own, other] = if from { ["from", "to"] } else { ["to", "from"] };
            let message = format!("`{other}` is missing beside `{own}`{place}");
            let help = format!("write from = {range}, or {key} = {one} alone");
            reader.report(table.span_of(own), message, expected, help);
        }
        // What could not be read was told.
        _ => {}
    }
    None
}
