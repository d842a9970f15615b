//! What changed between two reports, or two sets of reports, as data: inputs, criteria, verdicts, numbers
//! beyond their errors, figures; what moved within them is counted. Reports that are out of date are named.
//!
//! Pure: documents and figures come in as they were read, [`markdown`] writes down what comes out.
//!
//! For the program itself: this module may change at any time.

mod compare;
mod criteria;
mod document;
pub mod markdown;
mod moved;
mod reader;
mod renamed;

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;
use serde_json::{Value, json};

use crate::report::document::Word;

pub use document::{Cases, CurrentCase, Document, ListedCase, Remedy};

/// Reports of one side, by the name of their folder.
pub type Reports = BTreeMap<String, Document>;

/// What changed between two sets of reports.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Difference {
    /// `vinesink/diff@2`.
    pub format: &'static str,
    /// What the old reports were called on the command line.
    pub old: String,
    /// The same of the new ones.
    pub new: String,
    /// Reports that their case, or this version of the program, would not give now: the side, the `report.json`,
    /// the reason and what to do.
    pub stale: Vec<Value>,
    /// How many reports are on both sides and could be compared.
    pub compared: usize,
    /// How many reports the new side has, and how many of them were held to the text of their case.
    pub checked: [usize; 2],
    /// Whether the old side has commits that the new one lacks, so that they appear taken back.
    pub diverged: bool,
    /// Cases of the new side without a report, by the place of each.
    pub unreported: Vec<String>,
    /// Those of them that are not the same, the worst first: verdicts that flip, what else got worse, the rest by name.
    pub reports: Vec<ReportDifference>,
    /// Reports whose criteria fail on both sides, so that nothing flips: name and answer.
    pub failing: Vec<Value>,
    /// Reports on the new side only: name and answer.
    pub added: Vec<Value>,
    /// Reports on the old side only.
    pub removed: Vec<Value>,
}

/// What changed in one report.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct ReportDifference {
    /// The new report's name and answer.
    pub new: Value,
    /// The old one's.
    pub old: Value,
    /// Its folder below the one that was compared; empty where that is the report's own.
    pub folder: String,
    /// The folder on the old side where it has another name there: its case is the same, or most like it of those that are gone.
    pub renamed_from: Option<String>,
    /// The clearance by which the units of lengths are chosen, in m; none for a case in reduced units.
    pub clearance_m: Option<f64>,
    /// Whether the report's own verdict is another one.
    pub verdict: bool,
    /// What the case says.
    pub inputs: Vec<Change>,
    /// Criteria that flipped, moved, appeared or vanished: as they are in `report.json` on either side.
    pub criteria: Vec<Value>,
    /// Criteria that failed before too, and by as much.
    pub failing: Vec<Value>,
    /// Another kind of motion that decides: the worst over a band, or the main one.
    pub motion: Option<Change>,
    /// Claims that were confirmed or refuted and no longer are.
    pub claims: Vec<Change>,
    /// Regimes, areas, stability and whatever else has a name and not a size, the most important first.
    pub states: Vec<Change>,
    /// Quantities beyond their errors, the most important first.
    pub numbers: Vec<Change>,
    /// Figures whose drawing is not the same: name, title, and on which sides they are.
    pub figures: Vec<Value>,
    /// What moved and means nothing.
    pub folded: Folded,
}

/// What a reviewer need not look at: how many values there are of each sort.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Folded {
    /// Quantities that moved within their errors.
    pub within: usize,
    /// Sentences in which the numbers of the above stand, and motions that come and go by chance.
    pub wording: usize,
    /// Numbers that say how a result was found, and those that chance moves without a known error.
    pub unjudged: usize,
    /// Values that only one of two versions of the program writes.
    pub unknown: usize,
    /// Values that are the same.
    pub same: usize,
}

/// A value that is another one.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Change {
    /// What it is, for a reader.
    pub what: String,
    /// Where it stands in the document.
    pub path: String,
    /// Before: a quantity, word or flag as in `report.json`; null where there was none.
    pub old: Value,
    /// After.
    pub new: Value,
    /// Of two quantities: new minus old, relative where that is how people think of it; of an angle, the
    /// shorter way round. A quantity as well.
    pub change: Option<Value>,
    /// Of two quantities: the largest change that means nothing, in their unit.
    pub allowed: Option<f64>,
    /// Of a claim: what it says, which is told instead of its name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub statement: Option<Value>,
}

impl Difference {
    /// Compares two sets of reports. One report on either side is compared whatever it is called.
    pub fn of(old: (&str, &Reports), new: (&str, &Reports)) -> Self {
        let ((old_label, old), (new_label, new)) = (old, new);
        let mut difference = Self {
            format: "vinesink/diff@2",
            old: old_label.to_owned(),
            new: new_label.to_owned(),
            ..Self::default()
        };
        let renamed = renamed::pairs(old, new);
        for (name, document) in old.iter().filter(|(name, _)| !renamed.contains_key(name.as_str()))
        {
            match new.get(name) {
                Some(after) => difference.add(document, after, [name, name]),
                None => difference.removed.push(document.summary(name)),
            }
        }
        for (before, name) in &renamed {
            difference.add(&old[*before], &new[*name], [before, name]);
        }
        let is_known =
            |name: &String| old.contains_key(name) || renamed.values().any(|new| *new == name);
        for (name, document) in new.iter().filter(|(name, _)| !is_known(name)) {
            difference.stale.extend(document.stale("new"));
            difference.added.push(document.summary(name));
        }
        difference.stale.sort_by_key(document::reason);
        difference.reports.sort_by(|a, b| {
            let [(a_rank, a_worse), (b_rank, b_worse)] = [a, b].map(ReportDifference::severity);
            a_rank.cmp(&b_rank).then(b_worse.total_cmp(&a_worse)).then(a.folder.cmp(&b.folder))
        });
        difference
    }

    fn add(&mut self, old: &Document, new: &Document, [before, folder]: [&str; 2]) {
        self.stale.extend(old.stale("old"));
        self.stale.extend(new.stale("new"));
        if old.has_old_format() || new.has_old_format() {
            return;
        }
        self.compared += 1;
        let mut found = compare::reports(old, new, folder);
        found.renamed_from = (before != folder).then(|| before.to_owned());
        let fails = |of: &Value| of["criteria"][1].as_u64() > Some(0);
        if fails(&found.old) && fails(&found.new) {
            self.failing.push(found.new.clone());
        }
        let Folded { same, .. } = found.folded;
        let nothing = Folded { same, ..Folded::default() };
        if found.is_significant() || !found.figures.is_empty() || found.folded != nothing {
            self.reports.push(found);
        }
    }

    /// Holds the new side to its cases: a report has one, and a case that came or changed has a report. Where no case of
    /// either side is known, nothing is.
    /// `had` are the reports whose case the old side has.
    pub fn hold_to_cases(
        &mut self,
        (had, old_cases): (&BTreeSet<String>, &Cases),
        (reports, cases): (&Reports, &Cases),
    ) {
        let found = reports.values().filter(|report| report.case.is_some()).count();
        self.checked = [reports.len(), found];
        let mut renamed = Vec::new();
        for (name, report) in reports.iter().filter(|(_, report)| report.case.is_none()) {
            if found == 0 && cases.is_empty() && !had.contains(name) {
                continue;
            }
            let digest = report.case_digest();
            let same = cases.iter().find(|(_, case)| Some(&*case.sha256) == digest);
            let remedy = same.map_or(&report.remedy, |(_, case)| &case.remedy);
            let mut stale = remedy.stale("new", &report.place, "no-case");
            stale["name"] = json!(report.name());
            stale["case"] = json!(same.map(|(_, case)| &case.place));
            renamed.extend(same.map(|(name, _)| name));
            self.stale.push(stale);
        }
        let is_reported = |name: &String| {
            renamed.contains(&name) || reports.values().any(|report| report.name() == name)
        };
        for (name, case) in cases.iter().filter(|(name, _)| !is_reported(name)) {
            self.unreported.push(case.place.clone());
            let before = old_cases.get(name).map(|case| &case.sha256);
            if !old_cases.is_empty() && before != Some(&case.sha256) {
                self.stale.push(case.remedy.stale("new", &case.place, "no-report"));
            }
        }
        self.stale.sort_by_key(document::reason);
    }

    /// Whether anything changed or is out of date that a reviewer must know: not figures alone, nor wording.
    pub fn is_significant(&self) -> bool {
        !(self.stale.is_empty() && self.added.is_empty() && self.removed.is_empty())
            || self.reports.iter().any(ReportDifference::is_significant)
    }
}

impl ReportDifference {
    /// Whether a verdict, criterion, state, input or a number beyond its error changed.
    pub fn is_significant(&self) -> bool {
        let lists = [&self.inputs, &self.claims, &self.states, &self.numbers];
        let is_other = self.verdict || self.renamed_from.is_some() || !self.criteria.is_empty();
        is_other || lists.iter().any(|list| !list.is_empty())
    }

    /// Whether the answer is another word, or a criterion holds no longer or holds now.
    pub fn flips(&self) -> bool {
        self.words()[0] != self.words()[1] || self.criteria.iter().any(|one| one["flipped"] == true)
    }

    fn words(&self) -> [Option<Word>; 2] {
        let word = |of: &Value| serde_json::from_value(of["verdict"]["word"].clone()).ok();
        [&self.old, &self.new].map(word)
    }

    /// How soon a reviewer must see it, from 0, and within that how much worse a vibration has become at most, as a share.
    fn severity(&self) -> (u8, f64) {
        let [old, new] = self.words();
        let no_longer = |one: &Value| one["flipped"] == true && one["old"]["holds"] == true;
        let worse = self.numbers.iter().filter_map(Change::worse_by);
        let found = self.criteria.iter().filter_map(criteria::worse_by);
        let worse = worse.chain(found).fold(0.0, f64::max);
        let rank = match self.flips() {
            true if new > old || self.criteria.iter().any(no_longer) => 0,
            true => 1,
            false if self.verdict || !self.criteria.is_empty() => 2,
            false if worse > 0.0 => 3,
            false => 4,
        };
        (rank, worse)
    }
}
