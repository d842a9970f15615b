//! What an index needs of a `report.json`, read with its version checked.

use serde::Deserialize;

use super::super::FORMAT;

/// What an index shows of a report.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Summary {
    /// What the case is.
    pub title: String,
    /// The answer.
    pub verdict: Answer,
    /// What was refuted, has not settled, or lies outside the theory's range.
    pub notes: Vec<serde::de::IgnoredAny>,
    /// Inputs and key results.
    pub key_rows: Vec<KeyNumber>,
    /// The figures; the first stands for the report.
    pub figures: Vec<Drawing>,
    /// What the case asks of its design, where it asks for something.
    #[serde(default)]
    pub criteria: Vec<Criterion>,
}

/// The verdict of a report.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Answer {
    /// Good, mixed or bad.
    pub tone: Tone,
    /// One or two short sentences.
    pub headline: String,
}

/// Whether the news is good; the order is that of a sorted column.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Tone {
    /// The absorber helps.
    Good,
    /// Something between.
    Mixed,
    /// It does not help.
    Bad,
}

/// A row of the report's first table.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct KeyNumber {
    /// What.
    pub quantity: String,
    /// How much, with its unit.
    pub value: String,
}

/// A figure of the report.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Drawing {
    /// File stem under `figures/`.
    pub name: String,
    /// Its headline.
    pub title: String,
    /// What to see, for those who cannot see it.
    pub alt: String,
}

/// Something that the case asks of its design.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
pub struct Criterion {
    /// Whether it holds; nothing where that could not be told.
    pub holds: Option<bool>,
}

/// Why a file is not a report that can be listed.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum ReadError {
    /// Not JSON, or something else than a report needs stands in a place.
    #[error("{path}: {cause}")]
    #[diagnostic(help(
        "write the report again with `vinesink report`, or take its folder out of the way"
    ))]
    Malformed {
        /// The file.
        path: String,
        /// What is wrong, with line and column.
        cause: serde_json::Error,
    },
    /// A document that is not a report.
    #[error("{path} does not say that it is a report: it has no \"format\": \"{FORMAT}\"")]
    #[diagnostic(help(
        "write the report again with `vinesink report`, or take its folder out of the way"
    ))]
    NotAReport {
        /// The file.
        path: String,
    },
    /// A report in another format, or of another version.
    #[error("{path} has the format \"{found}\", and this version reads \"{FORMAT}\"")]
    #[diagnostic(help("write the report again with this version's `vinesink report`"))]
    OtherFormat {
        /// The file.
        path: String,
        /// What it says it is.
        found: String,
    },
}

impl Summary {
    /// Reads the text of a `report.json`; `path` is where it lies, for messages.
    ///
    /// # Errors
    /// [`ReadError`] says what is wrong with it, where, and what to do.
    pub fn read(text: &str, path: &str) -> Result<Self, ReadError> {
        #[derive(Deserialize)]
        struct Header {
            format: Option<String>,
        }
        let malformed = |cause| ReadError::Malformed { path: path.to_owned(), cause };
        let header: Header = serde_json::from_str(text).map_err(malformed)?;
        match header.format {
            None => Err(ReadError::NotAReport { path: path.to_owned() }),
            Some(found) if found != FORMAT => {
                Err(ReadError::OtherFormat { path: path.to_owned(), found })
            }
            Some(_) => serde_json::from_str(text).map_err(malformed),
        }
    }

    /// The printed value of a quantity.
    pub(super) fn value(&self, quantity: &str) -> Option<&str> {
        let row = self.key_rows.iter().find(|row| row.quantity == quantity)?;
        Some(&row.value)
    }

    /// How many criteria hold, in words; nothing where the case has none.
    pub(super) fn criteria_words(&self) -> Option<String> {
        let all = self.criteria.len();
        let count = |answer| self.criteria.iter().filter(|one| one.holds == answer).count();
        let hold = count(Some(true));
        let criteria = if all == 1 { "criterion" } else { "criteria" };
        let verb = if hold == 1 { "holds" } else { "hold" };
        let open = match count(None) {
            0 => String::new(),
            open => format!(", {open} cannot be told"),
        };
        (all > 0).then(|| format!("{hold} of {all} {criteria} {verb}{open}"))
    }
}

impl Tone {
    /// The word on the page.
    pub fn word(self) -> &'static str {
        match self {
            Self::Good => "good",
            Self::Mixed => "mixed",
            Self::Bad => "bad",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SMALLEST: &str = r#"{"format": "vinesink/report@1", "title": "T", "notes": [],
        "verdict": {"tone": "good", "headline": "H"}, "key_rows": [], "figures": []"#;

    fn message(text: &str) -> String {
        Summary::read(text, "a/report.json").expect_err("refused").to_string()
    }

    #[test]
    fn a_file_that_is_no_report_of_this_version_is_named() {
        let broken = message("{\n  \"format\": \"vinesink/report@1\",\n  \"title\"\n}");
        assert!(broken.starts_with("a/report.json: ") && broken.contains("line 4"), "{broken}");
        let missing = message("{\"title\": \"T\"}");
        assert!(missing.contains("does not say that it is a report"), "{missing}");
        let other = message("{\"format\": \"vinesink/report@2\"}");
        assert!(other.contains("report@2") && other.contains("report@1"), "{other}");
        let half = message("{\"format\": \"vinesink/report@1\", \"title\": \"T\"}");
        assert!(half.contains("missing field"), "{half}");
        for text in ["", "[]", "null", "\"x\"", "{\"format\": 1}"] {
            assert!(message(text).starts_with("a/report.json"), "{text}");
        }
    }

    #[test]
    fn criteria_are_counted() {
        let words = |criteria: &str| {
            let text = format!("{SMALLEST}{criteria}}}");
            Summary::read(&text, "").expect("a report").criteria_words()
        };
        assert_eq!(words(""), None);
        assert_eq!(words(", \"criteria\": []"), None);
        let one = r#", "criteria": [{"name": "peak", "asked": 1, "holds": true}]"#;
        assert_eq!(words(one).as_deref(), Some("1 of 1 criterion holds"));
        let three = r#", "criteria": [{"holds": true}, {"holds": false}, {"holds": null}]"#;
        assert_eq!(words(three).as_deref(), Some("1 of 3 criteria holds, 1 cannot be told"));
        let none = r#", "criteria": [{"holds": false}, {"holds": false}]"#;
        assert_eq!(words(none).as_deref(), Some("0 of 2 criteria hold"));
    }
}
