//! A case file with other values, everything else as its author wrote it.

use super::comment;
use super::inputs::Input;
use super::{Case, CaseError, Design};
use crate::quantity::Dimension;
use crate::system::Parameter;

/// Why a case file cannot be rewritten.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RewriteError {
    /// The text is not that of the case.
    #[error("the case file cannot be changed: its text is not the one that was read")]
    OtherText,
    /// The changed text is no valid case.
    #[error("the changed case is not valid: {0}")]
    Invalid(#[from] Box<CaseError>),
}

/// A changed case file.
#[derive(Debug, Clone, PartialEq)]
pub struct Rewritten {
    /// Its text.
    pub text: String,
    /// The case that it describes.
    pub case: Case,
}

/// How a value is rounded when it is written, to four significant digits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rounding {
    /// To the nearest number.
    Nearest,
    /// To the one below.
    Down,
    /// To the one above.
    Up,
    /// Not at all.
    Exact,
}

impl Rounding {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Nearest, Self::Down, Self::Up, Self::Exact];

    /// A value above 0 with [`DIGITS`] significant digits; one that has no more, but for rounding, stays what it is.
    pub(crate) fn of(self, value: f64) -> f64 {
        let round = match self {
            Self::Nearest => libm::rint,
            Self::Down => libm::floor,
            Self::Up => libm::ceil,
            Self::Exact => return value,
        };
        if value == 0.0 {
            return value;
        }
        let place = libm::floor(libm::log10(value)) as i32 - (DIGITS - 1);
        let units = value / libm::pow(10.0, f64::from(place));
        let nearest = libm::rint(units);
        let units = if (units - nearest).abs() < SAME * nearest { nearest } else { round(units) };
        // Read back from decimal digits, so that it is the double that a person would write.
        format!("{units}e{place}").parse().unwrap_or(value)
    }
}

/// Relative difference of values that are one in different units.
const SAME: f64 = 1e-12;
/// Significant digits of a written value.
const DIGITS: i32 = 4;

/// A value as TOML, in the unit in which an input's own is written; a pair where that is one, their difference kept.
fn written(input: &Input, si: f64, difference: f64, step: Rounding) -> String {
    if input.as_written.starts_with('[') {
        let [first, second] = [0.5, -0.5].map(|half| step.of(si + half * difference));
        return format!("[{first:?}, {second:?}]");
    }
    in_unit_of(&input.as_written, si, step)
}

/// A value as TOML, in the unit of another one.
pub(super) fn in_unit_of(as_written: &str, si: f64, step: Rounding) -> String {
    let begins = |c: char| matches!(c, '%' | '°') || c.is_alphabetic() && !matches!(c, 'e' | 'E');
    let Some(unit) = as_written.find(begins) else { return format!("{:?}", step.of(si)) };
    let unit = &as_written[unit..];
    let one = format!("1 {unit}");
    let dimension = Dimension::of(&one).unwrap_or(Dimension::Share);
    let one = dimension.parse(&one).unwrap_or(1.0);
    format!("\"{} {}\"", step.of(si / one), unit.trim())
}

impl Rewritten {
    /// The same without the comments behind numbers that are other than in the case before, where they name a number with a
    /// unit, or the one that was there: what they say of it need no longer hold.
    ///
    /// # Errors
    /// [`RewriteError`] where what is left is no case.
    pub fn with_fitting_comments(self, before: &Case) -> Result<Self, RewriteError> {
        let mut text = self.text;
        let own = |now: &Input| {
            let same = |one: &&Input| one.table == now.table && one.name == now.name;
            before.inputs.iter().find(same).map(|one| one.as_written.as_str())
        };
        let changed = self.case.inputs.iter().filter_map(|now| {
            own(now).filter(|written| *written != now.as_written).map(|own| (now.span.end, own))
        });
        let mut changed: Vec<(usize, &str)> = changed.collect();
        changed.sort_by_key(|(end, _)| std::cmp::Reverse(*end));
        for (end, written) in changed {
            let stale =
                |range: &std::ops::Range<usize>| !comment::fits(&text[range.clone()], written);
            if let Some(range) = comment::behind(&text, end).filter(stale) {
                text.replace_range(range, "");
            }
        }
        let case = Case::parse("the changed case", &text).map_err(Box::new)?;
        let case = Case { recording: self.case.recording, ..case };
        Ok(Self { text, case })
    }
}

impl Case {
    /// The text of this case, which `text` must be, with another design: values that differ are rounded to four
    /// significant digits (the clearance as asked) in the unit their author used, comments and order kept.
    ///
    /// # Errors
    /// [`RewriteError`] where `text` is not this case's, or the design makes no case.
    pub fn rewritten(
        &self,
        name: &str,
        text: &str,
        design: &Design,
        clearance: Rounding,
    ) -> Result<Rewritten, RewriteError> {
        let mut text = text.strip_prefix('\u{feff}').unwrap_or(text).to_owned();
        // Places are those of this very text, line ends included.
        if *text != *self.text {
            return Err(RewriteError::OtherText);
        }
        let step = if clearance == Rounding::Exact { Rounding::Exact } else { Rounding::Nearest };
        let changed = |input: &Input| {
            let parameter = input.parameter()?;
            let value = design.value(parameter)?;
            let rounding = if parameter == Parameter::Clearance { clearance } else { step };
            let difference = design.restitution_difference();
            let changed = self.design.value(parameter) != Some(value);
            changed.then(|| written(input, value, difference, rounding))
        };
        let mut inputs: Vec<&Input> = self.inputs.iter().collect();
        // From the end of the text, so that what is before stays in its place.
        inputs.sort_by_key(|input| std::cmp::Reverse(input.span.start));
        for input in inputs {
            if let Some(value) = changed(input) {
                text.replace_range(input.span.clone(), &value);
            }
        }
        let case = Self::parse(name, &text).map_err(Box::new)?;
        // What drives it has not changed, nor what its record holds.
        let case = Self { recording: self.recording.clone(), ..case };
        Ok(Rewritten { text, case })
    }
}
