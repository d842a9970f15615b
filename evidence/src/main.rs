//! `vinesink-evidence paper` and `vinesink-evidence extremes`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, Parser};
use miette::{IntoDiagnostic, Result};
use vinesink::answer::{Answer, Asked};
use vinesink::case::Case;
use vinesink::case_report;
use vinesink::program::case_file::{self, Reading};
use vinesink::program::parallel::Parallel;
use vinesink::program::progress::Progress;
use vinesink::program::reports;
use vinesink::report::render::Files;
use vinesink_evidence::extremes;
use vinesink_evidence::paper::{self, CASES, CaseReport, SETS, TRANSFER};

/// Show whether vinesink can be trusted.
///
/// Exit codes: 0 done, 1 done but something that is trusted is wrong, 2 could not be done.
#[derive(Debug, Parser)]
#[command(version, arg_required_else_help = true)]
enum Command {
    Paper(Paper),
    Extremes(Extremes),
}

/// Compare every figure of the paper with what the program finds
///
/// Writes OUT/paper.md and OUT/li2016-8hz-set-a/figures/nearer-resonance.svg from the shipped cases. Its other
/// images are those of the cases' reports, which `vinesink report` writes into the same folder.
#[derive(Debug, Args)]
#[command(after_long_help = PAPER)]
struct Paper {
    /// The folder with the shipped cases
    #[arg(long, value_name = "CASES", default_value = "cases")]
    cases: PathBuf,
    /// The folder that receives the page, beside the reports
    #[arg(long, value_name = "OUT", default_value = "reports")]
    out: PathBuf,
    #[command(flatten)]
    reading: Reading,
}

const PAPER: &str = "\
Examples:
  vinesink report cases/*.toml && vinesink-evidence paper
  vinesink-evidence paper --cases cases --out /somewhere/else";

/// Ask every layer at the ends of its ranges and compare with 77 decimal digits
///
/// Writes OUT/extremes.md: what each run costs, how well it closes its energy balance, how far it is
/// from a reference that shares no code with it, and what is flagged or refused and why; the same of
/// every other layer. Exits with 1 if anything that is trusted is wrong.
#[derive(Debug, Args)]
#[command(after_long_help = EXTREMES)]
struct Extremes {
    /// The folder that receives the page, beside the reports
    #[arg(long, value_name = "OUT", default_value = "reports")]
    out: PathBuf,
}

const EXTREMES: &str = "\
Examples:
  vinesink-evidence extremes
  vinesink-evidence extremes --out /somewhere/else";

fn main() -> ExitCode {
    vinesink::program::main(Command::try_parse(), |command| match command {
        Command::Paper(arguments) => paper(&arguments),
        Command::Extremes(arguments) => extremes(&arguments.out),
    })
}

fn paper(arguments: &Paper) -> Result<bool> {
    let names: Vec<&'static str> = CASES.into_iter().chain([TRANSFER]).chain(SETS).collect();
    let read = |name: &str| {
        case_file::read(&arguments.cases.join(format!("{name}.toml")), arguments.reading)
    };
    let cases: Vec<Case> = names.iter().map(|name| read(name)).collect::<Result<_>>()?;
    let progress = Progress::new("paper", cases.len() as u64);
    let mut members = Vec::new();
    for (name, case) in names.into_iter().zip(cases) {
        let answer = Answer::of(&case, Asked::Study, None, &Parallel).into_diagnostic()?;
        let study = answer.studied().into_diagnostic()?.clone();
        let figures = case_report::drawn(&case, &study, &Parallel).into_diagnostic()?;
        members.push(CaseReport { name, case, study, figures });
        progress.advance(1);
    }
    drop(progress);
    let files = paper::page(&members, &Parallel).into_diagnostic()?;
    reports::write_page(&arguments.out, "paper.md", &files)?;
    Ok(true)
}

fn extremes(out: &Path) -> Result<bool> {
    let entries = extremes::entries().into_diagnostic()?;
    let rows = extremes::layers::rows().into_diagnostic()?;
    let progress = Progress::new("extremes", (entries.len() + rows.len()) as u64 + 2);
    let mut outcomes = Vec::new();
    for entry in entries {
        outcomes.push(entry.outcome());
        progress.advance(1);
    }
    let mut layers = Vec::new();
    for row in rows {
        layers.push(row.outcome().into_diagnostic()?);
        progress.advance(1);
    }
    let units = extremes::unit_checks().into_diagnostic()?;
    progress.advance(1);
    let contact = extremes::contact::tables().into_diagnostic()?;
    progress.advance(1);
    let text = extremes::page(&outcomes, &layers, &contact, &units).into_diagnostic()?;
    let files = Files::from([("extremes.md".into(), text.into_bytes())]);
    reports::write_page(out, "extremes.md", &files)?;
    Ok(extremes::holds(&outcomes, &layers, &units))
}
