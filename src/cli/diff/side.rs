//! One of the two sides that are compared: its reports, where they are, and the cases that they are about.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use miette::{Result, miette};
use vinesink::diff::{Cases, CurrentCase, Document, ListedCase, Remedy, Reports};
use vinesink::digest::file_sha256;
use vinesink::program::cases::{self, CASES};
use vinesink::program::output::word;
use vinesink::store::{self, Reach, StoredReport};

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
    /// The cases that are there, by name; also those that have no report.
    pub cases: Cases,
    /// Where the case of each report was found.
    paths: BTreeMap<String, PathBuf>,
    reach: Reach,
}

impl ComparedSide {
    /// Reads the reports of a folder or file, or of `folder` at a revision.
    pub fn read(argument: &str, folder: &str, reach: Reach) -> Result<Self> {
        let path = Path::new(argument);
        if path.exists()
            && let Some(name) = store::name_of_ref(argument)
        {
            let written = if argument == "HEAD" { "HEAD^0" } else { &name };
            return Err(miette!(
                help =
                    format!("write ./{argument} for what is there, or {written} for the revision"),
                "`{argument}` is a file or folder here, and a revision that git knows"
            ));
        }
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
        let reports = reports.collect::<Result<_>>()?;
        let (cases, paths) = (Cases::new(), BTreeMap::new());
        Ok(Self { reports, place, address, folder, revision, cases, paths, reach })
    }

    /// Whether it is one report, and not a folder of them.
    pub fn is_one_report(&self) -> bool {
        self.reports.contains_key("")
    }

    /// The reports whose case was found.
    pub fn with_cases(&self) -> BTreeSet<String> {
        let found = self.reports.iter().filter(|(_, report)| report.case.is_some());
        found.map(|(name, _)| name.clone()).collect()
    }

    /// Whether the case of any report was found.
    pub fn has_cases(&self) -> bool {
        self.reports.values().any(|report| report.case.is_some())
    }

    /// Looks for the case of every report: in the folder `named` and those below it, or beside the reports, in `cases` of the
    /// working folder, and at last anywhere in the project; and for the files that the case reads. A report whose case is not
    /// there stays without.
    ///
    /// # Errors
    /// Where a file or the revision cannot be read.
    pub fn find_cases(&mut self, named: Option<&str>) -> Result<()> {
        let mut wanted = Vec::new();
        for (name, report) in &self.reports {
            let file = format!("{}.toml", report.name());
            for folder in cases::folders(&self.folder.join(name), named) {
                wanted.push((name.clone(), folder.join(&file)));
            }
        }
        self.take_cases(wanted, false)?;
        let project = self.toml_files(named)?;
        for everywhere in [false, true] {
            let mut wanted = Vec::new();
            for (name, report) in self.reports.iter().filter(|(_, one)| one.case.is_none()) {
                let folders = cases::folders(&self.folder.join(name), named);
                let usual = |path: &Path| {
                    let mut usual = folders.iter().filter(|folder| folder.ends_with(CASES));
                    usual.any(|folder| path.starts_with(folder))
                };
                let own = cases::called(report.name(), &project);
                let own = own.filter(|path| everywhere || usual(path));
                wanted.extend(own.map(|path| (name.clone(), path.clone())));
            }
            self.take_cases(wanted, true)?;
        }
        for (name, report) in self.reports.iter_mut().filter(|(_, one)| one.case.is_none()) {
            let case = Path::new(named.unwrap_or(CASES)).join(format!("{}.toml", report.name()));
            report.remedy = remedy(&case, &self.folder.join(name), &self.revision);
        }
        self.find_files()?;
        self.list_cases(named, &project)
    }

    /// Gives reports without a case the first of theirs that is there; of several of equal rank, as those `anywhere` are, one of
    /// another text than the report's if there is any: nobody knows which is meant, and a copy of before must hide no change.
    fn take_cases(&mut self, wanted: Vec<(String, PathBuf)>, anywhere: bool) -> Result<()> {
        let texts = self.read_files(wanted.iter().map(|(_, path)| path))?;
        let digests = texts.into_iter().map(|text| text.map(|text| file_sha256(&text)));
        let mut found: Vec<_> = wanted.into_iter().zip(digests).collect();
        if anywhere {
            found.sort_by_key(|((name, _), digest)| {
                self.reports[name].case_digest() == digest.as_deref()
            });
        }
        for ((name, path), digest) in found {
            let place = self.object(&path);
            let Some(report) = self.reports.get_mut(&name) else { continue };
            if let (Some(digest), None) = (digest, &report.case) {
                report.remedy = remedy(&path, &self.folder.join(&name), &self.revision);
                report.case = Some(CurrentCase { place, sha256: digest, ..CurrentCase::default() });
                self.paths.insert(name, path);
            }
        }
        Ok(())
    }

    /// Reads the files that cases read as they are now.
    fn find_files(&mut self) -> Result<()> {
        let mut wanted = Vec::new();
        for (name, report) in &self.reports {
            let folder = self.paths.get(name).and_then(|path| path.parent());
            for file in folder.iter().flat_map(|_| report.files_read()) {
                wanted.push((name.clone(), file));
            }
        }
        let path = |(name, file): &(String, String)| {
            self.paths[name].parent().map_or(PathBuf::from(file), |folder| folder.join(file))
        };
        let paths: Vec<PathBuf> = wanted.iter().map(path).collect();
        let digests: Vec<Option<String>> = match &self.revision {
            Some(_) => {
                let read = self.read_files(paths.iter())?;
                read.into_iter().map(|bytes| bytes.map(|bytes| file_sha256(&bytes))).collect()
            }
            None => {
                let read = |path: &PathBuf, (name, file): &(String, String)| {
                    let folder = self.paths[name].parent().unwrap_or(Path::new(""));
                    let read = store::read_named(folder, file, self.reach);
                    // What is out of reach is as good as not there.
                    read.ok().filter(|_| path.exists()).map(|(_, bytes)| file_sha256(&bytes))
                };
                paths.iter().zip(&wanted).map(|(path, wanted)| read(path, wanted)).collect()
            }
        };
        for ((name, file), digest) in wanted.into_iter().zip(digests) {
            let case = self.reports.get_mut(&name).and_then(|report| report.case.as_mut());
            case.into_iter().for_each(|case| _ = case.files.insert(file.clone(), digest.clone()));
        }
        Ok(())
    }

    /// Lists the cases in the folders in which cases of reports are, or are usually beside them.
    fn list_cases(&mut self, named: Option<&str>, project: &[PathBuf]) -> Result<()> {
        let mut folders: BTreeSet<PathBuf> =
            self.paths.values().filter_map(|path| path.parent().map(Path::to_owned)).collect();
        match named {
            Some(named) => _ = folders.insert(PathBuf::from(named)),
            None => folders.extend(self.folder.ancestors().map(|folder| folder.join(CASES))),
        }
        let is_in = |path: &&PathBuf| path.parent().is_some_and(|folder| folders.contains(folder));
        let paths: Vec<&PathBuf> = project.iter().filter(is_in).collect();
        let texts = self.read_files(paths.iter().copied())?;
        for (path, text) in paths.into_iter().zip(texts) {
            let name = path.file_stem().map(|name| name.to_string_lossy().into_owned());
            let text = text.filter(|text| cases::is_case(&String::from_utf8_lossy(text)));
            if let (Some(name), Some(text)) = (name, text) {
                let (place, out) = (self.object(path), self.folder.join(&name));
                let remedy = remedy(path, &out, &self.revision);
                self.cases.insert(name, ListedCase { place, sha256: file_sha256(&text), remedy });
            }
        }
        Ok(())
    }

    /// All TOML files of the project, or of the folder that was named.
    fn toml_files(&self, named: Option<&str>) -> Result<Vec<PathBuf>> {
        let Some((commit, before)) = &self.revision else {
            return Ok(match named {
                Some(named) => cases::below(Path::new(named)),
                None => cases::of_project(&self.folder),
            });
        };
        let all = store::toml_files_at(commit, !before.ends_with("./"))?;
        let is_wanted = |path: &PathBuf| named.is_none_or(|named| path.starts_with(named));
        Ok(all.into_iter().map(PathBuf::from).filter(is_wanted).collect())
    }

    /// What a path is called: that within the revision, if it is of one.
    fn object(&self, path: &Path) -> String {
        let before = self.revision.as_ref().map_or("", |(_, before)| before);
        format!("{before}{}", path.display())
    }

    fn read_files<'p>(
        &self,
        wanted: impl Iterator<Item = &'p PathBuf>,
    ) -> Result<Vec<Option<Vec<u8>>>> {
        if self.revision.is_some() {
            // A line end within a name would begin another one.
            let name = |path: &PathBuf| self.object(path).replace('\n', "\u{fffd}");
            let names: Vec<String> = wanted.map(name).collect();
            return Ok(store::read_files_at(&names)?);
        }
        let read = |path: &PathBuf| Ok(store::read_text_if_there(path)?.map(String::into_bytes));
        wanted.map(read).collect()
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

fn remedy(case: &Path, report: &Path, revision: &Option<(String, String)>) -> Remedy {
    let out = report.parent().filter(|out| *out != Path::new("")).unwrap_or(Path::new("."));
    let [case, out] = [case, out].map(|path| word(&path.display().to_string()));
    let command = format!("vinesink report {case} --out {out}");
    Remedy { command, revision: revision.as_ref().map(|(commit, _)| commit.clone()) }
}
