//! What a case that is driven by a record says of it, and the samples in its file.

use std::ops::Range;
use std::sync::{Arc, OnceLock};

use toml::Spanned;
use toml::de::DeValue;

use super::error::{CaseError, Problem};
use super::excitation::{ExcitationTable, Gaps};
use super::quantity::unit_in_brackets;
use super::reader::{Reader, Table};
use super::record_file::{self, RecordFormat, Wanted};
use super::{Case, warnings};
use crate::digest::file_sha256;
use crate::excitation::{Record, RecordQuantity, Spectrum};
use crate::quantity::Dimension;
use crate::quantity::unit::Unit;

/// What drives the oscillator, where that is a record or noise.
#[derive(Debug, Clone)]
pub struct Recording {
    /// What it is of.
    pub quantity: RecordQuantity,
    /// Where the values come from.
    pub source: RecordSource,
    /// Of a spectrum, made when they are first asked for; variants of a case share them.
    made: Arc<OnceLock<Vec<Record>>>,
}

impl PartialEq for Recording {
    fn eq(&self, other: &Self) -> bool {
        self.quantity == other.quantity && self.source == other.source
    }
}

/// Where the values of a record come from.
#[derive(Debug, Clone, PartialEq)]
pub enum RecordSource {
    /// A file.
    File {
        /// Its path, relative to the case file.
        path: String,
        /// What the case says of its columns.
        format: RecordFormat,
        /// Where its path stands in the text of the case.
        span: Range<usize>,
        /// What it holds; none until [`Case::with_record`] has been given that.
        read: Option<ReadRecord>,
    },
    /// Random numbers.
    Spectrum(Spectrum),
}

/// What the file of a record holds.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadRecord {
    /// SHA-256 of its bytes.
    pub sha256: String,
    /// Its samples in SI.
    pub record: Record,
    /// The unit in which its values are written.
    pub unit: &'static Unit,
}

impl Recording {
    fn new(quantity: RecordQuantity, source: RecordSource) -> Self {
        Self { quantity, source, made: Arc::default() }
    }

    /// The path of the file that must be read, relative to the case file.
    pub fn file(&self) -> Option<&str> {
        match &self.source {
            RecordSource::File { path, .. } => Some(path),
            RecordSource::Spectrum(_) => None,
        }
    }

    /// How many records it is.
    pub fn count(&self) -> usize {
        match &self.source {
            RecordSource::File { .. } => 1,
            RecordSource::Spectrum(spectrum) => spectrum.realisations as usize,
        }
    }

    /// The records; none of a file that was not read.
    pub fn records(&self) -> &[Record] {
        match &self.source {
            RecordSource::File { read, .. } => {
                read.as_ref().map_or(&[], |read| std::slice::from_ref(&read.record))
            }
            RecordSource::Spectrum(spectrum) => {
                self.made.get_or_init(|| spectrum.records(self.quantity).collect())
            }
        }
    }
}

impl Case {
    /// The records that drive it; none of another case, or of a file that was not read.
    pub fn records(&self) -> &[Record] {
        self.recording.as_ref().map_or(&[], Recording::records)
    }

    /// The case with the samples of its record; `name`, usually the path of the file, is for messages only. A case
    /// that names no file stays as it is.
    ///
    /// The file is text: a head whose last line names the columns and their units, `time (s),acceleration (g)`, without units
    /// beside `[reduced]`, and then a sample a line, the times ascending; or one of the PEER database. Columns stand between
    /// commas, semicolons, tabs or spaces. Lines that begin with `#` or `%` are passed over.
    ///
    /// # Errors
    /// [`CaseError`] with the lines that are wrong: columns without units or with those of something else, values that
    /// are no numbers, times that do not ascend, gaps.
    pub fn with_record(mut self, name: &str, file: impl AsRef<[u8]>) -> Result<Self, CaseError> {
        if let Some(Recording { quantity, source, .. }) = &mut self.recording
            && let RecordSource::File { format, read, .. } = source
        {
            let (units, quantity) = (self.design.units(), *quantity);
            let mut record = Record { quantity, samples: Vec::new(), base_velocity: 0.0 };
            let most = LARGEST / record.reduced(&units, 1.0).abs();
            let wanted = Wanted { format, quantity, physical: units.physical, most };
            let found = record_file::read(name, file.as_ref(), &wanted)?;
            record.samples = found.samples;
            let sha256 = file_sha256(file.as_ref());
            *read = Some(ReadRecord { sha256, record, unit: found.unit });
            self.warnings = warnings::of(&self);
        }
        Ok(self)
    }
}

pub(super) fn dimension(of: RecordQuantity) -> Dimension {
    match of {
        RecordQuantity::BaseAcceleration => Dimension::Acceleration,
        RecordQuantity::BaseDisplacement => Dimension::Length,
        RecordQuantity::Force => Dimension::Force,
    }
}

/// The lines that are no comments, without what surrounds them.
pub(super) fn lines(text: &str) -> impl Iterator<Item = &str> {
    text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'))
}

/// Largest value, dimensionless: beyond it rounding hides the walls whatever the structure.
const LARGEST: f64 = 1e15;

/// A problem with a part of the text.
pub(super) fn problem(
    text: &str,
    part: &str,
    message: String,
    expected: &str,
    help: &str,
) -> Box<Problem> {
    let start = part.as_ptr() as usize - text.as_ptr() as usize;
    Box::new(Problem::new(text, start..start + part.len(), message, expected).help(help))
}

/// Records of a spectrum unless the case says how many, the fewest lines that make noise, and the most samples of all
/// records together.
const REALISATIONS: u64 = 20;
const FEWEST_LINES: u64 = 10;
const MOST_SAMPLES: u64 = 20_000_000;

/// The densities of a spectrum as they are written.
fn densities<'a>(
    spectrum: &'a Spanned<DeValue<'a>>,
) -> impl Iterator<Item = &'a Spanned<DeValue<'a>>> {
    let corners = spectrum.get_ref().as_array().into_iter().flat_map(|all| all.iter());
    corners.filter_map(|corner| corner.get_ref().as_array()?.get(1))
}

/// What it says of its file's columns.
fn format(
    reader: &mut Reader,
    table: &Table,
    excitation: &ExcitationTable,
    quantity: RecordQuantity,
) -> Option<RecordFormat> {
    let mut format = RecordFormat {
        column: excitation.column.clone(),
        time_column: excitation.time_column.clone(),
        rate: excitation.rate,
        unit: None,
        linear_gaps: excitation.gaps == Some(Gaps::Linear),
    };
    if format.rate.is_some() && format.time_column.is_some() {
        let message = "`rate` and `time_column` say the same thing twice";
        let help = "remove one of the two lines: with a rate no times are read";
        reader.report(table.span_of("time_column"), message, "expected only one of the two", help);
        return None;
    }
    if let Some(written) = &excitation.unit {
        match unit_in_brackets(dimension(quantity), &format!("({written})")) {
            Ok(unit) => format.unit = Some(unit),
            Err((what, accepted)) => {
                let message = format!("`unit` {what}");
                reader.report(
                    table.span_of_value("unit"),
                    message,
                    "expected the unit of the values",
                    accepted,
                );
                return None;
            }
        }
    }
    Some(format)
}

/// What an excitation of the kind "record" says; none where something was reported.
pub(super) fn read(
    reader: &mut Reader,
    table: &Table,
    excitation: &ExcitationTable,
) -> Option<Recording> {
    let quantity = excitation.quantity?;
    let Some(corners) = excitation.spectrum.clone() else {
        for key in ["duration", "seed", "realisations"].into_iter().filter(|key| table.has(key)) {
            let message = format!("`{key}` has no meaning beside `file`");
            let help = "remove the line: it is for a spectrum";
            reader.report(table.span_of(key), message, "expected a file alone", help);
        }
        let path = excitation.file.clone()?;
        let (format, span) =
            (format(reader, table, excitation, quantity)?, table.span_of_value("file"));
        let source = RecordSource::File { path, format, span, read: None };
        return Some(Recording::new(quantity, source));
    };
    for key in
        ["column", "time_column", "rate", "unit", "gaps"].into_iter().filter(|key| table.has(key))
    {
        let message = format!("`{key}` has no meaning beside `spectrum`");
        let help = "remove the line: it is for a file";
        reader.report(table.span_of(key), message, "expected a spectrum alone", help);
    }
    for key in ["duration", "seed"].into_iter().filter(|key| !table.has(key)) {
        let message = format!("`{key}` is missing beside `spectrum`");
        let help = format!("add the line {}", reader.line(table, key));
        reader.report(table.span_of("spectrum"), message, "expected both", help);
    }
    if quantity != RecordQuantity::BaseAcceleration
        && let Some(value) = table.value("spectrum")
        && let Some(density) = densities(value).find(|one| one.get_ref().as_str().is_some())
    {
        let message = "a density of accelerations is none of this quantity";
        let expected = "expected plain numbers, in the squared SI unit of the quantity per Hz";
        let help = "write quantity = \"base-acceleration\", or the number without a unit";
        reader.report(density.span(), message, expected, help);
        return None;
    }
    let spectrum = Spectrum {
        corners,
        duration: excitation.duration?,
        seed: excitation.seed?,
        realisations: excitation.realisations.unwrap_or(REALISATIONS),
    };
    let lines = spectrum.lines();
    let lines = lines.end().saturating_sub(*lines.start()).saturating_add(1);
    let samples = spectrum.samples().saturating_mul(spectrum.realisations);
    if lines < FEWEST_LINES || samples > MOST_SAMPLES {
        let (message, help) = match lines < FEWEST_LINES {
            true => (
                format!("a record of that duration has {lines} lines of the spectrum"),
                "lines are one over the duration apart: make it longer, or the spectrum wider",
            ),
            false => (
                format!("the records have {samples} samples together"),
                "make them shorter or fewer, or end the spectrum at a lower frequency",
            ),
        };
        let expected =
            format!("expected at least {FEWEST_LINES} lines and at most {MOST_SAMPLES} samples");
        reader.report(table.span_of("duration"), message, expected, help);
        return None;
    }
    Some(Recording::new(quantity, RecordSource::Spectrum(spectrum)))
}
