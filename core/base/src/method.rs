//! The ways to know a number, from the cheapest to the dearest.

use serde::Serialize;

/// What gave a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Method {
    /// The case file.
    Given,
    /// An exact formula: linear response, tuned mass damper, inactive absorber.
    ClosedForm,
    /// The slow flow on the slow invariant manifold, at leading order in the mass ratio.
    Theory,
    /// The slow flow with averages over the absorber's motion, in every regime.
    AveragedFlow,
    /// An exact periodic orbit of the full system.
    ExactOrbit,
    /// Event-driven simulation of the full system.
    Simulation,
    /// The reference in 77 decimal digits.
    Reference,
}

impl Method {
    /// The name in a report.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Given => "given",
            Self::ClosedForm => "closed form",
            Self::Theory => "theory",
            Self::AveragedFlow => "averaged flow",
            Self::ExactOrbit => "exact orbit",
            Self::Simulation => "simulation",
            Self::Reference => "reference",
        }
    }
}
