//! What becomes of chunks that are all there: one file of results, on request as text, and a page.

use std::path::{Path, PathBuf};

use ::csv::Writer;
use clap::Args;
use miette::{IntoDiagnostic, Result, WrapErr as _, miette};
use vinesink::case::SweepParameter;
use vinesink::digest::sha256;
use vinesink::report::sweep::{AxisShown, MOST_POINTS, Swept};
use vinesink::store::{self, Growing};
use vinesink::sweep::columns::{self, Column};
use vinesink::sweep::csv;
use vinesink::sweep::limits::{StabilityLimit, stability_limits};
use vinesink::sweep::parquet::{self, Results};

use super::super::progress::Progress;
use super::super::{Outcome, index, output};
use super::{Sweep, shown};

/// What is written besides the results.
#[derive(Debug, Args)]
pub struct Wanted {
    /// Also write sweep.csv, with the units in its first line
    #[arg(long)]
    csv: bool,
    /// Write the page into REPORTS/<name>, where the case's report is, instead of beside the results
    #[arg(long, value_name = "REPORTS")]
    report: Option<PathBuf>,
}

impl Sweep {
    /// Puts all chunks together, one at a time, and writes what else is wanted.
    pub(super) fn merge(&self, wanted: &Wanted) -> Result<Outcome> {
        if let [first, ..] = self.missing()?.as_slice() {
            return Err(miette!(
                help = "`vinesink sweep run CASE` works out what is missing",
                "chunk {first} is not there, or is damaged"
            ));
        }
        let path = self.folder.join("sweep.parquet");
        let empty = columns::empty(&self.plan);
        self.put_together(&path, &empty).wrap_err_with(|| unfinished(&path))?;
        self.shards()?.sweep_up()?;
        output::print_path(&path)?;
        if wanted.csv {
            let text = self.folder.join("sweep.csv");
            written_as_text(&path, &text, &empty).wrap_err_with(|| unfinished(&text))?;
            output::print_path(&text)?;
        }
        if self.plan.points() > MOST_POINTS as u64 {
            output::complain(&format!(
                "There is no page of more than {MOST_POINTS} points; the results are whole."
            ));
            return Ok(Outcome::Done);
        }
        self.write_page(&path, empty, wanted.report.as_deref())?;
        Ok(Outcome::Done)
    }

    fn put_together(&self, path: &Path, empty: &[Column]) -> Result<()> {
        let shards = self.shards()?;
        let notes = vec![
            ("vinesink.sweep".to_owned(), self.plan.identity.clone()),
            ("vinesink.version".to_owned(), env!("CARGO_PKG_VERSION").to_owned()),
            ("vinesink.case".to_owned(), self.case_text.clone()),
        ];
        let mut merged = parquet::begin(Growing::begin(path)?, empty, &notes).into_diagnostic()?;
        let progress = Progress::new("chunks", self.plan.chunks());
        for chunk in 0..self.plan.chunks() {
            let file = shards.read(chunk)?;
            let which = || shown(&shards.path(chunk));
            parquet::append(&mut merged, &file).into_diagnostic().wrap_err_with(which)?;
            progress.advance(1);
        }
        Ok(merged.into_inner().into_diagnostic()?.finish()?)
    }

    /// Maps or diagrams with what they say in words.
    fn write_page(
        &self,
        merged: &Path,
        mut columns: Vec<Column>,
        reports: Option<&Path>,
    ) -> Result<()> {
        let results = Results::open(store::open(merged)?).into_diagnostic()?;
        for group in 0..results.groups() {
            results.add_to(&mut columns, group).into_diagnostic()?;
        }
        let settings = &self.plan.settings;
        let bytes = std::fs::read(merged).into_diagnostic().wrap_err_with(|| shown(merged))?;
        let swept = Swept {
            case: &self.case,
            axes: settings.axes.iter().map(|axis| AxisShown::of(&self.case, axis)).collect(),
            columns: &columns,
            starts: settings.starts,
            periods: settings.periods,
            limits: self.limits(),
            results_sha256: sha256(&bytes),
        };
        let name = self.folder.file_name().unwrap_or_default();
        let files = swept.files()?;
        let folder = reports.map_or_else(|| self.folder.clone(), |reports| reports.join(name));
        store::add_to_folder(&folder, &files)?;
        if let Some(reports) = reports {
            index::refresh(reports)?;
        }
        output::print_path(&folder.join("sweep.html"))
    }

    /// Of the exact orbit, which a map over frequency and clearance shows.
    fn limits(&self) -> Vec<StabilityLimit> {
        let axes = &self.plan.settings.axes;
        let of = |parameter| axes.iter().find(|axis| axis.parameter == parameter);
        match (axes.len(), of(SweepParameter::Frequency), of(SweepParameter::Clearance)) {
            (2, Some(frequency), Some(_)) => stability_limits(&self.case, &frequency.values),
            _ => Vec::new(),
        }
    }
}

/// The merged results once more as text, a chunk at a time.
fn written_as_text(merged: &Path, path: &Path, empty: &[Column]) -> Result<()> {
    let results = Results::open(store::open(merged)?).into_diagnostic()?;
    let mut writer = Writer::from_writer(Growing::begin(path)?);
    csv::header(&mut writer, empty).into_diagnostic()?;
    for group in 0..results.groups() {
        let mut columns = empty.to_vec();
        results.add_to(&mut columns, group).into_diagnostic()?;
        csv::rows(&mut writer, &columns).into_diagnostic()?;
    }
    let text = writer.into_inner().map_err(|error| error.into_error()).into_diagnostic()?;
    Ok(text.finish()?)
}

fn unfinished(path: &Path) -> String {
    format!(
        "{} could not be written; all chunks are kept, and `vinesink sweep merge` tries again",
        shown(path)
    )
}
