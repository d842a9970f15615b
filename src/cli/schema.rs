//! `vinesink schema`

use clap::Args;
use miette::Result;
use vinesink::case;
use vinesink::program::output;

/// Print the JSON Schema of a case file
///
/// Editors that know TOML schemas (through Taplo or Even Better TOML) complete and check a case
/// whose first line is `#:schema vinesink.schema.json`.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// Of a case of several modes or absorbers.
    #[arg(long)]
    several: bool,
}

const EXAMPLES: &str = "\
Examples:
  vinesink schema > vinesink.schema.json        beside the cases that refer to it
  vinesink schema --several > vinesink-several.schema.json";

pub fn run(arguments: Arguments) -> Result<bool> {
    let schema = if arguments.several { case::schema_of_several() } else { case::schema() };
    output::print_json(&schema)?;
    Ok(true)
}
