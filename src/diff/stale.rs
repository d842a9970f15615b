//! Reports that are not what their case and this program would give now.

use serde::Serialize;

use super::Document;

/// A report that is out of date, and what to do.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct StaleReport {
    /// `old` or `new`.
    pub side: &'static str,
    /// Its `report.json`.
    pub file: String,
    /// What differs.
    #[serde(flatten)]
    pub reason: Reason,
    /// What writes it again.
    pub command: String,
    /// The revision that has to be checked out before.
    pub revision: Option<String>,
}

/// Why a report is out of date.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(tag = "reason", rename_all = "kebab-case")]
pub enum Reason {
    /// The text of its case is another one now.
    CaseText {
        /// The case file.
        case: String,
        /// SHA-256 of the text that the report was made from.
        reported: String,
        /// SHA-256 of the text as it is.
        current: String,
    },
    /// Another version of the program wrote it.
    ProgramVersion {
        /// The version that wrote it.
        reported: String,
        /// This version.
        current: String,
    },
}

/// What is out of date about a report.
pub(super) fn reasons(side: &'static str, document: &Document) -> Vec<StaleReport> {
    let case = document.case.as_ref().and_then(|case| {
        let reported = document.provenance("case_sha256")?;
        (reported != case.sha256).then(|| Reason::CaseText {
            case: case.place.clone(),
            reported: reported.to_owned(),
            current: case.sha256.clone(),
        })
    });
    let current = env!("CARGO_PKG_VERSION");
    let version = document.provenance("version").filter(|reported| *reported != current);
    let version = version.map(|reported| Reason::ProgramVersion {
        reported: reported.to_owned(),
        current: current.to_owned(),
    });
    let stale = |reason| StaleReport {
        side,
        file: document.place.clone(),
        reason,
        command: document.remedy.command.clone(),
        revision: document.remedy.revision.clone(),
    };
    case.into_iter().chain(version).map(stale).collect()
}
