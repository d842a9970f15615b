//! What both pages say of a request: the answer as JSON, or what is wrong with it.

use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use vinesink::case::{CaseError, Problem};

/// The answer to a request; `{"problems": [...]}` where there is none.
pub fn answered<R: DeserializeOwned>(
    request: &[u8],
    answer: fn(R) -> Result<Value, Value>,
) -> Vec<u8> {
    let answer = serde_json::from_slice(request).map_err(words).and_then(answer);
    let answer = answer.unwrap_or_else(|problems| json!({ "problems": problems }));
    answer.to_string().into_bytes()
}

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
