//! The page about the simulation at the ends of its range.

use serde::Serialize;

use super::numbers::significant;
use super::render::{self, RenderError};
use crate::extremes::contact::ContactTable;
use crate::extremes::list::{FOLLOWED, IMPACT_LIMIT};
use crate::extremes::{ContactCost, Outcome, UnitCheck, Verdict};
use crate::simulation::Stop;
use crate::simulation::trust::{ENERGY_RESIDUAL, RESOLUTION};

/// What stands where there is nothing to say.
const NOTHING: &str = "–";

/// The page, formatted.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Extremes {
    runs: usize,
    held: usize,
    flagged: usize,
    refused: usize,
    wrong: usize,
    /// What is flagged, refused or wrong, and why.
    reasons: Vec<String>,
    rows: Vec<[String; 10]>,
    contact: Vec<Contact>,
    units: Vec<[String; 5]>,
    units_held: usize,
    limits: Limits,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct Limits {
    energy: String,
    resolution: String,
    impacts: u64,
    followed: usize,
}

/// The effect of the contact tolerance on one system.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct Contact {
    words: &'static str,
    rows: Vec<[String; 8]>,
}

impl Extremes {
    /// Formats what was measured.
    pub fn of(outcomes: &[Outcome], contact: &[ContactTable], units: &[UnitCheck]) -> Self {
        let count = |wanted: fn(&Verdict) -> bool| {
            outcomes.iter().filter(|outcome| wanted(&outcome.verdict)).count()
        };
        Self {
            runs: outcomes.len(),
            held: count(|verdict| *verdict == Verdict::Holds),
            flagged: count(|verdict| matches!(verdict, Verdict::Flagged(_))),
            refused: count(|verdict| matches!(verdict, Verdict::Refused(_))),
            wrong: count(|verdict| *verdict == Verdict::Wrong),
            reasons: outcomes.iter().filter_map(reason).collect(),
            rows: outcomes.iter().map(row).collect(),
            contact: contact
                .iter()
                .map(|table| Contact {
                    words: table.words,
                    rows: table.costs.iter().map(contact_row).collect(),
                })
                .collect(),
            units: units.iter().map(unit_row).collect(),
            units_held: units.iter().filter(|check| check.holds).count(),
            limits: Limits {
                energy: exponent(ENERGY_RESIDUAL),
                resolution: exponent(RESOLUTION),
                impacts: IMPACT_LIMIT,
                followed: FOLLOWED,
            },
        }
    }

    /// Whether nothing that is trusted is wrong.
    pub fn holds(&self) -> bool {
        self.wrong == 0 && self.units_held == self.units.len()
    }

    /// The page as Markdown.
    ///
    /// # Errors
    /// [`RenderError::Template`] if template and page do not fit.
    pub fn markdown(&self) -> Result<String, RenderError> {
        render::extremes(self)
    }
}

fn reason(outcome: &Outcome) -> Option<String> {
    let (what, value) = (outcome.entry.group.words(), &outcome.entry.value);
    let text = match &outcome.verdict {
        Verdict::Holds => return None,
        Verdict::Flagged(doubts) => {
            let words: Vec<String> = doubts.iter().map(|doubt| doubt.words()).collect();
            format!("flagged: {}", words.join("; "))
        }
        Verdict::Refused(refusal) => format!("refused: {refusal}"),
        Verdict::Wrong => "**trusted, and yet not what the reference says**".to_owned(),
    };
    Some(format!("{what}, {value}: {text}"))
}

fn row(outcome: &Outcome) -> [String; 10] {
    let verdict = match &outcome.verdict {
        Verdict::Holds => "holds",
        Verdict::Flagged(_) => "flagged",
        Verdict::Refused(_) => "refused",
        Verdict::Wrong => "**wrong**",
    };
    let entry = &outcome.entry;
    let name = [entry.group.words().to_owned(), entry.value.clone()];
    let nothing = || NOTHING.to_owned();
    let numbers = outcome.measured.as_ref().map_or_else(
        || std::array::from_fn(|_| nothing()),
        |measured| {
            let each = |count: u64| match measured.periods {
                0 => nothing(),
                periods => significant(count as f64 / periods as f64, 3),
            };
            let whole = measured.stop == Stop::EndTime;
            let compared = measured.comparison.as_ref().filter(|compared| compared.events > 0);
            [
                if whole {
                    measured.periods.to_string()
                } else {
                    format!("{} of {}", measured.periods, entry.run.periods)
                },
                each(measured.impacts),
                each(measured.evaluations),
                if whole { significant(measured.energy_residual, 2) } else { nothing() },
                significant(measured.penetration, 2),
                compared.map_or_else(nothing, |compared| {
                    format!("{} ({})", significant(compared.error, 2), compared.events)
                }),
                compared.map_or_else(nothing, |compared| significant(compared.one_rounding, 2)),
            ]
        },
    );
    let [first, value] = name;
    let [periods, impacts, evaluations, energy, penetration, error, rounding] = numbers;
    let verdict = verdict.to_owned();
    [first, value, periods, impacts, evaluations, energy, penetration, error, rounding, verdict]
}

fn contact_row(cost: &ContactCost) -> [String; 8] {
    [
        exponent(cost.tolerance.excursion),
        significant(cost.tolerance.drift, 1),
        significant(cost.time, 2),
        significant(cost.displacement, 2),
        significant(cost.loss, 2),
        significant(cost.rms, 6),
        significant(cost.impacts_per_period, 3),
        significant(cost.evaluations_per_period, 3),
    ]
}

fn unit_row(check: &UnitCheck) -> [String; 5] {
    [
        check.clearance.clone(),
        significant(check.difference, 2),
        format!("{} ({})", significant(check.times, 2), check.impacts),
        significant(check.scale, 2),
        if check.holds { "holds" } else { "**does not hold**" }.to_owned(),
    ]
}

/// A power of ten as a formula, where it is one.
fn exponent(value: f64) -> String {
    match format!("{value:e}").split_once('e') {
        Some(("1", exponent)) => format!("$10^{{{exponent}}}$"),
        _ => significant(value, 2),
    }
}
