//! What the case says: its numbers as written, its words, and how thoroughly it was simulated.

use std::collections::BTreeMap;

use super::{Document, WordChange};

/// Rows of the table of inputs that follow from others, and say so.
const DERIVED: &str = "derived";

/// Inputs that are not the same.
pub(super) fn changes(old: &Document, new: &Document) -> Vec<WordChange> {
    let (old, new) = (inputs(old), inputs(new));
    let mut names: Vec<&String> = new.iter().map(|(name, _)| name).collect();
    names.extend(old.iter().map(|(name, _)| name).filter(|name| find(&new, name).is_none()));
    names
        .into_iter()
        .filter_map(|name| {
            let (before, after) = (find(&old, name), find(&new, name));
            let change =
                || WordChange { what: name.clone(), old: before.clone(), new: after.clone() };
            (before != after).then(change)
        })
        .collect()
}

fn find(inputs: &[(String, String)], name: &str) -> Option<String> {
    inputs.iter().find(|(found, _)| found == name).map(|(_, value)| value.clone())
}

/// Name and value as written, in the case's order.
fn inputs(document: &Document) -> Vec<(String, String)> {
    let mut found: Vec<(String, String)> = Vec::new();
    for field in ["title", "source"] {
        found.push((field.to_owned(), document.text(field).to_owned()));
    }
    let mut seen: BTreeMap<&str, usize> = BTreeMap::new();
    for row in document.report["tables"]["inputs"]["rows"].as_array().into_iter().flatten() {
        let cell = |index: usize| row[index].as_str().unwrap_or("");
        if cell(3) == DERIVED {
            continue;
        }
        let count = seen.entry(cell(0)).or_default();
        *count += 1;
        let name = if *count == 1 { cell(0).to_owned() } else { format!("{} {count}", cell(0)) };
        found.push((name, cell(2).to_owned()));
    }
    let effort = &document.report["provenance"]["effort"];
    for (name, value) in effort.as_object().into_iter().flatten() {
        found.push((format!("simulation: {name}"), value.to_string()));
    }
    let demand = &document.report["layers"]["data"]["demand"];
    for (name, value) in demand.as_object().into_iter().flatten() {
        found.push((format!("accuracy: {}", name.replace('_', " ")), value.to_string()));
    }
    found
}
