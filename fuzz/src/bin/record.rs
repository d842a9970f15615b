//! A record of any text, of a case that is driven by one.
#![no_main]

use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;
use vinesink::case::Case;

static CASES: LazyLock<[Case; 2]> = LazyLock::new(|| {
    let physical = include_str!("../../../cases/tower-record.toml");
    let reduced = "title = \"t\"\nsource = \"s\"\n[reduced]\nmass_ratio = 0.015\ndamping = 0.5\nrestitution = 0.6\n\
        clearance = 1.0\nkind = \"record\"\nquantity = \"force\"\nfile = \"a.csv\"\n";
    [physical, reduced].map(|text| Case::parse("case.toml", text).expect("a case"))
});

fuzz_target!(|text: &str| {
    for case in CASES.iter().cloned() {
        match case.with_record("record.csv", text) {
            Ok(case) => {
                let record = &case.recording.as_ref().expect("recorded").records()[0];
                assert!(record.samples.len() > 1 && record.peak().is_finite());
            }
            Err(error) => vinesink_fuzz::told(error),
        }
    }
});
