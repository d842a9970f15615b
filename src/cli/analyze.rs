//! `vinesink analyze CASE`

use clap::Args;
use miette::{IntoDiagnostic, Result, WrapErr, miette};
use vinesink::answer::{Answer, Asked};
use vinesink::case_input::AnyCase;
use vinesink::method::Method;
use vinesink::program::case_file;
use vinesink::program::parallel::Parallel;
use vinesink::report::console::Analysed;
use vinesink::report::document::Content;
use vinesink::study::fidelity::LayerPlan;

use super::budget::{self, Work};
use super::one_case::{self, OneCase};
use super::several;

/// Print what the theory and the exact orbits say of a case
///
/// Slow invariant manifold, fixed points with their stability, boundaries and area, in closed form;
/// beside them the exact symmetric orbits of the full system and its own boundaries, and every long-term
/// motion. With --fidelity, or a table [accuracy] in the case, nothing is simulated that another layer
/// answers well enough.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    one: OneCase,
    /// Also answer by this layer [default: with [accuracy] in the case by the cheapest that is exact
    /// enough, else by none]
    #[arg(long, value_parser = one_case::layer(), value_name = "LAYER")]
    fidelity: Option<Method>,
}

const EXAMPLES: &str = "\
Examples:
  vinesink analyze cases/li2016-8hz-b7p5mm.toml
  vinesink analyze damper.toml --fidelity orbit    amplitude and regime by the exact orbit
  vinesink analyze damper.toml --format json | jq .boundaries";

pub fn run(arguments: Arguments) -> Result<bool> {
    let OneCase { path, long, reading, .. } = &arguments.one;
    let case = match case_file::read_any(path, *reading)?.0 {
        AnyCase::One(case) => *case,
        AnyCase::Several(case) => {
            several::without(path, &[("--fidelity", arguments.fidelity.is_some())])?;
            return several::analyze(&arguments.one, &case);
        }
    };
    if case.design.release().is_none() {
        one_case::steady(&case, path, "an analysis")?;
    }
    let plan = LayerPlan::of_case(&case, arguments.fidelity).into_diagnostic()?;
    let work = Work::of(&case, Asked::Analysis, plan.as_ref());
    long.allows(path, &case, &work)?;
    let progress = budget::progress("analysis", &case, &work, 0.0);
    let answer = Answer::of(&case, Asked::Analysis, plan.as_ref(), &Parallel)
        .into_diagnostic()
        .wrap_err_with(|| format!("{} cannot be analysed", path.display()))?;
    drop(progress);
    if arguments.one.print_transient(&case, &answer, Content::Analysis)? {
        return Ok(true);
    }
    let none = || miette!("{} was not analysed", path.display());
    let found = Analysed::of(&case, &answer).ok_or_else(none)?;
    arguments.one.print(|| found.text(), || found.document())?;
    Ok(answer.exact_enough())
}
