//! `vinesink diff OLD NEW`

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use miette::{Result, miette};
use vinesink::diff::markdown::{Addresses, markdown};
use vinesink::diff::{Difference, Document, Reports};
use vinesink::report::stored::ReadError;
use vinesink::store::{self, StoredReport, StoredReports};

use super::{Outcome, output};

/// Say what changed between two reports, or two sets of reports
///
/// Verdicts, criteria, inputs, numbers beyond what they are known to, and figures; everything else is
/// folded away and counted. A number that carries an error may move within it, an exact one may not.
/// OLD and NEW are each a folder with one report or many, a report.json, or a revision that git knows;
/// what is both is taken for a folder. The exit code is 1 where anything but figures and wording
/// changed.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// Before: a folder, a report.json or a revision
    #[arg(value_name = "OLD")]
    old: String,
    /// After: the same
    #[arg(value_name = "NEW")]
    new: String,
    /// The folder that is read from a revision
    #[arg(long, value_name = "FOLDER", default_value = "reports")]
    path: String,
    /// Markdown for a comment or JSON for programs
    #[arg(long, value_enum, default_value = "markdown")]
    format: Format,
    /// Address of OLD's folder, to show figures in a comment [default: OLD, if it is a folder]
    #[arg(long, value_name = "URL")]
    old_url: Option<String>,
    /// Address of NEW's folder
    #[arg(long, value_name = "URL")]
    new_url: Option<String>,
}

const EXAMPLES: &str = "\
Examples:
  vinesink diff reports/damper elsewhere/damper
  vinesink diff main HEAD                       the folder reports at two revisions
  vinesink diff v1.0 reports                    a revision against the working folder
  vinesink diff main HEAD --path design/reports --format json | jq .reports";

/// How a difference is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// GitHub-flavoured Markdown
    Markdown,
    /// One JSON document
    Json,
}

pub fn run(arguments: Arguments) -> Result<Outcome> {
    let Arguments { path, format, .. } = &arguments;
    let old = Side::read(&arguments.old, path)?;
    let new = Side::read(&arguments.new, path)?;
    if old.reports.is_empty() && new.reports.is_empty() {
        return Err(miette!(
            help = "name a folder that `vinesink report` has written, or for revisions the folder with --path",
            "there is no report.json in {}, and none in {}",
            old.place,
            new.place
        ));
    }
    if old.is_one_report() != new.is_one_report()
        && !old.reports.is_empty()
        && !new.reports.is_empty()
    {
        let (one, many) = if old.is_one_report() { (&old, &new) } else { (&new, &old) };
        return Err(miette!(
            help = "compare one with one, such as FOLDER/NAME with OTHER/NAME, or all with all",
            "{} is one report, {} is a folder of {}",
            one.place,
            many.place,
            many.reports.len()
        ));
    }
    let difference = Difference::of((&arguments.old, &old.reports), (&arguments.new, &new.reports));
    match format {
        Format::Json => output::print_json(&difference)?,
        Format::Markdown => {
            let addresses = Addresses {
                old: arguments.old_url.or(old.address),
                new: arguments.new_url.or(new.address),
            };
            output::print(markdown(&difference, &addresses))?;
        }
    }
    Ok(if difference.is_significant() { Outcome::DoesNotHold } else { Outcome::Done })
}

/// One of the two that are compared.
struct Side {
    reports: Reports,
    /// Where they were looked for, for messages.
    place: String,
    /// Where figures are, if they are files.
    address: Option<String>,
}

impl Side {
    fn read(argument: &str, folder: &str) -> Result<Self> {
        let path = Path::new(argument);
        let (stored, place, address) = if path.exists() {
            let folder = if path.is_file() { path.parent().map(Path::to_owned) } else { None };
            let address = folder.unwrap_or_else(|| PathBuf::from(path)).display().to_string();
            let address = if address.is_empty() { ".".to_owned() } else { address };
            (store::read_reports(path)?, format!("`{argument}`"), Some(address))
        } else {
            let place = format!("`{folder}` at `{argument}`");
            (store::read_reports_at(argument, folder)?, place, None)
        };
        Ok(Self { reports: documents(stored)?, place, address })
    }

    fn is_one_report(&self) -> bool {
        self.reports.contains_key("")
    }
}

fn documents(stored: StoredReports) -> Result<Reports, ReadError> {
    let document = |StoredReport { place, json, figures }: StoredReport| {
        Document::parse(&place, &json, figures)
    };
    stored.into_iter().map(|(name, report)| Ok((name, document(report)?))).collect()
}
