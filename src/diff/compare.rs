//! One report against its earlier self.

use std::collections::BTreeSet;

use serde_json::Value;

use super::accuracy::{Allowance, ROUNDING, allowance, is_angle};
use super::leaves::{Leaf, Leaves, is_inside, key};
use super::{
    Document, FigureChange, Folded, NumberChange, ReportDifference, WordChange, criteria, labels,
    motion,
};
use crate::report::stored::BandPeaks;

/// Single words that only explain; sentences do so anyway.
const EXPLANATIONS: [&str; 5] = [
    "analysis/exact_boundaries/test_function",
    "analysis/format",
    "claims/source",
    "confirmations/best/other",
    "confirmations/upper_limit/lost/other",
];

/// What comes and goes with another value.
const RESTATED: [&str; 2] = ["analysis/exact_boundaries/bracket", "attractors/two_standard_errors"];

/// What the change of a report's own verdict is about.
pub(super) const VERDICT: &str = "verdict";

/// The kind of a note about a claim whose verdict says the same.
const REFUTED: &str = "refuted";

/// The verdict on a claim that is none to worry about where it comes or goes with the claim.
const CONFIRMED: &str = "confirmed";

/// What changed in a report that is on both sides.
pub(super) fn reports(old: &Document, new: &Document, folder: &str) -> ReportDifference {
    let (criteria, agreeing) = criteria::changes(old, new);
    let mut comparison = Comparison {
        physical: is_physical(new),
        found: ReportDifference {
            name: if folder.is_empty() { new.name() } else { folder }.to_owned(),
            folder: folder.to_owned(),
            title: new.text("title").to_owned(),
            headline: new.headline().to_owned(),
            inputs: inputs(old, new),
            criteria,
            verdicts: Vec::new(),
            states: Vec::new(),
            numbers: Vec::new(),
            figures: figures(old, new),
            folded: Folded { same: agreeing, ..Folded::default() },
        },
    };
    comparison.verdict(old, new);
    comparison.notes(old, new);
    comparison.band(old, new);
    comparison.main_motion(&old.report["data"], &new.report["data"]);
    let (old, new) = (leaves(old), leaves(new));
    comparison.elements(&old, &new, false);
    comparison.elements(&new, &old, true);
    comparison.values(&old, &new);
    comparison.one_sided(&old, &new, false);
    comparison.one_sided(&new, &old, true);
    let mut found = comparison.found;
    found.numbers.sort_by_key(|number| labels::rank(&key(&number.path)));
    found.states.sort_by_key(|state| labels::state_rank(&state.what));
    found
}

/// Every value behind a report's text.
fn leaves(document: &Document) -> Leaves<'_> {
    Leaves::of(&document.report["data"]).and("layers", &document.report["layers"]["data"])
}

/// Whether lengths are in metres: no input is a dimensionless one.
fn is_physical(document: &Document) -> bool {
    let rows = document.report["tables"]["inputs"]["rows"].as_array();
    rows.into_iter().flatten().all(|row| row[3] != "reduced")
}

/// Inputs that are not the same, in the new case's order.
fn inputs(old: &Document, new: &Document) -> Vec<WordChange> {
    let (old, new) = (old.inputs(), new.inputs());
    let value = |inputs: &[(String, String)], name: &str| {
        inputs.iter().find(|(found, _)| found == name).map(|(_, value)| value.clone())
    };
    let gone = old.iter().filter(|(name, _)| value(&new, name).is_none());
    let changes = new.iter().chain(gone).map(|(name, _)| WordChange {
        what: name.clone(),
        old: value(&old, name),
        new: value(&new, name),
    });
    changes.filter(|change| change.old != change.new).collect()
}

/// A change of something that is there on one side only.
fn on_one_side(what: String, word: &str, appeared: bool) -> WordChange {
    let word = Some(word.to_owned());
    let (old, new) = if appeared { (None, word) } else { (word, None) };
    WordChange { what, old, new }
}

/// A text without its numbers: the same sentence about another number is the same sentence.
fn letters(text: &str) -> String {
    text.chars().filter(|letter| letter.is_alphabetic()).collect()
}

struct Comparison {
    physical: bool,
    found: ReportDifference,
}

impl Comparison {
    /// The report's own verdict: its tone, and its headline where it says something else.
    fn verdict(&mut self, old: &Document, new: &Document) {
        let tone = |document: &Document| document.report["verdict"]["tone"].clone();
        if tone(old) != tone(new) || letters(old.headline()) != letters(new.headline()) {
            self.found.verdicts.push(WordChange {
                what: VERDICT.into(),
                old: Some(old.headline().to_owned()),
                new: Some(new.headline().to_owned()),
            });
        }
    }

    /// Notes that appear or vanish; one that says the same about another number does neither.
    fn notes(&mut self, old: &Document, new: &Document) {
        let notes = |document: &Document| -> Vec<(String, String)> {
            let text = |note: &Value, field: &str| note[field].as_str().unwrap_or("").to_owned();
            let notes = document.list("notes").iter();
            let notes = notes.map(|note| (text(note, "kind"), text(note, "text")));
            notes.filter(|(kind, _)| kind != REFUTED).collect()
        };
        let (old, new) = (notes(old), notes(new));
        for (here, there, appeared) in [(&old, &new, false), (&new, &old, true)] {
            let told: BTreeSet<String> = there.iter().map(|(_, text)| letters(text)).collect();
            for (kind, text) in here.iter().filter(|(_, text)| !told.contains(&letters(text))) {
                let note = format!("{kind}: {text}");
                self.found.states.push(on_one_side("note".into(), &note, appeared));
            }
        }
    }

    /// The worst peak along a band, which no value of the document says alone; a criterion that asks for it
    /// tells it as well.
    fn band(&mut self, old: &Document, new: &Document) {
        if self.found.criteria.iter().any(|criterion| criterion.name == BandPeaks::CRITERION) {
            return;
        }
        let worst = |document: &Document| BandPeaks::of(&document.report)?.absorber;
        if let (Some(old), Some(new)) = (worst(old), worst(new)) {
            let leaves = [&old, &new].map(|peak| serde_json::json!({ "error": peak.error }));
            let [before, after] = leaves.each_ref().map(|value| Leaf { value, element: value });
            self.number("band/worst_peak", (before, old.value), (after, new.value));
        }
    }

    /// The motion that the verdict is about, where it is another one than before: what it vibrates by is
    /// what a reviewer asks first. Where it is the same one, it is compared as all motions are.
    fn main_motion(&mut self, old: &Value, new: &Value) {
        let main = |data: &Value| {
            let motions = data["attractors"].as_array()?;
            let moving = motions.iter().find(|motion| motion["regime"] != "at-rest");
            moving.or(motions.first()).cloned()
        };
        let (Some(old), Some(new)) = (main(old), main(new)) else { return };
        if old["regime"] == new["regime"] {
            return;
        }
        let (before, after) = (shown(&old["regime"]), shown(&new["regime"]));
        let what = "main motion".to_owned();
        self.found.states.push(WordChange { what, old: before, new: after });
        for path in ["displacement/peak", "displacement/rms", "impacts_per_period"] {
            let leaf = |motion| Leaf { value: motion, element: motion };
            let value =
                |motion: &Value| motion.pointer(&format!("/{path}")).and_then(Value::as_f64);
            if let (Some(a), Some(b)) = (value(&old), value(&new)) {
                self.number(&format!("attractors[main]/{path}"), (leaf(&old), a), (leaf(&new), b));
            }
        }
    }

    /// Motions, orbits, boundaries, claims that only `here` has.
    fn elements(&mut self, here: &Leaves<'_>, there: &Leaves<'_>, appeared: bool) {
        for path in here.elements_missing_in(there) {
            let (what, element) = (labels::label(&path), here.elements[&path]);
            let verdict = element["verdict"].as_str();
            let change = on_one_side(what, verdict.unwrap_or("there"), appeared);
            let by_chance = key(&path) == "attractors" && motion::found_by_chance(element);
            let list = if verdict.is_some_and(|verdict| verdict != CONFIRMED) {
                &mut self.found.verdicts
            } else if by_chance || is_along_band(&path) {
                &mut self.found.folded.wording
            } else {
                &mut self.found.states
            };
            list.push(change);
        }
    }

    /// Every value that is on both sides.
    fn values(&mut self, old: &Leaves<'_>, new: &Leaves<'_>) {
        for (path, before) in &old.values {
            let Some(after) = new.values.get(path) else { continue };
            if before.value == after.value {
                self.found.folded.same += 1;
            } else if let (Some(a), Some(b)) = (before.value.as_f64(), after.value.as_f64()) {
                self.number(path, (*before, a), (*after, b));
            } else {
                self.word(path, *before, *after);
            }
        }
    }

    fn number(&mut self, path: &str, (before, a): (Leaf<'_>, f64), (after, b): (Leaf<'_>, f64)) {
        let key = key(path);
        let (allowed, basis) = match allowance(&key, before, after, a, b) {
            Allowance::Within(allowed, basis) if !is_along_band(path) => (allowed, basis),
            Allowance::Restated => return,
            _ => {
                self.found.folded.unjudged += 1;
                return;
            }
        };
        // An error of nought is that of a whole number of impacts; nothing is known better than rounding.
        let allowed = allowed.max(ROUNDING * a.abs().max(b.abs()));
        let change = if is_angle(&key) { around(b - a) } else { b - a };
        let (what, unit) = (labels::label(path), labels::unit(&key, self.physical));
        let path = path.to_owned();
        let moved = NumberChange { what, path, unit, old: a, new: b, change, allowed, basis };
        // A change that is no number would otherwise hide behind the comparison.
        let beyond = change.abs() > allowed || !change.is_finite();
        let Folded { within, .. } = &mut self.found.folded;
        if beyond { &mut self.found.numbers } else { within }.push(moved);
    }

    fn word(&mut self, path: &str, before: Leaf<'_>, after: Leaf<'_>) {
        let key = key(path);
        let numbers = [before, after].map(|leaf| leaf.value.as_f64());
        let mut by_chance = motion::is_chance(&key) || is_along_band(path);
        if let [Some(value), None] | [None, Some(value)] = numbers {
            // A number that appears or vanishes: as important as the number itself.
            match allowance(&key, before, after, value, value) {
                Allowance::Within(..) => {}
                Allowance::Unjudged => by_chance = true,
                Allowance::Restated => return,
            }
        }
        if by_chance {
            self.found.folded.unjudged += 1;
            return;
        }
        let (old, new) = (shown(before.value), shown(after.value));
        let mut what = labels::label(path);
        let sentence = [&old, &new].into_iter().flatten().any(|text| text.contains(' '));
        let list = if key == "claims/verdict" {
            what = after.element["statement"].as_str().map_or(what, str::to_owned);
            &mut self.found.verdicts
        } else if sentence || key.ends_with("/words") || EXPLANATIONS.contains(&key.as_str()) {
            &mut self.found.folded.wording
        } else {
            &mut self.found.states
        };
        list.push(WordChange { what, old, new });
    }

    /// Values that only `here` has: of elements that the other side lacks, which are told already; of
    /// something that the other side says is not there; or of a field that only one version of the
    /// program writes.
    fn one_sided(&mut self, here: &Leaves<'_>, there: &Leaves<'_>, appeared: bool) {
        let elements = here.elements_missing_in(there);
        for (path, leaf) in here.values.iter().filter(|(path, _)| !there.values.contains_key(*path))
        {
            let told = elements.iter().any(|element| is_inside(path, element));
            // Nothing here, something there: the other direction tells it.
            let nothing = leaf.value.is_null();
            if told || nothing && there.values.keys().any(|other| is_inside(other, path)) {
                continue;
            }
            let mut ends = path.match_indices(['/', '[']).map(|(end, _)| &path[..end]);
            let denied = |outer: &&str| there.values.get(*outer).is_some_and(|l| l.value.is_null());
            let Some(outer) = ends.find(denied) else {
                self.found.folded.unknown += 1;
                continue;
            };
            let change = on_one_side(labels::label(outer), "there", appeared);
            let states = &mut self.found.states;
            if !RESTATED.contains(&key(outer).as_str()) && !states.contains(&change) {
                states.push(change);
            }
        }
    }
}

/// Whether a path leads into a list along a band: places are added where the amplitude is largest, and
/// what the list says is summed up in shares, peaks and criteria.
fn is_along_band(path: &str) -> bool {
    path.starts_with("band/") && path.contains('[')
}

/// The shorter way round a circle.
fn around(angle: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    angle - turn * (angle / turn).round()
}

/// A value in words.
fn shown(value: &Value) -> Option<String> {
    match value {
        Value::Null => None,
        Value::Bool(true) => Some("yes".into()),
        Value::Bool(false) => Some("no".into()),
        Value::String(text) => Some(text.clone()),
        other => Some(other.to_string()),
    }
}

/// Drawings that are not the same, in the order of the report.
fn figures(old: &Document, new: &Document) -> Vec<FigureChange> {
    let title = |name: &str| {
        let mut listed = new.list("figures").iter().chain(old.list("figures"));
        let figure = listed.find(|figure| figure["name"] == name)?;
        figure["title"].as_str()
    };
    let order = |name: &str| new.list("figures").iter().position(|one| one["name"] == name);
    let names: BTreeSet<&String> = old.figures.keys().chain(new.figures.keys()).collect();
    let mut changed: Vec<&str> = names
        .into_iter()
        .filter(|name| old.figures.get(*name) != new.figures.get(*name))
        .map(String::as_str)
        .collect();
    changed.sort_by_key(|name| order(name).unwrap_or(usize::MAX));
    let change = |name: &str| FigureChange {
        name: name.to_owned(),
        title: title(name).unwrap_or(name).to_owned(),
        in_old: old.figures.contains_key(name),
        in_new: new.figures.contains_key(name),
    };
    changed.into_iter().map(change).collect()
}
