//! The slow flow (18) on the manifold, in the absorber's amplitude and the excitation's phase.
//!
//! From `C^2(B)` follows `dB/dtau1 = 2 C (dC/dtau1) / (dC^2/dB)`. Lengths are measured in
//! clearances and the amplitude is `u = beta - 1`. Valid where (18) and (16) are, and not at the
//! fold, where `dC^2/dB` vanishes.

use super::Stated;
use super::fixed_points::{on_manifold, with_shift};
use super::manifold::{Manifold, in_shift};
use crate::symbolic::Expr;
use crate::symbolic::Symbol::{
    AmplitudeRatio as beta, ExcitationPhase as eta, ManifoldSquare as c_2,
    OscillatorAmplitude as C, Shift as u,
};

/// Rates and their Jacobian, in `beta`, `u`, `c_2` of a point of the manifold, and `eta`.
#[derive(Debug, Clone)]
pub struct SlowFlow {
    /// `d(beta)/dtau1`.
    pub ratio_rate: Expr,
    /// `d(eta)/dtau1`.
    pub phase_rate: Expr,
    /// Derivatives of the rates, by rows, by `u` and `eta`.
    pub jacobian: [[Expr; 2]; 2],
    /// Trace of the Jacobian.
    pub trace: Expr,
    /// Determinant of the Jacobian.
    pub determinant: Expr,
}

impl SlowFlow {
    /// Derives the flow from (18) and the manifold.
    pub fn derive(stated: &Stated, manifold: &Manifold) -> Self {
        let square_rate = (2 * C * &stated.amplitude_rate.right).distribute();
        let slope = manifold.shifted_square.differentiate(u).substitute(1 + u, beta);
        let ratio_rate = on_manifold(&square_rate, stated, manifold) / slope;
        let phase_rate = with_shift(&on_manifold(&stated.phase_rate.right, stated, manifold));
        let jacobian = [&ratio_rate, &phase_rate].map(|rate| {
            let in_shift = in_shift(&rate.substitute(c_2, &manifold.ratio_square));
            [u, eta].map(|by| in_point(&in_shift.differentiate(by), manifold))
        });
        let [[a, b], [c, d]] = &jacobian;
        let (trace, determinant) = (a + d, a * d - b * c);
        Self { ratio_rate, phase_rate, trace, determinant, jacobian }
    }
}

/// Writes `c_2` and `beta` again for what they are in `u`.
fn in_point(expression: &Expr, manifold: &Manifold) -> Expr {
    expression.substitute(&manifold.shifted_square, c_2).substitute(1 + u, beta)
}
