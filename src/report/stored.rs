//! A `report.json` that is read back: its format is checked here, for whoever reads one.

use serde_json::Value;

use super::document::FORMAT;

/// Why a file is not a report that can be read.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum ReadError {
    /// Not JSON.
    #[error("{place} is not JSON: {cause}")]
    #[diagnostic(help(
        "write the report again with `vinesink report CASE`, or look for a conflict left by a merge"
    ))]
    Syntax {
        /// The file, and where it was read from.
        place: String,
        /// What is wrong, with line and column.
        cause: serde_json::Error,
    },
    /// A document of another kind.
    #[error("{place} does not say that it is a report: it has no \"format\": \"{FORMAT}\"")]
    #[diagnostic(help(
        "name what `vinesink report CASE` writes; write the report again, or take its folder out of the way"
    ))]
    NotAReport {
        /// The file, and where it was read from.
        place: String,
    },
    /// A report of another version, or another document of this program.
    #[error("{place} has the format `{found}`, and this version reads `{FORMAT}`")]
    #[diagnostic(help("write the report again with this version's `vinesink report CASE`"))]
    OtherFormat {
        /// The file, and where it was read from.
        place: String,
        /// What it says it is.
        found: String,
    },
    /// Something else than a report needs stands in a place.
    #[error("{place} is not a whole report: {cause}")]
    #[diagnostic(help(
        "write the report again with `vinesink report CASE`, or take its folder out of the way"
    ))]
    Incomplete {
        /// The file, and where it was read from.
        place: String,
        /// What is wrong, with line and column.
        cause: serde_json::Error,
    },
}

/// The document in the text of a `report.json`; `place` says where it came from.
///
/// # Errors
/// [`ReadError`] where it is not JSON, or not a report of this format.
pub fn read(place: &str, text: &str) -> Result<Value, ReadError> {
    let place = || place.to_owned();
    let report: Value =
        serde_json::from_str(text).map_err(|cause| ReadError::Syntax { place: place(), cause })?;
    match report["format"].as_str() {
        Some(FORMAT) => Ok(report),
        Some(found) => Err(ReadError::OtherFormat { place: place(), found: found.to_owned() }),
        None => Err(ReadError::NotAReport { place: place() }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_documents_are_refused() {
        let read = |text: &str| read("x/report.json", text);
        assert!(read(r#"{"format": "vinesink/report@2"}"#).is_ok());
        let newer = read(r#"{"format": "vinesink/report@1"}"#).expect_err("another version");
        let newer = newer.to_string();
        assert!(newer.contains("`vinesink/report@2`") && newer.contains("`vinesink/report@1`"));
        for text in ["[]", "{}", "3", "\"x\"", "null", "{\"format\": 1}", "{\"title\": \"T\"}"] {
            let error = read(text).expect_err("no report");
            assert!(matches!(error, ReadError::NotAReport { .. }), "{text}: {error}");
        }
        assert!(matches!(read(""), Err(ReadError::Syntax { .. })));
        let broken = read("{\"format\":\n<<<<<<< HEAD").expect_err("a conflict");
        let broken = broken.to_string();
        assert!(
            broken.starts_with("x/report.json is not JSON") && broken.contains("line 2 column 1")
        );
    }
}
