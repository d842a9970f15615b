//! From text to TOML, with syntax errors turned into the same problems as any other error.

use toml::Spanned;
use toml::de::DeTable;

use super::error::Problem;
use crate::quantity::Dimension;

/// Parses TOML; on syntax errors, the first one, and those further down for which there is a remedy: what else the parser
/// finds behind an error is often the same one again.
pub(super) fn parse(text: &str) -> Result<DeTable<'_>, Vec<Problem>> {
    let (document, mut errors) = DeTable::parse_recoverable(text);
    if errors.is_empty() {
        return Ok(Spanned::into_inner(document));
    }
    errors.sort_by_key(start);
    errors.truncate(MOST_ERRORS);
    let mut problems: Vec<Problem> = errors.iter().map(|error| problem(text, error)).collect();
    problems.dedup_by_key(|problem| problem.line);
    let mut first = true;
    problems.retain(|problem| std::mem::take(&mut first) || problem.help.as_deref() != Some(LINES));
    Err(problems)
}

/// Errors that are looked at.
const MOST_ERRORS: usize = 100;
/// What a file is made of.
const LINES: &str = "a line is `key = value`, a [table] or a # comment; text stands in \"quotes\"";

fn start(error: &toml::de::Error) -> usize {
    error.span().map_or(0, |span| span.start)
}

fn problem(text: &str, error: &toml::de::Error) -> Problem {
    let span = error.span().unwrap_or(0..0);
    let (what, expected) = match error.message().split_once(", expected ") {
        Some((what, expected)) => (what, format!("expected {expected}")),
        None => (error.message(), "expected something else here".to_owned()),
    };
    let message = format!("the file is not valid TOML: {what}");
    let problem = Problem::new(text, span, message, expected);
    let line = line_around(text, problem.span.start);
    if what.contains("duplicate") {
        let expected =
            "expected each key and table once, but this one stands above already".to_owned();
        return Problem { expected, ..problem }.help("keep one of the two");
    }
    if let Some(quoted) = unquoted_quantity(line) {
        let expected = "expected a value with a unit to be in quotes".to_owned();
        return Problem { expected, ..problem }.help(format!("write {quoted}"));
    }
    problem.help(LINES)
}

fn line_around(text: &str, at: usize) -> &str {
    let start = text[..at].rfind('\n').map_or(0, |newline| newline + 1);
    text[start..].lines().next().unwrap_or_default()
}

/// `clearance = 7.5 mm` as it should have been written.
fn unquoted_quantity(line: &str) -> Option<String> {
    let (key, rest) = line.split_once('=')?;
    let value = rest.split('#').next()?.trim();
    Dimension::of(value)?;
    Some(format!("{} = \"{value}\"", key.trim()))
}
