//! `vinesink paper`

use std::path::PathBuf;

use clap::Args;
use miette::{IntoDiagnostic, Result};
use vinesink::answer::{Answer, Asked};
use vinesink::case::Case;
use vinesink::case_report;
use vinesink::evidence::paper::{CASES, CaseReport, SETS, TRANSFER, page};
use vinesink::program::case_file::{self, Reading};
use vinesink::program::parallel::Parallel;
use vinesink::program::progress::Progress;
use vinesink::program::reports;

/// Compare every figure of the paper with what the program finds
///
/// Writes OUT/paper.md and OUT/li2016-8hz-set-a/figures/nearer-resonance.svg from the shipped cases. Its other
/// images are those of the cases' reports, which `vinesink report` writes into the same folder.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// The folder with the shipped cases
    #[arg(long, value_name = "CASES", default_value = "cases")]
    cases: PathBuf,
    /// The folder that receives the page, beside the reports
    #[arg(long, value_name = "OUT", default_value = "reports")]
    out: PathBuf,
    #[command(flatten)]
    reading: Reading,
}

const EXAMPLES: &str = "\
Examples:
  vinesink report cases/*.toml && vinesink paper
  vinesink paper --cases cases --out /somewhere/else";

pub fn run(arguments: Arguments) -> Result<bool> {
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
        let figures = case_report::drawn(&case, &study).into_diagnostic()?;
        members.push(CaseReport { name, case, study, figures });
        progress.advance(1);
    }
    drop(progress);
    let files = page(&members, &Parallel).into_diagnostic()?;
    reports::write_page(&arguments.out, "paper.md", &files)?;
    Ok(true)
}
