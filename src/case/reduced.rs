//! The table `[reduced]`: a dimensionless design, lengths in a unit of its own.

use schemars::JsonSchema;
use serde::Deserialize;

use super::reader::Reader;
use super::schema::one_of;
use super::table::Table;
use crate::system::Excitation;

/// A dimensionless design, lengths in a unit of its own.
#[derive(Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields, extend("oneOf" = one_of("frequency_ratio", "detuning")))]
pub(super) struct ReducedTable {
    /// epsilon = m2 / m1, above 0.
    #[schemars(extend("exclusiveMinimum" = 0, "x-symbol" = r"\varepsilon"), example = 0.0076775)]
    mass_ratio: f64,
    /// lambda = c1 / (m2 omega0), 0 or more.
    #[schemars(extend("minimum" = 0, "x-symbol" = r"\lambda"), example = 1.799)]
    damping: f64,
    /// r, the coefficient of restitution, from 0 to 1.
    #[schemars(range(min = 0.0, max = 1.0), extend("x-symbol" = "r"), example = 0.6)]
    restitution: f64,
    /// b, the clearance, above 0.
    #[schemars(extend("exclusiveMinimum" = 0, "x-symbol" = "b"), example = 1.0)]
    clearance: f64,
    /// G = F / epsilon, the reduced forcing in the unit of the clearance, 0 or more.
    #[schemars(extend("minimum" = 0, "x-symbol" = "G"), example = 4.342)]
    forcing: f64,
    /// Omega = omega / omega0, above 0; or give detuning.
    #[schemars(extend("exclusiveMinimum" = 0, "x-symbol" = r"\Omega"), example = 0.95818)]
    frequency_ratio: Option<f64>,
    /// sigma, where Omega = 1 + epsilon sigma; or give frequency_ratio.
    #[schemars(extend("x-symbol" = r"\sigma"), example = -5.446)]
    detuning: Option<f64>,
    /// Where the excitation enters; base-displacement unless given.
    kind: Option<Excitation>,
}

/// A dimensionless design. [`Case::parse`](super::Case::parse) proves every value finite and in
/// its range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reduced {
    /// `eps = m2/m1`, above 0.
    pub mass_ratio: f64,
    /// `lambda = c1/(m2 omega0)`, at least 0.
    pub damping: f64,
    /// `r`, the coefficient of restitution, from 0 to 1.
    pub restitution: f64,
    /// `b`, above 0, in the case's own unit of length.
    pub clearance: f64,
    /// `G`, at least 0, in the case's own unit of length.
    pub forcing: f64,
    /// Where the excitation enters.
    pub excitation: Excitation,
    /// The excitation's frequency.
    pub tuning: Tuning,
}

/// The excitation's frequency, in the way its author gave it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tuning {
    /// `Omega = omega/omega0`, above 0.
    FrequencyRatio(f64),
    /// `sigma`, where `Omega = 1 + eps sigma` is above 0.
    Detuning(f64),
}

pub(super) const TABLE: &str = "reduced";

/// Reads the table; `None` when there is none or something was reported.
pub(super) fn read(reader: &mut Reader, root: &Table) -> Option<Reduced> {
    let (table, read) = reader.optional::<ReducedTable>(root, TABLE)?;
    let tuning = match (read.frequency_ratio, read.detuning) {
        (Some(ratio), _) => Tuning::FrequencyRatio(ratio),
        (None, detuning) => Tuning::Detuning(detuning?),
    };
    if let Tuning::Detuning(detuning) = tuning {
        let ratio = libm::fma(read.mass_ratio, detuning, 1.0);
        if !(ratio > 0.0 && ratio.is_finite()) {
            reader.report(
                table.span_of_value("detuning"),
                format!("`detuning` is {detuning}, so that 1 + mass_ratio * detuning is {ratio}"),
                "expected a detuning that leaves the frequency ratio finite and above 0",
                "the frequency ratio is 1 + mass_ratio * detuning; close to resonance detuning is near 0",
            );
            return None;
        }
    }
    Some(Reduced {
        mass_ratio: read.mass_ratio,
        damping: read.damping,
        restitution: read.restitution,
        clearance: read.clearance,
        forcing: read.forcing,
        excitation: read.kind.unwrap_or(Excitation::BaseDisplacement),
        tuning,
    })
}
