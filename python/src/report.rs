//! The files of a report.

use std::path::Path;

use pyo3::prelude::*;
use vinesink::answer::Decided;
use vinesink::case_input::AnyCase;
use vinesink::case_report::Report;
use vinesink::modal::Beside;
use vinesink::report::modal;
use vinesink::report::render::{self, Files};
use vinesink::store;
use vinesink::study::fidelity::LayerPlan;

use crate::decide;
use crate::errors::{FileError, refused};
use crate::work::WorkState;

/// The files, and whether simulations are to be trusted and what was asked of accuracy holds.
pub fn rendered(
    case: &AnyCase,
    name: &str,
    long: bool,
    work: &WorkState,
) -> PyResult<(Files, bool)> {
    match case {
        AnyCase::One(case) => {
            let plan = LayerPlan::of_case(case, None).map_err(refused)?;
            let report = Report::of(name, case, plan.as_ref(), Decided::ALL, work);
            let report = report.map_err(refused)?;
            let holds = report.answer.trusted() && report.answer.exact_enough();
            Ok((report.files(case, work).map_err(refused)?, holds))
        }
        AnyCase::Several(case) => {
            let answer = decide::of_several(case, Decided::ALL, long, work)?;
            let beside = Beside::of(case, &answer, work).map_err(refused)?;
            Ok((modal::files(name, case, &answer, &beside).map_err(refused)?, true))
        }
    }
}

/// Writes them, in place of those of an older report.
pub fn write(folder: &Path, files: &Files) -> PyResult<()> {
    let written = store::replace_folder(folder, files, render::is_of_report);
    written.map_err(|error| FileError::new_err(error.to_string()))
}
