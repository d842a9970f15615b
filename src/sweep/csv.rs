//! Columns as comma-separated values, a header line with units first.

use std::io::Write;

use csv::Writer;

use super::columns::{Cell, Column, Storage};

/// Writes the header: `peak [m]`; pure numbers and words have no unit.
///
/// # Errors
/// [`csv::Error`] where it cannot be written.
pub fn header<W: Write>(writer: &mut Writer<W>, columns: &[Column]) -> Result<(), csv::Error> {
    writer.write_record(columns.iter().map(|column| match column.unit {
        "" | "1" => column.name.clone(),
        unit => format!("{} [{unit}]", column.name),
    }))
}

/// Writes the rows of columns, numbers as text that reads back as the same number; a field is empty where there
/// is no value.
///
/// # Errors
/// [`csv::Error`] where they cannot be written.
pub fn rows<W: Write>(writer: &mut Writer<W>, columns: &[Column]) -> Result<(), csv::Error> {
    for row in 0..columns.first().map_or(0, |column| column.cells.len()) {
        writer.write_record(columns.iter().map(|column| match column.cells[row] {
            None => String::new(),
            Some(Cell::Text(text)) => text.to_owned(),
            Some(Cell::Number(flag)) if column.storage == Storage::Flag => {
                (flag != 0.0).to_string()
            }
            Some(Cell::Number(number)) => number.to_string(),
        }))?;
    }
    Ok(())
}
