//! Numbers as a reader sees them: few digits, a unit, a true minus sign.

use crate::case::{LengthUnit, Scales};

/// The sign that a minus is in text.
pub const MINUS: char = '\u{2212}';

/// `value` with `digits` significant digits in plain notation, or in powers of ten where plain
/// notation would need more than six digits before or four zeros after the point.
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".into();
    }
    if value.is_nan() {
        return "undefined".into();
    }
    if value.is_infinite() {
        return with_minus(if value > 0.0 { "infinite" } else { "-infinite" });
    }
    let scientific = format!("{:.*e}", digits - 1, value);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if !(-4..6).contains(&exponent) {
        return with_minus(&format!("{mantissa}e{exponent}"));
    }
    let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
    with_minus(&format!("{value:.decimals$}"))
}

/// A number inside a formula: `digits` significant digits or all that it has, with powers of ten from 1e4 on
/// and below 1e-3, and a hyphen for a minus.
pub fn tex(value: f64, digits: Option<u8>) -> String {
    let digits = digits.map_or(usize::MAX, usize::from);
    let text = match digits {
        usize::MAX => format!("{value:e}"),
        digits => format!("{value:.*e}", digits - 1),
    };
    match text.split_once('e') {
        Some((mantissa, exponent)) if !(1e-3..1e4).contains(&value.abs()) && value != 0.0 => {
            let factor =
                if mantissa == "1" { String::new() } else { format!("{mantissa} \\cdot ") };
            format!("{factor}10^{{{exponent}}}")
        }
        _ if digits == usize::MAX => value.to_string(),
        _ => significant(value, digits).replace(MINUS, "-"),
    }
}

/// `value` with a fixed number of decimals; a rounded zero has no sign.
pub fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let zero = text.trim_start_matches('-').chars().all(|c| c == '0' || c == '.');
    with_minus(if zero { text.trim_start_matches('-') } else { &text })
}

/// `value` as `fixed`, with its sign always shown.
pub fn signed(value: f64, decimals: usize) -> String {
    let text = fixed(value, decimals);
    if text.starts_with(MINUS) || value == 0.0 { text } else { format!("+{text}") }
}

/// A value with its error, to the decimals that the error leaves: `0.68 ± 0.10`, `−0.0713 ± 0.0008`.
/// An error that begins with 1 has two digits, since one digit would be off by up to a half.
pub fn with_error(value: f64, error: f64) -> String {
    if !(1e-6..1.0).contains(&error) {
        return format!("{} ± {}", significant(value, 3), significant(error, 2));
    }
    let place = (-libm::log10(error).floor()) as usize;
    let decimals = place + usize::from(error < 1.95 * libm::pow(10.0, -(place as f64)));
    format!("{} ± {}", fixed(value, decimals), fixed(error, decimals))
}

/// What follows an average of a motion that does not repeat: ` ± 3 %`; nothing where the error is lost in
/// its digits or has no meaning.
pub fn known_to(relative: f64) -> String {
    let told = (0.0005..1.0).contains(&relative);
    if told { format!(" ± {}", percent(relative)) } else { String::new() }
}

/// A share as a percentage: `0.256` is `26 %`.
pub fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    let decimals = match percent.abs() {
        0.0 => 0,
        p if p < 0.005 => return "< 0.01 %".into(),
        p if p < 0.095 => 2,
        p if p < 9.95 => 1,
        _ => 0,
    };
    format!("{} %", fixed(percent, decimals))
}

/// A share with a decimal, where `percent` has none: limits are often whole percents.
pub fn percent_sharply(share: f64) -> String {
    if share == 0.0 || share == 1.0 || share.abs() < 0.01 {
        percent(share)
    } else {
        format!("{} %", fixed(100.0 * share, 1))
    }
}

/// A relative difference as a percentage with its sign.
pub fn signed_percent(difference: f64) -> String {
    let sign = if difference < 0.0 { MINUS } else { '+' };
    format!("{sign}{}", percent(difference.abs()))
}

/// Words with a capital letter first.
pub fn capitalised(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// `20 log10(ratio)` in decibels, with its sign.
pub fn decibels(ratio: f64) -> String {
    format!("{} dB", signed(20.0 * libm::log10(ratio), 1))
}

/// Text with its leading hyphen replaced by a minus sign, in mantissa and exponent.
pub fn with_minus(text: &str) -> String {
    text.replace('-', &MINUS.to_string())
}

/// A relative error in per cent or powers of ten; one that is only `below` the value says so.
pub fn relative_error(value: f64, below: bool) -> String {
    // Nobody says 1e-7 %.
    const FINE: f64 = 1e-4;
    let size = if value < FINE { significant(value, 1) } else { percent(value) };
    if below { format!("below {size}") } else { size }
}

/// A count of operations with two digits, in powers of ten from a thousand on.
pub fn operations(count: u64) -> String {
    let scientific = format!("{:.1e}", count as f64);
    if count < 1000 { count.to_string() } else { with_minus(&scientific) }
}

/// A share as people ask for it: "1 %", not "1.0 %".
pub fn asked(share: f64) -> String {
    // Below what a percentage says with two decimals.
    if share < 5e-5 {
        return significant(share, 1);
    }
    percent(share).replace(".0 %", " %")
}

/// Lengths of one case, all in the same unit: the prefix that suits its clearance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LengthFormat {
    /// Case units (metres, or the case's own) in one displayed unit.
    per_unit: f64,
    /// The displayed unit.
    pub unit: &'static str,
}

impl LengthFormat {
    /// The format for a case.
    pub fn of(scales: &Scales) -> Self {
        if scales.length_unit() == LengthUnit::Own {
            return Self { per_unit: 1.0, unit: "units" };
        }
        Self::fitting(scales.length(1.0))
    }

    /// The prefix that suits a length in metres.
    pub fn fitting(length: f64) -> Self {
        let prefixes = [(1e3, "km"), (1.0, "m"), (1e-3, "mm"), (1e-6, "µm"), (1e-9, "nm")];
        // 0.1 mm still reads better than 100 µm, and 300 mm better than 0.3 m.
        let fitting = prefixes
            .into_iter()
            .find(|(size, _)| length >= 0.1 * size && *size != 1.0 || length >= *size);
        let (per_unit, unit) = fitting.unwrap_or((1e-9, "nm"));
        Self { per_unit, unit }
    }

    /// A length in case units as a number of displayed units.
    pub fn number(&self, length: f64) -> f64 {
        length / self.per_unit
    }

    /// A length with three significant digits and its unit.
    pub fn text(&self, length: f64) -> String {
        self.with_digits(length, 3)
    }

    /// A length with the given number of significant digits and its unit.
    pub fn with_digits(&self, length: f64, digits: usize) -> String {
        // A motion far larger than the clearance has a prefix of its own.
        let far = self.unit != "units" && self.number(length).abs() >= 1000.0;
        let format = if far { Self::fitting(length.abs()) } else { *self };
        let number = significant(format.number(length), digits);
        format!("{number} {}", format.unit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_deserve_their_place() {
        assert_eq!(significant(3.561_9, 3), "3.56");
        assert_eq!(significant(0.000_123_4, 3), "0.000123");
        assert_eq!(significant(-1_234.5, 3), "−1234");
        assert_eq!(significant(9.999, 3), "10.0");
        assert_eq!(significant(1.2e-9, 2), "1.2e−9");
        assert_eq!(significant(0.0, 3), "0");
        assert_eq!(fixed(-0.04, 1), "0.0");
        assert_eq!(signed(1.45, 1), "+1.4");
    }

    #[test]
    fn an_error_says_how_many_decimals_a_value_has() {
        assert_eq!(with_error(0.6834, 0.1021), "0.68 ± 0.10");
        assert_eq!(with_error(-0.071_31, 0.000_81), "−0.0713 ± 0.0008");
        assert_eq!(with_error(0.356, 0.0302), "0.36 ± 0.03");
        assert_eq!(with_error(12.3, 0.194), "12.30 ± 0.19");
        assert_eq!(with_error(0.5, 0.0), "0.500 ± 0");
    }

    #[test]
    fn percentages_and_decibels_read_as_people_say_them() {
        assert_eq!(percent(0.256), "26 %");
        assert_eq!(percent(0.0512), "5.1 %");
        assert_eq!(percent(0.00012), "0.01 %");
        assert_eq!(percent(3e-16), "< 0.01 %");
        assert_eq!(percent(0.0), "0 %");
        let sharply = [0.728_21, 0.9, 1.0, 0.0, 0.0034].map(percent_sharply);
        assert_eq!(sharply, ["72.8 %", "90.0 %", "100 %", "0 %", "0.3 %"]);
        assert_eq!(decibels(3.587 / 6.395), "−5.0 dB");
    }
}
