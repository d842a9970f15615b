//! Parses the command line, carries out the command, and reports how that went.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    let command = match cli::Cli::of_arguments() {
        Ok(command) => command,
        Err(code) => return code,
    };
    match command.run() {
        Ok(true) => ExitCode::SUCCESS,
        // Done, and a check or criterion does not hold.
        Ok(false) => ExitCode::from(1),
        Err(error) => cli::could_not(&error),
    }
}
