//! Exceptions of the package, which `package/vinesink/_errors.py` defines, and what the program says of a case's text.

use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, NamedSource, Report};
use pyo3::import_exception;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use vinesink::case::{self, Problem};
use vinesink::case_input::CaseInputError;

import_exception!(vinesink._errors, CaseError);
import_exception!(vinesink._errors, FileError);
import_exception!(vinesink._errors, InternalError);
import_exception!(vinesink._errors, RefusedError);

/// Width of messages, as the program writes them where no terminal tells another.
const WIDTH: usize = 80;

/// An error of the library as Python's `ValueError`, with its own message.
pub fn refused(error: impl std::fmt::Display) -> PyErr {
    RefusedError::new_err(error.to_string())
}

/// Warnings of a case as the program says them of its text.
pub fn warned(name: &str, text: &str, warnings: &[Problem]) -> Vec<String> {
    let visible = text.strip_prefix('\u{feff}').unwrap_or(text);
    let source = || NamedSource::new(name, visible.to_owned());
    let shown = |one: &Problem| shown(&*Report::new(one.clone()).with_source_code(source()));
    warnings.iter().map(shown).collect()
}

/// A problem as the program shows it, with the text underlined.
fn shown(problem: &dyn Diagnostic) -> String {
    let mut text = String::new();
    let handler = GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor());
    let handler = handler.with_width(WIDTH);
    // Writing into a text does not fail.
    let _ = handler.render_report(&mut text, problem);
    text
}

/// With the program's message, and each problem as a dict in `problems`.
pub fn not_read(py: Python<'_>, error: &CaseInputError) -> PyErr {
    match error {
        CaseInputError::Case(error) => case_error(py, error),
        CaseInputError::Named { source, .. } => FileError::new_err(source.to_string()),
        other => FileError::new_err(other.to_string()),
    }
}

fn case_error(py: Python<'_>, error: &case::CaseError) -> PyErr {
    let raised = CaseError::new_err(shown(error));
    let each = error.problems().map(|problem| {
        let dict = PyDict::new(py);
        dict.set_item("line", problem.line)?;
        dict.set_item("column", problem.column)?;
        dict.set_item("underlined", &problem.underlined)?;
        dict.set_item("message", &problem.message)?;
        dict.set_item("expected", &problem.expected)?;
        dict.set_item("help", &problem.help)?;
        Ok(dict)
    });
    let all: PyResult<Vec<_>> = each.collect();
    match all.and_then(|all| raised.value(py).setattr("problems", all)) {
        Ok(()) => raised,
        Err(other) => other,
    }
}
