//! The formats of `vinesink check`.

use std::fmt::Write as _;

use miette::Severity;
use serde::Serialize;

use super::{CriteriaDocument, CriterionRow, subject};
use crate::case::Problem;
use crate::report::figure::escape;

/// What became of one case of several.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Checked {
    /// Its criteria were judged.
    Judged(CriteriaDocument),
    /// It could not be read, or not be judged.
    Failed(FailedCase),
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

/// A place at which a case file is wrong, or probably is.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Place {
    /// The line, from 1.
    pub line: usize,
    /// The column in characters, from 1.
    pub column: usize,
    /// What is wrong, and what was expected or probably meant.
    pub message: String,
}

impl From<&Problem> for Place {
    fn from(problem: &Problem) -> Self {
        let Problem { line, column, message, expected, help, severity, .. } = problem;
        let more = match severity {
            Severity::Error => Some(expected),
            Severity::Warning | Severity::Advice => help.as_ref(),
        };
        let more = more.map_or_else(String::new, |more| format!("; {more}"));
        Self { line: *line, column: *column, message: format!("{message}{more}") }
    }
}

impl Place {
    fn annotation(&self, level: &str, file: &str, title: &str) -> String {
        let Self { line, column, message } = self;
        let message = escaped(message);
        format!("::{level} file={file},line={line},col={column},title={title}::{message}\n")
    }
}

impl FailedCase {
    /// Every reason in a line of its own, with its place in the file where it has one.
    fn reasons(&self) -> Vec<String> {
        if self.problems.is_empty() {
            return vec![self.error.clone()];
        }
        let reasons = self.problems.iter();
        reasons.map(|place| format!("line {}: {}", place.line, place.message)).collect()
    }
}

const FAILED: &str = "could not be checked";

/// A table for a terminal.
pub fn text(checked: &Checked) -> String {
    let document = match checked {
        Checked::Judged(document) => document,
        Checked::Failed(failed) => {
            let lines = failed.reasons().into_iter().map(|reason| format!("  {reason}\n"));
            return format!("{}: {FAILED}\n{}", failed.case, lines.collect::<String>());
        }
    };
    let header =
        ["criterion", "verdict", "asked", "found", "margin", "decided by"].map(str::to_owned);
    let mut lines = vec![header];
    lines.extend(document.criteria.iter().map(cells));
    let width =
        |column: usize| lines.iter().map(|line| line[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..6).map(width).collect();
    let mut text = format!("{}: {}\n", document.case, document.headline());
    if document.criteria.is_empty() {
        return text;
    }
    for line in &lines {
        let mut row = String::from(" ");
        for (cell, width) in line.iter().zip(&widths) {
            let fill = width - cell.chars().count();
            let _ = write!(row, " {cell}{} ", " ".repeat(fill));
        }
        let _ = writeln!(text, "{}", row.trim_end());
    }
    text
}

/// GitHub-flavoured Markdown.
pub fn markdown(checked: &Checked) -> String {
    let document = match checked {
        Checked::Judged(document) => document,
        Checked::Failed(failed) => {
            let lines = failed.reasons().into_iter().map(|reason| format!("- {reason}\n"));
            return format!("**{}**: {FAILED}\n\n{}", failed.case, lines.collect::<String>());
        }
    };
    let mut text = format!("**{}**: {}\n", document.case, document.headline());
    if document.criteria.is_empty() {
        return text;
    }
    text.push_str(
        "\n| criterion | verdict | asked | found | margin | decided by |\n|---|---|---|---|---|---|\n",
    );
    for row in &document.criteria {
        let _ = writeln!(text, "| {} |", cells(row).join(" | "));
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

/// Annotations of a GitHub workflow: an error for each criterion that does not hold and for each place at
/// which the case is wrong, a warning for each criterion that is too close to its limit.
pub fn annotations(path: &str, checked: &Checked) -> String {
    let mut text = String::new();
    let document = match checked {
        Checked::Judged(document) => document,
        Checked::Failed(failed) => {
            let title = property(&format!("{}: {FAILED}", failed.case));
            let path = property(path);
            text.extend(
                failed.problems.iter().map(|place| place.annotation("error", &path, &title)),
            );
            if failed.problems.is_empty() {
                let _ =
                    writeln!(text, "::error file={path},title={title}::{}", escaped(&failed.error));
            }
            return text;
        }
    };
    let (file, title) = (property(path), property(&document.case));
    text.extend(document.warnings.iter().map(|place| place.annotation("warning", &file, &title)));
    for row in &document.criteria {
        let level = match (row.holds, row.near_limit) {
            (Some(true), false) => continue,
            (Some(true), true) => "warning",
            _ => "error",
        };
        let message = format!(
            "{} {}: asked {}, found {}, by {}",
            subject(row.name),
            row.verdict(),
            row.words[0],
            row.found_words(),
            row.decided_by.words()
        );
        let _ = writeln!(
            text,
            "::{level} file={},title={}::{}",
            property(path),
            property(&format!("{}: {}", document.case, row.name)),
            escaped(&message)
        );
    }
    text
}

/// A JUnit report: a suite for each case, a test for each criterion; one that is an error for a case that
/// could not be checked.
pub fn junit(cases: &[Checked]) -> String {
    let fails = |row: &&CriterionRow| row.holds != Some(true);
    // Tests, failures and errors.
    let counts = |one: &Checked| match one {
        Checked::Judged(document) => {
            let rows = &document.criteria;
            [rows.len(), rows.iter().filter(fails).count(), 0]
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
        let name = escape(match one {
            Checked::Judged(document) => &document.case,
            Checked::Failed(failed) => &failed.case,
        });
        let _ = writeln!(text, "  <testsuite name=\"{name}\" {}>", attributes(counts(one)));
        match one {
            Checked::Judged(document) => criteria(&mut text, document),
            Checked::Failed(failed) => {
                let (error, reasons) = (escape(&failed.error), failed.reasons().join("\n"));
                let _ = writeln!(
                    text,
                    "    <testcase classname=\"{name}\" name=\"{name}\"><error message=\"{error}\">{}</error></testcase>",
                    escape(&reasons)
                );
            }
        }
        text.push_str("  </testsuite>\n");
    }
    text.push_str("</testsuites>\n");
    text
}

/// The tests of one suite.
fn criteria(text: &mut String, document: &CriteriaDocument) {
    for row in &document.criteria {
        let _ = write!(
            text,
            "    <testcase classname=\"{}\" name=\"{}\"",
            escape(&document.case),
            escape(row.name)
        );
        let message = format!(
            "asked {}, found {}, decided by {}",
            row.words[0],
            row.found_words(),
            row.decided_by.words()
        );
        if row.holds != Some(true) {
            let _ = writeln!(
                text,
                "><failure message=\"{}\">{}</failure></testcase>",
                escape(row.verdict()),
                escape(&message)
            );
        } else {
            let _ = writeln!(text, "><system-out>{}</system-out></testcase>", escape(&message));
        }
    }
}

pub(super) fn cells(row: &CriterionRow) -> [String; 6] {
    [
        subject(row.name).to_owned(),
        format!("{} {}", if row.holds == Some(true) { '✓' } else { '✗' }, row.verdict()),
        row.words[0].clone(),
        row.found_words(),
        row.words[2].clone(),
        row.decided_by.words().to_owned(),
    ]
}
