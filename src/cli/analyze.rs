//! `vinesink analyze CASE`

use clap::Args;
use miette::{IntoDiagnostic, Result, WrapErr};
use vinesink::analysis::Analysis;
use vinesink::method::Method;
use vinesink::orbits::FullSystem;
use vinesink::report::console::Analysed;
use vinesink::study::StudyEffort;
use vinesink::study::fidelity::Plan;

use super::budget::{ANALYSIS, Work};
use super::case_file::{self, OneCase};
use super::progress::Progress;
use super::{simulate, transient};

/// Print what the theory and the exact orbits say of a case
///
/// Slow invariant manifold, fixed points with their stability, boundaries and area, in closed form;
/// beside them the exact symmetric orbits of the full system and its own boundaries. Nothing is
/// simulated, except where neither can tell area Z1 from Z2, and where the case's table [accuracy]
/// asks for what only simulation knows.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    one: OneCase,
    /// Also answer by this layer [default: with [accuracy] in the case by the cheapest that is exact
    /// enough, else by none]
    #[arg(long, value_parser = case_file::layer(), value_name = "LAYER")]
    fidelity: Option<Method>,
}

const EXAMPLES: &str = "\
Examples:
  vinesink analyze cases/li2016-8hz-b7p5mm.toml
  vinesink analyze damper.toml --fidelity orbit    amplitude and regime by the exact orbit
  vinesink analyze damper.toml --format json | jq .boundaries";

pub fn run(arguments: Arguments) -> Result<bool> {
    let OneCase { path, long, .. } = &arguments.one;
    let case = case_file::read(path)?;
    if let Some(done) = transient::analyze(&arguments.one, &case)? {
        return Ok(done);
    }
    transient::steady(&case, path, "an analysis")?;
    let plan = Plan::of_case(&case, arguments.fidelity).into_diagnostic()?;
    let theory = Work::trajectory(&case, ANALYSIS);
    let progress = Progress::estimated("analysis", theory.seconds());
    let mut work = vec![theory];
    if plan.as_ref().is_some_and(Plan::needs_simulation) {
        work.extend(Work::motions(&case, &StudyEffort::of(&case.simulation)));
    }
    long.allows(path, &case, &work)?;
    let analysis = Analysis::of(&case.system())
        .into_diagnostic()
        .wrap_err_with(|| format!("{} cannot be analysed", path.display()))?;
    let exact = FullSystem::of(&case.system());
    drop(progress);
    let answers = match plan {
        Some(plan) if plan.needs_simulation() => {
            let found = simulate::search(&analysis, &StudyEffort::of(&case.simulation))?;
            Some(plan.answers(Some(&found)).into_diagnostic()?)
        }
        Some(plan) => Some(plan.answers(None).into_diagnostic()?),
        None => None,
    };
    let found =
        Analysed { case: &case, analysis: &analysis, exact: &exact, answers: answers.as_ref() };
    arguments.one.print(|| found.text(), || found.document())?;
    Ok(answers.is_none_or(|answers| answers.enough()))
}
