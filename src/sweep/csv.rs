//! Columns as comma-separated values, a header line with units first.

use std::io::Write;

use csv::Writer;

use super::columns::{Column, Values};

/// Writes rows behind one another.
pub struct Table<W: Write> {
    writer: Writer<W>,
}

impl<W: Write> Table<W> {
    /// Begins with the header: `peak [m]`; pure numbers and words have no unit.
    ///
    /// # Errors
    /// [`csv::Error`] where it cannot be written.
    pub fn new(sink: W, columns: &[Column]) -> Result<Self, csv::Error> {
        let mut writer = Writer::from_writer(sink);
        writer.write_record(columns.iter().map(|column| match column.unit {
            "" | "1" => column.name.clone(),
            unit => format!("{} [{unit}]", column.name),
        }))?;
        Ok(Self { writer })
    }

    /// Adds the rows of columns; a field is empty where there is no value.
    ///
    /// # Errors
    /// [`csv::Error`] where they cannot be written.
    pub fn add(&mut self, columns: &[Column]) -> Result<(), csv::Error> {
        let rows = columns.first().map_or(0, |column| column.values.len());
        for row in 0..rows {
            self.writer.write_record(columns.iter().map(|column| column.values.text(row)))?;
        }
        Ok(())
    }

    /// Ends the table.
    ///
    /// # Errors
    /// [`csv::Error`] where the last rows cannot be written.
    pub fn finish(self) -> Result<W, csv::Error> {
        self.writer.into_inner().map_err(|error| error.into_error().into())
    }
}

impl Values {
    /// A value as text that reads back as the same value; empty where there is none.
    fn text(&self, row: usize) -> String {
        fn shown<T: ToString>(all: &[Option<T>], row: usize) -> String {
            all.get(row).and_then(Option::as_ref).map_or_else(String::new, T::to_string)
        }
        match self {
            Self::Number(all) => shown(all, row),
            Self::Whole(all) => shown(all, row),
            Self::Flag(all) => shown(all, row),
            Self::Text(all) => shown(all, row),
        }
    }
}
