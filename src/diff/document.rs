//! A report as it was read, with its case file as that is now.

use std::collections::BTreeMap;

use serde_json::Value;

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
    pub case: Option<CaseFile>,
    /// What writes the report again.
    pub remedy: Remedy,
}

/// A case file as it is now.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CaseFile {
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

impl Document {
    /// Reads the text of a `report.json`; `place` says where it came from.
    ///
    /// # Errors
    /// [`ReadError`] where it is not JSON, or not a report of this format.
    pub fn parse(
        place: &str,
        text: &str,
        figures: BTreeMap<String, Vec<u8>>,
    ) -> Result<Self, ReadError> {
        let report = stored::read(place, text)?;
        Ok(Self { place: place.to_owned(), report, figures, case: None, remedy: Remedy::default() })
    }

    /// The case's name: the stem of its file.
    pub fn name(&self) -> &str {
        self.text("name")
    }

    /// A text of the document, empty where there is none.
    pub(super) fn text(&self, field: &str) -> &str {
        self.report[field].as_str().unwrap_or("")
    }

    /// The answer in a line.
    pub(super) fn headline(&self) -> &str {
        self.report["verdict"]["headline"].as_str().unwrap_or("")
    }

    /// Something that the report says of its origin.
    pub(super) fn provenance(&self, field: &str) -> Option<&str> {
        self.report["provenance"][field].as_str()
    }

    /// The elements of a list of the document, none where there is none.
    pub(super) fn list(&self, field: &str) -> &[Value] {
        self.report[field].as_array().map_or(&[], Vec::as_slice)
    }

    /// What the case says, name and value as written, in its order; and how thoroughly it was simulated.
    pub(super) fn inputs(&self) -> Vec<(String, String)> {
        let mut found: Vec<(String, String)> = Vec::new();
        let mut seen: BTreeMap<String, usize> = BTreeMap::new();
        let mut add = |name: &str, value: String| {
            let count = seen.entry(name.to_owned()).or_default();
            *count += 1;
            let name = if *count == 1 { name.to_owned() } else { format!("{name} {count}") };
            found.push((name, value));
        };
        for field in ["title", "source"] {
            add(field, self.text(field).to_owned());
        }
        for row in self.report["tables"]["inputs"]["rows"].as_array().into_iter().flatten() {
            let cell = |index: usize| row[index].as_str().unwrap_or("");
            if cell(3) != DERIVED {
                add(cell(0), cell(2).to_owned());
            }
        }
        let effort = &self.report["provenance"]["effort"];
        let demand = &self.report["layers"]["data"]["demand"];
        for (of, values) in [("simulation", effort), ("accuracy", demand)] {
            for (name, value) in values.as_object().into_iter().flatten() {
                add(&format!("{of}: {}", name.replace('_', " ")), value.to_string());
            }
        }
        found
    }
}

/// Rows of the table of inputs that follow from others, and say so.
const DERIVED: &str = "derived";
