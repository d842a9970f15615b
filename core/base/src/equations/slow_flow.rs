//! The slow flow (18) on the manifold, in the square of the oscillator's amplitude, `c_2 = C^2/b^2`, and the
//! excitation's phase; and in the absorber's amplitude, by `d c_2 / d beta = 2 (u + R beta)`.
//!
//! `dc_2 = 2 C dC` gives `dc_2 = gamma sqrt(c_2) sin(eta) - S`,
//! `d eta = (gamma sqrt(c_2) cos(eta) - K)/(2 c_2)`, `S` and `K` the sides of a fixed point. There its
//! Jacobian has the rows `S/(2 c_2) - S'`, `K` and `(K/(2 c_2) - K')/(2 c_2)`, `-S/(2 c_2)`, the prime being
//! `d/dc_2`, so that its trace is `-S'` and its determinant `((S^2 + K^2)/c_2)'/4`, a quarter of
//! `d(gamma^2)/dc_2`, where `d(gamma^2)/d(beta) = 2 sqrt(Delta)` at the larger fixed point. Valid where (18)
//! and (16) are; `beta`, trace and determinant not at the fold, where `d c_2 / d beta` vanishes.

use std::f64::consts::PI;

use crate::symbolic::{cos, cube, equations, sin, sqrt, square};

equations! {
    /// In reading order.
    GROUPS =
    "Slow flow", "rates of the amplitudes and of the phase", "derived here" => {
        SQUARE_RATE(lambda, rho, gamma, beta, c_2, eta): [D1_c_2]
            = gamma * sqrt(c_2) * sin(eta) - lambda * c_2 - 16.0 / cube(PI) * rho * square(beta);
        RATIO_RATE(R, beta, u, D1_c_2): [D1_beta] = D1_c_2 / (2.0 * (u + R * beta));
        PHASE_RATE(sigma, gamma, beta, u, c_2, eta): [D1_eta]
            = gamma * cos(eta) / (2.0 * sqrt(c_2)) + 4.0 * beta * u / (square(PI) * c_2) + sigma;
    }
    "Stability of a fixed point",
    "trace of the slow flow's Jacobian, and its determinant at the larger fixed point; at the smaller one the sign is the other",
    "derived here" => {
        TRACE(lambda, rho, R, beta, u): [tr_J] = -lambda - 16.0 * rho * beta / (cube(PI) * (u + R * beta));
        DETERMINANT(R, beta, u, Delta): [det_J] = sqrt(Delta) / (4.0 * (u + R * beta));
    }
}
