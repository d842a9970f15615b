//! Reading the case that a command is given.

use std::error::Error;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use miette::{IntoDiagnostic, NamedSource, Report, Result, miette};
use serde::Serialize;
use vinesink::case::Case;
use vinesink::method::Method;
use vinesink::store;
use vinesink::study::fidelity::{AccuracyTarget, Plan};

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

/// The name of a case: that of its file, without what stands behind the last point.
pub fn name(path: &Path) -> Result<String> {
    let stem = path.file_stem().ok_or_else(|| miette!("{} is no file", path.display()))?;
    Ok(stem.to_string_lossy().into_owned())
}

/// Reads a case file.
pub fn read(path: &Path) -> Result<Case> {
    read_with_text(path).map(|(case, _)| case)
}

/// Reads a case file; its text beside the case. What is probably a slip in it is said on standard error.
pub fn read_with_text(path: &Path) -> Result<(Case, String)> {
    let text = store::read_text(path)?;
    let name = path.display().to_string();
    let case = Case::parse(&name, &text)?;
    let visible = text.strip_prefix('\u{feff}').unwrap_or(&text);
    for warning in case.warnings() {
        let source = NamedSource::new(&name, visible.to_owned());
        let shown = Report::new(warning.clone()).with_source_code(source);
        output::complain(&format!("{shown:?}"));
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

/// The layer that answers, where the cheapest that is exact enough shall not.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Fidelity {
    /// Manifold and fixed points, in closed form
    Manifold,
    /// The exact symmetric orbit
    Orbit,
    /// Event-driven simulation
    Simulation,
}

impl From<Fidelity> for Method {
    fn from(asked: Fidelity) -> Self {
        match asked {
            Fidelity::Manifold => Self::Theory,
            Fidelity::Orbit => Self::ExactOrbit,
            Fidelity::Simulation => Self::Simulation,
        }
    }
}

/// Which layer answers what, if the case asks for accuracy or a layer is insisted on.
pub fn plan(case: &Case, forced: Option<Fidelity>) -> Result<Option<Plan>> {
    if case.accuracy.is_none() && forced.is_none() {
        return Ok(None);
    }
    let demand = case.accuracy.as_ref().map_or_else(AccuracyTarget::default, AccuracyTarget::of);
    Plan::of(&case.system(), demand, forced.map(Into::into)).map(Some).into_diagnostic()
}
