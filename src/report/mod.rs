//! The report of a case: plain data, decided and formatted here, so that templates only loop and
//! print. [`render`] turns it into Markdown, HTML and JSON; figures are data too ([`figure`]).

pub mod criteria;
pub mod documents;
pub mod extremes;
pub mod figure;
pub mod figures;
pub mod html;
pub mod index;
pub mod numbers;
pub mod optimize;
pub mod paper;
pub mod render;
pub mod stored;
pub mod summary;
pub mod sweep;
pub mod template;
pub mod tradeoff;

mod band;
mod equations;
mod exact_tables;
mod layers;
mod motion_tables;
mod notes;
mod tables;
mod units;
mod verdict;

use serde::Serialize;

use crate::case::Case;
use crate::criteria::Judged;
use crate::study::fidelity::Answers;
use crate::study::{CaseStudy, StudyEffort};
use crate::validation::Claim;
use criteria::{CriteriaDocument, CriterionRow};
use documents::{AnalysisDocument, AttractorDocument};
use figure::Figure;

pub use band::BandDocument;
pub use equations::EquationGroup;
pub use layers::Layers;
pub use notes::Note;
pub use tables::{KeyRow, Table};
pub use verdict::{Tone, Verdict};

/// A whole report.
#[derive(Debug, Clone, Serialize)]
pub struct Report {
    /// `vinesink/report@1`.
    pub format: &'static str,
    /// Stem of the case file.
    pub name: String,
    /// What the case is.
    pub title: String,
    /// Where its numbers come from.
    pub source: String,
    /// The answer, in a few sentences.
    pub verdict: Verdict,
    /// What was refuted, has not settled, or lies outside the theory's range.
    pub notes: Vec<Note>,
    /// Inputs and the results that matter most.
    pub key_rows: Vec<KeyRow>,
    /// Which layer answered what, where the case asks for accuracy or a layer was insisted on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub layers: Option<Layers>,
    /// Whether anything was simulated.
    #[serde(skip)]
    pub simulated: bool,
    /// What the case asks for, judged; left out where it asks for nothing.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub criteria: Vec<CriterionRow>,
    /// The same as a table.
    #[serde(skip)]
    pub criteria_table: Option<Table>,
    /// How many of them hold, in words.
    #[serde(skip)]
    pub criteria_headline: String,
    /// What the band is like, and the theory's areas along it; none without a band.
    #[serde(skip)]
    pub band: Option<[Table; 2]>,
    /// Everything else, as tables.
    pub tables: Tables,
    /// The figures, in reading order; the first belongs to the first screen.
    pub figures: Vec<FigureRow>,
    /// Names of figures that the case asks for and that have nothing to show in it.
    pub left_out: Vec<&'static str>,
    /// The equations with this case's numbers; in Markdown and HTML only.
    #[serde(skip)]
    pub equations: Vec<EquationGroup>,
    /// What made this report.
    pub provenance: Provenance,
    /// The numbers behind the text.
    pub data: ReportData,
}

/// The tables below the first screen.
#[derive(Debug, Clone, Serialize)]
pub struct Tables {
    /// Every long-term motion.
    pub attractors: Table,
    /// What kind of dynamics each of them is, and what says so.
    pub dynamics: Table,
    /// Where their energy goes.
    pub energies: Table,
    /// Fixed points of the slow flow.
    pub fixed_points: Table,
    /// Exact symmetric orbits.
    pub orbits: Table,
    /// Boundaries in clearance, of the theory and of the full system.
    pub boundaries: Table,
    /// The layers against one another.
    pub claims: Table,
    /// Why the tolerances in `claims` are what they are, by letter.
    pub tolerance_reasons: Vec<String>,
    /// Quality of the numerics.
    pub numerics: Table,
    /// All numbers of the case.
    pub inputs: Table,
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
    /// The same for those who cannot see it.
    pub alt: String,
    /// Width in pixels at which it is shown.
    pub width: u32,
}

/// Name and version of the format of `report.json`.
pub const FORMAT: &str = "vinesink/report@1";

/// Width of a page's column in pixels.
const PAGE_WIDTH: u32 = 720;

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

/// The numbers behind a report, in full precision.
#[derive(Debug, Clone, Serialize)]
pub struct ReportData {
    /// As `vinesink analyze` prints it.
    pub analysis: AnalysisDocument,
    /// Every attractor.
    pub attractors: Vec<AttractorDocument>,
    /// Every claim.
    pub claims: Vec<Claim>,
    /// Distances to boundaries, by theory.
    pub margins: crate::study::Margins,
    /// What simulation says of them.
    pub confirmations: crate::study::Confirmations,
    /// Amplitude of the oscillator without absorber impacts, in the case's unit of length.
    pub bare_amplitude: Option<f64>,
    /// What is known along the case's band, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub band: Option<BandDocument>,
}

impl Report {
    /// Writes the report of a study; `figures` are the ones that will be rendered beside it.
    pub fn new(name: &str, case: &Case, study: &CaseStudy, figures: &[Figure]) -> Self {
        let scales = case.scales();
        let bare = study.analysis.system.linear_response();
        Self {
            format: FORMAT,
            name: name.to_owned(),
            title: case.title.clone(),
            source: case.source.clone(),
            verdict: verdict::verdict(case, study),
            notes: notes::notes(case, study),
            key_rows: tables::key_rows(case, study),
            layers: None,
            simulated: study.simulated,
            criteria: Vec::new(),
            criteria_table: None,
            criteria_headline: String::new(),
            band: band::tables(case, study),
            tables: Tables {
                attractors: motion_tables::attractors(case, study),
                dynamics: motion_tables::dynamics_table(study),
                energies: motion_tables::energies(case, study),
                fixed_points: tables::fixed_points(case, study),
                orbits: exact_tables::orbits(case, study),
                boundaries: exact_tables::boundaries(case, study),
                claims: tables::claims(case, study),
                tolerance_reasons: tables::lettered_reasons(study),
                numerics: tables::numerics(study),
                inputs: tables::inputs(case),
            },
            figures: figures.iter().map(FigureRow::of).collect(),
            left_out: case
                .report
                .figures
                .iter()
                .map(|wanted| wanted.name())
                .filter(|name| figures.iter().all(|figure| figure.name != *name))
                .collect(),
            equations: equations::groups(case, study),
            provenance: Provenance {
                program: env!("CARGO_PKG_NAME"),
                version: env!("CARGO_PKG_VERSION"),
                case_sha256: case.text_hash.clone(),
                effort: study.effort,
            },
            data: ReportData {
                analysis: AnalysisDocument::new(&study.analysis, &study.exact, study.area, &scales),
                attractors: study
                    .attractors
                    .iter()
                    .zip(&study.proofs)
                    .map(|(found, proof)| AttractorDocument::new(found, proof.as_ref(), &scales))
                    .collect(),
                claims: study.claims.clone(),
                margins: study.margins.clone(),
                confirmations: study.confirmations.clone(),
                bare_amplitude: bare.map(|bare| scales.length(bare.amplitude())),
                band: study.band.as_ref().map(|survey| BandDocument::new(survey, &scales)),
            },
        }
    }
}

impl Report {
    /// Adds the section that says which layer answered.
    #[must_use]
    pub fn with_answers(mut self, case: &Case, answers: &Answers) -> Self {
        let layers = Layers::new(case, answers);
        self.key_rows.extend(layers.key_row());
        self.layers = Some(layers);
        self
    }
}

impl Report {
    /// Adds what the case asks for, judged; it stands on the first screen.
    #[must_use]
    pub fn with_criteria(mut self, case: &Case, judged: &[Judged]) -> Self {
        if judged.is_empty() {
            return self;
        }
        let document = CriteriaDocument::new(&self.name, case, judged);
        self.criteria_headline = numbers::capitalised(&document.headline());
        self.verdict.tone = document.tone();
        self.criteria_table = Some(document.table());
        self.criteria = document.criteria;
        self
    }
}

impl FigureRow {
    fn of(figure: &Figure) -> Self {
        Self {
            name: figure.name.clone(),
            title: figure.title.clone(),
            caption: figure.caption.clone(),
            alt: figure.alt.clone(),
            width: figure.size.0.min(PAGE_WIDTH),
        }
    }
}
