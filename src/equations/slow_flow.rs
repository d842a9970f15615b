//! The slow flow (18) on the manifold, in the absorber's amplitude and the excitation's phase.
//!
//! From `C^2(B)` follows `dB/dtau1 = 2 C (dC/dtau1) / (dC^2/dB)`. Lengths are measured in
//! clearances and the amplitude is `u = beta - 1`. Valid where (18) and (16) are, and not at the
//! fold, where `dC^2/dB` vanishes.

use super::Stated;
use super::fixed_points::on_manifold;
use super::manifold::{Manifold, in_shift};
use crate::symbolic::Expr;
use crate::symbolic::Symbol::{
    AmplitudeRatio as beta, ExcitationPhase as eta, ManifoldSquare as c_2,
    OscillatorAmplitude as C, Shift as u,
};

/// Rates and their Jacobian.
#[derive(Debug, Clone)]
pub struct SlowFlow {
    /// `d(beta)/dtau1` in `beta`, `c_2`, `eta`.
    pub ratio_rate: Expr,
    /// `d(eta)/dtau1` in `beta`, `c_2`, `eta`.
    pub phase_rate: Expr,
    /// Both rates in `u`, `eta`; these are evaluated.
    pub rates: [Expr; 2],
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
        let slope = manifold.ratio_square.differentiate(beta);
        let ratio_rate = on_manifold(&square_rate, stated, manifold) / slope;
        let phase_rate = on_manifold(&stated.phase_rate.right, stated, manifold);
        let rates = [&ratio_rate, &phase_rate]
            .map(|rate| in_shift(&rate.substitute(c_2, &manifold.ratio_square)));
        let jacobian = [0, 1].map(|row| [u, eta].map(|by| rates[row].differentiate(by)));
        let [[a, b], [c, d]] = &jacobian;
        let (trace, determinant) = (a + d, a * d - b * c);
        Self { ratio_rate, phase_rate, rates, trace, determinant, jacobian }
    }
}
