//! Text from outside on a page, in a message of a build server and on a terminal: nothing in it means anything
//! there. A template escapes all that it prints by the kind of its page, which `of_page` knows; what is to stay as
//! it is says so with a filter.

use std::io::{self, Write};

use tera::{EscapeFn, escape_html};

/// How the kinds of pages escape, by the ends of their names. Other templates print text as it is.
const PAGES: [(&str, EscapeFn); 5] = [
    (".md", markdown),
    (".html", element),
    (".xml", element),
    (".github", annotation),
    (".txt", line),
];

/// The ends of the names of templates that escape.
pub(super) fn suffixes() -> [&'static str; PAGES.len()] {
    PAGES.map(|(suffix, _)| suffix)
}

/// How a template of this name escapes.
pub(super) fn of_page(name: &str) -> Option<EscapeFn> {
    PAGES.iter().find(|(suffix, _)| name.ends_with(suffix)).map(|(_, escape)| *escape)
}

/// What a function that escapes makes of a text.
fn escaped(escape: EscapeFn, text: &str) -> String {
    let mut bytes = Vec::new();
    // Writing to memory does not fail.
    let _ = escape(text, &mut bytes);
    String::from_utf8_lossy(&bytes).into_owned()
}

pub use super::figure::is_control;

/// A character of a text that stays on its line.
fn on_its_line(letter: char) -> char {
    match letter {
        '\n' | '\r' | '\t' => ' ',
        control if is_control(control) => char::REPLACEMENT_CHARACTER,
        other => other,
    }
}

/// Text on a line of a terminal.
fn line(text: &str, out: &mut dyn Write) -> io::Result<()> {
    write!(out, "{}", text.chars().map(on_its_line).collect::<String>())
}

/// Text in HTML.
pub(super) fn html(text: &str) -> String {
    escaped(element, text)
}

/// Text in HTML and XML, in an attribute too; it may have several lines.
fn element(text: &str, out: &mut dyn Write) -> io::Result<()> {
    let seen = |c| if matches!(c, '\n' | '\t') { c } else { on_its_line(c) };
    escape_html(&text.chars().map(seen).collect::<String>(), out)
}

/// Text in a message of a GitHub workflow, with the workflow's own escapes for what would end it.
fn annotation(text: &str, out: &mut dyn Write) -> io::Result<()> {
    for letter in text.chars() {
        match letter {
            '%' => write!(out, "%25")?,
            '\n' => write!(out, "%0A")?,
            other => write!(out, "{}", on_its_line(other))?,
        }
    }
    Ok(())
}

/// The same in a property of a message, which ends earlier.
pub(super) fn property(text: &str) -> String {
    escaped(annotation, text).replace(':', "%3A").replace(',', "%2C")
}

/// Text in Markdown as GitHub and others extend it. A character that may mean something becomes an entity, which
/// means nothing wherever it stands: in text, a table or an HTML element. A forge makes links of names,
/// numbers and addresses after all that; a space without width (8203) within them keeps it from finding them.
fn markdown(text: &str, out: &mut dyn Write) -> io::Result<()> {
    let letters: Vec<char> = text.chars().map(on_its_line).collect();
    let at = |place: usize| letters.get(place).copied();
    let is = |place: usize, of: fn(&char) -> bool| at(place).as_ref().is_some_and(of);
    // What follows the end of a text is not known here.
    let may_be = |place: usize, of: fn(&char) -> bool| at(place).as_ref().is_none_or(of);
    let is_word = |c: &char| c.is_alphanumeric();
    let begin = letters.iter().take_while(|c| **c == ' ').count();
    let after_digits = begin + letters[begin..].iter().take_while(|c| c.is_ascii_digit()).count();
    for (place, letter) in letters.iter().copied().enumerate() {
        let next = place + 1;
        let before = |word: &str| {
            let start = next.saturating_sub(word.len());
            let found = letters[start..next].iter().collect::<String>();
            found.eq_ignore_ascii_case(word)
        };
        let entity = match letter {
            '*' | '`' | '\\' | '|' | '~' | '$' => true,
            // Before an address, or what names one; without it the bracket that opens is none either.
            ']' => is(next, |c| "([:".contains(*c)),
            '<' => may_be(next, |c| c.is_ascii_alphabetic() || "/!?".contains(*c)),
            '&' => may_be(next, |c| c.is_ascii_alphabetic() || *c == '#'),
            '_' => place == 0 || !is(place - 1, is_word) || !is(next, is_word),
            // Only at the beginning of a line: a quotation, a heading, a list, a line below a heading.
            '>' | '#' | '=' if place == begin => true,
            '-' if place == begin => may_be(next, |c| " -".contains(*c)),
            '+' if place == begin => may_be(next, |c| *c == ' '),
            '.' | ')' if place == after_digits && place > begin => may_be(next, |c| *c == ' '),
            _ => false,
        };
        match entity {
            true => write!(out, "&#{};", u32::from(letter))?,
            false => write!(out, "{letter}")?,
        }
        let link = match letter {
            '@' => may_be(next, is_word),
            '#' => is(next, char::is_ascii_digit),
            '-' => before("gh-") && is(next, char::is_ascii_digit),
            ':' => is(next, |c| *c == '/') && is(next + 1, |c| *c == '/'),
            '.' => before("www."),
            _ => false,
        };
        if link {
            write!(out, "&#8203;")?;
        }
    }
    Ok(())
}

/// Text in an attribute of an element in Markdown, in a table too.
pub(super) fn attribute(text: &str) -> String {
    let text: String = text.chars().map(on_its_line).collect();
    let entities = [("&", "&amp;"), ("\"", "&quot;"), ("<", "&lt;"), ("|", "&#124;")];
    entities.iter().fold(text, |text, (from, to)| text.replace(from, to))
}

/// A path as a link writes it: everything that could mean something else is encoded.
pub fn url_path(path: &str) -> String {
    path.bytes().fold(String::with_capacity(path.len()), |mut link, byte| {
        if byte.is_ascii_alphanumeric() || b"-._~/".contains(&byte) {
            link.push(char::from(byte));
        } else {
            link.push_str(&format!("%{byte:02X}"));
        }
        link
    })
}

/// Text in code marks, in which no entity is one: text that would leave them stands in an element instead.
pub(super) fn code(text: &str) -> String {
    let plain = |c: char| !"`|".contains(c) && c == on_its_line(c);
    let trimmed = !text.is_empty() && text.trim() == text;
    match trimmed && text.chars().all(plain) {
        true => format!("`{text}`"),
        false => format!("<code>{}</code>", escaped(markdown, text)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(text: &str) -> String {
        escaped(markdown, text)
    }

    #[test]
    fn ordinary_text_stays_as_it_is() {
        for ordinary in [
            "b = 7.5 mm (+0.27 mm)",
            "1:1 resonance, 80 % of the band",
            "x_y and two_words_more",
            "−1.8 ± 0.2 dB",
            "-1.8 dB",
            "+0.3 points",
            "++−",
            "[0.65, 0.55] \"as written\"",
            "< 0.01 %",
            "<0.1 %",
            "z > 2 & z < 3",
            "3.5",
            "2016-10-01",
            "Li, Seguy & Berlioz (2016), fig. 4(c)",
            "x′ = 0.3/b; see p. 12: this",
        ] {
            assert_eq!(text(ordinary), ordinary);
        }
    }

    #[test]
    fn what_means_something_does_not() {
        for (from, to) in [
            ("a*b*", "a&#42;b&#42;"),
            ("<img>", "&#60;img>"),
            ("</b", "&#60;/b"),
            ("a<", "a&#60;"),
            ("&lt;", "&#38;lt;"),
            ("![a](b)", "![a&#93;(b)"),
            ("[a][b]: c", "[a&#93;[b&#93;: c"),
            ("_a_", "&#95;a&#95;"),
            ("a|b", "a&#124;b"),
            ("$a$", "&#36;a&#36;"),
            ("~~a~~", "&#126;&#126;a&#126;&#126;"),
            ("# a", "&#35; a"),
            ("> a", "&#62; a"),
            ("- a", "&#45; a"),
            ("---", "&#45;--"),
            ("12. a", "12&#46; a"),
            ("1) a", "1&#41; a"),
            ("a\n# b", "a # b"),
            ("@a", "@&#8203;a"),
            ("a/b#1", "a/b#&#8203;1"),
            ("#1", "&#35;&#8203;1"),
            ("GH-1", "GH-&#8203;1"),
            ("https://a.b", "https:&#8203;//a.b"),
            ("WWW.a.b", "WWW.&#8203;a.b"),
            ("a@b.c", "a@&#8203;b.c"),
            ("a\0\u{1b}[1m\u{202e}", "a\u{fffd}\u{fffd}[1m\u{fffd}"),
        ] {
            assert_eq!(text(from), to);
        }
    }

    #[test]
    fn nothing_leaves_code_marks() {
        assert_eq!(code("cases/a_b.toml"), "`cases/a_b.toml`");
        assert_eq!(code("a`<img src=x>`b"), "<code>a&#96;&#60;img src=x>&#96;b</code>");
        assert_eq!(code("a|b"), "<code>a&#124;b</code>");
        assert_eq!(code("a\nb"), "<code>a b</code>");
        assert_eq!(code(""), "<code></code>");
    }
}
