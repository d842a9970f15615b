//! The table `[reduced]`: a dimensionless design, lengths in a unit of its own.

use super::physical::{RESTITUTION, read_kind};
use super::reader::{Bound, Field, Reader};
use super::table::Table;
use crate::system::Excitation;

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
pub(super) const KEYS: &[&str] = &[
    "mass_ratio",
    "damping",
    "restitution",
    "clearance",
    "forcing",
    "frequency_ratio",
    "detuning",
    "kind",
];

const MASS_RATIO: Field = Field::new("mass_ratio", r"\varepsilon", Bound::Positive, "0.0077");
const DAMPING: Field = Field::new("damping", r"\lambda", Bound::NotNegative, "1.799");
const CLEARANCE: Field = Field::new("clearance", "b", Bound::Positive, "1.0");
const FORCING: Field = Field::new("forcing", "G", Bound::NotNegative, "4.342");
const RATIO: Field = Field::new("frequency_ratio", r"\Omega", Bound::Positive, "0.958");
const DETUNING: Field = Field::new("detuning", r"\sigma", Bound::Any, "-5.446");

/// Reads the table; `None` when there is none or something was reported.
pub(super) fn read(reader: &mut Reader, root: &Table) -> Option<Reduced> {
    let table = reader.table(root, TABLE)?;
    let mass_ratio = table.number(reader, MASS_RATIO);
    let damping = table.number(reader, DAMPING);
    let restitution = table.number(reader, RESTITUTION);
    let clearance = table.number(reader, CLEARANCE);
    let forcing = table.number(reader, FORCING);
    let tuning = read_tuning(reader, &table, mass_ratio);
    let excitation = match table.has("kind") {
        true => read_kind(reader, &table),
        false => Some(Excitation::BaseDisplacement),
    };
    Some(Reduced {
        mass_ratio: mass_ratio?,
        damping: damping?,
        restitution: restitution?,
        clearance: clearance?,
        forcing: forcing?,
        excitation: excitation?,
        tuning: tuning?,
    })
}

fn read_tuning(reader: &mut Reader, table: &Table, mass_ratio: Option<f64>) -> Option<Tuning> {
    if table.either(reader, RATIO, DETUNING)? == RATIO.key {
        return table.number(reader, RATIO).map(Tuning::FrequencyRatio);
    }
    let detuning = table.number(reader, DETUNING)?;
    let ratio = libm::fma(mass_ratio?, detuning, 1.0);
    if ratio > 0.0 && ratio.is_finite() {
        return Some(Tuning::Detuning(detuning));
    }
    reader.report(
        table.span_of_value(DETUNING.key),
        format!("`detuning` is {detuning}, so that 1 + mass_ratio * detuning is {ratio}"),
        "expected a detuning that leaves the frequency ratio finite and above 0",
        "the frequency ratio is 1 + mass_ratio * detuning; close to resonance detuning is near 0",
    );
    None
}
