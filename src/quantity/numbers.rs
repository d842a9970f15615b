//! Numbers as a reader sees them: few digits, a unit, a true minus sign.

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

/// The number that `value` is with `digits` significant digits.
pub fn rounded_to(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits - 1).parse().unwrap_or(value)
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

/// The share that is left beside another one, rounded down, for what is promised: beside `0.0457` it is `95.4 %`.
pub fn rest(share: f64) -> String {
    let percent = 100.0 * share;
    // Two digits of what is not promised, and tenths at least.
    let decimals = (1.0 - libm::floor(libm::log10(percent))).clamp(1.0, 9.0);
    let scale = libm::pow(10.0, decimals);
    // What is exact but for rounding is not raised.
    let above = libm::ceil(percent * scale - 1e-6) / scale;
    format!("{} %", fixed(100.0 - above, decimals as usize))
}

/// Words with a capital letter first.
pub fn capitalised(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
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
        assert_eq!(
            [0.045_7, 0.312_3, 0.15, 0.001_497, 1.0].map(rest),
            ["95.4 %", "68.7 %", "85.0 %", "99.85 %", "0.0 %"]
        );
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
    }
}
