//! Runs the program on a design and reads what it says.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;
use tempfile::TempDir;

use crate::designs::Design;

/// A design in a folder of its own.
pub struct Bench {
    folder: TempDir,
    name: String,
}

impl Bench {
    pub fn new(design: &Design) -> Self {
        let bench =
            Self { folder: tempfile::tempdir().expect("a folder"), name: design.name.clone() };
        std::fs::write(bench.case(), &design.text).expect("written");
        bench
    }

    pub fn case(&self) -> PathBuf {
        self.at(&format!("{}.toml", self.name))
    }

    pub fn at(&self, file: &str) -> PathBuf {
        self.folder.path().join(file)
    }

    /// What a command prints as JSON, if it could be done.
    pub fn json(&self, command: &str, options: &[&str]) -> Option<Value> {
        self.json_of(command, &self.case(), options)
    }

    pub fn json_of(&self, command: &str, case: &Path, options: &[&str]) -> Option<Value> {
        let more = options.iter().copied().chain(["--format", "json"]);
        let output = run(command, case, more);
        serde_json::from_slice(&output.stdout).ok()
    }

    /// `report.json`.
    pub fn report(&self) -> Option<Value> {
        let out = self.at("reports");
        run("report", &self.case(), ["--criteria-only", "--out", out.to_str()?]);
        let text = std::fs::read(out.join(&self.name).join("report.json")).ok()?;
        serde_json::from_slice(&text).ok()
    }

    /// The first row of a sweep over a case, by column.
    pub fn row(&self, text: &str) -> Option<Vec<(String, String)>> {
        let case = self.at("swept.toml");
        std::fs::write(&case, text).ok()?;
        let out = self.at("sweeps");
        run("sweep", &case, ["--csv", "--out", out.to_str()?]);
        let table = std::fs::read_to_string(out.join("swept").join("sweep.csv")).ok()?;
        let mut lines = table.lines();
        let (head, row) = (lines.next()?, lines.next()?);
        let name = |column: &str| column.split([' ', '(']).next().unwrap_or_default().to_owned();
        Some(head.split(',').map(name).zip(row.split(',').map(str::to_owned)).collect())
    }
}

fn run<'a>(command: &str, case: &Path, options: impl IntoIterator<Item = &'a str>) -> Output {
    let built = || env!("CARGO_BIN_EXE_vinesink").to_owned();
    let program = std::env::var("VINESINK_PROGRAM").unwrap_or_else(|_| built());
    Command::new(program).arg(command).arg(case).args(options).output().expect("it runs")
}
