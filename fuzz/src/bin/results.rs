//! Results of a sweep of any bytes.
#![no_main]

use std::sync::LazyLock;

use bytes::Bytes;
use libfuzzer_sys::fuzz_target;
use vinesink::case::Case;
use vinesink::sweep::{Plan, columns, parquet};

static PLAN: LazyLock<Plan> = LazyLock::new(|| {
    let text = include_str!("../../corpus/results.toml");
    Plan::of(&Case::parse("case.toml", text).expect("a case")).expect("a sweep")
});

fuzz_target!(|bytes: &[u8]| {
    let mut read = columns::empty(&PLAN);
    let most = usize::try_from(PLAN.points_per_chunk()).expect("few");
    if parquet::read(Bytes::copy_from_slice(bytes), &mut read, most).is_ok() {
        assert!(read.iter().all(|column| column.cells.len() <= most));
    }
});
