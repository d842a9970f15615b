//! Places by their names.

use std::ops::Range;

use crate::case::reader::Reader;
use crate::case::value::{nearest, or};

/// The place of a name, which stands there in the text; the only one where none is given.
pub(super) fn find_place(
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
        None => format!("write place = {}", quoted[0]),
    };
    reader.report(span, message, format!("expected {}", or(&quoted)), help);
    None
}
