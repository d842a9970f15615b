//! A report as it was read, with its case file as that is now.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use crate::report::document::FORMAT;
use crate::report::stored::{self, ReadError};

/// A `report.json`, the drawings beside it, and the case that it is about.
#[derive(Debug, Clone, PartialEq)]
pub struct Document {
    /// Where the document was read from.
    pub place: String,
    /// The parsed document.
    pub report: Value,
    /// The drawings, by file stem.
    pub figures: BTreeMap<String, Vec<u8>>,
    /// The case file, where there is one.
    pub case: Option<CurrentCase>,
    /// What writes the report again.
    pub remedy: Remedy,
}

/// A case file as it is now.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CurrentCase {
    /// Where it was read from.
    pub place: String,
    /// SHA-256 of its text.
    pub sha256: String,
}

/// What writes a report again.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Remedy {
    /// A command line.
    pub command: String,
    /// The revision that has to be checked out before; nothing for files of the working folder.
    pub revision: Option<String>,
}

/// The format of version 0.1's first reports, whose numbers have neither identifiers nor errors.
const OLD_FORMAT: &str = "vinesink/report@1";

/// Why a report is out of date, in the order in which reports are named.
const REASONS: [&str; 3] = ["case-text", "program-version", "format"];

/// The place of a stale report's reason among [`REASONS`].
pub(super) fn reason(stale: &Value) -> Option<usize> {
    REASONS.iter().position(|reason| stale["reason"] == *reason)
}

impl Document {
    /// Reads the text of a `report.json`; `place` says where it came from. One of the format before this one is kept to
    /// be named as out of date.
    ///
    /// # Errors
    /// [`ReadError`] where it is not JSON, or not a report of this format or the one before.
    pub fn parse(
        place: &str,
        text: &str,
        figures: BTreeMap<String, Vec<u8>>,
    ) -> Result<Self, ReadError> {
        let report = match stored::read(place, text) {
            Err(error) if error.other_format.as_deref() == Some(OLD_FORMAT) => {
                serde_json::from_str(text).unwrap_or_default()
            }
            other => other?,
        };
        stored::quantities_are_known(place, &report["criteria"])?;
        Ok(Self { place: place.to_owned(), report, figures, case: None, remedy: Remedy::default() })
    }

    /// The case's name: the stem of its file.
    pub fn name(&self) -> &str {
        self.text("name")
    }

    /// Whether it is of the format before this one, which is not compared.
    pub fn has_old_format(&self) -> bool {
        self.report["format"] == OLD_FORMAT
    }

    /// Its name and answer, null where it has none, with how many criteria it has and how many of them fail; the
    /// name of the report's own folder where it has none below another.
    pub(super) fn summary(&self, folder: &str) -> Value {
        let count = |key: &str| self.report["criteria"][key].as_u64().unwrap_or(0);
        let verdict = if self.has_old_format() { &Value::Null } else { &self.report["verdict"] };
        json!({
            "name": if folder.is_empty() { self.name() } else { folder },
            "title": self.text("title"),
            "verdict": verdict,
            "criteria": [count("count"), count("failing")],
        })
    }

    /// What is out of date about it: it was made from another text of its case, by another version of the program,
    /// or has an old format and is not compared. `reported` is what it was made from, `current` the same now.
    pub(super) fn stale(&self, side: &str) -> Vec<Value> {
        let provenance = |field: &str| self.report["provenance"][field].as_str();
        let case = self.case.as_ref();
        let sides = [
            (provenance("case_sha256"), case.map(|case| case.sha256.as_str())),
            (provenance("version"), Some(env!("CARGO_PKG_VERSION"))),
            (self.report["format"].as_str().filter(|_| self.has_old_format()), Some(FORMAT)),
        ];
        let differing = REASONS.iter().zip(sides).filter_map(|(reason, (reported, current))| {
            let (reported, current) = reported.zip(current).filter(|(old, new)| old != new)?;
            Some(json!({
                "side": side,
                "file": self.place,
                "reason": reason,
                // The case file that has another text.
                "case": case.filter(|_| *reason == "case-text").map(|case| &case.place),
                "reported": reported,
                "current": current,
                "command": self.remedy.command,
                "revision": self.remedy.revision,
            }))
        });
        differing.collect()
    }

    /// A text of the document, empty where there is none.
    pub(super) fn text(&self, field: &str) -> &str {
        self.report[field].as_str().unwrap_or("")
    }

    /// The elements of a list, none where there is none.
    pub(super) fn list(&self, pointer: &str) -> &[Value] {
        let list = self.report.pointer(pointer).and_then(Value::as_array);
        list.map_or(&[], Vec::as_slice)
    }

    /// What the case says, name and value as written, in its order; and how thoroughly it was simulated.
    pub(super) fn inputs(&self) -> Vec<(String, Value)> {
        let mut found: Vec<(String, Value)> =
            ["title", "source"].map(|field| (field.to_owned(), json!(self.text(field)))).into();
        for input in self.list("/inputs") {
            let word = |key: &str| input[key].as_str().unwrap_or("").replace('_', " ");
            found
                .push((format!("{} {}", word("table"), word("name")), input["as_written"].clone()));
        }
        let band = ["from", "to"].map(|end| (end, &self.report["band"][end]));
        for (end, place) in band.into_iter().filter(|(_, place)| place.is_object()) {
            found.push((format!("band {end}"), place.clone()));
        }
        for (of, at) in [("simulation", "/provenance/effort"), ("accuracy", "/answers/demand")] {
            let values = self.report.pointer(at).and_then(Value::as_object);
            for (name, value) in values.into_iter().flatten() {
                found.push((format!("{of}: {}", name.replace('_', " ")), json!(value.to_string())));
            }
        }
        found
    }
}
