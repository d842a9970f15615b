//! SHA-256 in hexadecimal: what names a case's text, a sweep and its files.
//!
//! For the program itself: this module may change at any time.

use std::borrow::Cow;
use std::fmt::Write as _;

use sha2::{Digest as _, Sha256};

/// The SHA-256 of some bytes, as 64 lower-case hexadecimal digits.
///
/// ```
/// // The example of FIPS 180-2, appendix B.1.
/// let wanted = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
/// assert_eq!(vinesink::digest::sha256(b"abc"), wanted);
/// ```
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().fold(String::with_capacity(64), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}

/// The SHA-256 of a text whose lines end alike: a checkout that ends them with a carriage return too (`core.autocrlf`) has
/// the same text. A byte order mark counts: no checkout adds one.
///
/// ```
/// use vinesink::digest::{sha256, text_sha256};
///
/// assert_eq!(text_sha256("a\r\nb\r\n"), sha256(b"a\nb\n"));
/// ```
pub fn text_sha256(text: &str) -> String {
    file_sha256(text.as_bytes())
}

/// The same of the bytes of a file.
pub fn file_sha256(bytes: &[u8]) -> String {
    sha256(&one_line_end(bytes))
}

/// A text with line ends of one kind; bytes that have no others as they are.
pub fn one_line_end(text: &[u8]) -> Cow<'_, [u8]> {
    if !text.windows(2).any(|two| two == b"\r\n") {
        return Cow::Borrowed(text);
    }
    let next = text.iter().skip(1).map(Some).chain([None]);
    let kept = text
        .iter()
        .zip(next)
        .filter(|(byte, next)| (**byte, next.copied()) != (b'\r', Some(b'\n')));
    Cow::Owned(kept.map(|(byte, _)| *byte).collect())
}

#[cfg(test)]
mod tests {
    /// FIPS 180-2, appendix B.2.
    #[test]
    fn a_text_of_two_blocks() {
        let text = b"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq";
        let wanted = "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1";
        assert_eq!(super::sha256(text), wanted);
    }
}
