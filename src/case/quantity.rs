//! Quantities: a number with a unit, whose dimension is part of its type.
//!
//! A case file writes `"7.5 mm"`; [`Quantity<Length>`] is what that means, in SI units. Prefixes
//! are powers of ten, so the number is converted by moving its decimal exponent and rounded once:
//! `"7.5 mm"` is the same double as `0.0075`.

use std::fmt;
use std::marker::PhantomData;
use std::ops::{Div, Range};

use serde::Deserialize;

use super::suggest::nearest;

/// What can be measured, and how it may be written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measurand {
    /// As in "a length".
    pub name: &'static str,
    /// The SI unit that values are held in.
    pub si: &'static str,
    /// A quantity a person might write, unit included.
    pub example: &'static str,
    /// Every unit accepted, the usual ones first.
    pub units: &'static [Unit],
}

/// A [`Measurand`] as a type.
pub trait Dimension: 'static {
    /// What it is.
    const OF: &'static Measurand;
    /// As in "a length".
    const NAME: &'static str = Self::OF.name;
    /// Every unit accepted, the usual ones first.
    const UNITS: &'static [Unit] = Self::OF.units;
}

/// A unit that a case file may use: `value_si = number * 10^exponent / divisor`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// The unit as written; a space stands for a product, `u` also for `µ`.
    pub symbol: &'static str,
    exponent: i32,
    divisor: f64,
}

const fn unit(symbol: &'static str, exponent: i32) -> Unit {
    Unit { symbol, exponent, divisor: 1.0 }
}

macro_rules! dimension {
    ($(#[$doc:meta])* $type:ident, $name:literal, $si:literal, $example:literal, $units:expr) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum $type {}
        impl Dimension for $type {
            const OF: &'static Measurand =
                &Measurand { name: $name, si: $si, example: $example, units: $units };
        }
    };
}

dimension!(
    /// Metres.
    Length, "a length", "m", "7.5 mm",
    &[unit("mm", -3), unit("m", 0), unit("cm", -2), unit("um", -6), unit("nm", -9)]
);
dimension!(
    /// Kilograms.
    Mass, "a mass", "kg", "32 g",
    &[unit("kg", 0), unit("g", -3), unit("mg", -6), unit("ug", -9)]
);
dimension!(
    /// Newtons per metre.
    Stiffness, "a stiffness", "N/m", "11.47 kN/m",
    &[
        unit("N/m", 0), unit("kN/m", 3), unit("MN/m", 6), unit("mN/m", -3),
        unit("N/mm", 3), unit("kN/mm", 6), unit("N/cm", 2), unit("N/um", 6),
    ]
);
dimension!(
    /// Newton seconds per metre.
    Damping, "a damping", "N s/m", "3.02 N s/m",
    &[
        unit("N s/m", 0), unit("Ns/m", 0), unit("kN s/m", 3), unit("kNs/m", 3),
        unit("mN s/m", -3), unit("mNs/m", -3), unit("N s/mm", 3), unit("Ns/mm", 3),
        unit("kg/s", 0), unit("g/s", -3),
    ]
);
dimension!(
    /// A part of a whole: `1 %` is 0.01.
    Share, "a share", "1", "1 %", &[unit("%", -2)]
);
dimension!(
    /// Hertz; angular frequencies in rad/s are converted.
    Frequency, "a frequency", "Hz", "8 Hz",
    &[
        unit("Hz", 0), unit("kHz", 3), unit("mHz", -3), unit("MHz", 6),
        Unit { symbol: "rad/s", exponent: 0, divisor: std::f64::consts::TAU },
    ]
);
dimension!(
    /// Metres per second.
    Velocity, "a velocity", "m/s", "0.5 m/s",
    &[unit("m/s", 0), unit("mm/s", -3), unit("cm/s", -2)]
);
dimension!(
    /// Newtons.
    Force, "a force", "N", "2.9 N",
    &[unit("N", 0), unit("mN", -3), unit("kN", 3), unit("uN", -6), unit("nN", -9), unit("MN", 6)]
);

dimension!(
    /// Decibels.
    Decibel, "a level", "dB", "12 dB", &[unit("dB", 0)]
);

/// Everything that can be measured.
const ALL: [&Measurand; 9] = [
    Length::OF,
    Mass::OF,
    Stiffness::OF,
    Damping::OF,
    Frequency::OF,
    Force::OF,
    Velocity::OF,
    Share::OF,
    Decibel::OF,
];

impl Measurand {
    /// That of a name, as in "a length".
    pub(super) fn named(name: &str) -> Option<&'static Self> {
        ALL.into_iter().find(|one| one.name == name)
    }

    /// What a text that begins with a number and a known unit measures, a share excepted.
    pub(super) fn of(text: &str) -> Option<&'static Self> {
        Self::of_unit(text[leading_number(text)?.end..].trim())
    }

    /// What a unit measures; a share is no dimension that another could be mistaken for.
    fn of_unit(symbol: &str) -> Option<&'static Self> {
        ALL.into_iter().find(|one| *one != Share::OF && one.unit(symbol).is_some())
    }

    fn unit(&self, written: &str) -> Option<&'static Unit> {
        let plain = plain_spelling(written);
        self.units.iter().find(|unit| unit.symbol == plain)
    }

    /// The value in SI units of a number followed by a unit, such as `7.5 mm`.
    pub(super) fn parse(&self, text: &str) -> Result<f64, QuantityError> {
        let number = leading_number(text).ok_or_else(|| self.not_a_number(text))?;
        let rest = text[number.end..].trim();
        let start = text.len() - text[number.end..].trim_start().len();
        if rest.is_empty() {
            let help = format!("write the unit behind the number: {}", self.accepted());
            return Err(self.error("has no unit".to_owned(), 0..text.len()).with_help(help));
        }
        if rest.starts_with(',') {
            let message = "has a comma where a decimal point belongs".to_owned();
            let help = format!("write \"{}\"", text.replacen(',', ".", 1));
            return Err(self.error(message, 0..text.len()).with_help(help));
        }
        let unit = self.unit(rest);
        let unit = unit.ok_or_else(|| self.unsuitable_unit(rest, start..start + rest.len()))?;
        scaled(&text[number.clone()], unit).map_err(|message| self.error(message, number))
    }

    fn error(&self, message: String, range: Range<usize>) -> QuantityError {
        let expected = format!("expected {} such as \"{}\"", self.name, self.example);
        QuantityError { message, expected, help: None, range }
    }

    fn not_a_number(&self, text: &str) -> QuantityError {
        let word: String = text.trim_start().chars().take_while(|c| c.is_alphabetic()).collect();
        let sign = text.trim_start().trim_start_matches(['+', '-']).to_lowercase();
        let message = if text.trim().is_empty() {
            "is empty".to_owned()
        } else if sign.starts_with("inf") || sign.starts_with("nan") {
            format!("is \"{text}\", which is not a finite number")
        } else if Self::of_unit(&word).is_some() {
            format!("is \"{text}\", a unit without a number")
        } else {
            format!("is \"{text}\", which does not begin with a number")
        };
        self.error(message, 0..text.len())
    }

    fn unsuitable_unit(&self, written: &str, range: Range<usize>) -> QuantityError {
        let symbols: Vec<&str> = self.units.iter().map(|unit| unit.symbol).collect();
        let unknown = format!("has the unknown unit `{written}`");
        let (message, help) =
            match (Self::of_unit(written), nearest(&plain_spelling(written), &symbols)) {
                (Some(other), _) => {
                    let other = other.name;
                    let message =
                        format!("is {}, but `{written}` is the unit of {other}", self.name);
                    (message, self.accepted())
                }
                (None, Some(near)) => {
                    (unknown, format!("did you mean `{near}`? {}", self.accepted()))
                }
                (None, None) => (unknown, self.accepted()),
            };
        self.error(message, range).with_help(help)
    }

    fn accepted(&self) -> String {
        let symbols: Vec<&str> = self.units.iter().map(|unit| unit.symbol).collect();
        format!("{} is accepted in {}", self.name, symbols.join(", "))
    }
}

/// Moves the decimal point of a number, so that it is rounded once.
fn scaled(number: &str, unit: &Unit) -> Result<f64, String> {
    let (mantissa, written) = match number.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>()),
        None => (number, Ok(0)),
    };
    let exponent = written.map_err(|_| format!("has an absurd exponent in {number}"))?;
    let shifted = format!("{mantissa}e{}", i64::from(exponent) + i64::from(unit.exponent));
    let si = shifted.parse::<f64>().unwrap_or(f64::NAN) / unit.divisor;
    if si == 0.0 && mantissa.contains(|c| matches!(c, '1'..='9')) {
        return Err(format!("is {number} {}, too small to be told from 0", unit.symbol));
    }
    // Adding 0 makes -0 an ordinary 0.
    if si.is_finite() {
        Ok(si + 0.0)
    } else {
        Err(format!("is {number} {}, too large", unit.symbol))
    }
}

/// A finite value of one dimension, in SI units.
#[derive(Clone, Copy, PartialEq, Deserialize)]
#[serde(transparent, bound = "")]
pub struct Quantity<D> {
    si: f64,
    dimension: PhantomData<D>,
}

/// Why a text is not the quantity it should be.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct QuantityError {
    /// What is wrong, as the rest of a sentence whose subject is the key.
    pub message: String,
    /// What would have been accepted.
    pub expected: String,
    /// What to do, where more can be said than what was expected.
    pub help: Option<String>,
    /// The offending bytes of the text.
    pub range: Range<usize>,
}

impl QuantityError {
    fn with_help(self, help: String) -> Self {
        Self { help: Some(help), ..self }
    }
}

impl<D: Dimension> Quantity<D> {
    /// Reads a number followed by a unit, such as `7.5 mm`.
    ///
    /// # Errors
    /// [`QuantityError`] for a missing, unknown or unsuitable unit, and for a number that is
    /// missing, not finite or beyond what a double can hold.
    pub fn parse(text: &str) -> Result<Self, QuantityError> {
        D::OF.parse(text).map(|si| Self { si, dimension: PhantomData })
    }

    /// A quantity from its SI value; `None` unless finite.
    pub fn from_si(si: f64) -> Option<Self> {
        // Adding 0 makes -0 an ordinary 0.
        si.is_finite().then_some(Self { si: si + 0.0, dimension: PhantomData })
    }

    /// The value in the SI unit of its [`Measurand`].
    pub fn si(self) -> f64 {
        self.si
    }
}

/// One spelling for the many ways to write a product, a quotient and a micro sign.
fn plain_spelling(written: &str) -> String {
    let product = |c| if matches!(c, '*' | '·' | '⋅') { ' ' } else { c };
    let micro = |c| if matches!(c, 'µ' | 'μ') { 'u' } else { c };
    let spaced: String = written.chars().map(product).map(micro).collect();
    let words: Vec<&str> = spaced.split_whitespace().collect();
    words.join(" ").replace(" /", "/").replace("/ ", "/")
}

/// The bytes of the decimal number that `text` begins with, white space skipped.
fn leading_number(text: &str) -> Option<Range<usize>> {
    let bytes = text.as_bytes();
    let start = text.len() - text.trim_start().len();
    let sign = usize::from(matches!(bytes.get(start), Some(b'+' | b'-')));
    let mut end = digits(bytes, start + sign);
    let whole = end > start + sign;
    if bytes.get(end) == Some(&b'.') && (whole || bytes.get(end + 1)?.is_ascii_digit()) {
        end = digits(bytes, end + 1);
    } else if !whole {
        return None;
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let signed = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let after = digits(bytes, end + 1 + signed);
        if after > end + 1 + signed {
            end = after;
        }
    }
    Some(start..end)
}

fn digits(bytes: &[u8], from: usize) -> usize {
    from + bytes.iter().skip(from).take_while(|byte| byte.is_ascii_digit()).count()
}

impl<D: Dimension> fmt::Debug for Quantity<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// The shortest text that [`Quantity::parse`] reads back to the same value.
impl<D: Dimension> fmt::Display for Quantity<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.si, D::OF.si)
    }
}

/// The ratio of two quantities of one dimension is a number.
impl<D> Div for Quantity<D> {
    type Output = f64;
    fn div(self, other: Self) -> f64 {
        self.si / other.si
    }
}
