//! A report as it was read, with its case file as that is now.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use crate::report::document::FORMAT;
use crate::report::stored::{self, ReadError};

/// A `report.json`, the drawings beside it, and the case that it is about.
#[derive(Debug, Clone, PartialEq)]
pub struct Document {
    /// Where the document was read from.
    pub place: String,
    /// The parsed document.
    pub report: Value,
    /// The drawings, by file stem.
    pub figures: BTreeMap<String, Vec<u8>>,
    /// The case file, where there is one.
    pub case: Option<CurrentCase>,
    /// What writes the report again.
    pub remedy: Remedy,
}

/// A case file as it is now.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct CurrentCase {
    /// Where it was read from.
    pub place: String,
    /// SHA-256 of its text with line ends of one kind.
    pub sha256: String,
    /// The same of the files that the report was made from beside it, by name; none of one that is not there.
    pub files: BTreeMap<String, Option<String>>,
}

/// Cases by name, whether they have a report or not.
pub type Cases = BTreeMap<String, ListedCase>;

/// A case file that is there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ListedCase {
    /// Where it was read from.
    pub place: String,
    /// SHA-256 of its text with line ends of one kind.
    pub sha256: String,
    /// What writes its report.
    pub remedy: Remedy,
}

/// What writes a report again.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Remedy {
    /// A command line.
    pub command: String,
    /// The revision that has to be checked out before; nothing for files of the working folder.
    pub revision: Option<String>,
}

impl Remedy {
    /// What is out of date of a file, and what to do.
    pub(super) fn stale(&self, side: &str, file: &str, reason: &str) -> Value {
        json!({
            "side": side,
            "file": file,
            "reason": reason,
            "case": null,
            "reported": null,
            "current": null,
            "command": self.command,
            "revision": self.revision,
        })
    }
}

/// The format of version 0.1's first reports, whose numbers have neither identifiers nor errors.
const OLD_FORMAT: &str = "vinesink/report@1";

/// Why a report is out of date, in the order in which reports are named.
const REASONS: [&str; 6] =
    ["case-text", "file", "no-case", "no-report", "program-version", "format"];

/// The place of a stale report's reason among [`REASONS`].
pub(super) fn reason(stale: &Value) -> Option<usize> {
    REASONS.iter().position(|reason| stale["reason"] == *reason)
}

impl Document {
    /// Reads the text of a `report.json`; `place` says where it came from. One of the format before this one is kept to
    /// be named as out of date.
    ///
    /// # Errors
    /// [`ReadError`] where it is not JSON, or not a report of this format or the one before.
    pub fn parse(
        place: &str,
        text: &str,
        figures: BTreeMap<String, Vec<u8>>,
    ) -> Result<Self, ReadError> {
        let report = match stored::read(place, text) {
            Err(error) if error.other_format.as_deref() == Some(OLD_FORMAT) => {
                serde_json::from_str(text).unwrap_or_default()
            }
            other => other?,
        };
        stored::quantities_are_known(place, &report["criteria"])?;
        Ok(Self { place: place.to_owned(), report, figures, case: None, remedy: Remedy::default() })
    }

    /// The case's name: the stem of its file.
    pub fn name(&self) -> &str {
        self.text("name")
    }

    /// Whether it is of the format before this one, which is not compared.
    pub fn has_old_format(&self) -> bool {
        self.report["format"] == OLD_FORMAT
    }

    /// Its name and answer, null where it has none, with how many criteria it has and how many of them fail; the
    /// name of the report's own folder where it has none below another.
    pub(super) fn summary(&self, folder: &str) -> Value {
        let count = |key: &str| self.report["criteria"][key].as_u64().unwrap_or(0);
        let verdict = if self.has_old_format() { &Value::Null } else { &self.report["verdict"] };
        json!({
            "name": if folder.is_empty() { self.name() } else { folder },
            "title": self.text("title"),
            "verdict": verdict,
            "criteria": [count("count"), count("failing")],
        })
    }

    /// What is out of date about it: it was made from another text of its case or of a file that the case reads, by another
    /// version of the program, or has an old format and is not compared. `reported` is what it was made from, `current` the
    /// same now.
    pub(super) fn stale(&self, side: &str) -> Vec<Value> {
        let provenance = |field: &str| self.report["provenance"][field].as_str();
        let case = self.case.as_ref();
        let old_format = self.report["format"].as_str().filter(|_| self.has_old_format());
        let of_case =
            provenance("case_sha256").zip(case).map(|(old, case)| (old, json!(case.sha256)));
        let of_files =
            self.files().filter_map(|(name, old)| Some((name, old, case?.files.get(name)?)));
        let sides = [
            ("case-text", None, of_case),
            (
                "program-version",
                None,
                provenance("version").map(|it| (it, json!(env!("CARGO_PKG_VERSION")))),
            ),
            ("format", None, old_format.map(|it| (it, json!(FORMAT)))),
        ];
        let of_files =
            of_files.map(|(name, old, now)| ("file", Some(name), Some((old, json!(now)))));
        let differing = sides.into_iter().chain(of_files).filter_map(|(reason, name, both)| {
            let (reported, current) = both.filter(|(old, new)| old != new)?;
            let mut stale = self.remedy.stale(side, &self.place, reason);
            // The case file that has another text, or that reads what has another one.
            stale["case"] =
                json!(case.filter(|_| ["case-text", "file"].contains(&reason)).map(|it| &it.place));
            stale["name"] = json!(name);
            stale["reported"] = json!(reported);
            stale["current"] = current;
            Some(stale)
        });
        differing.collect()
    }

    /// The SHA-256 of the text of the case that it was made from.
    pub fn case_digest(&self) -> Option<&str> {
        self.report["provenance"]["case_sha256"].as_str()
    }

    /// The names of the files that its case read beside its own text.
    pub fn files_read(&self) -> Vec<String> {
        self.files().map(|(name, _)| name.to_owned()).collect()
    }

    /// A text of the document, empty where there is none.
    pub(super) fn text(&self, field: &str) -> &str {
        self.report[field].as_str().unwrap_or("")
    }

    /// The elements of a list, none where there is none.
    pub(super) fn list(&self, pointer: &str) -> &[Value] {
        let list = self.report.pointer(pointer).and_then(Value::as_array);
        list.map_or(&[], Vec::as_slice)
    }

    /// What the case says, value by value: its numbers in its order, every other key, the modes of a structure of several,
    /// the files that it reads; and how thoroughly it was simulated. `whole` where every key of both sides is known.
    pub(super) fn inputs(&self, whole: bool) -> Vec<Given> {
        let mut found = Vec::new();
        for field in ["title", "source"] {
            found.push(Given::new(field.to_owned(), field, &json!(self.text(field))));
        }
        for input in self.list("/inputs") {
            let word = |key: &str| input[key].as_str().unwrap_or("");
            let name = format!("{} {}", word("table"), word("name"));
            found.push(Given::new(format!("inputs[{name}]"), &name, &input["as_written"]));
        }
        if whole {
            leaves("case", "", &self.report["case"], &mut found);
        }
        let places = self.list("/places_of_shapes");
        for (k, mode) in self.list("/modes").iter().enumerate() {
            let (path, name) = (format!("modes[{}]", k + 1), format!("mode {}", k + 1));
            for (key, value) in
                mode.as_object().into_iter().flatten().filter(|(key, _)| *key != "shape")
            {
                found.push(Given::new(format!("{path}/{key}"), &format!("{name} {key}"), value));
            }
            let shape = mode["shape"].as_array().into_iter().flatten().zip(places);
            for (value, place) in shape {
                let place = place.as_str().unwrap_or("");
                let [path, name] =
                    [format!("{path}/shape[{place}]"), format!("{name} shape {place}")];
                found.push(Given::new(path, &name, value));
            }
        }
        for (file, digest) in self.files() {
            let (path, name) = (format!("files[{file}]"), format!("content of {file}"));
            let begin: String = digest.chars().take(8).collect();
            let given = Given::new(path, &name, &json!(format!("SHA-256 {begin}…")));
            found.push(Given { name, ..given });
        }
        for end in ["from", "to"] {
            let place = &self.report["band"][end];
            if place.is_object() {
                found.push(Given::new(format!("band/{end}"), &format!("band {end}"), place));
            }
        }
        for (of, at) in [("simulation", "/provenance/effort"), ("accuracy", "/answers/demand")] {
            let values = self.report.pointer(at).and_then(Value::as_object);
            for (name, value) in values.into_iter().flatten() {
                let path = format!("{}/{name}", &at[1..]);
                found.push(Given::new(path, &format!("{of} {name}"), &json!(value.to_string())));
            }
        }
        found
    }

    /// Whether it says every key of its case: one of an earlier version says its numbers alone.
    pub(super) fn has_whole_case(&self) -> bool {
        self.report["case"].is_object()
    }

    /// The files that its case read, by name, and the SHA-256 of each; earlier reports have them in their provenance.
    pub(super) fn files(&self) -> impl Iterator<Item = (&str, &str)> {
        let own = self
            .list("/files")
            .iter()
            .filter_map(|one| Some((one["path"].as_str()?, one["sha256"].as_str()?)));
        let earlier = self.report["provenance"]["files"].as_object();
        own.chain(
            earlier
                .into_iter()
                .flatten()
                .filter_map(|(name, it)| Some((name.as_str(), it.as_str()?))),
        )
    }
}

/// Something that is given.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Given {
    /// Where it stands in the document.
    pub(super) path: String,
    /// What a reader calls it.
    pub(super) name: String,
    /// As written, or a quantity.
    pub(super) value: Value,
}

impl Given {
    /// Of a name with the points and underscores of a file.
    fn new(path: String, name: &str, value: &Value) -> Self {
        Self { path, name: name.replace(['_', '.'], " ").trim().to_owned(), value: value.clone() }
    }
}

/// The values of a table and of those in it; a list of tables is numbered, any other is one value.
fn leaves(path: &str, name: &str, of: &Value, found: &mut Vec<Given>) {
    match of {
        Value::Object(entries) => {
            for (key, value) in entries {
                leaves(&format!("{path}/{key}"), &format!("{name} {key}"), value, found);
            }
        }
        Value::Array(items) if !items.is_empty() && items.iter().all(Value::is_object) => {
            for (k, item) in items.iter().enumerate() {
                leaves(&format!("{path}[{}]", k + 1), &format!("{name} {}", k + 1), item, found);
            }
        }
        value => found.push(Given::new(path.to_owned(), name, value)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reports of before say the same in their provenance.
    #[test]
    fn files_of_both_forms_are_the_same() {
        let forms = [
            json!({ "files": [{ "path": "quake.csv", "sha256": "12ab" }] }),
            json!({ "provenance": { "files": { "quake.csv": "12ab" } } }),
        ];
        for report in forms {
            let [place, remedy] = [String::new(), String::new()];
            let remedy = Remedy { command: remedy, revision: None };
            let of = Document { place, report, figures: BTreeMap::new(), case: None, remedy };
            assert_eq!(of.files().collect::<Vec<_>>(), [("quake.csv", "12ab")]);
        }
    }
}
