//! Reading reports back: one, or every one below a folder.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::{StoreError, refused, text_of};

/// The file that makes a folder a report.
pub(super) const REPORT: &str = "report.json";

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
/// [`StoreError`] when something cannot be read, or a `report.json` is not text.
pub fn read_reports(path: &Path) -> Result<StoredReports, StoreError> {
    if path.is_file() {
        let folder = path.parent().unwrap_or(Path::new("."));
        return Ok(BTreeMap::from([(String::new(), read_report(path, folder)?)]));
    }
    let mut files = Vec::new();
    find(path, &mut files)?;
    files
        .into_iter()
        .map(|file| {
            let folder = file.parent().unwrap_or(path);
            let inside = folder.strip_prefix(path).unwrap_or(folder);
            let names: Vec<_> = inside.iter().map(|name| name.to_string_lossy()).collect();
            Ok((names.join("/"), read_report(&file, folder)?))
        })
        .collect()
}

fn find(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), StoreError> {
    let file = folder.join(REPORT);
    if file.is_file() {
        files.push(file);
        return Ok(());
    }
    for path in entries(folder)? {
        let hidden = path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
        // A link may lead back up.
        if path.is_dir() && !path.is_symlink() && !hidden {
            find(&path, files)?;
        }
    }
    Ok(())
}

fn entries(folder: &Path) -> Result<Vec<PathBuf>, StoreError> {
    let read = |cause| refused("read", folder, cause);
    let entries = std::fs::read_dir(folder).map_err(read)?;
    entries.map(|entry| entry.map(|entry| entry.path()).map_err(read)).collect()
}

fn read_report(file: &Path, folder: &Path) -> Result<StoredReport, StoreError> {
    let json = super::read_text(file)?;
    let mut figures = BTreeMap::new();
    for path in drawings(folder)? {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let bytes = std::fs::read(&path).map_err(|cause| refused("read", &path, cause))?;
        figures.insert(name, bytes);
    }
    Ok(StoredReport { place: file.display().to_string(), json, figures })
}

/// The drawings of a report's folder; none where there are none.
pub(super) fn drawings(folder: &Path) -> Result<Vec<PathBuf>, StoreError> {
    let folder = folder.join("figures");
    if !folder.is_dir() {
        return Ok(Vec::new());
    }
    let mut found = entries(&folder)?;
    found.retain(|path| path.extension().is_some_and(|extension| extension == "svg"));
    Ok(found)
}

/// Reports among files with paths relative to a folder.
///
/// # Errors
/// [`StoreError::NotUtf8`] for a `report.json` that is not text.
pub(super) fn group(
    root: &str,
    files: &BTreeMap<String, Vec<u8>>,
) -> Result<StoredReports, StoreError> {
    let mut reports = StoredReports::new();
    for (path, bytes) in files {
        let (folder, name) = path.rsplit_once('/').unwrap_or(("", path));
        if name != REPORT {
            continue;
        }
        let place = format!("{root}/{path}");
        let json = text_of(Path::new(&place), bytes.clone())?;
        let inside = if folder.is_empty() { String::new() } else { format!("{folder}/") };
        let drawing = |path: &str| {
            let name =
                path.strip_prefix(&inside)?.strip_prefix("figures/")?.strip_suffix(".svg")?;
            (!name.contains('/')).then(|| name.to_owned())
        };
        let drawings = files.iter();
        let figures = drawings.filter_map(|(path, bytes)| Some((drawing(path)?, bytes.clone())));
        let figures = figures.collect();
        reports.insert(folder.to_owned(), StoredReport { place, json, figures });
    }
    Ok(reports)
}
