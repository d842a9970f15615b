//! A case's report as data: quantities, enums and lists, which templates turn into pages and `report.json` keeps.

pub mod criteria;
pub mod motions;
pub mod place;
pub mod theory;

mod band;
mod claims;
mod notes;
mod scale;
mod verdict;

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::Value;

use super::figure::Figure;
use crate::case::{Case, Input};
use crate::criteria::Judged;
use crate::method::Method;
use crate::quantity::catalogue as of;
use crate::quantity::{Quantity, Units};
use crate::study::fidelity::Answers;
use crate::study::{CaseStudy, StudyEffort};

pub use notes::theory_limits;
pub use scale::Scale;
pub use verdict::{Headline, Tone, Verdict, Word};

/// Name and version of the format of `report.json`.
pub const FORMAT: &str = "vinesink/report@2";

/// Relative change of the vibration that is worth calling a change.
const NOTICEABLE: f64 = 0.02;

/// A report. Quantities are in SI, or in the units of a reduced case.
#[derive(Debug, Clone, Serialize)]
pub struct Document {
    /// [`FORMAT`].
    pub format: &'static str,
    /// Stem of the case file.
    pub name: String,
    /// What the case is.
    pub title: String,
    /// Where its numbers come from.
    pub source: String,
    /// `si` or `reduced`.
    pub units: &'static str,
    /// The answer.
    pub verdict: Verdict,
    /// Numbers of the case, and those that its first screen, the index and a comparison show, by their id.
    pub quantities: BTreeMap<&'static str, Quantity>,
    /// What the case asks for, judged.
    pub criteria: Option<Value>,
    /// What limits these results.
    pub notes: Vec<Value>,
    /// The long-term motions, by share of starts; empty where nothing was simulated.
    pub motions: Vec<Value>,
    /// Index of the moving one that most starts lead to.
    pub main: Option<usize>,
    /// Whether anything was simulated.
    pub simulated: bool,
    /// What an inactive absorber leaves.
    pub inactive: Option<Value>,
    /// A tuned mass damper of the same mass at the case's own excitation.
    pub damper: Value,
    /// What theory and exact orbits say.
    pub theory: Value,
    /// What is known along the band.
    pub band: Option<Value>,
    /// Which layer answered what.
    pub answers: Option<Answers>,
    /// The layers against one another.
    pub claims: Vec<Value>,
    /// The numbers of the case file.
    pub inputs: Vec<Input>,
    /// What follows from them.
    pub derived: Vec<Input>,
    /// The figures, in reading order.
    pub figures: Vec<FigureRow>,
    /// Names of figures that the case asks for and that have nothing to show.
    pub left_out: Vec<&'static str>,
    /// What made this report.
    pub provenance: Provenance,
}

/// A figure's words; the drawing is a file of its own.
#[derive(Debug, Clone, Serialize)]
pub struct FigureRow {
    /// File stem under `figures/`.
    pub name: String,
    /// Title.
    pub title: String,
    /// What to see.
    pub caption: String,
    /// What it shows, for those who cannot see it.
    pub alt: String,
    /// Width in pixels at which it is shown.
    pub width: u32,
}

/// What made the report.
#[derive(Debug, Clone, Serialize)]
pub struct Provenance {
    /// The program.
    pub program: &'static str,
    /// Its version.
    pub version: &'static str,
    /// SHA-256 of the case file's text.
    pub case_sha256: String,
    /// How thoroughly the case was simulated.
    pub effort: StudyEffort,
}

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

impl FigureRow {
    /// Of a figure that has its words.
    pub fn of(figure: &Figure) -> Self {
        Self {
            name: figure.name.clone(),
            title: figure.title.clone(),
            caption: figure.caption.clone(),
            alt: figure.alt.clone(),
            width: figure.size.0.min(PAGE_WIDTH),
        }
    }
}

impl Document {
    /// Writes down a study.
    pub fn of(source: &Source) -> Self {
        let Source { case, study, judged, .. } = source;
        let scale = Scale::of(case);
        let system = &study.analysis.system;
        let motions: Vec<Value> = study
            .attractors
            .iter()
            .zip(&study.proofs)
            .map(|(found, proof)| motions::found(&scale, system, found, proof.as_ref()))
            .collect();
        let counted = case.criteria.is_empty() || case.count_inactive;
        let wanted = case.report.figures.iter().map(|wanted| wanted.name());
        let drawn = |name: &str| source.figures.iter().any(|figure| figure.name == name);
        Self {
            format: FORMAT,
            name: source.name.to_owned(),
            title: case.title.clone(),
            source: case.source.clone(),
            units: if scale.units().physical { "si" } else { "reduced" },
            verdict: Verdict::of(study, judged),
            quantities: quantities(&scale, case, study),
            notes: notes::notes(case, study),
            main: study.main_attractor().and_then(|main| {
                study.attractors.iter().position(|found| std::ptr::eq(found, main))
            }),
            simulated: study.simulated,
            inactive: study
                .inactive
                .as_ref()
                .map(|inactive| band::inactive(&scale, inactive, None, counted)),
            damper: band::damper(&scale, &study.rivals, None),
            theory: theory::with_margins(&scale, study),
            band: study.band.as_ref().map(|survey| band::band(&scale, survey)),
            answers: source.answers.cloned(),
            claims: study.claims.iter().map(|claim| claims::claim(&scale, claim)).collect(),
            inputs: case.inputs().to_vec(),
            derived: case.derived(),
            figures: source.figures.iter().map(FigureRow::of).collect(),
            left_out: wanted.filter(|name| !drawn(name)).collect(),
            provenance: Provenance {
                program: env!("CARGO_PKG_NAME"),
                version: env!("CARGO_PKG_VERSION"),
                case_sha256: case.text_hash.clone(),
                effort: study.effort,
            },
            criteria: criteria::criteria(case, judged),
            motions,
        }
    }

    /// The units of its pages.
    pub fn units(case: &Case) -> Units {
        Scale::of(case).units()
    }
}

/// The numbers that stand for a case: its own, and the vibration with and without absorber.
fn quantities(scale: &Scale, case: &Case, study: &CaseStudy) -> BTreeMap<&'static str, Quantity> {
    let system = &study.analysis.system;
    let given = |kind, value| Quantity::new(kind, value, Method::Given);
    let mut all = vec![
        scale.length(&of::CLEARANCE, 1.0, Method::Given),
        given(&of::RESTITUTION, system.restitution()),
        given(&of::MASS_RATIO, system.mass_ratio()),
        scale.amplitude(1.0, Method::Given),
        scale.frequency(system.frequency_ratio(), Method::Given),
        scale.length(&of::BARE_PEAK, study.rivals.bare.1, Method::ClosedForm),
        scale.length(&of::DAMPER_PEAK, study.rivals.damped.amplitude, Method::ClosedForm),
        scale.length(&of::DAMPER_STROKE, study.rivals.damped.stroke, Method::ClosedForm),
    ];
    if let crate::case::Design::Physical(physical) = &case.design {
        all.push(given(&of::ABSORBER_MASS, physical.absorber_mass_kg));
    }
    if let Some(main) = study.main_attractor() {
        all.extend(motions::headline(scale, &main.attractor).into_iter().map(|(_, one)| one));
    } else if let Some(orbit) = study.exact.attracting() {
        let (peak, bare) = (orbit.peaks.displacement, study.rivals.bare.1);
        let change = 20.0 * libm::log10(peak / bare);
        all.push(scale.length(&of::PEAK, peak, Method::ExactOrbit));
        all.push(Quantity::new(&of::CHANGE_DB, change, Method::ExactOrbit));
    }
    all.into_iter().map(|one| (one.kind.id, one)).collect()
}
