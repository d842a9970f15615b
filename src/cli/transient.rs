//! Commands on a structure that is not driven steadily: released or struck, swept, or driven by a record.

use std::path::Path;

use miette::{IntoDiagnostic, Result, miette};
use vinesink::case::{Case, Rounding};
use vinesink::criteria::{self, Judged};
use vinesink::excitation::Scene;
use vinesink::program::parallel::Parallel;
use vinesink::program::{case_file, output};
use vinesink::report::render::Files;
use vinesink::report::transient as page;
use vinesink::simulation::Impact;
use vinesink::store;
use vinesink::system::State;
use vinesink::transient::{DecayStudy, Flight, Study, best_clearance};

use super::budget::{Long, Work};
use super::one_case::{Format, OneCase};

/// Refuses a case that is not driven steadily where a command is about steady vibration.
pub fn steady(case: &Case, path: &Path, what: &str) -> Result<()> {
    match case.design.scene() {
        Scene::Steady => Ok(()),
        other => Err(miette!(
            help = "name a case whose excitation is base-displacement or force",
            "{}: its structure is {}, and {what} is about one that is driven steadily",
            path.display(),
            other.words()
        )),
    }
}

/// Refuses options that are about steady vibration for a case that is not, by their names where they were given.
pub fn without(case: &Case, path: &Path, given: &[(&str, bool)]) -> Result<()> {
    let option = given.iter().find(|(_, given)| *given);
    match (case.design.scene(), option) {
        (Scene::Steady, _) | (_, None) => Ok(()),
        (other, Some((option, _))) => Err(miette!(
            help = format!("leave out {option}: the case itself says what becomes of it"),
            "{}: {option} has no meaning for a structure that is {}",
            path.display(),
            other.words()
        )),
    }
}

/// The study of a case that is not driven steadily, unless it would take far too long; none for another.
fn studied(case: &Case, path: &Path, long: Long) -> Result<Option<Study>> {
    long.allows(path, case, &Vec::from_iter(Work::transient(case)))?;
    Study::of_case(case, &Parallel).transpose().into_diagnostic()
}

fn printed(one: &OneCase, case: &Case, study: &Study) -> Result<bool> {
    let document = page::document(&case_file::name(&one.path)?, case, study, &[]);
    one.print(|| page::text(case, study, &document), || &document)?;
    Ok(true)
}

/// What theory says of a release; none for another case.
pub fn analyze(one: &OneCase, case: &Case) -> Result<Option<bool>> {
    let study = DecayStudy::by_theory(case);
    study.map(|study| printed(one, case, &Study::Release(Box::new(study)))).transpose()
}

/// What simulation says.
pub fn simulate(one: &OneCase, case: &Case) -> Result<Option<bool>> {
    studied(case, &one.path, one.long)?.map(|study| printed(one, case, &study)).transpose()
}

/// Its criteria.
pub fn judged(case: &Case, path: &Path, long: Long) -> Result<Option<Vec<Judged>>> {
    Ok(studied(case, path, long)?.map(|study| criteria::judge_transient(case, &study)))
}

/// Its report.
pub fn report(case: &Case, path: &Path, name: &str, long: Long) -> Result<Option<Files>> {
    let Some(study) = studied(case, path, long)? else { return Ok(None) };
    let judged = criteria::judge_transient(case, &study);
    page::files(name, case, &study, &judged).into_diagnostic().map(Some)
}

/// One flight, from a chosen start or from that of the worst place, under the first record; `told` hears of its impacts.
/// False for a case that is driven steadily.
pub fn flight(
    one: &OneCase,
    case: &Case,
    start: Option<State>,
    periods: Option<u64>,
    told: &mut dyn FnMut(&Impact),
) -> Result<bool> {
    let start = match start {
        Some(start) => start,
        None => {
            let Some(study) = studied(case, &one.path, one.long)? else { return Ok(false) };
            let start = Flight::worst_start(case, &study);
            start.ok_or_else(|| miette!("no start was flown; ask for more than 0 starts"))?
        }
    };
    let Some(flight) = Flight::of_case(case, start, periods, told) else { return Ok(false) };
    let document = page::flight(case, &flight.into_diagnostic()?);
    one.print(|| page::flight_text(case, &document), || &document)?;
    Ok(true)
}

/// The clearance that serves it best, written into a new file where that is asked for.
pub fn optimize(
    one: &OneCase,
    case: &Case,
    text: &str,
    new: Option<&Path>,
) -> Result<Option<bool>> {
    one.long.allows(&one.path, case, &Work::clearances(case))?;
    let Some(best) = best_clearance(case, &Parallel) else { return Ok(None) };
    let name = one.path.display().to_string();
    // A larger one might leave the absorber of a released structure where no wall reaches it; and in a sweep, or under a
    // record, the absorber is lost above the best, where the displacement rises to that of the structure alone.
    let written = case.rewritten(&name, text, &best.design, Rounding::Down).into_diagnostic()?;
    let Some(study) = studied(&written.case, &one.path, one.long)? else { return Ok(None) };
    let judged = criteria::judge_transient(&written.case, &study);
    let name = case_file::name(&one.path)?;
    let judgement = page::document(&name, &written.case, &study, &judged);
    let document = page::optimum(case, &best, &judgement);
    one.print(|| page::optimum_text(case, &document), || &document)?;
    let found = document["answer"] == "found";
    if let Some(new) = new.filter(|_| found) {
        store::write_new(new, written.text.as_bytes())?;
        let line = format!("written: {}", new.display());
        match one.format {
            Format::Text => output::print(format!("{line}\n"))?,
            Format::Json => output::complain(&line),
        }
    }
    Ok(Some(found && criteria::all_hold(&judged)))
}
