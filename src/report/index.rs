//! The index of a folder of reports: every case with its verdict and its main numbers, and the cases side by
//! side. Made from the `report.json` of each, not from the cases.
//!
//! For the program itself: this module may change at any time.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::document::{Tone, Word};
use super::error::RenderError;
use super::render::Files;
use super::stored::{self, ReadError};
use super::template;
use crate::quantity::{Units, catalogue};

/// The index for a browser, and the one that a forge shows, by their file names.
pub const HTML: &str = "index.html";
/// See [`HTML`].
pub const MARKDOWN: &str = "README.md";

/// What both files of an index say of themselves, so that no other file is taken for one.
const SIGNATURE: &str = "This page is written by";
/// A clearance in m whose unit, mm, is that of an index of cases of any size.
const USUAL_CLEARANCE: f64 = 1e-3;

/// A report in its folder.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct IndexedReport {
    /// Name of its folder, which is that of the case.
    pub name: String,
    /// What its `report.json` says.
    #[serde(flatten)]
    pub summary: Summary,
    /// The files of its folder: it may have pages of other commands.
    pub files: Vec<String>,
    /// Whether its case is gone, while those of other reports are there.
    pub orphan: bool,
}

/// What an index needs of a report. Quantities as [`crate::quantity::Quantity`] is written.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    title: String,
    /// `si` or `reduced`.
    units: String,
    verdict: AnswerFacts,
    criteria: Value,
    quantities: BTreeMap<String, Value>,
    notes: Vec<Value>,
    figures: Vec<Value>,
    band: Value,
    /// Of a structure of several modes; none of others.
    #[serde(default, skip_serializing)]
    absorbers: Vec<Value>,
    #[serde(default, skip_serializing)]
    loads: Vec<Value>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct AnswerFacts {
    tone: Tone,
    word: Word,
}

/// Another page in the folder.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct OtherPage {
    /// File name.
    pub file: String,
    /// Its headline.
    pub title: String,
}

impl Summary {
    /// Reads the text of a `report.json`; `place` is where it lies, for messages.
    ///
    /// # Errors
    /// [`ReadError`] says what is wrong with it, where, and what to do.
    pub fn read(place: &str, text: &str) -> Result<Self, ReadError> {
        stored::read(place, text)?;
        // Out of the text once more, which knows the line where something is missing.
        let summary: Self =
            serde_json::from_str(text).map_err(|cause| stored::incomplete(place, &cause))?;
        let known = |part: &Value| stored::quantities_are_known(place, part);
        summary
            .quantities
            .values()
            .chain([&summary.band, &summary.criteria])
            .try_for_each(known)?;
        Ok(summary)
    }

    /// Numbers of the table, each from one end of a range to the other or one: clearance, excitation, vibration
    /// without and with absorber, change, tuned mass damper.
    fn cells(&self) -> [Value; 6] {
        let of = |ids: &[&str]| ids.iter().find_map(|id| self.quantities.get(*id)).cloned();
        let one = |from: Option<Value>| json!({ "from": from });
        let clearance = match &self.absorbers[..] {
            [] => one(of(&["clearance"])),
            several => range_of(several, &["/clearance"]),
        };
        let band = &self.band;
        if band.is_null() {
            let frequency = of(&["excitation_frequency", "frequency_ratio", "initial_amplitude"]);
            let excitation = match of(&["sweep_from"]) {
                Some(from) => json!({ "from": from, "to": of(&["sweep_to"]) }),
                None if !self.loads.is_empty() => {
                    range_of(&self.loads, &["/excitation/from", "/excitation/to"])
                }
                None => one(frequency),
            };
            // Of a released structure the time to come to rest, which has no level.
            if self.quantities.contains_key("bare_decay_time") {
                let rest = ["bare_decay_time", "decay_time", "damper_decay_time"];
                let [bare, time, damper] = rest.map(|id| one(of(&[id])));
                return [clearance, excitation, bare, time, one(None), damper];
            }
            let rest = ["bare_peak", "peak_displacement", "damper_peak"];
            let [bare, peak, damper] = rest.map(|id| one(of(&[id])));
            let reduced = of(&["reduction_db"]).map(|reduction| {
                let change = reduction["value"].as_f64().map(|level| -level);
                json!({ "id": "change_db", "value": change, "error": reduction["error"] })
            });
            let change = one(of(&["change_db"]).or(reduced));
            return [clearance, excitation, bare, peak, change, damper];
        }
        let along = |pointer: &str| one(band.pointer(pointer).cloned());
        let rest = ["/bare/peak", "/worst/peak", "/worst/change", "/damper/peak"];
        let [bare, peak, change, damper] = rest.map(along);
        let range = json!({ "from": band["from"], "to": band["to"] });
        [clearance, range, bare, peak, change, damper]
    }
}

/// From the least to the largest of quantities at some places of some rows, or the one.
fn range_of(rows: &[Value], pointers: &[&str]) -> Value {
    let all = rows.iter().flat_map(|row| pointers.iter().filter_map(|at| row.pointer(at)));
    let value = |of: &&Value| of["value"].as_f64().unwrap_or(f64::NAN);
    let least = all.clone().min_by(|a, b| value(a).total_cmp(&value(b)));
    let most = all.max_by(|a, b| value(a).total_cmp(&value(b)));
    json!({ "from": least, "to": most.filter(|most| least.map(|one| value(&one)) != Some(value(most))) })
}

/// Both files of the index of some reports, by their names.
///
/// # Errors
/// [`RenderError::Template`] if template and index do not fit.
pub fn files(
    mut cases: Vec<IndexedReport>,
    mut others: Vec<OtherPage>,
) -> Result<Files, RenderError> {
    cases.sort_by(|a, b| a.name.cmp(&b.name));
    others.sort_by(|a, b| a.file.cmp(&b.file));
    let mut words: BTreeMap<Word, usize> = BTreeMap::new();
    for case in &cases {
        *words.entry(case.summary.verdict.word).or_default() += 1;
    }
    let known = |id: &&str| cases.iter().any(|case| case.summary.quantities.contains_key(*id));
    let entries = cases.iter().map(|case| {
        let mut entry = json!(case);
        entry["reduced"] = json!(case.summary.units == "reduced");
        // Place of the verdict in a sorted column.
        entry["order"] = json!(case.summary.verdict.word as u8);
        entry["cells"] = json!(case.summary.cells());
        entry
    });
    let context = json!({
        "cases": entries.collect::<Vec<_>>(),
        // How many cases have each verdict, in the order of a sorted column.
        "words": words.into_iter().collect::<Vec<_>>(),
        // Identifiers of the quantities that some case has, in the order of the catalogue.
        "ids": catalogue::ALL.iter().map(|kind| kind.id).filter(known).collect::<Vec<_>>(),
        "others": others,
        "version": env!("CARGO_PKG_VERSION"),
    });
    let units = Units::physical(USUAL_CLEARANCE);
    let text = |name: &str| template::render(name, &units, &context);
    Ok(BTreeMap::from([
        (PathBuf::from(HTML), text("index.html")?.into_bytes()),
        (PathBuf::from(MARKDOWN), text("index.md")?.into_bytes()),
    ]))
}

/// Whether the text of a file is an index that may be replaced by a newer one.
pub fn is_index(text: &str) -> bool {
    // `vinesink index` stands in code marks, which differ between the two files.
    text.contains(SIGNATURE) && text.contains("vinesink index")
}

impl OtherPage {
    /// A page by its first headline, or by its file name where it has none.
    pub fn new(file: String, text: &str) -> Self {
        let headline = text.lines().find_map(|line| line.strip_prefix("# "));
        Self { title: headline.unwrap_or(&file).trim().to_owned(), file }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn case(name: &str, word: &str, units: &str, peak: f64) -> IndexedReport {
        let number =
            |id: &str, value: f64| serde_json::json!({"id": id, "value": value, "error": 0});
        let text = serde_json::json!({
            "format": "vinesink/answer@2", "asked": "report", "title": "T", "units": units, "notes": [], "figures": [],
            "verdict": {"tone": "good", "word": word}, "criteria": null, "band": null,
            "quantities": {"clearance": number("clearance", 0.02), "peak_displacement": number("peak_displacement", peak)},
        });
        let summary = Summary::read(name, &text.to_string()).expect("a report");
        IndexedReport { name: name.to_owned(), summary, files: Vec::new(), orphan: false }
    }

    #[test]
    fn cases_come_by_name_with_numbers_in_their_units() {
        let cases =
            vec![case("b", "does-nothing", "reduced", 1.5), case("a", "works", "si", 3.56e-3)];
        let files = files(cases, Vec::new()).expect("rendered");
        let text = String::from_utf8_lossy(&files[&PathBuf::from(MARKDOWN)]).into_owned();
        assert!(text.contains("2 cases: 1 works, 1 does nothing."), "{text}");
        let rows: Vec<&str> = text.lines().filter(|line| line.starts_with("| [")).collect();
        assert!(rows[0].contains("**Works**") && rows[0].contains("3.56 mm"), "{rows:?}");
        assert!(rows[1].contains("**Does nothing**") && rows[1].contains("1.50 units"), "{rows:?}");
        for (name, bytes) in files {
            assert!(is_index(&String::from_utf8_lossy(&bytes)), "{}", name.display());
        }
        assert!(!is_index("# My own notes\n\nWritten after `vinesink report`.\n"));
    }

    #[test]
    fn half_a_report_is_refused() {
        let half = "{\"format\": \"vinesink/answer@1\", \"asked\": \"report\",\n \"title\": \"T\"}";
        let half = Summary::read("a/report.json", half).expect_err("refused").to_string();
        assert!(half.starts_with("a/report.json") && half.contains("missing field"), "{half}");
        assert!(half.contains("line 2"), "{half}");
    }
}
