//! Reports that are not what their case and this program would give now.

use serde::Serialize;

use super::Document;
use crate::report::document::FORMAT;

/// A report that is out of date, and what to do.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct StaleReport {
    /// `old` or `new`.
    pub side: &'static str,
    /// Its `report.json`.
    pub file: String,
    /// What differs.
    pub reason: Reason,
    /// The case file that has another text.
    pub case: Option<String>,
    /// What the report was made from: SHA-256 of the case's text, version of the program, or format.
    pub reported: String,
    /// The same as it is now.
    pub current: String,
    /// What writes it again.
    pub command: String,
    /// The revision that has to be checked out before.
    pub revision: Option<String>,
}

/// Why a report is out of date, in the order in which reports are named.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Reason {
    /// The text of its case is another one now.
    CaseText,
    /// Another version of the program wrote it.
    ProgramVersion,
    /// It has an old format, and is not compared.
    Format,
}

/// What is out of date about a report.
pub(super) fn reasons(side: &'static str, document: &Document) -> Vec<StaleReport> {
    let provenance = |field: &str| document.report["provenance"][field].as_str();
    let case = document.case.as_ref();
    let sides = [
        (Reason::CaseText, provenance("case_sha256"), case.map(|case| case.sha256.as_str())),
        (Reason::ProgramVersion, provenance("version"), Some(env!("CARGO_PKG_VERSION"))),
        (Reason::Format, document.report["format"].as_str(), Some(FORMAT)),
    ];
    let differing = sides.into_iter().filter_map(|(reason, reported, current)| {
        let (reported, current) = reported.zip(current).filter(|(old, new)| old != new)?;
        Some(StaleReport {
            side,
            file: document.place.clone(),
            reason,
            case: case.filter(|_| reason == Reason::CaseText).map(|case| case.place.clone()),
            reported: reported.to_owned(),
            current: current.to_owned(),
            command: document.remedy.command.clone(),
            revision: document.remedy.revision.clone(),
        })
    });
    differing.collect()
}
