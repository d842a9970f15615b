//! A `report.json` that is read back: its format is checked here, for whoever reads one.
//!
//! For the program itself: this module may change at any time.

use serde_json::{Value, json};

use super::document::{Content, FORMAT};
use crate::quantity::catalogue;

/// Why a file is not a report that can be read.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("{message}")]
#[diagnostic(help("{help}"))]
pub struct ReadError {
    /// The file and where it was read from, and what is wrong, for JSON with line and column.
    message: String,
    /// What to do.
    help: &'static str,
    /// The format of another version, or of another document of this program.
    pub(crate) other_format: Option<String>,
}

const CONFLICT: &str =
    "write the report again with `vinesink report CASE`, or look for a conflict left by a merge";
const NO_REPORT: &str = "name what `vinesink report CASE` writes; write the report again, or take its folder out of the way";
const OUT_OF_DATE: &str = "write the report again with this version's `vinesink report CASE`";
const HALF: &str =
    "write the report again with `vinesink report CASE`, or take its folder out of the way";

fn error(message: String, help: &'static str) -> ReadError {
    ReadError { message, help, other_format: None }
}

/// Something else than a report needs stands in a place.
pub(super) fn incomplete(place: &str, cause: &serde_json::Error) -> ReadError {
    error(format!("{place} is not a whole report: {cause}"), HALF)
}

/// Whether every quantity in a part of a report is one that this version knows.
///
/// # Errors
/// [`ReadError`] names the first that is not.
pub(crate) fn quantities_are_known(place: &str, part: &Value) -> Result<(), ReadError> {
    // What is listed of motions has a value and an error, and is named by its field.
    let is_quantity = ["value", "error", "method"].iter().all(|key| part.get(key).is_some());
    let id = part["id"].as_str().unwrap_or_default();
    if is_quantity && catalogue::kind(id).is_none() {
        let message = format!("{place} is damaged: it has a quantity `{id}`, which is not known");
        return Err(error(message, HALF));
    }
    match part {
        Value::Object(fields) => {
            fields.values().try_for_each(|one| quantities_are_known(place, one))
        }
        Value::Array(items) => items.iter().try_for_each(|one| quantities_are_known(place, one)),
        _ => Ok(()),
    }
}

/// Formats of before. Those of one mode have the same fields.
const EARLIER: [&str; 2] = ["vinesink/report@2", "vinesink/answer@1"];

/// A report of an earlier format of several modes, whose loads were numbered from 0.
fn upgraded(mut report: Value) -> Value {
    fn later(of: &mut Value) {
        if let Some(load) = of.get("load").and_then(Value::as_u64) {
            of["load"] = json!(load + 1);
        }
    }
    if report["loads"].is_array() {
        for (k, one) in report["loads"].as_array_mut().into_iter().flatten().enumerate() {
            one["excitation"] = std::mem::replace(&mut one["load"], json!(k + 1));
            one["at_worst"] = one["motions"].take();
            later(&mut one["worst"]);
        }
        later(&mut report["worst"]);
        let rows = report["criteria"]["all"].as_array_mut().into_iter().flatten();
        rows.for_each(later);
        report["compared"].as_array_mut().into_iter().flatten().for_each(later);
    }
    report
}

/// The document in the text of a `report.json`; `place` says where it came from.
///
/// # Errors
/// [`ReadError`] where it is not JSON, or not a report of this format.
pub fn read(place: &str, text: &str) -> Result<Value, ReadError> {
    let report: Value = serde_json::from_str(text)
        .map_err(|cause| error(format!("{place} is not JSON: {cause}"), CONFLICT))?;
    let is_report = report["asked"].is_null() || report["asked"] == json!(Content::Report);
    match report["format"].as_str() {
        Some(earlier) if is_report && EARLIER.contains(&earlier) => Ok(upgraded(report)),
        Some(FORMAT) if report["asked"] == json!(Content::Report) => Ok(report),
        Some(found) if found == FORMAT || EARLIER.contains(&found) => {
            let asked = report["asked"].as_str().unwrap_or("nothing");
            Err(error(format!("{place} is what was asked with `{asked}`, not a report"), NO_REPORT))
        }
        Some(found) => {
            let message =
                format!("{place} has the format `{found}`, and this version reads `{FORMAT}`");
            Err(ReadError { other_format: Some(found.to_owned()), ..error(message, OUT_OF_DATE) })
        }
        None => {
            let lacks = format!("it has no \"format\": \"{FORMAT}\"");
            Err(error(format!("{place} does not say that it is a report: {lacks}"), NO_REPORT))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a reader of this version asks for is there in a report of several modes of the version before.
    #[test]
    fn loads_of_before_are_numbered_from_one() {
        let before = r#"{"format": "vinesink/answer@1", "asked": "report", "worst": {"load": 1, "at": 2},
            "criteria": {"all": [{"load": 0}]}, "compared": [{"load": 1}],
            "loads": [{"load": {"from": 5}, "motions": [7], "worst": {"load": 0}}]}"#;
        let found = read("x/report.json", before).expect("a report");
        let load = &found["loads"][0];
        assert_eq!([&load["load"], &load["excitation"]["from"], &load["at_worst"][0]], [1, 5, 7]);
        let worst = [&found["worst"]["load"], &load["worst"]["load"]];
        assert_eq!(worst, [2, 1]);
        assert_eq!([&found["criteria"]["all"][0]["load"], &found["compared"][0]["load"]], [1, 2]);
        let again = read("x/report.json", &before.replace("answer@1", "answer@2"));
        assert_eq!(again.expect("a report")["worst"]["load"], 1);
    }

    #[test]
    fn other_documents_are_refused() {
        let read = |text: &str| read("x/report.json", text);
        assert!(read(r#"{"format": "vinesink/answer@2", "asked": "report"}"#).is_ok());
        assert!(read(r#"{"format": "vinesink/answer@1", "asked": "report"}"#).is_ok());
        let other = read(r#"{"format": "vinesink/answer@2", "asked": "analysis"}"#);
        assert!(other.expect_err("no report").to_string().contains("asked with `analysis`"));
        assert!(read(r#"{"format": "vinesink/report@2"}"#).is_ok());
        let newer = read(r#"{"format": "vinesink/report@1"}"#).expect_err("another version");
        let newer = newer.to_string();
        assert!(newer.contains("`vinesink/answer@2`") && newer.contains("`vinesink/report@1`"));
        for text in ["[]", "{}", "3", "\"x\"", "null", "{\"format\": 1}", "{\"title\": \"T\"}"] {
            let error = read(text).expect_err("no report");
            let said = error.to_string();
            assert!(said.contains("does not say that it is a report"), "{text}: {said}");
        }
        assert!(read("").expect_err("nothing").to_string().contains("is not JSON"));
        let broken = read("{\"format\":\n<<<<<<< HEAD").expect_err("a conflict");
        let broken = broken.to_string();
        assert!(
            broken.starts_with("x/report.json is not JSON") && broken.contains("line 2 column 1")
        );
    }
}
