//! `vinesink schema`

use clap::Args;
use miette::{IntoDiagnostic, Result};
use vinesink::case;

use super::{Outcome, output};

/// Print the JSON Schema of a case file
///
/// Editors that know TOML schemas (through Taplo or Even Better TOML) complete and check a case
/// whose first line is `#:schema vinesink.schema.json`.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {}

const EXAMPLES: &str = "\
Examples:
  vinesink schema > vinesink.schema.json        beside the cases that refer to it";

pub fn run(_: Arguments) -> Result<Outcome> {
    let text = serde_json::to_string_pretty(&case::schema()).into_diagnostic()?;
    output::print(format!("{text}\n"))?;
    Ok(Outcome::Done)
}
