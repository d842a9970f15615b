//! A cell of the index: what it says, and where it goes when its column is sorted.

use serde::Serialize;

use super::super::numbers::MINUS;
use crate::case::{Dimension, Force, Frequency, Length, Mass, Quantity, Share};

/// What a cell without a value says.
pub const NOTHING: &str = "–";

/// A cell of a table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Cell {
    /// What it says.
    pub text: String,
    /// Its place in a sorted column; none for what cannot be compared, which comes last.
    pub order: Option<f64>,
}

impl Cell {
    /// A cell with a number and its unit as a report prints them, or without any.
    pub fn number(text: Option<&str>) -> Self {
        Self {
            text: text.unwrap_or(NOTHING).to_owned(),
            order: text.and_then(si_value).filter(|value| value.is_finite()),
        }
    }
}

/// The number that a printed value stands for, in SI units: `7.5 mm` is 0.0075 and `−5.0 dB` is −5.
/// Nothing for a length in a case's own unit, which cannot be compared with metres.
fn si_value(text: &str) -> Option<f64> {
    let plain = text.replace(MINUS, "-");
    // What follows in brackets says where the number is from.
    let plain = plain.split(" (").next().unwrap_or_default();
    let (number, unit) = plain.split_once(' ').unwrap_or((plain, ""));
    // A range, `8.0 to 8.7 Hz`, has its place by where it begins.
    if let Some((_, unit)) = unit.strip_prefix("to ").and_then(|to| to.split_once(' ')) {
        return si_value(&format!("{number} {unit}"));
    }
    match unit {
        "" | "dB" => number.parse().ok(),
        // An error follows: `0.61 ± 0.05`.
        _ if unit.starts_with('±') => number.parse().ok(),
        _ => si::<Length>(plain)
            .or_else(|| si::<Mass>(plain))
            .or_else(|| si::<Frequency>(plain))
            .or_else(|| si::<Force>(plain))
            .or_else(|| si::<Share>(plain)),
    }
}

fn si<D: Dimension>(text: &str) -> Option<f64> {
    Quantity::<D>::parse(text).ok().map(|quantity| quantity.si())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn printed_numbers_are_compared_in_si_units() {
        let order = |text| Cell::number(Some(text)).order;
        assert_eq!(order("7.5 mm"), Some(0.0075));
        assert_eq!(order("300 µm"), Some(0.0003));
        assert_eq!(order("8.5 Hz"), Some(8.5));
        assert_eq!(order("0.768 %"), Some(0.00768));
        assert_eq!(order("−5.0 dB"), Some(-5.0));
        assert_eq!(order("+0.8 dB"), Some(0.8));
        assert_eq!(order("1.2e−9 m"), Some(1.2e-9));
        assert_eq!(order("0.61 ± 0.05"), Some(0.61));
        assert_eq!(order("56.00"), Some(56.0));
        assert_eq!(order("3.72 mm (exact orbit)"), Some(0.00372));
        assert_eq!(order("8.0 to 8.7 Hz"), Some(8.0));
        assert_eq!(order("0.9 to 1.1 kHz"), Some(900.0));
        for incomparable in ["0.475 units", "Z3, strip A1", "infinite", "undefined", ""] {
            assert_eq!(order(incomparable), None, "{incomparable}");
        }
        assert_eq!(Cell::number(None), Cell { text: "–".into(), order: None });
    }
}
