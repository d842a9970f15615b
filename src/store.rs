//! The one place that touches the file system. Files and folders appear whole or not at all.
//!
//! For the program itself: this module may change at any time.

use std::io::ErrorKind;
use std::path::Path;

use tempfile::Builder;

mod error;
mod folder;
mod git;
mod growing;
mod reading;
mod reports;
mod shards;

use error::refused;

pub use error::StoreError;
pub use folder::{Output, folder_below, read_folder, replace_folder};
pub use git::{
    branch_point, is_ancestor, name_of_ref, read_files_at, read_reports_at, toml_files_at,
};
pub use growing::Growing;
pub use reading::{CaseText, Reach, below, open, read_case, read_named, read_text};
pub use reports::{StoredReport, StoredReports, read_reports};
pub use shards::{Found, Shards, Sharing, Turn};

/// The bytes of a file as text.
///
/// # Errors
/// [`StoreError`] with the place of the first byte that is no UTF-8.
pub fn text_of(path: &Path, bytes: Vec<u8>) -> Result<String, StoreError> {
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let before = String::from_utf8_lossy(&error.as_bytes()[..at]).into_owned();
        let byte = error.as_bytes()[at];
        let line = 1 + before.matches('\n').count();
        let column = 1 + before.chars().rev().take_while(|c| *c != '\n').count();
        let message = format!(
            "{} is not UTF-8 text: line {line} holds the byte 0x{byte:02X} at column {column}",
            path.display()
        );
        StoreError::new(message, Some("save the file with the encoding UTF-8"))
    })
}

/// Refuses a path at which something is.
///
/// # Errors
/// [`StoreError`] where something is.
pub fn must_be_new(path: &Path) -> Result<(), StoreError> {
    if path.symlink_metadata().is_ok() { Err(exists(path)) } else { Ok(()) }
}

/// Refuses a file whose folder is not there, before work begins whose result is to be written to it.
///
/// # Errors
/// [`StoreError`] with the folder.
pub fn must_have_folder(path: &Path) -> Result<(), StoreError> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let Some(folder) = folder.filter(|folder| !folder.is_dir()) else { return Ok(()) };
    let message =
        format!("cannot write {}: there is no folder {}", path.display(), folder.display());
    Err(StoreError::new(message, Some("create the folder first, or name another file")))
}

fn exists(path: &Path) -> StoreError {
    let message = format!("{} exists already and is left as it is", path.display());
    StoreError::new(message, Some("choose another name, or remove the file first"))
}

/// Writes a file that must not exist yet, whole or not at all. Its folder must exist.
///
/// # Errors
/// [`StoreError`]; an existing file is left alone.
pub fn write_new(path: &Path, bytes: &[u8]) -> Result<(), StoreError> {
    // The rename below refuses as well; asking first spares a folder that cannot be written to
    // from hiding the better reason.
    must_be_new(path)?;
    let file = Growing::of(path, bytes)?.on_disk()?;
    file.persist_noclobber(path).map(drop).map_err(|error| match error.error.kind() {
        ErrorKind::AlreadyExists => exists(path),
        _ => refused("write", path, error.error),
    })
}

/// Writes a file whole or not at all, in place of an earlier one. Its folder must exist.
///
/// # Errors
/// [`StoreError`]; an earlier file is then unchanged.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), StoreError> {
    Growing::of(path, bytes)?.finish()
}

/// What a folder holds, by name; names that begin with a point are left out.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Listing {
    /// Names of its files, sorted.
    pub files: Vec<String>,
    /// Names of its folders, sorted.
    pub folders: Vec<String>,
}

/// Lists a folder.
///
/// # Errors
/// [`StoreError`] when it cannot be read, or a name is not UTF-8.
pub fn list(path: &Path) -> Result<Listing, StoreError> {
    let read = |cause| refused("read", path, cause);
    let mut listing = Listing::default();
    for entry in std::fs::read_dir(path).map_err(read)? {
        let entry = entry.map_err(read)?;
        let name = entry.file_name().into_string();
        let name = name.map_err(|_| {
            let message = format!("the name of {} is not UTF-8", entry.path().display());
            StoreError::new(message, Some("rename it"))
        })?;
        if name.starts_with('.') {
            continue;
        }
        let is_folder = entry.path().is_dir();
        if is_folder { &mut listing.folders } else { &mut listing.files }.push(name);
    }
    listing.files.sort();
    listing.folders.sort();
    Ok(listing)
}

/// Reads a UTF-8 text file whole, where there is one.
///
/// # Errors
/// As [`read_text`], except that a missing file is no error.
pub fn read_text_if_there(path: &Path) -> Result<Option<String>, StoreError> {
    let missing = [Some(ErrorKind::NotFound), Some(ErrorKind::NotADirectory)];
    match read_text(path) {
        Err(error) if missing.contains(&error.refusal) => Ok(None),
        read => read.map(Some),
    }
}

/// The same for a file that must be below a folder once links are followed.
///
/// # Errors
/// As [`read_text_if_there`], and where a link leads out of the folder.
pub fn read_text_below(
    folder: &Path,
    name: &Path,
    reach: Reach,
) -> Result<Option<String>, StoreError> {
    let path = folder.join(name);
    if path.exists() {
        read_text(&reading::within(folder, &path, reach)?).map(Some)
    } else {
        Ok(None)
    }
}

/// Whether two paths lead to the same file, which is there.
pub fn is_same_file(a: &Path, b: &Path) -> bool {
    let file = |path: &Path| std::fs::canonicalize(path).ok();
    file(a).is_some_and(|a| file(b) == Some(a))
}

/// How the names of files begin that are not whole yet.
const TEMPORARY: &str = ".vinesink-";

/// Temporary names that get the permissions of any other new file, not those of a secret.
fn ordinary(mode: u32) -> Builder<'static, 'static> {
    let mut builder = Builder::new();
    builder.prefix(TEMPORARY);
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(mode));
    #[cfg(not(unix))]
    let _ = mode;
    builder
}

/// The folder that holds `path`, which must name something in it.
fn folder_of(path: &Path) -> Result<&Path, StoreError> {
    match (path.file_name(), path.parent()) {
        (Some(_), Some(folder)) if folder == Path::new("") => Ok(Path::new(".")),
        (Some(_), Some(folder)) => Ok(folder),
        _ => Err(unusable(path)),
    }
}

fn unusable(path: &Path) -> StoreError {
    let message = format!("{} does not name a file inside a folder", path.display());
    StoreError::new(message, None)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;
    use std::path::PathBuf;

    use tempfile::TempDir;

    use super::*;

    pub fn folder() -> TempDir {
        tempfile::tempdir().expect("a temporary folder")
    }

    pub fn files(list: &[(&str, &str)]) -> BTreeMap<PathBuf, Vec<u8>> {
        list.iter().map(|(path, text)| (path.into(), text.as_bytes().to_vec())).collect()
    }

    pub fn names(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).expect("a folder");
        let mut names: Vec<String> = entries
            .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    pub fn is_refused<T>(result: &Result<T, StoreError>) -> bool {
        result.as_ref().is_err_and(|error| error.refusal.is_some())
    }

    #[test]
    fn a_file_is_replaced_only_when_asked() {
        let folder = folder();
        let path = folder.path().join("file");
        write_new(&path, b"1").expect("new");
        let message = write_new(&path, b"2").expect_err("it is there").message;
        assert!(message.ends_with("exists already and is left as it is"), "{message}");
        assert_eq!(read_text(&path).expect("text"), "1");
        write_file(&path, b"3").expect("replaced");
        assert_eq!(read_text(&path).expect("text"), "3");
        assert_eq!(names(folder.path()), ["file"]);
    }

    #[test]
    fn a_folder_is_listed_by_name() {
        let folder = folder();
        let content = [("b/x", ""), ("a/x", ""), ("z.md", "1"), (".hidden/x", ""), ("c.md", "")];
        Output::open(folder.path()).expect("a folder").add("", &files(&content)).expect("written");
        let listing = list(folder.path()).expect("a folder");
        assert_eq!(listing.folders, ["a", "b"]);
        assert_eq!(listing.files, ["c.md", "z.md"]);
        let read = |name| read_text_if_there(&folder.path().join(name)).expect("text or nothing");
        assert_eq!((read("z.md"), read("none")), (Some("1".into()), None));
        assert!(is_refused(&list(&folder.path().join("z.md"))));
    }

    #[test]
    fn bytes_that_are_no_text_are_located() {
        let folder = folder();
        let path = folder.path().join("file");
        write_new(&path, b"title\nb\xc3\xa9b\xe9").expect("new");
        let error = read_text(&path).expect_err("Latin-1 is not UTF-8");
        let place = "line 2 holds the byte 0xE9 at column 4";
        assert!(error.to_string().ends_with(place), "{error}");
        let missing = read_text(&folder.path().join("none")).expect_err("no such file");
        assert!(missing.to_string().starts_with("cannot read "), "{missing}");
    }
}
