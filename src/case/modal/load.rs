//! The tables `[[excitation]]`: what may drive a structure of several modes, one at a time.

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::{Value, json};

use super::place::find_place;
use super::{ActsOn, Load, StructuralMode};
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
            return refused(
                "mode",
                message,
                "expected one of the modes, from 1",
                "name another mode",
            );
        }
        (_, Some(mode), None) => ActsOn::Mode(mode as usize - 1),
        (..) => ActsOn::Place(find_place(
            reader,
            table.span_of_value("place"),
            read.place.as_deref(),
            places,
        )?),
    };
    let range_hz = match (read.frequency, read.from, read.to) {
        (Some(at), None, None) => [at; 2],
        (None, Some(from), Some(to)) if from < to => [from, to],
        (None, Some(_), Some(_)) => {
            let help = "swap `from` and `to`, or write a larger `to`";
            reader.report(
                table.span_of_value("to"),
                "the range ends where it begins, or before",
                "expected `to` above `from`",
                help,
            );
            return None;
        }
        _ => {
            let message = "the excitation has neither a frequency nor a whole range";
            let help = "write frequency = \"6.9 Hz\", or from = \"6 Hz\" and to = \"8 Hz\"";
            reader.report(
                table.span.clone(),
                message,
                "expected `frequency`, or `from` and `to`",
                help,
            );
            return None;
        }
    };
    Some(Load { on, amplitude: read.amplitude, range_hz })
}
