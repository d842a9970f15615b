//! The page that sets every figure of the paper beside what the program finds.
//!
//! It is made from studies of the shipped cases: each figure of Li, Seguy, Berlioz 2016 has a section of
//! the template, with images of the cases' reports, statements that are checked here, and the numbers that
//! decide them. The verdict follows from the checks.

mod boundaries;
mod detuning;
mod dynamics;
mod map;
mod regimes;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde_json::{Value, json};

use vinesink::analysis::ManifoldBranch;
use vinesink::case::Case;
use vinesink::executor::Executor;
use vinesink::motions::{Measured, Motion};
use vinesink::orbits::Bifurcation;
use vinesink::quantity::Units;
use vinesink::regimes::Regime;
use vinesink::report::figure::Figure;
use vinesink::report::render::{Files, RenderError, page_files};
use vinesink::report::template::worded;
use vinesink::study::{CaseStudy, StudyError};
use vinesink::validation::clearances::clearances;

pub use detuning::SETS;

/// The cases that the page is made from, as their files are called.
pub const CASES: [&str; 12] = [
    "li2016-8p5hz-fig4a",
    "li2016-8p5hz-fig4b",
    "li2016-8p5hz-fig4c",
    "li2016-8p5hz-fig4d",
    "li2016-8p5hz-fig4e",
    "li2016-8hz-b0p3mm",
    "li2016-8hz-b2p5mm",
    "li2016-8hz-b4mm",
    "li2016-8hz-b7p5mm",
    "li2016-8hz-b11p5mm",
    "li2016-8hz-b15mm",
    "li2016-8hz-b20mm",
];

/// The case of Fig. 12, further to [`CASES`].
pub const TRANSFER: &str = "li2016-8p5hz-fig12";
/// In the middle of Z3 at 8 Hz and at 8.5 Hz.
const STEADY: [&str; 2] = ["li2016-8hz-b7p5mm", "li2016-8p5hz-fig4c"];
/// Hysteresis at 8 Hz.
const HYSTERESIS: &str = "li2016-8hz-b15mm";

/// Figures of reports beside each figure of the paper: its number, case, name, and the width at which it is
/// shown in pixels.
const IMAGES: [(&str, &str, &str, u32); 28] = [
    ("3", "li2016-8p5hz-fig4c", "sim", 720),
    ("4", "li2016-8p5hz-fig4a", "motion-1", 720),
    ("4", "li2016-8p5hz-fig4b", "motion-1", 720),
    ("4", "li2016-8p5hz-fig4c", "motion-1", 720),
    ("4", "li2016-8p5hz-fig4d", "motion-1", 720),
    ("4", "li2016-8p5hz-fig4e", "motion-1", 720),
    ("4", TRANSFER, "diagram-clearance", 860),
    ("5", TRANSFER, "areas", 860),
    ("5", HYSTERESIS, "areas", 860),
    ("6", TRANSFER, "bifurcations", 860),
    ("6", TRANSFER, "map", 720),
    ("6", TRANSFER, "clearances", 860),
    ("7", TRANSFER, "forcing-responses", 860),
    ("8", TRANSFER, "modulation", 860),
    ("9", "li2016-8hz-b4mm", "restitutions", 860),
    ("9", HYSTERESIS, "restitutions", 860),
    ("11", "li2016-8hz-b0p3mm", "return-map-1", 360),
    ("11", "li2016-8hz-b2p5mm", "return-map-1", 360),
    ("11", "li2016-8hz-b4mm", "return-map-1", 360),
    ("11", "li2016-8hz-b7p5mm", "return-map-1", 360),
    ("11", "li2016-8hz-b11p5mm", "return-map-1", 360),
    ("11", "li2016-8hz-b20mm", "return-map-1", 360),
    ("11", HYSTERESIS, "clearances", 860),
    ("11", HYSTERESIS, "diagram-clearance", 860),
    ("12", TRANSFER, "transfer", 860),
    ("12", TRANSFER, "captures", 860),
    ("12", TRANSFER, "return-map-1", 360),
    ("12", TRANSFER, "transfer-stretches", 720),
];

/// Why the page cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum PaperError {
    /// A case, a figure of its report, or a quantity that the page states is missing.
    #[error("{0}")]
    Missing(String),
    /// A case cannot be studied.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// The page cannot be rendered.
    #[error(transparent)]
    Render(#[from] RenderError),
}

/// A studied case with its figures.
#[derive(Debug)]
pub struct CaseReport {
    /// The case file's stem, which is also its report's folder.
    pub name: &'static str,
    /// The case.
    pub case: Case,
    /// All that is known of it.
    pub study: CaseStudy,
    /// The figures of its report.
    pub figures: Vec<Figure>,
}

impl CaseReport {
    /// A length over the clearance in metres.
    fn length(&self, over_clearance: f64) -> f64 {
        self.case.units().length(over_clearance)
    }

    /// The clearance at which the theory has a boundary, in metres.
    fn boundary(&self, kind: Bifurcation) -> Result<f64, PaperError> {
        let known = clearances(&self.study.analysis);
        let found = known.iter().find(|at| at.kind == kind).map(|at| self.length(at.clearance));
        self.needs(found, kind.words())
    }

    /// Whether fixed points collide on a branch.
    fn collides_on(&self, branch: ManifoldBranch) -> bool {
        self.study.analysis.boundaries.saddle_node.is_some_and(|node| node.branch == branch)
    }

    /// What the case should give.
    fn needs<T>(&self, found: Option<T>, what: &'static str) -> Result<T, PaperError> {
        found
            .ok_or_else(|| PaperError::Missing(format!("the case `{}` gives no {what}", self.name)))
    }

    /// The main motion, and what was measured of it.
    fn main(&self) -> Result<(&Motion, &Measured), PaperError> {
        self.needs(self.study.main(), "motion")
    }

    /// A figure of its report.
    fn image(&self, name: &'static str, width: u32) -> Result<Value, PaperError> {
        let figure = self.figures.iter().find(|figure| figure.name == name);
        let figure = figure.ok_or_else(|| {
            PaperError::Missing(format!(
                "the report of `{}` has no figure `{name}`; its table [report] should ask for it",
                self.name
            ))
        })?;
        Ok(json!({
            "case": self.name,
            "title": self.case.title,
            "name": name,
            "caption": figure.caption,
            "alt": figure.alt,
            "width": width.min(figure.size.0),
        }))
    }

    fn regime(&self) -> Option<Regime> {
        self.study.motions.main().map(Motion::regime)
    }

    fn impacts_per_period(&self) -> Result<f64, PaperError> {
        Ok(self.main()?.0.facts().impacts_per_period.value)
    }
}

/// Studied cases by name.
struct CaseSet<'a>(&'a [CaseReport]);

impl<'a> CaseSet<'a> {
    fn case(&self, name: &'static str) -> Result<&'a CaseReport, PaperError> {
        let missing = || format!("the page needs the case `{name}`, which was not given");
        let found = self.0.iter().find(|member| member.name == name);
        found.ok_or_else(|| PaperError::Missing(missing()))
    }
}

/// What became of a figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FigureOutcome {
    /// Every check holds.
    Reproduced,
    /// Some do.
    WithDifference,
    /// None does.
    Differs,
}

/// One figure of the paper.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PaperFigure {
    verdict: FigureOutcome,
    /// Statements of the paper, and whether the program finds them so.
    checks: BTreeMap<&'static str, bool>,
    /// The numbers that decide them; lengths in metres.
    facts: Value,
    images: Vec<Value>,
}

impl PaperFigure {
    fn new(checks: impl IntoIterator<Item = (&'static str, bool)>, facts: Value) -> Self {
        let checks: BTreeMap<&'static str, bool> = checks.into_iter().collect();
        let verdict = match checks.values().filter(|holds| **holds).count() {
            held if held == checks.len() => FigureOutcome::Reproduced,
            0 => FigureOutcome::Differs,
            _ => FigureOutcome::WithDifference,
        };
        Self { verdict, checks, facts, images: Vec::new() }
    }
}

/// The page `paper.md` and its own figure, in the folder of set A's report, from studies of [`CASES`], [`TRANSFER`] and [`SETS`].
///
/// # Errors
/// [`PaperError`] names what is missing.
pub fn page(members: &[CaseReport], executor: &dyn Executor) -> Result<Files, PaperError> {
    let cases = CaseSet(members);
    let mut sections = BTreeMap::from([
        ("3", boundaries::figure_3(&cases)?),
        ("4", regimes::figure_4(&cases)?),
        ("5", boundaries::figure_5(&cases)?),
        ("6", boundaries::figure_6(&cases)?),
        ("7", boundaries::figure_7(&cases)?),
        ("8", dynamics::figure_8(&cases)?),
        ("9", dynamics::figure_9(&cases)?),
        ("11", regimes::figure_11(&cases)?),
        ("12", dynamics::figure_12(&cases)?),
    ]);
    for (number, case, name, width) in IMAGES {
        let image = cases.case(case)?.image(name, width)?;
        sections.entry(number).and_modify(|section| section.images.push(image));
    }
    let (nearer, figures) = detuning::section(&cases, executor)?;
    let steady = STEADY.map(|name| boundaries::steady(&cases, name));
    let steady = steady.into_iter().collect::<Result<Vec<_>, _>>()?;
    let context = json!({ "sections": sections, "nearer": nearer, "steady": steady });
    let units = Units::physical(cases.case(STEADY[0])?.length(1.0));
    let figures = worded(figures, &units)?;
    let files = page_files("paper", "paper.md", None, &units, context, &figures)?;
    let drawing = |path: &Path| path.extension().is_some_and(|kind| kind == "svg");
    let placed = |path: PathBuf| if drawing(&path) { Path::new(SETS[0]).join(path) } else { path };
    Ok(files.into_iter().map(|(path, bytes)| (placed(path), bytes)).collect())
}

#[cfg(test)]
mod tests;
