//! A record of any bytes, of a case that is driven by one.
#![no_main]

use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;
use vinesink::case::Case;

static CASES: LazyLock<[Case; 3]> = LazyLock::new(|| {
    let physical = include_str!("../../../cases/tower-record.toml");
    let reduced = "title = \"t\"\nsource = \"s\"\n[reduced]\nmass_ratio = 0.015\ndamping = 0.5\nrestitution = 0.6\n\
        clearance = 1.0\nkind = \"record\"\nquantity = \"force\"\nfile = \"a.csv\"\n";
    let even = physical.replace(
        "kind = \"record\"",
        "kind = \"record\"\nrate = \"50 Hz\"\nunit = \"g\"\ngaps = \"linear\"",
    );
    [physical, reduced, &even].map(|text| Case::parse("case.toml", text).expect("a case"))
});

fuzz_target!(|file: &[u8]| {
    for case in CASES.iter().cloned() {
        match case.with_record("record.csv", file) {
            Ok(case) => {
                let record = &case.recording.as_ref().expect("recorded").records()[0];
                assert!(record.samples.len() > 1 && record.peak().is_finite());
            }
            Err(error) => vinesink_fuzz::told(error),
        }
    }
});
