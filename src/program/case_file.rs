//! Reading the case that a command is given.

use std::path::{Component, Path};

use clap::Args;
use miette::{NamedSource, Report, Result, miette};

use super::output;
use crate::case::{Case, Problem, nearest};
use crate::case_input::{self, AnyCase, CaseInputError};
use crate::store::{self, Reach};

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

/// The case file in the folder of a path at which there is none whose name is closest to it.
fn beside(path: &Path) -> Option<String> {
    let name = path.file_name().filter(|_| !path.exists())?.to_string_lossy().into_owned();
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let there = store::list(folder.unwrap_or(Path::new("."))).ok()?;
    let names = there.files.iter().map(String::as_str).filter(|name| name.ends_with(".toml"));
    let names: Vec<&str> = names.collect();
    let whole = format!("{name}.toml");
    let without_ending = names.contains(&whole.as_str()).then_some(whole.as_str());
    without_ending.or_else(|| nearest(&name, &names)).map(str::to_owned)
}

/// Reads a case file of either kind; its text beside the case. What is probably a slip in it is said on standard error.
pub fn read_any(path: &Path, reading: Reading) -> Result<(AnyCase, String)> {
    let (case, text) = read_even_at_rest(path, reading)?;
    if let AnyCase::One(case) = &case {
        must_move(path, case)?;
    }
    Ok((case, text))
}

/// Refuses a structure that is let go from 0, of which there is nothing to say.
fn must_move(path: &Path, case: &Case) -> Result<()> {
    match case.design.release() {
        Some(release) if release.is_rest() => Err(miette!(
            help = "write `displacement` or `velocity` above 0; `vinesink simulate --initial` flies an absorber that is kicked",
            "{}: nothing sets the oscillator in motion",
            path.display()
        )),
        _ => Ok(()),
    }
}

/// The same where a start is given beside the case, so that nothing in it need set anything in motion.
pub fn read_even_at_rest(path: &Path, reading: Reading) -> Result<(AnyCase, String)> {
    let read = case_input::read_any(path, reading.reach());
    let (case, text) = read.map_err(|error| refused(path, error))?;
    match &case {
        AnyCase::One(case) => warn(path, case.warnings(), &text),
        AnyCase::Several(case) => warn(path, &case.warnings, &text),
    }
    Ok((case, text))
}

/// The same of a case of one mode and one absorber.
pub fn read_with_text(path: &Path, reading: Reading) -> Result<(Case, String)> {
    let read = case_input::read(path, reading.reach());
    let (case, text) = read.map_err(|error| refused(path, error))?;
    must_move(path, &case)?;
    warn(path, case.warnings(), &text);
    Ok((case, text))
}

/// Why a case file could not be read.
fn refused(path: &Path, error: CaseInputError) -> Report {
    match error {
        CaseInputError::Case(error) => Report::new(error),
        CaseInputError::Named { what, source, .. } => {
            Report::new(source).wrap_err(format!("{}: the {what} cannot be read", path.display()))
        }
        CaseInputError::File(error) => match beside(path) {
            Some(other) => {
                let help = format!("did you mean {}?", path.with_file_name(other).display());
                miette!(help = help, "{error}")
            }
            None => Report::new(error),
        },
    }
}

/// Says what is probably a slip.
fn warn(path: &Path, warnings: &[Problem], text: &str) {
    let name = path.display().to_string();
    let visible = text.strip_prefix('\u{feff}').unwrap_or(text);
    for warning in warnings {
        let source = NamedSource::new(&name, visible.to_owned());
        let shown = Report::new(warning.clone()).with_source_code(source);
        output::complain_of(&shown);
    }
}
