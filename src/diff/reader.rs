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
    "band/worst/change",
    "loads/worst/peak",
    "loads/worst",
    "quantities/decay_time",
    "quantities/active_decay_time",
    "quantities/peak_displacement",
    "quantities/change_db",
    "quantities/rms_displacement",
    "ranges/from",
    "ranges/to",
    "loads/forces/limits",
    "quantities/impacts_per_period",
    "quantities/impact_speed",
    "band/bare/peak",
    "loads/bare/peak",
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

/// Those before this one are of the structure with its absorber.
const FURTHER_HEADLINES: usize = 15;

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
const WORDS: [(&str, &str); 28] = [
    ("absorbers", "absorber"),
    ("alternatives", ""),
    ("answers", "answer"),
    ("band", ""),
    ("bare", ""),
    ("boundaries", "boundary"),
    ("choice", ""),
    ("claims", "claim"),
    ("combined", "combination"),
    ("deviations", "deviation"),
    ("fixed_points", "fixed point"),
    ("forces", ""),
    ("group", ""),
    ("loads", "load"),
    ("main", "main motion"),
    ("manifolds", "manifold of"),
    ("most", "at most"),
    ("motions", "motion"),
    ("orbits", "exact orbit"),
    ("places", "motions"),
    ("points", "fixed point"),
    ("quantities", ""),
    ("ranges", "range of"),
    ("restitutions", "absorber"),
    ("rows", ""),
    ("stretches", "stable range"),
    ("theory", ""),
    ("winner", "better device"),
];

/// The place of a path in an order, by itself or by what holds it; after the end where it has none.
fn rank(order: &[&str], path: &str) -> usize {
    let key = without_elements(path);
    let inside = |first: &&str| {
        key.strip_prefix(first).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
    };
    order.iter().position(inside).unwrap_or(order.len())
}

/// The most important first; a number that stands in several places is told once.
pub(super) fn sorted(mut found: ReportDifference) -> ReportDifference {
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

/// What the numbers at a path are over, where a report has the same of something else too: a band beside the case's own
/// frequency, or several loads.
pub(super) fn over(path: &str, report: &Value) -> &'static str {
    let begins = |with: &[&str]| with.iter().any(|first| path.starts_with(first));
    let has_band = report["band"].is_object();
    match () {
        () if begins(&["band/", "places"]) => " over the band",
        () if has_band && begins(&["quantities/", "motions", "inactive"]) => {
            " at its own frequency"
        }
        () if report["loads"].is_array() && begins(&["quantities/"]) => " over all loads",
        () => "",
    }
}

/// Quantities of which less is better.
const LESS_IS_BETTER: [&str; 5] =
    ["peak_displacement", "rms_displacement", "change_db", "impact_speed", "decay_time"];

impl Change {
    /// Whether a number is one of those that a reviewer looks at first.
    pub(super) fn is_headline(&self) -> bool {
        rank(&HEADLINES, &self.path) < HEADLINES.len()
    }

    /// By which share of before a vibration of the structure has grown, of those that a reviewer looks at first.
    pub(super) fn worse_by(&self) -> Option<f64> {
        let is_headline = rank(&HEADLINES, &self.path) < FURTHER_HEADLINES;
        let id = self.new["id"].as_str().filter(|id| LESS_IS_BETTER.contains(id) && is_headline)?;
        let (old, new) = (self.old["value"].as_f64()?, self.new["value"].as_f64()?);
        // A level is a ratio already: 20 dB are a factor of ten.
        let by = match id {
            "change_db" => libm::exp10((new - old) / 20.0) - 1.0,
            _ => new / old - 1.0,
        };
        (by > 0.0 && by.is_finite()).then_some(by)
    }

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
        // Over a band the worst is meant, unless it is said otherwise.
        if key == "worst" && kind.is_some() && path.starts_with("band/") {
            continue;
        }
        let element = element.trim_end_matches(']').replace("][", " ");
        // The ends of what was tried.
        if let ("holds", Some((which, end))) = (key, element.split_once(' ')) {
            let which = if which == "1" { String::new() } else { format!(" ({which})") };
            words.push(format!("hold{which} {}", if end == "1" { "from" } else { "to" }));
            continue;
        }
        let known = WORDS.iter().find(|(name, _)| *name == key);
        // Orbits of several modes, each by its number.
        let is_orbit = key == "exact" && !element.is_empty();
        words.push(match known {
            _ if is_orbit => "exact orbit".to_owned(),
            Some((_, word)) => (*word).to_owned(),
            None => key.replace('_', " "),
        });
        words.push(element);
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
            (
                "loads[1]/theory[mode 2]/exact[1]/amplitude",
                Some(&of::OSCILLATOR_AMPLITUDE),
                "load 1 mode 2 exact orbit 1: amplitude of the oscillator",
            ),
            (
                "loads[2]/forces/limits/holds[1][2]",
                Some(&of::FORCE_AMPLITUDE),
                "load 2 limits hold to: amplitude of the force",
            ),
            (
                "loads[1]/bare/peak",
                Some(&of::BARE_PEAK),
                "load 1: peak displacement without absorber",
            ),
            ("theory/area", None, "area"),
        ] {
            assert_eq!(label(path, kind), words);
        }
    }
}
