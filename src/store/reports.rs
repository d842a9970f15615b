//! Reading reports back: one, or every one below a folder.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::reading::{self, FileKind, Reach, within};
use super::{StoreError, text_of};
use crate::digest::one_line_end;

/// The file that makes a folder a report.
pub(super) const REPORT: &str = "report.json";
/// The folder of its drawings, and how their names end.
const FIGURES: &str = "figures";
/// See [`FIGURES`].
pub(super) const DRAWING: &str = ".svg";

/// The files of a report, as they were read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StoredReport {
    /// Where its `report.json` is, for messages.
    pub place: String,
    /// The text of `report.json`.
    pub json: String,
    /// The drawings under `figures/`, by file stem.
    pub figures: BTreeMap<String, Vec<u8>>,
}

/// Reports by their folder below the one that was read, with `/` between names; a report that was
/// asked for itself has an empty name.
pub type StoredReports = BTreeMap<String, StoredReport>;

/// The report in a folder, or every report below it, or the one whose `report.json` this is. Folders
/// whose name begins with a point are passed over.
///
/// # Errors
/// [`StoreError`] when something cannot be read or a link leads out of the folder, or a `report.json` is not text.
pub fn read_reports(path: &Path, reach: Reach) -> Result<StoredReports, StoreError> {
    if path.is_file() {
        let folder = super::folder_of(path)?;
        let report = read_report(path, folder, folder, reach)?;
        return Ok(BTreeMap::from([(String::new(), report)]));
    }
    let mut files = Vec::new();
    find(path, &mut files)?;
    files
        .into_iter()
        .map(|file| {
            let folder = file.parent().unwrap_or(path);
            let inside = folder.strip_prefix(path).unwrap_or(folder);
            let names: Vec<_> = inside.iter().map(|name| name.to_string_lossy()).collect();
            Ok((names.join("/"), read_report(&file, folder, path, reach)?))
        })
        .collect()
}

fn find(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), StoreError> {
    let file = folder.join(REPORT);
    if file.is_file() {
        files.push(file);
        return Ok(());
    }
    for name in super::list(folder)?.folders {
        let path = folder.join(name);
        // A link may lead back up.
        if !path.is_symlink() {
            find(&path, files)?;
        }
    }
    Ok(())
}

/// The report of a folder below `root`.
fn read_report(
    file: &Path,
    folder: &Path,
    root: &Path,
    reach: Reach,
) -> Result<StoredReport, StoreError> {
    let read = |path: &Path| reading::read(&within(root, path, reach)?, FileKind::Other);
    let json = text_of(file, read(file)?)?;
    let mut figures = BTreeMap::new();
    for name in drawings(folder)? {
        // A checkout may end lines otherwise than the revision that it is compared with.
        let bytes = one_line_end(&read(&folder.join(FIGURES).join(&name))?).into_owned();
        figures.insert(name.strip_suffix(DRAWING).unwrap_or(&name).to_owned(), bytes);
    }
    Ok(StoredReport { place: file.display().to_string(), json, figures })
}

/// The file names of the drawings in a report's folder, sorted; none where there are none.
fn drawings(folder: &Path) -> Result<Vec<String>, StoreError> {
    let folder = folder.join(FIGURES);
    if !folder.is_dir() {
        return Ok(Vec::new());
    }
    let mut found = super::list(&folder)?.files;
    found.retain(|name| name.ends_with(DRAWING));
    Ok(found)
}

/// Reports among files with paths relative to a folder; as in a folder, names that begin with a point
/// are passed over.
///
/// # Errors
/// [`StoreError`] for a `report.json` that is not text.
pub(super) fn group(
    root: &str,
    files: &BTreeMap<String, Vec<u8>>,
) -> Result<StoredReports, StoreError> {
    let mut reports = StoredReports::new();
    for (path, bytes) in files {
        let (folder, name) = path.rsplit_once('/').unwrap_or(("", path));
        if name != REPORT || is_hidden(path) {
            continue;
        }
        let place = format!("{root}/{path}");
        let json = text_of(Path::new(&place), bytes.clone())?;
        let inside = if folder.is_empty() { String::new() } else { format!("{folder}/") };
        let drawing = |path: &str| {
            let path = path.strip_prefix(&inside)?.strip_prefix(FIGURES)?.strip_prefix('/')?;
            let name = path.strip_suffix(DRAWING)?;
            (!name.contains('/') && !is_hidden(name)).then(|| name.to_owned())
        };
        let drawings = files.iter();
        let figures = drawings
            .filter_map(|(path, bytes)| Some((drawing(path)?, one_line_end(bytes).into_owned())));
        let figures = figures.collect();
        reports.insert(folder.to_owned(), StoredReport { place, json, figures });
    }
    Ok(reports)
}

fn is_hidden(path: &str) -> bool {
    path.split('/').any(|name| name.starts_with('.'))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A folder and the same files out of a revision are read alike.
    #[test]
    fn reports_are_found_and_what_is_hidden_or_linked_is_passed_over() {
        let names = [
            "a/report.json",
            "a/figures/map.svg",
            "a/figures/.map.svg",
            "a/figures/map.png",
            "a/figures/deep/map.svg",
            "b/c/report.json",
            "b/c/more/report.json",
            ".hidden/report.json",
            "figures/map.svg",
        ];
        let files: BTreeMap<String, Vec<u8>> =
            names.iter().map(|name| ((*name).to_owned(), name.as_bytes().to_vec())).collect();
        let folder = tempfile::tempdir().expect("a folder");
        let written = files.iter().map(|(name, bytes)| (PathBuf::from(name), bytes.clone()));
        let output = super::super::Output::open(folder.path()).expect("a folder");
        output.add("", &written.collect()).expect("written");
        #[cfg(unix)]
        std::os::unix::fs::symlink("..", folder.path().join("b/up")).expect("a link");
        let read = read_reports(folder.path(), Reach::Folder).expect("readable");
        assert_eq!(read.keys().collect::<Vec<_>>(), ["a", "b/c"]);
        assert_eq!(read["a"].figures.keys().collect::<Vec<_>>(), ["map"]);
        assert_eq!(read["a"].figures["map"], b"a/figures/map.svg");
        let grouped = group("main:reports", &files).expect("text");
        let figures = |reports: &StoredReports, name: &str| reports[name].figures.clone();
        assert_eq!(figures(&grouped, "a"), figures(&read, "a"));
        assert!(!grouped.contains_key(".hidden"), "{:?}", grouped.keys());
    }
}
