//! A case's report as data: quantities, enums and lists, which templates turn into pages and `report.json` keeps.

pub mod claims;
pub mod criteria;
pub mod motions;
pub mod place;
pub mod theory;

mod band;
mod cavity;
mod decision;
mod deviations;
mod notes;
mod scale;
mod verdict;
mod word;

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::{Value, json};

use super::figure::Figure;
use crate::case::Case;
use crate::criteria::{Judged, method};
use crate::method::Method;
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;
use crate::study::CaseStudy;
use crate::study::fidelity::Answers;
use crate::system::Parameter;

pub(super) use band::{AbsorberAlong, damper, outside};
pub use decision::{Devices, alternatives, decide, designed, edges, range, reliability, together};
pub use notes::theory_limits;
pub use scale::{Scale, cavity, support};
pub use word::{Tone, Word};

/// Name and version of the format of what is known of a case: `report.json`, and what `analyze` and `simulate` print.
pub const FORMAT: &str = "vinesink/answer@2";

/// What a document holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Content {
    /// Everything.
    Report,
    /// Theory, exact orbits and long-term motions.
    Analysis,
    /// What simulation says.
    Simulation,
    /// One flight of a structure that is not driven steadily.
    Flight,
}

/// A document of a case: what all have in common, and the fields of its own.
pub fn answer(case: &Case, content: Content, fields: Value) -> Value {
    let heading = [&case.title, &case.source, &case.text_hash];
    let mut document = headed(heading.map(String::as_str), case.units().name(), content, fields);
    if let Some(support) = scale::support(case) {
        document["support"] = support;
    }
    if content == Content::Report {
        keep_case(&mut document, case.written(), case.files());
    }
    document
}

/// Puts into a report what it was made from, so that a comparison misses none of it: every key of the case as written, and
/// the SHA-256 of each file that the case reads, by its name there.
pub fn keep_case(document: &mut Value, written: Value, files: BTreeMap<String, String>) {
    document["case"] = written;
    let file = |(path, sha256): (String, String)| json!({ "path": path, "sha256": sha256 });
    document["files"] = files.into_iter().map(file).collect();
}

/// The same of any case: its title, source and SHA-256, the name of its units, and the fields.
pub fn headed(
    [title, source, text_hash]: [&str; 3],
    units: &str,
    content: Content,
    fields: Value,
) -> Value {
    let mut document = json!({
        "format": FORMAT,
        "asked": content,
        "title": title,
        "source": source,
        "units": units,
        "provenance": {
            "program": env!("CARGO_PKG_NAME"),
            "version": env!("CARGO_PKG_VERSION"),
            "case_sha256": text_hash,
        },
    });
    if let (Some(all), Value::Object(own)) = (document.as_object_mut(), fields) {
        all.extend(own);
    }
    document
}

/// Relative change of the vibration that is worth calling a change.
pub(super) const NOTICEABLE: f64 = 0.02;

/// What a report is made from.
pub struct Source<'a> {
    /// Stem of the case file.
    pub name: &'a str,
    /// The case.
    pub case: &'a Case,
    /// What was found.
    pub study: &'a CaseStudy,
    /// Its criteria; empty where it has none.
    pub judged: &'a [Judged],
    /// Which layer answers, where accuracy was asked for.
    pub answers: Option<&'a Answers>,
    /// The figures that are drawn beside it.
    pub figures: &'a [Figure],
}

/// Width of a page's column in pixels.
const PAGE_WIDTH: u32 = 720;

/// The words of a figure, whose drawing is a file of its own, and the width in pixels at which it is shown.
pub fn figure_row(figure: &Figure) -> Value {
    json!({
        "name": figure.name,
        "title": figure.title,
        "caption": figure.caption,
        "alt": figure.alt,
        "width": figure.size.0.min(PAGE_WIDTH),
    })
}

/// A report. Quantities are in SI, or in the units of a reduced case.
pub fn document(source: &Source) -> Value {
    let Source { case, study, judged, .. } = source;
    let scale = Scale::of(case);
    let resting = study.motions.rest().or(study.rest.as_ref());
    let wanted = case.report.figures.iter().map(|wanted| wanted.name());
    let drawn = |name: &str| source.figures.iter().any(|figure| figure.name == name);
    let fields = json!({
        "name": source.name,
        "verdict": verdict::verdict(study, judged, case.count_inactive),
        // Numbers of the case, and those that its first screen, the index and a comparison show, by their id.
        "quantities": quantities(&scale, case, study),
        "criteria": criteria::criteria(case, judged),
        "notes": notes::notes(case, study),
        // Long-term motions by share, and the index of the main one.
        "motions": motions::found(&scale, study, case.count_inactive),
        "main": study.motions.main_index(),
        "simulated": study.simulated,
        "inactive": resting.and_then(|one| band::inactive(&scale, one, None, case.count_inactive)),
        // A tuned mass damper of the same mass at the case's own excitation.
        "damper": band::damper(&scale, &study.rivals, None),
        "theory": theory::with_margins(&scale, study),
        "band": study.band.as_ref().map(|survey| {
            let mut told = band::band(&scale, survey);
            told["decides"] = json!(band::decides(case, &scale, survey, judged));
            told
        }),
        // The motions at the places of the band that were looked at.
        "places": study.band.as_ref().map(|survey| {
            motions::places(&scale, &survey.motions, survey.count_rest)
        }),
        // The case in rigs that differ from it by a little, the worst first.
        "deviations": study.deviations.as_ref().map(|one| deviations::deviations(&scale, one)),
        // Which layer answered what.
        "answers": source.answers,
        "claims": study.claims.iter().map(|one| claims::claim(&scale.units, one)).collect::<Vec<_>>(),
        "inputs": case.inputs(),
        "derived": case.derived(),
        // In reading order, and the names of those that the case asks for and that have nothing to show.
        "figures": source.figures.iter().map(figure_row).collect::<Vec<_>>(),
        "left_out": wanted.filter(|name| !drawn(name)).collect::<Vec<_>>(),
    });
    let mut document = answer(case, Content::Report, fields);
    document["provenance"]["effort"] = json!(study.effort);
    document
}

/// The numbers that stand for a case: its own, and the vibration with and without absorber.
fn quantities(scale: &Scale, case: &Case, study: &CaseStudy) -> BTreeMap<&'static str, Quantity> {
    let system = &study.analysis.system;
    let given = |kind, value| Quantity::new(kind, value, Method::Given);
    let mut all = vec![
        scale.units.quantity(&of::CLEARANCE, 1.0, Method::Given),
        given(&of::RESTITUTION, system.restitution()),
        given(&of::MASS_RATIO, system.mass_ratio()),
        scale.amplitude(1.0, Method::Given),
        scale.frequency(system.frequency_ratio(), Method::Given),
        scale.units.quantity(&of::BARE_PEAK, study.rivals.bare.1, Method::ClosedForm),
        scale.units.quantity(&of::DAMPER_PEAK, study.rivals.damped.amplitude, Method::ClosedForm),
        scale.units.quantity(&of::DAMPER_STROKE, study.rivals.damped.stroke, Method::ClosedForm),
    ];
    let mass = case.design.value(Parameter::AbsorberMass);
    all.extend(mass.map(|mass| given(&of::ABSORBER_MASS, mass)));
    all.extend(scale::cavity(case));
    if let Some(main) = study.motions.main() {
        let headline = motions::headline(scale, system, main.facts(), method(main));
        all.extend(headline.into_iter().map(|(_, one)| one));
    } else if let Some(peak) = study.exact.attracting_peak() {
        let bare = study.rivals.bare.1;
        let change = 20.0 * libm::log10(peak / bare);
        all.push(scale.units.quantity(&of::PEAK, peak, Method::ExactOrbit));
        all.push(Quantity::new(&of::CHANGE_DB, change, Method::ExactOrbit));
    }
    all.into_iter().map(|one| (one.kind.id, one)).collect()
}
