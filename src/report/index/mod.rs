//! The index of a folder of reports: every case with its verdict and its key numbers, and the cases
//! side by side. Made from the `report.json` of each, not from the cases.

mod cell;
mod summary;

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::Serialize;

use super::render::{self, RenderError};
use cell::{Cell, NOTHING};
pub use summary::{Summary, Tone};

/// The index for a browser, and the one that a forge shows, by their file names.
pub const HTML: &str = "index.html";
/// See [`HTML`].
pub const MARKDOWN: &str = "README.md";

/// The pages of accuracy and cost that may lie in a case's folder.
pub const TRADEOFF: &str = "tradeoff.md";
/// Where the page of a sweep is, in the folder of a report.
pub const SWEEP: &str = "sweep.md";

/// What both files of an index say of themselves, so that no other file is taken for one.
const SIGNATURE: &str = "This page is written by";

/// A report in its folder.
#[derive(Debug, Clone, PartialEq)]
pub struct Member {
    /// Name of its folder, which is that of the case.
    pub name: String,
    /// What its `report.json` says.
    pub summary: Summary,
    /// Whether the folder has a page of accuracy and cost.
    pub has_tradeoff: bool,
    /// Whether the page of a sweep lies beside its report.
    pub has_sweep: bool,
}

/// Another page in the folder.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct OtherPage {
    /// File name.
    pub file: String,
    /// Its headline.
    pub title: String,
}

/// An index, ready to be printed.
#[derive(Debug, Clone, Serialize)]
pub struct Index {
    /// How many cases there are, and how many of each kind, in words.
    summary: String,
    /// The columns beside case and verdict.
    columns: Vec<Column>,
    /// The cases by name.
    cases: Vec<Entry>,
    /// The key numbers of all cases: a row each, with a text for each case.
    comparison: Vec<Comparison>,
    /// Other pages by file name.
    others: Vec<OtherPage>,
    program: &'static str,
    version: &'static str,
}

#[derive(Debug, Clone, Serialize)]
struct Entry {
    name: String,
    title: String,
    tone: &'static str,
    /// Place of the tone in a sorted column.
    tone_order: u8,
    headline: String,
    /// What else there is to say of the verdict: criteria, notes.
    remarks: Vec<String>,
    cells: Vec<Cell>,
    figure: Option<Thumbnail>,
    has_tradeoff: bool,
    has_sweep: bool,
}

/// The small figure of a case.
#[derive(Debug, Clone, Serialize)]
struct Thumbnail {
    /// Path from the index.
    path: String,
    /// What it is, which is all that its size shows.
    title: String,
    /// What to see where it is larger.
    alt: String,
}

#[derive(Debug, Clone, Serialize)]
struct Comparison {
    quantity: String,
    values: Vec<String>,
}

/// A column beside case and verdict.
#[derive(Debug, Clone, Copy, Serialize)]
struct Column {
    title: &'static str,
    /// Whether it is sorted as numbers.
    numeric: bool,
    /// Whether Markdown has it as well, where seven columns are the limit.
    always: bool,
    /// The key number that it shows.
    #[serde(skip)]
    quantity: &'static str,
    /// The key number that some cases have instead, with what it needs before and after it.
    #[serde(skip)]
    instead: Option<(&'static str, &'static str, &'static str)>,
}

const fn column(title: &'static str, quantity: &'static str) -> Column {
    Column { title, numeric: true, always: false, quantity, instead: None }
}

const COLUMNS: [Column; 7] = [
    Column {
        always: true,
        instead: Some(("Clearance", "", " units")),
        ..column("Clearance b", "Clearance b")
    },
    Column {
        always: true,
        instead: Some(("Frequency ratio", "Ω = ", "")),
        ..column("Frequency", "Excitation frequency")
    },
    column("Peak without", "Vibration of the bare oscillator"),
    Column {
        always: true,
        instead: Some(("Peak of the exact symmetric orbit", "", " (exact orbit)")),
        ..column("Peak with", "Vibration with the absorber, peak")
    },
    Column { always: true, ..column("Change", "Change of the peak") },
    column("Impacts z", "Impacts per period z"),
    Column { numeric: false, ..column("Area", "Area of the case") },
];

/// Quantities of a reduced case that a physical one has by another name.
const ALIASES: [(&str, &str); 2] = [("Clearance", "Clearance b"), ("Restitution", "Restitution r")];

impl Index {
    /// The index of some reports, in the order of their names.
    pub fn new(mut members: Vec<Member>, mut others: Vec<OtherPage>) -> Self {
        members.sort_by(|a, b| a.name.cmp(&b.name));
        others.sort_by(|a, b| a.file.cmp(&b.file));
        Self {
            summary: summary(&members),
            columns: COLUMNS.to_vec(),
            comparison: comparison(&members),
            cases: members.into_iter().map(Entry::of).collect(),
            others,
            program: env!("CARGO_PKG_NAME"),
            version: env!("CARGO_PKG_VERSION"),
        }
    }

    /// Both files of the index, by their names.
    ///
    /// # Errors
    /// [`RenderError::Template`] if template and index do not fit.
    pub fn files(&self) -> Result<BTreeMap<PathBuf, Vec<u8>>, RenderError> {
        Ok(BTreeMap::from([
            (PathBuf::from(HTML), render::index_html(self)?.into_bytes()),
            (PathBuf::from(MARKDOWN), render::index_markdown(self)?.into_bytes()),
        ]))
    }
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

impl Entry {
    fn of(member: Member) -> Self {
        let Member { name, summary, has_tradeoff, has_sweep } = member;
        let notes = match summary.notes.len() {
            0 => None,
            1 => Some("1 note".to_owned()),
            several => Some(format!("{several} notes")),
        };
        let figure = summary.figures.first().map(|figure| Thumbnail {
            path: format!("{name}/figures/{}.svg", figure.name),
            title: format!("{name}: {}", figure.title),
            alt: figure.alt.clone(),
        });
        Self {
            tone: summary.verdict.tone.word(),
            tone_order: summary.verdict.tone as u8,
            remarks: summary.criteria_words().into_iter().chain(notes).collect(),
            cells: COLUMNS.iter().map(|column| cell(&summary, column)).collect(),
            headline: summary.verdict.headline,
            title: summary.title,
            name,
            figure,
            has_tradeoff,
            has_sweep,
        }
    }
}

fn cell(summary: &Summary, column: &Column) -> Cell {
    if let Some(value) = summary.value(column.quantity) {
        return Cell::number(Some(value));
    }
    let other = column.instead.and_then(|(quantity, before, after)| {
        summary.value(quantity).map(|value| format!("{before}{value}{after}"))
    });
    Cell::number(other.as_deref())
}

fn summary(members: &[Member]) -> String {
    let count = |tone| members.iter().filter(|one| one.summary.verdict.tone == tone).count();
    let cases = if members.len() == 1 { "case" } else { "cases" };
    let verdicts = [Tone::Good, Tone::Mixed, Tone::Bad].map(|tone| (count(tone), tone.word()));
    let verdicts = verdicts.iter().filter(|(count, _)| *count > 0);
    let verdicts: Vec<String> = verdicts.map(|(count, word)| format!("{count} {word}")).collect();
    format!("{} {cases}: {}.", members.len(), verdicts.join(", "))
}

/// Every quantity that a case has, in the order of the reports, with each case's value.
fn comparison(members: &[Member]) -> Vec<Comparison> {
    let mut quantities: Vec<&str> = Vec::new();
    for member in members {
        let mut place = 0;
        for row in &member.summary.key_rows {
            let quantity = common_name(&row.quantity);
            place = 1 + match quantities.iter().position(|known| *known == quantity) {
                Some(known) => known,
                None => {
                    quantities.insert(place, quantity);
                    place
                }
            };
        }
    }
    let value = |member: &Member, quantity: &str| {
        let mut rows = member.summary.key_rows.iter();
        let row = rows.find(|row| common_name(&row.quantity) == quantity);
        row.map_or_else(|| NOTHING.to_owned(), |row| row.value.clone())
    };
    let mut rows: Vec<Comparison> = quantities
        .into_iter()
        .map(|quantity| Comparison {
            quantity: quantity.to_owned(),
            values: members.iter().map(|member| value(member, quantity)).collect(),
        })
        .collect();
    let criteria: Vec<_> = members.iter().map(|member| member.summary.criteria_words()).collect();
    if criteria.iter().any(Option::is_some) {
        let values = criteria.into_iter().map(|words| words.unwrap_or_else(|| NOTHING.to_owned()));
        rows.insert(0, Comparison { quantity: "Criteria".to_owned(), values: values.collect() });
    }
    rows
}

fn common_name(quantity: &str) -> &str {
    ALIASES.iter().find(|(other, _)| *other == quantity).map_or(quantity, |(_, name)| name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn member(name: &str, tone: &str, rows: &[(&str, &str)]) -> Member {
        let rows: Vec<_> = rows
            .iter()
            .map(|(quantity, value)| serde_json::json!({"quantity": quantity, "value": value}))
            .collect();
        let text = serde_json::json!({
            "format": "vinesink/report@1", "title": "T", "notes": [], "figures": [],
            "verdict": {"tone": tone, "headline": "H"}, "key_rows": rows,
        });
        let summary = Summary::read(name, &text.to_string()).expect("a report");
        Member { name: name.to_owned(), summary, has_tradeoff: false, has_sweep: false }
    }

    #[test]
    fn cases_come_by_name_and_quantities_in_the_order_of_the_reports() {
        let physical =
            [("Clearance b", "20 mm"), ("Impacts per period z", "2.000"), ("Area", "Z3")];
        let reduced = [("Clearance", "1.0"), ("Forcing", "4.3"), ("Area", "Z1")];
        let members = vec![member("b", "bad", &reduced), member("a", "good", &physical)];
        let index = Index::new(members, Vec::new());
        assert_eq!(index.summary, "2 cases: 1 good, 1 bad.");
        let names: Vec<_> = index.cases.iter().map(|case| case.name.as_str()).collect();
        assert_eq!(names, ["a", "b"]);
        let rows: Vec<_> = index
            .comparison
            .iter()
            .map(|row| (row.quantity.as_str(), row.values.join(" ")))
            .collect();
        assert_eq!(
            rows,
            [
                ("Clearance b", "20 mm 1.0".to_owned()),
                ("Forcing", "– 4.3".to_owned()),
                ("Impacts per period z", "2.000 –".to_owned()),
                ("Area", "Z3 Z1".to_owned()),
            ]
        );
        assert_eq!(index.cases[0].cells[0], Cell { text: "20 mm".into(), order: Some(0.02) });
        assert_eq!(index.cases[1].cells[0], Cell { text: "1.0 units".into(), order: None });
    }

    #[test]
    fn only_an_index_is_taken_for_one() {
        let index = Index::new(vec![member("a", "good", &[])], Vec::new());
        for (name, bytes) in index.files().expect("rendered") {
            let text = String::from_utf8(bytes).expect("UTF-8");
            assert!(is_index(&text), "{}", name.display());
        }
        assert!(!is_index("# My own notes\n\nWritten after `vinesink report`.\n"));
    }
}
