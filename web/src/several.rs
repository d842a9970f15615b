//! The requests of the page of structures of several modes with several absorbers, and the simulation that runs there.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

use serde::Deserialize;
use serde_json::{Value, json};
use vinesink::case::{Load, ModalCase, PlacedAbsorber};
use vinesink::executor::Serial;
use vinesink::modal::ModalAnswer;
use vinesink::quantity::catalogue::{CLEARANCE, EXCITATION_FREQUENCY, RESTITUTION};
use vinesink::quantity::{Kind, Units};
use vinesink::report::figure::{self, Figure};
use vinesink::report::html::unbroken;
use vinesink::report::{document, modal};
use vinesink::simulation::{ModalImpact, ModalObserver, ModalSegment, ModalSimulation};
use vinesink::system::{ModalState, ModalSystem};

use crate::From;
use crate::told::{answered, problems, words};

/// A request; every one but [`Request::Presets`] is about the case that `text` describes.
#[derive(Deserialize)]
#[serde(tag = "ask", rename_all = "snake_case")]
enum Request {
    /// The cases to begin with.
    Presets,
    /// The sliders of a case under one of its loads.
    Open { text: String, load: usize },
    /// The case with other absorbers.
    Change { text: String, values: BTreeMap<String, f64> },
    /// What is known at the frequency of the sliders.
    Study { text: String, at: At },
    /// The figure over the range of the load.
    Range { text: String, at: At, narrow: bool },
    /// The running simulation is of this case now.
    Run { text: String, at: At, from: From },
}

/// One of the loads, with the frequency in Hz and the amplitude of the sliders.
#[derive(Deserialize, Clone, Copy)]
struct At {
    load: usize,
    frequency: f64,
    amplitude: f64,
}

const PRESETS: [(&str, &str); 3] = [
    ("a mast, one ball against three modes", include_str!("../../cases/several/mast.toml")),
    ("a gymnasium floor, balls at two places", include_str!("../../cases/several/floor.toml")),
    ("graded balls on one mode", include_str!("../../cases/several/graded.toml")),
];

/// Absorbers that are drawn and have sliders.
const DRAWN: usize = 3;

/// The answer to a request.
pub fn to(request: &[u8]) -> Vec<u8> {
    answered(request, answer)
}

fn answer(request: Request) -> Result<Value, Value> {
    match request {
        Request::Presets => Ok(PRESETS.iter().map(|(name, text)| json!([name, text])).collect()),
        Request::Open { text, load } => opened(&parsed(&text)?, &text, load),
        Request::Change { text, values } => {
            let case = parsed(&text)?;
            let mut absorbers = case.absorbers.clone();
            for (j, one) in absorbers.iter_mut().enumerate() {
                let of = |key: &str| values.get(&format!("{key}_{}", j + 1)).copied();
                one.clearance_m = of("clearance").unwrap_or(one.clearance_m);
                one.restitution = of("restitution").unwrap_or(one.restitution);
            }
            let (text, _) = case.rewritten(&text, &absorbers).map_err(words)?;
            Ok(json!({ "text": text }))
        }
        Request::Study { text, at } => {
            let case = under(parsed(&text)?, at, true)?;
            let found = ModalAnswer::of(&case, &Serial).map_err(words)?;
            found.observe(&Serial);
            let mut told = modal::at_frequency(&case, &found).map_err(words)?;
            let markdown = told["markdown"].as_str().map(unbroken).unwrap_or_default();
            told["markdown"] = markdown.into();
            Ok(told)
        }
        Request::Range { text, at, narrow } => {
            let case = under(parsed(&text)?, at, false)?;
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
            let case = under(parsed(&text)?, at, true)?;
            change(&case, from)
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

fn load_of(case: &ModalCase, number: usize) -> Result<Load, Value> {
    case.loads.get(number).copied().ok_or_else(|| words(format!("there is no load {number}")))
}

/// The case under the load of the sliders alone, at their frequency or over its range.
fn under(mut case: ModalCase, at: At, at_frequency: bool) -> Result<ModalCase, Value> {
    let load = load_of(&case, at.load)?;
    let range_hz = if at_frequency { [at.frequency; 2] } else { load.range_hz };
    case.loads = vec![Load { amplitude: at.amplitude, range_hz, ..load }];
    Ok(case)
}

/// How far a slider goes to either side of the value it begins with, as a factor; a frequency beside a load of one.
const RANGE: f64 = 8.0;
const BESIDE: f64 = 0.15;

fn opened(case: &ModalCase, text: &str, load: usize) -> Result<Value, Value> {
    let of = load_of(case, load)?;
    let units = modal::units(case);
    let [from, to] = of.range_hz;
    let range = if from < to { [from, to] } else { [from * (1.0 - BESIDE), from * (1.0 + BESIDE)] };
    let own = of.centre(case);
    let wide = |value: f64| ([value / RANGE, value * RANGE], true);
    let one = |kind: &'static Kind, value: f64, range| control(&units, kind, None, value, range);
    let mut controls = vec![
        one(&EXCITATION_FREQUENCY, own, (range, false)),
        one(of.amplitude_kind(), of.amplitude, wide(of.amplitude)),
    ];
    controls[0]["key"] = "frequency".into();
    controls[1]["key"] = "amplitude".into();
    for (j, absorber) in case.absorbers.iter().enumerate().take(DRAWN) {
        let one =
            |kind: &'static Kind, value: f64, range| control(&units, kind, Some(j), value, range);
        controls.push(one(&CLEARANCE, absorber.clearance_m, wide(absorber.clearance_m)));
        controls.push(one(&RESTITUTION, absorber.restitution, ([0.0, 1.0], false)));
    }
    let loads = case.loads.iter().map(|load| modal::load_words(case, load));
    let loads = loads.collect::<Result<Vec<_>, _>>().map_err(words)?;
    let more = case.absorbers.len().saturating_sub(DRAWN);
    let notes =
        (more > 0).then(|| format!("{more} more of the absorbers fly along and are not drawn."));
    Ok(json!({
        "text": text, "title": case.title, "controls": controls, "load": load,
        "loads": loads, "notes": notes.into_iter().collect::<Vec<_>>(),
    }))
}

/// A slider: of an absorber, or of the excitation.
fn control(
    units: &Units,
    kind: &Kind,
    absorber: Option<usize>,
    value: f64,
    (range, log): ([f64; 2], bool),
) -> Value {
    const NUMBERS: [&str; DRAWN] = ["₁", "₂", "₃"];
    let unit = units.unit(kind.dimension, value);
    let number = absorber.map_or("", |j| NUMBERS[j]);
    json!({
        "key": absorber.map(|j| format!("{}_{}", kind.id, j + 1)), "name": kind.name,
        "symbol": format!("{}{number}", kind.symbol), "value": value,
        "unit": { "symbol": unit.symbol, "size": unit.size }, "range": range, "log": log,
    })
}

thread_local! {
    static RUNNING: RefCell<Option<Running>> = const { RefCell::new(None) };
}

/// A simulation and what its numbers are told by.
struct Running {
    simulation: ModalSimulation,
    system: ModalSystem,
}

/// How near to a wall an absorber may be that a smaller cavity pushes inwards, over the clearance.
const BESIDE_THE_WALL: f64 = 0.999;

/// Runs another case; what its numbers are in, and the structure without absorbers at each absorber: displacement at phase 0 and a
/// quarter of a period later.
fn change(case: &ModalCase, from: From) -> Result<Value, Value> {
    let system = case.system(&case.loads[0], case.loads[0].range_hz[0]).map_err(words)?;
    let clearances: Vec<f64> = case.absorbers.iter().map(|one| one.clearance_m).collect();
    let size = |of: &ModalSystem| [of.modes().len(), of.absorbers().len()];
    let own = size(&system);
    RUNNING.with_borrow_mut(|running| {
        let mut phase = 0.0;
        let mut state = ModalState::AT_REST;
        match running.as_ref().filter(|one| from == From::Here && size(&one.system) == own) {
            Some(one) => {
                (state, phase) = (one.simulation.state(), one.simulation.phase());
                for (j, b) in clearances.iter().enumerate() {
                    let x = displacement(&system, &state, j);
                    let gap = (x - state.absorbers[j][0]).clamp(-BESIDE_THE_WALL * b, BESIDE_THE_WALL * b);
                    state.absorbers[j][0] = x - gap;
                }
            }
            None if from != From::Rest => {
                for (one, b) in state.absorbers.iter_mut().zip(&clearances) {
                    *one = [0.5 * b, *b];
                }
            }
            None => {}
        }
        let simulation = ModalSimulation::new(&system, &state, phase).map_err(words)?;
        let bare = (0..clearances.len()).map(|j| {
            let motion = system.steady_motion_at(j);
            [motion.cosine, motion.sine]
        });
        let bare: Vec<[f64; 2]> = bare.collect();
        *running = Some(Running { simulation, system });
        let unit = modal::units(case).unit(CLEARANCE.dimension, clearances[0]);
        let over = |value: &f64| value / unit.size;
        Ok(json!({
            "unit": unit.symbol, "size": unit.size, "clearances": clearances.iter().map(over).collect::<Vec<_>>(),
            "bare": bare.iter().map(|one| one.iter().map(over).collect::<Vec<_>>()).collect::<Vec<_>>(),
            "places": case.absorbers.iter().map(|one: &PlacedAbsorber| &case.places[one.place]).collect::<Vec<_>>(),
        }))
    })
}

/// Displacement of the structure at an absorber.
fn displacement(system: &ModalSystem, state: &ModalState, absorber: usize) -> f64 {
    let modes = system.modes().iter().zip(&state.modes);
    modes.map(|(mode, [q, _])| mode.shape[absorber] * q).sum()
}

/// Points of a run at even phases, and its impacts.
struct Trace<'a> {
    system: &'a ModalSystem,
    samples: f64,
    points: Vec<f64>,
    impacts: Vec<f64>,
}

impl ModalObserver for Trace<'_> {
    fn segment(&mut self, segment: &ModalSegment<'_>) {
        let speed = self.system.frequency_ratio() / TAU;
        let begin = segment.turns as f64 + segment.phase / TAU;
        let end = begin + speed * segment.duration;
        let mut k = (begin * self.samples).ceil();
        while k < end * self.samples {
            let state = segment.at((k / self.samples - begin) / speed);
            self.points.push(k / self.samples);
            for (j, absorber) in self.system.absorbers().iter().enumerate() {
                let x = displacement(self.system, &state, j);
                self.points.extend([x, (x - state.absorbers[j][0]) / absorber.clearance]);
            }
            k += 1.0;
        }
    }

    fn impact(&mut self, impact: &ModalImpact) {
        let time = impact.tau * self.system.frequency_ratio() / TAU;
        self.impacts.extend([time, impact.absorber as f64, impact.side.sign()]);
    }
}

/// Appends what happens in the next periods: the number of points; for each the time in periods since the last change of the case, then
/// of each absorber the displacement of its place in m and its gap over its clearance; then for each impact its time, its absorber and
/// its side, -1 or 1.
pub fn go_on(periods: u32, samples: f64, numbers: &mut Vec<f64>) {
    RUNNING.with_borrow_mut(|running| {
        let Some(Running { simulation, system }) = running else { return };
        let mut trace = Trace { system, samples, points: Vec::new(), impacts: Vec::new() };
        // An absorber that chatters has infinitely many impacts.
        const AT_MOST: u64 = 100_000;
        simulation.run(periods.into(), AT_MOST, &mut trace);
        let width = 1 + 2 * system.absorbers().len();
        numbers.push((trace.points.len() / width) as f64);
        numbers.append(&mut trace.points);
        numbers.append(&mut trace.impacts);
    });
}
