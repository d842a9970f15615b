//! A report as it was read.

use std::collections::BTreeMap;

use serde_json::Value;

/// The format of reports that can be compared.
const FORMAT: &str = "vinesink/report@1";

/// A `report.json` and the drawings beside it.
#[derive(Debug, Clone, PartialEq)]
pub struct Document {
    /// The parsed document.
    pub report: Value,
    /// The drawings, by file stem.
    pub figures: BTreeMap<String, Vec<u8>>,
}

/// Why a text is no report.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
pub enum DocumentError {
    /// It is not JSON.
    #[error("{place} is not JSON: {problem}")]
    #[diagnostic(help(
        "write it again with `vinesink report CASE`, or look for a conflict left by a merge"
    ))]
    Syntax {
        /// The file, and where it was read from.
        place: String,
        /// What is wrong, with line and column.
        problem: String,
    },
    /// It is JSON of another kind or version.
    #[error("{place} is not a report that can be compared: its format is {found}, not `{FORMAT}`")]
    #[diagnostic(help(
        "compare report.json of `vinesink report`; write older ones again with this version of the program"
    ))]
    Format {
        /// The file, and where it was read from.
        place: String,
        /// What stands there.
        found: String,
    },
}

impl Document {
    /// Reads the text of a `report.json`; `place` says where it came from.
    ///
    /// # Errors
    /// [`DocumentError`] where it is not JSON, or not a report of this format.
    pub fn parse(
        place: &str,
        text: &str,
        figures: BTreeMap<String, Vec<u8>>,
    ) -> Result<Self, DocumentError> {
        let report: Value = serde_json::from_str(text).map_err(|error| DocumentError::Syntax {
            place: place.to_owned(),
            problem: error.to_string(),
        })?;
        let format = &report["format"];
        if format != FORMAT {
            let found =
                format.as_str().map_or("not there".to_owned(), |found| format!("`{found}`"));
            return Err(DocumentError::Format { place: place.to_owned(), found });
        }
        Ok(Self { report, figures })
    }

    /// The case's name.
    pub(super) fn name(&self) -> &str {
        self.text("name")
    }

    /// A text of the document, empty where there is none.
    pub(super) fn text(&self, field: &str) -> &str {
        self.report[field].as_str().unwrap_or("")
    }

    /// The elements of a list of the document, none where there is none.
    pub(super) fn list(&self, field: &str) -> &[Value] {
        self.report[field].as_array().map_or(&[], Vec::as_slice)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_documents_are_refused() {
        let parse = |text: &str| Document::parse("x/report.json", text, BTreeMap::new());
        assert!(parse(r#"{"format": "vinesink/report@1"}"#).is_ok());
        let newer = parse(r#"{"format": "vinesink/report@2"}"#).expect_err("another version");
        assert!(newer.to_string().contains("`vinesink/report@2`"), "{newer}");
        for text in ["[]", "{}", "3", "\"x\"", "null"] {
            let error = parse(text).expect_err("no report");
            assert!(matches!(error, DocumentError::Format { .. }), "{text}: {error}");
        }
        let broken = parse("{\"format\":\n<<<<<<< HEAD").expect_err("a conflict");
        assert!(broken.to_string().contains("line 2 column 1"), "{broken}");
    }
}
