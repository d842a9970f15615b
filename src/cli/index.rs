//! `vinesink index [FOLDER]`

use std::path::PathBuf;

use clap::Args;
use miette::Result;
use vinesink::program::case_file::Reading;
use vinesink::program::{output, reports};
use vinesink::report::index;

/// List the reports of a folder, with verdicts and key numbers, to sort and to compare
///
/// Writes FOLDER/index.html and FOLDER/README.md from the report.json of every report in FOLDER.
/// Once they are there, `report`, `tradeoff` and `vinesink-evidence` keep them up to date.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// The folder with a folder per case, as `vinesink report` writes it
    #[arg(value_name = "FOLDER", default_value = "reports")]
    folder: PathBuf,
    #[command(flatten)]
    reading: Reading,
}

const EXAMPLES: &str = "\
Examples:
  vinesink report cases/*.toml && vinesink index
  vinesink index /somewhere/else";

pub fn run(arguments: Arguments) -> Result<bool> {
    let folder = &arguments.folder;
    reports::write_index(folder, arguments.reading.reach())?;
    for name in [index::HTML, index::MARKDOWN] {
        output::print_path(&folder.join(name))?;
    }
    Ok(true)
}
