//! Columns as comma-separated values, a header line with units first.

use std::io::Write;

use csv::Writer;

use super::columns::{Column, Values};

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
    fn shown<T: ToString>(all: &[Option<T>], row: usize) -> String {
        all.get(row).and_then(Option::as_ref).map_or_else(String::new, T::to_string)
    }
    for row in 0..columns.first().map_or(0, |column| column.values.len()) {
        writer.write_record(columns.iter().map(|column| match &column.values {
            Values::Number(all) => shown(all, row),
            Values::Whole(all) => shown(all, row),
            Values::Flag(all) => shown(all, row),
            Values::Text(all) => shown(all, row),
        }))?;
    }
    Ok(())
}
