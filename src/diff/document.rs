//! A report as it was read.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::report::stored::{self, ReadError};

/// A `report.json` and the drawings beside it.
#[derive(Debug, Clone, PartialEq)]
pub struct Document {
    /// The parsed document.
    pub report: Value,
    /// The drawings, by file stem.
    pub figures: BTreeMap<String, Vec<u8>>,
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
        Ok(Self { report: stored::read(place, text)?, figures })
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
