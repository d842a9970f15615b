//! The samples in the file of a record: which separator, decimal mark and columns it has is seen in it, a unit never
//! guessed.

use std::borrow::Cow;

use super::error::{CaseError, Problem};
use super::quantity::{leading_number, number_in, unit_in_brackets};
use super::record::{dimension, problem};
use crate::excitation::RecordQuantity;
use crate::quantity::Dimension;
use crate::quantity::unit::Unit;

/// What a case says of the file of its record.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RecordFormat {
    /// The column of the values, by its name in the head or its number.
    pub column: Option<String>,
    /// The column of the times.
    pub time_column: Option<String>,
    /// Samples in a second, or in a fast time of a reduced case, where the file has no times.
    pub rate: Option<f64>,
    /// The unit of the values.
    pub unit: Option<&'static Unit>,
    /// Whether a gap is a straight line.
    pub linear_gaps: bool,
}

/// What is asked of a file.
pub(super) struct Wanted<'a> {
    pub format: &'a RecordFormat,
    pub quantity: RecordQuantity,
    /// Whether the case has units.
    pub physical: bool,
    /// Largest value in SI.
    pub most: f64,
}

/// What a file holds.
pub(super) struct Found {
    pub samples: Vec<[f64; 2]>,
    /// In which the values are written.
    pub unit: &'static Unit,
}

/// Problems after which a file is not read further: who took the wrong file has one in every line.
const MOST_PROBLEMS: usize = 5;
/// Median steps above which samples are missing.
const GAP: f64 = 3.0;
/// Relative difference of rates that are one: some are nominal.
const SAME_RATE: f64 = 0.01;
/// Rounding of steps.
const ROUNDING: f64 = 1e-6;
/// Lines of numbers that surely are a table, and may be quoted.
const SURELY: usize = 3;
/// Lines in which it is looked for what most are like.
const SURVEYED: usize = 20_000;
/// Lines by which readings are told apart.
const COMPARED: usize = 100;
/// Lines of a head that a message shows, and characters of each.
const HEAD_LINES: usize = 4;
const HEAD_WIDTH: usize = 80;
/// What lines of a head have that say how often is sampled.
const RATES: [&str; 5] = ["rate", "hz", "sampl", "interval", "abtast"];

/// The text of a file, whose units may be in Latin-1.
///
/// # Errors
/// What it is instead, and what to do.
pub(super) fn text_of<'a>(
    name: &str,
    what: &str,
    bytes: &'a [u8],
) -> Result<Cow<'a, str>, (String, String)> {
    let pairs = |of: fn([u8; 2]) -> u16| {
        let units = bytes[2..].chunks_exact(2).map(|two| of([two[0], two[1]]));
        Cow::from(String::from_utf16_lossy(&units.collect::<Vec<u16>>()))
    };
    let text = match bytes {
        [0xff, 0xfe, ..] => pairs(u16::from_le_bytes),
        [0xfe, 0xff, ..] => pairs(u16::from_be_bytes),
        _ => {
            if let Some((is, advice)) = binary(name, bytes) {
                return Err((
                    format!("{name} is not {what}: it is {is}, not text"),
                    advice.to_owned(),
                ));
            }
            let visible = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
            let latin = || visible.iter().map(|byte| char::from(*byte)).collect::<String>();
            std::str::from_utf8(visible).map_or_else(|_| latin().into(), Cow::from)
        }
    };
    // A carriage return alone ends a line where nothing else does.
    Ok(if text.contains('\r') && !text.contains('\n') {
        text.replace('\r', "\n").into()
    } else {
        text
    })
}

/// What a file is that is no text, and how to make text of it.
fn binary(name: &str, bytes: &[u8]) -> Option<(&'static str, &'static str)> {
    const SHEET: (&str, &str) = (
        "an Excel workbook",
        "open it and save the sheet as \"CSV UTF-8 (Comma delimited)\", one line for each sample",
    );
    const GZIP: (&str, &str) = ("compressed", "unpack it first: gunzip, or for a zip file unzip");
    const TDMS: (&str, &str) = (
        "a TDMS file of LabVIEW or DIAdem",
        "export the channel as CSV, for example in Python with the package npTDMS: \
         TdmsFile.read(file).as_dataframe().to_csv(name)",
    );
    const MAT: (&str, &str) = (
        "a MAT file of MATLAB",
        "write the times and values to a text file in MATLAB: writematrix([t(:) x(:)], \"record.csv\")",
    );
    const HDF: (&str, &str) = (
        "an HDF5 file, as MATLAB's of version 7.3",
        "write the times and values to a text file: in MATLAB writematrix([t(:) x(:)], \"record.csv\")",
    );
    const OTHER: (&str, &str) =
        ("a binary file", "export the record as text, a time and a value a line");
    let ends = |with: &str| name.to_ascii_lowercase().ends_with(with);
    Some(match bytes {
        [b'P', b'K', 3, 4, ..] if ends(".zip") => GZIP,
        [b'P', b'K', 3, 4, ..] | [0xd0, 0xcf, 0x11, 0xe0, ..] => SHEET,
        [0x1f, 0x8b, ..] | [b'B', b'Z', b'h', ..] | [0xfd, b'7', b'z', b'X', b'Z', ..] => GZIP,
        [b'T', b'D', b'S', b'm', ..] => TDMS,
        _ if bytes.starts_with(b"MATLAB 5.0 MAT-file") => MAT,
        [0x89, b'H', b'D', b'F', ..] => HDF,
        _ if !bytes.contains(&0) => return None,
        _ if ends(".xls") || ends(".xlsx") => SHEET,
        _ if ends(".mat") => MAT,
        _ if ends(".tdms") => TDMS,
        _ => OTHER,
    })
}

/// What stands between two cells.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Separator {
    Tab,
    Semicolon,
    CommaAndSpace,
    Comma,
    Spaces,
}

/// How lines are read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Reading {
    separator: Separator,
    /// Whether numbers have a decimal comma.
    comma: bool,
}

impl Reading {
    /// Commas between columns, and decimal points.
    pub(super) const PLAIN: Self = Self { separator: Separator::Comma, comma: false };

    /// Those that a text may have.
    fn all(text: &str) -> impl Iterator<Item = Self> {
        use Separator::{Comma, CommaAndSpace, Semicolon, Spaces, Tab};
        let there = [('\t', Tab), (';', Semicolon), (',', Comma)];
        let there = there.into_iter().filter(|(mark, _)| text.contains(*mark)).map(|(_, one)| one);
        let mut all: Vec<Self> =
            there.chain([Spaces]).map(|separator| Self { separator, comma: false }).collect();
        if text.contains(',') {
            let there = [("\t", Tab), (";", Semicolon), (", ", CommaAndSpace), (" ", Spaces)];
            let there =
                there.into_iter().filter(|(mark, one)| *one == Spaces || text.contains(mark));
            all.extend(there.map(|(_, separator)| Self { separator, comma: true }));
        }
        all.into_iter()
    }

    /// The cells of a line; empty ones at its end are none.
    pub(super) fn cells(self, line: &str) -> Vec<&str> {
        let mut cells = match self.separator {
            Separator::Spaces => line.split_whitespace().collect(),
            Separator::CommaAndSpace => line.split(", ").collect(),
            Separator::Tab => quoted(line, '\t'),
            Separator::Semicolon => quoted(line, ';'),
            Separator::Comma => quoted(line, ','),
        };
        for cell in &mut cells {
            let inner = cell.trim();
            *cell = inner.strip_prefix('"').and_then(|one| one.strip_suffix('"')).unwrap_or(inner);
        }
        while cells.len() > 1 && cells.last().is_some_and(|last| last.is_empty()) {
            cells.pop();
        }
        cells
    }

    /// The names of a head's columns, of which there should be so many.
    fn names(self, line: &str, count: usize) -> Vec<&str> {
        if count == 1 && self.separator == Separator::Spaces && !line.contains(['\t', ';', ',']) {
            return vec![line];
        }
        let cells = self.cells(line);
        if self.separator != Separator::Spaces || cells.len() == count {
            return cells;
        }
        // What is in brackets belongs to the name before.
        let mut names: Vec<&str> = Vec::new();
        for cell in cells {
            match names.last_mut() {
                Some(last) if cell.starts_with(['(', '[']) || is_open(last) => {
                    let start = last.as_ptr() as usize - line.as_ptr() as usize;
                    let end = cell.as_ptr() as usize + cell.len() - line.as_ptr() as usize;
                    *last = &line[start..end];
                }
                _ => names.push(cell),
            }
        }
        names
    }

    /// A cell as a number with a decimal point.
    fn plain(self, cell: &str) -> Option<Cow<'_, str>> {
        match (self.comma, cell.contains(',')) {
            (false, false) => Some(cell.into()),
            (true, true) if !cell.contains('.') => Some(cell.replacen(',', ".", 1).into()),
            (true, false) if !cell.contains('.') => Some(cell.into()),
            _ => None,
        }
    }

    pub(super) fn number(self, cell: &str, unit: &Unit) -> Option<f64> {
        number_in(&self.plain(cell)?, unit)
    }

    /// How many cells a line has, and which of them are numbers.
    fn signature(self, line: &str) -> Signature {
        let is_number = |cell: &str| {
            let plain = self.plain(cell);
            plain.is_some_and(|cell| {
                let unsigned = cell.strip_prefix('-').unwrap_or(&cell);
                leading_number(unsigned) == Some(0..unsigned.len())
            })
        };
        let cells = self.cells(line);
        let numbers = cells.iter().enumerate().filter(|(_, cell)| is_number(cell));
        let numbers = numbers.fold(0, |all, (k, _)| all | 1 << k.min(Signature::MOST));
        Signature { count: cells.len(), numbers }
    }

    /// How it reads lines of so many columns.
    pub(super) fn words(self, count: usize) -> String {
        let mark = if self.comma { "commas" } else { "points" };
        if count == 1 {
            return format!("one column, with decimal {mark}");
        }
        let separator = match self.separator {
            Separator::Tab => "tabs",
            Separator::Semicolon => "semicolons",
            Separator::CommaAndSpace => "a comma and a space",
            Separator::Comma => "commas",
            Separator::Spaces => "spaces",
        };
        format!("{count} columns between {separator}, with decimal {mark}")
    }
}

/// What a line is like.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Signature {
    count: usize,
    /// A bit for each cell that is a number; the last stands for all further ones.
    numbers: u128,
}

impl Signature {
    const MOST: usize = 127;

    /// The share of its cells that are numbers.
    fn share(self) -> f64 {
        f64::from(self.numbers.count_ones()) / self.count.clamp(1, Self::MOST + 1) as f64
    }
}

/// The unit of a plain number.
fn pure() -> &'static Unit {
    const PURE: &Unit = &Unit { symbol: "", size: 1.0, exponent: 0, quotient: [1.0; 2] };
    PURE
}

fn is_open(name: &str) -> bool {
    let open = |[open, close]: [char; 2]| name.matches(open).count() > name.matches(close).count();
    open(['(', ')']) || open(['[', ']'])
}

/// The parts of a line between separators that do not stand in quotes.
fn quoted(line: &str, separator: char) -> Vec<&str> {
    let mut within = false;
    line.split(move |c: char| {
        within ^= c == '"';
        c == separator && !within
    })
    .collect()
}

/// A text with what it is a table of.
pub(super) struct RecordTable<'t> {
    text: &'t str,
    /// Lines before the first sample, comments among them.
    head: Vec<&'t str>,
    /// Lines of samples.
    rows: Vec<&'t str>,
    pub(super) reading: Reading,
    /// Other readings of the same lines that are as good, and their columns.
    pub(super) rivals: Vec<(Reading, usize)>,
    pub(super) count: usize,
    /// Whether it surely is a table of numbers.
    sure: bool,
}

/// A reading, what most lines are like in it, and the numbers in the first of those.
type Tried = (Reading, Signature, Vec<Vec<Option<f64>>>);

fn is_comment(line: &str) -> bool {
    line.starts_with(['#', '%'])
}

/// What most lines that have numbers are like in a reading: how many they are, and which of their cells are numbers.
fn usual(reading: Reading, lines: &[&str]) -> (usize, Signature) {
    let mut found: Vec<(usize, Signature)> = Vec::new();
    for line in lines.iter().filter(|line| !is_comment(line)) {
        let signature = reading.signature(line);
        if signature.numbers == 0 {
            continue;
        }
        if let Some((count, _)) = found.iter_mut().find(|(_, known)| *known == signature) {
            *count += 1;
        } else if found.len() < COMPARED {
            found.push((1, signature));
        }
    }
    found.into_iter().max_by_key(|(count, _)| *count).unwrap_or_default()
}

impl<'t> RecordTable<'t> {
    pub(super) fn of(text: &'t str, has_times: bool) -> Self {
        let lines: Vec<&str> =
            text.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
        let surveyed = &lines[..lines.len().min(SURVEYED)];
        let mut readings: Vec<(Reading, usize, Signature)> = Reading::all(text)
            .map(|reading| {
                let (count, signature) = usual(reading, surveyed);
                (reading, count, signature)
            })
            .collect();
        let most = readings.iter().map(|one| one.1).max().unwrap_or(0);
        readings.retain(|one| one.1 == most && most > 0);
        let best = readings.iter().map(|one| one.2.share()).fold(0.0, f64::max);
        readings.retain(|one| one.2.share() >= best);
        let Some((first, _, signature)) = readings.first().copied() else {
            let head: Vec<&str> =
                lines.iter().copied().take_while(|line| is_comment(line)).collect();
            let (head, rows) = lines.split_at((head.len() + 1).min(lines.len()));
            let count = head.last().map_or(0, |line| Reading::PLAIN.cells(line).len());
            let (head, rows) = (head.to_vec(), rows.to_vec());
            return Self {
                text,
                head,
                rows,
                reading: Reading::PLAIN,
                rivals: Vec::new(),
                count,
                sure: false,
            };
        };
        // Readings by which the numbers are the same are one.
        let first_rows = |reading: Reading, signature: Signature| -> Vec<Vec<Option<f64>>> {
            let of_kind = lines.iter().filter(|line| reading.signature(line) == signature);
            of_kind
                .take(COMPARED)
                .map(|line| {
                    reading.cells(line).iter().map(|cell| reading.number(cell, pure())).collect()
                })
                .collect()
        };
        let mut chosen: Vec<Tried> = Vec::new();
        for (reading, _, signature) in readings {
            let rows = first_rows(reading, signature);
            if !chosen.iter().any(|(.., known)| *known == rows) {
                chosen.push((reading, signature, rows));
            }
        }
        let begins = |reading: Reading, signature: Signature| {
            lines.iter().position(|line| !is_comment(line) && reading.signature(line) == signature)
        };
        if chosen.len() > 1 {
            let before = begins(first, signature).and_then(|at| at.checked_sub(1));
            let head = before.map(|at| lines[at].trim_start_matches(['#', '%']).trim());
            let named = |one: &Tried| {
                head.is_some_and(|head| one.0.names(head, one.1.count).len() == one.1.count)
            };
            let ascends =
                |one: &Tried| one.1.count > 1 && one.2.windows(2).all(|two| two[0][0] < two[1][0]);
            keep(&mut chosen, named);
            if has_times {
                keep(&mut chosen, ascends);
            }
        }
        let (reading, signature, _) = chosen.remove(0);
        let start = begins(reading, signature).unwrap_or(0);
        let rows: Vec<&str> =
            lines[start..].iter().copied().filter(|line| !is_comment(line)).collect();
        let sure = most >= SURELY
            && signature.share() == 1.0
            && 10 * most >= 9 * rows.len().min(SURVEYED - start);
        Self {
            text,
            head: lines[..start].to_vec(),
            rows,
            reading,
            rivals: chosen.into_iter().map(|one| (one.0, one.1.count)).collect(),
            count: signature.count,
            sure,
        }
    }

    /// The columns, by the last line of the head that has as many cells; and by a line of units below it.
    fn columns(&self) -> Vec<Column<'t>> {
        let named = |line: &&'t str| {
            let names = self.reading.names(line.trim_start_matches(['#', '%']).trim(), self.count);
            Some(names).filter(|names| names.len() == self.count)
        };
        let plain = self.head.iter().rev().filter(|line| !is_comment(line));
        let comments = self.head.iter().rev().filter(|line| is_comment(line));
        let mut rows: Vec<Vec<&'t str>> = plain.map_while(&named).take(2).collect();
        if rows.is_empty() {
            rows.extend(comments.map_while(&named).take(1));
        }
        let units =
            rows.first().filter(|row| rows.len() > 1 && row.iter().all(|cell| is_unit(cell)));
        let names =
            if units.is_some() { &rows[1] } else { rows.first().unwrap_or(const { &Vec::new() }) };
        let at = &self.text[..0];
        (0..self.count)
            .map(|k| {
                let cell = names.get(k).copied().unwrap_or(at);
                Column { cell, unit: units.map(|row| row[k]) }
            })
            .collect()
    }

    /// The last lines of the head, for a message.
    pub(super) fn own_head(&self) -> String {
        if !self.sure {
            return String::new();
        }
        if self.head.is_empty() {
            let first = self.rows.first().copied().unwrap_or_default();
            return format!("; the file has no head and begins with: {}", cut(first));
        }
        let last = &self.head[self.head.len().saturating_sub(HEAD_LINES)..];
        let before = &self.head[..self.head.len() - last.len()];
        let of_rate = |line: &&&str| {
            let lower = line.to_lowercase();
            RATES.iter().any(|word| lower.contains(word))
        };
        let lines = before.iter().filter(of_rate).take(HEAD_LINES).chain(last);
        let lines: Vec<&str> = lines.map(|line| cut(line)).collect();
        format!("; the file's own head is: {}", lines.join(" | "))
    }

    /// Refuses what can be read in two ways.
    pub(super) fn must_be_one(&self) -> Result<(), Box<Problem>> {
        let [(other, columns), ..] = self.rivals.as_slice() else { return Ok(()) };
        let [own, other] = [self.reading.words(self.count), other.words(*columns)];
        let message = format!("the lines of the file can be read in two ways: {own}, or {other}");
        let first = self.rows.first().copied().unwrap_or_default();
        let help = "write a head with a name for each column, or put semicolons between the columns, or write decimal points";
        Err(problem(self.text, first, message, "expected one way to read it", help))
    }

    /// The place at which something is wrong with the head.
    fn place(&self) -> &'t str {
        self.head.iter().rev().chain(&self.rows).next().copied().unwrap_or(&self.text[..0])
    }

    fn refused(&self, message: String, expected: &str, help: &str) -> Vec<Problem> {
        vec![*problem(
            self.text,
            self.place(),
            message,
            expected,
            &format!("{help}{}", self.own_head()),
        )]
    }
}

/// Keeps what fits, unless nothing does.
fn keep<T>(all: &mut Vec<T>, fits: impl Fn(&T) -> bool) {
    if all.iter().any(&fits) {
        all.retain(fits);
    }
}

fn cut(line: &str) -> &str {
    &line[..line.floor_char_boundary(HEAD_WIDTH.min(line.len()))]
}

fn without_brackets(cell: &str) -> &str {
    cell.trim().trim_start_matches(['(', '[']).trim_end_matches([')', ']'])
}

/// Whether a cell of a line of units is one, or none.
fn is_unit(cell: &str) -> bool {
    matches!(without_brackets(cell), "" | "-") || Dimension::is_unit(without_brackets(cell))
}

/// A column of a file.
#[derive(Clone, Copy)]
struct Column<'t> {
    /// Its cell in the head, empty where there is none.
    cell: &'t str,
    /// Its cell in a line of units.
    unit: Option<&'t str>,
}

impl<'t> Column<'t> {
    /// Its name without a unit.
    fn name(self) -> &'t str {
        bare_name(self.cell)
    }

    fn unit(self, of: Dimension) -> Result<&'static Unit, (String, String)> {
        match self.unit {
            Some(unit) if of != Dimension::Number => {
                unit_in_brackets(of, &format!("({})", without_brackets(unit)))
            }
            _ => unit_in_brackets(of, self.cell),
        }
    }

    /// Whether neither the name nor a line below it has a unit.
    fn has_no_unit(self) -> bool {
        self.name() == self.cell.trim()
            && self.unit.is_none_or(|unit| !Dimension::is_unit(without_brackets(unit)))
    }

    fn is_time(self, physical: bool) -> bool {
        let name = self.name().to_lowercase();
        physical && self.unit(Dimension::Time).is_ok() || name.starts_with("time") || name == "t"
    }
}

/// A name without the unit behind it.
fn bare_name(cell: &str) -> &str {
    let trimmed = cell.trim();
    let open = trimmed.strip_suffix([')', ']']).and_then(|inner| inner.rfind(['(', '[']));
    let open = open.filter(|at| Dimension::is_unit(without_brackets(&trimmed[*at..])));
    trimmed[..open.unwrap_or(trimmed.len())].trim_end()
}

/// The columns that are read: that of the times, where there is one, and that of the values, each with a unit that the case
/// gives it.
struct Chosen {
    time: Option<(usize, Option<String>)>,
    value: (usize, Option<String>),
}

/// Reads a file; `name` is for messages alone.
///
/// # Errors
/// [`CaseError`] with what is wrong, without a word of what is not surely a record.
pub(super) fn read(name: &str, bytes: &[u8], wanted: &Wanted) -> Result<Found, CaseError> {
    let text = text_of(name, "a record", bytes)
        .map_err(|(message, help)| CaseError::of_file(name, message, &help))?;
    if let Some(found) = peer(&text, wanted) {
        return found.map_err(|problems| CaseError::new(name, &text, problems, 0));
    }
    let table = RecordTable::of(&text, wanted.format.rate.is_none());
    let columns = table.columns();
    samples(&table, &columns, wanted).map_err(|problems| {
        let error = CaseError::new(name, &text, problems, 0);
        let of = dimension(wanted.quantity);
        let fits = |column: &Column| {
            let units = [Dimension::Time, of].into_iter();
            wanted.physical && units.clone().any(|of| column.unit(of).is_ok())
        };
        let plain = || table.head.last().is_some_and(|head| head.replace(' ', "") == "time,value");
        match table.sure || columns.iter().any(fits) || !wanted.physical && plain() {
            true => error,
            false => error.without_text(
                "a record",
                "a record has a head that names its columns and their units, and below it a time and a value a line; \
                 its text is not shown, for it may be another file",
            ),
        }
    })
}

/// Which columns are read.
fn chosen(
    table: &RecordTable,
    columns: &[Column],
    wanted: &Wanted,
) -> Result<Chosen, Vec<Problem>> {
    let (format, of) = (wanted.format, dimension(wanted.quantity));
    let names: Vec<String> = columns
        .iter()
        .enumerate()
        .map(
            |(k, one)| {
                if one.name().is_empty() { (k + 1).to_string() } else { one.name().to_owned() }
            },
        )
        .collect();
    let listed = || names.iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", ");
    let find = |key: &str,
                wanted: &Option<String>|
     -> Result<Option<(usize, Option<String>)>, Vec<Problem>> {
        let Some(written) = wanted else { return Ok(None) };
        let bare = bare_name(written);
        let unit = (bare != written.trim()).then(|| written.clone());
        let matching = |fits: &dyn Fn(usize) -> bool| {
            let all: Vec<usize> = (0..columns.len()).filter(|k| fits(*k)).collect();
            if let [only] = all.as_slice() { Some(*only) } else { None }
        };
        if let Some(k) = matching(&|k| columns[k].cell == written) {
            return Ok(Some((k, None)));
        }
        let found = matching(&|k| names[k] == bare)
            .or_else(|| matching(&|k| names[k].eq_ignore_ascii_case(bare)))
            .or_else(|| bare.parse::<usize>().ok()?.checked_sub(1).filter(|k| *k < columns.len()));
        found.map(|k| Some((k, unit))).ok_or_else(|| {
            let message = format!("the record has no single column \"{written}\" for `{key}`");
            table.refused(
                message,
                &format!("its columns are {}", listed()),
                "name one of them, or its number from 1",
            )
        })
    };
    let mut value = find("column", &format.column)?;
    let mut time = find("time_column", &format.time_column)?;
    let other = |than: usize| if columns.len() == 2 { Some(1 - than) } else { None };
    let times: Vec<usize> =
        (0..columns.len()).filter(|k| columns[*k].is_time(wanted.physical)).collect();
    if time.is_none() && format.rate.is_none() {
        let not_value = |k: &usize| value.as_ref().is_none_or(|(value, _)| value != k);
        let first = times.iter().copied().find(not_value);
        let guessed = first.or_else(|| value.as_ref().and_then(|(value, _)| other(*value)));
        let guessed = guessed.or(if columns.len() > 1 { Some(0).filter(not_value) } else { None });
        time = guessed.map(|k| (k, None));
        if time.is_none() {
            let message = "the record has no column of times".to_owned();
            let help = "where samples are even write rate = \"... Hz\" in [excitation], else add the column";
            return Err(table.refused(message, "expected a time and a value", help));
        }
    }
    if value.is_none() {
        let is_time = |k: usize| match &time {
            Some((time, _)) => *time == k,
            None => columns.len() > 1 && times.contains(&k),
        };
        let rest: Vec<usize> = (0..columns.len()).filter(|k| !is_time(*k)).collect();
        let fit = |k: &&usize| wanted.physical && columns[**k].unit(of).is_ok();
        let fitting: Vec<usize> = rest.iter().filter(fit).copied().collect();
        value = match (rest.as_slice(), fitting.as_slice()) {
            ([only], _) | (_, [only]) => Some((*only, None)),
            _ => {
                let message =
                    format!("the record has {} columns that may be its values", rest.len());
                let expected = format!("its columns are {}", listed());
                return Err(table.refused(
                    message,
                    &expected,
                    "write column = \"...\" in [excitation], the name or the number of one of them",
                ));
            }
        };
    }
    match (time, value) {
        (Some((time, _)), Some((value, _))) if time == value => {
            let message =
                "the times and the values of the record are to be in one column".to_owned();
            Err(table.refused(message, "expected two", "name another `column` or `time_column`"))
        }
        (time, Some(value)) => Ok(Chosen { time, value }),
        (_, None) => {
            Err(table.refused("the record has no values".into(), "expected a column", "add them"))
        }
    }
}

/// A column's unit, which the case may give.
fn unit_of(
    table: &RecordTable,
    (of, what): (Dimension, &str),
    column: Column,
    given: Option<&str>,
    wanted: &Wanted,
) -> Result<&'static Unit, Vec<Problem>> {
    let own = column.unit(if wanted.physical { of } else { Dimension::Number });
    let by_case = match given {
        Some(written) => Some(unit_in_brackets(of, written)),
        None if what == "value" => wanted.format.unit.map(Ok),
        None => None,
    };
    let (message, accepted) = match (own, by_case) {
        (Ok(own), None) => return Ok(own),
        (Ok(own), Some(Ok(given))) if own == given => return Ok(own),
        (Ok(own), Some(Ok(given))) => {
            let [own, given] = [own, given].map(|unit| unit.symbol);
            (
                format!("is in {own} by the head, and in {given} by the case"),
                "remove one".to_owned(),
            )
        }
        // Brackets may hold something else.
        (Err(_), Some(Ok(given))) if column.has_no_unit() => return Ok(given),
        (_, Some(Err(error))) | (Err(error), _) => error,
    };
    let place = if column.cell.is_empty() { table.place() } else { column.cell };
    let how = match what {
        "time" => {
            "write it in brackets behind the name in the head, or time_column = \"name (unit)\" in [excitation], or rate = \"... Hz\""
        }
        _ => {
            "write the one of the file in brackets behind the name in the head, or unit = \"...\" in [excitation]"
        }
    };
    let (expected, help) = match wanted.physical {
        true => ("expected its unit", format!("{accepted}; {how}")),
        false => (
            "expected a name without a unit",
            "numbers of [reduced] have none: a head is for example time,value".to_owned(),
        ),
    };
    let message = format!("the {what} of the record {message}");
    let help = format!("{help}{}", table.own_head());
    Err(vec![*problem(table.text, place, message, expected, &help)])
}

fn samples(
    table: &RecordTable,
    columns: &[Column],
    wanted: &Wanted,
) -> Result<Found, Vec<Problem>> {
    let of = dimension(wanted.quantity);
    table.must_be_one().map_err(|problem| vec![*problem])?;
    let pointed = table.head.last().filter(|head| !is_comment(head));
    if let Some(head) = pointed {
        let names = table.reading.names(head, table.count).len();
        if names != table.count
            && columns.iter().all(|column| column.cell.is_empty())
            && names <= 2
            && table.count > 1
        {
            let message = format!(
                "the head of the record names {names} columns, and its lines have {}",
                table.count
            );
            return Err(table.refused(
                message,
                "expected a name for each column",
                "name each column, with its unit in brackets",
            ));
        }
    }
    let chosen = chosen(table, columns, wanted)?;
    let unit = |what: (Dimension, &str), (column, given): &(usize, Option<String>)| {
        unit_of(table, what, columns[*column], given.as_deref(), wanted)
    };
    let time_unit =
        chosen.time.as_ref().map(|time| unit((Dimension::Time, "time"), time)).transpose();
    let (time_unit, value_unit) = match (time_unit, unit((of, "value"), &chosen.value)) {
        (Ok(time), Ok(value)) => (time, value),
        (time, value) => return Err(time.err().into_iter().chain(value.err()).flatten().collect()),
    };
    let rate = wanted.format.rate.unwrap_or(1.0);
    let (mut samples, mut problems): (Vec<[f64; 2]>, Vec<Problem>) = (Vec::new(), Vec::new());
    for line in &table.rows {
        let cells = table.reading.cells(line);
        let even = samples.len() as f64 / rate;
        let time = chosen.time.as_ref().zip(time_unit).map(|((column, _), unit)| (*column, unit));
        match sample(
            table,
            line,
            &cells,
            (time, even),
            (chosen.value.0, value_unit),
            wanted,
            samples.last(),
        ) {
            Ok(sample) => samples.push(sample),
            Err(found) => problems.push(*found),
        }
        if problems.len() >= MOST_PROBLEMS {
            break;
        }
    }
    if problems.is_empty() && samples.len() < 2 {
        let message = "the record has fewer than two samples".to_owned();
        return Err(table.refused(message, "expected at least two lines below", "add them"));
    }
    if problems.is_empty() {
        problems.extend(other_rate(table, columns, chosen.value.0, wanted));
    }
    if problems.is_empty() && !wanted.format.linear_gaps {
        problems = gaps(table, &samples, chosen.time.as_ref().map_or(0, |time| time.0));
    }
    if problems.is_empty() { Ok(Found { samples, unit: value_unit }) } else { Err(problems) }
}

/// That the rate of the case is not that of the times which the file has all the same.
fn other_rate(
    table: &RecordTable,
    columns: &[Column],
    value: usize,
    wanted: &Wanted,
) -> Option<Problem> {
    let rate = wanted.format.rate?;
    let unit = |column: &Column| column.unit(Dimension::Time).ok().filter(|_| wanted.physical);
    let (column, unit) = columns.iter().enumerate().find_map(|(k, one)| Some((k, unit(one)?)))?;
    let time =
        |row: Option<&&str>| table.reading.number(table.reading.cells(row?).get(column)?, unit);
    let lasts = time(table.rows.last())? - time(table.rows.first())?;
    let own = (table.rows.len() - 1) as f64 / lasts;
    if column == value || (own / rate - 1.0).abs() < SAME_RATE {
        return None;
    }
    let message = format!(
        "the times of the record are those of {} samples in a second, not of `rate`",
        short(own)
    );
    let help = "remove `rate`, or the column of times where it is wrong";
    Some(*problem(table.text, columns[column].cell, message, "expected the rate of the case", help))
}

/// A line with a time later than the last one.
fn sample(
    table: &RecordTable,
    line: &str,
    cells: &[&str],
    (time, even): (Option<(usize, &Unit)>, f64),
    (column, unit): (usize, &Unit),
    wanted: &Wanted,
    last: Option<&[f64; 2]>,
) -> Result<[f64; 2], Box<Problem>> {
    let text = table.text;
    let needed = time.map_or(column, |(time, _)| time.max(column)) + 1;
    if cells.len() < needed || cells.len() > table.count {
        let message = match table.count {
            2 => "a line of the record does not have two values".to_owned(),
            count => format!("a line of the record does not have {count} values"),
        };
        let help = format!("the other lines have {}", table.reading.words(table.count));
        return Err(problem(text, line, message, "expected a value in each column", &help));
    }
    let number = |column: usize, unit| {
        let cell = cells[column];
        table.reading.number(cell, unit).ok_or_else(|| {
            let message = format!("\"{cell}\" is no number");
            let help = format!(
                "write numbers such as 0.25 or 2.5e-1; the other lines have {}",
                table.reading.words(table.count)
            );
            let cell = if cell.is_empty() { line } else { cell };
            problem(text, cell, message, "expected a number", &help)
        })
    };
    let at = time.map_or(Ok(even), |(column, unit)| number(column, unit))?;
    let found = [at, number(column, unit)?];
    match last {
        Some(last) if last[0] >= found[0] => {
            let message = "the times of the record do not ascend".to_owned();
            let help = "sort the lines, and keep one of each time";
            let cell = time.map_or(line, |(column, _)| cells[column]);
            Err(problem(text, cell, message, "expected a later time than above", help))
        }
        _ if found[1].abs() > wanted.most => {
            let message = "a value of the record is too large for the case".to_owned();
            let help = "check its unit, and those of the case: one is many orders of magnitude away from the others";
            Err(problem(
                text,
                cells[column],
                message,
                "expected values as a structure meets them",
                help,
            ))
        }
        _ => Ok(found),
    }
}

/// The step of most samples.
pub(super) fn median_step(samples: &[[f64; 2]]) -> f64 {
    let mut steps: Vec<f64> = samples.windows(2).map(|two| two[1][0] - two[0][0]).collect();
    let middle = steps.len() / 2;
    let (_, median, _) = steps.select_nth_unstable_by(middle, f64::total_cmp);
    *median
}

/// Where samples are missing.
fn gaps(table: &RecordTable, samples: &[[f64; 2]], column: usize) -> Vec<Problem> {
    let median = median_step(samples);
    let missing = samples
        .windows(2)
        .enumerate()
        .filter(|(_, two)| two[1][0] - two[0][0] > GAP * median * (1.0 + ROUNDING));
    missing
        .take(MOST_PROBLEMS)
        .map(|(k, two)| {
            let row = table.rows[k + 1];
            let cell = table.reading.cells(row).get(column).copied().unwrap_or(row);
            let message = format!(
                "samples of the record are missing between {} and {}: its steps are {}",
                short(two[0][0]),
                short(two[1][0]),
                short(median)
            );
            let help = "complete the record, or write gaps = \"linear\" in [excitation]: then a straight line is drawn across";
            *problem(table.text, cell, message, "expected at most three steps", help)
        })
        .collect()
}

/// Six digits of a time.
fn short(value: f64) -> String {
    crate::quantity::numbers::rounded_to(value, 6).to_string()
}

/// A file of the PEER ground motion database: a head with the number of samples and their step, then values line by line;
/// none where it is another one.
fn peer(text: &str, wanted: &Wanted) -> Option<Result<Found, Vec<Problem>>> {
    const LINES: usize = 8;
    let lines: Vec<&str> = text.lines().collect();
    let last = lines.iter().take(LINES).position(|line| {
        let upper = line.to_uppercase();
        upper.contains("NPTS") && upper.contains("DT")
    })?;
    let head = lines[last].to_uppercase();
    let refused = |at: &str, message: String, help: &str| {
        Some(Err(vec![*problem(text, at, message, "expected a PEER file", help)]))
    };
    let number = |token: &str| number_in(token.trim_matches([',', ';']), pure());
    let tokens = head.replace('=', " ");
    let tokens: Vec<&str> = tokens.split_whitespace().collect();
    let behind = |word: &str| {
        let at = tokens.iter().position(|token| token.trim_matches(',') == word)?;
        number(tokens.get(at + 1)?)
    };
    let plain: Vec<f64> = tokens.iter().filter_map(|token| number(token)).collect();
    let (count, step) = match (behind("NPTS"), behind("DT")) {
        (Some(count), Some(step)) => (count, step),
        // The older head: 4000 0.01 NPTS, DT.
        _ => (plain.first().copied()?, plain.get(1).copied()?),
    };
    if !wanted.physical {
        return refused(
            lines[last],
            "a PEER file has units, and [reduced] has none".into(),
            "write the case in physical units",
        );
    }
    let named = lines[..last].iter().rev().find_map(|line| {
        let at = line.to_uppercase().find("UNITS OF")?;
        line.get(at + "UNITS OF".len()..).map(str::trim)
    });
    let of = dimension(wanted.quantity);
    let symbol = named
        .unwrap_or_default()
        .to_lowercase()
        .replace("sec", "s")
        .replace("/s/s", "/s2")
        .replace("**", "^");
    let unit = match (unit_in_brackets(of, &format!("({symbol})")), wanted.format.unit) {
        (Ok(unit), None) => unit,
        (Ok(unit), Some(given)) if unit == given => unit,
        (Ok(unit), Some(given)) => {
            let message = format!(
                "the values are in {} by the head, and in {} by the case",
                unit.symbol, given.symbol
            );
            return refused(named.unwrap_or(lines[last]), message, "remove `unit`");
        }
        (Err(_), Some(given)) if named.is_none() => given,
        (Err((message, accepted)), _) => {
            let place = named.unwrap_or(lines[last]);
            return refused(place, format!("the value of the record {message}"), &accepted);
        }
    };
    if step.is_nan()
        || step <= 0.0
        || wanted.format.rate.is_some_and(|rate| (rate * step - 1.0).abs() > ROUNDING)
    {
        let message = format!("the step of the samples is {step} s by the head");
        return refused(lines[last], message, "remove `rate`, or give that of the file");
    }
    let mut samples = Vec::new();
    for line in &lines[last + 1..] {
        for token in line.split_whitespace() {
            let Some(value) = number_in(token, unit) else {
                return refused(
                    token,
                    format!("\"{token}\" is no number"),
                    "below the head a PEER file has numbers alone",
                );
            };
            if value.abs() > wanted.most {
                return refused(
                    token,
                    "a value of the record is too large for the case".into(),
                    "check the units of the case",
                );
            }
            samples.push([samples.len() as f64 * step, value]);
        }
    }
    if samples.len() < 2 || samples.len() as f64 != count {
        let message = format!("the head says {count} samples, and {} follow", samples.len());
        return refused(
            lines[last],
            message,
            "fetch the file again: it was cut, or the head changed",
        );
    }
    Some(Ok(Found { samples, unit }))
}
