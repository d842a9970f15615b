//! What becomes of chunks that are all there: one file of results, on request as text, and a page.

use std::path::{Path, PathBuf};

use ::csv::Writer;
use clap::Args;
use miette::{IntoDiagnostic, Result, WrapErr as _, miette};
use vinesink::digest::sha256;
use vinesink::program::progress::Progress;
use vinesink::program::{output, reports};
use vinesink::report::sweep::{MOST_POINTS, Swept};
use vinesink::store::{self, Growing, Output, Turn};
use vinesink::sweep::columns::Column;
use vinesink::sweep::csv;
use vinesink::sweep::parquet;

use super::{Sweep, shown};

/// What is written besides the results.
#[derive(Debug, Args)]
pub struct ResultFiles {
    /// Also write sweep.csv, with the units in its first line
    #[arg(long)]
    csv: bool,
    /// Write the page into REPORTS/<name>, where the case's report is, instead of beside the results
    #[arg(long, value_name = "REPORTS")]
    report: Option<PathBuf>,
}

impl Sweep {
    /// Refuses a sweep of which chunks are not there.
    pub(super) fn is_whole(&self) -> Result<()> {
        if let [first, ..] = self.missing()?.as_slice() {
            return Err(miette!(
                help = "`vinesink sweep run CASE` works out what is missing",
                "chunk {first} is not there, or is damaged"
            ));
        }
        Ok(())
    }

    /// Puts all chunks together, one at a time, and writes what else is wanted, while nobody else works on them.
    pub(super) fn merge(&self, wanted: &ResultFiles, turn: &Turn) -> Result<bool> {
        self.is_whole()?;
        let path = self.folder.join("sweep.parquet");
        self.put_together(&path).wrap_err_with(|| unfinished(&path))?;
        self.shards()?.sweep_up(turn)?;
        output::print_path(&path)?;
        if wanted.csv {
            let text = self.folder.join("sweep.csv");
            self.write_as_text(&text).wrap_err_with(|| unfinished(&text))?;
            output::print_path(&text)?;
        }
        if self.grid().points() > MOST_POINTS as u64 {
            output::complain(&format!(
                "There is no page of more than {MOST_POINTS} points; the results are whole."
            ));
            return Ok(true);
        }
        self.write_page(&path, wanted.report.as_deref())?;
        Ok(true)
    }

    /// Reads the chunks in their order, one at a time, so that memory holds no more.
    fn each_chunk(&self, mut of: impl FnMut(Vec<Column>) -> Result<()>) -> Result<()> {
        let shards = self.shards()?;
        let progress = Progress::new("chunks", self.grid().chunks());
        for chunk in 0..self.grid().chunks() {
            let path = shards.path(chunk);
            let mut columns = self.of.empty();
            let rows = usize::try_from(self.grid().points_per_chunk()).unwrap_or(usize::MAX);
            let read = parquet::read(store::open(&path)?, &mut columns, rows);
            read.into_diagnostic().wrap_err_with(|| shown(&path))?;
            of(columns)?;
            progress.advance(1);
        }
        Ok(())
    }

    fn put_together(&self, path: &Path) -> Result<()> {
        let notes = vec![
            ("vinesink.sweep".to_owned(), self.grid().identity.clone()),
            ("vinesink.version".to_owned(), env!("CARGO_PKG_VERSION").to_owned()),
            ("vinesink.case".to_owned(), self.case_text.clone()),
        ];
        let merged = parquet::begin(Growing::begin(path)?, &self.of.empty(), &notes);
        let mut merged = merged.into_diagnostic()?;
        self.each_chunk(|columns| parquet::append(&mut merged, &columns).into_diagnostic())?;
        Ok(merged.into_inner().into_diagnostic()?.finish()?)
    }

    fn write_as_text(&self, path: &Path) -> Result<()> {
        let mut writer = Writer::from_writer(Growing::begin(path)?);
        csv::header(&mut writer, &self.of.empty()).into_diagnostic()?;
        self.each_chunk(|columns| csv::rows(&mut writer, &columns).into_diagnostic())?;
        let text = writer.into_inner().map_err(|error| error.into_error()).into_diagnostic()?;
        Ok(text.finish()?)
    }

    /// Maps or diagrams with what they say in words.
    fn write_page(&self, merged: &Path, reports: Option<&Path>) -> Result<()> {
        let mut columns = self.of.empty();
        self.each_chunk(|chunk| {
            for (column, more) in columns.iter_mut().zip(chunk) {
                column.cells.extend(more.cells);
            }
            Ok(())
        })?;
        let settings = &self.grid().settings;
        let bytes = std::fs::read(merged).into_diagnostic().wrap_err_with(|| shown(merged))?;
        let swept = Swept {
            case: self.of.shown(),
            axes: self.of.axes(),
            columns: &columns,
            starts: settings.starts,
            periods: settings.periods,
            limits: self.of.limits(),
            results_sha256: sha256(&bytes),
        };
        let files = swept.files()?;
        let out = reports.unwrap_or(&self.out);
        Output::open(out)?.add(&self.name, &files)?;
        reports.map_or(Ok(()), reports::refresh)?;
        output::print_path(&out.join(&self.name).join("sweep.html"))
    }
}

fn unfinished(path: &Path) -> String {
    format!(
        "{} could not be written; all chunks are kept, and `vinesink sweep merge` tries again",
        shown(path)
    )
}
