//! `vinesink tradeoff CASE`

use std::hint::black_box;
use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use miette::{IntoDiagnostic, Result};
use vinesink::program::parallel::Parallel;
use vinesink::program::progress::Progress;
use vinesink::program::{case_file, reports};
use vinesink::study::StudyError;
use vinesink::system::{State, System};
use vinesink::tradeoff::page::{Page, USUAL};
use vinesink::tradeoff::{Tradeoff, TradeoffEffort, Trial};

use super::budget::{BEST_ANSWER, Work};
use super::one_case::{self, Format, OneCase};

/// Measure how much accuracy each layer gives for how much work
///
/// Asks the closed form, the slow flow in time, the exact orbit, simulations of several lengths and
/// a fixed-step integrator for the amplitude of the case's long-term motion, and sets their errors
/// against the best answer beside what they cost: in operations, which are the same on every
/// machine, and on the terminal also in seconds of this one.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    one: OneCase,
    /// Also write tradeoff.md and figures/tradeoff.svg into OUT/<name of the case file>, without
    /// seconds
    #[arg(long, value_name = "OUT")]
    out: Option<PathBuf>,
    /// Put seconds into the JSON document, which is then not the same twice
    #[arg(long)]
    seconds: bool,
}

const EXAMPLES: &str = "\
Examples:
  vinesink tradeoff cases/li2016-8hz-b7p5mm.toml
  vinesink tradeoff cases/li2016-8p5hz-fig4d.toml --out reports
  vinesink tradeoff damper.toml --format json | jq '.methods[] | [.method, .operations]'";

/// Runs of a method of which the fastest counts, and seconds after which no further one begins.
const RUNS: u32 = 5;
const LONG_ENOUGH: f64 = 0.2;

pub fn run(arguments: Arguments) -> Result<bool> {
    let OneCase { path, format, long, reading } = &arguments.one;
    if arguments.out.is_some() {
        case_file::name(path)?;
    }
    let case = case_file::read(path, *reading)?;
    one_case::steady(&case, path, "a trade-off")?;
    let system = case.system();
    let effort = TradeoffEffort { search: case.effort(), ..TradeoffEffort::default() };
    let [starts, motion] = Work::motions(&case, &effort.search);
    long.allows(path, &case, &[starts, motion, Work::trajectory(&case, BEST_ANSWER)])?;
    let timed = *format == Format::Text || arguments.seconds;
    let steps = Tradeoff::steps(&effort);
    // Each method once more on the clock; the starts are not.
    let again = if timed { steps - u64::from(effort.search.starts) } else { 0 };
    let progress = Progress::new("layers", steps + again);
    let found = Tradeoff::of(&system, &effort, &Parallel, &mut |done| progress.advance(done));
    let found = found.into_diagnostic()?;
    let asked = case.accuracy.and_then(|accuracy| accuracy.amplitude);
    let allowed = asked.unwrap_or(USUAL);
    let seconds =
        if timed { seconds(&system, &found, &progress).into_diagnostic()? } else { Vec::new() };
    drop(progress);
    let page = Page { case: &case, found: &found, allowed, seconds: None };
    if let Some(out) = &arguments.out {
        reports::add_to_report(out, path, &page.files().into_diagnostic()?)?;
    }
    let timed = Page { seconds: timed.then_some(seconds.as_slice()), ..page };
    arguments.one.print(|| timed.text(), || timed.document())?;
    Ok(true)
}

/// The shortest of several runs of each method, in seconds, in the order of the trials.
fn seconds(system: &System, found: &Tradeoff, progress: &Progress) -> Result<Vec<f64>, StudyError> {
    let timed = |trial| {
        progress.advance(1);
        fastest(system, found.start, trial)
    };
    found.trials.iter().map(timed).collect()
}

fn fastest(system: &System, start: State, trial: &Trial) -> Result<f64, StudyError> {
    let mut best = f64::INFINITY;
    let begin = Instant::now();
    for _ in 0..RUNS {
        let here = Instant::now();
        black_box(trial.method.run(system, start)?);
        best = best.min(here.elapsed().as_secs_f64());
        if begin.elapsed().as_secs_f64() > LONG_ENOUGH {
            break;
        }
    }
    Ok(best)
}
