//! One of the two sides that are compared: its reports, where they are, and the cases that they are about.

use std::path::{Path, PathBuf};

use miette::Result;
use vinesink::diff::{CurrentCase, Document, Remedy, Reports};
use vinesink::digest::sha256;
use vinesink::program::output::word;
use vinesink::store::{self, Reach, StoredReport};

/// Folders above a report in which its case is looked for: its own, that of all reports, the project's, and
/// one more.
const ABOVE: usize = 4;

/// One of the two that are compared.
pub struct ComparedSide {
    pub reports: Reports,
    /// Where they were looked for, for messages.
    pub place: String,
    /// Where figures are, if they are files.
    pub address: Option<String>,
    /// The folder of the reports; within the revision, if they are of one.
    folder: PathBuf,
    /// The revision, with what stands before a path in it.
    revision: Option<(String, String)>,
}

impl ComparedSide {
    /// Reads the reports of a folder or file, or of `folder` at a revision.
    pub fn read(argument: &str, folder: &str, reach: Reach) -> Result<Self> {
        let path = Path::new(argument);
        let (stored, place, address, revision) = if path.exists() {
            let folder = if path.is_file() { path.parent() } else { None };
            let address = folder.unwrap_or(path).display().to_string();
            let address = if address.is_empty() { ".".to_owned() } else { address };
            (store::read_reports(path, reach)?, format!("`{argument}`"), Some(address), None)
        } else {
            let place = format!("`{folder}` at `{argument}`");
            let commit = argument.split_once(':').map_or(argument, |(commit, _)| commit);
            // A folder that the revision brings counts from the repository's root.
            let root = if commit == argument { "./" } else { "" };
            let revision = (commit.to_owned(), format!("{commit}:{root}"));
            (store::read_reports_at(argument, folder)?, place, None, Some(revision))
        };
        let folder = match (&address, argument.split_once(':')) {
            (Some(address), _) => address,
            (None, Some((_, folder))) => folder,
            (None, None) => folder,
        };
        let folder = PathBuf::from(folder.trim_end_matches("report.json"));
        let document = |StoredReport { place, json, figures }: StoredReport| {
            Document::parse(&place, &json, figures)
        };
        let reports = stored.into_iter().map(|(name, report)| Ok((name, document(report)?)));
        Ok(Self { reports: reports.collect::<Result<_>>()?, place, address, folder, revision })
    }

    /// Whether it is one report, and not a folder of them.
    pub fn is_one_report(&self) -> bool {
        self.reports.contains_key("")
    }

    /// Whether the case of any report was found.
    pub fn has_cases(&self) -> bool {
        self.reports.values().any(|report| report.case.is_some())
    }

    /// Looks for the case of every report: in the folder `named`, or beside the reports and in `cases` of
    /// the working folder. A report whose case is not there stays without.
    ///
    /// # Errors
    /// Where a file or the revision cannot be read.
    pub fn find_cases(&mut self, named: Option<&str>) -> Result<()> {
        let mut wanted = Vec::new();
        for (name, report) in &self.reports {
            let file = format!("{}.toml", report.name());
            for folder in self.case_folders(&self.folder.join(name), named) {
                wanted.push((name.clone(), folder.join(&file)));
            }
        }
        let texts = self.read_files(&wanted)?;
        for ((name, path), text) in wanted.into_iter().zip(texts) {
            let Some(report) = self.reports.get_mut(&name) else { continue };
            if let (Some(text), None) = (text, &report.case) {
                let place = path.display().to_string();
                let before = self.revision.as_ref().map_or("", |(_, before)| before);
                let place = format!("{before}{place}");
                report.case = Some(CurrentCase { place, sha256: sha256(&text) });
                report.remedy = remedy(&path, &self.folder.join(&name), &self.revision);
            }
        }
        for (name, report) in self.reports.iter_mut().filter(|(_, one)| one.case.is_none()) {
            let case = Path::new(named.unwrap_or(CASES)).join(format!("{}.toml", report.name()));
            report.remedy = remedy(&case, &self.folder.join(name), &self.revision);
        }
        Ok(())
    }

    fn case_folders(&self, report: &Path, named: Option<&str>) -> Vec<PathBuf> {
        if let Some(named) = named {
            return vec![PathBuf::from(named)];
        }
        let above = report.ancestors().take(ABOVE);
        let mut folders: Vec<PathBuf> =
            above.flat_map(|folder| [folder.join(CASES), folder.to_owned()]).collect();
        folders.push(PathBuf::from(CASES));
        folders
    }

    fn read_files(&self, wanted: &[(String, PathBuf)]) -> Result<Vec<Option<Vec<u8>>>> {
        let Some((_, before)) = &self.revision else {
            let read = |(_, path): &(String, PathBuf)| {
                let text = store::read_text_if_there(path)?;
                Ok(text.map(String::into_bytes))
            };
            return wanted.iter().map(read).collect();
        };
        let name = |(_, path): &(String, PathBuf)| format!("{before}{}", path.display());
        Ok(store::read_files_at(&wanted.iter().map(name).collect::<Vec<_>>())?)
    }

    /// Does not hold reports to a case that is the newer report's: an earlier version of a design, which
    /// its case is no longer, is what a comparison is for.
    pub fn forget_cases_of(&mut self, newer: &Self) {
        for (name, report) in &mut self.reports {
            let case = |report: &Document| report.case.as_ref().map(|case| case.place.clone());
            let newer = newer.reports.get(name).and_then(case);
            let own = case(report).zip(newer);
            if own.is_none_or(|(a, b)| a == b || store::is_same_file(a.as_ref(), b.as_ref())) {
                report.case = None;
            }
        }
    }
}

/// Where cases usually are.
const CASES: &str = "cases";

fn remedy(case: &Path, report: &Path, revision: &Option<(String, String)>) -> Remedy {
    let out = report.parent().filter(|out| *out != Path::new("")).unwrap_or(Path::new("."));
    let [case, out] = [case, out].map(|path| word(&path.display().to_string()));
    let command = format!("vinesink report {case} --out {out}");
    Remedy { command, revision: revision.as_ref().map(|(commit, _)| commit.clone()) }
}
