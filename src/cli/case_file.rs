//! Reading the case that a command is given.

use std::error::Error;
use std::path::{Component, Path, PathBuf};

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use miette::{IntoDiagnostic, NamedSource, Report, Result, miette};
use serde::Serialize;
use vinesink::answer::Answer;
use vinesink::case::Case;
use vinesink::case_input::{self, CaseInputError};
use vinesink::excitation::Scene;
use vinesink::method::Method;
use vinesink::report::document::Content;
use vinesink::report::transient;
use vinesink::store::Reach;

use super::budget::Long;
use super::output;

/// What commands on one case have in common.
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

/// What may be read.
#[derive(Debug, Clone, Copy, Args)]
pub struct Reading {
    /// Also read files outside of the folder of the case, or of the reports, where a case or a link leads to them
    #[arg(long)]
    pub allow_outside: bool,
}

impl Reading {
    /// How far paths and links may lead.
    pub fn reach(self) -> Reach {
        if self.allow_outside { Reach::Anywhere } else { Reach::Folder }
    }
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

/// The name of a case: that of its file, without what stands behind the last point.
pub fn name(path: &Path) -> Result<String> {
    let stem = path.file_stem().ok_or_else(|| miette!("{} is no file", path.display()))?;
    let name = stem.to_string_lossy().into_owned();
    match Path::new(&name).components().next() {
        // What receives its report must be a folder of its own.
        Some(Component::Normal(_)) => Ok(name),
        _ => Err(miette!(
            help = "rename it, for example to damper.toml",
            "{} has no name before its ending",
            path.display()
        )),
    }
}

/// Reads a case file.
pub fn read(path: &Path, reading: Reading) -> Result<Case> {
    read_with_text(path, reading).map(|(case, _)| case)
}

/// Reads a case file; its text beside the case. What is probably a slip in it is said on standard error.
pub fn read_with_text(path: &Path, reading: Reading) -> Result<(Case, String)> {
    let (case, text) = case_input::read(path, reading.reach()).map_err(|error| match error {
        CaseInputError::Case(error) => Report::new(error),
        CaseInputError::Record { source, .. } => Report::new(source)
            .wrap_err(format!("{}: the record of its excitation cannot be read", path.display())),
        CaseInputError::File(error) => Report::new(error),
    })?;
    let name = path.display().to_string();
    let visible = text.strip_prefix('\u{feff}').unwrap_or(&text);
    for warning in case.warnings() {
        let source = NamedSource::new(&name, visible.to_owned());
        let shown = Report::new(warning.clone()).with_source_code(source);
        output::complain_of(&shown);
    }
    Ok((case, text))
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
