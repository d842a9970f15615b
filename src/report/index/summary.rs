//! What an index needs of a `report.json`, read with its version checked.

use serde::Deserialize;
use serde_json::Value;

use super::super::stored::{self, BandPeaks, ReadError};
use super::cell::Cell;

/// What an index shows of a report.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Summary {
    /// What the case is.
    pub title: String,
    /// The answer.
    #[serde(rename = "verdict")]
    pub answer: Answer,
    /// What was refuted, has not settled, or lies outside the theory's range.
    pub notes: Vec<serde::de::IgnoredAny>,
    /// Inputs and key results.
    pub key_rows: Vec<KeyNumber>,
    /// The figures; the first stands for the report.
    pub figures: Vec<Drawing>,
    /// What the case asks of its design, where it asks for something.
    #[serde(default)]
    pub criteria: Vec<Criterion>,
    /// The band, where the case has one.
    #[serde(skip)]
    pub band: Option<BandSummary>,
}

/// A band and what happens along it.
#[derive(Debug, Clone, PartialEq)]
pub struct BandSummary {
    /// Its ends as the case gives them.
    pub ends: [String; 2],
    /// The largest peaks along it.
    pub peaks: BandPeaks,
    /// Whether these are in metres, and not in the case's own unit.
    pub metres: bool,
}

/// The answer of a report.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Answer {
    /// Good, mixed or bad; another version may have further words.
    pub tone: String,
    /// One or two short sentences.
    pub headline: String,
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
    /// Whether the error of what was found could turn that.
    #[serde(default)]
    pub near_limit: bool,
}

/// What a row of the index says first: of the criteria where the case has any, else of the vibration. The
/// order is that of a sorted column.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// All criteria hold.
    Holds,
    /// The absorber reduces the vibration in steady 1:1 resonance.
    Works,
    /// No criterion clearly fails, and some could turn within their errors or could not be measured.
    TooClose,
    /// Something between.
    Mixed,
    /// The absorber changes nothing.
    Nothing,
    /// It makes it worse.
    Worse,
    /// So many criteria do not hold, of so many, and some of them clearly.
    Fails(usize, usize),
}

impl Verdict {
    /// The verdict of a report with these criteria, or where there are none with this tone and this change
    /// of the peak in decibels.
    fn of(criteria: &[Criterion], tone: &str, change: Option<f64>) -> Self {
        if criteria.is_empty() {
            return match tone {
                "good" | "works" => Self::Works,
                "bad" if change.is_some_and(|decibels| decibels > 0.0) => Self::Worse,
                "bad" => Self::Nothing,
                _ => Self::Mixed,
            };
        }
        let fails = |one: &&Criterion| one.holds == Some(false);
        let failing = criteria.iter().filter(fails).count();
        if criteria.iter().filter(fails).any(|one| !one.near_limit) {
            Self::Fails(failing, criteria.len())
        } else if criteria.iter().all(|one| one.holds == Some(true) && !one.near_limit) {
            Self::Holds
        } else {
            Self::TooClose
        }
    }

    /// The words on the page.
    pub fn words(self) -> String {
        match self {
            Self::Holds => "Holds".into(),
            Self::Works => "Works".into(),
            Self::TooClose => "Too close to call".into(),
            Self::Mixed => "Mixed".into(),
            Self::Nothing => "Does nothing".into(),
            Self::Worse => "Makes it worse".into(),
            Self::Fails(failing, all) => format!("Fails ({failing} of {all})"),
        }
    }

    /// What several of them do.
    pub fn count(self, count: usize) -> String {
        let (one, many) = match self {
            Self::Holds => ("holds", "hold"),
            Self::Works => ("works", "work"),
            Self::TooClose => ("too close to call", "too close to call"),
            Self::Mixed => ("mixed", "mixed"),
            Self::Nothing => ("does nothing", "do nothing"),
            Self::Worse => ("makes it worse", "make it worse"),
            Self::Fails(..) => ("fails", "fail"),
        };
        format!("{count} {}", if count == 1 { one } else { many })
    }

    /// Its place in a sorted column, and among the kinds of verdicts.
    pub fn order(self) -> u8 {
        match self {
            Self::Holds => 0,
            Self::Works => 1,
            Self::TooClose => 2,
            Self::Mixed => 3,
            Self::Nothing => 4,
            Self::Worse => 5,
            Self::Fails(..) => 6,
        }
    }

    /// The class of its colour.
    pub fn tone(self) -> &'static str {
        match self {
            Self::Holds | Self::Works => "good",
            Self::TooClose | Self::Mixed => "mixed",
            Self::Nothing | Self::Worse | Self::Fails(..) => "bad",
        }
    }
}

impl Summary {
    /// Reads the text of a `report.json`; `place` is where it lies, for messages.
    ///
    /// # Errors
    /// [`ReadError`] says what is wrong with it, where, and what to do.
    pub fn read(place: &str, text: &str) -> Result<Self, ReadError> {
        let report = stored::read(place, text)?;
        // Out of the text once more, which knows the line where something is missing.
        let summary: Self = serde_json::from_str(text)
            .map_err(|cause| ReadError::Incomplete { place: place.to_owned(), cause })?;
        Ok(Self { band: BandSummary::of(&report), ..summary })
    }

    /// What there is to say first, with the change of the peak as it is printed.
    pub(super) fn verdict(&self, change: &Cell) -> Verdict {
        Verdict::of(&self.criteria, &self.answer.tone, change.order)
    }

    /// The printed value of a quantity.
    pub(super) fn value(&self, quantity: &str) -> Option<&str> {
        let row = self.key_rows.iter().find(|row| row.quantity == quantity)?;
        Some(&row.value)
    }
}

impl BandSummary {
    fn of(report: &Value) -> Option<Self> {
        let rows = report["tables"]["inputs"]["rows"].as_array();
        let rows = || rows.into_iter().flatten();
        let input = |name: &str| {
            let row = rows().find(|row| row[0] == name)?;
            row[2].as_str().map(str::to_owned)
        };
        Some(Self {
            ends: [input("Band from")?, input("Band to")?],
            peaks: BandPeaks::of(report)?,
            metres: rows().all(|row| row[3] != "reduced"),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_report_is_refused() {
        let half = "{\"format\": \"vinesink/report@1\",\n \"title\": \"T\"}";
        let half = Summary::read("a/report.json", half).expect_err("refused").to_string();
        assert!(half.starts_with("a/report.json") && half.contains("missing field"), "{half}");
        assert!(half.contains("line 2"), "{half}");
    }

    #[test]
    fn criteria_decide_where_there_are_any() {
        let words = |criteria: &[(Option<bool>, bool)], tone: &str| {
            let criteria = criteria.iter();
            let criteria: Vec<Criterion> = criteria
                .map(|(holds, near_limit)| Criterion { holds: *holds, near_limit: *near_limit })
                .collect();
            Verdict::of(&criteria, tone, None).words()
        };
        let (yes, no, open) = ((Some(true), false), (Some(false), false), (None, false));
        let (barely, nearly) = ((Some(true), true), (Some(false), true));
        assert_eq!(words(&[yes, yes], "bad"), "Holds");
        assert_eq!(words(&[no, yes, no], "good"), "Fails (2 of 3)");
        assert_eq!(words(&[no, nearly, open], "mixed"), "Fails (2 of 3)");
        for close in [barely, nearly, open] {
            assert_eq!(words(&[yes, close], "good"), "Too close to call");
        }
        assert_eq!(Verdict::of(&[], "bad", Some(0.8)), Verdict::Worse);
        assert_eq!(
            ["good", "mixed", "bad"].map(|tone| words(&[], tone)),
            ["Works", "Mixed", "Does nothing"]
        );
    }
}
