//! What commands do with a case of several modes or absorbers.

use std::path::Path;

use miette::{IntoDiagnostic, Result, miette};
use vinesink::answer::Decided;
use vinesink::answer::several::{self, LeftOut};
use vinesink::case::{ModalCase, Objective};
use vinesink::modal::{
    Beside, ModalAnswer, ModalOptimum, checks, orbits, seconds, seconds_of_flight, usual_periods,
};
use vinesink::program::case_file::name;
use vinesink::program::parallel::Parallel;
use vinesink::program::reports;
use vinesink::report::modal::{
    analysis, analysis_text, files, optimum, optimum_files, optimum_text, simulation, text,
};
use vinesink::report::render::Files;

use super::budget::Long;
use super::impacts;
use super::one_case::OneCase;

/// Refuses options that nothing reads for such a case, by their names where they were given.
pub fn without(path: &Path, given: &[(&str, bool)]) -> Result<()> {
    match given.iter().find(|(_, given)| *given) {
        None => Ok(()),
        Some((option, _)) => Err(miette!(
            help = format!("leave out {option}"),
            "{}: {option} has no meaning for several modes or absorbers",
            path.display()
        )),
    }
}

/// What is known of it, unless that takes too long.
pub fn answered(path: &Path, case: &ModalCase, long: Long) -> Result<ModalAnswer> {
    long.allows_seconds(path, seconds(case), "motions at each frequency of each load")?;
    ModalAnswer::of(case, &Parallel).into_diagnostic()
}

/// The same with what `told` says beside the criteria: how far numbers may change, and with which probability all hold where some are
/// uncertain; each where that is not too long.
pub fn decided(
    path: &Path,
    case: &ModalCase,
    answer: ModalAnswer,
    told: Decided,
    long: Long,
) -> Result<ModalAnswer> {
    let affords = |what: LeftOut, seconds: f64, is_ordinary: bool| {
        long.affords_beside(path, what, seconds, is_ordinary)
    };
    several::decided(case, answer, told, &affords, &Parallel).into_diagnostic()
}

/// The files of its report.
pub fn report(
    path: &Path,
    name: &str,
    case: &ModalCase,
    told: Decided,
    long: Long,
) -> Result<Files> {
    let answer = answered(path, case, long)?;
    let answer = decided(path, case, answer, told, long)?;
    let mut beside = Beside::of(case, &answer, &Parallel).into_diagnostic()?;
    if !told.alternatives {
        beside.dampers.clear();
    }
    files(name, case, &answer, &beside).into_diagnostic()
}

/// Prints what it does under its loads, and writes the impacts of the worst motion under each over so many excitation periods where a file
/// is named for them.
pub fn simulate(
    one: &OneCase,
    case: &ModalCase,
    impacts: Option<&Path>,
    periods: Option<u64>,
) -> Result<bool> {
    let periods = periods.unwrap_or_else(|| usual_periods(case));
    if impacts.is_some() {
        let flown = seconds_of_flight(case, periods as f64 * case.loads.len() as f64);
        let what = format!("{periods} excitation periods of a motion under each load");
        one.long.allows_seconds(&one.path, flown, &what)?;
    }
    let answer = answered(&one.path, case, one.long)?;
    answer.observe(&Parallel);
    if let Some(file) = impacts {
        let found = answer.impacts(case, periods).into_diagnostic()?;
        impacts::write_of_loads(file, case, &found)?;
    }
    let stem = name(&one.path)?;
    one.print(|| text(&stem, case, &answer), || simulation(&stem, case, &answer))?;
    Ok(true)
}

/// Prints its exact orbits under each load.
pub fn analyze(one: &OneCase, case: &ModalCase) -> Result<bool> {
    let found = orbits(case, &Parallel).into_diagnostic()?;
    one.print(|| analysis_text(case, &found), || analysis(case, &found))?;
    Ok(true)
}

/// Prints better absorbers, by this objective in place of the case's own; the text of the case with them, where there are any: of those
/// that are best on average where that is asked for. Its page goes into a folder of reports where one is named.
pub fn optimize(
    one: &OneCase,
    case: &ModalCase,
    text: &str,
    (objective, robust): (Option<Objective>, bool),
    out: Option<&Path>,
) -> Result<Option<String>> {
    let seconds = seconds(case) * checks(case);
    one.long.allows_seconds(&one.path, seconds, "candidates under each load")?;
    let found = ModalOptimum::of(case, text, objective, &Parallel).into_diagnostic()?;
    let document = optimum(case, &found);
    if let Some(out) = out {
        let files = optimum_files(case, &found, &document).into_diagnostic()?;
        reports::add_to_report(out, &one.path, &files)?;
    }
    one.print(|| optimum_text(case, &document), || &document)?;
    let best = found.best.first().filter(|_| found.succeeds());
    let of_robust = found
        .robust
        .as_ref()
        .map(|one| &one.design)
        .filter(|one| robust && one.is_feasible() && one.case.absorbers != case.absorbers);
    Ok(of_robust.or(best).map(|best| best.text.clone()))
}
