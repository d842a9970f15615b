//! `vinesink check CASE...`

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use miette::{IntoDiagnostic, Report, Result};
use serde::Serialize;
use vinesink::band::Survey;
use vinesink::case::CaseError;
use vinesink::criteria;
use vinesink::report::criteria::{
    Checked, FailedCase, JudgedCase, annotations, junit, markdown, text,
};
use vinesink::report::document::place::Place;

use super::budget::{Long, Work};
use super::parallel::Parallel;
use super::{Outcome, case_file, output};

/// Hold each case against its criteria
///
/// A case's table [criteria] says what its design must achieve, over its [band] if it has one; each
/// criterion is decided by the cheapest layer that can. Ends with exit code 1 if one does not hold, with 2
/// if a case could not be checked, which does not keep the others from being.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// The case files
    #[arg(value_name = "CASE", required = true)]
    cases: Vec<PathBuf>,
    /// How the result is printed
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
    #[command(flatten)]
    long: Long,
}

const EXAMPLES: &str = "\
Examples:
  vinesink check damper.toml
  vinesink check cases/*.toml --format junit > criteria.xml
  vinesink check cases/*.toml --format github       annotations in a workflow of GitHub

A criterion is a line such as
  [criteria]
  z3_share = \">= 80 %\"
  peak_displacement = \"<= 3 mm\"
  no_coexistence = true";

/// How the result is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// A table for people
    Text,
    /// One JSON document
    Json,
    /// Tables for a pull request
    Markdown,
    /// Annotations of a GitHub workflow
    Github,
    /// A JUnit report for build servers
    Junit,
}

#[derive(Serialize)]
struct Document {
    format: &'static str,
    holds: bool,
    cases: Vec<Checked>,
}

pub fn run(arguments: Arguments) -> Result<Outcome> {
    let mut failures = Vec::new();
    let cases: Vec<Checked> =
        arguments.cases.iter().map(|path| checked(path, arguments.long, &mut failures)).collect();
    let holds = |one: &Checked| matches!(one, Checked::Judged(document) if document.holds);
    let holds = cases.iter().all(holds);
    match arguments.format {
        Format::Text => output::print(separated(cases.iter().map(text)))?,
        Format::Markdown => output::print(separated(cases.iter().map(markdown)))?,
        Format::Github => {
            let paths = arguments.cases.iter().map(|path| path.display().to_string());
            let lines = paths.zip(&cases).map(|(path, one)| annotations(&path, one));
            output::print(lines.collect::<String>())?;
        }
        Format::Junit => output::print(junit(&cases))?,
        Format::Json => {
            output::print_json(&Document { format: "vinesink/check@1", holds, cases })?;
        }
    }
    // One bad case does not keep the others from being checked; each is said in full.
    output::last_of(failures)?;
    Ok(holds.into())
}

fn checked(path: &Path, long: Long, failures: &mut Vec<Report>) -> Checked {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    match judged(path, &stem, long) {
        Ok(document) => Checked::Judged(document),
        Err(error) => {
            let problems =
                error.downcast_ref::<CaseError>().into_iter().flat_map(CaseError::problems);
            let problems = problems.map(Place::from).collect();
            let failed = FailedCase { case: stem.into(), error: error.to_string(), problems };
            failures.push(error);
            Checked::Failed(failed)
        }
    }
}

fn judged(path: &Path, stem: &str, long: Long) -> Result<JudgedCase> {
    let case = case_file::read(path)?;
    if !case.criteria.is_empty() {
        long.allows(path, &case, &[Work::criteria(&case)])?;
    }
    let survey = Survey::of(&criteria::range(&case), &criteria::settings(&case), &Parallel);
    let judged = criteria::judge(&case, &survey.into_diagnostic()?);
    if case.criteria.is_empty() {
        output::complain(&format!("{}: there is no table [criteria]", path.display()));
    }
    JudgedCase::new(stem, &case, &judged).into_diagnostic()
}

fn separated(parts: impl Iterator<Item = String>) -> String {
    parts.collect::<Vec<_>>().join("\n")
}
