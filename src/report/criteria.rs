//! The formats of `vinesink check`: for a terminal, a pull request and build servers.

use std::fmt::Write as _;

use serde::Serialize;

use super::document::Document;
use super::document::criteria::{CriteriaFacts, CriterionFacts, Outcome};
use super::document::place::Place;
use super::figure::escape;
use super::render::RenderError;
use super::template;
use crate::case::Case;
use crate::criteria::Judged;
use crate::method::Method;

/// What became of one case of several.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Checked {
    /// Its criteria were judged.
    Judged(JudgedCase),
    /// It could not be read, or not be judged.
    Failed(FailedCase),
}

/// A case whose criteria were judged.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JudgedCase {
    /// Its name: the stem of its file.
    pub case: String,
    /// Its title.
    pub title: String,
    /// What is probably a slip in its file; left out where nothing is.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Place>,
    /// Whether all hold.
    pub holds: bool,
    /// Whether the motion of an inactive absorber counts.
    pub count_inactive: bool,
    /// One for each line of `[criteria]`, in the order of a report.
    pub criteria: Vec<CriterionRow>,
    /// How many hold, in words.
    #[serde(skip)]
    headline: String,
}

/// A criterion, judged. Numbers in SI, or in the units of a reduced case.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CriterionRow {
    /// The key in the case file.
    pub name: &'static str,
    /// What was asked, as written.
    pub asked: String,
    /// What was found; 1 and 0 for true and false, `None` where nothing could be measured.
    pub found: Option<f64>,
    /// Unit of `found`, `error` and `margin`: `1`, `m`, `m/s`, `dB`.
    pub unit: &'static str,
    /// How far `found` may be off.
    pub error: Option<f64>,
    /// Room that is left; negative where the criterion does not hold.
    pub margin: Option<f64>,
    /// Whether it holds.
    pub holds: Option<bool>,
    /// Whether the error could turn that.
    pub near_limit: bool,
    /// Which layer decided.
    pub decided_by: Method,
    /// Where in the band it is worst, with unit; empty where that says nothing.
    pub at: String,
    /// Share of the absorber's resting places from which a start from rest never wakes it, where that motion
    /// decides.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inactive_share: Option<f64>,
    /// Whether the motion that decides has settled.
    pub settled: bool,
    /// Criterion, verdict, asked, found, margin and layer as a person reads them.
    #[serde(skip)]
    cells: Vec<String>,
}

/// A case that could not be checked.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FailedCase {
    /// Its name: the stem of its file.
    pub case: String,
    /// Why, in a sentence.
    pub error: String,
    /// Where its file is wrong, in the order of its lines; empty where that is not the reason.
    pub problems: Vec<Place>,
}

#[derive(Serialize)]
struct Context<'a> {
    criteria: &'a CriteriaFacts,
}

impl JudgedCase {
    /// A case and what was judged.
    ///
    /// # Errors
    /// [`RenderError::Template`] if the template does not fit.
    pub fn new(name: &str, case: &Case, judged: &[Judged]) -> Result<Self, RenderError> {
        let units = Document::units(case);
        let facts = CriteriaFacts::of(case, judged);
        let text = facts
            .as_ref()
            .map(|criteria| template::render("criteria", &units, &Context { criteria }));
        let text = text.transpose()?.unwrap_or_else(|| NO_CRITERIA.to_owned());
        let mut lines = text.lines().filter(|line| !line.is_empty());
        let headline = lines.next().unwrap_or_default().to_owned();
        let rows = facts.iter().flat_map(|facts| &facts.all).zip(lines).zip(judged);
        let row = |((facts, line), judged): ((&CriterionFacts, &str), &Judged)| CriterionRow {
            name: facts.name,
            asked: facts.asked.clone(),
            found: judged.found,
            unit: facts.limit.map_or("1", |limit| limit.kind.dimension.symbol(units.physical)),
            error: judged.found.map(|_| facts.error),
            margin: judged.margin,
            holds: facts.holds,
            near_limit: facts.outcome == Outcome::TooCloseToCall,
            decided_by: facts.decided_by,
            at: facts.at.map_or_else(String::new, |at| units.text(at.kind, at.value)),
            inactive_share: judged.inactive,
            settled: facts.settled,
            cells: line.split('\t').map(str::to_owned).collect(),
        };
        Ok(Self {
            case: name.to_owned(),
            title: case.title.clone(),
            warnings: case.warnings().iter().map(Place::from).collect(),
            holds: judged.iter().all(|one| one.holds == Some(true)),
            count_inactive: case.count_inactive,
            criteria: rows.map(row).collect(),
            headline,
        })
    }
}

const NO_CRITERIA: &str = "no criteria: add a table [criteria] to the case";
const FAILED: &str = "could not be checked";
const HEADS: [&str; 6] = ["criterion", "verdict", "asked", "found", "margin", "decided by"];

impl FailedCase {
    /// Where and why.
    fn reasons(&self) -> Vec<String> {
        if self.problems.is_empty() {
            return vec![self.error.clone()];
        }
        let line = |place: &Place| format!("line {}: {}", place.line, place.message);
        self.problems.iter().map(line).collect()
    }
}

impl CriterionRow {
    /// "asked, found, decided by" for a build server.
    fn message(&self) -> String {
        let [_, _, asked, found, _, layer] = HEADS.map(|head| self.cell(head));
        format!("asked {asked}, found {found}, decided by {layer}")
    }

    /// What it came to, without its mark.
    fn verdict(&self) -> &str {
        self.cell("verdict").trim_start_matches(['✓', '✗', ' '])
    }

    fn cell(&self, head: &str) -> &str {
        let index = HEADS.iter().position(|known| *known == head).unwrap_or(0);
        self.cells.get(index).map_or("", String::as_str)
    }
}

/// A table for a terminal.
pub fn text(checked: &Checked) -> String {
    let judged = match checked {
        Checked::Judged(judged) => judged,
        Checked::Failed(failed) => {
            let lines = failed.reasons().into_iter().map(|reason| format!("  {reason}\n"));
            return format!("{}: {FAILED}\n{}", failed.case, lines.collect::<String>());
        }
    };
    let mut text = format!("{}: {}\n", judged.case, judged.headline);
    if judged.criteria.is_empty() {
        return text;
    }
    let heads: Vec<String> = HEADS.iter().map(|head| (*head).to_owned()).collect();
    let lines: Vec<&Vec<String>> =
        std::iter::once(&heads).chain(judged.criteria.iter().map(|row| &row.cells)).collect();
    let length = |cell: &String| cell.chars().count();
    let width = |column: usize| {
        lines.iter().filter_map(|line| line.get(column)).map(length).max().unwrap_or(0)
    };
    for line in &lines {
        let cells = line.iter().enumerate();
        let padded =
            cells.map(|(k, cell)| format!("{cell}{}", " ".repeat(width(k) - length(cell))));
        let row = padded.collect::<Vec<_>>().join("  ");
        let _ = writeln!(text, "  {}", row.trim_end());
    }
    text
}

/// GitHub-flavoured Markdown.
pub fn markdown(checked: &Checked) -> String {
    let judged = match checked {
        Checked::Judged(judged) => judged,
        Checked::Failed(failed) => {
            let lines = failed.reasons().into_iter().map(|reason| format!("- {reason}\n"));
            return format!("**{}**: {FAILED}\n\n{}", failed.case, lines.collect::<String>());
        }
    };
    let mut text = format!("**{}**: {}\n", judged.case, judged.headline);
    if !judged.criteria.is_empty() {
        let _ = writeln!(text, "\n| {} |\n|{}", HEADS.join(" | "), "---|".repeat(HEADS.len()));
    }
    for row in &judged.criteria {
        let _ = writeln!(text, "| {} |", row.cells.join(" | "));
    }
    text
}

/// The workflow's own escapes for what ends a message.
fn escaped(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// The same for a property.
fn property(text: &str) -> String {
    escaped(text).replace(':', "%3A").replace(',', "%2C")
}

/// An annotation at a place of a case file.
fn annotation(level: &str, file: &str, title: &str, place: &Place) -> String {
    let Place { line, column, message } = place;
    let message = escaped(message);
    format!("::{level} file={file},line={line},col={column},title={title}::{message}\n")
}

/// Annotations of a GitHub workflow: an error for each criterion that does not hold and for each place at
/// which the case is wrong, a warning for each criterion that is too close to its limit.
pub fn annotations(path: &str, checked: &Checked) -> String {
    let file = property(path);
    let judged = match checked {
        Checked::Judged(judged) => judged,
        Checked::Failed(failed) => {
            let title = property(&format!("{}: {FAILED}", failed.case));
            if failed.problems.is_empty() {
                return format!("::error file={file},title={title}::{}\n", escaped(&failed.error));
            }
            let problems = failed.problems.iter();
            return problems.map(|place| annotation("error", &file, &title, place)).collect();
        }
    };
    let title = property(&judged.case);
    let warnings = judged.warnings.iter();
    let mut text: String =
        warnings.map(|place| annotation("warning", &file, &title, place)).collect();
    for row in &judged.criteria {
        let level = match (row.holds, row.near_limit) {
            (Some(true), false) => continue,
            (Some(true), true) => "warning",
            _ => "error",
        };
        let title = property(&format!("{}: {}", judged.case, row.name));
        let message = format!("{} {}: {}", row.cell("criterion"), row.verdict(), row.message());
        let _ = writeln!(text, "::{level} file={file},title={title}::{}", escaped(&message));
    }
    text
}

/// A JUnit report: a suite for each case, a test for each criterion; one that is an error for a case that
/// could not be checked.
pub fn junit(cases: &[Checked]) -> String {
    let fails = |row: &&CriterionRow| row.holds != Some(true);
    // Tests, failures and errors.
    let counts = |one: &Checked| match one {
        Checked::Judged(judged) => {
            [judged.criteria.len(), judged.criteria.iter().filter(fails).count(), 0]
        }
        Checked::Failed(_) => [1, 0, 1],
    };
    let attributes = |[tests, failures, errors]: [usize; 3]| {
        format!("tests=\"{tests}\" failures=\"{failures}\" errors=\"{errors}\"")
    };
    let sum = |[a, b, c]: [usize; 3], [d, e, f]: [usize; 3]| [a + d, b + e, c + f];
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    let all = cases.iter().map(counts).fold([0; 3], sum);
    let _ = writeln!(text, "<testsuites name=\"vinesink check\" {}>", attributes(all));
    for one in cases {
        let (name, tests) = match one {
            Checked::Judged(judged) => {
                let name = escape(&judged.case);
                let tests = judged.criteria.iter().map(|row| test(&name, row)).collect();
                (name, tests)
            }
            Checked::Failed(failed) => {
                let name = escape(&failed.case);
                let (error, reasons) = (escape(&failed.error), failed.reasons().join("\n"));
                let content = format!("<error message=\"{error}\">{}</error>", escape(&reasons));
                let test = test_case(&name, &name, &content);
                (name, test)
            }
        };
        let attributes = attributes(counts(one));
        let _ = write!(text, "  <testsuite name=\"{name}\" {attributes}>\n{tests}  </testsuite>\n");
    }
    text.push_str("</testsuites>\n");
    text
}

/// One criterion as a test.
fn test(suite: &str, row: &CriterionRow) -> String {
    let message = escape(&row.message());
    let content = match row.holds {
        Some(true) => format!("<system-out>{message}</system-out>"),
        _ => format!("<failure message=\"{}\">{message}</failure>", escape(row.verdict())),
    };
    test_case(suite, &escape(row.name), &content)
}

fn test_case(suite: &str, name: &str, content: &str) -> String {
    format!("    <testcase classname=\"{suite}\" name=\"{name}\">{content}</testcase>\n")
}
