//! The one place that touches the file system. Files and folders appear whole or not at all.

use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::{Component, Path, PathBuf};

use tempfile::{Builder, TempDir};

mod error;
mod git;
mod growing;
mod reports;
mod shards;

use error::refused;

pub use error::StoreError;
pub use git::{read_files_at, read_reports_at};
pub use growing::Growing;
pub use reports::{StoredReport, StoredReports, read_reports};
pub use shards::Shards;

/// Reads a UTF-8 text file whole.
///
/// # Errors
/// [`StoreError`] when it cannot be read or is not text.
pub fn read_text(path: &Path) -> Result<String, StoreError> {
    text_of(path, std::fs::read(path).map_err(|cause| refused("read", path, cause))?)
}

/// Opens a file for reading.
///
/// # Errors
/// [`StoreError`] when it cannot be read.
pub fn open(path: &Path) -> Result<std::fs::File, StoreError> {
    std::fs::File::open(path).map_err(|cause| refused("read", path, cause))
}

/// The bytes of a file as text.
fn text_of(path: &Path, bytes: Vec<u8>) -> Result<String, StoreError> {
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

/// As [`write_file`], into a folder that is made where there is none.
///
/// # Errors
/// [`StoreError`]; an earlier file is then unchanged.
pub fn write_file_and_folder(path: &Path, bytes: &[u8]) -> Result<(), StoreError> {
    make_folder_of(path)?;
    write_file(path, bytes)
}

/// Makes the folder of a path where there is none.
fn make_folder_of(path: &Path) -> Result<(), StoreError> {
    let folder = folder_of(path)?;
    std::fs::create_dir_all(folder).map_err(|cause| refused("create", folder, cause))
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

/// Whether two paths lead to the same file, which is there.
pub fn is_same_file(a: &Path, b: &Path) -> bool {
    let file = |path: &Path| std::fs::canonicalize(path).ok();
    file(a).is_some_and(|a| file(b) == Some(a))
}

/// Replaces what is `ours` in a folder, which may be missing, by `files` (paths relative to it, as those
/// that `ours` is asked about). The new folder is written beside the old one, the files of others are
/// taken along, and it takes the old one's place when it is complete: on any failure the old one stays
/// as it was, and no file of ours outlives the ones it belonged to.
///
/// # Errors
/// [`StoreError`] for a path that leads out of the folder, or when something cannot be written, moved or
/// removed.
pub fn replace_folder(
    path: &Path,
    files: &BTreeMap<PathBuf, Vec<u8>>,
    ours: fn(&Path) -> bool,
) -> Result<(), StoreError> {
    stay_inside(files)?;
    if path.exists() && !path.is_dir() {
        return Err(refused("replace", path, ErrorKind::NotADirectory.into()));
    }
    make_folder_of(path)?;
    let new = temporary_folder(path)?;
    for (file, bytes) in files {
        let file = new.path().join(file);
        make_folder_of(&file)?;
        std::fs::write(&file, bytes).map_err(|cause| refused("write", &file, cause))?;
    }
    for file in files_below(path)?.into_iter().filter(|file| !ours(file)) {
        take_along(&path.join(&file), &new.path().join(file))?;
    }
    swap(path, new)
}

/// Puts a file also where another one is to be, unless there is one.
fn take_along(from: &Path, to: &Path) -> Result<(), StoreError> {
    if to.is_file() {
        return Ok(());
    }
    make_folder_of(to)?;
    // The same file under a second name, until the first one is removed; not every file system can.
    let taken = std::fs::hard_link(from, to).or_else(|_| std::fs::copy(from, to).map(drop));
    taken.map_err(|cause| refused("keep", from, cause))
}

/// The files of a folder and of those in it, relative to it; none where there is no such folder.
fn files_below(path: &Path) -> Result<Vec<PathBuf>, StoreError> {
    let (mut files, mut folders) = (Vec::new(), vec![PathBuf::new()]);
    while let Some(inside) = folders.pop() {
        let folder = path.join(&inside);
        if !folder.is_dir() {
            continue;
        }
        let read = |cause| refused("read", &folder, cause);
        for entry in std::fs::read_dir(&folder).map_err(read)? {
            let entry = entry.map_err(read)?;
            // A link to a folder is the link that it is.
            let is_folder = entry.file_type().map_err(read)?.is_dir();
            if is_folder { &mut folders } else { &mut files }.push(inside.join(entry.file_name()));
        }
    }
    Ok(files)
}

/// Reads what is `ours` in a folder, by its path in it; nothing where there is no such folder.
///
/// # Errors
/// [`StoreError`] when something is there and cannot be read.
pub fn read_folder(
    path: &Path,
    ours: fn(&Path) -> bool,
) -> Result<BTreeMap<PathBuf, Vec<u8>>, StoreError> {
    let files = files_below(path)?.into_iter().filter(|file| ours(file));
    let read = |file: PathBuf| {
        let bytes = std::fs::read(path.join(&file));
        Ok((file.clone(), bytes.map_err(|cause| refused("read", &path.join(file), cause))?))
    };
    files.map(read).collect()
}

/// Adds `files` (paths relative to it) to a folder, which may be missing, each whole or not at all;
/// files of the same name are replaced, all others stay.
///
/// # Errors
/// [`StoreError`] for a path that leads out of the folder, or when something cannot be written.
pub fn add_to_folder(path: &Path, files: &BTreeMap<PathBuf, Vec<u8>>) -> Result<(), StoreError> {
    stay_inside(files)?;
    for (file, bytes) in files {
        write_file_and_folder(&path.join(file), bytes)?;
    }
    Ok(())
}

/// Moves the old folder aside, the new one in, and the old one back should that fail.
fn swap(path: &Path, new: TempDir) -> Result<(), StoreError> {
    let replace = |cause| refused("replace", path, cause);
    let aside = temporary_folder(path)?;
    let old = aside.path().join("old");
    let had_old = match std::fs::rename(path, &old) {
        Ok(()) => true,
        Err(cause) if cause.kind() == ErrorKind::NotFound => false,
        Err(cause) => return Err(replace(cause)),
    };
    if let Err(cause) = std::fs::rename(new.path(), path) {
        if had_old && std::fs::rename(&old, path).is_err() {
            // The old folder could not go back: keep it where it is rather than delete it.
            let _ = aside.keep();
        }
        return Err(replace(cause));
    }
    let _ = new.keep();
    aside.close().map_err(|cause| refused("remove the earlier", path, cause))
}

fn temporary_folder(path: &Path) -> Result<TempDir, StoreError> {
    let folder = folder_of(path)?;
    ordinary(0o777).tempdir_in(folder).map_err(|cause| refused("write in", folder, cause))
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

/// Refuses paths that lead out of the folder that they are relative to.
fn stay_inside(files: &BTreeMap<PathBuf, Vec<u8>>) -> Result<(), StoreError> {
    let stays = |file: &Path| {
        let mut components = file.components().peekable();
        components.peek().is_some() && components.all(|part| matches!(part, Component::Normal(_)))
    };
    files.keys().find(|file| !stays(file)).map_or(Ok(()), |outside| Err(unusable(outside)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder() -> TempDir {
        tempfile::tempdir().expect("a temporary folder")
    }

    fn files(list: &[(&str, &str)]) -> BTreeMap<PathBuf, Vec<u8>> {
        list.iter().map(|(path, text)| (path.into(), text.as_bytes().to_vec())).collect()
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).expect("a folder");
        let mut names: Vec<String> = entries
            .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    fn is_refused<T>(result: &Result<T, StoreError>) -> bool {
        result.as_ref().is_err_and(|error| error.refusal.is_some())
    }

    fn is_txt(file: &Path) -> bool {
        file.extension().is_some_and(|extension| extension == "txt")
    }

    #[test]
    fn what_is_ours_in_a_folder_is_replaced_whole() {
        let folder = folder();
        let target = folder.path().join("reports/case");
        let old = [("a.txt", "1"), ("figures/b.txt", "2"), ("gone/c.txt", "3")];
        replace_folder(&target, &files(&old), is_txt).expect("written");
        assert_eq!(names(&target), ["a.txt", "figures", "gone"]);
        assert_eq!(read_text(&target.join("figures/b.txt")).expect("text"), "2");
        let others = [("d.md", "4"), ("figures/e.svg", "5"), (".keep", ""), ("f/g/h", "6")];
        add_to_folder(&target, &files(&others)).expect("added");
        #[cfg(unix)]
        std::os::unix::fs::symlink("nowhere", target.join("link")).expect("a link");
        replace_folder(&target, &files(&[("a.txt", "7")]), is_txt).expect("written again");
        let mut left = names(&target);
        left.retain(|name| name != "link");
        assert_eq!(left, [".keep", "a.txt", "d.md", "f", "figures"]);
        assert_eq!(names(&target.join("figures")), ["e.svg"]);
        for (name, text) in [("a.txt", "7"), ("d.md", "4"), ("figures/e.svg", "5"), ("f/g/h", "6")]
        {
            assert_eq!(read_text(&target.join(name)).expect("text"), text, "{name}");
        }
        #[cfg(unix)]
        assert!(target.join("link").is_symlink());
        // A new file wins over one of the same name that was not ours.
        replace_folder(&target, &files(&[("d.md", "8")]), is_txt).expect("written");
        assert_eq!(read_text(&target.join("d.md")).expect("text"), "8");
        assert_eq!(names(&folder.path().join("reports")), ["case"]);
    }

    #[test]
    fn a_folder_that_cannot_be_written_keeps_the_old_one() {
        let folder = folder();
        let target = folder.path().join("case");
        replace_folder(&target, &files(&[("a/b", "1")]), |_| true).expect("written");
        // A file cannot also be a folder.
        let error = replace_folder(&target, &files(&[("x", "1"), ("x/y", "2")]), |_| true);
        assert!(is_refused(&error), "{error:?}");
        for outside in ["../b", "/b", "", "a/../../b"] {
            let error = replace_folder(&target, &files(&[(outside, "1")]), |_| true);
            let message = error.expect_err(outside).message;
            assert!(message.contains("does not name a file inside a folder"), "{message}");
        }
        // What is to be kept would stand where something else is to be.
        for new in ["a", "a/b/c"] {
            let error = replace_folder(&target, &files(&[(new, "2"), ("z", "3")]), |_| false);
            assert!(is_refused(&error), "{new}: {error:?}");
        }
        let error = replace_folder(&target.join("a/b"), &files(&[("b", "1")]), |_| true);
        assert!(is_refused(&error), "a file is no folder: {error:?}");
        assert_eq!(names(folder.path()), ["case"]);
        assert_eq!(names(&target), ["a"]);
        assert_eq!(read_text(&target.join("a/b")).expect("text"), "1");
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
        add_to_folder(folder.path(), &files(&content)).expect("written");
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
