//! Folders that are written into: what appears in them appears whole or not at all, through no link, and while nobody
//! else writes.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::ErrorKind;
use std::path::{Component, Path, PathBuf};

use tempfile::TempDir;

use super::error::{StoreError, linked, refused};
use super::reading::{self, FileKind};
use super::{folder_of, ordinary, unusable, write_file};

/// A folder that somebody named to be written into. Others who would write into it through this type wait until this
/// value is gone, with its process at the latest; where a file system knows no locks, nobody waits.
///
/// The folder itself may be a link. Nothing below it is written through one: whoever filled it, as a repository that was
/// checked out, does not say what else is written to.
pub struct Output {
    root: PathBuf,
    _lock: Option<File>,
}

impl Output {
    /// Opens a folder, which is made where there is none, once nobody else writes into it.
    ///
    /// # Errors
    /// [`StoreError`] where it cannot be made.
    pub fn open(root: &Path) -> Result<Self, StoreError> {
        let root = if root == Path::new("") { Path::new(".") } else { root };
        std::fs::create_dir_all(root).map_err(|cause| refused("create", root, cause))?;
        let lock = lockable(root).filter(|file| file.lock().is_ok());
        Ok(Self { root: root.to_owned(), _lock: lock })
    }

    /// Adds `files` to the folder `inside` of it, which may be missing (paths relative to that), each whole or not at
    /// all; files of the same name are replaced, all others stay.
    ///
    /// # Errors
    /// [`StoreError`] for a path that leads out of the folder or through a link, or when something cannot be written.
    pub fn add(
        &self,
        inside: impl AsRef<Path>,
        files: &BTreeMap<PathBuf, Vec<u8>>,
    ) -> Result<(), StoreError> {
        stay_inside(files)?;
        for (file, bytes) in files {
            let file = inside.as_ref().join(file);
            let folder = folder_below(&self.root, file.parent().unwrap_or(Path::new("")))?;
            write_file(&folder.join(file.file_name().unwrap_or_default()), bytes)?;
        }
        Ok(())
    }

    /// Replaces what is `ours` in the folder `name` of it, which may be missing, by `files` (paths relative to that, as
    /// those that `ours` is asked about). The new folder is written beside the old one, the files of others are taken
    /// along, and it takes the old one's place when it is complete: on any failure the old one stays as it was, and no
    /// file of ours outlives the ones it belonged to.
    ///
    /// # Errors
    /// [`StoreError`] for a path that leads out of the folder or through a link, or when something cannot be written,
    /// moved or removed.
    pub fn replace(
        &self,
        name: impl AsRef<Path>,
        files: &BTreeMap<PathBuf, Vec<u8>>,
        ours: fn(&Path) -> bool,
    ) -> Result<(), StoreError> {
        stay_inside(files)?;
        let path = self.root.join(name);
        if path.is_symlink() {
            return Err(linked(&path));
        }
        if path.exists() && !path.is_dir() {
            return Err(refused("replace", &path, ErrorKind::NotADirectory.into()));
        }
        let new = temporary_folder(&path)?;
        for (file, bytes) in files {
            let file = new.path().join(file);
            make_folder_of(&file)?;
            std::fs::write(&file, bytes).map_err(|cause| refused("write", &file, cause))?;
        }
        for file in files_below(&path)?.into_iter().filter(|file| !ours(file)) {
            take_along(&path.join(&file), &new.path().join(file))?;
        }
        swap(&path, new)
    }
}

/// What stands for a folder where it is locked: a folder can be locked like a file, but for Windows.
pub(super) fn lockable(folder: &Path) -> Option<File> {
    let file = match cfg!(unix) {
        true => File::open(folder),
        false => File::create(folder.join(".vinesink-lock")),
    };
    file.ok()
}

/// As [`Output::replace`], of a folder that was named itself.
///
/// # Errors
/// As there.
pub fn replace_folder(
    path: &Path,
    files: &BTreeMap<PathBuf, Vec<u8>>,
    ours: fn(&Path) -> bool,
) -> Result<(), StoreError> {
    let led_to = path.is_symlink().then(|| path.canonicalize().ok()).flatten();
    let path = led_to.as_deref().unwrap_or(path);
    Output::open(folder_of(path)?)?.replace(path.file_name().unwrap_or_default(), files, ours)
}

/// The folder `inside` of another one, both made where they are missing; the other one may be a link, nothing below it.
///
/// # Errors
/// [`StoreError`] where a link is in the way, or a folder cannot be made.
pub fn folder_below(root: &Path, inside: &Path) -> Result<PathBuf, StoreError> {
    let make = |folder: &Path| {
        std::fs::create_dir_all(folder).map_err(|cause| refused("create", folder, cause))
    };
    let mut folder = root.to_owned();
    make(root)?;
    for part in inside {
        folder.push(part);
        if folder.is_symlink() {
            return Err(linked(&folder));
        }
        make(&folder)?;
    }
    Ok(folder)
}

/// Makes the folder of a path in a folder that nobody else knows.
fn make_folder_of(path: &Path) -> Result<(), StoreError> {
    let folder = folder_of(path)?;
    std::fs::create_dir_all(folder).map_err(|cause| refused("create", folder, cause))
}

/// Puts a file also where another one is to be, unless there is one.
fn take_along(from: &Path, to: &Path) -> Result<(), StoreError> {
    if to.is_file() {
        return Ok(());
    }
    if from.is_symlink() && to.is_dir() {
        return Err(linked(from));
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
    let read =
        |file: PathBuf| Ok((file.clone(), reading::read(&path.join(file), FileKind::Other)?));
    files.map(read).collect()
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
    use super::super::read_text;
    use super::super::tests::{files, folder, is_refused, names};
    use super::*;

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
        let reports = Output::open(&folder.path().join("reports")).expect("a folder");
        reports.add("case", &files(&others)).expect("added");
        drop(reports);
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
}
