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

use super::document::criteria::{badge, criteria, sample};
use super::document::{Content, NOTICEABLE, Word, answer, cavity, figure_row};
use super::figure::{Color, Dash, Figure, Style};
use super::render::{Files, RenderError, page_files, with_document};
use super::template::{render, worded};
use crate::case::Case;
use crate::criteria::Judged;
use crate::measure::{Device, Measure};
use crate::method::Method;
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;
use crate::system::Parameter;
use crate::transient::{Run, Runs, Study};

/// The line of a tuned mass damper.
pub(super) const DAMPER: Style = Style::new(Color::Orange, 1.6, Dash::LongDashed);
/// The line of a predicted decay.
pub(super) const THEORY: Style = Style::new(Color::Blue, 2.0, Dash::Dashed);

/// What a page of such a structure tells beside what is of its scene alone.
const MEASURES: [(Measure, Device); 23] = [
    (Measure::Peak, Device::Absorber),
    (Measure::Peak, Device::Without),
    (Measure::Peak, Device::Damper),
    (Measure::PeakFrequency, Device::Absorber),
    (Measure::PeakFrequency, Device::Without),
    (Measure::PeakFrequency, Device::Damper),
    (Measure::Rms, Device::Absorber),
    (Measure::Rms, Device::Without),
    (Measure::Rms, Device::Damper),
    // Where a criterion asks for one of them.
    (Measure::PeakVelocity, Device::Absorber),
    (Measure::RmsVelocity, Device::Absorber),
    (Measure::PeakAcceleration, Device::Absorber),
    (Measure::RmsAcceleration, Device::Absorber),
    (Measure::ReductionDb, Device::Absorber),
    (Measure::ReductionDbTmd, Device::Absorber),
    (Measure::ImpactSpeed, Device::Absorber),
    (Measure::Impacts, Device::Absorber),
    (Measure::ImpactEnergyShare, Device::Absorber),
    (Measure::Stroke, Device::Damper),
    (Measure::DecayTime, Device::Absorber),
    (Measure::DecayTime, Device::Without),
    (Measure::DecayTime, Device::Damper),
    (Measure::TheoryDecayTime, Device::Absorber),
];

/// The name of a study's templates.
const fn name_of(study: &Study) -> &'static str {
    match study {
        Study::Release(_) => "release",
        Study::Sweep(_) => "sine-sweep",
        Study::Record(_) => "record",
    }
}

/// A report as data, with its figures.
///
/// # Errors
/// [`RenderError`] says which part cannot be rendered.
pub fn drawn(
    name: &str,
    case: &Case,
    study: &Study,
    judged: &[Judged],
) -> Result<(Value, Vec<Figure>), RenderError> {
    let mut facts = document(name, case, study, judged, Content::Report);
    let figures = match study {
        Study::Release(study) => release::figures(case, study, &facts),
        Study::Sweep(study) => sine_sweep::figures(case, study, &facts),
        Study::Record(study) => record::figures(case, study, &facts),
    };
    let figures = worded(figures, &case.units())?;
    facts["figures"] = figures.iter().map(figure_row).collect();
    Ok((facts, figures))
}

/// The files of its folder.
///
/// # Errors
/// [`RenderError`] says which part cannot be rendered.
pub fn files(
    case: &Case,
    study: &Study,
    facts: &Value,
    figures: &[Figure],
) -> Result<Files, RenderError> {
    let tone = facts["verdict"]["tone"].as_str();
    let template = format!("{}.md", name_of(study));
    let files = page_files("report", &template, tone, &case.units(), facts.clone(), figures)?;
    Ok(with_document(files, facts))
}

/// What a terminal shows of a document.
///
/// # Errors
/// [`RenderError::Template`] if the template does not fit.
pub fn text(case: &Case, study: &Study, document: &Value) -> Result<String, RenderError> {
    render(&format!("{}.txt", name_of(study)), &case.units(), document)
}

/// A report as data. Quantities are in SI, or in the units of a reduced case.
pub fn document(
    name: &str,
    case: &Case,
    study: &Study,
    judged: &[Judged],
    content: Content,
) -> Value {
    let (mut quantities, word) = match study {
        Study::Release(study) => (release::quantities(case, study), release::word(study)),
        Study::Sweep(study) => (sine_sweep::quantities(case, study), sine_sweep::word(study)),
        Study::Record(of) => (record::quantities(of), record::word(study)),
    };
    let (units, scene) = (case.units(), case.design.scene());
    let asked = MEASURES.into_iter().filter(|(of, _)| of.is_of(scene));
    quantities.extend(asked.filter_map(|(of, by)| study.quantity(&units, of, by)));
    quantities.extend(given(case));
    let all: BTreeMap<&str, Quantity> = quantities.iter().map(|one| (one.kind.id, *one)).collect();
    let word = badge(judged).unwrap_or(word);
    let warnings = case.warnings().iter();
    let warnings =
        warnings.map(|one| json!({ "kind": "warning", "line": one.line, "message": one.message }));
    let fields = json!({
        "name": name,
        "verdict": { "tone": word.tone(), "word": word, "headline": name_of(study) },
        "quantities": all,
        "criteria": criteria(case, judged),
        "notes": warnings.collect::<Vec<_>>(),
        "count_inactive": case.count_inactive,
        "band": null,
        "inputs": case.inputs(),
        "derived": case.derived(),
        "figures": [],
    });
    let mut document = answer(case, content, fields);
    match study {
        Study::Release(study) => release::add(case, study, &mut document),
        Study::Sweep(study) => sine_sweep::add(case, study, &mut document),
        Study::Record(of) => record::add(case, study, of, &mut document),
    }
    document
}

/// Starts that a page lists.
const LISTED: usize = 10;

/// The worst starts that count, as rows, from the worst on.
fn worst_rows<R: Run>(
    case: &Case,
    runs: &Runs<R>,
    of: Measure,
    row: impl Fn(&(f64, R)) -> Value,
) -> Value {
    runs.sorted(of, case.count_inactive).into_iter().take(LISTED).map(row).collect()
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
