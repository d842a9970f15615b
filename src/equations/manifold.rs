//! What (14) and (15) give: the slow invariant manifold, its fold, and where symmetry breaks.
//!
//! `C^2 = (1 + R) B^2 - 2 b B + b^2` is equation (16). Valid at first order in the mass ratio, for
//! two symmetric impacts per cycle; a point of it is a motion only if the absorber stays between
//! the walls from impact to impact.

use super::Stated;
use crate::symbolic::Symbol::{
    AbsorberAmplitude as B, AbsorberPhase as Theta, AmplitudeRatio as beta, Clearance as b,
    CosineLength, ImpactFactor, OscillatorAmplitude as C, Restitution as r,
    RestitutionRatio as rho, Shift as u, SineLength,
};
use crate::symbolic::{AlgebraError, Expr, cos, eliminate_angle, sin, sqrt};

/// The manifold and its special points, as expressions.
#[derive(Debug, Clone)]
pub struct Manifold {
    /// `cos Theta` in `b`, `B`, `C`.
    pub cosine: Expr,
    /// `sin Theta` in `B`, `C`, `rho`.
    pub sine: Expr,
    /// `C^2` as the sum of two squares, in `b`, `B`, `R`.
    pub square: Expr,
    /// The same in descending powers of `B`, as (16) has it.
    pub square_by_powers: Expr,
    /// `d(C^2)/dB`.
    pub slope: Expr,
    /// `B` at the fold.
    pub fold_amplitude: Expr,
    /// `C` at the fold.
    pub fold_oscillator: Expr,
    /// `c_2 = C^2/b^2` in `beta` and `R`.
    pub ratio_square: Expr,
    /// `c_2` in `u` and `R`; keeps the accuracy of `R` near the fold, where `u` is as small.
    pub shifted_square: Expr,
    /// `beta` at the fold.
    pub fold_ratio: Expr,
    /// `u` at the fold.
    pub fold_shift: Expr,
    /// `c_2` at the fold.
    pub fold_square: Expr,
    /// `beta` where a multiplier of the half-period map is 1, in `r`; it is the fold again.
    pub unit_multiplier_ratio: Expr,
    /// `beta` where a multiplier is -1: symmetric impacts become asymmetric.
    pub breaking_ratio: Expr,
    /// `u` there.
    pub breaking_shift: Expr,
    /// `c_2` there.
    pub breaking_square: Expr,
}

impl Manifold {
    /// Derives everything from (14), (15), the definitions of `rho` and `R`, and the trace and
    /// determinant of the half-period map.
    ///
    /// # Errors
    /// Never for the stated equations; a test runs it.
    pub fn derive(stated: &Stated) -> Result<Self, AlgebraError> {
        let restitution = stated.restitution_ratio.residual().solve_linear(r)?;
        let curvature = stated.curvature.residual().solve_linear(rho.squared())?;
        let cosine = stated.impact_position.residual().solve_linear(cos(Theta))?;
        let sine = stated.impact_velocity.residual().solve_linear(sin(Theta))?;
        let sine = sine.substitute(r, restitution).cancel();
        let circle = eliminate_angle(&(C * &cosine), &(C * &sine), &C.into());
        let square = circle.substitute(rho.squared(), curvature).solve_linear(C.squared())?;
        let slope = square.differentiate(B).descending_in(B)?;
        let fold_amplitude = slope.solve_linear(B)?.cancel();
        let at_fold = square.substitute(B, &fold_amplitude).cancel();
        let fold_oscillator = b * sqrt((at_fold / b.squared()).cancel());
        let ratio_square = in_clearances(&square);
        let shifted_square = in_shift(&ratio_square);
        let fold_shift = shifted_square.differentiate(u).solve_linear(u)?.cancel();
        let breaking_ratio = multiplier_ratio(stated, &cosine, &sine, -1)?;
        let breaking_shift = (&breaking_ratio - 1).cancel();
        Ok(Self {
            square_by_powers: square.descending_in(B)?,
            fold_ratio: in_clearances(&fold_amplitude),
            fold_square: shifted_square.substitute(u, &fold_shift).cancel(),
            unit_multiplier_ratio: multiplier_ratio(stated, &cosine, &sine, 1)?,
            breaking_square: shifted_square.substitute(u, &breaking_shift).cancel(),
            cosine,
            sine,
            square,
            slope,
            fold_amplitude,
            fold_oscillator,
            ratio_square,
            shifted_square,
            fold_shift,
            breaking_ratio,
            breaking_shift,
        })
    }
}

/// `beta` where the half-period map has the multiplier 1 or -1: `1 -+ trace + determinant = 0`.
fn multiplier_ratio(
    stated: &Stated,
    cosine: &Expr,
    sine: &Expr,
    multiplier: i32,
) -> Result<Expr, AlgebraError> {
    let condition = 1 - multiplier * &stated.trace.right + &stated.determinant.right;
    let condition = condition
        .substitute(ImpactFactor, &stated.impact_factor.right)
        .substitute(CosineLength, C * cosine)
        .substitute(SineLength, C * sine)
        .substitute(rho, &stated.restitution_ratio.right);
    Ok(in_clearances(&condition).solve_linear(beta)?.cancel())
}

/// Measures lengths in clearances: `b = 1`, `B = beta`. Right for expressions in which all terms
/// have the same power of length, once they are divided by that power of `b`.
pub(super) fn in_clearances(expression: &Expr) -> Expr {
    expression.substitute(b, 1).substitute(B, beta)
}

/// Writes `1 + u` for `beta`.
pub(super) fn in_shift(expression: &Expr) -> Expr {
    expression.substitute(beta, 1 + u)
}

/// Writes even powers of `rho` as powers of `R`, so that a division by `R` can cancel.
pub(super) fn with_curvature(expression: &Expr, stated: &Stated) -> Result<Expr, AlgebraError> {
    let square = stated.curvature.residual().solve_linear(rho.squared())?;
    Ok(expression.expand().substitute(rho.squared(), square))
}
