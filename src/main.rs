//! Parses the command line, carries out the command, and reports how that went.

mod cli;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    match cli::Cli::parse().run() {
        Ok(true) => ExitCode::SUCCESS,
        // Done, and a check or criterion does not hold.
        Ok(false) => ExitCode::from(1),
        Err(error) => cli::could_not(&error),
    }
}
