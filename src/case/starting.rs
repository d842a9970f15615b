//! The text of a commented case to start from.

use super::Case;
use super::excitation::{KINDS, KindRow};

const STARTING_CASE: &str = include_str!("starting_case.toml");

/// The kinds of excitation that a case may begin with; the first is what it has unless asked.
pub fn excitation_kinds() -> impl Iterator<Item = &'static str> {
    KINDS.iter().map(KindRow::name)
}

impl Case {
    /// The text of a commented case to start from, with the given title.
    pub fn starting_text(title: &str) -> String {
        Self::starting_text_of(title, KINDS[0].name())
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
