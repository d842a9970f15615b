//! Exact periodic orbits of the full system, at any mass ratio: layer 3.
//!
//! Nothing is expanded in the mass ratio and nothing is integrated step by step. Between impacts the
//! motion is closed form ([`flight`]); from one impact to the next it is a map with an exact Jacobian
//! ([`ImpactMap`]). Its symmetric two-impact cycles solve one quadratic ([`symmetric_orbits`], [`equations`]), those of a
//! cavity of any kind are roots of one function ([`two_impact_orbits`]); all others
//! are found by Newton's method ([`newton`]) and followed by continuation ([`branch`]), with their
//! bifurcations. Where the symmetric ones begin and end is [`SymmetricFamily`]; with the asymmetric ones that
//! follow them, [`boundaries`]. Those of several modes with several absorbers are [`antiperiodic_orbits`], their branches
//! [`ModalBranch`], and where one attracts [`stable_stretches`]; any other sequence of impacts is a [`ModalCycle`]. Nothing here knows of the asymptotic theory, or of simulation.

mod admissibility;
pub mod boundaries;
pub mod branch;
mod continuation;
mod cycle;
pub mod equations;
pub mod flight;
mod full_system;
mod grazing;
mod impact_map;
mod limits;
mod locate;
pub(crate) mod measures;
mod mirror;
mod modal;
mod multipliers;
pub mod newton;
mod orbit;
mod special_point;
pub mod switching;
mod symmetric;
mod tracer;
mod two_impact;

#[doc(no_inline)]
pub use crate::bifurcation::Bifurcation;
pub use admissibility::{Admissibility, Narrowest};
pub use boundaries::{AsymmetricOrbits, ExactBoundaries};
pub use branch::{Branch, BranchEnd, BranchPoint};
pub use cycle::{Closure, Convergence, Cycle};
pub use full_system::{BestClearance, FullSystem};
pub use impact_map::{AfterImpact, ImpactMap, Leg, Step, Wall};
pub use limits::{Limit, StableStretch, SymmetricFamily};
pub use measures::{EnergyPerPeriod, Measures, Peaks};
pub use modal::{
    CycleImpact, ModalBranch, ModalBranchPoint, ModalCycle, ModalOrbit, ModalPeriodicOrbit,
    ModalSpecialPoint, ReachEnd, antiperiodic_orbits, orbit_state, stable_reach, stable_stretches,
    values_looked_at,
};
pub use multipliers::{Leading, Multipliers, spectral_radius};
pub use orbit::{Orbit, Origin};
pub use special_point::SpecialPoint;
pub use symmetric::{SymmetricCurve, SymmetricOrbit, attracting_orbit, symmetric_orbits};
pub use two_impact::{
    ONE_ORBIT, SteadyOrbit, TwoImpactOrbits, attracting_orbits, steady_orbit, steady_orbits,
    two_impact_orbits,
};

/// Largest amplitude of the steady motion between impacts over the size of an orbit: near resonance, with damping ratios below
/// 1e-6, its multipliers would be known to less than 1e-9.
const MOST_HIDDEN: f64 = 4e5;

/// Why an orbit is not returned.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OrbitError {
    /// The steady motion between impacts does not exist.
    #[error(
        "an undamped oscillator driven exactly at its natural frequency has no steady motion \
         between impacts; add damping or change the frequency"
    )]
    NoSteadyMotion,
    /// The orbit is the small difference of a steady motion between impacts and a free one.
    #[error(
        "the steady motion between impacts is {times:.0e} times as large as the orbit, which rounding hides; add damping or \
         change the frequency"
    )]
    Hidden {
        /// Amplitude of the steady motion over the size of the orbit.
        times: f64,
    },
    /// What was asked for is known of an ideal cavity only.
    #[error(
        "the symmetric orbits of a cavity and their limits are known in closed form where it is level, does not rub, and \
         its ends are alike"
    )]
    RealCavity,
    /// Newton's method did not converge.
    #[error(
        "Newton's method stopped after {iterations} steps with a residual of {residual:.1e}; \
         start closer to the orbit"
    )]
    NotConverged {
        /// Steps taken.
        iterations: u32,
        /// Largest closure defect over the size of the orbit.
        residual: f64,
    },
    /// The equations are singular at this orbit: at a grazing impact or a bifurcation.
    #[error("the orbit's equations are singular: it grazes a wall or lies on a bifurcation")]
    Singular,
    /// A cycle needs at least one impact, a positive duration each, and a period.
    #[error("the start is not a cycle: {reason}")]
    NotACycle {
        /// What is wrong with it.
        reason: &'static str,
    },
}
