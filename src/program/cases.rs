//! Where the cases of reports are.

use std::path::{Component, Path, PathBuf};

use crate::store;

/// Where cases usually are.
pub const CASES: &str = "cases";

/// Folders above a report in which its case is looked for: its own, that of all reports, the project's, and
/// one more.
const ABOVE: usize = 4;
/// How deep below a folder cases are looked for, and in how many folders at most.
const DEEP: usize = 3;
const MOST: usize = 4000;

/// The folders in which the case of a report is looked for first: `named`, or beside the reports and in `cases` of the working
/// folder.
pub fn folders(report: &Path, named: Option<&str>) -> Vec<PathBuf> {
    if let Some(named) = named {
        return vec![PathBuf::from(named)];
    }
    let above = report.ancestors().take(ABOVE);
    let mut folders: Vec<PathBuf> =
        above.flat_map(|folder| [folder.join(CASES), folder.to_owned()]).collect();
    folders.push(PathBuf::from(CASES));
    folders
}

/// Where else it may be, with the files of the folders in it: the working folder where the reports are in it, else the
/// repository that they are in; none where that is not known.
pub fn project(reports: &Path) -> Option<PathBuf> {
    let is_below = |part: Component| matches!(part, Component::Normal(_) | Component::CurDir);
    if reports.components().all(is_below) {
        return Some(PathBuf::new());
    }
    let is_repository = |folder: &&Path| folder.join(".git").exists();
    reports.ancestors().find(is_repository).map(Path::to_owned)
}

/// The files that may be cases of reports: those of their project. Reports that are elsewhere, as a review writes them, may be
/// of the cases of the working folder.
pub fn of_project(reports: &Path) -> Vec<PathBuf> {
    below(&project(reports).unwrap_or_default())
}

/// TOML files in a folder and in those below it, but for what is hidden and what links lead to; a folder that cannot be read
/// holds none. Those that are deeper come later.
pub fn below(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![(folder.to_owned(), 0)];
    let mut next = 0;
    while let Some((folder, depth)) = folders.get(next).cloned() {
        next += 1;
        let here = if folder == Path::new("") { Path::new(".") } else { &folder };
        let Ok(listing) = store::list(here) else { continue };
        let files = listing.files.iter().filter(|name| name.ends_with(".toml"));
        found.extend(files.map(|name| folder.join(name)));
        let inner = listing.folders.iter().map(|name| folder.join(name));
        let inner = inner.filter(|path| depth < DEEP && !path.is_symlink());
        let room = MOST.saturating_sub(folders.len());
        folders.extend(inner.map(|path| (path, depth + 1)).take(room));
    }
    found
}

/// The files of a list that may be the case of a name.
pub fn called<'a>(name: &str, all: &'a [PathBuf]) -> impl Iterator<Item = &'a PathBuf> {
    let file = format!("{name}.toml");
    all.iter().filter(move |path| path.file_name().is_some_and(|own| own == file.as_str()))
}

/// The case of a report in the working folder, by the name of the case; none where it is not found.
pub fn of_report(report: &Path, name: &str, project: &[PathBuf]) -> Option<PathBuf> {
    let file = format!("{name}.toml");
    let first = folders(report, None).into_iter().map(|folder| folder.join(&file));
    first.filter(|path| path.is_file()).chain(called(name, project).cloned()).next()
}

/// Whether a text may be a case: it has a title, and a table of a design.
pub fn is_case(text: &str) -> bool {
    let begins = |line: &str, word: &str| line.trim_start().starts_with(word);
    let design = ["[oscillator]", "[absorber]", "[[absorber]]", "[reduced", "[[mode]]", "[modes]"];
    text.lines().any(|line| begins(line, "title"))
        && text.lines().any(|line| design.iter().any(|table| begins(line, table)))
}
