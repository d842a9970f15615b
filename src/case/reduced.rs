//! The table `[reduced]`: a dimensionless design, lengths in a unit of its own.

use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::{Value, json};

use super::excitation::{ExcitationKind, ExcitationTable, add_keys, keys_by_kind};
use super::reader::{Reader, Table};
use super::restitution::{Restitution, one_or_each};
use crate::excitation::Transient;
use crate::system::{Cavity, Excitation};

// Beside these it has the keys of an excitation.
/// A dimensionless design, lengths in a unit of its own.
#[derive(Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields, extend("oneOf" = keys_by_kind(true)), transform = add_keys)]
pub(super) struct ReducedTable {
    /// epsilon = m2 / m1, above 0.
    #[schemars(extend("exclusiveMinimum" = 0, "x-symbol" = r"\varepsilon"), example = 0.0076775)]
    mass_ratio: f64,
    /// lambda = c1 / (m2 omega0), 0 or more.
    #[schemars(extend("minimum" = 0, "x-symbol" = r"\lambda"), example = 1.799)]
    damping: f64,
    /// r, the coefficient of restitution, from 0 to 1; or a pair, at the walls x - y = +b and x - y = -b.
    #[schemars(with = "Value", extend("anyOf" = one_or_each()), example = 0.6, example = vec![0.65, 0.55])]
    restitution: Restitution,
    /// a, gravity's acceleration along the cavity over b omega0^2, positive along positive displacements of the
    /// absorber; 0 unless given.
    #[schemars(extend("x-symbol" = "a"), example = 0.004)]
    gravity_along: Option<f64>,
    /// f, sliding friction over m2 b omega0^2, 0 or more; 0 unless given.
    #[schemars(extend("minimum" = 0, "x-symbol" = "f"), example = 0.002)]
    friction_acceleration: Option<f64>,
    /// b, the clearance, above 0.
    #[schemars(extend("exclusiveMinimum" = 0, "x-symbol" = "b"), example = 1.0)]
    clearance: f64,
    /// G = F / epsilon, the reduced forcing in the unit of the clearance, 0 or more.
    #[schemars(extend("minimum" = 0, "x-symbol" = "G"), example = 4.342)]
    forcing: Option<f64>,
    /// Omega = omega / omega0, above 0; or give detuning.
    #[schemars(extend("exclusiveMinimum" = 0, "x-symbol" = r"\Omega"), example = 0.95818)]
    frequency_ratio: Option<f64>,
    /// sigma, where Omega = 1 + epsilon sigma; or give frequency_ratio.
    #[schemars(extend("x-symbol" = r"\sigma"), example = -5.446)]
    detuning: Option<f64>,
}

// `Case::parse` proves every value finite and in its range.
/// A dimensionless design, lengths in a unit of its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reduced {
    /// `epsilon = m2/m1`.
    pub mass_ratio: f64,
    /// `lambda = c1/(m2 omega0)`.
    pub damping: f64,
    /// `r`, the coefficient of restitution; the mean where the walls differ.
    pub restitution: f64,
    /// What the cavity has beyond two equal walls, at this clearance.
    pub cavity: Cavity,
    /// `b`, the clearance.
    pub clearance: f64,
    /// `G = F/epsilon`, the reduced forcing in the unit of the clearance; 0 where nothing drives steadily.
    pub forcing: f64,
    /// `Omega = omega/omega0`, or that at which a sweep begins; none where there is a detuning or no excitation.
    pub frequency_ratio: Option<f64>,
    /// `sigma`, where `Omega = 1 + epsilon sigma`.
    pub detuning: Option<f64>,
    /// Where the excitation enters.
    pub excitation: Excitation,
    /// What is not steady harmonic excitation.
    pub transient: Option<Transient>,
}

impl Reduced {
    /// `Omega = omega/omega0`, however its author gave it; 1 where nothing drives the oscillator.
    pub fn frequency_ratio(&self) -> f64 {
        let detuned = libm::fma(self.mass_ratio, self.detuning.unwrap_or_default(), 1.0);
        self.frequency_ratio.unwrap_or(detuned)
    }

    /// `sigma`, however its author gave it.
    pub fn detuning(&self) -> f64 {
        let of_ratio = || (self.frequency_ratio() - 1.0) / self.mass_ratio;
        self.detuning.unwrap_or_else(of_ratio)
    }
}

pub(super) const TABLE: &str = "reduced";

/// Reads the table; `None` when there is none or something was reported.
pub(super) fn read(reader: &mut Reader, root: &Table) -> Option<Reduced> {
    let table = reader.table::<ReducedTable>(root, TABLE)?;
    let mut values = reader.values(&table);
    values.entry("kind").or_insert_with(|| json!(ExcitationKind::default()));
    let values = Value::Object(values);
    let excitation = ExcitationTable::deserialize(&values).ok()?;
    let read = ReducedTable::deserialize(&values).ok()?;
    // Frequency ratios over the fast time are angles.
    let transient = excitation.transient(reader, &table, TAU)?;
    let read = Reduced {
        mass_ratio: read.mass_ratio,
        damping: read.damping,
        restitution: read.restitution.mean(),
        cavity: Cavity {
            gravity_along: read.gravity_along.unwrap_or_default(),
            friction_acceleration: read.friction_acceleration.unwrap_or_default(),
            restitution_difference: read.restitution.difference(),
        },
        clearance: read.clearance,
        forcing: match transient {
            None | Some(Transient::Sweep(_)) => read.forcing?,
            _ => 0.0,
        },
        frequency_ratio: excitation.from.or(read.frequency_ratio),
        detuning: read.detuning,
        excitation: excitation.enters(),
        transient,
    };
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
