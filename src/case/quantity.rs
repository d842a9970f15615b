//! Quantities: a number followed by a unit, such as `"7.5 mm"`.
//!
//! Prefixes are powers of ten, so the number is converted by moving its decimal exponent and rounded once:
//! `"7.5 mm"` is the same double as `0.0075`.

use std::ops::Range;

use super::value::nearest;
use crate::quantity::Dimension;
use crate::quantity::unit::Unit;

/// Why a text is not the quantity it should be.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct QuantityError {
    /// What is wrong, as the rest of a sentence whose subject is the key.
    pub message: String,
    /// What to do, where more can be said than what was expected.
    pub help: Option<String>,
    /// The offending bytes of the text.
    pub range: Range<usize>,
}

/// What a case gives with a unit: its name with its article, and an example.
const MEASURED: [(Dimension, &str, &str); 16] = [
    (Dimension::Length, "a length", "7.5 mm"),
    (Dimension::Mass, "a mass", "32 g"),
    (Dimension::Stiffness, "a stiffness", "11.47 kN/m"),
    (Dimension::Damping, "a damping", "3.02 N s/m"),
    (Dimension::Frequency, "a frequency", "8 Hz"),
    (Dimension::Force, "a force", "2.9 N"),
    (Dimension::Velocity, "a velocity", "0.5 m/s"),
    (Dimension::Acceleration, "an acceleration", "2 m/s²"),
    (Dimension::AccelerationDensity, "a density of accelerations", "0.02 g2/Hz"),
    (Dimension::Impulse, "an impulse", "2 N s"),
    (Dimension::Time, "a time", "5 s"),
    (Dimension::FrequencyRate, "a sweep rate", "0.1 Hz/s"),
    (Dimension::OctaveRate, "a sweep rate", "1 oct/min"),
    (Dimension::Inclination, "an angle", "0.5 deg"),
    (Dimension::Share, "a share", "1 %"),
    (Dimension::Level, "a level", "12 dB"),
];

impl Dimension {
    /// That of a name, as in "a length".
    pub(super) fn named(name: &str) -> Option<Self> {
        MEASURED.into_iter().find(|(_, known, _)| *known == name).map(|(one, ..)| one)
    }

    /// Its name with its article, and a quantity a person might write.
    pub(super) fn words(self) -> (&'static str, &'static str) {
        let found = MEASURED.into_iter().find(|(one, ..)| *one == self);
        found.map_or(("a number", "1"), |(_, name, example)| (name, example))
    }

    /// It and what has the same name: a sweep rate is in hertz or in octaves.
    pub(super) fn namesakes(self) -> impl Iterator<Item = Self> {
        let name = self.words().0;
        MEASURED.into_iter().filter(move |(_, other, _)| *other == name).map(|(one, ..)| one)
    }

    /// That of its name which the unit of a text belongs to.
    pub(super) fn of_namesake(self, text: &str) -> Self {
        let written = Self::of(text);
        self.namesakes().find(|one| Some(*one) == written).unwrap_or(self)
    }

    /// What a text that begins with a number and a known unit measures, a share excepted.
    pub(super) fn of(text: &str) -> Option<Self> {
        Self::of_unit(&text[leading_number(text)?.end..])
    }

    /// What a unit measures; a share is no dimension that another could be mistaken for.
    fn of_unit(written: &str) -> Option<Self> {
        let all = MEASURED.into_iter().map(|(one, ..)| one).filter(|one| *one != Self::Share);
        all.into_iter().find(|one| one.unit_of(written).is_some())
    }

    /// Whether a word is the unit of something, a share excepted.
    pub(super) fn is_unit(word: &str) -> bool {
        Self::of_unit(word).is_some()
    }

    fn unit_of(self, written: &str) -> Option<&'static Unit> {
        let plain = plain_spelling(written);
        self.accepted_units().find(|unit| plain_spelling(unit.symbol) == plain)
    }

    /// The value in SI units of a number followed by a unit, such as `7.5 mm`.
    ///
    /// # Errors
    /// [`QuantityError`] for a missing, unknown or unsuitable unit, and for a number that is missing, not
    /// finite or beyond what a double can hold.
    pub fn parse(self, text: &str) -> Result<f64, QuantityError> {
        self.parse_behind(text, 0)
    }

    /// The same of what stands behind a sign of so many bytes.
    pub(super) fn parse_behind(self, whole: &str, sign: usize) -> Result<f64, QuantityError> {
        let text = &whole[sign..];
        let error = |message: String, help: Option<String>, range: Range<usize>| {
            Err(QuantityError { message, help, range: sign + range.start..sign + range.end })
        };
        let everything = 0..text.len();
        let example = || Some(format!("write for example \"{}\"", self.words().1));
        let Some(number) = leading_number(text) else {
            return error(no_number(text), example(), everything);
        };
        let unit = text[number.end..].trim();
        if unit.is_empty() {
            let help = format!("write the unit behind the number: {}", self.accepted());
            return error("has no unit".to_owned(), Some(help), everything);
        }
        if unit.starts_with(',') {
            let message = "has a comma where a decimal point belongs".to_owned();
            let help = format!("write \"{}\"", whole.replacen(',', ".", 1));
            return error(message, Some(help), everything);
        }
        let start = text.len() - text[number.end..].trim_start().len();
        match self.unit_of(unit) {
            Some(found) => scaled(&text[number.clone()], found)
                .or_else(|message| error(message, example(), number)),
            None => {
                let (message, help) = self.unsuitable(unit);
                error(message, Some(help), start..start + unit.len())
            }
        }
    }

    /// What is wrong with a unit that is none of its own, and what to do.
    fn unsuitable(self, written: &str) -> (String, String) {
        if let Some(other) = Self::of_unit(written) {
            let ((own, example), (other, _)) = (self.words(), other.words());
            if own == other {
                let message = format!("is in `{written}`, and the case's own is not");
                return (message, format!("write all of them in units as in \"{example}\""));
            }
            let message = format!("is {own}, but `{written}` is the unit of {other}");
            let is_acceleration = Self::Acceleration.unit_of(written).is_some();
            let converted = if self == Self::Length && is_acceleration { CONVERTED } else { "" };
            return (message, self.accepted() + converted);
        }
        let symbols: Vec<&str> = self.all_units().map(|unit| unit.symbol).collect();
        let near = nearest(&plain_spelling(written), &symbols);
        let near = near.map(|near| format!("did you mean `{near}`? ")).unwrap_or_default();
        (format!("has the unknown unit `{written}`"), near + &self.accepted())
    }

    /// The units of all that has its name.
    pub(super) fn all_units(self) -> impl Iterator<Item = &'static Unit> {
        self.namesakes().flat_map(Self::accepted_units)
    }

    fn accepted(self) -> String {
        let symbols: Vec<String> =
            self.all_units().map(|unit| plain_spelling(unit.symbol)).collect();
        format!("{} is accepted in {}", self.words().0, symbols.join(", "))
    }
}

/// What is said where an acceleration stands for a length, as shakers are set.
const CONVERTED: &str = "; a harmonic acceleration a at the frequency f is the amplitude a/(2 pi f)^2: \
                         1 g at 100 Hz is 0.0248 mm";

/// The unit that stands between brackets in the head of a column, a number's without; else what is wrong with it, and
/// what to do.
pub(super) fn unit_in_brackets(
    of: Dimension,
    head: &str,
) -> Result<&'static Unit, (String, String)> {
    let between = |[open, close]: [char; 2]| head.trim_end().strip_suffix(close)?.rsplit_once(open);
    let inner = between(['(', ')']).or_else(|| between(['[', ']']));
    let none = || ("has no unit".to_owned(), of.accepted());
    let Some((_, written)) = inner else { return of.unit_of("").ok_or_else(none) };
    of.unit_of(written).ok_or_else(|| of.unsuitable(written.trim()))
}

/// A number in a unit; `None` where it is none, or none that can be held.
pub(super) fn number_in(text: &str, unit: &Unit) -> Option<f64> {
    let (sign, rest) = match text.trim().strip_prefix('-') {
        Some(rest) => (-1.0, rest),
        None => (1.0, text.trim()),
    };
    let number = leading_number(rest).filter(|number| *number == (0..rest.len()))?;
    scaled(&rest[number], unit).ok().map(|value| sign * value)
}

fn no_number(text: &str) -> String {
    let word: String = text.trim_start().chars().take_while(|c| c.is_alphabetic()).collect();
    let sign = text.trim_start().trim_start_matches(['+', '-']).to_lowercase();
    if text.trim().is_empty() {
        "is empty".to_owned()
    } else if sign.starts_with("inf") || sign.starts_with("nan") {
        format!("is \"{text}\", which is not a finite number")
    } else if Dimension::of_unit(&word).is_some() {
        format!("is \"{text}\", a unit without a number")
    } else {
        format!("is \"{text}\", which does not begin with a number")
    }
}

/// Moves the decimal point of a number, so that it is rounded once.
fn scaled(number: &str, unit: &Unit) -> Result<f64, String> {
    let (mantissa, written) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    let exponent: i32 =
        written.parse().map_err(|_| format!("has an absurd exponent in {number}"))?;
    let shifted = format!("{mantissa}e{}", i64::from(exponent) + i64::from(unit.exponent));
    let [times, over] = unit.quotient;
    let si = shifted.parse::<f64>().unwrap_or(f64::NAN) * times / over;
    let symbol = unit.symbol;
    if si == 0.0 && mantissa.contains(|c| matches!(c, '1'..='9')) {
        return Err(format!("is {number} {symbol}, too small to be told from 0"));
    }
    // Adding 0 makes -0 an ordinary 0.
    si.is_finite().then_some(si + 0.0).ok_or_else(|| format!("is {number} {symbol}, too large"))
}

/// One spelling for the many ways to write a product, a quotient and a micro sign.
fn plain_spelling(written: &str) -> String {
    let plain = written.replace(['*', '·', '⋅'], " ").replace(['µ', 'μ'], "u");
    let words: Vec<&str> = plain.split_whitespace().collect();
    words.join(" ").replace(" /", "/").replace("/ ", "/")
}

/// The bytes of the decimal number that `text` begins with, white space skipped.
pub(super) fn leading_number(text: &str) -> Option<Range<usize>> {
    let start = text.len() - text.trim_start().len();
    let digits =
        |from: usize| from + text.bytes().skip(from).take_while(u8::is_ascii_digit).count();
    let after = |at: usize, any_of: &[char]| at + usize::from(text[at..].starts_with(any_of));
    let whole = after(start, &['+', '-']);
    let point = digits(whole);
    let end = digits(after(point, &['.']));
    if !text[whole..end].contains(|c: char| c.is_ascii_digit()) {
        return None;
    }
    let exponent = after(after(end, &['e', 'E']), &['+', '-']);
    let has_exponent = text[end..].starts_with(['e', 'E']) && digits(exponent) > exponent;
    Some(start..if has_exponent { digits(exponent) } else { end })
}
