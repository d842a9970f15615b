//! Files of the PEER ground motion database (AT2, DT2).

use super::error::Problem;
use super::number_table::pure;
use super::quantity::{number_in, unit_in_brackets};
use super::record::{dimension, problem};
use super::record_file::{Found, ROUNDING, Wanted};

/// A file of the PEER ground motion database: a head with the number of samples and their step, then values line by line;
/// none where it is another one.
pub(super) fn peer(text: &str, wanted: &Wanted) -> Option<Result<Found, Vec<Problem>>> {
    const LINES: usize = 8;
    let lines: Vec<&str> = text.lines().collect();
    let last = lines.iter().take(LINES).position(|line| {
        let upper = line.to_uppercase();
        upper.contains("NPTS") && upper.contains("DT")
    })?;
    let head = lines[last].to_uppercase();
    let refused = |at: &str, message: String, help: &str| {
        Some(Err(vec![*problem(text, at, message, "expected a PEER file", help)]))
    };
    let number = |token: &str| number_in(token.trim_matches([',', ';']), pure());
    let tokens = head.replace('=', " ");
    let tokens: Vec<&str> = tokens.split_whitespace().collect();
    let behind = |word: &str| {
        let at = tokens.iter().position(|token| token.trim_matches(',') == word)?;
        number(tokens.get(at + 1)?)
    };
    let plain: Vec<f64> = tokens.iter().filter_map(|token| number(token)).collect();
    let (count, step) = match (behind("NPTS"), behind("DT")) {
        (Some(count), Some(step)) => (count, step),
        // The older head: 4000 0.01 NPTS, DT.
        _ => (plain.first().copied()?, plain.get(1).copied()?),
    };
    if !wanted.physical {
        return refused(
            lines[last],
            "a PEER file has units, and [reduced] has none".into(),
            "write the case in physical units",
        );
    }
    let named = lines[..last].iter().rev().find_map(|line| {
        let at = line.to_uppercase().find("UNITS OF")?;
        line.get(at + "UNITS OF".len()..).map(str::trim)
    });
    let of = dimension(wanted.quantity);
    let symbol = named
        .unwrap_or_default()
        .to_lowercase()
        .replace("sec", "s")
        .replace("/s/s", "/s2")
        .replace("**", "^");
    let unit = match (unit_in_brackets(of, &format!("({symbol})")), wanted.format.unit) {
        (Ok(unit), None) => unit,
        (Ok(unit), Some(given)) if unit == given => unit,
        (Ok(unit), Some(given)) => {
            let message = format!(
                "the values are in {} by the head, and in {} by the case",
                unit.symbol, given.symbol
            );
            return refused(named.unwrap_or(lines[last]), message, "remove `unit`");
        }
        (Err(_), Some(given)) if named.is_none() => given,
        (Err((message, accepted)), _) => {
            let place = named.unwrap_or(lines[last]);
            return refused(place, format!("the value of the record {message}"), &accepted);
        }
    };
    if step.is_nan()
        || step <= 0.0
        || wanted.format.rate.is_some_and(|rate| (rate * step - 1.0).abs() > ROUNDING)
    {
        let message = format!("the step of the samples is {step} s by the head");
        return refused(lines[last], message, "remove `rate`, or give that of the file");
    }
    let mut samples = Vec::new();
    for line in &lines[last + 1..] {
        for token in line.split_whitespace() {
            let Some(value) = number_in(token, unit) else {
                return refused(
                    token,
                    format!("\"{token}\" is no number"),
                    "below the head a PEER file has numbers alone",
                );
            };
            if value.abs() > wanted.most {
                return refused(
                    token,
                    "a value of the record is too large for the case".into(),
                    "check the units of the case",
                );
            }
            samples.push([samples.len() as f64 * step, value]);
        }
    }
    if samples.len() < 2 || samples.len() as f64 != count {
        let message = format!("the head says {count} samples, and {} follow", samples.len());
        return refused(
            lines[last],
            message,
            "fetch the file again: it was cut, or the head changed",
        );
    }
    Some(Ok(Found { samples, unit }))
}
