//! `vinesink analyze CASE`

use clap::Args;
use miette::{IntoDiagnostic, Result, WrapErr};
use vinesink::analysis::Analysis;
use vinesink::orbits::FullSystem;
use vinesink::report::documents::AnalysisDocument;
use vinesink::report::summary;
use vinesink::study::settle_area;

use super::case_file::{CaseArgument, Format};
use super::{Outcome, output};

/// Print what the theory and the exact orbits say of a case
///
/// Slow invariant manifold, fixed points with their stability, boundaries and area, in closed form;
/// beside them the exact symmetric orbits of the full system and its own boundaries. Nothing is
/// simulated, except where neither can tell area Z1 from Z2.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    case: CaseArgument,
    /// Text for people or JSON for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  vinesink analyze cases/li2016-8hz-b7p5mm.toml
  vinesink analyze damper.toml --format json | jq .boundaries";

pub fn run(arguments: Arguments) -> Result<Outcome> {
    let case = arguments.case.read()?;
    let analysis = Analysis::of(&case.system())
        .into_diagnostic()
        .wrap_err_with(|| format!("{} cannot be analysed", arguments.case.path.display()))?;
    let exact = FullSystem::of(&case.system());
    let area = settle_area(&analysis, &exact).into_diagnostic()?;
    match arguments.format {
        Format::Text => output::print(summary::analysis(&case, &analysis, &exact, area))?,
        Format::Json => {
            output::print_json(&AnalysisDocument::new(&analysis, &exact, area, &case.scales()))?;
        }
    }
    Ok(Outcome::Done)
}
