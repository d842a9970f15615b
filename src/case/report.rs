//! The optional table `[report]`.

use schemars::JsonSchema;
use serde::Deserialize;

use super::names::names;

/// What the report holds beside the usual. The table may be left out.
#[derive(Debug, Clone, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[serde(default)]
pub struct ReportSettings {
    /// Further figures, each once; the usual ones are in every report.
    #[schemars(extend("uniqueItems" = true), example = ["areas", "transfer"])]
    pub figures: Vec<ExtraFigure>,
}

names! { name:
    /// A further figure, which a report holds only where its case asks for it; the usual figures are in
    /// every report without being named. These take a family of parameters, or a long look at one motion;
    /// figures in brackets are those of Li, Seguy, Berlioz 2016 that it repeats.
    pub enum ExtraFigure {
        /// The areas along the manifold, and how the fixed points move as the clearance grows (Fig. 5).
        Areas = "areas",
        /// What the saddle-node and the Hopf boundary are, and where they lie (Figs. 6a and 6b).
        Bifurcations = "bifurcations",
        /// Frequency responses for four forcings per clearance across the areas (Fig. 7).
        ForcingResponses = "forcing-responses",
        /// A long stretch of the motion on the manifold, enlarged in two places (Fig. 8).
        Modulation = "modulation",
        /// The manifold, and what it takes from the oscillator, for five restitutions (Fig. 9).
        Restitutions = "restitutions",
        /// What simulation finds at many clearances, on the manifold and by its peak (Figs. 11g and 4).
        Clearances = "clearances",
        /// The amplitudes C and E of (17) in every period, in captures and between them (section 4.2).
        Captures = "captures",
        /// Which starts lead to which long-term motion, on a plane of the oscillator's starting states.
        Basins = "basins",
        /// How the largest Lyapunov exponent of each motion converges.
        Exponents = "exponents",
        /// Displacement, acceleration and every impact's strength over some seconds (Fig. 12).
        Transfer = "transfer",
        /// Three short stretches of the same: decrease, weak impacts, few impacts (Figs. 12d to 12f).
        TransferStretches = "transfer-stretches",
        /// The clearance swept up and down by simulation, with the exact orbits over it.
        DiagramClearance = "diagram-clearance",
        /// The same for the excitation frequency.
        DiagramFrequency = "diagram-frequency",
        /// The same for the excitation amplitude.
        DiagramForcing = "diagram-forcing",
    }
}
