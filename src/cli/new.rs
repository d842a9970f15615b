//! `vinesink new NAME`

use std::path::PathBuf;

use clap::Args;
use clap::builder::PossibleValuesParser;
use miette::{Result, miette};
use vinesink::case::{Case, excitation_kinds};
use vinesink::program::output;
use vinesink::store;

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
    /// What drives the structure, or sets it in motion [default: base-displacement]
    #[arg(long, value_name = "KIND", value_parser = PossibleValuesParser::new(excitation_kinds()))]
    kind: Option<String>,
}

const EXAMPLES: &str = "\
Examples:
  vinesink new damper                write damper.toml
  vinesink new jump --kind impulse   the same for a structure that is struck
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
    let title = title.to_string_lossy();
    let text = match &arguments.kind {
        Some(kind) => Case::starting_text_of(&title, kind),
        None => Case::starting_text(&title),
    };
    store::write_new(&path, text.as_bytes())?;
    output::print_path(&path)?;
    Ok(true)
}
