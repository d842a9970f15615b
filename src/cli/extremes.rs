//! `vinesink extremes`

use std::path::PathBuf;

use clap::Args;
use miette::{IntoDiagnostic, Result};
use vinesink::evidence::extremes::contact::tables;
use vinesink::evidence::extremes::layers::rows;
use vinesink::evidence::extremes::{entries, holds, page, unit_checks};
use vinesink::program::progress::Progress;
use vinesink::program::reports;
use vinesink::report::render::Files;

/// Ask every layer at the ends of its ranges and compare with 77 decimal digits
///
/// Writes OUT/extremes.md: what each run costs, how well it closes its energy balance, how far it is
/// from a reference that shares no code with it, and what is flagged or refused and why; the same of
/// every other layer. Exits with 1 if anything that is trusted is wrong.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// The folder that receives the page, beside the reports
    #[arg(long, value_name = "OUT", default_value = "reports")]
    out: PathBuf,
}

const EXAMPLES: &str = "\
Examples:
  vinesink extremes
  vinesink extremes --out /somewhere/else";

pub fn run(arguments: Arguments) -> Result<bool> {
    let entries = entries().into_diagnostic()?;
    let rows = rows().into_diagnostic()?;
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
    let units = unit_checks().into_diagnostic()?;
    progress.advance(1);
    let contact = tables().into_diagnostic()?;
    progress.advance(1);
    let text = page(&outcomes, &layers, &contact, &units).into_diagnostic()?;
    let files = Files::from([("extremes.md".into(), text.into_bytes())]);
    reports::write_page(&arguments.out, "extremes.md", &files)?;
    Ok(holds(&outcomes, &layers, &units))
}
