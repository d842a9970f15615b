//! What changed between two reports, or two sets of reports, as data: inputs, criteria, verdicts, numbers
//! beyond what they are known to, figures; what moved within that is counted. Reports that are out of date
//! are named.
//!
//! Pure: documents and figures come in as they were read, [`markdown`] writes down what comes out.

mod accuracy;
mod compare;
mod criteria;
mod document;
mod labels;
mod leaves;
pub mod markdown;
mod motion;
mod shown;
mod stale;

use std::collections::BTreeMap;

use serde::Serialize;

pub use accuracy::Basis;
pub use criteria::{CriterionChange, Found};
pub use document::{CaseFile, Document, Remedy};
pub use stale::{Reason, StaleReport};

/// Reports of one side, by the name of their folder.
pub type Reports = BTreeMap<String, Document>;

/// What changed between two sets of reports.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Difference {
    /// `vinesink/diff@1`.
    pub format: &'static str,
    /// What the old reports were called on the command line.
    pub old: String,
    /// The same of the new ones.
    pub new: String,
    /// Reports that their case, or this version of the program, would not give now.
    pub stale: Vec<StaleReport>,
    /// How many reports are on both sides.
    pub compared: usize,
    /// Reports on both sides that are not the same, by name.
    pub reports: Vec<ReportDifference>,
    /// Reports on the new side only.
    pub added: Vec<Summary>,
    /// Reports on the old side only.
    pub removed: Vec<Summary>,
}

/// A report that has nothing to be compared with.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// Its folder's name.
    pub name: String,
    /// Its title.
    pub title: String,
    /// Its verdict.
    pub headline: String,
}

/// What changed in one report.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReportDifference {
    /// Its case's name.
    pub name: String,
    /// Its folder below the one that was compared; empty where that is the report's own.
    pub folder: String,
    /// The new title.
    pub title: String,
    /// The new verdict.
    pub headline: String,
    /// What the case says.
    pub inputs: Vec<WordChange>,
    /// Criteria that flipped, moved, appeared or vanished.
    pub criteria: Vec<CriterionChange>,
    /// The report's verdict, and claims that were confirmed or refuted and no longer are.
    pub verdicts: Vec<WordChange>,
    /// Regimes, areas, stability and whatever else has a name and not a size, the most important first.
    pub states: Vec<WordChange>,
    /// Numbers beyond what they are known to, the most important first.
    pub numbers: Vec<NumberChange>,
    /// Figures whose drawing is not the same.
    pub figures: Vec<FigureChange>,
    /// What moved and means nothing.
    pub folded: Folded,
}

/// What a reviewer need not look at.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Folded {
    /// Numbers that moved within what they are known to.
    pub within: Vec<NumberChange>,
    /// Sentences about the above, and what comes and goes by chance.
    pub wording: Vec<WordChange>,
    /// How many values moved by chance, without a known error.
    pub unjudged: usize,
    /// How many values only one of two versions of the program writes.
    pub unknown: usize,
    /// How many values are the same.
    pub same: usize,
}

/// A word or a text; `None` where it is missing.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WordChange {
    /// What it says something about.
    pub what: String,
    /// Before.
    pub old: Option<String>,
    /// After.
    pub new: Option<String>,
}

/// A number; in the units of `report.json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NumberChange {
    /// What it measures.
    pub what: String,
    /// Where it stands in the document's `data`.
    pub path: String,
    /// Its unit, empty for a plain number.
    pub unit: &'static str,
    /// Before.
    pub old: f64,
    /// After.
    pub new: f64,
    /// New minus old; of an angle, the shorter way round.
    pub change: f64,
    /// The largest change that means nothing.
    pub allowed: f64,
    /// Why that one.
    pub basis: Basis,
}

/// A drawing.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct FigureChange {
    /// File stem under `figures/`.
    pub name: String,
    /// The figure's title.
    pub title: String,
    /// Whether it is there on the old side.
    pub in_old: bool,
    /// Whether it is there on the new side.
    pub in_new: bool,
}

impl Difference {
    /// Compares two sets of reports. One report on either side is compared whatever it is called.
    pub fn of(old: (&str, &Reports), new: (&str, &Reports)) -> Self {
        let ((old_label, old), (new_label, new)) = (old, new);
        let mut difference = Self {
            format: "vinesink/diff@1",
            old: old_label.to_owned(),
            new: new_label.to_owned(),
            stale: Vec::new(),
            compared: 0,
            reports: Vec::new(),
            added: Vec::new(),
            removed: Vec::new(),
        };
        let alone = |reports: &Reports| reports.len() == 1 && reports.contains_key("");
        if alone(old) && alone(new) {
            difference.add(&old[""], &new[""], "");
            return difference;
        }
        for (name, document) in old {
            match new.get(name) {
                Some(after) => difference.add(document, after, name),
                None => difference.removed.push(Summary::of(document, name)),
            }
        }
        for (name, document) in new.iter().filter(|(name, _)| !old.contains_key(*name)) {
            difference.stale.extend(stale::reasons("new", document));
            difference.added.push(Summary::of(document, name));
        }
        difference
    }

    fn add(&mut self, old: &Document, new: &Document, folder: &str) {
        self.compared += 1;
        self.stale.extend(stale::reasons("old", old));
        self.stale.extend(stale::reasons("new", new));
        let found = compare::reports(old, new, folder);
        if !found.is_same() {
            self.reports.push(found);
        }
    }

    /// Whether anything changed or is out of date that a reviewer must know: not figures alone, nor wording.
    pub fn is_significant(&self) -> bool {
        !self.stale.is_empty()
            || !self.added.is_empty()
            || !self.removed.is_empty()
            || self.reports.iter().any(ReportDifference::is_significant)
    }
}

impl ReportDifference {
    /// Whether a verdict, criterion, state, input or a number beyond its tolerance changed.
    pub fn is_significant(&self) -> bool {
        !(self.verdicts.is_empty()
            && self.criteria.is_empty()
            && self.states.is_empty()
            && self.inputs.is_empty()
            && self.numbers.is_empty())
    }

    fn is_same(&self) -> bool {
        let Folded { within, wording, unjudged, unknown, .. } = &self.folded;
        let moved = within.len() + wording.len() + unjudged + unknown;
        !self.is_significant() && self.figures.is_empty() && moved == 0
    }
}

impl Summary {
    fn of(document: &Document, name: &str) -> Self {
        Self {
            name: if name.is_empty() { document.name() } else { name }.to_owned(),
            title: document.text("title").to_owned(),
            headline: document.headline().to_owned(),
        }
    }
}
