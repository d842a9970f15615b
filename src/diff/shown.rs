//! Numbers of a difference as a reviewer reads them: with enough digits to see the change.

use super::{CriterionChange, Found, NumberChange};
use crate::report::criteria::unitless_words;
use crate::report::numbers::{signed_percent, significant, with_minus};

/// A row of numbers, formatted.
pub(super) struct Shown {
    /// Before, with its unit.
    pub old: String,
    /// After.
    pub new: String,
    /// New minus old, relative where that is how people think of it.
    pub change: String,
    /// The largest change that means nothing, in the same way.
    pub allowed: String,
}

impl Shown {
    /// Formats a row.
    pub fn of(change: &NumberChange) -> Self {
        let size = change.old.abs().max(change.new.abs());
        let (factor, unit) = displayed(change.unit, size);
        // Enough digits to see the change.
        let relative = if size > 0.0 { change.change.abs() / size } else { 0.0 };
        let digits = if relative > 0.0 { (2.5 - libm::log10(relative)) as usize } else { 17 };
        let digits = digits.clamp(4, 17);
        let value = |value: f64| format!("{}{unit}", significant(factor * value, digits));
        let sign = if change.change < 0.0 { "" } else { "+" };
        let plain = ["dB", "rad", "%", ""].contains(&change.unit)
            || change.old.abs() < change.allowed
            || change.old == 0.0;
        let (change_text, allowed) = if plain {
            let value = |value: f64| format!("{}{unit}", significant(factor * value, 3));
            (format!("{sign}{}", value(change.change)), value(change.allowed))
        } else {
            let relative = change.change / change.old.abs();
            (share(relative, true), share(change.allowed / change.old.abs(), false))
        };
        Self {
            old: value(change.old),
            new: value(change.new),
            change: change_text,
            allowed: format!("±{allowed}"),
        }
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

/// Digits of what a criterion found.
const USUAL_DIGITS: usize = 4;

/// A relative change; nobody says 1e-7 %.
fn share(relative: f64, signed: bool) -> String {
    let text = if relative.abs() >= 1e-4 {
        signed_percent(relative)
    } else {
        let sign = if relative < 0.0 { "−" } else { "+" };
        format!("{sign}{}", with_minus(&format!("{:.0e}", relative.abs())))
    };
    if signed { text } else { text.trim_start_matches('+').to_owned() }
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
