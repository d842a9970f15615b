//! A place in a case file.

use miette::Severity;
use serde::Serialize;

use crate::case::Problem;

/// A place at which a case file is wrong, or probably is.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct FilePlace {
    /// The line, from 1.
    pub line: usize,
    /// The column in characters, from 1.
    pub column: usize,
    /// What is wrong, and what was expected or probably meant.
    pub message: String,
}

impl From<&Problem> for FilePlace {
    fn from(problem: &Problem) -> Self {
        let Problem { line, column, message, expected, help, severity, .. } = problem;
        let more = match severity {
            Severity::Error => Some(expected),
            Severity::Warning | Severity::Advice => help.as_ref(),
        };
        let more = more.map_or_else(String::new, |more| format!("; {more}"));
        Self { line: *line, column: *column, message: format!("{message}{more}") }
    }
}
