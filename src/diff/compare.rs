//! One report against its earlier self.

use serde_json::Value;

use super::accuracy::{Allowance, allowance, is_angle};
use super::leaves::{Leaf, Leaves, is_inside, key};
use super::words::skeleton;
use super::{
    Document, FigureChange, Folded, NumberChange, ReportDifference, WordChange, criteria, inputs,
    labels, motion,
};

/// Words that only explain: what they are about is compared as a number or a verdict.
const EXPLANATIONS: [&str; 10] = [
    "analysis/exact_boundaries/test_function",
    "analysis/format",
    "attractors/doubts/advice",
    "attractors/doubts/words",
    "claims/observed/words",
    "claims/source",
    "claims/statement",
    "claims/tolerance/reason",
    "confirmations/best/other",
    "confirmations/upper_limit/lost/other",
];

/// How a note about a refuted claim begins.
const REFUTED: &str = "refuted:";

/// What comes and goes with another value.
const RESTATED: [&str; 2] = ["analysis/exact_boundaries/bracket", "attractors/two_standard_errors"];

/// What changed in a report that is on both sides.
pub(super) fn reports(old: &Document, new: &Document, folder: &str) -> ReportDifference {
    let (criteria, agreeing) = criteria::changes(old, new);
    let mut found = ReportDifference {
        name: if folder.is_empty() { new.name() } else { folder }.to_owned(),
        folder: folder.to_owned(),
        title: new.text("title").to_owned(),
        headline: new.report["verdict"]["headline"].as_str().unwrap_or("").to_owned(),
        verdicts: Vec::new(),
        criteria,
        states: Vec::new(),
        inputs: inputs::changes(old, new),
        numbers: Vec::new(),
        figures: figures(old, new),
        folded: Folded { same: agreeing, ..Folded::default() },
    };
    verdict(old, new, &mut found);
    texts(old, new, &mut found);
    let physical = is_physical(new);
    let (old_data, new_data) = (&old.report["data"], &new.report["data"]);
    let (old, new) = (leaves(old), leaves(new));
    main_motion(old_data, new_data, physical, &mut found);
    elements(&old, &new, &mut found);
    values(&old, &new, physical, &mut found);
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

/// The report's own verdict: its tone, and its headline where it says something else.
fn verdict(old: &Document, new: &Document, found: &mut ReportDifference) {
    let part = |document: &Document, field: &str| {
        document.report["verdict"][field].as_str().map(str::to_owned)
    };
    let tones = (part(old, "tone"), part(new, "tone"));
    let (before, after) = (part(old, "headline"), part(new, "headline"));
    let sentence = |text: &Option<String>| text.as_deref().map(skeleton);
    let change = WordChange { what: "verdict".into(), old: before.clone(), new: after.clone() };
    if tones.0 != tones.1 || sentence(&before) != sentence(&after) {
        found.verdicts.push(change);
    } else if before != after {
        found.folded.wording.push(change);
    }
}

/// Sentences of the verdict and notes. A note that appears is a finding; a sentence that says the same
/// in other words is none.
fn texts(old: &Document, new: &Document, found: &mut ReportDifference) {
    let sentences = |document: &Document| -> Vec<String> {
        let list = document.report["verdict"]["sentences"].as_array();
        list.into_iter().flatten().filter_map(Value::as_str).map(str::to_owned).collect()
    };
    let notes = |document: &Document| -> Vec<String> {
        let text = |note: &Value, field: &str| note[field].as_str().unwrap_or("").to_owned();
        let notes = document.list("notes").iter();
        notes.map(|note| format!("{}: {}", text(note, "kind"), text(note, "text"))).collect()
    };
    let folded = &mut found.folded.wording;
    folded.extend(unmatched("verdict", &sentences(old), &sentences(new)));
    for change in unmatched("note", &notes(old), &notes(new)) {
        let about_numbers = change.old.is_some() && change.new.is_some();
        // The verdict of the claim has told it already.
        let told = [&change.old, &change.new].into_iter().flatten().all(|t| t.starts_with(REFUTED));
        if about_numbers || told { &mut *folded } else { &mut found.states }.push(change);
    }
    let version = |document: &Document| {
        let made_by = &document.report["provenance"];
        ["program", "version"].map(|field| made_by[field].as_str().unwrap_or("")).join(" ")
    };
    if version(old) != version(new) {
        folded.push(WordChange {
            what: "program".into(),
            old: Some(version(old)),
            new: Some(version(new)),
        });
    }
}

/// Texts that are not on both sides; two that differ in their numbers are one change.
fn unmatched(what: &str, old: &[String], new: &[String]) -> Vec<WordChange> {
    let only = |these: &[String], those: &[String]| -> Vec<String> {
        these.iter().filter(|text| !those.contains(text)).cloned().collect()
    };
    let (mut gone, come) = (only(old, new), only(new, old));
    let mut changes = Vec::new();
    for text in come {
        let same = gone.iter().position(|before| skeleton(before) == skeleton(&text));
        let before = same.map(|index| gone.remove(index));
        changes.push(WordChange { what: what.into(), old: before, new: Some(text) });
    }
    let gone = gone.into_iter();
    changes.extend(gone.map(|text| WordChange { what: what.into(), old: Some(text), new: None }));
    changes
}

/// The motion that the verdict is about, where it is another one than before: what it vibrates by is
/// what a reviewer asks first. Where it is the same one, it is compared as all motions are.
fn main_motion(old: &Value, new: &Value, physical: bool, found: &mut ReportDifference) {
    let main = |data: &Value| {
        let motions = data["attractors"].as_array()?;
        let moving = motions.iter().find(|motion| motion["regime"] != "at-rest");
        moving.or(motions.first()).cloned()
    };
    let (Some(old), Some(new)) = (main(old), main(new)) else { return };
    if old["regime"] == new["regime"] {
        return;
    }
    let what = "main motion".to_owned();
    let (before, after) = (shown(&old["regime"]), shown(&new["regime"]));
    found.states.push(WordChange { what, old: before, new: after });
    for path in ["displacement/peak", "displacement/rms", "impacts_per_period"] {
        let leaf = |motion| Leaf { value: motion, element: motion };
        let value = |motion: &Value| motion.pointer(&format!("/{path}")).and_then(Value::as_f64);
        if let (Some(a), Some(b)) = (value(&old), value(&new)) {
            let path = format!("attractors[main]/{path}");
            number(&path, (leaf(&old), a), (leaf(&new), b), physical, found);
        }
    }
}

/// Lists along a band whose length says nothing that its shares and criteria do not: places are added
/// where the amplitude is largest.
const OF_BANDS: [&str; 3] = ["band/simulated", "band/stability", "band/zones"];

/// Motions, orbits, boundaries, claims that appeared or vanished.
fn elements(old: &Leaves<'_>, new: &Leaves<'_>, found: &mut ReportDifference) {
    for (here, there, appeared) in [(old, new, false), (new, old, true)] {
        for path in here.elements_missing_in(there) {
            let what = labels::label(&path);
            let element = here.elements[&path];
            let verdict = element["verdict"].as_str().map(str::to_owned);
            let word = verdict.clone().or_else(|| Some("there".to_owned()));
            let (old, new) = if appeared { (None, word) } else { (word, None) };
            let change = WordChange { what, old, new };
            if verdict.is_some() {
                found.verdicts.push(change);
            } else if key(&path) == "attractors" && motion::found_by_chance(element)
                || OF_BANDS.contains(&key(&path).as_str())
            {
                found.folded.wording.push(change);
            } else {
                found.states.push(change);
            }
        }
    }
}

/// Every value that is on both sides, or missing from an element that is on both.
fn values(old: &Leaves<'_>, new: &Leaves<'_>, physical: bool, found: &mut ReportDifference) {
    for (path, before) in &old.values {
        let Some(after) = new.values.get(path) else { continue };
        if before.value == after.value {
            found.folded.same += 1;
        } else if let (Some(a), Some(b)) = (before.value.as_f64(), after.value.as_f64()) {
            number(path, (*before, a), (*after, b), physical, found);
        } else {
            word(path, *before, *after, found);
        }
    }
    missing(old, new, false, found);
    missing(new, old, true, found);
}

fn number(
    path: &str,
    (before, a): (Leaf<'_>, f64),
    (after, b): (Leaf<'_>, f64),
    physical: bool,
    found: &mut ReportDifference,
) {
    let key = key(path);
    let (allowed, basis) = match allowance(&key, before, after, a, b) {
        Allowance::Within(allowed, basis) => (allowed, basis),
        Allowance::Unjudged => {
            found.folded.unjudged += 1;
            return;
        }
        Allowance::Restated => return,
    };
    let change = if is_angle(&key) { around(b - a) } else { b - a };
    let what = labels::label(path);
    let unit = labels::unit(&key, physical);
    let path = path.to_owned();
    let moved = NumberChange { what, path, unit, old: a, new: b, change, allowed, basis };
    // A change that is no number would otherwise hide behind the comparison.
    let beyond = change.abs() > allowed || !change.is_finite();
    if beyond { &mut found.numbers } else { &mut found.folded.within }.push(moved);
}

/// The shorter way round a circle.
fn around(angle: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    angle - turn * (angle / turn).round()
}

fn word(path: &str, before: Leaf<'_>, after: Leaf<'_>, found: &mut ReportDifference) {
    let key = key(path);
    let numbers = [before, after].map(|leaf| leaf.value.as_f64());
    if let [Some(value), None] | [None, Some(value)] = numbers {
        // A number that appears or vanishes: as important as the number itself.
        match allowance(&key, before, after, value, value) {
            Allowance::Within(..) => {}
            Allowance::Unjudged => {
                found.folded.unjudged += 1;
                return;
            }
            Allowance::Restated => return,
        }
    }
    let (old, new) = (shown(before.value), shown(after.value));
    let change = WordChange { what: labels::label(path), old, new };
    if key == "claims/verdict" {
        let what = after.element["statement"].as_str().unwrap_or(&change.what).to_owned();
        found.verdicts.push(WordChange { what, ..change });
    } else if motion::is_chance(&key) {
        found.folded.unjudged += 1;
    } else if EXPLANATIONS.contains(&key.as_str()) || says_the_same(&change) {
        found.folded.wording.push(change);
    } else {
        found.states.push(change);
    }
}

fn says_the_same(change: &WordChange) -> bool {
    let words = |text: &Option<String>| text.as_deref().map(skeleton);
    // A bare number is no sentence.
    words(&change.old) == words(&change.new) && words(&change.old).is_some_and(|w| !w.is_empty())
}

/// Values that only one side has: of elements that the other side lacks, which are told already; of
/// something that the other side says is not there; or of a field that only one version of the
/// program writes.
fn missing(here: &Leaves<'_>, there: &Leaves<'_>, appeared: bool, found: &mut ReportDifference) {
    let elements = here.elements_missing_in(there);
    for (path, leaf) in here.values.iter().filter(|(path, _)| !there.values.contains_key(*path)) {
        let told = elements.iter().any(|element| is_inside(path, element));
        // Nothing here, something there: the other direction tells it.
        let nothing = leaf.value.is_null();
        if told || nothing && there.values.keys().any(|other| is_inside(other, path)) {
            continue;
        }
        let ends = path.match_indices(['/', '[']).map(|(end, _)| &path[..end]);
        let denied =
            |outer: &&str| there.values.get(*outer).is_some_and(|leaf| leaf.value.is_null());
        let Some(outer) = ends.into_iter().find(denied) else {
            found.folded.unknown += 1;
            continue;
        };
        let there = Some("there".to_owned());
        let (old, new) = if appeared { (None, there) } else { (there, None) };
        let change = WordChange { what: labels::label(outer), old, new };
        if !RESTATED.contains(&key(outer).as_str()) && !found.states.contains(&change) {
            found.states.push(change);
        }
    }
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
    let mut names: Vec<&str> = Vec::new();
    for document in [new, old] {
        let listed = document.list("figures").iter().filter_map(|figure| figure["name"].as_str());
        for name in listed.chain(document.figures.keys().map(String::as_str)) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }
    names
        .into_iter()
        .filter(|name| old.figures.get(*name) != new.figures.get(*name))
        .map(|name| FigureChange {
            name: name.to_owned(),
            title: title(new, name).or_else(|| title(old, name)).unwrap_or(name).to_owned(),
            in_old: old.figures.contains_key(name),
            in_new: new.figures.contains_key(name),
        })
        .collect()
}

fn title<'a>(document: &'a Document, name: &str) -> Option<&'a str> {
    let figure = document.list("figures").iter().find(|figure| figure["name"] == name)?;
    figure["title"].as_str()
}
