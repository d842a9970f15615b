//! Judged criteria in words, for comparisons of reports.

use super::numbers::percent_sharply;
use crate::case::{Measure, Subject};

/// What a criterion came to, in words.
pub fn verdict(holds: Option<bool>, near_limit: bool) -> &'static str {
    match (holds, near_limit) {
        (Some(true), false) => "holds",
        (Some(false), false) => "fails",
        (Some(_), true) => "too close to call",
        (None, _) => "could not be measured",
    }
}

/// What was found for the criterion with this key, as a report shows it; `None` for what is shown in
/// the unit that `report.json` gives, and for a key of another version.
pub fn unitless_words(key: &str, found: f64) -> Option<String> {
    match known(key)?.measure() {
        Measure::Share => Some(percent_sharply(found)),
        Measure::Flag => Some((found > 0.5).to_string()),
        _ => None,
    }
}

fn known(key: &str) -> Option<Subject> {
    Subject::ALL.into_iter().find(|known| known.key() == key)
}

/// A subject as a report calls it; the key itself where it is one of another version.
pub fn subject(key: &str) -> &str {
    match known(key) {
        Some(Subject::Z3Share) => "share of the band in area Z3",
        Some(Subject::StableShare) => "share of the band with a stable 1:1 orbit",
        Some(Subject::PeakDisplacement) => "peak displacement",
        Some(Subject::RmsDisplacement) => "rms displacement",
        Some(Subject::ReductionDb) => "reduction against the bare oscillator",
        Some(Subject::ReductionDbTmd) => "reduction against the best tuned mass damper",
        Some(Subject::MarginClearance) => "margin of the clearance",
        Some(Subject::ImpactVelocity) => "impact velocity",
        Some(Subject::ImpactsPerPeriod) => "impacts per period",
        Some(Subject::NoCoexistence) => "no other motion beside",
        None => key,
    }
}
