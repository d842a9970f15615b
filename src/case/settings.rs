//! Optional tables that are read as they stand: `[simulation]`, `[report]`, `[accuracy]`.

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::{Value, json};

use vinesink_core::names;

use super::criteria::Criterion;
use crate::quantity::Units;

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

/// What the report holds beside the usual. The table may be left out.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[serde(default)]
pub struct ReportSettings {
    /// Further figures, each once; the usual ones are in every report.
    #[schemars(extend("uniqueItems" = true), example = vec!["areas", "transfer"])]
    pub figures: Vec<ExtraFigure>,
    /// Whether the report says what would spoil the design first: its largest motion in rigs that differ by a tilt,
    /// friction, other restitutions and another natural frequency; true unless given.
    #[schemars(example = false)]
    pub deviations: bool,
    /// Units of the case's pages, figures and text for a terminal: SI unless given. Files for programs, the index and
    /// `diff` are in SI; not beside `[reduced]`.
    pub units: PageUnits,
}

names! { name:
    /// Units of pages.
    #[derive(Default, schemars::JsonSchema)]
    pub enum PageUnits {
        /// Metre, kilogram and newton with their prefixes.
        #[default]
        Si = "si",
        /// Inch, pound, ounce and pound of force; accelerations in g.
        Us = "us",
    }
}

impl PageUnits {
    /// Those of the pages of a case with such units and criteria.
    pub(crate) fn of_pages(self, own: Units, criteria: &[Criterion]) -> Units {
        match self {
            Self::Us => own.in_us(),
            Self::Si if criteria.iter().any(Criterion::is_in_g) => own.in_g(),
            Self::Si => own,
        }
    }
}

impl Default for ReportSettings {
    fn default() -> Self {
        Self { figures: Vec::new(), deviations: true, units: PageUnits::Si }
    }
}

/// What the absorber is held against. Each key may be left out.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[serde(default)]
pub struct AlternativesSettings {
    /// Shares by which the structure's natural frequency is off, either way, that no device was told; 5, 10 and 20 %
    /// unless given.
    #[schemars(extend("items" = share_off(), "minItems" = 1, "maxItems" = 4, "x-ascending" = true), example = vec!["5 %", "10 %"])]
    pub drift: Vec<f64>,
    /// Damping ratio of a tuned mass damper without a damping medium, a metal spring; 0.2 % unless given.
    #[schemars(extend("x-measurand" = "a share", "exclusiveMinimum" = 0, "maximum" = 1, "x-symbol" = r"\zeta_\mathrm{d}"), example = "0.2 %")]
    pub damper_damping: f64,
    /// Factor by which the damper's own frequency is another than designed: that of an elastomer that is cold.
    #[schemars(extend("exclusiveMinimum" = 0, "x-symbol" = r"\varphi_\mathrm{d}"), example = 1.41)]
    pub damper_frequency_factor: Option<f64>,
}

impl Default for AlternativesSettings {
    fn default() -> Self {
        let drift = vec![0.05, 0.1, 0.2];
        Self { drift, damper_damping: 0.002, damper_frequency_factor: None }
    }
}

/// A share that a frequency may be off by.
fn share_off() -> Value {
    json!({
        "type": "number", "x-measurand": "a share", "exclusiveMinimum": 0, "maximum": 0.5,
        "examples": ["5 %"], "x-symbol": r"\Delta f_0/f_0",
    })
}

names! { name:
    /// A further figure, which a report holds only where its case asks for it; the usual figures are in
    /// every report without being named. These take a family of parameters, or a long look at one motion;
    /// figures in brackets are those of Li, Seguy, Berlioz 2016 that it repeats.
    #[derive(schemars::JsonSchema)]
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
        /// What the absorber takes at any amplitude of the oscillator, in every regime, and the frequency response
        /// that follows; with it the report holds the steady amplitudes of the averaged flow against simulation.
        Dissipation = "dissipation",
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

impl AccuracySettings {
    /// A per cent of the amplitude unless given, which is what clearances and restitution are known to.
    pub fn amplitude(&self) -> f64 {
        self.amplitude.unwrap_or(0.01)
    }

    /// Unless given as exactly as regimes are told apart.
    pub fn impacts_per_period(&self) -> f64 {
        self.impacts_per_period.unwrap_or(0.01)
    }
}
