//! `vinesink diff OLD NEW`

use std::path::Path;

use clap::{Args, ValueEnum};
use miette::{IntoDiagnostic as _, Result, WrapErr as _, miette};
use vinesink::diff::Difference;
use vinesink::diff::markdown::markdown;
use vinesink::program::case_file::Reading;
use vinesink::program::{cases, output};
use vinesink::report::escape::url_path;
use vinesink::store;

use side::ComparedSide;

mod side;

/// Say what changed between two reports, or two sets of reports
///
/// Inputs, criteria and the most important numbers beyond what they are known to; everything else is
/// folded away and counted. A number that carries an error may move within it, an exact one may not.
/// OLD and NEW are each a folder with one report or many, a report.json, or a revision that git knows;
/// what could be both is refused. Reports are named that were made from another text of their case or of a
/// file that it reads, by another version of the program, or whose case is gone. The exit code is 1 where a
/// report is out of date or anything but figures and wording changed.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// Before: a folder, a report.json or a revision
    #[arg(value_name = "OLD")]
    old: String,
    /// After: the same; left out where OLD is `main...HEAD`, which compares HEAD with where it left main
    #[arg(value_name = "NEW")]
    new: Option<String>,
    /// The folder that is read from a revision
    #[arg(long, value_name = "FOLDER", default_value = "reports")]
    path: String,
    /// The folder with the cases that the reports are about [default: the folder `cases` beside the
    /// reports, or in the working folder]
    #[arg(long, value_name = "FOLDER")]
    cases: Option<String>,
    /// Markdown for a comment or JSON for programs
    #[arg(long, value_enum, default_value = "markdown")]
    format: DiffFormat,
    /// Address of OLD's folder, to show figures in a comment [default: OLD, if it is a folder]
    #[arg(long, value_name = "URL")]
    old_url: Option<String>,
    /// Address of NEW's folder
    #[arg(long, value_name = "URL")]
    new_url: Option<String>,
    #[command(flatten)]
    reading: Reading,
}

const EXAMPLES: &str = "\
Examples:
  vinesink diff reports/damper elsewhere/damper
  vinesink diff main...HEAD                     what a branch changed since it left main
  vinesink diff main... reports                 the same with what is not committed yet
  vinesink diff v1.0 v1.1                       the folder reports at two revisions
  vinesink diff main...HEAD --path design/reports --format json | jq .reports";

/// How a difference is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum DiffFormat {
    /// GitHub-flavoured Markdown
    Markdown,
    /// One JSON document
    Json,
}

/// What is compared.
struct Compared {
    /// What its two sides are called.
    names: [String; 2],
    /// The old side.
    from: String,
    /// Whether the old side has commits that the new one lacks, so that they appear taken back.
    diverged: bool,
}

/// The two sides of a command line; of `main...HEAD` the old one is the commit at which HEAD left main.
fn compared(old: &str, new: Option<&str>) -> Result<Compared> {
    if let Some((base, branch)) = old.split_once("...").filter(|_| !Path::new(old).exists()) {
        let or_head =
            |name: &str| if name.is_empty() { "HEAD".to_owned() } else { name.to_owned() };
        let [base, branch] = [base, branch].map(or_head);
        let from = store::branch_point(&base, &branch)?;
        let new = new.map_or(branch.clone(), str::to_owned);
        return Ok(Compared { names: [format!("{base}...{branch}"), new], from, diverged: false });
    }
    let new = new.ok_or_else(|| {
        miette!(
            help = "name both sides, or write main...HEAD for what HEAD changed since it left main",
            "there is nothing to compare `{old}` with"
        )
    })?;
    let [is_revision, is_newer] = [old, new].map(|one| !Path::new(one).exists());
    // What is in the working folder has been made from the commit that is checked out.
    let is_below = cases::project(Path::new(new)).is_some_and(|root| root == Path::new(""));
    let against = if is_newer { Some(new) } else { Some("HEAD").filter(|_| is_below) };
    let commit = |name: &str| name.split(':').next().unwrap_or(name).to_owned();
    let diverged =
        is_revision && against.is_some_and(|new| !store::is_ancestor(&commit(old), &commit(new)));
    Ok(Compared { names: [old, new].map(str::to_owned), from: old.to_owned(), diverged })
}

pub fn run(arguments: Arguments) -> Result<bool> {
    let Arguments { path, format, cases, reading, .. } = &arguments;
    let Compared { names, from, diverged } = compared(&arguments.old, arguments.new.as_deref())?;
    let mut old = ComparedSide::read(&from, path, reading.reach())?;
    let mut new = ComparedSide::read(&names[1], path, reading.reach())?;
    new.find_cases(cases.as_deref())?;
    old.find_cases(cases.as_deref())?;
    let had = old.with_cases();
    old.forget_cases_of(&new);
    if let Some(folder) = cases.as_deref().filter(|_| !old.has_cases() && !new.has_cases()) {
        return Err(miette!(
            help = "name the folder with the case files, as `vinesink report` was given them",
            "`{folder}` has the case of none of these reports"
        ));
    }
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
    let mut difference = Difference::of((&names[0], &old.reports), (&names[1], &new.reports));
    difference.diverged = diverged;
    difference.hold_to_cases((&had, &old.cases), (&new.reports, &new.cases));
    match format {
        DiffFormat::Json => output::print_json(&difference)?,
        DiffFormat::Markdown => {
            // A folder is no address yet.
            let encoded = |folder: Option<String>| folder.map(|folder| url_path(&folder));
            let old = arguments.old_url.or(encoded(old.address));
            let new = arguments.new_url.or(encoded(new.address));
            let addresses = [old.as_deref(), new.as_deref()];
            let text = markdown(&difference, addresses).into_diagnostic();
            output::print(text.wrap_err("a report is damaged, or not one of this version")?)?;
        }
    }
    Ok(!difference.is_significant())
}
