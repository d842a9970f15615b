//! Criteria of a case: what was asked, what was found, whether it holds.

use serde::Serialize;
use serde_json::Value;

use super::Document;
use super::moved::{Moved, moved};

/// A criterion that flipped, moved, appeared or vanished.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CriterionChange {
    /// Its key in the case file.
    pub name: String,
    /// Whether it is on both sides and the answer is another one.
    pub flipped: bool,
    /// Before, as in `report.json`; null where there was none.
    pub old: Value,
    /// After.
    pub new: Value,
}

impl CriterionChange {
    fn of(old: &Value, new: &Value) -> Self {
        let name = new["name"].as_str().or(old["name"].as_str()).unwrap_or("");
        let flipped = !old.is_null() && !new.is_null() && old["holds"] != new["holds"];
        Self { name: name.to_owned(), flipped, old: old.clone(), new: new.clone() }
    }
}

/// Whether both sides say the same: asked alike, answered alike, and found within both errors.
fn agree(old: &Value, new: &Value) -> bool {
    let same = |key: &str| old[key] == new[key];
    let found = same("found") || moved(&old["found"], &new["found"]) == Moved::Within;
    found && ["asked", "holds", "found_flag"].into_iter().all(same)
}

/// Criteria that do not agree, flipped ones first; and how many do agree.
pub(super) fn changes(old: &Document, new: &Document) -> (Vec<CriterionChange>, usize) {
    let [old, new] = [old, new].map(|document| document.list("/criteria/all"));
    let (same, differing): (Vec<_>, Vec<_>) = new
        .iter()
        .map(|after| (find(old, after).unwrap_or(&Value::Null), after))
        .partition(|(before, after)| !before.is_null() && agree(before, after));
    let gone = old.iter().filter(|before| find(new, before).is_none());
    let differing = differing.into_iter().chain(gone.map(|before| (before, &Value::Null)));
    let mut changes: Vec<_> =
        differing.map(|(before, after)| CriterionChange::of(before, after)).collect();
    changes.sort_by_key(|change| !change.flipped);
    (changes, same.len())
}

fn find<'a>(list: &'a [Value], wanted: &Value) -> Option<&'a Value> {
    list.iter().find(|one| one["name"] == wanted["name"])
}
