//! What commands on one case have in common.

use std::error::Error;
use std::path::{Path, PathBuf};

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use miette::{IntoDiagnostic, Result, miette};
use serde::Serialize;
use vinesink::answer::Answer;
use vinesink::case::Case;
use vinesink::excitation::Scene;
use vinesink::method::Method;
use vinesink::program::case_file::{Reading, name};
use vinesink::program::output;
use vinesink::report::document::Content;
use vinesink::report::transient;

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

/// Refuses a case that is not driven steadily where a command is about steady vibration.
pub fn steady(case: &Case, path: &Path, what: &str) -> Result<()> {
    match case.design.scene() {
        Scene::Steady => Ok(()),
        other => Err(miette!(
            help = "name a case whose excitation is base-displacement or force",
            "{}: its structure is {}, and {what} is about one that is driven steadily",
            path.display(),
            other.words()
        )),
    }
}

/// Refuses options that are about steady vibration for a case that is not, by their names where they were given.
pub fn without(case: &Case, path: &Path, given: &[(&str, bool)]) -> Result<()> {
    let option = given.iter().find(|(_, given)| *given);
    match (case.design.scene(), option) {
        (Scene::Steady, _) | (_, None) => Ok(()),
        (other, Some((option, _))) => Err(miette!(
            help = format!("leave out {option}: the case itself says what becomes of it"),
            "{}: {option} has no meaning for a structure that is {}",
            path.display(),
            other.words()
        )),
    }
}

impl OneCase {
    /// Prints what became of a structure that is not driven steadily; whether it is one.
    pub fn print_transient(&self, case: &Case, answer: &Answer, content: Content) -> Result<bool> {
        let Some(study) = &answer.transient else { return Ok(false) };
        let document = transient::document(&name(&self.path)?, case, study, &[], content);
        self.print(|| transient::text(case, study, &document), || &document)?;
        Ok(true)
    }

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
