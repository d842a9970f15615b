//! Criteria of a case: what was asked, what was found, whether it holds.

use serde::Serialize;
use serde_json::Value;

use super::Document;
use super::accuracy::ROUNDING;

/// A criterion that flipped, moved, appeared or vanished.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CriterionChange {
    /// Its name.
    pub name: String,
    /// Unit of what was found, `1` for a plain number.
    pub unit: String,
    /// Before; `None` where there was none.
    pub old: Option<Found>,
    /// After; `None` where there is none.
    pub new: Option<Found>,
}

/// One side of a criterion.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Found {
    /// What was asked, such as `>= 0.8`.
    pub asked: String,
    /// What was found.
    pub value: Option<f64>,
    /// How well that is known.
    pub error: Option<f64>,
    /// Whether it holds; `None` where that could not be decided.
    pub holds: Option<bool>,
    /// Whether the limit is within the error.
    pub near_limit: bool,
    /// The layer that decided.
    pub decided_by: Option<String>,
}

impl CriterionChange {
    /// Whether the answer is another one.
    pub fn is_flipped(&self) -> bool {
        let holds = |found: &Option<Found>| found.as_ref().map(|found| found.holds);
        match (holds(&self.old), holds(&self.new)) {
            (Some(old), Some(new)) => old != new,
            _ => false,
        }
    }
}

impl Found {
    fn of(criterion: &Value) -> Self {
        let mut asked = criterion["asked"].as_str().unwrap_or("").to_owned();
        if criterion["unit"] == "dB" && !asked.ends_with("dB") {
            asked.push_str(" dB");
        }
        Self {
            asked,
            value: criterion["found"].as_f64(),
            error: criterion["error"].as_f64(),
            holds: criterion["holds"].as_bool(),
            near_limit: criterion["near_limit"].as_bool().unwrap_or(false),
            decided_by: criterion["decided_by"].as_str().map(str::to_owned),
        }
    }

    /// Whether the other side says the same: asked alike, answered alike, and within both errors.
    fn agrees(&self, other: &Self) -> bool {
        let close = match (self.value, other.value) {
            (Some(a), Some(b)) => {
                let errors = self.error.unwrap_or(0.0) + other.error.unwrap_or(0.0);
                (b - a).abs() <= errors + ROUNDING * a.abs().max(b.abs())
            }
            (a, b) => a == b,
        };
        close && self.asked == other.asked && self.holds == other.holds
    }
}

/// Criteria that do not agree, flipped ones first; and how many do agree.
pub(super) fn changes(old: &Document, new: &Document) -> (Vec<CriterionChange>, usize) {
    let (old, new) = (old.list("criteria"), new.list("criteria"));
    let mut changes = Vec::new();
    let mut same = 0;
    for criterion in new {
        let (before, after) = (find(old, name(criterion)), Found::of(criterion));
        match before.map(Found::of) {
            Some(before) if before.agrees(&after) => same += 1,
            before => changes.push(change(criterion, before, Some(after))),
        }
    }
    let gone = old.iter().filter(|criterion| find(new, name(criterion)).is_none());
    changes.extend(gone.map(|criterion| change(criterion, Some(Found::of(criterion)), None)));
    changes.sort_by_key(|change| !change.is_flipped());
    (changes, same)
}

fn change(criterion: &Value, old: Option<Found>, new: Option<Found>) -> CriterionChange {
    let unit = criterion["unit"].as_str().unwrap_or("1").to_owned();
    CriterionChange { name: name(criterion).to_owned(), unit, old, new }
}

fn name(criterion: &Value) -> &str {
    criterion["name"].as_str().unwrap_or("")
}

fn find<'a>(criteria: &'a [Value], wanted: &str) -> Option<&'a Value> {
    criteria.iter().find(|criterion| name(criterion) == wanted)
}
