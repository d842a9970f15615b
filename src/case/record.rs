//! What a case that is driven by a record says of it, and the samples in its file.

use std::sync::{Arc, OnceLock};

use toml::Spanned;
use toml::de::DeValue;

use super::error::{CaseError, Problem};
use super::excitation::ExcitationTable;
use super::quantity::{number_in, unit_in_brackets};
use super::reader::{Reader, Table};
use super::{Case, warnings};
use crate::digest::text_sha256;
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
    /// A file of two columns.
    File {
        /// Its path, relative to the case file.
        path: String,
        /// SHA-256 of its text as of a case's, and its samples in SI; none until [`Case::with_record`] has been given them.
        read: Option<(String, Record)>,
    },
    /// Random numbers.
    Spectrum(Spectrum),
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
                read.as_ref().map_or(&[], |(_, record)| std::slice::from_ref(record))
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
    /// The text has a head, `time (s),acceleration (m/s²)`, without units beside `[reduced]`, and then a sample a line,
    /// the times ascending. Lines that begin with `#` are passed over.
    ///
    /// # Errors
    /// [`CaseError`] with the lines that are wrong: a head without units or with those of something else, values that
    /// are no numbers, times that do not ascend.
    pub fn with_record(mut self, name: &str, text: &str) -> Result<Self, CaseError> {
        let visible = text.strip_prefix('\u{feff}').unwrap_or(text);
        if let Some(Recording { quantity, source: RecordSource::File { read, .. }, .. }) =
            &mut self.recording
        {
            let units = self.design.units();
            let physical = units.physical;
            let mut record =
                Record { quantity: *quantity, samples: Vec::new(), base_velocity: 0.0 };
            let most = LARGEST / record.reduced(&units, 1.0).abs();
            record.samples = samples(visible, *quantity, physical, most).map_err(|problems| {
                let error = CaseError::new(name, visible, problems, 0);
                match is_record(visible, *quantity, physical) {
                    true => error,
                    false => error.without_text(
                        "a record",
                        &format!(
                            "begin it with the line {}; its own is not shown, for it may be another file",
                            head(*quantity, physical)
                        ),
                    ),
                }
            })?;
            *read = Some((text_sha256(text), record));
            self.warnings = warnings::of(&self);
        }
        Ok(self)
    }
}

fn dimension(of: RecordQuantity) -> Dimension {
    match of {
        RecordQuantity::BaseAcceleration => Dimension::Acceleration,
        RecordQuantity::BaseDisplacement => Dimension::Length,
        RecordQuantity::Force => Dimension::Force,
    }
}

/// A head of a file.
fn head(of: RecordQuantity, physical: bool) -> &'static str {
    match of {
        _ if !physical => "time,value",
        RecordQuantity::BaseAcceleration => "time (s),acceleration (m/s²)",
        RecordQuantity::BaseDisplacement => "time (s),displacement (mm)",
        RecordQuantity::Force => "time (s),force (N)",
    }
}

/// The lines that are no comments, without what surrounds them.
pub(super) fn lines(text: &str) -> impl Iterator<Item = &str> {
    text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'))
}

/// Whether a text is surely meant to be a record, and may be quoted: its head has a unit that fits, or the names that
/// stand there without units.
fn is_record(text: &str, quantity: RecordQuantity, physical: bool) -> bool {
    let Some(head) = lines(text).next() else { return false };
    let has_unit = |(of, cell): (Dimension, &str)| unit_in_brackets(of, cell).is_ok();
    let units = cells(head).map(|(time, value)| {
        [(Dimension::Time, time), (dimension(quantity), value)].into_iter().any(has_unit)
    });
    units == Some(true) || !physical && head.replace(' ', "") == self::head(quantity, false)
}

/// Largest value, dimensionless: beyond it rounding hides the walls whatever the structure.
const LARGEST: f64 = 1e15;
/// Problems after which a file is not read further: who took the wrong file has one in every line.
const MOST_PROBLEMS: usize = 5;

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

/// The two cells of a line.
fn cells(line: &str) -> Option<(&str, &str)> {
    line.split_once(',').filter(|(_, value)| !value.contains(','))
}

fn samples(
    text: &str,
    quantity: RecordQuantity,
    physical: bool,
    most: f64,
) -> Result<Vec<[f64; 2]>, Vec<Problem>> {
    let mut lines = lines(text);
    // An empty text has no line: its beginning.
    let head = lines.next().unwrap_or(&text[..0]);
    let help = format!("begin the file with {}", self::head(quantity, physical));
    let Some((time, value)) = cells(head) else {
        let message = "the head of the record does not name two columns".to_owned();
        return Err(vec![*problem(text, head, message, "expected time and value", &help)]);
    };
    let unit = |dimension: Dimension, column: &'static str, cell| {
        let wrong = |(what, accepted): (String, String)| {
            let message = format!("the {column} of the record {what}");
            let (expected, help) = match physical {
                true => ("expected a unit between brackets", &format!("{accepted}; {help}")),
                false => ("expected a name without a unit", &help),
            };
            problem(text, cell, message, expected, help)
        };
        let dimension = if physical { dimension } else { Dimension::Number };
        unit_in_brackets(dimension, cell).map_err(wrong)
    };
    let units = match (
        unit(Dimension::Time, "time", time),
        unit(self::dimension(quantity), "value", value),
    ) {
        (Ok(time), Ok(value)) => [time, value],
        (time, value) => {
            return Err(time.err().into_iter().chain(value.err()).map(|one| *one).collect());
        }
    };
    let (mut samples, mut problems): (Vec<[f64; 2]>, Vec<Problem>) = (Vec::new(), Vec::new());
    for line in lines {
        match sample(text, line, units, most, samples.last()) {
            Ok(sample) => samples.push(sample),
            Err(found) => problems.push(*found),
        }
        if problems.len() >= MOST_PROBLEMS {
            break;
        }
    }
    if problems.is_empty() && samples.len() < 2 {
        let message = "the record has fewer than two samples".to_owned();
        problems.push(*problem(text, head, message, "expected at least two lines below", &help));
    }
    if problems.is_empty() { Ok(samples) } else { Err(problems) }
}

/// A line with a time later than the last one.
fn sample(
    text: &str,
    line: &str,
    units: [&Unit; 2],
    most: f64,
    last: Option<&[f64; 2]>,
) -> Result<[f64; 2], Box<Problem>> {
    let Some((time, value)) = cells(line) else {
        let message = "a line of the record does not have two values".to_owned();
        let help = "separate two numbers by a comma; the decimal point is a point";
        return Err(problem(text, line, message, "expected time and value", help));
    };
    let number = |cell: &str, unit| {
        number_in(cell, unit).ok_or_else(|| {
            let message = format!("\"{}\" is no number", cell.trim());
            let help = "write numbers such as 0.25 or 2.5e-1";
            problem(text, cell, message, "expected a number", help)
        })
    };
    let found = [number(time, units[0])?, number(value, units[1])?];
    match last {
        Some(last) if last[0] >= found[0] => {
            let message = "the times of the record do not ascend".to_owned();
            let help = "sort the lines, and keep one of each time";
            Err(problem(text, time, message, "expected a later time than above", help))
        }
        _ if found[1].abs() > most => {
            let message = "a value of the record is too large for the case".to_owned();
            let help = "check its unit, and those of the case: one is many orders of magnitude away from the others";
            Err(problem(text, value, message, "expected values as a structure meets them", help))
        }
        _ => Ok(found),
    }
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
        let source = RecordSource::File { path: excitation.file.clone()?, read: None };
        return Some(Recording::new(quantity, source));
    };
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
