//! What is wrong with a request or its case.

use serde_json::{Value, json};
use vinesink::case::{CaseError, Problem};

/// What is wrong in other words than a case file's.
pub fn words(error: impl std::fmt::Display) -> Value {
    json!([{ "message": error.to_string() }])
}

/// What is wrong with a case file, and where.
pub fn problems(error: &CaseError) -> Value {
    let one = |problem: &Problem| {
        json!({
            "message": problem.message, "expected": problem.expected, "help": problem.help,
            "line": problem.line, "column": problem.column,
        })
    };
    error.problems().map(one).collect()
}
