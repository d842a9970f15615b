//! What decides whether a design is taken: criteria, the best absorber, grids of designs, and two designs side by side.

use std::collections::BTreeMap;
use std::ops::Range;

use pyo3::prelude::*;
use pyo3::types::PyDict;
use vinesink::answer::several::{self, LeftOut};
use vinesink::answer::{Answer, Asked, Decided};
use vinesink::case::{ModalCase, Objective};
use vinesink::case_input::AnyCase;
use vinesink::case_optimum::Optimum;
use vinesink::case_report::Report;
use vinesink::diff::{Difference, Document, Reports, markdown};
use vinesink::executor::map;
use vinesink::modal::{ModalAnswer, ModalOptimum};
use vinesink::report::criteria::Checked;
use vinesink::report::modal;
use vinesink::report::render::Files;
use vinesink::sweep::columns::{Cell, Column, Storage};
use vinesink::sweep::work::points;
use vinesink::sweep::{ModalPlan, Plan};

use crate::errors::refused;
use crate::report::rendered;
use crate::work::{Columns, WorkState, json};

/// Points of a sweep that are worked out together.
const TOGETHER: u64 = 64;

/// What `vinesink check --format json` says of a case.
pub fn checked(
    case: &AnyCase,
    stem: &str,
    alone: bool,
    long: bool,
    work: &WorkState,
) -> PyResult<String> {
    let none = |advice| Err(refused(format!("the case has no criteria: give it {advice}")));
    let told = if alone { Decided::NOTHING } else { Decided::CHECKED };
    let checked = match case {
        AnyCase::One(case) if case.criteria.is_empty() => {
            return none("some, criteria={\"peak_displacement\": \"<= 4 mm\"}");
        }
        AnyCase::One(case) => {
            let asked = if alone { Asked::Criteria } else { Asked::Decision };
            let answer = Answer::of(case, asked, None, work).map_err(refused)?;
            let answer = answer.decided(case, told, work).map_err(refused)?;
            Checked::judged(stem, stem, case, &answer)
        }
        AnyCase::Several(case) if case.criteria.is_empty() => return none("a table [criteria]"),
        AnyCase::Several(case) => {
            let answer = of_several(case, told, long, work)?;
            answer.observe(work);
            modal::checked(stem, stem, case, &answer)
        }
    };
    json(&checked.document)
}

/// What is known of several modes or absorbers, with what is told beside the criteria: as far as that is ordinary work, or any is
/// asked for.
pub fn of_several(
    case: &ModalCase,
    told: Decided,
    long: bool,
    work: &WorkState,
) -> PyResult<ModalAnswer> {
    let affords = |_: LeftOut, _: f64, is_ordinary: bool| long || is_ordinary;
    let answer = ModalAnswer::of(case, work).map_err(refused)?;
    several::decided(case, answer, told, &affords, work).map_err(refused)
}

/// The objective of a name.
fn objective_of(name: &str) -> PyResult<Objective> {
    let known = Objective::ALL.into_iter().find(|one| one.name() == name);
    known.ok_or_else(|| {
        let all = Objective::ALL.map(Objective::name).join(", ");
        refused(format!("there is no objective \"{name}\"; there are {all}"))
    })
}

/// What `vinesink optimize --format json` says, the text of the case with the optimum, where there is one, and whether it is
/// better than the case's own and meets all criteria.
pub fn optimum(
    case: &AnyCase,
    text: &str,
    objective: Option<&str>,
    work: &WorkState,
) -> PyResult<(String, Option<String>, bool)> {
    let objective = objective.map(objective_of).transpose()?;
    match case {
        AnyCase::One(case) => {
            let found = Optimum::of("the case", case, text, objective, work).map_err(refused)?;
            let better = found.better.map(|better| better.text);
            Ok((json(&found.document)?, better, found.succeeds))
        }
        AnyCase::Several(_) if objective == Some(Objective::Z3Share) => Err(refused(
            "z3-share is an area of the theory of one mode and one absorber: ask for stable-share",
        )),
        AnyCase::Several(case) => {
            let found = ModalOptimum::of(case, text, objective, work).map_err(refused)?;
            let better = found.best.first().filter(|_| found.succeeds());
            let better = better.map(|best| best.text.clone());
            Ok((json(&modal::optimum(case, &found))?, better, found.succeeds()))
        }
    }
}

/// The columns of the sweep of a case, all points in order.
pub fn swept(case: &AnyCase, work: &WorkState) -> PyResult<Vec<Column>> {
    let none = || refused("the case has no table [sweep]");
    match case {
        AnyCase::One(case) => {
            let plan = Plan::of(case).ok_or_else(none)?;
            let line = match plan.settings.axes.last() {
                Some(axis) if plan.settings.follow => axis.values.len() as u64,
                _ => 1,
            };
            // Where motions are followed, along whole lines.
            let together = line * (TOGETHER / line).max(1);
            in_parts(plan.points(), together, work, |part| points(&plan, part).map_err(refused))
        }
        AnyCase::Several(case) => {
            let plan = ModalPlan::of(case).ok_or_else(none)?;
            in_parts(plan.grid.points(), 1, work, |part| Ok(plan.points(part)))
        }
    }
}

/// The columns of so many points, some together at a time.
fn in_parts(
    points: u64,
    together: u64,
    work: &WorkState,
    of: impl Fn(Range<u64>) -> PyResult<Vec<Column>> + Sync,
) -> PyResult<Vec<Column>> {
    let part = |k: u64| k * together..((k + 1) * together).min(points);
    work.goes_on();
    let count = points.div_ceil(together) as usize;
    let found = map(work, "points", count, |k| of(part(k as u64)));
    let mut all: Vec<Column> = Vec::new();
    for found in found {
        let found = found?;
        if all.is_empty() {
            all = found;
            continue;
        }
        all.iter_mut().zip(found).for_each(|(one, more)| one.cells.extend(more.cells));
    }
    Ok(all)
}

/// Columns as lists: numbers with NaN where a point has none, words with nothing; and their units.
pub fn lists<'py>(py: Python<'py>, columns: &[Column]) -> PyResult<(Columns<'py>, Columns<'py>)> {
    let [dict, units] = [PyDict::new(py), PyDict::new(py)];
    for Column { name, unit, storage, cells } in columns {
        units.set_item(name, unit)?;
        if *storage == Storage::Text {
            let words: Vec<&str> =
                cells.iter().map(|cell| cell.and_then(Cell::text).unwrap_or_default()).collect();
            dict.set_item(name, words)?;
        } else {
            let numbers: Vec<f64> =
                cells.iter().map(|cell| cell.and_then(Cell::number).unwrap_or(f64::NAN)).collect();
            dict.set_item(name, numbers)?;
        }
    }
    Ok((dict, units))
}

/// As what a case is called where two are compared.
const COMPARED: &str = "case";

/// What changed from one case to another, as `vinesink diff` says it of the files of their reports: the document, and Markdown.
pub fn compared(old: &AnyCase, new: &AnyCase, work: &WorkState) -> PyResult<(String, String)> {
    let side = |label: &str, case: &AnyCase| -> PyResult<Reports> {
        let (document, figures) = parts(&files(case, work)?);
        let document = Document::parse(label, &document, figures).map_err(refused)?;
        Ok(BTreeMap::from([(COMPARED.to_owned(), document)]))
    };
    let (old, new) = (side("old", old)?, side("new", new)?);
    let difference = Difference::of(("old", &old), ("new", &new));
    let told = markdown::markdown(&difference, markdown::Addresses::default()).map_err(refused)?;
    Ok((json(&difference)?, told))
}

/// The files of the report that a comparison reads: without what is asked of accuracy.
fn files(case: &AnyCase, work: &WorkState) -> PyResult<Files> {
    match case {
        AnyCase::One(case) => {
            let report = Report::of(COMPARED, case, None, Decided::ALL, work).map_err(refused)?;
            report.files(case, work).map_err(refused)
        }
        AnyCase::Several(_) => Ok(rendered(case, COMPARED, false, work)?.0),
    }
}

/// The document of a report, and its drawings by their names.
fn parts(files: &Files) -> (String, BTreeMap<String, Vec<u8>>) {
    let mut document = String::new();
    let mut figures = BTreeMap::new();
    for (path, content) in files {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        match path.extension().and_then(|of| of.to_str()) {
            Some("json") => document = String::from_utf8_lossy(content).into_owned(),
            Some("svg") => {
                figures.insert(stem, content.clone());
            }
            _ => {}
        }
    }
    (document, figures)
}
