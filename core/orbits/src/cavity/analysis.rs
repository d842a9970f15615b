//! Everything that the theory of a cavity says of one system.

use serde::Serialize;

use super::{CavityFixedPoint, CavityTheory, Forcing, ManifoldPoint};
use crate::system::System;

/// The theory of a cavity that is tilted, rubs or has unequal ends, at a system's excitation. Lengths over the clearance.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CavityAnalysis {
    /// The cavity.
    pub theory: CavityTheory,
    /// All fixed points of the slow flow, by ascending absorber amplitude.
    pub fixed_points: Vec<CavityFixedPoint>,
    /// The fold of the manifold; none where the cavity is not symmetric.
    pub fold: Option<ManifoldPoint>,
    /// Where symmetric motions end; none where the cavity is not symmetric.
    pub symmetry_breaking: Option<ManifoldPoint>,
}

impl CavityAnalysis {
    /// Analyses a system; none of an ideal cavity, whose theory is [`crate::analysis`].
    pub fn of(system: &System) -> Option<Self> {
        if system.cavity().is_ideal() {
            return None;
        }
        let theory = CavityTheory::of(system);
        Some(Self {
            theory,
            fixed_points: theory.fixed_points(&Forcing::of(system)),
            fold: theory.fold(),
            symmetry_breaking: theory.symmetry_breaking(),
        })
    }

    /// The stable motion with the largest amplitude of the absorber.
    pub fn stable_point(&self) -> Option<&CavityFixedPoint> {
        self.fixed_points.iter().rfind(|point| point.stable)
    }
}
