//! The table `[reduced]`: a dimensionless design, lengths in a unit of its own.

use schemars::JsonSchema;
use serde::Deserialize;

use super::reader::{Reader, Table};
use super::schema::one_of;
use crate::system::Excitation;

// `Case::parse` proves every value finite and in its range, and one of the two frequencies given.
/// A dimensionless design, lengths in a unit of its own.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields, extend("oneOf" = one_of("frequency_ratio", "detuning")))]
pub struct Reduced {
    /// epsilon = m2 / m1, above 0.
    #[schemars(extend("exclusiveMinimum" = 0, "x-symbol" = r"\varepsilon"), example = 0.0076775)]
    pub mass_ratio: f64,
    /// lambda = c1 / (m2 omega0), 0 or more.
    #[schemars(extend("minimum" = 0, "x-symbol" = r"\lambda"), example = 1.799)]
    pub damping: f64,
    /// r, the coefficient of restitution, from 0 to 1.
    #[schemars(range(min = 0.0, max = 1.0), extend("x-symbol" = "r"), example = 0.6)]
    pub restitution: f64,
    /// b, the clearance, above 0.
    #[schemars(extend("exclusiveMinimum" = 0, "x-symbol" = "b"), example = 1.0)]
    pub clearance: f64,
    /// G = F / epsilon, the reduced forcing in the unit of the clearance, 0 or more.
    #[schemars(extend("minimum" = 0, "x-symbol" = "G"), example = 4.342)]
    pub forcing: f64,
    /// Omega = omega / omega0, above 0; or give detuning.
    #[schemars(extend("exclusiveMinimum" = 0, "x-symbol" = r"\Omega"), example = 0.95818)]
    pub frequency_ratio: Option<f64>,
    /// sigma, where Omega = 1 + epsilon sigma; or give frequency_ratio.
    #[schemars(extend("x-symbol" = r"\sigma"), example = -5.446)]
    pub detuning: Option<f64>,
    /// Where the excitation enters; base-displacement unless given.
    #[serde(rename = "kind", default)]
    pub excitation: Excitation,
}

impl Reduced {
    /// `Omega = omega/omega0`, however its author gave it.
    pub fn frequency_ratio(&self) -> f64 {
        let detuned = libm::fma(self.mass_ratio, self.detuning.unwrap_or_default(), 1.0);
        self.frequency_ratio.unwrap_or(detuned)
    }
}

pub(super) const TABLE: &str = "reduced";

/// Reads the table; `None` when there is none or something was reported.
pub(super) fn read(reader: &mut Reader, root: &Table) -> Option<Reduced> {
    let (table, read) = reader.optional::<Reduced>(root, TABLE)?;
    let ratio = read.frequency_ratio();
    if ratio > 0.0 && ratio.is_finite() {
        return Some(read);
    }
    let detuning = read.detuning.unwrap_or_default();
    reader.report(
        table.span_of_value("detuning"),
        format!("`detuning` is {detuning}, so that 1 + mass_ratio * detuning is {ratio}"),
        "expected a detuning that leaves the frequency ratio finite and above 0",
        "the frequency ratio is 1 + mass_ratio * detuning; close to resonance detuning is near 0",
    );
    None
}
