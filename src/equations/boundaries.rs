//! Boundaries of the regimes in the plane of detuning and forcing, and the point where two meet.
//!
//! A fixed point at the fold is the Hopf boundary (paper, Fig. 6b); one where a multiplier of the
//! impact pair is -1 is the symmetry-breaking boundary; two fixed points meeting exactly at the
//! fold are the point P1 (Fig. 6c). Valid at first order in the mass ratio.

use super::fixed_points::{collected, with_shift};
use super::manifold::{Manifold, with_curvature};
use super::{FixedPoints, Stated};
use crate::symbolic::Symbol::{
    AmplitudeRatio as beta, Detuning as sigma, ManifoldSquare as c_2, Shift as u,
};
use crate::symbolic::{AlgebraError, Expr};

/// The explicit boundaries.
#[derive(Debug, Clone)]
pub struct Boundaries {
    /// `gamma^2` of the Hopf boundary by ascending powers of `sigma`.
    pub hopf: [Expr; 3],
    /// `gamma^2` of the symmetry-breaking boundary by ascending powers of `sigma`.
    pub breaking: [Expr; 3],
    /// `sigma` where a fixed point at the fold is a double one, in `beta`, `c_2` of the fold.
    pub meeting_detuning_at_fold: Expr,
    /// `sigma` of P1 in `lambda`, `rho`, `R`.
    pub meeting_detuning: Expr,
    /// `gamma^2` of P1 in `sigma` of P1.
    pub meeting_forcing_squared: Expr,
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
        let forcing = with_shift(&fixed_points.forcing_squared);
        let at = |ratio: &Expr, shift: &Expr, square: &Expr| {
            forcing.substitute(beta, ratio).substitute(u, shift).substitute(c_2, square)
        };
        let fold = at(&manifold.fold_ratio, &manifold.fold_shift, &manifold.fold_square);
        // rho^2 over c_2 of the fold stays finite for r = 1: cancel R, for values at r = 1.
        let hopf = collected::<3>(&fold, sigma)?;
        let [constant, linear, quadratic] = hopf.map(|c| with_curvature(&c, stated));
        let hopf = [constant?.cancel(), linear?.cancel(), quadratic?.cancel()];
        let breaking =
            at(&manifold.breaking_ratio, &manifold.breaking_shift, &manifold.breaking_square);
        // c_2 is stationary at the fold, so gamma^2 is if the rest of the condition is.
        let stationary = fixed_points.condition.differentiate(beta);
        let meeting_detuning_at_fold = stationary.solve_linear(sigma)?;
        let meeting_detuning = meeting_detuning_at_fold
            .substitute(beta, &manifold.fold_ratio)
            .substitute(c_2, &manifold.fold_square);
        Ok(Self {
            meeting_forcing_squared: Expr::sum([
                hopf[0].clone(),
                &hopf[1] * sigma,
                &hopf[2] * sigma.squared(),
            ]),
            hopf,
            breaking: collected(&breaking, sigma)?,
            meeting_detuning: with_curvature(&meeting_detuning, stated)?.cancel(),
            meeting_detuning_at_fold,
        })
    }
}
