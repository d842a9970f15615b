//! Results of a sweep in pandas, polars and DuckDB, through the script that is shown to users.
//!
//! Needs a Python with the packages, named in `VINESINK_PYTHON`; `.ci/deep` makes one.

use crate::common;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use tempfile::TempDir;

const SWEEP: &str = r#"[sweep]
starts = 1
periods = 48
record = ["regime", "reduction_db"]
clearance = { from = "5 mm", to = "40 mm", count = 36 }
frequency = { values = ["8 Hz", "8.3 Hz", "8.35 Hz", "8.7 Hz"] }
"#;

#[test]
#[ignore = "deep"]
fn three_libraries_read_the_same() {
    let python = std::env::var("VINESINK_PYTHON")
        .expect("VINESINK_PYTHON names a Python with pandas, polars and duckdb");
    let folder = TempDir::new().expect("a folder");
    let case = format!("{}{SWEEP}", common::table_1_case());
    fs::write(folder.path().join("map.toml"), case).expect("written");
    let mut sweep = Command::new(env!("CARGO_BIN_EXE_vinesink"));
    sweep.current_dir(folder.path()).args(["sweep", "map.toml", "--csv"]);
    assert!(sweep.status().expect("it runs").success());
    // What the script should say, from the text.
    let csv = fs::read_to_string(folder.path().join("sweeps/map/sweep.csv")).expect("written");
    let mut groups: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    for line in csv.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        groups.entry(fields[3]).or_default().push(fields[4].parse().expect("a reduction"));
    }
    let mut wanted: Vec<(usize, &str, f64)> = groups
        .iter()
        .map(|(regime, all)| (all.len(), *regime, all.iter().sum::<f64>() / all.len() as f64))
        .collect();
    wanted.sort_by(|a, b| b.0.cmp(&a.0).then(a.1.cmp(b.1)));
    assert!(wanted.len() > 2, "{wanted:?}");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/sweep/read.py");
    for reader in ["pandas", "polars", "duckdb"] {
        let output = Command::new(&python)
            .arg(&script)
            .args(["sweeps/map/sweep.parquet", "--with", reader])
            .current_dir(folder.path())
            .output()
            .expect("it runs");
        assert!(output.status.success(), "{reader}: {output:?}");
        let said = String::from_utf8(output.stdout).expect("text");
        let mut lines = said.lines();
        assert_eq!(
            lines.next(),
            Some("units: clearance m, frequency Hz, reduction_db dB"),
            "{reader}"
        );
        for (points, regime, reduction) in &wanted {
            // Rounded to three digits: the three add up in different orders.
            let line = lines.next().unwrap_or_default();
            let (name, rest) = line.split_once(": ").expect(line);
            let (count, rest) = rest.split_once(" points, ").expect(line);
            let mean: f64 = rest.trim_end_matches(" dB").parse().expect(line);
            assert_eq!((name, count.parse()), (*regime, Ok(*points)), "{reader}");
            assert!((mean - reduction).abs() < 0.000_6, "{reader}: {mean} {reduction}");
        }
        assert_eq!(lines.next(), None);
    }
}
