//! Bifurcations, of orbits of the full system and of fixed points of the slow flow alike.

use serde::Serialize;

/// What happens to a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Bifurcation {
    /// Two orbits collide and vanish: a multiplier passes +1 where the branch turns back.
    SaddleNode,
    /// A symmetric orbit gives way to two asymmetric ones, mirror images of one another: the
    /// multiplier of the half-period map passes -1.
    SymmetryBreaking,
    /// An orbit of twice the period branches off: a multiplier passes -1.
    PeriodDoubling,
    /// A complex pair of multipliers passes the unit circle, and a modulated motion branches off:
    /// what the slow flow calls Hopf.
    NeimarkSacker,
    /// Between two impacts the absorber touches a wall: an impact appears.
    Grazing,
    /// After an impact without rebound the wall no longer leaves the absorber behind: it stays on
    /// the wall.
    Sticking,
    /// An impact loses its speed: it disappears.
    VanishingImpact,
    /// Where the absorber rubs, it comes to rest against the oscillator between two impacts: from there on
    /// friction has the other sign for a while.
    Reversal,
    /// Another branch passes through, without this one turning back.
    BranchPoint,
}

impl Bifurcation {
    /// The field's name for it.
    pub fn words(self) -> &'static str {
        match self {
            Self::SaddleNode => "saddle-node",
            Self::SymmetryBreaking => "symmetry breaking",
            Self::PeriodDoubling => "period doubling",
            Self::NeimarkSacker => "Neimark–Sacker",
            Self::Grazing => "grazing",
            Self::Sticking => "sticking",
            Self::VanishingImpact => "vanishing impact",
            Self::Reversal => "slip reversal",
            Self::BranchPoint => "branch point",
        }
    }

    /// The name of the same in the slow flow, whose fixed points the orbits are.
    pub fn words_in_slow_flow(self) -> &'static str {
        if self == Self::NeimarkSacker { "Hopf" } else { self.words() }
    }

    /// Whether the orbit stops being a motion there, whatever its multipliers.
    #[doc(hidden)]
    pub fn ends_motion(self) -> bool {
        matches!(self, Self::Grazing | Self::Sticking | Self::VanishingImpact | Self::Reversal)
    }
}
