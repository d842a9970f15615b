//! `vinesink check CASE...`

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use miette::{IntoDiagnostic, Report, Result};
use serde_json::json;
use vinesink::answer::{Answer, Asked, Decided};
use vinesink::case::{Case, CaseError};
use vinesink::case_input::AnyCase;
use vinesink::operating_range::{Together, Varied};
use vinesink::program::case_file::{self, Reading};
use vinesink::program::output;
use vinesink::program::parallel::Parallel;
use vinesink::report::criteria::{Checked, junit};
use vinesink::report::document::place::FilePlace;
use vinesink::report::modal;
use vinesink::report::render::RenderError;

use super::budget::{self, Long, Work};
use super::several;

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
    format: CheckFormat,
    /// Judge the criteria alone: no tuned mass damper beside the absorber, no range over which they hold
    #[arg(long)]
    criteria_only: bool,
    #[command(flatten)]
    long: Long,
    #[command(flatten)]
    reading: Reading,
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
enum CheckFormat {
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

pub fn run(arguments: Arguments) -> Result<bool> {
    let mut failures = Vec::new();
    let cases: Vec<Checked> =
        arguments.cases.iter().map(|path| checked(path, &arguments, &mut failures)).collect();
    let holds = cases.iter().all(Checked::holds);
    let each = |format: fn(&Checked) -> Result<String, RenderError>, between: &str| {
        let texts: Result<Vec<String>, _> = cases.iter().map(format).collect();
        texts.map(|texts| texts.join(between)).into_diagnostic()
    };
    match arguments.format {
        CheckFormat::Text => output::print(each(Checked::text, "\n")?)?,
        CheckFormat::Markdown => output::print(each(Checked::markdown, "\n")?)?,
        CheckFormat::Github => output::print_commands(&each(Checked::annotations, "")?)?,
        CheckFormat::Junit => output::print(junit(&cases).into_diagnostic()?)?,
        CheckFormat::Json => {
            let cases: Vec<_> = cases.iter().map(|one| &one.document).collect();
            let document = json!({ "format": "vinesink/check@3", "holds": holds, "cases": cases });
            output::print_json(&document)?;
        }
    }
    // One bad case does not keep the others from being checked; each is said in full.
    output::last_of(failures)?;
    Ok(holds)
}

fn checked(path: &Path, arguments: &Arguments, failures: &mut Vec<Report>) -> Checked {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let place = path.display().to_string();
    match judged(path, &place, &stem, arguments) {
        Ok(checked) => checked,
        Err(error) => {
            let problems =
                error.downcast_ref::<CaseError>().into_iter().flat_map(CaseError::problems);
            let problems: Vec<FilePlace> = problems.map(FilePlace::from).collect();
            let failed = Checked::failed(&place, &stem, &error.to_string(), &problems);
            failures.push(error);
            failed
        }
    }
}

fn judged(path: &Path, place: &str, stem: &str, arguments: &Arguments) -> Result<Checked> {
    match case_file::read_any(path, arguments.reading)?.0 {
        AnyCase::One(case) => {
            let answer = answered(path, &case, arguments)?;
            without_criteria(path, case.criteria.is_empty());
            Ok(Checked::judged(place, stem, &case, &answer))
        }
        AnyCase::Several(case) => {
            let answer = several::answered(path, &case, arguments.long)?;
            let (_, told) = told(arguments);
            let answer = several::decided(path, &case, answer, told, arguments.long)?;
            // Only that format has all motions.
            if matches!(arguments.format, CheckFormat::Json) {
                answer.observe(&Parallel);
            }
            without_criteria(path, case.criteria.is_empty());
            Ok(modal::checked(place, stem, &case, &answer))
        }
    }
}

fn without_criteria(path: &Path, none: bool) {
    if none {
        output::complain(&format!("{}: there is no table [criteria]", path.display()));
    }
}

/// What is asked of a case, and looked at beside it: what no format tells is not looked for.
fn told(arguments: &Arguments) -> (Asked, Decided) {
    match arguments.format {
        CheckFormat::Json if !arguments.criteria_only => (Asked::Decision, Decided::CHECKED),
        CheckFormat::Text | CheckFormat::Markdown if !arguments.criteria_only => {
            let (ranges, until) = (&Varied::FIRST, Together::Hold);
            (Asked::Decision, Decided { ranges, until, ..Decided::CHECKED })
        }
        _ => (Asked::Criteria, Decided::NOTHING),
    }
}

fn answered(path: &Path, case: &Case, arguments: &Arguments) -> Result<Answer> {
    let (long, (asked, told)) = (&arguments.long, told(arguments));
    let work = Work::of(case, asked, None);
    long.allows(path, case, &work)?;
    let decides = long.decides(path, case, &work, told);
    let besides = budget::of_decision(case, decides);
    let _progress = budget::progress("check", case, &work, besides);
    let answer = Answer::of(case, asked, None, &Parallel).into_diagnostic()?;
    answer.decided(case, decides, &Parallel).into_diagnostic()
}
