//! Modes from a file of columns: a head that names them, with units, and a line for each mode.

use std::collections::HashSet;

use super::StructuralMode;
use super::universal::{self, line_of};
use crate::case::error::{CaseError, Problem};
use crate::case::number_table::{NumberTable, Reading, text_of};
use crate::case::quantity::unit_in_brackets;
use crate::case::record::{lines, problem};
use crate::digest::file_sha256;
use crate::quantity::Dimension;
use crate::quantity::unit::Unit;
use crate::system::LARGEST_DAMPING_RATIO;

/// A file of modes: its path, for messages, and its text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ModesFile {
    /// Its path.
    pub name: String,
    /// Its text.
    pub text: String,
    /// SHA-256 of its bytes with line ends of one kind.
    pub sha256: String,
}

impl ModesFile {
    /// That of the bytes of a file. What is no UTF-8 is taken for Latin-1, which may stand in titles and comments; of a Universal File
    /// the bytes of binary data sets, which hold no modes, are left out.
    ///
    /// # Errors
    /// [`CaseError`] where it is no text.
    pub fn of_bytes(name: &str, bytes: &[u8]) -> Result<Self, CaseError> {
        let sha256 = file_sha256(bytes);
        let bytes = universal::without_binary(bytes);
        let text = text_of(name, "a file of modes", &bytes)
            .map_err(|(message, help)| CaseError::of_file(name, message, &help))?;
        if text.trim_matches(['\u{feff}', ' ', '\t', '\r', '\n']).is_empty() {
            let help = "write a head such as frequency (Hz),damping_ratio (%),mass (kg),tip and a line for each mode below";
            return Err(CaseError::of_file(name, format!("{name} is empty"), help));
        }
        Ok(Self { name: name.to_owned(), text: text.into_owned(), sha256 })
    }

    /// Its text without a byte order mark.
    pub(super) fn text(&self) -> &str {
        self.text.strip_prefix('\u{feff}').unwrap_or(&self.text)
    }
}

/// Most places of a structure: each has a column in tables, and is measured in every motion.
const MOST_PLACES: usize = 200;

/// A mode of a file.
#[derive(Debug, Clone)]
pub(super) struct FileMode {
    /// The mode, its shape at the places of a case.
    pub mode: StructuralMode,
    /// All of its shape that the file has.
    pub whole: Vec<f64>,
    /// At how many nodes or places that is.
    pub nodes: usize,
    /// In which line, from 1, its frequency stands.
    pub line: usize,
}

/// Names of places, and modes with their shapes there.
pub(super) type Modes = (Vec<String>, Vec<StructuralMode>);

/// What a head has.
const HEAD: &str = "its first line names frequency, damping_ratio and mass, each with its unit in brackets, and a column for each place";
/// What a mode has beside its shape, whether it must be given, and what it is.
const KNOWN: [(&str, bool, Dimension); 4] = [
    ("frequency", true, Dimension::Frequency),
    ("damping_ratio", true, Dimension::Share),
    ("mass", true, Dimension::Mass),
    ("participation", false, Dimension::Number),
];

/// What a column is: one of [`KNOWN`], the shape at a place, or something that nobody reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Is {
    Known(usize),
    Place,
    Other,
}

#[derive(Clone, Copy)]
struct Column<'t> {
    is: Is,
    name: &'t str,
    /// Its cell of the head.
    cell: &'t str,
    /// None of what is not read.
    unit: Option<&'static Unit>,
}

/// What a file of columns has.
pub(super) struct Columns {
    /// Names of places.
    pub places: Vec<String>,
    /// The modes with their shapes there.
    pub modes: Vec<FileMode>,
    /// What its columns were read as.
    pub read_as: String,
}

/// The modes of a file, at the places that a case names, each by its column; at those of all further columns unless it does.
pub(super) fn read(
    file: &ModesFile,
    named: Option<&[(String, String)]>,
) -> Result<Columns, CaseError> {
    let text = file.text();
    let refused = |problems| CaseError::new(&file.name, text, problems, 0);
    let found = NumberTable::of(text, false);
    // Its head is the first line that has names of a head; what stands above it is not read.
    let has_names = |reading: Reading, line: &str| {
        let cells = reading.cells(line);
        KNOWN.iter().filter(|(name, ..)| cells.iter().any(|cell| name_of(cell) == *name)).count()
            > 1
    };
    let fits = |(reading, count): &(Reading, usize)| {
        lines(text).any(|line| has_names(*reading, line) && reading.cells(line).len() == *count)
    };
    let all = [(found.reading, found.count)].into_iter().chain(found.rivals.iter().copied());
    let fitting: Vec<(Reading, usize)> = all.filter(fits).collect();
    let reading = fitting.first().map_or(Reading::PLAIN, |one| one.0);
    let is_head = |line: &str| has_names(reading, line);
    let all: Vec<&str> = lines(text).collect();
    let at = all.iter().position(|line| is_head(line));
    let head = all.get(at.unwrap_or(0)).copied().unwrap_or(&text[..0]);
    let mut lines = all.iter().copied().skip(at.unwrap_or(0) + 1);
    // A file whose head is another one may be anything, and is not shown.
    let is_table = at.is_some();
    if fitting.len() > 1 {
        found.must_be_one().map_err(|problem| refused(vec![*problem]))?;
    }
    let columns = columns(text, head, reading, named).map_err(|problem| {
        let help = format!("{HEAD}; {}", problem.message);
        let error = refused(vec![*problem]);
        if is_table { error } else { error.without_text("a table of modes", &help) }
    })?;
    let lines: Vec<&str> = lines.by_ref().collect();
    if lines.is_empty() {
        let message = "the file has no mode".to_owned();
        let expected = "expected a line for each mode below the head";
        return Err(refused(vec![*problem(text, head, message, expected, "add the modes")]));
    }
    let (modes, problems): (Vec<_>, Vec<_>) =
        lines.iter().map(|line| mode(text, line, reading, &columns)).partition(Result::is_ok);
    let problems: Vec<Problem> =
        problems.into_iter().filter_map(Result::err).map(|one| *one).collect();
    if !problems.is_empty() {
        return Err(refused(problems));
    }
    let modes: Vec<StructuralMode> = modes.into_iter().filter_map(Result::ok).collect();
    let at: Vec<&Column> = columns.iter().filter(|one| one.is == Is::Place).collect();
    if named.is_none()
        && let Some(counts) = (0..at.len()).find(|k| counts(at[*k].name, &modes, *k))
    {
        let values: Vec<String> = modes.iter().map(|mode| mode.shape[counts].to_string()).collect();
        let (name, values) = (at[counts].name, values.join(", "));
        let entry = |one: &&Column| format!("{} = {:?}", bare(one.name), one.name);
        let others: Vec<String> = at.iter().filter(|one| one.name != name).map(entry).collect();
        let message = format!(
            "the column {name} holds {values}: numbers of the modes, it seems, and no shape"
        );
        let help = match others.is_empty() {
            true => "remove the column, and add one with the shape at a place".to_owned(),
            false => format!(
                "remove the column, or name those that are places in [modes]: places = {{ {} }}",
                others.join(", ")
            ),
        };
        let expected = "expected the shape at a place";
        return Err(refused(vec![*problem(text, at[counts].cell, message, expected, &help)]));
    }
    // Places by their names, and which of the columns that are read each is.
    let places: Vec<(String, usize)> = match named {
        None => at.iter().enumerate().map(|(k, one)| (one.name.to_owned(), k)).collect(),
        Some(named) => {
            let of = |column: &str| at.iter().position(|one| one.name == column);
            named.iter().filter_map(|(place, column)| Some((place.clone(), of(column)?))).collect()
        }
    };
    let of = |(line, mode): (&&str, StructuralMode)| FileMode {
        nodes: mode.shape.len(),
        line: line_of(text, line),
        whole: mode.shape.clone(),
        mode: StructuralMode {
            shape: places.iter().map(|(_, k)| mode.shape[*k]).collect(),
            ..mode
        },
    };
    let modes = lines.iter().zip(modes).map(of).collect();
    let cells = |is: &dyn Fn(Is) -> bool| {
        let cells = columns.iter().filter(|one| is(one.is)).map(|one| one.cell.trim());
        cells.collect::<Vec<_>>().join(", ")
    };
    let numbers = cells(&|is| matches!(is, Is::Known(_)));
    let read_as = format!("{numbers}; shapes at {}", cells(&|is| is == Is::Place));
    Ok(Columns { places: places.into_iter().map(|(name, _)| name).collect(), modes, read_as })
}

/// Whether what a column holds counts the modes: whole numbers one after the other, of three and more any that ascend; of a single
/// mode by its name.
fn counts(name: &str, modes: &[StructuralMode], place: usize) -> bool {
    const NAMES: [&str; 8] = ["mode", "no", "no.", "nr", "number", "id", "index", "#"];
    let values: Vec<f64> = modes.iter().map(|mode| mode.shape[place]).collect();
    let whole = values.iter().all(|value| value.fract() == 0.0);
    let steps = |holds: fn(f64) -> bool| values.windows(2).all(|two| holds(two[1] - two[0]));
    match values.len() {
        1 => whole && NAMES.contains(&name.to_lowercase().as_str()),
        2 => whole && steps(|step| step == 1.0),
        _ => whole && steps(|step| step > 0.0),
    }
}

/// The name in a cell of the head, without its unit.
fn name_of(cell: &str) -> &str {
    cell.split(['(', '[']).next().unwrap_or(cell).trim()
}

/// A key of TOML.
fn bare(name: &str) -> String {
    let plain = |one: u8| one.is_ascii_alphanumeric() || one == b'_' || one == b'-';
    if name.bytes().all(plain) { name.to_owned() } else { format!("{name:?}") }
}

/// The columns of a head that are read, in the order of the places that are named.
fn columns<'t>(
    text: &str,
    head: &'t str,
    reading: Reading,
    named: Option<&[(String, String)]>,
) -> Result<Vec<Column<'t>>, Box<Problem>> {
    let (mut columns, mut names): (Vec<Column>, HashSet<&str>) = (Vec::new(), HashSet::new());
    for cell in reading.cells(head) {
        let name = name_of(cell);
        let wrong = |message: String, help: &str| {
            problem(text, cell, message, "expected the columns of a table of modes", help)
        };
        if name.is_empty() || !names.insert(name) {
            let message = format!("the column \"{name}\" has no name, or stands there twice");
            return Err(wrong(message, "name each column once"));
        }
        let known = KNOWN.iter().position(|(known, ..)| *known == name);
        let is = match (known, named) {
            (Some(known), _) => Is::Known(known),
            (None, Some(named)) if named.iter().all(|(_, column)| column != name) => Is::Other,
            (None, _) => Is::Place,
        };
        let of = known.map_or(Dimension::Number, |known| KNOWN[known].2);
        let unit = (is != Is::Other).then(|| unit_in_brackets(of, cell)).transpose();
        let unit =
            unit.map_err(|(what, accepted)| wrong(format!("the column {name} {what}"), &accepted))?;
        columns.push(Column { is, name, cell, unit });
    }
    let lacks = |name: &str| !names.contains(name);
    if let Some((name, ..)) = KNOWN.iter().find(|(name, needed, _)| *needed && lacks(name)) {
        let message = format!("there is no column {name}");
        return Err(problem(text, head, message, "expected it in the head", "add the column"));
    }
    if let Some((_, column)) = named.into_iter().flatten().find(|(_, column)| lacks(column)) {
        let message = format!("there is no column {column}, which `places` names");
        let expected = "expected columns of the file in `places`";
        return Err(problem(text, head, message, expected, "name a column of the file"));
    }
    let count = columns.iter().filter(|one| one.is == Is::Place).count();
    if count > MOST_PLACES {
        let message = format!("the file has {count} columns of places");
        let expected = format!("expected at most {MOST_PLACES}");
        let help = "name those that count in [modes]: places = { tip = \"tip\" }";
        return Err(problem(text, head, message, &expected, help));
    }
    if columns.iter().all(|one| one.is != Is::Place) {
        let message = "there is no column of a place".to_owned();
        return Err(problem(text, head, message, "expected the shape at a place", "add a column"));
    }
    Ok(columns)
}

/// The mode of a line.
fn mode(
    text: &str,
    line: &str,
    reading: Reading,
    columns: &[Column],
) -> Result<StructuralMode, Box<Problem>> {
    let cells = reading.cells(line);
    if cells.len() != columns.len() {
        let message = format!("the line has {} values", cells.len());
        let expected = format!("expected {}, as the head", columns.len());
        let help = format!("write {}", reading.words(columns.len()));
        return Err(problem(text, line, message, &expected, &help));
    }
    let (mut values, mut shape) = ([0.0, 0.0, 0.0, f64::NAN], Vec::new());
    for (cell, column) in cells.iter().zip(columns) {
        let wrong = |expected: &str| {
            let message = format!("{} is \"{}\"", column.name, cell.trim());
            let help = "write numbers such as 0.25; or leave the column out, or name those that are places: places = { tip = \"tip\" } in [modes]";
            problem(text, cell, message, expected, help)
        };
        let Some(unit) = column.unit else { continue };
        let number = reading.number(cell, unit).ok_or_else(|| wrong("expected a number"))?;
        match column.is {
            Is::Other => {}
            Is::Place => shape.push(number),
            Is::Known(0 | 2) if number <= 0.0 => return Err(wrong("expected a number above 0")),
            Is::Known(1) if !(0.0..=LARGEST_DAMPING_RATIO).contains(&number) => {
                return Err(wrong("expected a damping ratio from 0 to 0.85"));
            }
            Is::Known(known) => values[known] = number,
        }
    }
    if shape.iter().all(|value| *value == 0.0) {
        let message = "the shape of a mode is 0 everywhere".to_owned();
        let expected = "expected a displacement other than 0 at a place";
        return Err(problem(text, line, message, expected, "add a place at which it moves"));
    }
    let [frequency_hz, damping_ratio, mass_kg, participation] = values;
    Ok(StructuralMode { frequency_hz, damping_ratio, mass_kg, shape, participation, forcing: 0.0 })
}
