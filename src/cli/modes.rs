//! `vinesink modes FILE`

use std::path::{Path, PathBuf};

use clap::Args;
use miette::{IntoDiagnostic, Report, Result};
use vinesink::case::{ModesFile, ModesListing};
use vinesink::case_input::{CaseInputError, read_modes};
use vinesink::program::output;
use vinesink::report::modal::{listing, listing_text};

use super::one_case::Format;

/// List the modes of a file
///
/// A file of modes, as the table [modes] of a case names it: a Universal File or a file of columns. Lists its modes with what they
/// are read as, and the lines of a case that read it.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// The file
    #[arg(value_name = "FILE")]
    path: PathBuf,
    /// Text for people or JSON for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  vinesink modes mast.unv
  vinesink modes mast.csv --format json";

/// A file of modes.
pub fn read(path: &Path) -> Result<ModesFile> {
    read_modes(path).map_err(|error| match error {
        CaseInputError::Case(error) => Report::new(error),
        CaseInputError::File(error) => Report::new(error),
        other => Report::msg(other),
    })
}

pub fn run(arguments: Arguments) -> Result<bool> {
    let file = read(&arguments.path)?;
    let name = arguments.path.file_name().unwrap_or_default().to_string_lossy();
    let found = ModesListing::of(&file, &name)?;
    match arguments.format {
        Format::Text => output::print(listing_text(&name, &found).into_diagnostic()?)?,
        Format::Json => output::print_json(&listing(&name, &found))?,
    }
    Ok(true)
}
