//! A case file with other values of the absorber, everything else as its author wrote it.

use toml_edit::{DocumentMut, TableLike, Value};

use super::{AbsorberDesign, Case, CaseError, Design};
use crate::quantity::Dimension;

/// Why a case file cannot be rewritten.
#[derive(Debug, thiserror::Error)]
pub enum RewriteError {
    /// The text is not that of a case.
    #[error("the case file cannot be changed: {0}")]
    NotACase(#[from] toml_edit::TomlError),
    /// A key whose value should change is not there.
    #[error("the case file has no `{key}` in [{table}] to change")]
    Missing {
        /// The table.
        table: &'static str,
        /// The key.
        key: &'static str,
    },
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
}

/// Significant digits of a written value.
const DIGITS: i32 = 4;

/// A value above 0 with [`DIGITS`] significant digits, rounded or moved on by one in the last of them.
fn rounded(value: f64, step: Rounding) -> f64 {
    if value == 0.0 || step == Rounding::Exact {
        return value;
    }
    let place = libm::floor(libm::log10(value)) as i32 - (DIGITS - 1);
    let units = value / libm::pow(10.0, f64::from(place));
    let units = match step {
        Rounding::Down => libm::floor(units),
        Rounding::Nearest => libm::rint(units),
        Rounding::Up | Rounding::Exact => libm::ceil(units),
    };
    // Read back from decimal digits, so that it is the double that a person would write.
    format!("{units}e{place}").parse().unwrap_or(value)
}

/// A number in the unit in which `as_written` gives its own.
fn written(of: Dimension, si: f64, as_written: &str, step: Rounding) -> String {
    let begins = |c: char| c == '%' || c.is_alphabetic() && !matches!(c, 'e' | 'E');
    let number = as_written.trim().find(begins);
    let unit = number.map_or(of.symbol(true), |at| as_written.trim()[at..].trim());
    let one = of.parse(&format!("1 {unit}")).unwrap_or(1.0);
    format!("{} {unit}", rounded(si / one, step))
}

impl Case {
    /// The text of this case, which `text` must be, with another absorber: values rounded to four
    /// significant digits (the clearance as asked) in the unit their author used, comments and order kept.
    ///
    /// # Errors
    /// [`RewriteError`] where `text` is not this case's, or the choice makes no case.
    pub fn rewritten(
        &self,
        name: &str,
        text: &str,
        choice: &AbsorberDesign,
        clearance: Rounding,
    ) -> Result<Rewritten, RewriteError> {
        let mut document: DocumentMut =
            text.strip_prefix('\u{feff}').unwrap_or(text).parse::<DocumentMut>()?;
        let own = AbsorberDesign::of(&self.design);
        let step = if clearance == Rounding::Exact { Rounding::Exact } else { Rounding::Nearest };
        let physical = matches!(self.design, Design::Physical(_));
        let table = if physical { "absorber" } else { "reduced" };
        let as_written = |key: &str| {
            let input = self.inputs().iter().find(|one| one.table == table && one.name == key);
            input.map_or("", |input| input.as_written.as_str())
        };
        if choice.clearance != own.clearance {
            let value = match physical {
                true => {
                    written(Dimension::Length, choice.clearance, as_written("clearance"), clearance)
                        .into()
                }
                false => rounded(choice.clearance, clearance).into(),
            };
            set(&mut document, table, "clearance", value)?;
        }
        if choice.restitution != own.restitution {
            let value = rounded(choice.restitution, step).min(1.0);
            set(&mut document, table, "restitution", value.into())?;
        }
        if let (Some(mass), Design::Physical(physical)) = (choice.mass, &self.design)
            && mass != physical.absorber_mass_kg
        {
            let ratio = mass / physical.mass_kg;
            let (key, value) = match as_written("mass_ratio") {
                "" => ("mass", written(Dimension::Mass, mass, as_written("mass"), step).into()),
                share if share.ends_with('%') => {
                    ("mass_ratio", written(Dimension::Share, ratio, share, step).into())
                }
                _ => ("mass_ratio", rounded(ratio, step).into()),
            };
            set(&mut document, table, key, value)?;
        }
        let text = document.to_string();
        let case = Case::parse(name, &text).map_err(Box::new)?;
        Ok(Rewritten { text, case })
    }
}

/// Replaces a value and keeps what stands around it.
fn set(
    document: &mut DocumentMut,
    table: &'static str,
    key: &'static str,
    value: Value,
) -> Result<(), RewriteError> {
    let tables = document.as_table_mut();
    let place = tables.get_mut(table).and_then(|item| item.as_table_like_mut());
    let place = place.and_then(|table: &mut dyn TableLike| table.get_mut(key));
    let old = place.and_then(|item| item.as_value_mut());
    let old = old.ok_or(RewriteError::Missing { table, key })?;
    let decor = old.decor().clone();
    *old = value;
    *old.decor_mut() = decor;
    Ok(())
}
