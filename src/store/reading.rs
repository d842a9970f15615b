//! The gate through which files are read: regular ones alone, of a bounded size; and where somebody else may have
//! written the path or the link that leads to one, only what lies in its folder.

use std::fs::{self, File, Metadata};
use std::io::{ErrorKind, Read as _};
use std::path::{Path, PathBuf};

use super::error::{StoreError, refused};
use super::{folder_of, text_of};

/// How far a path that a case holds, or a link, may lead.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reach {
    /// To what lies in the folder of the case or the reports, or below it.
    Folder,
    /// To any regular file, and messages may quote it.
    Anywhere,
}

/// The text of a case file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CaseText {
    /// The text.
    pub text: String,
    /// Whether messages may quote it: not where a link leads to it, which may stand for any file.
    pub quotable: bool,
}

/// What a file is read as, which bounds its size.
#[derive(Debug, Clone, Copy)]
pub(super) enum FileKind {
    Case,
    Record,
    Results,
    Other,
}

impl FileKind {
    /// Most MiB: a case has a few kB, and one with ten thousand values in lists a hundred; a record of 64 has three
    /// million samples, whose flights take longer than what is ordinary; a chunk of a sweep that follows motions has
    /// 16 lines of at most a million points; the largest report has less than one.
    fn most(self) -> u64 {
        match self {
            Self::Case => 1,
            Self::Record | Self::Other => 64,
            Self::Results => 4096,
        }
    }

    /// Whether a file may have so many bytes; if not, why it is not read.
    pub(super) fn allows(self, bytes: u64) -> Result<(), String> {
        match bytes > self.most() << 20 {
            true => Err(format!("has more than {} MiB and is not read", self.most())),
            false => Ok(()),
        }
    }

    fn advice(self) -> &'static str {
        match self {
            Self::Case => {
                "name a case file; long lists of values can be written as ends and a count"
            }
            Self::Record => "cut the record into shorter ones, or sample it less often",
            Self::Results | Self::Other => {
                "look what it is: no file that the program writes is so large"
            }
        }
    }
}

/// Opens a regular file for reading.
///
/// # Errors
/// [`StoreError`] when it cannot be read or is something else.
pub fn open(path: &Path) -> Result<File, StoreError> {
    let refused = |cause| refused("read", path, cause);
    let regular = |metadata: Metadata| match metadata {
        file if file.is_file() => Ok(()),
        folder if folder.is_dir() => Err(refused(ErrorKind::IsADirectory.into())),
        _ => {
            let message = format!("{} is no regular file and is not read", path.display());
            Err(StoreError::new(
                message,
                Some("write what comes from a pipe or a device to a file"),
            ))
        }
    };
    // Before, for to open a pipe waits for who writes to it; and after, when it may have been replaced.
    regular(fs::metadata(path).map_err(refused)?)?;
    let file = File::open(path).map_err(refused)?;
    regular(file.metadata().map_err(refused)?)?;
    Ok(file)
}

/// Reads a regular file whole.
pub(super) fn read(path: &Path, kind: FileKind) -> Result<Vec<u8>, StoreError> {
    let mut bytes = Vec::new();
    let mut file = open(path)?.take((kind.most() << 20) + 1);
    file.read_to_end(&mut bytes).map_err(|cause| refused("read", path, cause))?;
    match kind.allows(bytes.len() as u64) {
        Ok(()) => Ok(bytes),
        Err(why) => Err(StoreError::new(format!("{} {why}", path.display()), Some(kind.advice()))),
    }
}

/// Reads a UTF-8 text file whole.
///
/// # Errors
/// [`StoreError`] when it cannot be read, is no regular file, is too large or is not text.
pub fn read_text(path: &Path) -> Result<String, StoreError> {
    text_of(path, read(path, FileKind::Other)?)
}

/// Reads a case file.
///
/// # Errors
/// As [`read_text`], and where a link leads out of its folder.
pub fn read_case(path: &Path, reach: Reach) -> Result<CaseText, StoreError> {
    let file = within(folder_of(path)?, path, reach)?;
    let quotable = reach == Reach::Anywhere || !is_linked(path);
    Ok(CaseText { text: text_of(path, read(&file, FileKind::Case)?)?, quotable })
}

/// Reads a file that a case in `folder` names, with the path that messages give it: bytes, for what writes records and modes often
/// writes no UTF-8.
///
/// # Errors
/// [`StoreError`] when it cannot be read, is no regular file or is too large, and where it is not below the folder.
pub fn read_named(
    folder: &Path,
    name: &str,
    reach: Reach,
) -> Result<(PathBuf, Vec<u8>), StoreError> {
    let path = folder.join(name);
    let folder = if folder == Path::new("") { Path::new(".") } else { folder };
    let bytes = read(&within(folder, &path, reach)?, FileKind::Record)?;
    Ok((path, bytes))
}

/// The path of a file from a folder in which it is, or below which; none of one elsewhere.
///
/// # Errors
/// [`StoreError`] where there is no such file or folder.
pub fn below(folder: &Path, file: &Path) -> Result<Option<PathBuf>, StoreError> {
    let real = |path: &Path| fs::canonicalize(path).map_err(|cause| refused("read", path, cause));
    let folder = if folder == Path::new("") { Path::new(".") } else { folder };
    let (folder, file) = (real(folder)?, real(file)?);
    Ok(file.strip_prefix(&folder).ok().map(Path::to_owned))
}

/// The file that a path leads to, which must be below a folder unless all are in reach.
pub(super) fn within(folder: &Path, path: &Path, reach: Reach) -> Result<PathBuf, StoreError> {
    let real = |path: &Path| fs::canonicalize(path).map_err(|cause| refused("read", path, cause));
    if reach == Reach::Anywhere {
        return Ok(path.to_owned());
    }
    let file = real(path)?;
    if file.starts_with(real(folder)?) {
        return Ok(file);
    }
    let message = format!("{} leads out of the folder {}", path.display(), folder.display());
    let advice = "copy the file into that folder; --allow-outside reads it where it is";
    Err(StoreError::new(message, Some(advice)))
}

/// Whether a path is a link, or leads through one below the working folder, which is where other people's files are.
fn is_linked(path: &Path) -> bool {
    let here = std::env::current_dir().unwrap_or_default();
    let below = path.strip_prefix(&here).unwrap_or(path);
    let folders = if below.is_absolute() { 1 } else { usize::MAX };
    below.ancestors().take(folders).any(Path::is_symlink)
}
