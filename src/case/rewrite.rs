//! A case file with other values of the absorber, everything else as its author wrote it.

use toml_edit::{DocumentMut, TableLike, Value};

use super::quantity::{Dimension, Length, Mass, Quantity, Share};
use super::{AbsorberDesign, Case, CaseError, Design};

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

/// How a rounded value is rounded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Step {
    Down,
    Nearest,
    Up,
    Exact,
}

/// Significant digits of a written value.
const DIGITS: i32 = 4;

/// A value above 0 with [`DIGITS`] significant digits, rounded or moved on by one in the last of them.
fn rounded(value: f64, step: Step) -> f64 {
    if value == 0.0 || step == Step::Exact {
        return value;
    }
    let place = libm::floor(libm::log10(value)) as i32 - (DIGITS - 1);
    let units = value / libm::pow(10.0, f64::from(place));
    let units = match step {
        Step::Down => libm::floor(units),
        Step::Nearest => libm::rint(units),
        Step::Up | Step::Exact => libm::ceil(units),
    };
    // Read back from decimal digits, so that it is the double that a person would write.
    format!("{units}e{place}").parse().unwrap_or(value)
}

/// A number in the unit in which `as_written` gives its own.
fn written<D: Dimension>(si: f64, as_written: &str, step: Step) -> String {
    let begins = |c: char| c == '%' || c.is_alphabetic() && !matches!(c, 'e' | 'E');
    let number = as_written.trim().find(begins);
    let unit = number.map_or(D::OF.si, |at| as_written.trim()[at..].trim());
    let one = Quantity::<D>::parse(&format!("1 {unit}")).map_or(1.0, Quantity::si);
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
        let step = if clearance == Rounding::EXACT { Step::Exact } else { Step::Nearest };
        let table = match self.design {
            Design::Physical(_) => "absorber",
            Design::Reduced(_) => "reduced",
        };
        let unit_of = |key: &str| {
            let input = self.inputs().iter().find(|one| one.table == table && one.name == key);
            input.map_or("", |input| input.as_written.as_str())
        };
        if choice.clearance != own.clearance {
            let value = match self.design {
                Design::Physical(_) => {
                    written::<Length>(choice.clearance, unit_of("clearance"), clearance.0).into()
                }
                Design::Reduced(_) => rounded(choice.clearance, clearance.0).into(),
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
            if unit_of("mass_ratio").is_empty() {
                let value = written::<Mass>(mass, unit_of("mass"), step);
                set(&mut document, table, "mass", value.into())?;
            } else {
                let (ratio, as_written) = (mass / physical.mass_kg, unit_of("mass_ratio"));
                let value = if as_written.ends_with('%') {
                    written::<Share>(ratio, as_written, step).into()
                } else {
                    rounded(ratio, step).into()
                };
                set(&mut document, table, "mass_ratio", value)?;
            }
        }
        let text = document.to_string();
        let case = Case::parse(name, &text).map_err(Box::new)?;
        Ok(Rewritten { text, case })
    }
}

/// How the clearance is rounded when it is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rounding(Step);

impl Rounding {
    /// Not at all.
    pub const EXACT: Self = Self(Step::Exact);
    /// To the nearest number of four digits, to the one below, to the one above, and not at all.
    pub const ALL: [Self; 4] = [Self(Step::Nearest), Self(Step::Down), Self(Step::Up), Self::EXACT];
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
