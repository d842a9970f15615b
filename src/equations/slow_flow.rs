//! The slow flow (18) on the manifold, in the absorber's amplitude and the excitation's phase.
//!
//! From `C^2(B)` follows `dB/dtau1 = 2 C (dC/dtau1) / (dC^2/dB)`. Lengths are measured in
//! clearances. Valid where (18) and (16) are, and not at the fold, where `dC^2/dB` vanishes.
//!
//! In `c_2` and `eta` the flow is `dc_2 = gamma sqrt(c_2) sin(eta) - S`,
//! `d eta = (gamma sqrt(c_2) cos(eta) - K)/(2 c_2)`, `S` and `K` the sides of a fixed point. There its
//! Jacobian has the rows `S/(2 c_2) - S'`, `K` and `(K/(2 c_2) - K')/(2 c_2)`, `-S/(2 c_2)`, the prime being
//! `d/dc_2`, so that its trace is `-S'` and its determinant `((S^2 + K^2)/c_2)'/4`, a quarter of
//! `d(gamma^2)/dc_2`.

use super::fixed_points::{FixedPoints, on_manifold, with_shift};
use super::{Manifold, Stated};
use crate::symbolic::Symbol::{
    AmplitudeRatio as beta, Discriminant as Delta, ManifoldSquare as c_2, OscillatorAmplitude as C,
    Shift as u,
};
use crate::symbolic::{Expr, sqrt};

/// Rates of the flow, and what decides the stability of a fixed point.
#[derive(Debug, Clone)]
pub struct SlowFlow {
    /// `d(beta)/dtau1`, in `beta`, `u`, `c_2`, `eta`.
    pub ratio_rate: Expr,
    /// `d(eta)/dtau1`.
    pub phase_rate: Expr,
    /// Trace of the Jacobian at a fixed point, in `beta`, `u`.
    pub trace: Expr,
    /// Determinant of the Jacobian at the larger fixed point, where `d(gamma^2)/d(beta)` is
    /// `2 sqrt(Delta)`, in `beta`, `u`, `Delta`; at the smaller one the sign is the other.
    pub determinant: Expr,
}

impl SlowFlow {
    /// Derives the flow from (18) and the manifold.
    pub fn derive(stated: &Stated, manifold: &Manifold, fixed_points: &FixedPoints) -> Self {
        let square_rate = (2 * C * &stated.amplitude_rate.right).distribute();
        let slope = manifold.shifted_square.differentiate(u).substitute(1 + u, beta);
        let sine = &fixed_points.sine;
        Self {
            ratio_rate: on_manifold(&square_rate, stated, manifold) / &slope,
            phase_rate: with_shift(&on_manifold(&stated.phase_rate.right, stated, manifold)),
            trace: -(sine.differentiate(c_2) + sine.differentiate(beta) / &slope),
            determinant: sqrt(Delta) / (2 * slope),
        }
    }
}
