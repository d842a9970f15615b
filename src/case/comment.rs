//! The comment behind a value, and whether it still fits once the value has changed.

use std::ops::Range;

use super::quantity::leading_number;
use crate::quantity::Dimension;

/// The comment behind a value that ends at a byte of a text, with the space before it and the indented lines of comment
/// that go on with it.
pub(super) fn behind(text: &str, end: usize) -> Option<Range<usize>> {
    let line_end = |from: usize| text[from..].find('\n').map_or(text.len(), |end| from + end);
    let line = &text[end..line_end(end)];
    let mut quote = None;
    let sign = line.char_indices().find(|(_, letter)| {
        match (quote, letter) {
            (None, '"' | '\'') => quote = Some(*letter),
            (Some(open), letter) if open == *letter => quote = None,
            _ => {}
        }
        quote.is_none() && *letter == '#'
    });
    let begin = end + line[..sign?.0].trim_end().len();
    let mut last = line_end(end);
    while last < text.len() {
        let next = line_end(last + 1);
        let goes_on = &text[last + 1..next];
        if !(goes_on.starts_with([' ', '\t']) && goes_on.trim_start().starts_with('#')) {
            break;
        }
        last = next;
    }
    Some(begin..last)
}

/// Whether a comment names no number that may belong to the value it stands behind: none with a unit, and not the value
/// as it was written.
pub(super) fn fits(comment: &str, written: &str) -> bool {
    let was = leading_number(written).map(|number| &written[number]);
    let mut before = ' ';
    for (place, letter) in comment.char_indices() {
        let begins = letter.is_ascii_digit() && !before.is_alphanumeric() && before != '.';
        before = letter;
        if !begins {
            continue;
        }
        let rest = &comment[place..];
        let Some(number) = leading_number(rest) else { continue };
        let unit = rest[number.end..].trim_start();
        let ends = |letter: char| letter.is_whitespace() || "\"',;:.)]".contains(letter);
        let unit = unit.split(ends).next().unwrap_or_default();
        let measures = unit.starts_with('%') || (!unit.is_empty() && Dimension::is_unit(unit));
        if measures || was == Some(&rest[number]) {
            return false;
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::{behind, fits};

    #[test]
    fn a_comment_that_names_a_number_of_its_own_does_not_fit() {
        for (comment, written) in [
            ("# or mass_ratio = \"0.77 %\", which is this mass over the other", "32 g"),
            ("# half of the 15 mm that the housing has", "7.5 mm"),
            ("# 0.55 by the drop test", "0.55"),
            ("# 2.05Hz", "1 Hz"),
        ] {
            assert!(!fits(comment, written), "{comment}");
        }
        for (comment, written) in [
            ("# from the middle to either wall", "6 mm"),
            ("# speed after over before: 1 elastic, 0 no rebound", "0.6"),
            ("# section 3.4, M8 bolts, for 1:1 resonance", "6 mm"),
        ] {
            assert!(fits(comment, written), "{comment}");
        }
    }

    #[test]
    fn a_comment_ends_with_its_lines() {
        let text = "a = { b = 1, c = \"#\" }  # one\n    # two\n# three\nd = 2\n";
        let found = |end| behind(text, end).map(|range| &text[range]);
        assert_eq!(found(text.find('1').expect("there") + 1), Some("  # one\n    # two"));
        assert_eq!(found(text.find('2').map_or(0, |_| text.len() - 1)), None);
    }
}
