//! Parses the command line, carries out the command, and reports how that went.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    vinesink::program::main(cli::Cli::of_arguments(), cli::Cli::run)
}
