//! The optional table `[accuracy]`.

use schemars::JsonSchema;
use serde::Deserialize;

/// How exact the answers must be. Without this table every layer is computed and simulation decides;
/// with it the cheapest layer whose error is known to be small enough answers, and the report says
/// which. Each key may be left out.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct AccuracySettings {
    /// Largest relative error of the oscillator's amplitude (its root mean square), above 0; 1 %
    /// unless given.
    #[schemars(extend("x-measurand" = "a share", "exclusiveMinimum" = 0))]
    #[schemars(extend("x-symbol" = r"\Delta_\mathrm{amplitude}"))]
    pub amplitude: Option<f64>,
    /// Largest error of the impacts per excitation period, above 0; 0.01 unless given.
    #[schemars(extend("exclusiveMinimum" = 0, "x-symbol" = r"\Delta z"), example = 0.01)]
    pub impacts_per_period: Option<f64>,
    /// Whether other long-term motions are looked for, which only simulation from many starts does;
    /// false unless given.
    #[serde(default)]
    #[schemars(example = true)]
    pub coexistence: bool,
}
