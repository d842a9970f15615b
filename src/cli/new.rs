//! `vinesink new NAME`

use std::path::PathBuf;

use clap::Args;
use miette::{Result, miette};
use vinesink::case::Case;
use vinesink::store;

use super::output;

/// Write a commented case to start from
///
/// Writes NAME.toml, in the current folder or under the path given. An existing file is never
/// overwritten.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// Name or path of the case, with or without `.toml`
    #[arg(value_name = "NAME")]
    path: PathBuf,
}

const EXAMPLES: &str = "\
Examples:
  vinesink new damper                write damper.toml
  vinesink new cases/footbridge      write cases/footbridge.toml; the folder must exist";

pub fn run(arguments: Arguments) -> Result<bool> {
    // Also behind a dot that is part of the name, as in `8.5hz`.
    let path = match arguments.path.extension() {
        Some(extension) if extension == "toml" => arguments.path.clone(),
        _ => arguments.path.with_added_extension("toml"),
    };
    let title = path.file_stem().ok_or_else(|| {
        miette!(
            help = "write for example `vinesink new damper`",
            "`{}` is not a file's name",
            arguments.path.display()
        )
    })?;
    let text = Case::starting_text(&title.to_string_lossy());
    store::write_new(&path, text.as_bytes())?;
    output::print_path(&path)?;
    Ok(true)
}
