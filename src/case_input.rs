//! A case from its file, with the record that it names: the one way in for the program and for Python.
//!
//! For the program itself: this module may change at any time.

use std::path::{Path, PathBuf};

use crate::case::{Case, CaseError, ModalCase, ModesFile, Recording, is_modal, modes_file};
use crate::store::{self, CaseText, Reach, StoreError};

/// Why a case could not be read from its file.
#[derive(Debug, thiserror::Error)]
pub enum CaseInputError {
    /// Its file cannot be read.
    #[error(transparent)]
    File(#[from] StoreError),
    /// The file that it names cannot be read.
    #[error("{case}: the {what} cannot be read")]
    Named {
        /// What the file has: the record of its excitation, or its modes.
        what: &'static str,
        /// The case.
        case: String,
        /// Why.
        source: StoreError,
    },
    /// It is no case, or its record no record.
    #[error(transparent)]
    Case(#[from] CaseError),
}

/// A case of either kind.
#[derive(Debug, Clone)]
pub enum AnyCase {
    /// One mode and one absorber.
    One(Box<Case>),
    /// Several modes or absorbers.
    Several(Box<ModalCase>),
}

/// Reads a case file and the record that it names; its text beside the case.
///
/// # Errors
/// [`CaseInputError`]; also for a case of several modes or absorbers.
pub fn read(path: &Path, reach: Reach) -> Result<(Case, String), CaseInputError> {
    read_text(path, reach, |name, text, folder| parse(name, text, folder, reach))
}

/// The same of a case of either kind.
///
/// # Errors
/// [`CaseInputError`].
pub fn read_any(path: &Path, reach: Reach) -> Result<(AnyCase, String), CaseInputError> {
    read_text(path, reach, |name, text, folder| parse_any(name, text, folder, reach))
}

/// Reads a case of either kind from its text, and the files that it names below a folder.
///
/// # Errors
/// [`CaseInputError`].
pub fn parse_any(
    name: &str,
    text: &str,
    folder: &Path,
    reach: Reach,
) -> Result<AnyCase, CaseInputError> {
    Ok(match is_modal(text) {
        true => AnyCase::Several(Box::new(parse_several(name, text, folder, reach)?)),
        false => AnyCase::One(Box::new(parse(name, text, folder, reach)?)),
    })
}

/// Reads a case of several modes or absorbers from its text, and the file of its modes below a folder.
///
/// # Errors
/// [`CaseInputError`].
pub fn parse_several(
    name: &str,
    text: &str,
    folder: &Path,
    reach: Reach,
) -> Result<ModalCase, CaseInputError> {
    let read = |file: String| read_named(name, "file of its modes", &file, folder, reach);
    let modes = modes_file(text).map(read).transpose()?;
    let of = |(path, bytes): (PathBuf, Vec<u8>)| {
        ModesFile::of_bytes(&path.display().to_string(), &bytes)
    };
    let modes = modes.map(of).transpose()?;
    Ok(ModalCase::parse_with(name, text, modes)?)
}

/// Reads a file of modes, wherever it is.
///
/// # Errors
/// [`CaseInputError`] where it cannot be read, or is no text.
pub fn read_modes(path: &Path) -> Result<ModesFile, CaseInputError> {
    let (path, bytes) = store::read_named(Path::new(""), &path.to_string_lossy(), Reach::Anywhere)?;
    Ok(ModesFile::of_bytes(&path.display().to_string(), &bytes)?)
}

fn read_text<T>(
    path: &Path,
    reach: Reach,
    parse: impl Fn(&str, &str, &Path) -> Result<T, CaseInputError>,
) -> Result<(T, String), CaseInputError> {
    let CaseText { text, quotable } = store::read_case(path, reach)?;
    let name = path.display().to_string();
    let folder = path.parent().unwrap_or(Path::new(""));
    let case = parse(&name, &text, folder).map_err(|error| match error {
        CaseInputError::Case(error) if !quotable && error.name() == name => {
            let advice =
                "a link leads to it, so its lines are not shown; --allow-outside shows them";
            error.without_text("a case", advice).into()
        }
        other => other,
    })?;
    Ok((case, text))
}

/// Reads a case from its text, and the record that it names below a folder.
///
/// # Errors
/// [`CaseInputError`].
pub fn parse(name: &str, text: &str, folder: &Path, reach: Reach) -> Result<Case, CaseInputError> {
    let case = Case::parse(name, text)?;
    let Some(file) = case.recording.as_ref().and_then(Recording::file) else { return Ok(case) };
    let (path, samples) = read_named(name, "record of its excitation", file, folder, reach)?;
    Ok(case.with_record(&path.display().to_string(), samples)?)
}

/// The path and the bytes of a file that a case names, below its folder.
fn read_named(
    case: &str,
    what: &'static str,
    file: &str,
    folder: &Path,
    reach: Reach,
) -> Result<(PathBuf, Vec<u8>), CaseInputError> {
    let read = store::read_named(folder, file, reach);
    read.map_err(|source| CaseInputError::Named { what, case: case.to_owned(), source })
}
