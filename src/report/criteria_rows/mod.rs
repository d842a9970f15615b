//! Judged criteria in words and as data: for a terminal, a report, a pull request and build servers.

use serde::Serialize;

use super::numbers::{LengthFormat, fixed, percent, percent_sharply, significant};
use super::units::Units;
use crate::case::{Case, Measure, Relation, Subject};
use crate::criteria::Judged;
use crate::method::Method;

/// A criterion, judged: one line of every format. Numbers in SI units, or the case's own.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CriterionRow {
    /// The key in the case file.
    pub name: &'static str,
    /// What was asked, as written.
    pub asked: String,
    /// What was found; 1 and 0 for true and false, `None` where nothing could be measured.
    pub found: Option<f64>,
    /// Unit of `found`, `error` and `margin`: `1`, `m`, `m/s`, `dB`.
    pub unit: &'static str,
    /// How far `found` may be off.
    pub error: Option<f64>,
    /// Room that is left; negative where the criterion does not hold.
    pub margin: Option<f64>,
    /// Whether it holds.
    pub holds: Option<bool>,
    /// Whether the error could turn that.
    pub near_limit: bool,
    /// Which layer decided.
    pub decided_by: Method,
    /// Where in the band it is worst, with unit; empty where that says nothing.
    pub at: String,
    /// Share of the absorber's resting places from which a start from rest never wakes it, where that
    /// motion decides.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inactive_share: Option<f64>,
    /// Whether the motion that decides has settled.
    pub settled: bool,
    /// `asked`, `found` and `margin` as a person reads them.
    #[serde(skip)]
    pub words: [String; 3],
}

impl CriterionRow {
    /// "holds", "fails", or what else there is to say.
    pub fn verdict(&self) -> &'static str {
        verdict(self.holds, self.near_limit)
    }

    /// What was found and where, in a line.
    pub fn found_words(&self) -> String {
        let mut words = self.words[1].clone();
        if !self.at.is_empty() {
            words += &format!(" at {}", self.at);
        }
        if let Some(share) = self.inactive_share {
            words += &format!(" (absorber inactive from {} of resting places)", percent(share));
        }
        if !self.settled {
            words += " (not settled)";
        }
        words
    }
}

/// A line for each judged criterion.
pub fn rows(case: &Case, judged: &[Judged]) -> Vec<CriterionRow> {
    judged.iter().map(|one| row(case, one)).collect()
}

fn row(case: &Case, judged: &Judged) -> CriterionRow {
    let criterion = &judged.criterion;
    let measure = criterion.subject.measure();
    let number = |value: f64| number(case, measure, value);
    let asked = match (measure, criterion.relation) {
        (Measure::Flag, _) => yes(criterion.limit).to_owned(),
        (_, relation) => format!("{} {}", sign(relation), number(criterion.limit)),
    };
    let found = judged.found.map_or_else(
        || "nothing".to_owned(),
        |found| match measure {
            Measure::Flag => yes(found).to_owned(),
            _ => number(found) + &error_words(case, judged),
        },
    );
    let margin = match (judged.margin, measure) {
        (Some(margin), Measure::Share | Measure::Length | Measure::Decibel | Measure::Velocity) => {
            let sign = if margin < 0.0 { "−" } else { "+" };
            // Shares differ by percentage points, not by per cent of one another.
            format!("{sign}{}", number(margin.abs()).replace('%', "points"))
        }
        _ => String::new(),
    };
    CriterionRow {
        name: criterion.subject.key(),
        asked: criterion.as_written.clone(),
        found: judged.found,
        unit: unit(case, measure),
        error: judged.found.map(|_| judged.error),
        margin: judged.margin,
        holds: judged.holds,
        near_limit: judged.near_limit,
        decided_by: judged.decided_by,
        at: judged
            .at
            .zip(case.band.as_ref())
            .map_or_else(String::new, |(at, band)| Units::of(case).band_text(band.over, at)),
        inactive_share: judged.inactive,
        settled: judged.settled,
        words: [asked, found, margin],
    }
}

/// Error of a reduction that changes a digit that is shown.
const LEAST_DECIBELS: f64 = 0.05;

/// By how much a simulated value may be worse, where that changes a digit that is shown.
fn error_words(case: &Case, judged: &Judged) -> String {
    let least = match judged.criterion.subject.measure() {
        Measure::Decibel => LEAST_DECIBELS,
        _ => 1e-3 * judged.found.map_or(0.0, f64::abs),
    };
    let relevant = judged.error > least;
    if !judged.criterion.subject.is_of_motions() || !relevant {
        return String::new();
    }
    let sign = match judged.criterion.relation {
        Relation::AtLeast => "−",
        Relation::AtMost => "+",
        Relation::Equal => "±",
    };
    format!(" ({sign}{})", number(case, judged.criterion.subject.measure(), judged.error))
}

fn yes(value: f64) -> &'static str {
    if value > 0.5 { "true" } else { "false" }
}

fn sign(relation: Relation) -> &'static str {
    match relation {
        Relation::AtLeast => "≥",
        Relation::AtMost => "≤",
        Relation::Equal => "=",
    }
}

fn number(case: &Case, measure: Measure, value: f64) -> String {
    match measure {
        Measure::Share => percent_sharply(value),
        Measure::Length => LengthFormat::of(&case.scales()).text(value),
        Measure::Decibel => format!("{} dB", fixed(value, 1)),
        Measure::Velocity if case.scales().natural_frequency_rad_per_s.is_some() => {
            format!("{} m/s", significant(value, 3))
        }
        Measure::Velocity | Measure::Count | Measure::Flag => significant(value, 3),
    }
}

fn unit(case: &Case, measure: Measure) -> &'static str {
    let physical = case.scales().natural_frequency_rad_per_s.is_some();
    match measure {
        Measure::Share | Measure::Count | Measure::Flag => "1",
        Measure::Decibel => "dB",
        Measure::Length => case.scales().length_unit().symbol(),
        Measure::Velocity => {
            if physical {
                "m/s"
            } else {
                "1"
            }
        }
    }
}

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
        Measure::Flag => Some(yes(found).to_owned()),
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
