//! The optional table `[simulation]`.

use schemars::JsonSchema;
use serde::Deserialize;

/// How the case is simulated. Each key may be left out.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct SimulationSettings {
    /// Excitation periods that are measured.
    #[schemars(range(min = 1, max = 100_000_000), extend("x-symbol" = "N"), example = 2000)]
    pub periods: Option<u64>,
    /// Excitation periods simulated first, so that transients die out, and not measured.
    #[schemars(
        range(min = 0, max = 100_000_000), extend("x-symbol" = r"N_\mathrm{discard}"), example = 500
    )]
    pub discard: Option<u64>,
    /// Number of initial conditions tried: one start can miss a coexisting motion.
    #[schemars(range(min = 1, max = 10_000), extend("x-symbol" = r"N_\mathrm{starts}"), example = 64)]
    pub starts: Option<u64>,
}
