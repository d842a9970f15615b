//! A folder of reports: what is written into it, and the index that is kept up to date beside them.

use std::collections::BTreeMap;
use std::path::Path;

use miette::{IntoDiagnostic, Result, WrapErr, miette};

use super::{case_file, cases, output};
use crate::report::index::{self, IndexedReport, OtherPage, Summary};
use crate::report::render::Files;
use crate::store::{self, Listing, Output, Reach};

/// Writes the index of a folder; a file of one of its names that is no index is left alone, and an error.
pub fn write_index(folder: &Path, reach: Reach) -> Result<()> {
    for name in [index::HTML, index::MARKDOWN] {
        if existing(folder, name)? == Some(false) {
            return Err(miette!(
                help = "rename it, or write the reports to a folder of their own",
                "{} is not an index and is left as it is",
                folder.join(name).display()
            ));
        }
    }
    write(folder, reach)
}

/// Writes the index of a folder anew where it has one; a file of that name that is none is left alone.
pub fn refresh(folder: &Path) -> Result<()> {
    let ours = |name| Ok::<_, miette::Report>(existing(folder, name)? != Some(false));
    let there = existing(folder, index::HTML)?.or(existing(folder, index::MARKDOWN)?);
    if there.is_none() || !ours(index::HTML)? || !ours(index::MARKDOWN)? {
        return Ok(());
    }
    write(folder, Reach::Folder).wrap_err("the index beside the reports is not up to date")
}

/// Adds files to the folder of a case's report in a folder of reports.
pub fn add_to_report(reports: &Path, case: &Path, files: &Files) -> Result<()> {
    Output::open(reports)?.add(case_file::name(case)?, files)?;
    refresh(reports)
}

/// Writes a page and its figures beside the reports of a folder, which is made where there is none.
pub fn write_page(reports: &Path, name: &str, files: &Files) -> Result<()> {
    Output::open(reports)?.add("", files)?;
    output::print_path(&reports.join(name))?;
    refresh(reports)
}

/// Whether a file is there, and if so, whether it is an index.
fn existing(folder: &Path, name: &str) -> Result<Option<bool>> {
    let text = store::read_text_if_there(&folder.join(name))?;
    Ok(text.map(|text| index::is_index(&text)))
}

fn write(folder: &Path, reach: Reach) -> Result<()> {
    // A folder that is not there has no index.
    store::list(folder)?;
    // Nobody writes a report between the reading of all and the writing of their index.
    let output = Output::open(folder)?;
    let Listing { files, folders } = store::list(folder)?;
    let members = members(folder, folders, reach)?;
    warn_of_letter_case(&members.iter().map(|one| one.name.clone()).collect::<Vec<_>>());
    if members.is_empty() {
        return Err(miette!(
            help = format!("write one with `vinesink report CASE --out {}`", folder.display()),
            "{} holds no report: no folder in it has a report.json",
            folder.display()
        ));
    }
    let pages = files.into_iter().filter(|name| name.ends_with(".md") && name != index::MARKDOWN);
    let others: Result<Vec<OtherPage>> = pages
        .map(|name| {
            let text = store::read_text_below(folder, name.as_ref(), reach)?;
            Ok(OtherPage::new(name, &text.unwrap_or_default()))
        })
        .collect();
    let files = index::files(members, others?).into_diagnostic();
    let files = files.wrap_err("a report is damaged, or not one of this version")?;
    Ok(output.add("", &files)?)
}

/// Says of names that differ by letter case alone: where files are not told apart by it, they are one folder.
pub fn warn_of_letter_case(names: &[String]) {
    let mut seen: BTreeMap<String, &String> = BTreeMap::new();
    for name in names {
        if let Some(other) = seen.insert(name.to_lowercase(), name) {
            output::complain(&format!(
                "`{other}` and `{name}` differ by letter case alone: on Windows and macOS one report overwrites the other; rename one"
            ));
        }
    }
}

/// The reports among some folders; a folder without one is something else.
fn members(folder: &Path, names: Vec<String>, reach: Reach) -> Result<Vec<IndexedReport>> {
    let mut members = Vec::new();
    let project = cases::of_project(folder);
    for name in names {
        let path = Path::new(&name).join("report.json");
        let Some(text) = store::read_text_below(folder, &path, reach)? else { continue };
        let summary = Summary::read(&folder.join(path).display().to_string(), &text)?;
        let files = store::list(&folder.join(&name))?.files;
        let orphan = cases::of_report(&folder.join(&name), &name, &project).is_none();
        members.push(IndexedReport { name, summary, files, orphan });
    }
    // Where no case is found, they are somewhere else.
    let is_known = members.iter().any(|one| !one.orphan);
    members.iter_mut().for_each(|one| one.orphan &= is_known);
    Ok(members)
}
