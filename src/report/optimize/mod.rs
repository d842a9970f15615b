//! The page of `vinesink optimize`: the best absorber in words, tables and two figures.

mod damper;
mod figure;
mod words;

use serde::Serialize;

use super::FigureRow;
use super::figure::Figure;
use super::numbers::{percent, significant};
use super::tables::{Table, table};
use crate::band::simulated::Place;
use crate::case::{AbsorberDesign, Case, Uncertainty};
use crate::optimize::claim::Claim;
use crate::optimize::robust::{Robust, UnderDeviations};
use crate::optimize::sensitivity::{Changed, Sensitivity};
use crate::optimize::{Bounds, Design, Optimization, Variable, chart};
use damper::DamperDocument;
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
    /// What the survey finds with the best, place by place; empty where nothing was simulated.
    pub surveyed: Table,
    /// What a change of each parameter does.
    pub sensitivities: Table,
    /// How it was found, a sentence each.
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
            surveyed: surveyed(&words),
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

fn mass(choice: &AbsorberDesign) -> String {
    choice.mass.map_or_else(dash, mass_text)
}

/// A mass in kilograms with the prefix that suits it.
fn mass_text(kilograms: f64) -> String {
    match kilograms {
        some if some >= 1.0 => format!("{} kg", significant(some, 4)),
        some => format!("{} g", significant(1e3 * some, 4)),
    }
}

fn dash() -> String {
    "–".to_owned()
}

fn absorbers(words: &Words) -> Table {
    let found = words.found;
    let dashed = |value: Option<f64>| value.map_or_else(dash, |value| words.value(value));
    let row = |name: &str, one: &Design, under: Option<UnderDeviations>| {
        let holding = one.criteria.iter().filter(|judged| judged.holds == Some(true)).count();
        [
            name.to_owned(),
            words.length(one.choice.clearance),
            significant(one.choice.restitution, 4),
            mass(&one.choice),
            words.of(one),
            if one.criteria.is_empty() {
                dash()
            } else {
                format!("{holding} of {}", one.criteria.len())
            },
            dashed(under.map(|under| under.expected)),
        ]
    };
    let under = |k: usize| found.robust.as_ref().map(|robust| robust.under[k]);
    let mut rows = vec![row("the case", &found.own, None)];
    if found.improves() {
        rows.push(row("optimum", &found.best, under(1)));
        rows.extend(
            found.robust.iter().map(|robust| row("robust optimum", &robust.design, under(0))),
        );
    }
    let columns = [
        ("Absorber", false),
        ("Clearance", true),
        ("Restitution", true),
        ("Mass", true),
        ("Objective", true),
        ("Criteria that hold", true),
        ("Expected", true),
    ];
    table(columns, rows)
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
                format!("mass {} to {}", mass_text(from), mass_text(to))
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

/// Places of the band that the table shows, the worst one included.
const SHOWN: usize = 9;

/// What the survey finds with the best absorber at some of its places.
fn surveyed(words: &Words) -> Table {
    let best = &words.found.best;
    let places = &best.motions.places;
    let worst = best.worst.map(|worst| worst.at);
    let length = |over: f64| words.lengths.text(over * best.choice.clearance);
    let every = places.len().div_ceil(SHOWN).max(1);
    let shown = |k: usize, place: &Place| k.is_multiple_of(every) || Some(place.at) == worst;
    let chosen = places.iter().enumerate().filter(|(k, place)| shown(*k, place));
    let rows = chosen.map(|(_, place)| {
        let largest = place.largest().map(|motion| {
            let [peak, error] =
                [motion.peak, motion.peak_error].map(|one| one * best.choice.clearance);
            match words.is_amplitude() {
                true => words.value_with_error(peak, error),
                false => words.lengths.text(peak),
            }
        });
        let inactive = place.inactive.map(|one| {
            format!("{}, {} of resting places", length(one.amplitude), percent(one.share))
        });
        [
            words.at(place.at),
            place.orbit.map_or_else(dash, length),
            place.motions.len().to_string(),
            largest.unwrap_or_else(dash),
            inactive.unwrap_or_else(dash),
        ]
    });
    let at = if words.over_amplitude() { "Amplitude" } else { "Frequency" };
    table(
        [
            (at, true),
            ("Stable 1:1 orbit", true),
            ("Motions with impacts", true),
            ("Largest peak of these", true),
            ("Absorber never wakes", true),
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
        let task = &words.found.task;
        let value =
            |score: Option<f64>| score.map_or_else(dash, |score| words.value(task.value(score)));
        [
            name.to_owned(),
            percent(one.change),
            value(one.smaller),
            value(Some(words.found.best.score(task.objective))),
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
    let titles = absorbers.columns.iter().map(|column| column.title.to_owned()).collect();
    let lines: Vec<Vec<String>> = std::iter::once(titles).chain(absorbers.rows).collect();
    let width = |column: usize| lines.iter().map(|line| line[column].chars().count()).max();
    let widths: Vec<usize> = (0..lines[0].len()).map(|k| width(k).unwrap_or(0)).collect();
    for line in &lines {
        let cells = line.iter().zip(&widths).enumerate();
        let cells = cells.map(|(k, (cell, width))| match k {
            0 => format!("{cell:width$}"),
            _ => format!("  {cell:>width$}"),
        });
        let _ = writeln!(text, "{}", cells.collect::<String>());
    }
    let _ = writeln!(text);
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
        Some(best) if robust => {
            format!("the robust optimum, {}", words.absorber(&best.design.choice))
        }
        _ => format!("the optimum, {}", words.absorber(&found.best.choice)),
    }
}

/// `vinesink/optimization@2`. Lengths in metres or the case's own unit.
#[derive(Debug, Clone, Serialize)]
pub struct OptimizationDocument {
    format: &'static str,
    title: String,
    objective: &'static str,
    bounds: Vec<Bounds>,
    /// The frequency's as a frequency ratio, the amplitude's over the case's own.
    uncertainty: Uncertainty,
    /// Whether the objective has a value at all.
    reached: bool,
    /// Whether all criteria hold at the optimum; true without criteria.
    feasible: bool,
    /// Whether the optimum is another absorber than the case's own, and not worse.
    improves: bool,
    /// The best absorber, rounded as it is written; none where nothing is reached.
    optimum: Option<AbsorberDesign>,
    /// The objective at the optimum as it is shown, and as a check of the written case gives it.
    claimed: ValueDocument,
    checked: ValueDocument,
    own: DesignDocument,
    /// Where nothing meets all criteria, the absorber that misses them least.
    closest: Option<DesignDocument>,
    robust: Option<RobustDocument>,
    /// Clearances that are as good as the optimum's.
    plateau: [f64; 2],
    bare: Option<f64>,
    tuned_mass_damper: DamperDocument,
    /// Pairs of clearance and objective by the cheap layer.
    landscape: Vec<(f64, Option<f64>)>,
    /// Every absorber that was judged.
    judged: Vec<JudgedDocument>,
    sensitivities: Vec<Sensitivity>,
    /// Over the case's own clearance.
    claim: Option<ClaimDocument>,
    chart: Vec<chart::Suited>,
    /// SHA-256 of the case file's text.
    case_sha256: String,
}

/// A value of the objective and how much worse it may be.
#[derive(Debug, Clone, Serialize)]
struct ValueDocument {
    value: Option<f64>,
    error: f64,
}

#[derive(Debug, Clone, Serialize)]
struct DesignDocument {
    #[serde(flatten)]
    choice: AbsorberDesign,
    #[serde(flatten)]
    objective: ValueDocument,
    feasible: bool,
}

#[derive(Debug, Clone, Serialize)]
struct RobustDocument {
    #[serde(flatten)]
    design: DesignDocument,
    expected: Option<f64>,
    worst_corner: Option<f64>,
    /// The same for the optimum as written.
    optimum_expected: Option<f64>,
    optimum_worst_corner: Option<f64>,
}

#[derive(Debug, Clone, Serialize)]
struct JudgedDocument {
    clearance: f64,
    #[serde(flatten)]
    objective: ValueDocument,
    feasible: bool,
}

#[derive(Debug, Clone, Serialize)]
struct ClaimDocument {
    #[serde(flatten)]
    claim: Claim,
    distance: f64,
    excess: f64,
    holds: bool,
}

fn finite(value: f64) -> Option<f64> {
    Some(value).filter(|value| value.is_finite())
}

impl DesignDocument {
    fn new(design: &Design) -> Self {
        let objective = ValueDocument { value: finite(design.value), error: design.error };
        Self { choice: design.choice, objective, feasible: design.is_feasible() }
    }
}

impl OptimizationDocument {
    /// The document of a case.
    pub fn new(case: &Case, found: &Optimization) -> Self {
        let (best, task) = (&found.best, &found.task);
        let reached = found.reached();
        let spoken = |one: &Sensitivity| Sensitivity {
            smaller: one.smaller.and_then(|score| finite(task.value(score))),
            larger: one.larger.and_then(|score| finite(task.value(score))),
            ..*one
        };
        let robust = |one: &Robust| RobustDocument {
            design: DesignDocument::new(&one.design),
            expected: finite(one.under[0].expected),
            worst_corner: finite(one.under[0].worst_corner),
            optimum_expected: finite(one.under[1].expected),
            optimum_worst_corner: finite(one.under[1].worst_corner),
        };
        let length = |over: f64| finite(over * best.choice.clearance);
        Self {
            format: "vinesink/optimization@2",
            title: case.title.clone(),
            objective: task.objective.name(),
            bounds: task.bounds.clone(),
            uncertainty: task.uncertainty,
            reached,
            feasible: best.is_feasible(),
            improves: found.improves(),
            optimum: reached.then_some(best.choice),
            claimed: ValueDocument { value: finite(best.value), error: best.error },
            checked: ValueDocument { value: finite(found.checked.0), error: found.checked.1 },
            own: DesignDocument::new(&found.own),
            closest: found.closest.as_ref().map(DesignDocument::new),
            robust: found.robust.as_ref().map(robust),
            plateau: found.plateau,
            bare: length(best.rivals.bare.1),
            tuned_mass_damper: DamperDocument::new(&best.rivals, |over| {
                over * best.choice.clearance
            }),
            landscape: found.landscape.iter().map(|(at, value)| (*at, finite(*value))).collect(),
            judged: found
                .judged
                .iter()
                .map(|one| JudgedDocument {
                    clearance: one.clearance,
                    objective: ValueDocument { value: finite(one.value), error: one.error },
                    feasible: one.feasible,
                })
                .collect(),
            sensitivities: found.sensitivities.iter().map(spoken).collect(),
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
