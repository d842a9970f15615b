//! The requests about a structure of several modes or absorbers.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::{Value, json};
use vinesink::case::{Load, ModalCase};
use vinesink::executor::Serial;
use vinesink::modal::ModalAnswer;
use vinesink::quantity::catalogue::{CLEARANCE, EXCITATION_FREQUENCY, RESTITUTION};
use vinesink::quantity::{Kind, Units};
use vinesink::report::figure::{self, Figure};
use vinesink::report::html::unbroken;
use vinesink::report::{document, modal};

use crate::running::{self, From};
use crate::told::{problems, words};

/// A request about the case that `text` describes, under one of its loads.
#[derive(Deserialize)]
#[serde(tag = "ask", rename_all = "snake_case")]
pub enum Request {
    /// The sliders of a case.
    Open {
        text: String,
        #[serde(default)]
        at: At,
    },
    /// The case with other absorbers, and another excitation.
    Change { text: String, at: At, values: BTreeMap<String, f64> },
    /// What is known at the frequency of the sliders.
    Study { text: String, at: At },
    /// The figure over the range of the load.
    Range { text: String, at: At, narrow: bool },
    /// The running simulation is of this case now.
    Run { text: String, at: At, from: From },
}

/// One of the loads, with the frequency in Hz and the amplitude of the sliders; those of the load where they are not said.
#[derive(Deserialize, Default, Clone, Copy)]
pub struct At {
    load: usize,
    frequency: Option<f64>,
    amplitude: Option<f64>,
}

/// Absorbers that are drawn and have sliders; each has a number.
const NUMBERS: [&str; 3] = ["₁", "₂", "₃"];

/// The answer to a request.
pub fn answer(request: Request) -> Result<Value, Value> {
    match request {
        Request::Open { text, at } => opened(&parsed(&text)?, &text, at),
        Request::Change { text, at, values } => changed(&text, at, &values),
        Request::Study { text, at } => {
            let case = at_frequency(parsed(&text)?, at)?;
            let found = ModalAnswer::of(&case, &Serial).map_err(words)?;
            found.observe(&Serial);
            let mut told = modal::at_frequency(&case, &found).map_err(words)?;
            let markdown = told["markdown"].as_str().map(unbroken).unwrap_or_default();
            told["markdown"] = markdown.into();
            Ok(told)
        }
        Request::Range { text, at, narrow } => {
            let case = over_range(parsed(&text)?, at)?;
            let found = ModalAnswer::of(&case, &Serial).map_err(words)?;
            let drawn = modal::over_frequency(&case, &found).map_err(words)?;
            let drawn = drawn.into_iter().filter(|figure| !figure.panels.is_empty());
            let rows = drawn.map(|figure| {
                let figure = if narrow { figure.narrow().unwrap_or(figure) } else { figure };
                shown(&figure)
            });
            Ok(json!({ "figures": rows.collect::<Result<Vec<_>, _>>()? }))
        }
        Request::Run { text, at, from } => {
            let case = at_frequency(parsed(&text)?, at)?;
            run(&case, from)
        }
    }
}

fn shown(figure: &Figure) -> Result<Value, Value> {
    let mut row = document::figure_row(figure);
    row["svg"] = figure::draw(figure).map_err(words)?.svg.into();
    Ok(row)
}

fn parsed(text: &str) -> Result<ModalCase, Value> {
    ModalCase::parse("case.toml", text).map_err(|error| problems(&error))
}

/// The load of the sliders, with their amplitude, and their frequency.
fn load_of(case: &ModalCase, at: At) -> Result<(Load, f64), Value> {
    let load = case.loads.get(at.load).copied();
    let load = load.ok_or_else(|| words(format!("there is no load {}", at.load)))?;
    let amplitude = at.amplitude.unwrap_or(load.amplitude);
    Ok((Load { amplitude, ..load }, at.frequency.unwrap_or_else(|| load.centre(case))))
}

/// The case under the load of the sliders alone, over its range.
fn over_range(mut case: ModalCase, at: At) -> Result<ModalCase, Value> {
    case.loads = vec![load_of(&case, at)?.0];
    Ok(case)
}

/// The same at their frequency.
fn at_frequency(mut case: ModalCase, at: At) -> Result<ModalCase, Value> {
    let (load, frequency) = load_of(&case, at)?;
    case.loads = vec![Load { range_hz: [frequency; 2], ..load }];
    Ok(case)
}

/// How far a slider goes to either side of the value it begins with, as a factor; a frequency beside a load of one.
const RANGE: f64 = 8.0;
const BESIDE: f64 = 0.15;

fn opened(case: &ModalCase, text: &str, at: At) -> Result<Value, Value> {
    let (load, frequency) = load_of(case, at)?;
    let own = case.loads[at.load];
    let units = modal::units(case);
    let [from, to] = own.range_hz;
    let range = if from < to { [from, to] } else { [from * (1.0 - BESIDE), from * (1.0 + BESIDE)] };
    let wide = |value: f64| ([value / RANGE, value * RANGE], true);
    let excitation = |key: &str, kind, value, range| slider(&units, key, kind, "", value, range);
    let mut controls = vec![
        excitation("frequency", &EXCITATION_FREQUENCY, frequency, (range, false)),
        excitation("amplitude", load.amplitude_kind(), load.amplitude, wide(own.amplitude)),
    ];
    for ((absorber, number), j) in case.absorbers.iter().zip(NUMBERS).zip(1..) {
        let one = |kind: &'static Kind, value, range| {
            slider(&units, &format!("{}_{j}", kind.id), kind, number, value, range)
        };
        controls.push(one(&CLEARANCE, absorber.clearance_m, wide(absorber.clearance_m)));
        controls.push(one(&RESTITUTION, absorber.restitution, ([0.0, 1.0], false)));
    }
    let loads = case.loads.iter().map(|load| modal::load_words(case, load));
    let loads = loads.collect::<Result<Vec<_>, _>>().map_err(words)?;
    let more = case.absorbers.len().saturating_sub(NUMBERS.len());
    let notes =
        (more > 0).then(|| format!("{more} more of the absorbers fly along and are not drawn."));
    Ok(json!({
        "text": text, "title": case.title, "controls": controls, "loads": loads, "notes": notes.as_slice(),
        "at": { "load": at.load, "frequency": frequency, "amplitude": load.amplitude },
    }))
}

/// A slider: of the excitation, or of an absorber with its number.
fn slider(
    units: &Units,
    key: &str,
    kind: &Kind,
    number: &str,
    value: f64,
    (range, log): ([f64; 2], bool),
) -> Value {
    let unit = units.unit(kind.dimension, value);
    json!({
        "key": key, "name": kind.name, "symbol": format!("{}{number}", kind.symbol),
        "value": value, "words": units.text(kind, value),
        "unit": { "symbol": unit.symbol, "size": unit.size }, "range": range, "log": log,
    })
}

/// The case with other values of its sliders, of which those of the excitation are not in its text.
fn changed(text: &str, mut at: At, values: &BTreeMap<String, f64>) -> Result<Value, Value> {
    let of = |key: &str| values.get(key).copied();
    at.frequency = of("frequency").or(at.frequency);
    at.amplitude = of("amplitude").or(at.amplitude);
    let case = parsed(text)?;
    let mut absorbers = case.absorbers.clone();
    for (j, one) in (1..).zip(&mut absorbers) {
        one.clearance_m = of(&format!("clearance_{j}")).unwrap_or(one.clearance_m);
        one.restitution = of(&format!("restitution_{j}")).unwrap_or(one.restitution);
    }
    let (text, case) = case.rewritten(text, &absorbers).map_err(words)?;
    opened(&case, &text, at)
}

/// Runs another case; what its numbers are in, and the structure without absorbers at each absorber: displacement at phase 0 and a
/// quarter of a period later.
fn run(case: &ModalCase, from: From) -> Result<Value, Value> {
    let system = case.system(&case.loads[0], case.loads[0].range_hz[0]).map_err(words)?;
    running::several(&system, from).map_err(words)?;
    let unit = modal::units(case).unit(CLEARANCE.dimension, case.absorbers[0].clearance_m);
    let bare = |j: usize| {
        let motion = system.steady_motion_at(j);
        [motion.cosine / unit.size, motion.sine / unit.size]
    };
    let clearances = case.absorbers.iter().map(|one| one.clearance_m / unit.size);
    let places = case.absorbers.iter().map(|one| &case.places[one.place]);
    Ok(json!({
        "unit": unit.symbol, "scale": 1.0 / unit.size, "clearances": clearances.collect::<Vec<_>>(),
        "places": places.collect::<Vec<_>>(), "bare": (0..case.absorbers.len()).map(bare).collect::<Vec<_>>(),
        "carried": "",
    }))
}
