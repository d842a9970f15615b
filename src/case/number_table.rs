//! A text that is a table of numbers, as loggers, databases and spreadsheets write it: which separator, decimal mark and columns it
//! has is seen in the numbers; what can be read in two ways is told with both.

use std::borrow::Cow;

use super::error::Problem;
use super::quantity::{leading_number, number_in, unit_in_brackets};
use super::record::problem;
use crate::quantity::Dimension;
use crate::quantity::unit::Unit;

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
            if bytes.starts_with(LFS) {
                let message = format!("{name} is not {what}: it is a pointer to what Git LFS has");
                return Err((message, "fetch it first: git lfs pull".to_owned()));
            }
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

/// How the text begins that stands for a file in a repository.
const LFS: &[u8] = b"version https://git-lfs.github.com/spec/";

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
    pub(super) fn names(self, line: &str, count: usize) -> Vec<&str> {
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
pub(super) fn pure() -> &'static Unit {
    const PURE: &Unit = &Unit { symbol: "", size: 1.0, exponent: 0, quotient: [1.0; 2] };
    PURE
}

fn is_open(name: &str) -> bool {
    let open = |[open, close]: [char; 2]| name.matches(open).count() > name.matches(close).count();
    open(['(', ')']) || open(['[', ']'])
}

/// The parts of a line between separators that do not stand in quotes.
pub(super) fn quoted(line: &str, separator: char) -> Vec<&str> {
    let mut within = false;
    line.split(move |c: char| {
        within ^= c == '"';
        c == separator && !within
    })
    .collect()
}

/// A text with what it is a table of.
pub(super) struct NumberTable<'t> {
    pub(super) text: &'t str,
    /// Lines before the first sample, comments among them.
    pub(super) head: Vec<&'t str>,
    /// Lines of samples.
    pub(super) rows: Vec<&'t str>,
    pub(super) reading: Reading,
    /// Other readings of the same lines that are as good, and their columns.
    pub(super) rivals: Vec<(Reading, usize)>,
    pub(super) count: usize,
    /// Whether it surely is a table of numbers.
    pub(super) sure: bool,
}

/// A reading, what most lines are like in it, and the numbers in the first of those.
type Tried = (Reading, Signature, Vec<Vec<Option<f64>>>);

pub(super) fn is_comment(line: &str) -> bool {
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

impl<'t> NumberTable<'t> {
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
    pub(super) fn columns(&self) -> Vec<Column<'t>> {
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
    pub(super) fn place(&self) -> &'t str {
        self.head.iter().rev().chain(&self.rows).next().copied().unwrap_or(&self.text[..0])
    }

    pub(super) fn refused(&self, message: String, expected: &str, help: &str) -> Vec<Problem> {
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

pub(super) fn without_brackets(cell: &str) -> &str {
    cell.trim().trim_start_matches(['(', '[']).trim_end_matches([')', ']'])
}

/// Whether a cell of a line of units is one, or none.
fn is_unit(cell: &str) -> bool {
    matches!(without_brackets(cell), "" | "-") || Dimension::is_unit(without_brackets(cell))
}

/// A column of a file.
#[derive(Clone, Copy)]
pub(super) struct Column<'t> {
    /// Its cell in the head, empty where there is none.
    pub cell: &'t str,
    /// Its cell in a line of units.
    unit: Option<&'t str>,
}

impl<'t> Column<'t> {
    /// Its name without a unit.
    pub(super) fn name(self) -> &'t str {
        bare_name(self.cell)
    }

    pub(super) fn unit(self, of: Dimension) -> Result<&'static Unit, (String, String)> {
        match self.unit {
            Some(unit) if of != Dimension::Number => {
                unit_in_brackets(of, &format!("({})", without_brackets(unit)))
            }
            _ => unit_in_brackets(of, self.cell),
        }
    }

    /// Whether neither the name nor a line below it has a unit.
    pub(super) fn has_no_unit(self) -> bool {
        self.name() == self.cell.trim()
            && self.unit.is_none_or(|unit| !Dimension::is_unit(without_brackets(unit)))
    }

    pub(super) fn is_time(self, physical: bool) -> bool {
        let name = self.name().to_lowercase();
        physical && self.unit(Dimension::Time).is_ok() || name.starts_with("time") || name == "t"
    }
}

/// A name without the unit behind it.
pub(super) fn bare_name(cell: &str) -> &str {
    let trimmed = cell.trim();
    let open = trimmed.strip_suffix([')', ']']).and_then(|inner| inner.rfind(['(', '[']));
    let open = open.filter(|at| Dimension::is_unit(without_brackets(&trimmed[*at..])));
    trimmed[..open.unwrap_or(trimmed.len())].trim_end()
}
