//! A structure that is not driven steadily: its report, and what `analyze`, `simulate` and `optimize` print of it. The
//! sentences are in `templates/`, a page and a text for each kind.

mod flight;
mod optimum;
mod record;
mod release;
mod sine_sweep;

use std::collections::BTreeMap;

use serde_json::{Value, json};

pub use flight::{flight, flight_text};
pub use optimum::{optimum, optimum_text};

use super::document::criteria::{badge, criteria};
use super::document::{FORMAT, NOTICEABLE, Word, cavity, figure_row};
use super::figure::{Color, Dash, Style};
use super::render::{Files, RenderError, in_lines, page_files};
use super::template::{render, worded};
use crate::case::Case;
use crate::criteria::Judged;
use crate::flights::share_above;
use crate::method::Method;
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;
use crate::system::Parameter;
use crate::transient::Study;

/// The line of a tuned mass damper.
pub(super) const DAMPER: Style = Style::new(Color::Orange, 1.6, Dash::LongDashed);
/// The line of a predicted decay.
pub(super) const THEORY: Style = Style::new(Color::Blue, 2.0, Dash::Dashed);

/// The name of a study's templates.
const fn name_of(study: &Study) -> &'static str {
    match study {
        Study::Release(_) => "release",
        Study::Sweep(_) => "sine-sweep",
        Study::Record(_) => "record",
    }
}

/// The files of a report's folder.
///
/// # Errors
/// [`RenderError`] says which part cannot be rendered.
pub fn files(
    name: &str,
    case: &Case,
    study: &Study,
    judged: &[Judged],
) -> Result<Files, RenderError> {
    let mut facts = document(name, case, study, judged);
    let figures = match study {
        Study::Release(study) => release::figures(case, study, &facts),
        Study::Sweep(study) => sine_sweep::figures(case, study, &facts),
        Study::Record(study) => record::figures(case, study, &facts),
    };
    let units = case.units();
    let figures = worded(figures, &units)?;
    facts["figures"] = figures.iter().map(figure_row).collect();
    let json = format!("{}\n", in_lines(&facts, 0));
    let tone = facts["verdict"]["tone"].as_str().unwrap_or_default().to_owned();
    let template = format!("{}.md", name_of(study));
    let mut files = page_files("report", &template, Some(&tone), &units, facts, &figures)?;
    files.insert("report.json".into(), json.into_bytes());
    Ok(files)
}

/// What a terminal shows of a document.
///
/// # Errors
/// [`RenderError::Template`] if the template does not fit.
pub fn text(case: &Case, study: &Study, document: &Value) -> Result<String, RenderError> {
    render(&format!("{}.txt", name_of(study)), &case.units(), document)
}

/// A report as data. Quantities are in SI, or in the units of a reduced case.
pub fn document(name: &str, case: &Case, study: &Study, judged: &[Judged]) -> Value {
    let (mut quantities, word) = match study {
        Study::Release(study) => (release::quantities(case, study), release::word(study)),
        Study::Sweep(study) => (sine_sweep::quantities(case, study), sine_sweep::word(study)),
        Study::Record(study) => (record::quantities(case, study), record::word(study)),
    };
    quantities.extend(given(case));
    let all: BTreeMap<&str, Quantity> = quantities.iter().map(|one| (one.kind.id, *one)).collect();
    let word = badge(judged).unwrap_or(word);
    let warnings = case.warnings().iter();
    let warnings =
        warnings.map(|one| json!({ "kind": "warning", "line": one.line, "message": one.message }));
    let mut document = json!({
        "format": FORMAT,
        "name": name,
        "title": case.title,
        "source": case.source,
        "units": case.units().name(),
        "verdict": { "tone": word.tone(), "word": word, "headline": name_of(study) },
        "quantities": all,
        "criteria": criteria(case, judged),
        "notes": warnings.collect::<Vec<_>>(),
        "count_inactive": case.count_inactive,
        "band": null,
        "inputs": case.inputs(),
        "derived": case.derived(),
        "figures": [],
        "provenance": {
            "program": env!("CARGO_PKG_NAME"),
            "version": env!("CARGO_PKG_VERSION"),
            "case_sha256": case.text_hash,
        },
    });
    match study {
        Study::Release(study) => release::add(case, study, &mut document),
        Study::Sweep(study) => sine_sweep::add(case, study, &mut document),
        Study::Record(study) => record::add(case, study, &mut document),
    }
    document
}

/// From which places of the absorber numbers are known: even ones, all, and the share of places that are worse than the
/// worst of the even ones, at most, at odds of 19 to 1.
fn sample(even: u64, all: usize) -> Value {
    json!({ "even": even, "all": all, "share_above": share_above(even) })
}

/// Starts that a page lists.
const LISTED: usize = 10;

/// The worst starts, as rows, from the worst on.
fn worst_rows<T>(starts: &[T], badness: impl Fn(&T) -> f64, row: impl Fn(&T) -> Value) -> Value {
    let mut starts: Vec<&T> = starts.iter().collect();
    starts.sort_by(|a, b| badness(b).total_cmp(&badness(a)));
    starts.into_iter().take(LISTED).map(row).collect()
}

/// What the case says of its absorber.
fn given(case: &Case) -> Vec<Quantity> {
    let system = case.system();
    let given = |kind, value| Quantity::new(kind, value, Method::Given);
    let mass = case.design.value(Parameter::AbsorberMass);
    let own = [
        case.units().quantity(&of::CLEARANCE, 1.0, Method::Given),
        given(&of::RESTITUTION, system.restitution()),
        given(&of::MASS_RATIO, system.mass_ratio()),
        // A reduced design's is over the structure's.
        given(&of::ABSORBER_MASS, mass.unwrap_or(system.mass_ratio())),
    ];
    own.into_iter().chain(cavity(case)).collect()
}

/// The answer where there are no criteria, from the worst and the best of what counts over the structure alone.
fn word_of(worst: f64, best: f64) -> Word {
    if worst < 1.0 - NOTICEABLE {
        Word::Works
    } else if best < 1.0 - NOTICEABLE {
        Word::Mixed
    } else if worst > 1.0 + NOTICEABLE {
        Word::MakesItWorse
    } else {
        Word::DoesNothing
    }
}
