//! The index of a folder of reports: every case with its verdict and its key numbers, and the cases
//! side by side. Made from the `report.json` of each, not from the cases.

mod cell;
mod summary;

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::Serialize;

use super::numbers::{LengthFormat, decibels, significant};
use super::render::{self, RenderError};
use cell::{Cell, NOTHING};
pub use summary::{BandSummary, Summary, Verdict};

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
pub struct CaseReport {
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
    /// What is said first, and the class of its colour.
    verdict: String,
    tone: &'static str,
    /// Its place in a sorted column.
    order: u8,
    headline: String,
    /// How many notes the report has, if it has any.
    notes: Option<String>,
    cells: Vec<Cell>,
    figure: Option<Picture>,
    has_tradeoff: bool,
    has_sweep: bool,
}

/// The first figure of a case, which is shown where cases stand side by side.
#[derive(Debug, Clone, Serialize)]
struct Picture {
    /// Path from the index.
    path: String,
    /// What to see, for those who cannot see it.
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
    /// Whether Markdown has it as well, where seven columns are the limit.
    always: bool,
    /// What it says of a case with a band.
    #[serde(skip)]
    along_band: fn(&BandSummary) -> Option<String>,
    /// The key number that it shows of a case without one, or where a band says nothing.
    #[serde(skip)]
    quantity: &'static str,
    /// The key number that some cases have instead, with what it needs before and after it.
    #[serde(skip)]
    instead: Option<(&'static str, &'static str, &'static str)>,
}

const fn column(
    title: &'static str,
    along_band: fn(&BandSummary) -> Option<String>,
    quantity: &'static str,
) -> Column {
    Column { title, always: true, along_band, quantity, instead: None }
}

const CHANGE: Column = column("Change", BandSummary::change, "Change of the peak");

const COLUMNS: [Column; 6] = [
    Column {
        instead: Some(("Clearance", "", " units")),
        ..column("Clearance b", |_| None, "Clearance b")
    },
    Column {
        instead: Some(("Frequency ratio", "Ω = ", "")),
        ..column("Excitation", BandSummary::range, "Excitation frequency")
    },
    Column {
        always: false,
        ..column("Without absorber", BandSummary::bare, "Vibration of the bare oscillator")
    },
    Column {
        instead: Some(("Peak of the exact symmetric orbit", "", " (exact orbit)")),
        ..column("With absorber", BandSummary::absorber, "Vibration with the absorber, peak")
    },
    CHANGE,
    column("Tuned mass damper", BandSummary::damper, "Vibration with a tuned mass damper"),
];

impl BandSummary {
    fn range(&self) -> Option<String> {
        let [from, to] = &self.ends;
        // One unit is enough for two numbers that share it.
        let unit = to.split_once(' ').map_or("", |(_, unit)| unit);
        let from = from.strip_suffix(unit).map_or(from.as_str(), str::trim_end);
        Some(format!("{from} to {to}"))
    }

    fn bare(&self) -> Option<String> {
        Some(self.peaks.bare.map_or_else(|| "no limit".into(), |peak| self.length(peak)))
    }

    fn absorber(&self) -> Option<String> {
        self.peaks.absorber.map(|peak| self.length(peak.value))
    }

    fn change(&self) -> Option<String> {
        Some(decibels(self.peaks.absorber?.value / self.peaks.bare?))
    }

    fn damper(&self) -> Option<String> {
        let peak = self.peaks.damper?;
        let change = self.peaks.bare.map(|bare| format!(" ({})", decibels(peak / bare)));
        Some(format!("{}{}", self.length(peak), change.unwrap_or_default()))
    }

    fn length(&self, peak: f64) -> String {
        if self.metres {
            LengthFormat::fitting(peak).text(peak)
        } else {
            format!("{} units", significant(peak, 3))
        }
    }
}

/// Quantities of a reduced case that a physical one has by another name.
const ALIASES: [(&str, &str); 2] = [("Clearance", "Clearance b"), ("Restitution", "Restitution r")];

impl Index {
    /// The index of some reports, in the order of their names.
    pub fn new(mut members: Vec<CaseReport>, mut others: Vec<OtherPage>) -> Self {
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
    fn of(member: CaseReport) -> Self {
        let CaseReport { name, summary, has_tradeoff, has_sweep } = member;
        let notes = match summary.notes.len() {
            0 => None,
            1 => Some("1 note".to_owned()),
            several => Some(format!("{several} notes")),
        };
        let figure = summary.figures.first().map(|figure| Picture {
            path: format!("{name}/figures/{}.svg", figure.name),
            alt: figure.alt.clone(),
        });
        let verdict = verdict(&summary);
        Self {
            verdict: verdict.words(),
            tone: verdict.tone(),
            order: verdict.order(),
            notes,
            cells: COLUMNS.iter().map(|column| cell(&summary, column)).collect(),
            headline: summary.answer.headline,
            title: summary.title,
            name,
            figure,
            has_tradeoff,
            has_sweep,
        }
    }
}

fn verdict(summary: &Summary) -> Verdict {
    summary.verdict(&cell(summary, &CHANGE))
}

fn cell(summary: &Summary, column: &Column) -> Cell {
    let along_band = summary.band.as_ref().and_then(column.along_band);
    let own = || summary.value(column.quantity).map(str::to_owned);
    let instead = || {
        let (quantity, before, after) = column.instead?;
        Some(format!("{before}{}{after}", summary.value(quantity)?))
    };
    Cell::number(along_band.or_else(own).or_else(instead).as_deref())
}

fn summary(members: &[CaseReport]) -> String {
    let mut verdicts: Vec<Verdict> = members.iter().map(|one| verdict(&one.summary)).collect();
    verdicts.sort_by_key(|verdict| verdict.order());
    let kinds = verdicts.chunk_by(|a, b| a.order() == b.order());
    let kinds: Vec<String> = kinds.map(|kind| kind[0].count(kind.len())).collect();
    let cases = if members.len() == 1 { "case" } else { "cases" };
    format!("{} {cases}: {}.", members.len(), kinds.join(", "))
}

/// What is known along bands, then every quantity that a case has, in the order of the reports, with each
/// case's value.
fn comparison(members: &[CaseReport]) -> Vec<Comparison> {
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
    let value = |member: &CaseReport, quantity: &str| {
        let mut rows = member.summary.key_rows.iter();
        let row = rows.find(|row| common_name(&row.quantity) == quantity);
        row.map_or_else(|| NOTHING.to_owned(), |row| row.value.clone())
    };
    let row = |quantity: &str| Comparison {
        quantity: quantity.to_owned(),
        values: members.iter().map(|member| value(member, quantity)).collect(),
    };
    let along_band = COLUMNS.iter().filter_map(|column| {
        let value = |member: &CaseReport| member.summary.band.as_ref().and_then(column.along_band);
        let values: Vec<Option<String>> = members.iter().map(value).collect();
        values.iter().any(Option::is_some).then(|| Comparison {
            quantity: format!("{}, over the band", column.title),
            values: values.into_iter().map(|value| value.unwrap_or(NOTHING.to_owned())).collect(),
        })
    });
    along_band.chain(quantities.into_iter().map(row)).collect()
}

fn common_name(quantity: &str) -> &str {
    ALIASES.iter().find(|(other, _)| *other == quantity).map_or(quantity, |(_, name)| name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn member(name: &str, tone: &str, rows: &[(&str, &str)]) -> CaseReport {
        let rows: Vec<_> = rows
            .iter()
            .map(|(quantity, value)| serde_json::json!({"quantity": quantity, "value": value}))
            .collect();
        let text = serde_json::json!({
            "format": "vinesink/report@1", "title": "T", "notes": [], "figures": [],
            "verdict": {"tone": tone, "headline": "H"}, "key_rows": rows,
        });
        let summary = Summary::read(name, &text.to_string()).expect("a report");
        CaseReport { name: name.to_owned(), summary, has_tradeoff: false, has_sweep: false }
    }

    #[test]
    fn cases_come_by_name_and_quantities_in_the_order_of_the_reports() {
        let physical =
            [("Clearance b", "20 mm"), ("Impacts per period z", "2.000"), ("Area", "Z3")];
        let reduced = [("Clearance", "1.0"), ("Forcing", "4.3"), ("Area", "Z1")];
        let members = vec![member("b", "bad", &reduced), member("a", "good", &physical)];
        let index = Index::new(members, Vec::new());
        assert_eq!(index.summary, "2 cases: 1 works, 1 does nothing.");
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
