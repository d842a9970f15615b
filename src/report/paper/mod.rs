//! The page that sets every figure of the paper beside what the program finds.
//!
//! It is made from studies of the shipped cases: each figure of Li, Seguy, Berlioz 2016 has a
//! section with images of the cases' reports, what the paper shows, what is found, a list of
//! claims that the program checks, and what the paper leaves out. The verdict follows from the
//! claims; every number is computed.

mod boundaries;
mod dynamics;
mod findings;
mod regimes;

use serde::Serialize;

use super::figure::Figure;
use super::numbers::LengthFormat;
use super::render::RenderError;
use crate::case::Case;
use crate::regimes::{FoundAttractor, Regime};
use crate::study::{CaseStudy, StudyError};

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

/// Why the page cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum PaperError {
    /// A case that the page is made from was not given.
    #[error("the page needs the case `{0}`, which was not given")]
    NoCase(&'static str),
    /// A case's report lacks a figure.
    #[error(
        "the report of `{case}` has no figure `{figure}`; its table [report] should ask for it"
    )]
    NoFigure {
        /// The case.
        case: &'static str,
        /// The figure.
        figure: &'static str,
    },
    /// A quantity that the page states does not exist for the case that should give it.
    #[error("the case `{case}` gives no {what}")]
    NoResult {
        /// The case.
        case: &'static str,
        /// What is missing.
        what: &'static str,
    },
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
    pub name: String,
    /// The case.
    pub case: Case,
    /// All that is known of it.
    pub study: CaseStudy,
    /// The figures of its report.
    pub figures: Vec<Figure>,
}

impl CaseReport {
    /// A length over the clearance in words.
    fn length(&self, over_clearance: f64) -> String {
        let scales = self.case.scales();
        LengthFormat::of(&scales).text(scales.length(over_clearance))
    }

    /// The moving attractor that most starts lead to.
    fn main(&self) -> Option<&FoundAttractor> {
        self.study.main_attractor()
    }

    fn regime(&self) -> Option<Regime> {
        self.main().map(FoundAttractor::regime)
    }
}

/// Studied cases by name.
struct CaseSet<'a>(&'a [CaseReport]);

impl<'a> CaseSet<'a> {
    fn case(&self, name: &'static str) -> Result<&'a CaseReport, PaperError> {
        self.0.iter().find(|member| member.name == name).ok_or(PaperError::NoCase(name))
    }

    fn image(
        &self,
        case: &'static str,
        name: &'static str,
        width: u32,
    ) -> Result<Image, PaperError> {
        let figure = self.case(case)?.figures.iter().find(|figure| figure.name == name);
        let figure = figure.ok_or(PaperError::NoFigure { case, figure: name })?;
        Ok(Image {
            path: format!("{case}/figures/{name}.svg"),
            report: format!("{case}/report.md"),
            title: self.case(case)?.case.title.clone(),
            caption: figure.caption.clone(),
            alt: figure.alt.clone(),
            width: width.min(figure.size.0),
        })
    }
}

/// A figure of a report.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Image {
    /// Where it is, from the page.
    path: String,
    /// The report it belongs to, from the page.
    report: String,
    /// The case's title.
    title: String,
    caption: String,
    alt: String,
    width: u32,
}

/// A statement of the paper, and whether the program finds it so.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Check {
    /// The statement with the numbers that decide it, as Markdown.
    words: String,
    holds: bool,
}

/// What became of a figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum Outcome {
    /// Every check holds.
    Reproduced,
    /// Some do.
    WithDifference,
    /// None does.
    Differs,
}

impl Outcome {
    fn of(checks: &[Check]) -> Self {
        match checks.iter().filter(|check| check.holds).count() {
            held if held == checks.len() => Self::Reproduced,
            0 => Self::Differs,
            _ => Self::WithDifference,
        }
    }

    /// The verdict word.
    #[must_use]
    pub const fn words(self) -> &'static str {
        match self {
            Self::Reproduced => "reproduced",
            Self::WithDifference => "reproduced with a difference",
            Self::Differs => "differs",
        }
    }
}

/// One figure of the paper. Text is Markdown, a sentence a line.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Section {
    number: &'static str,
    title: &'static str,
    verdict: &'static str,
    /// What the paper shows.
    paper: &'static str,
    images: Vec<Image>,
    checks: Vec<Check>,
    /// What differs and why, and what else was found.
    remarks: Vec<String>,
    /// What the paper does not give.
    missing: &'static str,
}

/// What is found by reading a figure's section, before the verdict is drawn.
struct Draft {
    number: &'static str,
    title: &'static str,
    paper: &'static str,
    images: Vec<Image>,
    checks: Vec<Check>,
    remarks: Vec<String>,
    missing: &'static str,
}

impl From<Draft> for Section {
    fn from(draft: Draft) -> Self {
        let Draft { number, title, paper, images, checks, remarks, missing } = draft;
        let verdict = Outcome::of(&checks).words();
        Self { number, title, verdict, paper, images, checks, remarks, missing }
    }
}

/// A statement that the program decides.
fn check(holds: bool, words: impl Into<String>) -> Check {
    Check { words: words.into(), holds }
}

/// The page.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Paper {
    /// What an expert should know before reading on.
    pub findings: Vec<String>,
    /// The figures that can be computed, in order.
    pub sections: Vec<Section>,
    /// Limits of steady 1:1 resonance by each layer that gives one.
    pub limits: Vec<findings::Limit>,
}

impl Paper {
    /// Makes the page from studies of [`CASES`] and [`TRANSFER`].
    ///
    /// # Errors
    /// [`PaperError`] names what is missing.
    pub fn of(members: &[CaseReport]) -> Result<Self, PaperError> {
        let shelf = CaseSet(members);
        let sections = vec![
            boundaries::figure_3(&shelf)?.into(),
            regimes::figure_4(&shelf)?.into(),
            boundaries::figure_5(&shelf)?.into(),
            boundaries::figure_6(&shelf)?.into(),
            boundaries::figure_7(&shelf)?.into(),
            dynamics::figure_8(&shelf)?.into(),
            dynamics::figure_9(&shelf)?.into(),
            regimes::figure_11(&shelf)?.into(),
            dynamics::figure_12(&shelf)?.into(),
        ];
        Ok(Self {
            findings: findings::findings(&shelf)?,
            sections,
            limits: findings::limits(&shelf)?,
        })
    }

    /// The page as Markdown.
    ///
    /// # Errors
    /// [`PaperError::Render`] if template and page do not fit.
    pub fn markdown(&self) -> Result<String, PaperError> {
        Ok(super::render::paper(self)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_verdict_follows_from_the_checks() {
        let outcome = |holds: &[bool]| {
            let checks: Vec<Check> = holds.iter().map(|holds| check(*holds, "")).collect();
            Outcome::of(&checks)
        };
        assert_eq!(outcome(&[true, true]), Outcome::Reproduced);
        assert_eq!(outcome(&[true, false]), Outcome::WithDifference);
        assert_eq!(outcome(&[false, false]), Outcome::Differs);
    }

    #[test]
    fn a_case_that_is_not_there_is_named() {
        let error = Paper::of(&[]).expect_err("needs cases");
        assert!(error.to_string().contains("`li2016-8p5hz-fig4c`"), "{error}");
    }
}
