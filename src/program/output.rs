//! Standard output and standard error. What is written to them does nothing on a terminal and commands nothing of a
//! build server that reads its log, wherever it comes from.

use std::io::{self, ErrorKind, IsTerminal as _, Write};
use std::path::Path;

use crate::report::escape::is_control;
use miette::{GraphicalReportHandler, GraphicalTheme, IntoDiagnostic, Report, Result, WrapErr};
use serde::Serialize;

/// Writes a result to standard output. A reader that stops early, such as `head`, is no error.
pub fn print(text: impl AsRef<str>) -> Result<()> {
    print_commands(&harmless(text.as_ref()))
}

/// The same of commands to a build server, in whose template all else is escaped.
pub fn print_commands(text: &str) -> Result<()> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(error).into_diagnostic().wrap_err("cannot write to standard output")
        }
        _ => Ok(()),
    }
}

/// Writes one JSON document to standard output.
pub fn print_json(document: &impl Serialize) -> Result<()> {
    let text = serde_json::to_string_pretty(document).into_diagnostic()?;
    print(format!("{text}\n"))
}

/// Writes the path of a file that was written.
pub fn print_path(path: &Path) -> Result<()> {
    print(format!("{}\n", place(path)))
}

/// A path on one line.
pub fn place(path: &Path) -> String {
    path.display().to_string().replace('\n', "\\u000a")
}

/// A word as a shell takes it, quoted where it must be.
pub fn word(text: &str) -> String {
    let harmless = |byte: u8| byte.is_ascii_alphanumeric() || b"-_=./:,+@%".contains(&byte);
    match !text.is_empty() && text.bytes().all(harmless) {
        true => text.to_owned(),
        false => format!("'{}'", text.replace('\'', r"'\''")),
    }
}

/// Says in full why some of several things could not be done, but for the last, which is the command's own
/// error.
pub fn last_of(mut failures: Vec<Report>) -> Result<()> {
    let last = failures.pop();
    failures.iter().for_each(complain_of);
    last.map_or(Ok(()), Err)
}

/// Says in full what is wrong, on a terminal in colours where nothing but these is in the text.
pub fn complain_of(error: &Report) {
    let text = format!("{error:?}");
    let mut plain = String::new();
    let handler = GraphicalReportHandler::new_themed(GraphicalTheme::none());
    let is_plain =
        handler.render_report(&mut plain, error.as_ref()).is_ok() && harmless(&plain) == plain;
    if is_plain && io::stderr().is_terminal() {
        let _ = writeln!(io::stderr().lock(), "{text}");
    } else {
        complain(&text);
    }
}

/// Writes to standard error; when even that fails, nobody is left to be told.
pub fn complain(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{}", harmless(text));
}

/// Text in which a character that acts stands as its code, as JSON writes one: what a terminal obeys, and what begins a
/// command of a workflow, `::` at the beginning of a line and `##[`, `##vso[` and the like anywhere.
pub fn harmless(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        let begin = line.len() - line.trim_start().len();
        let is_command = line[begin..].starts_with("::");
        for (place, letter) in line.char_indices() {
            let rest = &line[place..];
            let acts = match letter {
                '\n' | '\t' => false,
                ':' => is_command && place == begin,
                '#' => rest.strip_prefix("##").is_some_and(|rest| {
                    rest.trim_start_matches(|c: char| c.is_ascii_alphabetic()).starts_with('[')
                }),
                other => is_control(other),
            };
            if acts {
                for unit in letter.encode_utf16(&mut [0; 2]) {
                    out += &format!("\\u{unit:04x}");
                }
            } else {
                out.push(letter);
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::harmless;

    #[test]
    fn what_acts_is_shown() {
        for (text, shown) in [
            ("b = 7.5 mm: 1:1\n\t## A\n", "b = 7.5 mm: 1:1\n\t## A\n"),
            ("a\u{1b}[31m\0\u{9b}2J\r", "a\\u001b[31m\\u0000\\u009b2J\\u000d"),
            ("\u{202e}a", "\\u202ea"),
            ("a\u{200b}\u{e0041}\u{61c}", "a\\u200b\\udb40\\udc41\\u061c"),
            ("::error::a\n  ::b\na::c", "\\u003a:error::a\n  \\u003a:b\na::c"),
            ("a ##[error]b ##vso[c]", "a \\u0023#[error]b \\u0023#vso[c]"),
        ] {
            assert_eq!(harmless(text), shown);
        }
    }
}
