//! A case file of any text: read, or refused with a message that is short.
#![no_main]

use libfuzzer_sys::fuzz_target;
use vinesink::case::Case;

fuzz_target!(|text: &str| {
    if let Err(error) = Case::parse("case.toml", text) {
        assert!(error.problems().count() > 0);
        vinesink_fuzz::told(error);
    }
});
