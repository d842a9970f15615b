//! `vinesink check CASE...`

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use miette::{IntoDiagnostic, Result};
use serde::Serialize;
use vinesink::criteria;
use vinesink::report::criteria::{CriteriaDocument, annotations, junit, markdown, text};

use super::{Outcome, case_file, output};

/// Hold each case against its criteria
///
/// A case's table [criteria] says what its design must achieve, over its [band] if it has one; each
/// criterion is decided by the cheapest layer that can. Ends with exit code 1 if one does not hold.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// The case files
    #[arg(value_name = "CASE", required = true)]
    cases: Vec<PathBuf>,
    /// How the result is printed
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
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
    cases: Vec<CriteriaDocument>,
}

pub fn run(arguments: Arguments) -> Result<Outcome> {
    let documents = arguments
        .cases
        .iter()
        .map(|path| judged(path))
        .collect::<Result<Vec<CriteriaDocument>>>()?;
    let holds = documents.iter().all(|document| document.holds);
    match arguments.format {
        Format::Text => output::print(separated(documents.iter().map(text)))?,
        Format::Markdown => output::print(separated(documents.iter().map(markdown)))?,
        Format::Github => {
            let lines = arguments
                .cases
                .iter()
                .zip(&documents)
                .map(|(path, document)| annotations(&path.display().to_string(), document));
            output::print(lines.collect::<String>())?;
        }
        Format::Junit => output::print(junit(&documents))?,
        Format::Json => {
            output::print_json(&Document { format: "vinesink/check@1", holds, cases: documents })?
        }
    }
    Ok(if holds { Outcome::Done } else { Outcome::DoesNotHold })
}

fn judged(path: &Path) -> Result<CriteriaDocument> {
    let case = case_file::read(path)?;
    let judged = criteria::judge(&case, None).into_diagnostic()?;
    if case.criteria.is_empty() {
        output::complain(&format!("{}: there is no table [criteria]", path.display()));
    }
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    Ok(CriteriaDocument::new(&stem, &case, &judged))
}

fn separated(parts: impl Iterator<Item = String>) -> String {
    parts.collect::<Vec<_>>().join("\n")
}
