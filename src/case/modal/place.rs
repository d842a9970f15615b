//! Places by their names.

use std::ops::Range;

use crate::case::reader::{Reader, Table};
use crate::case::value::{nearest, or};

/// Reports names that would break a table.
pub(super) fn check_names(reader: &mut Reader, root: &Table, places: &[String]) {
    let breaks = |name: &&String| name.chars().any(|one| one == '|' || one.is_control());
    let Some(name) = places.iter().find(breaks) else { return };
    let told = ["mode", "modes", "reduced"].into_iter().find(|table| root.has(table));
    let message = format!("a place is called {name:?}");
    let expected = "expected names without `|` and without line breaks";
    let at = root.span_of(told.unwrap_or_default());
    reader.report(at, message, expected, "give the place a name such as tip");
}

/// The place of a name, which stands there in the text; the only one where none is given.
pub(in crate::case) fn find_place(
    reader: &mut Reader,
    span: Range<usize>,
    name: Option<&str>,
    places: &[String],
) -> Option<usize> {
    let known: Vec<&str> = places.iter().map(String::as_str).collect();
    let quoted: Vec<String> = places.iter().map(|name| format!("\"{name}\"")).collect();
    let message = match name {
        None if places.len() == 1 => return Some(0),
        None => "`place` is missing".to_owned(),
        Some(name) => match known.iter().position(|known| *known == name) {
            Some(found) => return Some(found),
            None => format!("\"{name}\" is a place at which no mode has a shape"),
        },
    };
    if places.is_empty() {
        // Said of the modes.
        return None;
    }
    let help = match name.and_then(|name| nearest(name, &known)) {
        Some(near) => format!("did you mean \"{near}\"?"),
        None if name.is_some() => format!("write for example {}", quoted[0]),
        None => format!("write place = {}", quoted[0]),
    };
    reader.report(span, message, format!("expected {}", or(&quoted)), help);
    None
}
