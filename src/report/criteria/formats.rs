//! The formats of `vinesink check`.

use std::fmt::Write as _;

use super::{CriteriaDocument, CriterionRow, subject};
use crate::report::figure::escape;

/// A table for a terminal.
pub fn text(document: &CriteriaDocument) -> String {
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
pub fn markdown(document: &CriteriaDocument) -> String {
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

/// Annotations of a GitHub workflow: an error for each criterion that does not hold, a warning for each
/// that is too close to its limit.
pub fn annotations(path: &str, document: &CriteriaDocument) -> String {
    let mut text = String::new();
    for row in &document.criteria {
        let level = match (row.holds, row.near_limit) {
            (Some(true), false) => continue,
            (Some(true), true) => "warning",
            _ => "error",
        };
        // The workflow's own escapes for what ends a message or a property.
        let escaped =
            |text: &str| text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A");
        let property = |text: &str| escaped(text).replace(':', "%3A").replace(',', "%2C");
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

/// A JUnit report: a suite for each case, a test for each criterion.
pub fn junit(documents: &[CriteriaDocument]) -> String {
    let count = |of: &dyn Fn(&CriterionRow) -> bool, documents: &[CriteriaDocument]| {
        documents.iter().flat_map(|document| &document.criteria).filter(|row| of(row)).count()
    };
    let fails = |row: &CriterionRow| row.holds != Some(true);
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    let _ = writeln!(
        text,
        "<testsuites name=\"vinesink check\" tests=\"{}\" failures=\"{}\">",
        count(&|_| true, documents),
        count(&fails, documents)
    );
    for document in documents {
        let one = std::slice::from_ref(document);
        let _ = writeln!(
            text,
            "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\">",
            escape(&document.case),
            document.criteria.len(),
            count(&fails, one)
        );
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
            if fails(row) {
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
        text.push_str("  </testsuite>\n");
    }
    text.push_str("</testsuites>\n");
    text
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
