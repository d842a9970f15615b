//! `vinesink manual FOLDER`

use std::path::PathBuf;

use clap::{Args, Command, CommandFactory};
use clap_mangen::Man;
use miette::{IntoDiagnostic, Result};
use vinesink::program::output;
use vinesink::report::render::Files;
use vinesink::store::Output;

use super::Cli;

/// Write a manual page for each command, as `man` reads it
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// Folder of the pages, which is made if it is missing
    folder: PathBuf,
}

const EXAMPLES: &str = "\
Examples:
  vinesink manual ~/.local/share/man/man1
  man vinesink-report";

pub fn run(arguments: Arguments) -> Result<bool> {
    let mut program = Cli::command();
    program.build();
    let commands = program.get_subcommands().filter(|one| one.get_name() != "help");
    let folder = Output::open(&arguments.folder)?;
    for command in std::iter::once(&program).chain(commands) {
        let (name, page) = page(command.clone())?;
        folder.add("", &Files::from([(name.clone().into(), page)]))?;
        output::print_path(&arguments.folder.join(name))?;
    }
    Ok(true)
}

/// A page and the name of its file.
fn page(command: Command) -> Result<(String, Vec<u8>)> {
    // `vinesink sweep` has the page vinesink-sweep(1).
    let name = command.get_bin_name().unwrap_or("vinesink").replace(' ', "-");
    let man = Man::new(command.display_name(name));
    let mut page = Vec::new();
    man.render(&mut page).into_diagnostic()?;
    Ok((man.get_filename(), page))
}
