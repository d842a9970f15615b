//! The page that sets every figure of the paper beside what the program finds.
//!
//! It is made from studies of the shipped cases: each figure of Li, Seguy, Berlioz 2016 has a section of
//! the template, with images of the cases' reports, statements that are checked here, and the numbers that
//! decide them. The verdict follows from the checks.

mod boundaries;
mod dynamics;
mod regimes;

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::{Value, json};

use crate::analysis::Branch;
use crate::case::Case;
use crate::orbits::Bifurcation;
use crate::quantity::Units;
use crate::regimes::{FoundAttractor, Regime};
use crate::report::figure::Figure;
use crate::report::render::RenderError;
use crate::report::template;
use crate::study::{CaseStudy, StudyError};
use crate::validation::boundaries::clearances;

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
        self.case.scales().length(over_clearance)
    }

    /// The clearance at which the theory has a boundary, in metres.
    fn boundary(&self, kind: Bifurcation) -> Result<f64, PaperError> {
        let known = clearances(&self.study.analysis);
        let found = known.iter().find(|at| at.kind == kind).map(|at| self.length(at.clearance));
        self.needs(found, kind.words())
    }

    /// Whether fixed points collide on a branch.
    fn collides_on(&self, branch: Branch) -> bool {
        self.study.analysis.boundaries.saddle_node.is_some_and(|node| node.branch == branch)
    }

    /// What the case should give.
    fn needs<T>(&self, found: Option<T>, what: &'static str) -> Result<T, PaperError> {
        found
            .ok_or_else(|| PaperError::Missing(format!("the case `{}` gives no {what}", self.name)))
    }

    /// The moving attractor that most starts lead to.
    fn main(&self) -> Result<&FoundAttractor, PaperError> {
        self.needs(self.study.main_attractor(), "motion")
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
        self.study.main_attractor().map(FoundAttractor::regime)
    }

    fn impacts_per_period(&self) -> Result<f64, PaperError> {
        Ok(self.main()?.attractor.classification.evidence.impacts_per_period)
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
pub enum Outcome {
    /// Every check holds.
    Reproduced,
    /// Some do.
    WithDifference,
    /// None does.
    Differs,
}

/// One figure of the paper.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Section {
    verdict: Outcome,
    /// Statements of the paper, and whether the program finds them so.
    checks: BTreeMap<&'static str, bool>,
    /// The numbers that decide them; lengths in metres.
    facts: Value,
    images: Vec<Value>,
}

impl Section {
    fn new(checks: impl IntoIterator<Item = (&'static str, bool)>, facts: Value) -> Self {
        let checks: BTreeMap<&'static str, bool> = checks.into_iter().collect();
        let verdict = match checks.values().filter(|holds| **holds).count() {
            held if held == checks.len() => Outcome::Reproduced,
            0 => Outcome::Differs,
            _ => Outcome::WithDifference,
        };
        Self { verdict, checks, facts, images: Vec::new() }
    }
}

/// The page as Markdown, from studies of [`CASES`] and [`TRANSFER`].
///
/// # Errors
/// [`PaperError`] names what is missing.
pub fn page(members: &[CaseReport]) -> Result<String, PaperError> {
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
    let [steady_8, steady_85] = STEADY.map(|name| boundaries::steady(&cases, name));
    let context = json!({ "figures": sections, "steady": [steady_8?, steady_85?] });
    let units = Units::physical(cases.case(STEADY[0])?.length(1.0));
    Ok(template::render("paper.md", &units, &context)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_verdict_follows_from_the_checks() {
        let outcome = |holds: &[(&'static str, bool)]| {
            Section::new(holds.iter().copied(), Value::Null).verdict
        };
        assert_eq!(outcome(&[("a", true), ("b", true)]), Outcome::Reproduced);
        assert_eq!(outcome(&[("a", true), ("b", false)]), Outcome::WithDifference);
        assert_eq!(outcome(&[("a", false), ("b", false)]), Outcome::Differs);
    }

    /// Every field that the template reads, with made-up numbers.
    #[test]
    fn the_template_fits_what_the_figures_tell() {
        let at = json!({ "clearance": 0.01, "peak": 0.003, "share": 0.4 });
        let stretch = json!({ "change": 0.2, "periods": 5, "impacts": 7, "impulse": 2.5 });
        let panel = json!({
            "letter": "a", "expected": "above-two", "found": "above-two", "clearance": 3e-4,
            "impacts_per_period": 3.0, "rms": 0.002,
        });
        let image = json!({
            "case": "c", "title": "t_t", "name": "n", "caption": "what", "alt": "see", "width": 720,
        });
        let section = |names: &[&'static str], facts: Value| {
            let checks = names.iter().map(|name| (*name, *name != "least_at_the_end"));
            Section { images: vec![image.clone()], ..Section::new(checks, facts) }
        };
        let figures = BTreeMap::from([
            (
                "3",
                section(
                    &["one_stable_branch", "on_the_branch"],
                    json!({
                        "fold": { "B": 1.05, "C": 0.2 }, "breaking": { "B": 1.6812, "C": 0.4 },
                        "away": 0.01, "allowed": 0.03,
                    }),
                ),
            ),
            (
                "4",
                section(
                    &["a", "impacts_fall", "valley"],
                    json!({
                        "panels": [panel], "breaking": 0.01, "doubling": 0.008, "grazing": 0.007,
                    }),
                ),
            ),
            (
                "5",
                section(
                    &["hopf_first", "modulated", "collide", "side_by_side"],
                    json!({
                        "hopf": 0.0265, "collision": 0.0349, "modulated": 0.028,
                        "slow_hopf": 0.0155, "slow_collision": 0.0163, "hysteresis": 0.015,
                    }),
                ),
            ),
            (
                "6",
                section(
                    &["branches", "one_meeting", "least_at_the_end"],
                    json!({
                        "frequency": 8.3036, "detuning": -0.7096, "forcing": 1.119,
                        "clearance": 0.02, "least": at, "last": at, "before": 0.2, "lower": 0.05,
                    }),
                ),
            ),
            ("7", section(&["widest", "none_whole"], json!({ "responses": [at, at, at, at] }))),
            ("8", section(&["modulated", "follows"], json!({ "clearance": 0.028, "away": 0.05 }))),
            (
                "9",
                section(
                    &["lifts_the_fold", "harmonic", "damping", "one_amplitude"],
                    json!({
                        "harmonic": [0.9, 1.0], "damping": [0.4, 0.5], "elastic": 0.5, "dull": 0.4,
                    }),
                ),
            ),
            (
                "11",
                section(
                    &["a", "irregular", "three"],
                    json!({ "panels": [panel], "forcing": {
                        "amplitude": 2.5e-4, "steady_to": 0.0158, "asymmetric": 0.004,
                        "modulated": 0.0115, "least": 2.1e-4, "alone": 1.8e-4, "beside": 2e-4,
                        "missed_by": 0.05, "for_three": 1.9e-4,
                    } }),
                ),
            ),
            (
                "12",
                section(
                    &[
                        "papers_own",
                        "captures",
                        "falls",
                        "sparse",
                        "correlation",
                        "weak",
                        "stronger",
                    ],
                    json!({
                        "papers_own": 0.015, "papers_regime": null, "clearance": 0.028,
                        "captured": 0.6, "longest": 40, "falls": stretch, "sparse": stretch,
                        "correlation": -0.5, "searched": 400,
                    }),
                ),
            ),
        ]);
        let steady = json!({
            "clearance": 0.0075, "peak": 0.00356, "bare": 0.00301, "change_db": 1.45,
            "breaking": 0.0051, "hopf": 0.0155, "collision": 0.0163, "ends_by_collision": true,
            "exact": [0.005, 0.0158], "exact_end": "fold", "simulated": null,
        });
        let context = json!({ "figures": figures, "steady": [steady, steady] });
        let text = template::render("paper.md", &Units::physical(0.0075), &context);
        let text = text.unwrap_or_else(|error| panic!("{error}"));
        for part in [
            "| [5](#fig-5): areas Z1 to Z4, and the two ways out of Z3 | reproduced |",
            "| [6](#fig-6): saddle-node and Hopf boundary, and the regions A1 and A2 | reproduced with a difference |",
            "3.56 mm instead of 3.01 mm (+1.4 dB)",
            "- holds: (a) more than two impacts per period in the paper; found at b = 0.300 mm:",
            "- **does not hold**: The vibration is smallest",
            "8.3036 Hz, $\\sigma = -0.7096$, $\\gamma = 1.119$",
            "[t\\_t](c/report.md): what\n\nChecked:\n\n- holds: One stable branch",
            "(Hopf, 26.5 mm), then two unstable points meet on the left branch and vanish (34.9 mm).",
        ] {
            assert!(text.contains(part), "{part} in\n{text}");
        }
    }

    #[test]
    fn a_case_that_is_not_there_is_named() {
        let error = page(&[]).expect_err("needs cases");
        assert!(error.to_string().contains("`li2016-8p5hz-fig4c`"), "{error}");
    }
}
