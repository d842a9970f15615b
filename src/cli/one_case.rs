//! What commands on one case have in common.

use std::error::Error;
use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use miette::{IntoDiagnostic, Result};
use serde::Serialize;
use vinesink::method::Method;
use vinesink::program::case_file::Reading;
use vinesink::program::output;

use super::budget::Long;

/// The case, how its result is printed, and what is allowed.
#[derive(Debug, Args)]
pub struct OneCase {
    /// The case file
    #[arg(value_name = "CASE")]
    pub path: PathBuf,
    /// Text for people or JSON for programs
    #[arg(long, value_enum, default_value = "text")]
    pub format: Format,
    #[command(flatten)]
    pub long: Long,
    #[command(flatten)]
    pub reading: Reading,
}

impl OneCase {
    /// Prints a result, only that document made which is asked for.
    pub fn print<E: Error + Send + Sync + 'static, J: Serialize>(
        &self,
        text: impl FnOnce() -> Result<String, E>,
        json: impl FnOnce() -> J,
    ) -> Result<()> {
        match self.format {
            Format::Text => output::print(text().into_diagnostic()?),
            Format::Json => output::print_json(&json()),
        }
    }
}

/// How a result is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// For people
    Text,
    /// One JSON document
    Json,
}

/// Reads the layer that answers, where the cheapest that is exact enough shall not.
pub fn layer() -> impl TypedValueParser<Value = Method> {
    one_of([
        ("manifold", Method::Theory, "Manifold and fixed points, in closed form"),
        ("averaged-flow", Method::AveragedFlow, "The slow flow with averages, in every regime"),
        ("orbit", Method::ExactOrbit, "The exact symmetric orbit"),
        ("simulation", Method::Simulation, "Event-driven simulation"),
    ])
}

/// Reads one of some names with their values and what the help says of them.
pub fn one_of<T: Copy + Send + Sync + 'static, const N: usize>(
    all: [(&'static str, T, &'static str); N],
) -> impl TypedValueParser<Value = T> {
    let names = all.map(|(name, _, help)| PossibleValue::new(name).help(help));
    PossibleValuesParser::new(names).try_map(move |name| {
        let known = all.iter().find(|(known, ..)| *known == name);
        known.map(|(_, value, _)| *value).ok_or("not one of the names")
    })
}
