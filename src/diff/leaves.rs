//! A JSON document as a flat list of values, each under a name that stays the same when a list
//! grows: elements are named by what they are, not by where they stand.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Map, Value};

/// A number, word or flag of a document, and where it stands.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leaf<'a> {
    /// The value itself.
    pub value: &'a Value,
    /// The nearest element of a list that holds it, or the document.
    pub element: &'a Value,
}

/// The values of a document.
#[derive(Debug, Default)]
pub(super) struct Leaves<'a> {
    /// By path, such as `attractors[two-symmetric]/displacement/peak`.
    pub values: BTreeMap<String, Leaf<'a>>,
    /// Elements of lists, by path.
    pub elements: BTreeMap<String, &'a Value>,
}

/// Keys whose lists are pairs or matrices of numbers, not lists of things.
const PLAIN_LISTS: [&str; 4] = ["bracket", "interval", "multipliers", "share_interval_95"];

/// What names an element of a list, by the list's key.
const IDENTITIES: [(&str, &str); 8] = [
    ("answers", "question"),
    ("attractors", "regime"),
    ("claims", "id"),
    ("criteria", "name"),
    ("exact_boundaries", "kind"),
    ("fixed_points", "branch"),
    ("notes", "kind"),
    ("saddle_node", "branch"),
];

impl<'a> Leaves<'a> {
    /// The values of an object.
    pub fn of(document: &'a Value) -> Self {
        Self::default().and("", document)
    }

    /// The same with those of another object, under a name.
    pub fn and(mut self, name: &str, document: &'a Value) -> Self {
        if document.is_object() {
            self.walk(document, name.to_owned(), name, document);
        }
        self
    }

    /// Elements of lists that are here and not in `other`, the outermost only.
    pub fn elements_missing_in(&self, other: &Self) -> BTreeSet<String> {
        let mut missing: BTreeSet<String> = BTreeSet::new();
        for path in self.elements.keys().filter(|path| !other.elements.contains_key(*path)) {
            if !missing.iter().any(|outer| is_inside(path, outer)) {
                missing.insert(path.clone());
            }
        }
        missing
    }

    fn walk(&mut self, value: &'a Value, path: String, key: &str, element: &'a Value) {
        match value {
            Value::Object(fields) => {
                for (name, field) in fields {
                    self.walk(field, joined(&path, name), name, element);
                }
            }
            Value::Array(items) => {
                let mut seen: BTreeMap<String, usize> = BTreeMap::new();
                for (index, item) in items.iter().enumerate() {
                    let name = match item {
                        Value::Object(fields) => identity(key, fields).map(|name| {
                            let count = seen.entry(name.clone()).or_default();
                            *count += 1;
                            if *count == 1 { name } else { format!("{name} {count}") }
                        }),
                        _ => None,
                    };
                    let name = name.unwrap_or_else(|| (index + 1).to_string());
                    let path = format!("{path}[{name}]");
                    if PLAIN_LISTS.contains(&key) || !item.is_object() {
                        self.walk(item, path, key, element);
                    } else {
                        self.elements.insert(path.clone(), item);
                        self.walk(item, path, "", item);
                    }
                }
            }
            _ => {
                self.values.insert(path, Leaf { value, element });
            }
        }
    }
}

/// Whether a path lies in an element.
pub(super) fn is_inside(path: &str, element: &str) -> bool {
    path.strip_prefix(element).is_some_and(|rest| rest.is_empty() || rest.starts_with(['/', '[']))
}

/// A path without the names of elements: `attractors/displacement/peak`.
pub(super) fn key(path: &str) -> String {
    let mut depth = 0;
    path.chars()
        .filter(|letter| {
            match letter {
                '[' => depth += 1,
                ']' => depth -= 1,
                _ => return depth == 0,
            }
            false
        })
        .collect()
}

fn joined(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_owned() } else { format!("{path}/{name}") }
}

/// What an element is called. Lists that are not known are told apart by kind and branch, or by
/// position where they have neither.
fn identity(list: &str, fields: &Map<String, Value>) -> Option<String> {
    let text = |key: &str| fields.get(key).and_then(Value::as_str);
    if let Some((_, key)) = IDENTITIES.iter().find(|(name, _)| *name == list) {
        return text(key).map(str::to_owned);
    }
    let words: Vec<&str> = ["kind", "branch"].into_iter().filter_map(text).collect();
    if words.is_empty() { None } else { Some(words.join(" ")) }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn elements_are_named_by_what_they_are() {
        let document = json!({
            "attractors": [
                {"regime": "at-rest", "peak": 1.0},
                {"regime": "at-rest", "peak": 2.0, "multipliers": [[1.0, 2.0]]},
            ],
            "orbits": [{"phase": 3.0}],
        });
        let leaves = Leaves::of(&document);
        let paths: Vec<&str> = leaves.values.keys().map(String::as_str).collect();
        assert_eq!(
            paths,
            [
                "attractors[at-rest 2]/multipliers[1][1]",
                "attractors[at-rest 2]/multipliers[1][2]",
                "attractors[at-rest 2]/peak",
                "attractors[at-rest 2]/regime",
                "attractors[at-rest]/peak",
                "attractors[at-rest]/regime",
                "orbits[1]/phase",
            ]
        );
        assert_eq!(key("attractors[at-rest 2]/multipliers[1][2]"), "attractors/multipliers");
        let fewer = json!({"attractors": [{"regime": "at-rest"}], "orbits": [{}]});
        let missing = leaves.elements_missing_in(&Leaves::of(&fewer));
        assert_eq!(missing.into_iter().collect::<Vec<_>>(), ["attractors[at-rest 2]"]);
    }
}
