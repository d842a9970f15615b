//! One report against its earlier self.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Value, json};

use super::document::Given;
use super::moved::{Moved, ROUNDING, alike, is_quantity, kind, moved};
use super::reader::{label, over, sorted, without_elements};
use super::{Change, Document, Folded, ReportDifference, criteria};
use crate::motions::wilson;

/// Elements of a list from which on it is told as one where the other side has none.
const MANY: usize = 8;

/// What has a way of its own; all else is compared value by value. Of these it is compared which fields there are.
const APART: [&str; 12] = [
    "asked",
    "case",
    "criteria",
    "files",
    "format",
    "inputs",
    "main",
    "name",
    "provenance",
    "source",
    "title",
    "verdict",
];

/// Keys of counts that say how a result was found, follow from where a run happened to end or from other values, or are an
/// index.
const NOT_JUDGED: [&str; 10] = [
    "attracting",
    "captures",
    "found",
    "lost",
    "numerics",
    "only_here",
    "operations",
    "several",
    "starts",
    "wider",
];

/// Whether this says what a claim is about, and why it is judged so: its numbers and verdict are told.
fn explains(path: &str, key: &str) -> bool {
    path.starts_with("claims") && ["statement", "outcome", "reason"].contains(&key)
}

/// What names an element of a list, by the list's key; elements of others are numbered.
const NATURAL_KEYS: [(&str, &[&str]); 14] = [
    ("alternatives", &["which", "drift", "dampers"]),
    ("answers", &["question"]),
    ("boundaries", &["kind", "branch"]),
    ("claims", &["id"]),
    ("derived", &["name"]),
    ("doubts", &["kind"]),
    ("figures", &["name"]),
    ("holds_for", &["parameter", "load", "absorber"]),
    ("manifolds", &["absorber"]),
    ("motions", &["regime"]),
    ("notes", &["kind", "limit", "message"]),
    ("ranges", &["parameter", "load", "absorber"]),
    ("rows", &["deviation"]),
    ("theory", &["mode"]),
];

/// Lists that are counted, as those along a band are: what they say stands in its worst values,
/// criteria and limits.
const COUNTED: [&str; 11] = [
    "compared",
    "loads/at_worst",
    "band/decides",
    "loads/decides",
    "loads/forces/at",
    "loads/forces/limits/fails",
    "loads/forces/limits/open",
    "loads/forces/steps",
    "loads/forces/working",
    "loads/motions",
    "loads/places",
];

/// What changed in a report that is on both sides.
pub(super) fn reports(old: &Document, new: &Document, folder: &str) -> ReportDifference {
    let (criteria, agreeing) = criteria::changes(old, new);
    let failing = agreeing.iter().filter(|one| one["holds"] == false).cloned().collect();
    let clearance = &new.report["quantities"]["clearance"]["value"];
    let said = |document: &Document| {
        let verdict = &document.report["verdict"];
        ["tone", "word", "headline", "band", "reason"].map(|field| verdict[field].clone())
    };
    let found = ReportDifference {
        new: new.summary(folder),
        old: old.summary(folder),
        folder: folder.to_owned(),
        clearance_m: clearance.as_f64().filter(|_| new.report["units"] != "reduced"),
        verdict: said(old) != said(new),
        inputs: inputs(old, new),
        criteria,
        states: main_motion(old, new).into_iter().collect(),
        figures: figures(old, new),
        failing,
        motion: deciding_motion(old, new),
        folded: Folded { same: agreeing.len(), ..Folded::default() },
        ..ReportDifference::default()
    };
    let [given, renumbered] = [Vec::new(), Vec::new()];
    let mut comparison = Comparator { old, new, found, given, renumbered };
    comparison.fields("", &old.report, &new.report);
    let mut found = sorted(comparison.ended());
    // What a criterion is over is a part of its name.
    let has_band = new.report["band"].is_object();
    let sides = found.criteria.iter_mut().flat_map(|one| {
        let sides = one.as_object_mut().into_iter().flat_map(|one| one.iter_mut());
        sides.filter(|(side, _)| *side == "old" || *side == "new").map(|(_, one)| one)
    });
    for one in sides.chain(&mut found.failing).filter(|one| one.is_object()) {
        one["over_band"] = json!(has_band);
    }
    for one in found.numbers.iter_mut().chain(&mut found.states) {
        one.what += over(&one.path, &new.report);
    }
    found
}

fn change(path: &str, old: &Value, new: &Value) -> Change {
    let known = kind(new).or_else(|| kind(old));
    // A quantity that this version's catalogue does not have is a number.
    let shown = |one: &Value| match one {
        _ if is_quantity(one) && kind(one).is_none() => one["value"].clone(),
        _ => one.clone(),
    };
    Change {
        what: label(path, known),
        path: path.to_owned(),
        old: shown(old),
        new: shown(new),
        ..Change::default()
    }
}

/// Inputs that are not the same, in the new case's order; each name once, for what the case says may be known in two ways.
fn inputs(old: &Document, new: &Document) -> Vec<Change> {
    let whole = old.has_whole_case() && new.has_whole_case();
    let [old, new] = [old, new].map(|document| document.inputs(whole));
    let values = |of: &[Given]| -> BTreeMap<String, Value> {
        of.iter().map(|one| (one.path.clone(), one.value.clone())).collect()
    };
    let [before, after] = [values(&old), values(&new)];
    let gone = old.iter().filter(|one| !after.contains_key(&one.path));
    let same = |old: &Value, new: &Value| {
        is_same(old, new) || is_given(old) && moved(old, new) == Moved::Within
    };
    let mut told = BTreeSet::new();
    let change = |one: &Given| {
        let [old, new] = [&before, &after].map(|of| of.get(&one.path).unwrap_or(&Value::Null));
        let differs = !same(old, new) && told.insert(one.name.clone());
        // As a case file has it: true, not yes.
        let shown = |value: &Value| match value {
            Value::Bool(_) | Value::Number(_) | Value::Array(_) => json!(value.to_string()),
            other => other.clone(),
        };
        let change = || change(&one.path, &shown(old), &shown(new));
        differs.then(|| Change { what: one.name.clone(), ..change() })
    };
    new.iter().chain(gone).filter_map(change).collect()
}

/// The regime of the motion that most starts lead to, where it is another one.
fn main_motion(old: &Document, new: &Document) -> Option<Change> {
    let [old, new] = [old, new].map(|document| {
        let main = document.report["main"].as_u64().unwrap_or(u64::MAX);
        document.report["motions"].get(main as usize).map_or(&Value::Null, |one| &one["regime"])
    });
    (old != new).then(|| change("main", old, new))
}

/// Another kind of motion that decides: the worst over a band or of all loads; else the main one.
fn deciding_motion(old: &Document, new: &Document) -> Option<Change> {
    let [before, after] = [old, new].map(|document| {
        let report = &document.report;
        match &report["worst"]["rests"] {
            Value::Bool(true) => json!("every absorber at rest"),
            Value::Bool(false) => json!("an absorber that hits its walls"),
            _ => report["band"]["worst"]["regime"].clone(),
        }
    });
    let has_both = !before.is_null() && !after.is_null();
    let what =
        if new.report["band"].is_object() { "worst motion over the band" } else { "worst motion" };
    let worst = || Change { what: what.to_owned(), ..change("worst", &before, &after) };
    if has_both { (before != after).then(worst) } else { main_motion(old, new) }
}

/// Drawings that are not the same, in the order of the report.
fn figures(old: &Document, new: &Document) -> Vec<Value> {
    let listed = || new.list("/figures").iter().chain(old.list("/figures"));
    let names: BTreeSet<&String> = old.figures.keys().chain(new.figures.keys()).collect();
    let differing =
        names.into_iter().filter(|name| old.figures.get(*name) != new.figures.get(*name));
    let place = |name: &String| listed().position(|one| one["name"] == **name);
    let mut changed: Vec<&String> = differing.collect();
    changed.sort_by_key(|name| place(name).unwrap_or(usize::MAX));
    let change = |name: &String| {
        let title = listed().find(|one| one["name"] == *name).map(|one| &one["title"]);
        let title = title.and_then(Value::as_str).unwrap_or(name);
        let [in_old, in_new] = [old, new].map(|side| side.figures.contains_key(name));
        json!({ "name": name, "title": title, "in_old": in_old, "in_new": in_new })
    };
    changed.into_iter().map(change).collect()
}

struct Comparator<'a> {
    old: &'a Document,
    new: &'a Document,
    found: ReportDifference,
    /// What is said to be given, and is something else.
    given: Vec<Change>,
    /// Texts in which nothing but numbers changed.
    renumbered: Vec<Change>,
}

impl Comparator<'_> {
    /// Of what has a way of its own, the fields that are on one side only; all else value by value.
    fn fields(&mut self, path: &str, old: &Value, new: &Value) {
        match (old, new) {
            // Each of its keys is an input.
            _ if path == "case" => {}
            (Value::Object(before), Value::Object(after)) => {
                let keys: BTreeSet<&String> = before.keys().chain(after.keys()).collect();
                for key in keys {
                    let at = if path.is_empty() { key.clone() } else { format!("{path}/{key}") };
                    match (before.get(key), after.get(key)) {
                        (Some(a), Some(b)) if !path.is_empty() || APART.contains(&key.as_str()) => {
                            self.fields(&at, a, b);
                        }
                        (Some(a), Some(b)) => self.values(&at, new, a, b),
                        // The format of before does not say it; files are inputs.
                        _ if ["asked", "files", "provenance/files"].contains(&at.as_str()) => {}
                        (a, b) => self.on_one_side(&at, a, b),
                    }
                }
            }
            (Value::Array(before), Value::Array(after)) => {
                let pairs = before.iter().zip(after).enumerate();
                pairs.for_each(|(k, (a, b))| self.fields(&format!("{path}[{}]", k + 1), a, b));
            }
            // What an input says beside its text.
            _ if path.starts_with("inputs[") && !is_same(old, new) => {
                self.given.push(change(path, old, new));
            }
            _ => {}
        }
    }

    /// A field on one side only: two versions of the program may differ in it, one does not.
    fn on_one_side(&mut self, path: &str, old: Option<&Value>, new: Option<&Value>) {
        let version =
            |of: &Document| of.report["provenance"]["version"].as_str().map(str::to_owned);
        if version(self.old).zip(version(self.new)).is_some_and(|(old, new)| old != new) {
            self.found.folded.unknown += 1;
        } else {
            let told = |one: Option<&Value>| one.map_or(Value::Null, |_| json!("there"));
            self.found.states.push(change(path, &told(old), &told(new)));
        }
    }

    /// What was found, once all is known that explains it: a number that is given changes with an input, and a text
    /// with its numbers.
    fn ended(mut self) -> ReportDifference {
        let ReportDifference { inputs, numbers, states, folded, .. } = &mut self.found;
        if inputs.is_empty() {
            let (of_case, other): (Vec<_>, Vec<_>) =
                self.given.into_iter().partition(|one| is_quantity(&one.new));
            numbers.extend(of_case);
            states.extend(other);
        }
        let moved = folded.within + folded.unjudged + folded.wording + inputs.len() + numbers.len();
        if moved == 0 {
            states.append(&mut self.renumbered);
        }
        folded.wording += self.renumbered.len();
        self.found
    }

    /// Everything below a path; `within` is the new object that holds it.
    fn values(&mut self, path: &str, within: &Value, old: &Value, new: &Value) {
        match (old, new) {
            _ if is_quantity(old) && is_quantity(new) => self.quantity(path, old, new),
            (Value::Object(before), Value::Object(after)) => {
                let keys: BTreeSet<&String> = before.keys().chain(after.keys()).collect();
                for key in keys {
                    match (before.get(key), after.get(key)) {
                        (Some(a), Some(b)) if explains(path, key) && alike(a, b) => {
                            let folded = &mut self.found.folded;
                            *(if a == b { &mut folded.same } else { &mut folded.wording }) += 1;
                        }
                        (Some(a), Some(b)) => self.values(&format!("{path}/{key}"), new, a, b),
                        (a, b) => self.on_one_side(&format!("{path}/{key}"), a, b),
                    }
                }
            }
            (Value::Array(before), Value::Array(after)) => self.list(path, before, after),
            _ if old == new => self.found.folded.same += 1,
            _ => self.word(path, within, old, new),
        }
    }

    /// Lists along a band are counted: places are added where the amplitude is largest, and what a list says
    /// is summed up in shares, peaks and criteria.
    fn list(&mut self, path: &str, old: &[Value], new: &[Value]) {
        if path.starts_with("band/") || COUNTED.contains(&without_elements(path).as_str()) {
            let folded = &mut self.found.folded;
            *(if old == new { &mut folded.same } else { &mut folded.unjudged }) += 1;
            return;
        }
        let key = path.rsplit('/').next().unwrap_or(path);
        if path == "places" {
            return self.motions_along(old, new);
        }
        // What one side did not look at is one thing that came or went.
        if old.is_empty() != new.is_empty() && old.len() + new.len() >= MANY {
            let count = |of: &[Value]| match of.len() {
                0 => Value::Null,
                count => json!(format!("{count} entries")),
            };
            self.found.states.push(change(path, &count(old), &count(new)));
            return;
        }
        let (old, new) = (named(key, old), named(key, new));
        // A figure whose drawing came or went is told as that.
        let [drawn, redrawn] = [self.old, self.new].map(|of| &of.figures);
        let is_told =
            |name: &str| key == "figures" && drawn.contains_key(name) != redrawn.contains_key(name);
        for (name, before) in &old {
            let path = format!("{path}[{name}]");
            match new.get(name) {
                None if is_told(name) => {}
                None => self.element(&path, before, &Value::Null),
                Some(_) if key == "notes" => self.found.folded.same += 1,
                Some(after) => self.values(&path, after, before, after),
            }
        }
        let added = new.iter().filter(|(name, _)| !old.contains_key(*name) && !is_told(name));
        for (name, after) in added {
            self.element(&format!("{path}[{name}]"), &Value::Null, after);
        }
    }

    /// Motions at the frequencies of a band, which are many: how many frequencies have others.
    fn motions_along(&mut self, old: &[Value], new: &[Value]) {
        let at = |place: &Value| place["at"].to_string();
        let before: BTreeMap<String, &Value> = old.iter().map(|one| (at(one), one)).collect();
        let pairs: Vec<(&Value, &Value)> = match old.len() == new.len() {
            true => old.iter().zip(new).collect(),
            false => new.iter().filter_map(|one| Some((*before.get(&at(one))?, one))).collect(),
        };
        let others = pairs.iter().filter(|(old, new)| in_words(old) != in_words(new)).count();
        let folded = &mut self.found.folded;
        *(if old == new { &mut folded.same } else { &mut folded.unjudged }) += 1;
        if others > 0 {
            let told = json!(format!("others at {others} of {} frequencies", pairs.len()));
            self.found.states.push(change("places", &Value::Null, &told));
        }
    }

    /// A motion, orbit, boundary, claim or note that is on one side only.
    fn element(&mut self, path: &str, old: &Value, new: &Value) {
        let (element, other) = if old.is_null() { (new, self.old) } else { (old, self.new) };
        let told = |one: &Value| match &one["verdict"] {
            _ if one.is_null() => Value::Null,
            _ if path.starts_with("notes") => json!(path[6..].trim_end_matches(']')),
            Value::Null => json!("there"),
            verdict => verdict.clone(),
        };
        let mut change = change(path, &told(old), &told(new));
        if path.starts_with("notes") {
            change.what = "note".into();
        }
        let starts = other.report["provenance"]["effort"]["starts"].as_u64().unwrap_or(0);
        if path.starts_with("motions") && is_by_chance(element, starts as u32) {
            self.found.folded.wording += 1;
        } else if element["verdict"].is_string() && element["verdict"] != "confirmed" {
            self.found.claims.push(change);
        } else if element["kind"] != "refuted" {
            // The claim itself says that it is refuted.
            self.found.states.push(change);
        }
    }

    /// What is given is an input, which is told as such, or a place along the band. A number that is known by another
    /// layer is told although it did not move.
    fn quantity(&mut self, path: &str, old: &Value, new: &Value) {
        let has = |one: &Value, key: &str| one.get(key).is_some();
        let keys = [old, new].map(|one| one.as_object().into_iter().flat_map(|all| all.keys()));
        for key in keys.into_iter().flatten().filter(|key| has(old, key) != has(new, key)) {
            self.on_one_side(&format!("{path}/{key}"), old.get(key), new.get(key));
        }
        // A unit is there where a script reads the number alone.
        if has(old, "unit") && has(new, "unit") && old["unit"] != new["unit"] {
            let path = format!("{path}/unit");
            self.found.states.push(change(&path, &old["unit"], &new["unit"]));
        }
        let folded = &mut self.found.folded;
        let is_place = path.starts_with("band/") && old["id"] == new["id"];
        match moved(old, new) {
            _ if old == new => folded.same += 1,
            Moved::Beyond(by, allowed) if is_given(old) && is_given(new) && !is_place => {
                self.given.push(Change { change: by, allowed, ..change(path, old, new) });
            }
            _ if is_given(old) && is_given(new) => {}
            Moved::Within | Moved::Unjudged if old["method"] != new["method"] => {
                let path = format!("{path}/method");
                self.found.states.push(change(&path, &old["method"], &new["method"]));
            }
            Moved::Within => folded.within += 1,
            Moved::Unjudged => folded.unjudged += 1,
            Moved::Beyond(by, allowed) => {
                self.found.numbers.push(Change { change: by, allowed, ..change(path, old, new) });
            }
        }
    }

    /// A word, a flag, a count, or something that is there on one side only; a number without an error says
    /// how a result was found.
    fn word(&mut self, path: &str, within: &Value, old: &Value, new: &Value) {
        let sentence = |one: &Value| one.as_str().is_some_and(|text| text.contains(' '));
        let unknown = |one: &Value| one.is_f64() || is_quantity(one) && one["error"].is_null();
        let judged = !path.split(['/', '[']).any(|key| NOT_JUDGED.contains(&key));
        let either = |is: &dyn Fn(&Value) -> bool| is(old) || is(new);
        let told = |one: &Value| match one {
            Value::Object(_) | Value::Array(_) if !is_quantity(one) => json!("there"),
            other => other.clone(),
        };
        let found = change(path, &told(old), &told(new));
        let texts = old.as_str().zip(new.as_str());
        if path.starts_with("derived") && is_same(old, new) {
            self.found.folded.within += 1;
        } else if path.starts_with("derived") {
            self.found.states.push(found);
        } else if either(&unknown) || either(&Value::is_number) && !judged {
            self.found.folded.unjudged += 1;
        } else if without_elements(path) == "claims/verdict" {
            let statement = Some(within["statement"].clone());
            self.found.claims.push(Change { statement, ..found });
        } else if either(&sentence) && texts.is_some_and(|(old, new)| words(old).eq(words(new))) {
            self.renumbered.push(found);
        } else {
            self.found.states.push(found);
        }
    }
}

/// The elements of a list by their natural key or number; of several with one key, the later have a number.
fn named<'v>(list: &str, items: &'v [Value]) -> BTreeMap<String, &'v Value> {
    let natural = NATURAL_KEYS.iter().find(|(name, _)| *name == list);
    let mut named = BTreeMap::new();
    for (index, item) in items.iter().enumerate() {
        let words = natural.map(|(_, keys)| {
            let words = keys.iter().filter_map(|key| match &item[*key] {
                Value::String(text) => Some(without_numbers(text)),
                // One damper is what a device is unless told.
                Value::Number(count) if *key == "dampers" => {
                    count.as_u64().filter(|count| *count > 1).map(|count| format!("of {count}"))
                }
                // Of several loads or absorbers which.
                Value::Number(number) if number.is_u64() => Some(format!("{key} {number}")),
                // Any other number that names an element is a share.
                other => {
                    let percent = other.as_f64().map(|share| (1e5 * share).round() / 1e3);
                    percent.filter(|it| *it != 0.0).map(|it| format!("±{it} %"))
                }
            });
            words.collect::<Vec<_>>().join(" ")
        });
        let name = words.unwrap_or_else(|| (index + 1).to_string());
        let later = (2..).map(|count| format!("{name} {count}"));
        let mut free = std::iter::once(name.clone()).chain(later);
        let name = free.find(|name| !named.contains_key(name)).unwrap_or(name);
        named.insert(name, item);
    }
    named
}

/// The words of a text that have no number in them.
fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split_whitespace().filter(|word| !word.contains(|c: char| c.is_ascii_digit()))
}

/// Whether two values are the same but for rounding.
fn is_same(old: &Value, new: &Value) -> bool {
    if let (Value::Array(old), Value::Array(new)) = (old, new) {
        return old.len() == new.len() && old.iter().zip(new).all(|(old, new)| is_same(old, new));
    }
    let rounds = |(a, b): (f64, f64)| (a - b).abs() <= ROUNDING * a.abs().max(b.abs());
    old == new || old.as_f64().zip(new.as_f64()).is_some_and(rounds)
}

/// A sentence by its letters: with another number it is the same. Anything else as it is.
fn without_numbers(text: &str) -> String {
    let kept = |letter: &char| !text.contains(' ') || letter.is_alphabetic() || *letter == ' ';
    text.chars().filter(kept).collect()
}

/// A value without its numbers.
fn in_words(value: &Value) -> Value {
    match value {
        Value::Object(all) => all.iter().map(|(key, one)| (key.clone(), in_words(one))).collect(),
        Value::Array(all) => all.iter().map(in_words).collect(),
        Value::Number(_) => Value::Null,
        other => other.clone(),
    }
}

/// Whether a quantity is of the case file.
fn is_given(value: &Value) -> bool {
    is_quantity(value) && value["method"] == "given"
}

/// Whether a motion that is on one side only could have been missed on the other: no start of as many is
/// within the 95 % interval of its share. One that no start found is reached from the theory, not by chance.
fn is_by_chance(motion: &Value, starts: u32) -> bool {
    // Before there was one list of motions, `starts` held all of it.
    let before = &motion["starts"];
    let found = before.as_u64().or_else(|| before["count"].as_u64()).unwrap_or(0);
    let either = [&motion["reached"], before];
    let low = either.iter().find_map(|one| one["interval"][0]["value"].as_f64());
    found > 0 && low.is_some_and(|low| low <= wilson(0, starts)[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A motion that one start in 32 found may be missed by the next 32; one that half of them found, not.
    #[test]
    fn one_start_of_many_may_be_chance() {
        let by_chance = |starts: u32| {
            let low = json!({"value": wilson(starts, 32)[0]});
            let now = json!({"starts": starts, "reached": {"interval": [low]}});
            let before = json!({"starts": {"count": starts, "interval": [low]}});
            let [now, before] = [now, before].map(|motion| is_by_chance(&motion, 32));
            assert_eq!(now, before);
            now
        };
        assert!(by_chance(1) && !by_chance(16) && !by_chance(0));
    }
}
