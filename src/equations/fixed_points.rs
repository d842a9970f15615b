//! Fixed points of the slow flow (18) on the manifold, as a quartic, and their frequency response.
//!
//! With `S = lambda c_2 + (16/pi^3) rho beta^2` and `K = (8/pi^2) beta (1 - beta) - 2 sigma c_2`,
//! both derived here, a fixed point has `gamma sqrt(c_2) sin(eta) = S` and
//! `gamma sqrt(c_2) cos(eta) = K`, so `S^2 + K^2 = gamma^2 c_2`. Valid where (18) and (16) are.

use super::Stated;
use super::manifold::{Manifold, in_clearances, in_shift};
use crate::symbolic::Symbol::{
    AbsorberPhase as Theta, AmplitudeRatio as beta, Detuning as sigma, ExcitationPhase as eta,
    FirstHarmonic as E, ForcingPerClearance as gamma, ManifoldSquare as c_2,
    OscillatorAmplitude as C, ReducedForcing as G, Shift as u,
};
use crate::symbolic::{AlgebraError, Expr, Symbol, cos, eliminate_angle, sin, sqrt};

/// The condition for a fixed point in its several forms.
#[derive(Debug, Clone)]
pub struct FixedPoints {
    /// `gamma sqrt(c_2) sin(eta)` in `beta`, `c_2`.
    pub sine: Expr,
    /// `gamma sqrt(c_2) cos(eta)` in `beta`, `c_2`.
    pub cosine: Expr,
    /// What vanishes at a fixed point, in `beta`, `c_2`.
    pub condition: Expr,
    /// `gamma^2` at which there is a fixed point, in `beta`, `c_2`.
    pub forcing_squared: Expr,
    /// Coefficients of the condition in ascending powers of `beta`.
    pub by_ratio: [Expr; 5],
    /// Coefficients of the condition in ascending powers of `u`; these are solved numerically.
    pub by_shift: [Expr; 5],
    /// Coefficients of the condition in ascending powers of `sigma`, in `beta`, `u`, `c_2`.
    pub by_detuning: [Expr; 3],
    /// Numerator of `d(gamma^2)/d(beta)`, two fixed points meeting, by powers of `beta`.
    pub saddle_node_by_ratio: [Expr; 6],
    /// The same by powers of `u`.
    pub saddle_node_by_shift: [Expr; 6],
    /// The same by powers of `sigma`, in `u`: at a given amplitude the boundary is explicit.
    pub saddle_node_by_detuning: [Expr; 3],
}

impl FixedPoints {
    /// Derives everything from (18) and the manifold.
    ///
    /// # Errors
    /// Never for the stated equations; a test runs it.
    pub fn derive(stated: &Stated, manifold: &Manifold) -> Result<Self, AlgebraError> {
        let sine = &stated.amplitude_rate.right.solve_linear(sin(eta))? * G;
        let cosine = &stated.phase_rate.right.solve_linear(cos(eta))? * G;
        let on_manifold =
            |side: Expr| on_manifold(&(side.distribute() * C).distribute(), stated, manifold);
        let (sine, cosine) = (on_manifold(sine), on_manifold(cosine));
        let condition = eliminate_angle(&sine, &cosine, &(gamma * sqrt(c_2)));
        let in_ratio = condition.substitute(c_2, &manifold.ratio_square);
        let in_shift = in_shift(&condition.substitute(c_2, &manifold.ratio_square));
        let by_ratio = collected(&in_ratio, beta)?;
        let by_shift = collected(&in_shift, u)?;
        let unforced =
            |coefficients: &[Expr; 5]| coefficients.clone().map(|c| c.substitute(gamma, 0));
        let saddle_node_by_shift = saddle_node(&unforced(&by_shift), &manifold.shifted_square, u)?;
        Ok(Self {
            forcing_squared: condition.solve_linear(gamma.squared())?,
            by_detuning: collected(&with_shift(&condition), sigma)?,
            saddle_node_by_ratio: saddle_node(&unforced(&by_ratio), &manifold.ratio_square, beta)?,
            saddle_node_by_detuning: collected(&polynomial(&saddle_node_by_shift, u), sigma)?,
            saddle_node_by_shift,
            sine,
            cosine,
            condition,
            by_ratio,
            by_shift,
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

/// `N' c_2 - N c_2'` by powers of `variable`, from the coefficients of `N = gamma^2 c_2`.
fn saddle_node(
    numerator: &[Expr; 5],
    square: &Expr,
    variable: Symbol,
) -> Result<[Expr; 6], AlgebraError> {
    let numerator = polynomial(numerator, variable);
    let square = polynomial(&square.collect(variable)?, variable);
    let rise = numerator.differentiate(variable) * &square;
    collected(&(rise - numerator * square.differentiate(variable)), variable)
}

/// The polynomial with these coefficients.
fn polynomial(coefficients: &[Expr], variable: Symbol) -> Expr {
    let powers = std::iter::successors(Some(Expr::ONE), |power| Some(power * variable));
    Expr::sum(coefficients.iter().zip(powers).map(|(coefficient, power)| coefficient * power))
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
