//! A report.json of any text, compared with itself and with a report of the program, and listed in an index.
#![no_main]

use std::collections::BTreeMap;
use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;
use vinesink::diff::markdown::markdown;
use vinesink::diff::{Difference, Document, Reports};
use vinesink::report::index::{IndexedReport, Summary, files};

const OWN: &str = include_str!("../../corpus/report/footbridge.json");

static KNOWN: LazyLock<Reports> = LazyLock::new(|| reports(OWN).expect("a report"));

fn reports(text: &str) -> Option<Reports> {
    let report = Document::parse("report.json", text, BTreeMap::new()).ok()?;
    Some([(String::new(), report)].into())
}

fuzz_target!(|text: &str| {
    if let Ok(summary) = Summary::read("report.json", text) {
        let member =
            IndexedReport { name: "one".to_owned(), summary, files: Vec::new(), orphan: false };
        let _ = files(vec![member], Vec::new());
    }
    let Some(read) = reports(text) else { return };
    for other in [&read, &*KNOWN] {
        let difference = Difference::of(("old", other), ("new", &read));
        let _ = markdown(&difference, [None, None]);
    }
});
