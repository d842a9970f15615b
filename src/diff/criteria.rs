//! Criteria of a case: what was asked, what was found, whether it holds.

use serde_json::{Value, json};

use super::Document;
use super::moved::{Moved, alike, moved};

/// Whether both sides say the same: asked alike, answered alike but for numbers, and found within both errors.
fn agree(old: &Value, new: &Value) -> bool {
    let same = |key: &str| old[key] == new[key];
    let found = same("found") || moved(&old["found"], &new["found"]) == Moved::Within;
    found && same("asked") && alike(old, new)
}

/// By which share of before what a criterion limits has moved towards its limit or beyond; none where it has not.
pub(super) fn worse_by(change: &Value) -> Option<f64> {
    let [old, new] = ["old", "new"].map(|side| change[side]["found"]["value"].as_f64());
    let sign = match change["new"]["relation"].as_str()? {
        "at-most" => 1.0,
        "at-least" => -1.0,
        _ => return None,
    };
    let by = sign * (new? - old?) / old?.abs();
    (by > 0.0 && by.is_finite()).then_some(by)
}

/// Criteria that do not agree, as they are on either side and null where there is none, flipped ones first, then those that
/// fail; and those of the new side that do agree.
pub(super) fn changes(old: &Document, new: &Document) -> (Vec<Value>, Vec<Value>) {
    let [old, new] = [old, new].map(|document| document.list("/criteria/all"));
    let same = |list: &[Value], wanted: &Value| {
        let found = list
            .iter()
            .find(|one| ["name", "place", "absorber"].iter().all(|key| one[key] == wanted[key]));
        found.cloned().unwrap_or_default()
    };
    let pairs = new.iter().map(|after| (same(old, after), after.clone()));
    let gone = old.iter().filter(|before| same(new, before).is_null());
    let gone = gone.map(|before| (before.clone(), Value::Null));
    let (agreeing, differing): (Vec<_>, Vec<_>) =
        pairs.chain(gone).partition(|(before, after)| !before.is_null() && agree(before, after));
    let change = |(old, new): (Value, Value)| {
        let flipped = !old.is_null() && !new.is_null() && old["holds"] != new["holds"];
        let name = if new.is_null() { &old["name"] } else { &new["name"] };
        json!({ "name": name, "flipped": flipped, "old": old, "new": new })
    };
    let mut changes: Vec<Value> = differing.into_iter().map(change).collect();
    changes.sort_by_key(|change| (change["flipped"] == false, change["new"]["holds"] != false));
    (changes, agreeing.into_iter().map(|(_, new)| new).collect())
}
