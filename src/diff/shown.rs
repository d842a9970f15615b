//! Numbers of a difference as a reviewer reads them: with enough digits to see the change.

use super::{CriterionChange, Found, NumberChange};
use crate::report::criteria_rows::unitless_words;
use crate::report::numbers::{signed_percent, significant, with_minus};
use crate::report::render::markdown_cell;

/// A row of numbers, formatted.
pub(super) struct Shown {
    what: String,
    /// Before, with its unit.
    old: String,
    /// After.
    new: String,
    /// New minus old, relative where that is how people think of it.
    change: String,
}

impl Shown {
    /// Formats a row.
    pub fn of(change: &NumberChange) -> Self {
        let size = change.old.abs().max(change.new.abs());
        let (factor, unit) = displayed(change.unit, size);
        // Enough digits to see the change.
        let relative = if size > 0.0 { change.change.abs() / size } else { 0.0 };
        let digits = if relative > 0.0 { (2.5 - libm::log10(relative)) as usize } else { 17 };
        let digits = digits.clamp(USUAL_DIGITS, 17);
        let value = |value: f64| format!("{}{unit}", significant(factor * value, digits));
        let plain = ["dB", "rad", "%", ""].contains(&change.unit)
            || change.old.abs() < change.allowed
            || change.old == 0.0;
        let sign = if change.change < 0.0 { "" } else { "+" };
        let difference = if plain {
            let unit = if unit == " %" { " points" } else { unit.as_str() };
            format!("{sign}{}{unit}", significant(factor * change.change, 3))
        } else {
            share(change.change / change.old.abs())
        };
        let (old, new) = (value(change.old), value(change.new));
        Self { what: change.what.clone(), old, new, change: difference }
    }

    /// A line of a table.
    pub fn row(&self) -> String {
        let Self { what, old, new, change } = self;
        format!("| {} | {old} | {new} | {change} |", markdown_cell(what))
    }
}

/// What was found for a criterion before and after: as a report shows it, or where that says the same of
/// two numbers, with as many digits as tell them apart.
pub(super) fn found(change: &CriterionChange) -> [Option<String>; 2] {
    let values =
        [&change.old, &change.new].map(|side| side.as_ref().and_then(|found: &Found| found.value));
    let usual = |value: f64| unitless_words(&change.name, value);
    let words = values.map(|value| value.and_then(usual));
    let differ = |texts: &[Option<String>; 2]| texts[0] != texts[1] || values[0] == values[1];
    if words.iter().any(Option::is_some) && differ(&words) {
        return words;
    }
    let unit = if words.iter().any(Option::is_some) { "%" } else { change.unit.as_str() };
    let with = |digits: usize| {
        values.map(|value| {
            let value = value?;
            let (factor, unit) = displayed(unit, value.abs());
            Some(format!("{}{unit}", significant(factor * value, digits)))
        })
    };
    (USUAL_DIGITS..17).map(with).find(differ).unwrap_or_else(|| with(17))
}

/// Digits of a number, unless two need more to be told apart.
const USUAL_DIGITS: usize = 4;

/// A relative change; nobody says 1e-7 %.
fn share(relative: f64) -> String {
    if relative.abs() >= 1e-4 {
        return signed_percent(relative);
    }
    let sign = if relative < 0.0 { "−" } else { "+" };
    format!("{sign}{}", with_minus(&format!("{:.0e}", relative.abs())))
}

/// The factor and the unit, with its space, that a person would use.
fn displayed(unit: &str, size: f64) -> (f64, String) {
    match unit {
        "" | "1" => (1.0, String::new()),
        "%" => (100.0, " %".into()),
        "m" | "J" | "m/s" if size > 0.0 && size < 1.0 => {
            let (factor, prefix) = if size >= 1e-4 { (1e3, "m") } else { (1e6, "µ") };
            (factor, format!(" {prefix}{unit}"))
        }
        _ => (1.0, format!(" {unit}")),
    }
}
