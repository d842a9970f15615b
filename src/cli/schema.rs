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
pub struct Arguments {}

const EXAMPLES: &str = "\
Example:
  vinesink schema > vinesink.schema.json        beside the cases that refer to it";

pub fn run(_: Arguments) -> Result<bool> {
    output::print_json(&case::schema())?;
    Ok(true)
}
