//! Free decay: the slow flow (18) without excitation, on the manifold, integrated in closed form.
//!
//! Without forcing (18) is `dc_2/dtau_1 = -Q`, `Q = lambda c_2 + ell beta^2` with `ell = 16 rho/pi^3`; with
//! (16), `c_2 = (1 + R) beta^2 - 2 beta + 1`, that is `Q = Lambda beta^2 - 2 lambda beta + lambda`. The time
//! from `beta_i` down to `beta_f` is therefore the integral of `2 ((1 + R) beta - 1)/Q` over `beta`. Its
//! numerator is `(1 + R)/Lambda dQ/dbeta - 2 ell/Lambda`, and `Psi`, the integral of `1/Q`, is a difference of
//! two arctangents over `q`, `q^2 = lambda (Lambda - lambda)`. Both arguments are positive on the stable
//! branch, where `Lambda beta - lambda >= ell/(1 + R)`, so that the difference is one arctangent, which loses
//! nothing as `lambda` vanishes. Impacts take the integral of `ell beta^2` over time; division by `Q` leaves
//! `(1 + R) beta/Lambda + s_d` and a remainder with the factor `lambda`.
//!
//! At first order in the mass ratio, energy is `c_2` in units of that of the oscillator at an amplitude of
//! one clearance. Valid on the stable branch, from symmetry breaking down to the fold, where capture ends.

use std::f64::consts::PI;

use crate::symbolic::{atan2, cube, equations, ln, sqrt, square};

const DERIVED: &str =
    "derived here from (18) without forcing; on the stable branch, first order in epsilon";

equations! {
    /// In reading order.
    GROUPS =
    "Rate of decay", "how fast the square of the amplitude falls without excitation", DERIVED => {
        IMPACT_COEFFICIENT(rho): [ell] = 16.0 / cube(PI) * rho;
        RATE_COEFFICIENT(lambda, R, ell): [Lambda] = lambda * (1.0 + R) + ell;
        RATE_ROOT(lambda, R, ell): [q] = sqrt(lambda * (lambda * R + ell));
        DECAY_RATE(lambda, Lambda, beta): [Q] = Lambda * square(beta) - 2.0 * lambda * beta + lambda;
    }
    "Time of decay", "slow time from one amplitude down to another, with the rates of decay at both", DERIVED => {
        ARCTANGENT(lambda, Lambda, q, beta_i, beta_f): [Psi]
            = atan2(q * Lambda * (beta_i - beta_f),
                square(q) + (Lambda * beta_i - lambda) * (Lambda * beta_f - lambda)) / q;
        DECAY_TIME(R, ell, Lambda, Psi, Q_i, Q_f): [tau_1]
            = (1.0 + R) / Lambda * ln(Q_i / Q_f) - 2.0 * ell / Lambda * Psi;
    }
    "Time of decay without damping", "its limit as the oscillator's own damping vanishes", DERIVED => {
        ARCTANGENT_UNDAMPED(ell, beta_i, beta_f): [Psi] = (beta_i - beta_f) / (ell * beta_i * beta_f);
    }
    "Energy that impacts take", "their part of the fall of the square of the amplitude; the rest is the damper's",
    DERIVED => {
        QUOTIENT(lambda, R, Lambda): [s_d] = (2.0 * lambda * (1.0 + R) / Lambda - 1.0) / Lambda;
        IMPACT_ENERGY(lambda, R, ell, Lambda, s_d, Psi, beta_i, beta_f, Q_i, Q_f): [W]
            = 2.0 * ell * ((beta_i - beta_f) * ((1.0 + R) / (2.0 * Lambda) * (beta_i + beta_f) + s_d)
                + lambda / Lambda * (s_d - (1.0 + R) / (2.0 * Lambda)) * ln(Q_i / Q_f)
                - lambda * (s_d - lambda / Lambda * (2.0 * s_d - (1.0 + R) / Lambda)) * Psi);
    }
}
