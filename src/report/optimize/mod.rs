//! The page of `vinesink optimize`: the best absorber in words, tables and two figures.

mod figure;
mod words;

use serde::Serialize;

use super::FigureRow;
use super::figure::Figure;
use super::numbers::{percent, significant};
use super::tables::{Table, table};
use crate::case::{Case, Choice, Uncertainty};
use crate::optimize::claim::Claim;
use crate::optimize::confirm::Place;
use crate::optimize::sensitivity::{Changed, Sensitivity};
use crate::optimize::shortlist::Candidate;
use crate::optimize::{Bounds, Chosen, Optimization, Variable, chart};
use words::Words;

pub use figure::figures;

/// The page as data.
#[derive(Debug, Clone, Serialize)]
pub struct OptimizePage {
    /// The case's title.
    pub title: String,
    /// The answer in a sentence.
    pub headline: String,
    /// What follows from the rest, a sentence each.
    pub sentences: Vec<String>,
    /// The case's absorber, the best, the robust one.
    pub absorbers: Table,
    /// Whether there is an optimum: what follows about it has nothing to say where there is none.
    pub reached: bool,
    /// What was looked for and between which bounds.
    pub looked_for: String,
    /// What simulation says, in a sentence.
    pub confirmed_words: String,
    /// What simulation says, place by place.
    pub confirmed: Table,
    /// What a change of each parameter does.
    pub sensitivities: Table,
    /// How expectations were computed, if anything is uncertain, and how the winner was chosen where
    /// simulation has a part in it; a sentence each.
    pub method: Vec<String>,
    /// The paper's claim on the case, a sentence each.
    pub claim: Vec<String>,
    /// The figures' words; the drawings are files of their own.
    pub figures: Vec<FigureRow>,
    /// Folder name of the case's report.
    pub name: String,
    /// Version of the program.
    pub version: &'static str,
    /// SHA-256 of the case file's text.
    pub case_sha256: String,
}

impl OptimizePage {
    /// Writes the page of a case.
    pub fn new(name: &str, case: &Case, found: &Optimization, figures: &[Figure]) -> Self {
        let words = Words::new(case, found);
        Self {
            title: case.title.clone(),
            headline: words.headline(),
            sentences: words.sentences(),
            absorbers: absorbers(&words),
            reached: found.reached(),
            looked_for: looked_for(&words),
            confirmed_words: words.confirmed(),
            confirmed: confirmed(&words),
            sensitivities: sensitivities(&words),
            method: words.method(),
            claim: words.claim(),
            figures: figures.iter().map(FigureRow::of).collect(),
            name: name.to_owned(),
            version: env!("CARGO_PKG_VERSION"),
            case_sha256: case.text_hash.clone(),
        }
    }
}

fn mass(choice: &Choice) -> String {
    choice.mass.map_or_else(dash, |mass| format!("{} g", significant(1e3 * mass, 4)))
}

fn dash() -> String {
    "–".to_owned()
}

/// Column of what simulation finds, which not every objective has.
const SIMULATED: usize = 5;

fn absorbers(words: &Words) -> Table {
    let found = words.found;
    let value = |score: Option<f64>| score.map_or_else(dash, |score| words.value(score));
    let row = |name: &str, one: &Chosen| {
        [
            name.to_owned(),
            words.length(one.choice.clearance),
            significant(one.choice.restitution, 4),
            mass(&one.choice),
            words.value(one.score),
            value(one.simulated),
            value(one.expected),
        ]
    };
    let mut rows = vec![row("the case", &found.own)];
    if found.reached() {
        rows.push(row("optimum", &found.nominal));
        rows.extend(found.robust.iter().map(|robust| row("robust optimum", robust)));
    }
    let columns = [
        ("Absorber", false),
        ("Clearance", true),
        ("Restitution", true),
        ("Mass", true),
        ("Objective", true),
        ("As simulated", true),
        ("Expected", true),
    ];
    let mut table = table(columns, rows);
    if found.nominal.simulated.is_none() {
        table.columns.remove(SIMULATED);
        table.rows.iter_mut().for_each(|row| drop(row.remove(SIMULATED)));
    }
    table
}

fn looked_for(words: &Words) -> String {
    let bounds = words.found.task.bounds.iter().map(|bounds| {
        let Bounds { variable, from, to } = *bounds;
        match variable {
            Variable::Clearance => {
                format!("clearance {} to {}", words.length(from), words.length(to))
            }
            Variable::Restitution => {
                format!("restitution {} to {}", significant(from, 3), significant(to, 3))
            }
            Variable::Mass => {
                format!("mass {} to {} g", significant(1e3 * from, 4), significant(1e3 * to, 4))
            }
        }
    });
    let bounds: Vec<String> = bounds.collect();
    let asked = format!("Objective: {}. Bounds: {}.", words.objective_words(), bounds.join(", "));
    if words.uncertain.is_empty() {
        return asked;
    }
    format!("{asked} Uncertain: {}.", words.uncertain.join("; "))
}

fn confirmed(words: &Words) -> Table {
    let rows = words.found.confirmed.iter().map(|place| {
        [
            words.at(place.at),
            place.exact.map_or_else(dash, |exact| words.lengths.text(exact)),
            format!("{} of {}", place.as_predicted, place.starts),
            if place.asleep > 0 { "never wakes" } else { "wakes" }.to_owned(),
            place.motions.to_string(),
            place.largest.map_or_else(dash, |largest| words.lengths.text(largest)),
        ]
    });
    let at = if words.over_amplitude() { "Amplitude" } else { "Frequency" };
    table(
        [
            (at, true),
            ("Exact orbit", true),
            ("Starts that led to it", true),
            ("From rest the absorber", false),
            ("Motions with impacts", true),
            ("Largest amplitude", true),
        ],
        rows.collect(),
    )
}

fn sensitivities(words: &Words) -> Table {
    let rows = words.found.sensitivities.iter().map(|one| {
        let name = match one.of {
            Changed::Clearance => "clearance",
            Changed::Restitution => "restitution",
            Changed::Mass => "mass",
            Changed::Frequency => "frequency",
            Changed::Amplitude => "amplitude",
        };
        let value = |score: Option<f64>| score.map_or_else(dash, |score| words.value(score));
        [
            name.to_owned(),
            percent(one.change),
            value(one.smaller),
            words.value(words.found.nominal.score),
            value(one.larger),
        ]
    });
    table(
        [
            ("Parameter", false),
            ("Change", true),
            ("Smaller", true),
            ("As it is", true),
            ("Larger", true),
        ],
        rows.collect(),
    )
}

/// What the terminal shows.
pub fn summary(case: &Case, found: &Optimization) -> String {
    use std::fmt::Write as _;
    let words = Words::new(case, found);
    let mut text = format!("{}\n\n{}\n", case.title, words.headline());
    for sentence in words.sentences() {
        let _ = writeln!(text, "{sentence}");
    }
    let _ = writeln!(text, "{}\n", looked_for(&words));
    let absorbers = absorbers(&words);
    let titles: Vec<&str> = absorbers.columns.iter().map(|column| column.title).collect();
    for row in std::iter::once(titles).chain(
        absorbers.rows.iter().map(|row| row.iter().map(String::as_str).collect::<Vec<&str>>()),
    ) {
        let [name, values @ ..] = row.as_slice() else { continue };
        let values: String = values.iter().map(|value| format!("{value:>14}")).collect();
        let _ = writeln!(text, "{name:16}{values}");
    }
    let _ = writeln!(text);
    if found.reached() {
        let _ = writeln!(text, "{}", words.confirmed());
    }
    for sentence in words.claim() {
        let _ = writeln!(text, "{sentence}");
    }
    text
}

/// Which absorber is written: the best, or the best in expectation where `robust` and something is
/// uncertain.
pub fn written(case: &Case, found: &Optimization, robust: bool) -> String {
    let words = Words::new(case, found);
    match &found.robust {
        Some(best) if robust => format!("the robust optimum, {}", words.absorber(&best.choice)),
        _ => format!("the optimum, {}", words.absorber(&found.nominal.choice)),
    }
}

/// `vinesink/optimization@1`. Lengths in metres or the case's own unit; objectives as they are spoken
/// of, so that an amplitude is positive.
#[derive(Debug, Clone, Serialize)]
pub struct OptimizationDocument {
    format: &'static str,
    title: String,
    objective: &'static str,
    bounds: Vec<Bounds>,
    /// The frequency's as a frequency ratio, the amplitude's over the case's own.
    uncertainty: Uncertainty,
    reached: bool,
    own: ChosenDocument,
    /// None where nothing reaches the objective, and nothing is said of it then.
    optimum: Option<ChosenDocument>,
    robust: Option<ChosenDocument>,
    /// Pairs of clearance and objective.
    landscape: Vec<(f64, Option<f64>)>,
    /// Pairs of clearance and expected objective.
    robust_landscape: Vec<(f64, Option<f64>)>,
    sensitivities: Vec<Sensitivity>,
    /// What was simulated before one was chosen, in the order of the search.
    candidates: Vec<Candidate>,
    confirmed: Vec<Place>,
    /// Over the case's own clearance.
    claim: Option<ClaimDocument>,
    chart: Vec<chart::Suited>,
    /// SHA-256 of the case file's text.
    case_sha256: String,
}

#[derive(Debug, Clone, Serialize)]
struct ChosenDocument {
    #[serde(flatten)]
    choice: Choice,
    objective: Option<f64>,
    simulated: Option<f64>,
    expected: Option<f64>,
    plateau: [f64; 2],
}

#[derive(Debug, Clone, Serialize)]
struct ClaimDocument {
    #[serde(flatten)]
    claim: Claim,
    distance: f64,
    excess: f64,
    holds: bool,
}

impl OptimizationDocument {
    /// The document of a case.
    pub fn new(case: &Case, found: &Optimization) -> Self {
        let value = |score: f64| Some(found.task.value(score)).filter(|value| value.is_finite());
        let chosen = |one: &Chosen| ChosenDocument {
            choice: one.choice,
            objective: value(one.score),
            simulated: one.simulated.and_then(value),
            expected: one.expected.and_then(value),
            plateau: one.plateau,
        };
        let reached = found.reached();
        let of_best = reached.then_some(found).into_iter();
        let pairs =
            |points: &[(f64, f64)]| points.iter().map(|(at, score)| (*at, value(*score))).collect();
        let spoken = |one: &Sensitivity| Sensitivity {
            smaller: one.smaller.and_then(value),
            larger: one.larger.and_then(value),
            ..*one
        };
        let of_candidate = |one: &Candidate| Candidate {
            score: found.task.value(one.score),
            simulated: found.task.value(one.simulated),
            ..*one
        };
        Self {
            format: "vinesink/optimization@1",
            title: case.title.clone(),
            objective: found.task.objective.name(),
            bounds: found.task.bounds.clone(),
            uncertainty: found.task.uncertainty,
            reached,
            own: chosen(&found.own),
            optimum: reached.then(|| chosen(&found.nominal)),
            robust: found.robust.as_ref().filter(|_| reached).map(chosen),
            landscape: pairs(&found.landscape),
            robust_landscape: pairs(&found.robust_landscape),
            sensitivities: of_best
                .clone()
                .flat_map(|best| best.sensitivities.iter().map(spoken))
                .collect(),
            candidates: found.candidates.iter().map(of_candidate).collect(),
            confirmed: of_best.flat_map(|best| best.confirmed.clone()).collect(),
            claim: found.claim.map(|claim| ClaimDocument {
                claim,
                distance: claim.distance(),
                excess: claim.excess(),
                holds: claim.holds(),
            }),
            chart: found.chart.clone(),
            case_sha256: case.text_hash.clone(),
        }
    }
}
