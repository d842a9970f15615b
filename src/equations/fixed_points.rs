//! Fixed points of the slow flow (18) on the manifold: `gamma^2` is a quadratic in `beta`.
//!
//! At rest (18) says `gamma sin(eta) = lambda C + E sin(Theta)`, `gamma cos(eta) = E cos(Theta) - 2 sigma C`
//! (lengths over the clearance). Turned by the absorber's phase these are
//! `gamma cos(eta - Theta) = E - 2 sigma C cos(Theta) + lambda C sin(Theta)` and
//! `gamma sin(eta - Theta) = lambda C cos(Theta) + 2 sigma C sin(Theta)`, in which (14), (15) and `E` are
//! linear in `beta`. Their squares add up to `gamma^2 = p_0 + p_1 beta + p_2 beta^2`, whose smallest value
//! is the saddle-node's. Valid where (18) and (16) are.

use super::Stated;
use super::manifold::{Manifold, in_clearances};
use crate::symbolic::Symbol::{
    AbsorberPhase as Theta, AmplitudeRatio as beta, CollisionForcing, Detuning as sigma,
    Discriminant as Delta, ExcitationPhase as eta, FirstHarmonic as E, ForcingConstant as p_0,
    ForcingLinear as p_1, ForcingPerClearance as gamma, ForcingSquare as p_2,
    ManifoldSquare as c_2, OscillatorAmplitude as C, ReducedForcing as G, Shift as u,
};
use crate::symbolic::{AlgebraError, Expr, Symbol, cos, fraction, sin, sqrt};

/// The condition for a fixed point in its several forms.
#[derive(Debug, Clone)]
pub struct FixedPoints {
    /// `gamma sqrt(c_2) sin(eta)` in `beta`, `c_2`.
    pub sine: Expr,
    /// `gamma sqrt(c_2) cos(eta)` in `beta`, `u`, `c_2`.
    pub cosine: Expr,
    /// `gamma cos(eta - Theta)` in `beta`, `u`.
    pub along: Expr,
    /// `gamma sin(eta - Theta)` in `beta`, `u`.
    pub across: Expr,
    /// `gamma^2` at which there is a fixed point, in `beta`, `u`.
    pub forcing_squared: Expr,
    /// `p_0`, `p_1`, `p_2`: the same by powers of `beta`.
    pub quadratic: [Expr; 3],
    /// `gamma` at which two fixed points meet, in `p_2`.
    pub collision_forcing: Expr,
    /// `beta` at which they meet, in `p_1`, `p_2`.
    pub collision_ratio: Expr,
    /// `Delta`, a quarter of the discriminant, in `p_2` and `gamma` of the collision.
    pub discriminant: Expr,
    /// `beta` of the two fixed points, the smaller first, in `p_1`, `p_2`, `Delta`.
    pub ratios: [Expr; 2],
    /// The product of the two, in `p_0`, `p_2`, `gamma`.
    pub product: Expr,
    /// What vanishes at a fixed point, by powers of `sigma`, in `beta`, `u`: the frequency response.
    pub by_detuning: [Expr; 3],
    /// What vanishes where two fixed points meet, by powers of `sigma`.
    pub collision_by_detuning: [Expr; 5],
}

impl FixedPoints {
    /// Derives everything from (18) and the manifold.
    ///
    /// # Errors
    /// Never for the stated equations; a test runs it.
    pub fn derive(stated: &Stated, manifold: &Manifold) -> Result<Self, AlgebraError> {
        let sine = (&stated.amplitude_rate.right.solve_linear(sin(eta))? * G).distribute();
        let cosine = (&stated.phase_rate.right.solve_linear(cos(eta))? * G).distribute();
        let turned = |side: Expr| {
            let square = sin(Theta).squared();
            let side = side.expand().substitute(square, 1 - cos(Theta).squared()).expand();
            with_shift(&on_manifold(&side, stated, manifold))
        };
        let along = turned(&cosine * cos(Theta) + &sine * sin(Theta));
        let across = turned(&sine * cos(Theta) - &cosine * sin(Theta));
        let forcing_squared = along.squared() + across.squared();
        // Both are linear in beta and u = beta - 1.
        let parts = |side: &Expr| -> Result<[Expr; 2], AlgebraError> {
            let [by_shift, by_ratio]: [Expr; 2] = collected(side, beta)?;
            let [_, by_shift]: [Expr; 2] = collected(&by_shift, u)?;
            Ok([by_ratio, by_shift])
        };
        let ([along_ratio, along_shift], [across_ratio, across_shift]) =
            (parts(&along)?, parts(&across)?);
        let (along_slope, across_slope) =
            (&along_ratio + &along_shift, &across_ratio + &across_shift);
        let distance = &along_shift * &across_ratio - &along_ratio * &across_shift;
        let at_rest =
            |side: &Expr| with_shift(&on_manifold(&(side * C).distribute(), stated, manifold));
        let root = |sign: i32| (sign * sqrt(Delta) - fraction(1, 2) * p_1) / p_2;
        let square = along_slope.squared() + across_slope.squared();
        let condition = &forcing_squared - gamma.squared();
        let collision = distance.squared() - gamma.squared() * &square;
        Ok(Self {
            sine: at_rest(&sine),
            cosine: at_rest(&cosine),
            quadratic: [
                (along_shift.squared() + across_shift.squared()).expand(),
                (-2 * (&along_shift * &along_slope + &across_shift * &across_slope)).expand(),
                square,
            ],
            collision_forcing: distance.expand() / sqrt(p_2),
            collision_ratio: -p_1 / (2 * p_2),
            discriminant: p_2 * (gamma - CollisionForcing) * (gamma + CollisionForcing),
            ratios: [root(-1), root(1)],
            product: (p_0 - gamma.squared()) / p_2,
            by_detuning: collected(&condition.expand(), sigma)?,
            collision_by_detuning: collected(&collision.expand(), sigma)?,
            along,
            across,
            forcing_squared,
        })
    }
}

/// Puts (14), (15) and `E` in, and measures lengths in clearances, so that `C^2` is `c_2`.
pub(super) fn on_manifold(expression: &Expr, stated: &Stated, manifold: &Manifold) -> Expr {
    let expression = expression
        .substitute(E, &stated.first_harmonic.right)
        .substitute(sin(Theta), &manifold.sine)
        .substitute(cos(Theta), &manifold.cosine);
    in_clearances(&expression)
        .substitute(C.squared(), c_2)
        .substitute(C, sqrt(c_2))
        .substitute(G, gamma)
}

/// Writes `-u` for `1 - beta`, which keeps small differences exact.
pub(super) fn with_shift(expression: &Expr) -> Expr {
    expression.substitute(1 - beta, -u)
}

/// Exactly `N` coefficients, ascending; those beyond the degree are 0.
pub(super) fn collected<const N: usize>(
    expression: &Expr,
    variable: Symbol,
) -> Result<[Expr; N], AlgebraError> {
    let coefficients = expression.collect(variable)?;
    assert!(coefficients.len() <= N, "degree {} in {variable}", coefficients.len() - 1);
    Ok(std::array::from_fn(|power| coefficients.get(power).cloned().unwrap_or(Expr::ZERO)))
}
