//! Reads the tables of a case file: every value checked once, every problem kept with its place.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::Problem;
use super::inputs::Input;
use super::suggest::nearest;
use super::table::{Table, kind};

/// A numeric key of a case file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Field {
    pub key: &'static str,
    /// The symbol in LaTeX.
    pub symbol: &'static str,
    pub bound: Bound,
    /// A value as a person might write it, quotes included.
    pub example: &'static str,
}

impl Field {
    pub const fn new(
        key: &'static str,
        symbol: &'static str,
        bound: Bound,
        example: &'static str,
    ) -> Self {
        Self { key, symbol, bound, example }
    }

    pub fn line(&self) -> String {
        format!("{} = {}", self.key, self.example)
    }
}

/// The values a field may take, besides being finite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Bound {
    Positive,
    NotNegative,
    UpToOne,
    Any,
}

impl Bound {
    pub fn holds(self, value: f64) -> bool {
        match self {
            Self::Positive => value > 0.0,
            Self::NotNegative => value >= 0.0,
            Self::UpToOne => (0.0..=1.0).contains(&value),
            Self::Any => true,
        }
    }

    pub fn words(self) -> &'static str {
        match self {
            Self::Positive => "above 0",
            Self::NotNegative => "0 or more",
            Self::UpToOne => "from 0 to 1",
            Self::Any => "of any size",
        }
    }
}

/// The text being read, with what was found wrong and what was read so far.
pub(super) struct Reader<'t> {
    pub text: &'t str,
    pub problems: Vec<Problem>,
    pub inputs: Vec<Input>,
    /// Every table with the keys it may have, the top level under the name "".
    tables: &'static [(&'static str, &'static [&'static str])],
}

impl<'t> Reader<'t> {
    /// `tables` lists every table with the keys it may have, the top level under the name "".
    pub fn new(text: &'t str, tables: &'static [(&'static str, &'static [&'static str])]) -> Self {
        Self { text, problems: Vec::new(), inputs: Vec::new(), tables }
    }

    /// Opens the top level, reporting every unknown key in it.
    pub fn root<'d>(&mut self, entries: &'d DeTable<'d>) -> Table<'d> {
        self.open("", 0..self.first_line(), entries)
    }

    /// The bytes of the first line, to point at when there is nothing better.
    pub fn first_line(&self) -> usize {
        self.text.lines().next().map_or(0, str::len)
    }

    /// Opens a table, reporting every unknown key in it; `None` when there is no such table.
    pub fn table<'d>(&mut self, root: &Table<'d>, name: &'static str) -> Option<Table<'d>> {
        let (key, value) = root.entry(name)?;
        if let DeValue::Table(entries) = value.get_ref() {
            return Some(self.open(name, key.span(), entries));
        }
        let message = format!("`{name}` is {}, but it must be a table", kind(value.get_ref()));
        let help = format!("write [{name}] on a line of its own and the table's keys below it");
        self.report(key.span(), message, format!("expected the table [{name}]"), help);
        None
    }

    fn open<'d>(
        &mut self,
        name: &'static str,
        span: Range<usize>,
        entries: &'d DeTable<'d>,
    ) -> Table<'d> {
        let known = self.tables.iter().find(|(table, _)| *table == name).map_or(&[][..], |t| t.1);
        let mut misspelled = Vec::new();
        for (key, value) in
            entries.iter().filter(|(key, _)| !known.contains(&key.get_ref().as_ref()))
        {
            let table = matches!(value.get_ref(), DeValue::Table(_));
            misspelled.extend(self.unknown_key(name, known, key, table));
        }
        Table::new(name, span, entries, misspelled)
    }

    fn unknown_key(
        &mut self,
        name: &'static str,
        known: &[&'static str],
        key: &Spanned<std::borrow::Cow<'_, str>>,
        table: bool,
    ) -> Option<&'static str> {
        let written = key.get_ref().as_ref();
        let homes = self.homes_of(written);
        let guess = if homes.is_empty() { nearest(written, known) } else { None };
        let what = if table { "table" } else { "key" };
        let place = if name.is_empty() { String::new() } else { format!(" in [{name}]") };
        let expected = format!("expected one of {}", known.join(", "));
        let help = match guess {
            Some(guess) => format!("did you mean `{guess}`?"),
            None if !homes.is_empty() => format!("`{written}` belongs in {homes}"),
            None => format!("remove `{written}`, or write one of the keys named above"),
        };
        self.report(key.span(), format!("unknown {what} `{written}`{place}"), expected, help);
        guess
    }

    fn homes_of(&self, key: &str) -> String {
        let homes = self.tables.iter().filter(|(_, keys)| keys.contains(&key));
        let named = homes.map(|(table, _)| match *table {
            "" => "the lines before the first table".to_owned(),
            table => format!("[{table}]"),
        });
        named.collect::<Vec<_>>().join(" or ")
    }

    /// Records a problem.
    pub fn report(
        &mut self,
        span: Range<usize>,
        message: impl Into<String>,
        expected: impl Into<String>,
        help: impl Into<String>,
    ) {
        self.problems.push(Problem::new(self.text, span, message, expected).help(help));
    }

    /// The bytes of a value as its author wrote it, without the quotes.
    pub fn as_written(&self, span: Range<usize>) -> String {
        self.text[span].trim_matches(['"', '\'']).to_owned()
    }
}
