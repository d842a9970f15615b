//! Reports that have another name on either side, paired by what their cases say.

use std::collections::BTreeMap;

use serde_json::Value;

use super::document::Given;
use super::{Document, Reports};

/// The share of what two cases say that must be the same for one to be the other under a new name, as git has it of files.
const ALIKE: f64 = 0.5;

/// New names by old ones of reports that are on one side only: first those of one case text, then those whose cases say most
/// of the same.
pub(super) fn pairs<'a>(old: &'a Reports, new: &'a Reports) -> BTreeMap<&'a str, &'a str> {
    let gone: Vec<_> = old.iter().filter(|(name, _)| !new.contains_key(*name)).collect();
    let added: Vec<_> = new.iter().filter(|(name, _)| !old.contains_key(*name)).collect();
    let mut all = Vec::new();
    for (before, old) in &gone {
        for (after, new) in &added {
            all.push((alike(old, new), before.as_str(), after.as_str()));
        }
    }
    all.retain(|(share, ..)| *share >= ALIKE);
    all.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut found: BTreeMap<&str, &str> = BTreeMap::new();
    for (_, before, after) in all {
        if !found.contains_key(before) && !found.values().any(|taken| *taken == after) {
            found.insert(before, after);
        }
    }
    found
}

/// The share of what two cases say that is the same; 2 where their texts are.
fn alike(old: &Document, new: &Document) -> f64 {
    if old.case_digest().is_some() && old.case_digest() == new.case_digest() {
        return 2.0;
    }
    let whole = old.has_whole_case() && new.has_whole_case();
    let says = |of: &Document| -> BTreeMap<String, Value> {
        of.inputs(whole).into_iter().map(|Given { path, value, .. }| (path, value)).collect()
    };
    let [old, new] = [old, new].map(says);
    let same = old.iter().filter(|(path, value)| new.get(*path) == Some(value)).count();
    same as f64 / old.len().max(new.len()) as f64
}
