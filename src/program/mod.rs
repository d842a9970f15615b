//! What programs on a command line share: how they begin and end, print, tell of long work, read a case, use all
//! processors, and keep the index beside reports.
//!
//! For the programs themselves, `vinesink` and those that are built on it: this module may change at any time.

pub mod case_file;
pub mod cases;
pub mod output;
pub mod parallel;
pub mod progress;
pub mod reports;

use std::process::ExitCode;

use miette::Result;

/// Carries out what a command line asks for and says how that went: 0 done, 1 done and a check or criterion does not
/// hold, 2 could not be done, of which the reason is told on standard error.
pub fn main<C>(asked: Result<C, clap::Error>, run: impl FnOnce(C) -> Result<bool>) -> ExitCode {
    let outcome = match asked {
        Ok(command) => run(command),
        Err(error) if error.use_stderr() => {
            output::complain(error.to_string().trim_end());
            return ExitCode::from(2);
        }
        // Help and version.
        Err(error) => error.exit(),
    };
    match outcome {
        Ok(holds) => ExitCode::from(u8::from(!holds)),
        Err(error) => {
            output::complain_of(&error);
            ExitCode::from(2)
        }
    }
}
