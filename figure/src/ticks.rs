//! Round ticks with as few digits as tell them apart.

use super::data::{AxisScale, Tick};

/// The smallest of 1, 2, 5 times a power of ten that divides a span into at most `most` parts.
pub(super) fn round_step(span: f64, most: f64) -> f64 {
    let raw = span / most.max(1.0);
    let power = libm::pow(10.0, libm::floor(libm::log10(raw)));
    let tolerance = 1.0 - 1e-9;
    [1.0, 2.0, 5.0]
        .map(|m| m * power)
        .into_iter()
        .find(|s| *s >= raw * tolerance)
        .unwrap_or(10.0 * power)
}

/// Ticks for a range, at most about `most` of them with words.
pub(super) fn ticks(scale: AxisScale, first: f64, last: f64, most: f64) -> Vec<Tick> {
    match scale {
        AxisScale::Linear => linear(first, last, most),
        AxisScale::Log => {
            let decades = libm::log10(last / first);
            if decades < 0.8 { linear(first, last, most) } else { decadic(first, last, most) }
        }
    }
}

fn linear(first: f64, last: f64, most: f64) -> Vec<Tick> {
    let step = round_step(last - first, most);
    let from = libm::ceil(first / step - 1e-9);
    let to = libm::floor(last / step + 1e-9);
    let count = (to - from).clamp(0.0, 100.0) as usize;
    let values: Vec<f64> = (0..=count).map(|i| (from + i as f64) * step).collect();
    let labels = labels(&values, step).into_iter().map(Some);
    values.into_iter().zip(labels).map(|(value, label)| Tick { value, label }).collect()
}

fn decadic(first: f64, last: f64, most: f64) -> Vec<Tick> {
    let from = libm::floor(libm::log10(first) + 1e-9) as i32;
    let to = libm::floor(libm::log10(last) + 1e-9) as i32;
    let whole = (libm::ceil(libm::log10(first) - 1e-9) as i32..=to).count();
    let every = (whole as f64 / most).ceil().max(1.0) as i32;
    let named: &[u32] = match whole {
        0..=1 if most >= 4.0 => &[1, 2, 5],
        2 if most >= 8.0 => &[1, 2, 5],
        _ => &[1],
    };
    let digits = from >= -3 && to <= 4;
    let tick = |(exponent, digit): (i32, u32)| {
        let value = f64::from(digit) * libm::pow(10.0, f64::from(exponent));
        let inside = value >= first * (1.0 - 1e-9) && value <= last * (1.0 + 1e-9);
        let words = named.contains(&digit) && exponent.rem_euclid(every) == 0;
        let minor = digit == 1 || (every == 1 && to - from <= 6);
        let label = words.then(|| power(digit, exponent, digits));
        (inside && (words || minor)).then_some(Tick { value, label })
    };
    let all = (from..=to).flat_map(|exponent| (1..=9).map(move |digit| (exponent, digit)));
    all.filter_map(tick).collect()
}

/// A digit times a power of ten, in plain digits where all of an axis are short.
fn power(digit: u32, exponent: i32, digits: bool) -> String {
    match exponent {
        0.. if digits => format!("{digit}{}", "0".repeat(exponent as usize)),
        _ if digits => format!("0.{}{digit}", "0".repeat((-exponent - 1) as usize)),
        _ if digit == 1 => format!("10{}", raised(exponent)),
        _ => format!("{digit}×10{}", raised(exponent)),
    }
}

/// The words for values that are multiples of a step: same number of decimals for all, as few as
/// tell them apart; powers of ten where plain digits would be many.
fn labels(values: &[f64], step: f64) -> Vec<String> {
    let largest = values.iter().fold(step, |m, v| m.max(v.abs()));
    if !(1e-3..1e5).contains(&largest) {
        let exponent = libm::floor(libm::log10(largest) + 1e-12) as i32;
        let unit = libm::pow(10.0, f64::from(exponent));
        let places = decimals(step / unit);
        let word = |v: &f64| match plain(v / unit, places) {
            zero if zero.chars().all(|c| "0.".contains(c)) => "0".to_owned(),
            mantissa => format!("{mantissa}×10{}", raised(exponent)),
        };
        return values.iter().map(word).collect();
    }
    values.iter().map(|v| plain(*v, decimals(step))).collect()
}

/// How many decimals a step needs.
fn decimals(step: f64) -> usize {
    let whole = |places: &usize| {
        let scaled = step * libm::pow(10.0, *places as f64);
        (scaled - scaled.round()).abs() < 1e-6 * scaled.max(1e-300)
    };
    (0..15).find(whole).unwrap_or(15)
}

/// A number with a true minus sign, and no minus before zero.
fn plain(value: f64, places: usize) -> String {
    let digits = format!("{:.places$}", value.abs());
    if value < 0.0 && digits.chars().any(|c| ('1'..='9').contains(&c)) {
        format!("\u{2212}{digits}")
    } else {
        digits
    }
}

/// An exponent, raised.
fn raised(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raise = |c: char| c.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize]);
    exponent.to_string().chars().map(raise).collect()
}
