//! The text of a commented case to start from.

use super::Case;
use super::comment;
use super::excitation::{KINDS, KindRow};

const STARTING_CASE: &str = include_str!("starting_case.toml");

/// The kinds of excitation that a case may begin with; the first is what it has unless asked.
pub fn excitation_kinds() -> impl Iterator<Item = &'static str> {
    KINDS.iter().map(KindRow::name)
}

/// A line that a case to start from has in place of the one that it shows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StartingLine {
    /// The table it stands in; empty before the first.
    pub table: &'static str,
    /// Its key.
    pub key: &'static str,
    /// Its value, as TOML.
    pub value: String,
}

impl StartingLine {
    /// A line whose value is what a person wrote: a number, or a text with its unit.
    pub fn new(table: &'static str, key: &'static str, written: &str) -> Self {
        let written = written.trim();
        let is_number = written.parse::<f64>().is_ok_and(f64::is_finite);
        let quoted = || toml::Value::from(written).to_string();
        Self { table, key, value: if is_number { written.to_owned() } else { quoted() } }
    }
}

/// Column at which a comment behind a value stands.
pub(super) const COMMENTS: usize = 30;

/// The lines of a text, and how they are changed.
struct Lines(Vec<String>);

/// Where a key is shown.
enum Shown {
    /// As a line of its own, or in the comment behind another that says the same.
    As(usize),
    /// As a comment.
    Commented(usize),
    /// In the words of a comment.
    Named(usize),
}

impl Lines {
    /// Begin and end of a table.
    fn of_table(&self, table: &str) -> std::ops::Range<usize> {
        let is_head = |line: &str| line.trim_start_matches("# ").starts_with('[');
        let heads = || (0..self.0.len()).filter(|k| is_head(&self.0[*k]));
        let of = |k: &usize| self.0[*k].trim_start_matches("# ").starts_with(&format!("[{table}]"));
        let begin = if table.is_empty() { Some(0) } else { heads().find(of) };
        let begin = begin.unwrap_or(self.0.len());
        begin..heads().find(|k| *k > begin).unwrap_or(self.0.len())
    }

    fn shown(&self, table: &std::ops::Range<usize>, key: &str) -> Option<Shown> {
        let find = |is: &dyn Fn(&str) -> bool| table.clone().find(|k| is(&self.0[*k]));
        let [own, other] = [format!("{key} = "), format!("# or {key} = ")];
        let commented = format!("# {own}");
        find(&|line| line.starts_with(&own))
            .or_else(|| find(&|line| line.contains(&other)))
            .map(Shown::As)
            .or_else(|| find(&|line| line.starts_with(&commented)).map(Shown::Commented))
            .or_else(|| find(&|line| line.contains(&format!(" {own}"))).map(Shown::Named))
    }

    /// Gives a table a line, in the place where its key is shown; the comment behind it stays where it fits.
    fn give(&mut self, StartingLine { table, key, value }: &StartingLine) {
        let place = self.of_table(table);
        let line = format!("{key} = {value}");
        let head = place.start;
        match self.shown(&place, key) {
            Some(Shown::As(at)) => {
                let remark = self.remark(at, key);
                let gap =
                    if remark.is_empty() { 0 } else { COMMENTS.saturating_sub(line.len()).max(1) };
                self.0[at] = format!("{line}{}{remark}", " ".repeat(gap));
            }
            Some(Shown::Commented(at)) => self.0[at] = line,
            Some(Shown::Named(at)) => self.0.insert(at + 1, line),
            None => self.0.insert(place.end, line),
        }
        if let Some(open) = self.0.get(head).and_then(|head| head.strip_prefix("# [")) {
            self.0[head] = format!("[{open}");
        }
    }

    /// What still fits of the comment behind a value, where another takes its place.
    fn remark(&self, at: usize, key: &str) -> String {
        let line = &self.0[at];
        let Some((other, value)) = line.split_once(" = ") else { return String::new() };
        let comment = comment::behind(line, other.len()).map(|range| line[range].trim_start());
        match comment {
            _ if other != key => format!("# or {other}"),
            Some(comment) if comment::fits(comment, value.trim_matches('"')) => comment.to_owned(),
            _ => String::new(),
        }
    }
}

impl Case {
    /// The text of a commented case to start from, with the given title.
    pub fn starting_text(title: &str) -> String {
        Self::starting_text_of(title, KINDS[0].name())
    }

    /// The same with other values: each line stands where its key is shown.
    pub fn starting_text_with(title: &str, kind: &str, lines: &[StartingLine]) -> String {
        let text = Self::starting_text_of(title, kind);
        let mut all = Lines(text.lines().map(str::to_owned).collect());
        lines.iter().for_each(|line| all.give(line));
        all.0.join("\n") + "\n"
    }

    /// The same with another kind of excitation, one of [`excitation_kinds`]; the other kinds are comments.
    pub fn starting_text_of(title: &str, kind: &str) -> String {
        let (own, others): (Vec<_>, _) = KINDS.iter().partition(|row| row.name() == kind);
        let lines = |row: &&KindRow| format!("kind = \"{}\"\n{}", row.name(), row.lines);
        let commented = |row: &&KindRow| {
            lines(row).lines().map(|line| format!("# {line}\n")).collect::<String>()
        };
        let own: String = own.iter().map(lines).collect();
        let others: Vec<String> = others.iter().map(commented).collect();
        let quoted = toml::Value::from(title).to_string();
        let text = STARTING_CASE.replacen("EXCITATION\n", &own, 1);
        let text = text.replacen("OTHER_KINDS\n", &others.join("#\n"), 1);
        text.replacen("\"TITLE\"", &quoted, 1)
    }
}
