//! What the asymptotic theory says of a system, in closed form: layers 1 and 2.
//!
//! Source: Li, Seguy, Berlioz (2016), equations (14) to (18), and what is derived from them in
//! [`crate::equations`]. Valid at leading order in the mass ratio `eps`, near 1:1 resonance
//! (`abs(eps sigma)` small), for motions with two symmetric impacts per period. Lengths are over
//! the clearance. Nothing here simulates.

mod areas;
pub mod boundaries;
mod curve;
mod decay;
mod fixed_points;
pub mod frequency_response;
mod manifold;
pub mod motion;
mod several;
pub mod slow_motion;

use serde::Serialize;

use crate::cavity::CavityAnalysis;
use crate::system::System;

pub use crate::cavity::{AsymmetricLimits, ManifoldPoint};

pub use areas::{Area, Strip, Zone};
pub use boundaries::{Boundaries, CodimensionTwo, SaddleNode};
pub use curve::{Amplitude, FixedPointCurve};
pub use decay::{EnergyShares, FreeDecay};
pub use fixed_points::{FixedPoint, FixedPointKind, solve as fixed_points};
pub use manifold::{Manifold, ManifoldBranch};
pub use several::{
    AbsorberGroup, Grading, GroupFixedPoint, GroupForces, GroupMember, UnforcedMode,
    apparent_restitution, effective_restitutions, neglected_at_leading_order, scattered,
};

/// The quadratic of the fixed points has a coefficient that is not finite.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error(
    "the theory's condition for fixed points cannot be solved: a coefficient is not finite; \
     detuning, damping or forcing is too extreme for the asymptotic theory"
)]
pub struct AnalysisError;

/// Everything that the theory says of one system.
///
/// With Table 1 of Li, Seguy, Berlioz (2016) at 8 Hz, whose base moves by 0.25 mm, the clearances at the boundaries
/// are published:
///
/// ```
/// # use vinesink_core::system::{Cavity, Excitation, Parameters, System};
/// # let system = System::new(Parameters {
/// #     mass_ratio: 0.032 / 4.168, damping: 1.799, restitution: 0.6, frequency_ratio: 8.0 / 8.349,
/// #     forcing_per_clearance: 4.3417, excitation: Excitation::BaseDisplacement,
/// #     cavity: Cavity::IDEAL,
/// # })?;
/// use vinesink_core::analysis::{Analysis, Area};
///
/// let analysis = Analysis::of(&system)?;
/// // The base's 0.25 mm over the mass ratio is the reduced forcing G; a boundary is at G / b.
/// let clearance_mm = |gamma: f64| 0.25 * 4.168 / 0.032 / gamma;
/// let boundaries = &analysis.boundaries;
/// assert!((clearance_mm(boundaries.symmetry_breaking) - 4.687).abs() < 0.01);
/// assert!((clearance_mm(boundaries.hopf) - 15.346).abs() < 0.01);
/// let collision = boundaries.saddle_node.expect("two fixed points").forcing_over_clearance;
/// assert!((clearance_mm(collision) - 16.259).abs() < 0.01);
///
/// // At 7.5 mm there is a stable fixed point, the steady 1:1 motion.
/// assert_eq!(analysis.zone.area, Area::Z3);
/// let point = analysis.stable_points().next().expect("one");
/// assert!((point.oscillator_amplitude - 0.470).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct Analysis {
    /// The system.
    pub system: System,
    /// The slow invariant manifold.
    pub manifold: Manifold,
    /// All fixed points of the slow flow, by ascending `B`.
    pub fixed_points: Vec<FixedPoint>,
    /// Where regimes end.
    pub boundaries: Boundaries,
    /// Where the system lies between them.
    pub zone: Zone,
    /// The theory of its cavity, where that is not ideal: all above is of an ideal one.
    #[serde(skip)]
    pub cavity: Option<CavityAnalysis>,
}

impl Analysis {
    /// Analyses a system.
    ///
    /// # Errors
    /// [`AnalysisError`] where the fixed-point condition overflows.
    pub fn of(system: &System) -> Result<Self, AnalysisError> {
        let manifold = Manifold::of(system.restitution());
        let fixed_points = fixed_points::solve(system, &manifold)?;
        let boundaries = Boundaries::of(system, &manifold);
        let curve = FixedPointCurve::of(system, &manifold);
        let zone = curve.zone(system.forcing_per_clearance());
        let cavity = CavityAnalysis::of(system);
        Ok(Self { system: *system, manifold, fixed_points, boundaries, zone, cavity })
    }

    /// The fixed points that are stable motions.
    pub fn stable_points(&self) -> impl Iterator<Item = &FixedPoint> {
        self.fixed_points.iter().filter(|point| point.stable)
    }
}
