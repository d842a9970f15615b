//! What an index needs of a `report.json`, read with its version checked.

use serde::Deserialize;

use super::super::stored::{self, ReadError};

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

impl Summary {
    /// Reads the text of a `report.json`; `place` is where it lies, for messages.
    ///
    /// # Errors
    /// [`ReadError`] says what is wrong with it, where, and what to do.
    pub fn read(place: &str, text: &str) -> Result<Self, ReadError> {
        stored::read(place, text)?;
        // Out of the text once more, which knows the line where something is missing.
        serde_json::from_str(text)
            .map_err(|cause| ReadError::Incomplete { place: place.to_owned(), cause })
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

    #[test]
    fn half_a_report_is_refused() {
        let half = "{\"format\": \"vinesink/report@1\",\n \"title\": \"T\"}";
        let half = Summary::read("a/report.json", half).expect_err("refused").to_string();
        assert!(half.starts_with("a/report.json") && half.contains("missing field"), "{half}");
        assert!(half.contains("line 2"), "{half}");
    }

    #[test]
    fn criteria_are_counted() {
        let words = |criteria: &str| {
            let text = format!("{SMALLEST}{criteria}}}");
            Summary::read("", &text).expect("a report").criteria_words()
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
