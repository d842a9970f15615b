//! The samples in the file of a record, a table of numbers; a unit is never guessed.

use super::error::{CaseError, Problem};
use super::number_table::{Column, NumberTable, bare_name, is_comment, text_of};
use super::peer::peer;
use super::quantity::unit_in_brackets;
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
pub(super) const ROUNDING: f64 = 1e-6;

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
    let table = NumberTable::of(&text, wanted.format.rate.is_none());
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
    table: &NumberTable,
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
    table: &NumberTable,
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
    table: &NumberTable,
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
    table: &NumberTable,
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
    table: &NumberTable,
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
fn gaps(table: &NumberTable, samples: &[[f64; 2]], column: usize) -> Vec<Problem> {
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
