//! The optional table `[accuracy]`: how exact the answers must be, and whether coexisting motions
//! matter. With it the cheapest layer that is known to be exact enough answers.

use super::quantity::{Quantity, Share};
use super::reader::{Bound, Field, Reader};
use super::table::Table;

/// What the case says about accuracy.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct AccuracySettings {
    /// Largest relative error of the oscillator's amplitude, above 0; 1 % unless given.
    pub amplitude: Option<f64>,
    /// Largest error of the impacts per excitation period, above 0; 0.01 unless given.
    pub impacts_per_period: Option<f64>,
    /// Whether it is asked which other long-term motions there are.
    pub coexistence: bool,
}

pub(super) const TABLE: &str = "accuracy";
pub(super) const KEYS: &[&str] = &["amplitude", "impacts_per_period", "coexistence"];

/// Reads the table; `None` where there is none, which asks for everything.
pub(super) fn read(reader: &mut Reader, root: &Table) -> Option<AccuracySettings> {
    let table = reader.table(root, TABLE)?;
    let mut settings = AccuracySettings::default();
    if table.entry("amplitude").is_some() {
        let field =
            Field::new("amplitude", r"\Delta_\mathrm{amplitude}", Bound::Positive, "\"1 %\"");
        settings.amplitude = table.quantity::<Share>(reader, field);
    }
    if table.entry("impacts_per_period").is_some() {
        let field = Field::new("impacts_per_period", r"\Delta z", Bound::Positive, "0.01");
        settings.impacts_per_period = table.number(reader, field);
    }
    settings.coexistence = table.flag(reader, "coexistence").unwrap_or(false);
    Some(settings)
}

/// How exact the answers must be. Without this table every layer is computed and simulation decides;
/// with it the cheapest layer whose error is known to be small enough answers, and the report says
/// which. Each key may be left out.
#[derive(schemars::JsonSchema)]
#[schemars(deny_unknown_fields)]
#[expect(dead_code, reason = "describes the table to editors; read() is what reads it")]
pub(super) struct AccuracyTable {
    /// Largest relative error of the oscillator's amplitude (its root mean square), above 0; 1 %
    /// unless given.
    amplitude: Option<Quantity<Share>>,
    /// Largest error of the impacts per excitation period, above 0; 0.01 unless given.
    #[schemars(extend("exclusiveMinimum" = 0), example = 0.01)]
    impacts_per_period: Option<f64>,
    /// Whether other long-term motions are looked for, which only simulation from many starts does;
    /// false unless given.
    #[schemars(example = true)]
    coexistence: Option<bool>,
}
