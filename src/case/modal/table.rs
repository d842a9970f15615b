//! Modes from a file of columns: a head that names them, with units, and a line for each mode.

use super::StructuralMode;
use crate::case::error::{CaseError, Problem};
use crate::case::quantity::{number_in, unit_in_brackets};
use crate::case::record::{lines, problem};
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
}

/// Names of places, and modes with their shapes there.
pub(super) type Modes = (Vec<String>, Vec<StructuralMode>);

/// How a head begins.
const HEAD: &str = "frequency (Hz),damping_ratio (%),mass (kg),tip";
/// What a mode has beside its shape, whether it must be given, and what it is.
const KNOWN: [(&str, bool, Dimension); 4] = [
    ("frequency", true, Dimension::Frequency),
    ("damping_ratio", true, Dimension::Share),
    ("mass", true, Dimension::Mass),
    ("participation", false, Dimension::Number),
];

/// A column: one of [`KNOWN`], or a place.
#[derive(Clone, Copy)]
struct Column<'t> {
    known: Option<usize>,
    name: &'t str,
    unit: &'static Unit,
}

/// The modes of a file.
pub(super) fn read(file: &ModesFile) -> Result<Modes, CaseError> {
    let text = file.text.strip_prefix('\u{feff}').unwrap_or(&file.text);
    let mut lines = lines(text);
    let head = lines.next().unwrap_or(&text[..0]);
    let refused = |problems| CaseError::new(&file.name, text, problems, 0);
    // A file whose head is another one may be anything, and is not shown.
    let columns = columns(text, head).map_err(|problem| {
        let help = format!("begin it with a line such as {HEAD}; {}", problem.message);
        refused(vec![*problem]).without_text("a table of modes", &help)
    })?;
    let lines: Vec<&str> = lines.collect();
    if lines.is_empty() {
        let message = "the file has no mode".to_owned();
        let expected = "expected a line for each mode below the head";
        return Err(refused(vec![*problem(text, head, message, expected, "add the modes")]));
    }
    let (modes, problems): (Vec<_>, Vec<_>) =
        lines.iter().map(|line| mode(text, line, &columns)).partition(Result::is_ok);
    let problems: Vec<Problem> =
        problems.into_iter().filter_map(Result::err).map(|one| *one).collect();
    if !problems.is_empty() {
        return Err(refused(problems));
    }
    let places = columns.iter().filter(|one| one.known.is_none());
    Ok((
        places.map(|one| one.name.to_owned()).collect(),
        modes.into_iter().filter_map(Result::ok).collect(),
    ))
}

fn columns<'t>(text: &str, head: &'t str) -> Result<Vec<Column<'t>>, Box<Problem>> {
    let mut columns: Vec<Column> = Vec::new();
    for cell in head.split(',') {
        let name = cell.split('(').next().unwrap_or(cell).trim();
        let wrong = |message: String, help: &str| {
            problem(text, cell, message, "expected the columns of a table of modes", help)
        };
        if name.is_empty() || columns.iter().any(|one| one.name == name) {
            let message = format!("the column \"{name}\" has no name, or stands there twice");
            return Err(wrong(message, "name each column once"));
        }
        let known = KNOWN.iter().position(|(known, ..)| *known == name);
        let of = known.map_or(Dimension::Number, |known| KNOWN[known].2);
        let unit = unit_in_brackets(of, cell)
            .map_err(|(what, accepted)| wrong(format!("the column {name} {what}"), &accepted))?;
        columns.push(Column { known, name, unit });
    }
    let has = |known: usize| columns.iter().any(|one| one.known == Some(known));
    if let Some((name, ..)) =
        KNOWN.iter().enumerate().find(|(k, one)| one.1 && !has(*k)).map(|one| one.1)
    {
        let message = format!("there is no column {name}");
        return Err(problem(text, head, message, "expected it in the head", "add the column"));
    }
    if columns.iter().all(|one| one.known.is_some()) {
        let message = "there is no column of a place".to_owned();
        return Err(problem(text, head, message, "expected the shape at a place", "add a column"));
    }
    Ok(columns)
}

/// The mode of a line.
fn mode(text: &str, line: &str, columns: &[Column]) -> Result<StructuralMode, Box<Problem>> {
    let cells: Vec<&str> = line.split(',').collect();
    if cells.len() != columns.len() {
        let message = format!("the line has {} values", cells.len());
        let expected = format!("expected {}, as the head", columns.len());
        let help = "separate numbers by commas; the decimal point is a point";
        return Err(problem(text, line, message, &expected, help));
    }
    let (mut values, mut shape) = ([0.0, 0.0, 0.0, f64::NAN], Vec::new());
    for (cell, column) in cells.iter().zip(columns) {
        let wrong = |expected: &str| {
            let message = format!("{} is \"{}\"", column.name, cell.trim());
            problem(text, cell, message, expected, "write numbers such as 0.25 or 2.5e-1")
        };
        let number = number_in(cell, column.unit).ok_or_else(|| wrong("expected a number"))?;
        match column.known {
            None => shape.push(number),
            Some(0 | 2) if number <= 0.0 => return Err(wrong("expected a number above 0")),
            Some(1) if !(0.0..=LARGEST_DAMPING_RATIO).contains(&number) => {
                return Err(wrong("expected a damping ratio from 0 to 0.85"));
            }
            Some(known) => values[known] = number,
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
