//! Tables of a report, formatted: every number with its unit and no more digits than it deserves.

use serde::Serialize;

/// A table of text.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Table {
    /// Column heads; at most seven.
    pub columns: Vec<Column>,
    /// Rows, as long as the columns.
    pub rows: Vec<Vec<String>>,
}

/// A column head.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Column {
    /// Its text.
    pub title: &'static str,
    /// Whether its cells are numbers, to be aligned on the right.
    pub numeric: bool,
}

pub(super) fn table<const N: usize>(
    columns: [(&'static str, bool); N],
    rows: Vec<[String; N]>,
) -> Table {
    Table {
        columns: columns.into_iter().map(|(title, numeric)| Column { title, numeric }).collect(),
        rows: rows.into_iter().map(Vec::from).collect(),
    }
}
