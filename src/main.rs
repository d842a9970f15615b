//! Parses the command line, carries out the command, and reports how that went.

mod cli;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    match cli::Cli::parse().run() {
        Ok(outcome) => outcome.into(),
        Err(error) => cli::could_not(&error),
    }
}
