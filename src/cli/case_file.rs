//! Reading the case that a command is given.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use miette::Result;
use vinesink::case::Case;
use vinesink::store;

/// The case that a command works on.
#[derive(Debug, Args)]
pub struct CaseArgument {
    /// The case file
    #[arg(value_name = "CASE")]
    pub path: PathBuf,
}

impl CaseArgument {
    /// Reads it.
    pub fn read(&self) -> Result<Case> {
        read(&self.path)
    }
}

/// Reads a case file.
pub fn read(path: &Path) -> Result<Case> {
    let text = store::read_text(path)?;
    Ok(Case::parse(&path.display().to_string(), &text)?)
}

/// How a result is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// For people
    Text,
    /// One JSON document
    Json,
}
