//! The paper's equations, stated once, and everything that the program derives from them.
//!
//! [`Stated`] holds the equations as given; [`Manifold`], [`FixedPoints`], [`Boundaries`] and
//! [`SlowFlow`] hold what follows from them, as expressions. [`Programs`] evaluates exactly these
//! expressions, and [`Equations::for_report`] lists them for a reader. All of the asymptotic
//! results hold at first order in the mass ratio, near 1:1 resonance, for two symmetric impacts
//! per cycle; [`SymmetricOrbits`] holds such motions exactly, at any mass ratio and frequency.

mod boundaries;
mod fixed_points;
mod manifold;
mod orbit_programs;
mod orbit_report;
mod orbits;
mod programs;
mod report;
mod slow_flow;
mod stated;

pub use boundaries::Boundaries;
pub use fixed_points::FixedPoints;
pub use manifold::Manifold;
pub use orbit_programs::{OrbitPrograms, Turning};
pub use orbits::{OrbitConditions, SteadyMotion, SymmetricOrbits};
pub use programs::{ManifoldPoint, Programs, Quadratic};
pub use report::{Motion, ReportEquation};
pub use slow_flow::SlowFlow;
pub use stated::Stated;

use crate::symbolic::AlgebraError;
use std::sync::LazyLock;

/// All equations, stated and derived, with the programs that evaluate them.
#[derive(Debug, Clone)]
pub struct Equations {
    /// As given.
    pub stated: Stated,
    /// The slow invariant manifold.
    pub manifold: Manifold,
    /// Fixed points of the slow flow.
    pub fixed_points: FixedPoints,
    /// Boundaries of regimes.
    pub boundaries: Boundaries,
    /// The slow flow on the manifold.
    pub slow_flow: SlowFlow,
    /// Exact symmetric orbits.
    pub orbits: SymmetricOrbits,
    /// Evaluation of the above.
    pub programs: Programs,
}

impl Equations {
    /// Derives everything. [`equations`] does it once for the whole program.
    ///
    /// # Errors
    /// Never for the stated equations, which are constants of the program; a test runs it.
    pub fn derive() -> Result<Self, AlgebraError> {
        let stated = Stated::new();
        let manifold = Manifold::derive(&stated)?;
        let fixed_points = FixedPoints::derive(&stated, &manifold)?;
        let boundaries = Boundaries::derive(&stated, &manifold, &fixed_points)?;
        let slow_flow = SlowFlow::derive(&stated, &manifold, &fixed_points);
        let orbits = SymmetricOrbits::derive(&stated)?;
        let programs =
            Programs::new(&stated, &manifold, &fixed_points, &boundaries, &slow_flow, &orbits);
        Ok(Self { stated, manifold, fixed_points, boundaries, slow_flow, orbits, programs })
    }
}

/// The equations, derived at the first call.
///
/// # Panics
/// If the derivation fails, which depends on nothing but the program itself.
pub fn equations() -> &'static Equations {
    static EQUATIONS: LazyLock<Equations> =
        LazyLock::new(|| Equations::derive().expect("the stated equations can be solved"));
    &EQUATIONS
}
