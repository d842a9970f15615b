//! What a reviewer reads first, and what numbers and states are called.

use std::collections::BTreeSet;

use serde_json::Value;

use super::moved::kind;
use super::{Change, ReportDifference};
use crate::quantity::Kind;
use crate::quantity::catalogue::Dimension;

/// Quantities that a reviewer looks at first, by path, the most important first.
const HEADLINES: [&str; 29] = [
    "absorbers",
    "band/worst/peak",
    "loads/worst/peak",
    "quantities/decay_time",
    "quantities/active_decay_time",
    "quantities/peak_displacement",
    "quantities/change_db",
    "quantities/rms_displacement",
    "ranges/from",
    "ranges/to",
    "loads/forces/limits",
    "worst_off/peak",
    "quantities/impacts_per_period",
    "quantities/impact_speed",
    "band/bare/peak",
    "loads/bare/peak",
    "off/worst/peak",
    "band/damper/peak",
    "band/stable_share",
    "band/z3_share",
    "quantities/bare_peak",
    "quantities/damper_peak",
    "alternatives/worst",
    "theory/orbits/peak",
    "theory/orbits/impact_speed",
    "theory/orbits/multiplier",
    "theory/boundaries/exact",
    "motions/starts/share",
    "motions/peak",
];

/// The same of what has no size. Those before [`FURTHER_STATES`] are told before the fold.
const STATES: [&str; 9] = [
    "choice/winner",
    "loads/worst",
    "main",
    "theory/area",
    "theory/strip",
    "notes",
    "motions",
    "theory/orbits",
    "theory/fixed_points",
];
/// See [`STATES`].
const FURTHER_STATES: usize = 6;

/// What a reader calls the keys of a document; others are called as they are.
const WORDS: [(&str, &str); 22] = [
    ("absorbers", "absorber"),
    ("alternatives", ""),
    ("answers", "answer"),
    ("boundaries", "boundary"),
    ("choice", ""),
    ("claims", "claim"),
    ("combined", "combination"),
    ("deviations", "deviation"),
    ("fixed_points", "fixed point"),
    ("forces", ""),
    ("loads", "load"),
    ("main", "main motion"),
    ("motions", "motion"),
    ("off", "natural frequencies off"),
    ("orbits", "exact orbit"),
    ("quantities", ""),
    ("ranges", "range of"),
    ("rows", ""),
    ("stretches", "stable range"),
    ("theory", ""),
    ("winner", "better device"),
    ("worst_off", "natural frequencies off, worst"),
];

/// The most important first; a number that stands in several places is told once.
pub(super) fn sorted(mut found: ReportDifference) -> ReportDifference {
    let rank = |order: &[&str], path: &str| {
        let key = without_elements(path);
        let inside = |first: &&str| {
            key.strip_prefix(first).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
        };
        order.iter().position(inside).unwrap_or(order.len())
    };
    // What no headline names: theory explains, and its phases come last.
    let is_phase =
        |one: &Change| kind(&one.new).is_some_and(|kind| kind.dimension == Dimension::Angle);
    found.numbers.sort_by_key(|one| {
        (rank(&HEADLINES, &one.path), one.path.starts_with("theory/"), is_phase(one))
    });
    found.states.sort_by_key(|one| rank(&STATES, &one.path));
    let numbers = |old: &Value, new: &Value| {
        [&new["id"], &old["value"], &new["value"]].map(ToString::to_string)
    };
    let criteria =
        found.criteria.iter().map(|one| numbers(&one["old"]["found"], &one["new"]["found"]));
    let mut told: BTreeSet<[String; 3]> = criteria.collect();
    found.numbers.retain(|one| told.insert(numbers(&one.old, &one.new)));
    found
}

impl Change {
    /// Whether a state is one of the first that a reviewer asks for.
    pub(super) fn is_key_state(&self) -> bool {
        STATES[..FURTHER_STATES].contains(&without_elements(&self.path).as_str())
    }
}

/// A path without the names of elements: `motions/peak`.
pub(super) fn without_elements(path: &str) -> String {
    path.split('/').map(|part| part.split('[').next().unwrap_or(part)).collect::<Vec<_>>().join("/")
}

/// A path in words, and the name of the quantity there: `motion two-symmetric: peak displacement`.
pub(super) fn label(path: &str, kind: Option<&Kind>) -> String {
    let mut words: Vec<String> = Vec::new();
    for segment in path.split('/') {
        let (key, element) = segment.split_once('[').unwrap_or((segment, ""));
        let known = WORDS.iter().find(|(name, _)| *name == key);
        words.push(known.map_or_else(|| key.replace('_', " "), |(_, word)| (*word).to_owned()));
        words.push(element.trim_end_matches(']').replace("][", " "));
    }
    if let Some(kind) = kind
        && let Some(field) = words.iter_mut().rfind(|word| !word.is_empty())
        && (field == "at"
            || kind.name.contains(&*field)
            || kind.id.replace('_', " ").contains(&*field))
    {
        field.clear();
    }
    words.retain(|word| !word.is_empty());
    let place = words.join(" ");
    match kind {
        None => place,
        Some(kind) if place.is_empty() => kind.name.to_owned(),
        Some(kind) => format!("{place}: {}", kind.name),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::catalogue as of;

    #[test]
    fn paths_become_words() {
        for (path, kind, words) in [
            ("quantities/peak_displacement", Some(&of::PEAK), "peak displacement"),
            (
                "motions[two-symmetric]/peak",
                Some(&of::PEAK),
                "motion two-symmetric: peak displacement",
            ),
            (
                "theory/orbits[2]/multiplier",
                Some(&of::SPECTRAL_RADIUS),
                "exact orbit 2: largest multiplier",
            ),
            (
                "theory/boundaries[saddle-node stable]/exact",
                Some(&of::BOUNDARY),
                "boundary saddle-node stable exact: clearance at the boundary",
            ),
            ("theory/orbits[2]/stable", None, "exact orbit 2 stable"),
            ("theory/area", None, "area"),
        ] {
            assert_eq!(label(path, kind), words);
        }
    }
}
