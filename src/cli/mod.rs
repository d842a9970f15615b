//! The command line. A command is a variant of [`Command`] and a file with its arguments and
//! `pub fn run(arguments) -> Result<bool, miette::Report>`, which says whether every check asked for holds.

mod analyze;
mod budget;
mod check;
mod completions;
mod diff;
mod impacts;
mod index;
mod manual;
mod modes;
mod new;
mod one_case;
mod optimize;
mod report;
mod schema;
mod several;
mod simulate;
mod sweep;
mod tradeoff;

use clap::error::{ContextKind, ContextValue};
use clap::{CommandFactory as _, Parser, Subcommand};
use vinesink::case::nearest;

/// Design vibro-impact nonlinear energy sinks.
///
/// A case is a TOML file that describes an oscillator, the small mass that rattles inside it, and
/// what drives it. `vinesink new NAME` writes a commented one to start from.
///
/// Exit codes: 0 done, 1 done but a check does not hold, 2 could not be done.
#[derive(Debug, Parser)]
#[command(version, arg_required_else_help = true, after_help = EXAMPLES)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
}

const EXAMPLES: &str = "\
Examples:
  vinesink new damper                           write damper.toml, a case to start from
  vinesink analyze damper.toml                  what the theory says of it
  vinesink simulate damper.toml                 what it does, from many starts
  vinesink report damper.toml                   the design report, in reports/damper
  vinesink check damper.toml                    whether it meets its criteria
  vinesink index                                all reports of a folder on one page
  vinesink diff main...HEAD                     what changed in the reports since main
  vinesink tradeoff damper.toml                 how much accuracy for how much work
  vinesink optimize damper.toml                 the clearance that serves it best
  vinesink sweep damper.toml                    a map over its parameters, as Parquet
  vinesink modes mast.unv                       the modes of a file, and how it is read
  vinesink schema > vinesink.schema.json        let the editor complete and check cases
  vinesink help new                             what a command does, with examples";

#[derive(Debug, Subcommand)]
enum Command {
    New(new::Arguments),
    Analyze(analyze::Arguments),
    Simulate(simulate::Arguments),
    Report(report::Arguments),
    Check(check::Arguments),
    Index(index::Arguments),
    Diff(diff::Arguments),
    Tradeoff(tradeoff::Arguments),
    Optimize(optimize::Arguments),
    Sweep(sweep::Arguments),
    Modes(modes::Arguments),
    Schema(schema::Arguments),
    Completions(completions::Arguments),
    Manual(manual::Arguments),
}

impl Cli {
    /// The command that the arguments name.
    pub fn of_arguments() -> Result<Self, clap::Error> {
        Self::try_parse().map_err(moved)
    }

    /// Carries out the command; whether every check asked for holds.
    pub fn run(self) -> Result<bool, miette::Report> {
        match self.command {
            Command::New(arguments) => new::run(arguments),
            Command::Analyze(arguments) => analyze::run(arguments),
            Command::Simulate(arguments) => simulate::run(arguments),
            Command::Report(arguments) => report::run(arguments),
            Command::Check(arguments) => check::run(arguments),
            Command::Index(arguments) => index::run(arguments),
            Command::Diff(arguments) => diff::run(arguments),
            Command::Tradeoff(arguments) => tradeoff::run(arguments),
            Command::Optimize(arguments) => optimize::run(arguments),
            Command::Sweep(arguments) => sweep::run(arguments),
            Command::Modes(arguments) => modes::run(arguments),
            Command::Schema(arguments) => schema::run(arguments),
            Command::Completions(arguments) => completions::run(arguments),
            Command::Manual(arguments) => manual::run(arguments),
        }
    }
}

/// Says which program has a command now that was one of this.
fn moved(mut error: clap::Error) -> clap::Error {
    if let Some(ContextValue::String(name)) = error.get(ContextKind::InvalidSubcommand)
        && ["paper", "extremes"].contains(&name.as_str())
    {
        let tip = format!("it is now `vinesink-evidence {name}`").into();
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip]));
    } else if let Some(ContextValue::String(name)) = error.get(ContextKind::InvalidSubcommand) {
        // The closest alone: a letter that is missing is a slip, half of the word is not.
        let all = Cli::command();
        let names: Vec<&str> = all.get_subcommands().map(clap::Command::get_name).collect();
        if let Some(closest) = nearest(name, &names).map(str::to_owned) {
            let only = ContextValue::Strings(vec![closest]);
            error.insert(ContextKind::SuggestedSubcommand, only);
        }
    }
    error
}
