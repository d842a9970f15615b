//! Boundaries of the regimes in the plane of detuning and forcing, and the point where two meet.
//!
//! A fixed point at the fold is the Hopf boundary (paper, Fig. 6b); one where a multiplier of the
//! impact pair is -1 is the symmetry-breaking boundary; two fixed points meeting exactly at the
//! fold are the point P1 (Fig. 6c). Valid at first order in the mass ratio.

use super::manifold::{Manifold, with_curvature};
use super::{FixedPoints, Stated};
use crate::symbolic::Symbol::{
    AmplitudeRatio as beta, Detuning as sigma, ForcingLinear as p_1, ForcingSquare as p_2,
    Shift as u,
};
use crate::symbolic::{AlgebraError, Expr};

/// The explicit boundaries.
#[derive(Debug, Clone)]
pub struct Boundaries {
    /// `gamma^2` of the Hopf boundary.
    pub hopf_squared: Expr,
    /// `gamma^2` of the symmetry-breaking boundary.
    pub breaking_squared: Expr,
    /// `sigma` of P1 in `lambda`, `rho`, `R`.
    pub meeting_detuning: Expr,
}

impl Boundaries {
    /// Derives the boundaries from the condition for a fixed point.
    ///
    /// # Errors
    /// Never for the stated equations; a test runs it.
    pub fn derive(
        stated: &Stated,
        manifold: &Manifold,
        fixed_points: &FixedPoints,
    ) -> Result<Self, AlgebraError> {
        let at = |ratio: &Expr, shift: &Expr| {
            fixed_points.forcing_squared.substitute(beta, ratio).substitute(u, shift)
        };
        // The collision is at the fold: with rho^2 as R the squares of sigma cancel.
        let [_, linear, square] = &fixed_points.quadratic;
        let meeting = (&fixed_points.collision_ratio - &manifold.fold_ratio)
            .substitute(p_1, linear)
            .substitute(p_2, with_curvature(square, stated)?);
        Ok(Self {
            hopf_squared: at(&manifold.fold_ratio, &manifold.fold_shift),
            breaking_squared: at(&manifold.breaking_ratio, &manifold.breaking_shift),
            meeting_detuning: meeting.solve_linear(sigma)?.cancel(),
        })
    }
}
