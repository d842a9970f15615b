//! Commands on a structure that is swept through resonance.

use std::path::Path;

use miette::{IntoDiagnostic, Result};
use vinesink::case::Case;
use vinesink::criteria::{self, Judged};
use vinesink::report::render::Files;
use vinesink::report::sine_sweep as page;
use vinesink::transient::SweepStudy;

use super::budget::Work;
use super::case_file::{self, OneCase};
use super::parallel::Parallel;

/// The study of a case that is swept, unless it would take far too long; none for another.
fn studied(case: &Case, path: &Path, long: super::budget::Long) -> Result<Option<SweepStudy>> {
    if let Some(sweep) = case.design.sine_sweep() {
        long.allows(path, case, &[Work::passages(case, &sweep)])?;
    }
    SweepStudy::of_case(case, &Parallel).transpose().into_diagnostic()
}

/// What simulation says.
pub fn simulate(one: &OneCase, case: &Case) -> Result<Option<bool>> {
    let Some(study) = studied(case, &one.path, one.long)? else { return Ok(None) };
    let document = page::document(&case_file::name(&one.path)?, case, &study, &[]);
    one.print(|| page::text(case, &document), || &document)?;
    Ok(Some(true))
}

/// Its criteria.
pub fn judged(case: &Case, path: &Path, long: super::budget::Long) -> Result<Option<Vec<Judged>>> {
    Ok(studied(case, path, long)?.map(|study| criteria::judge_sweep(case, &study)))
}

/// Its report.
pub fn report(
    case: &Case,
    path: &Path,
    name: &str,
    long: super::budget::Long,
) -> Result<Option<Files>> {
    let Some(study) = studied(case, path, long)? else { return Ok(None) };
    let judged = criteria::judge_sweep(case, &study);
    page::files(name, case, &study, &judged).into_diagnostic().map(Some)
}
