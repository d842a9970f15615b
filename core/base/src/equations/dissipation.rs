//! The slow flow (18) with averages in place of the two components of the absorber's force.
//!
//! Over the clearance, `E sin(Theta)` and `E cos(Theta)` are `S(c)` and `K(c)`, `c = C/b`, averages over the motion
//! of the impact pair at a prescribed amplitude; with (14), (15) and `E` the first two are their closed forms.
//! At rest (18) says `gamma sin(eta) = lambda c + S` and `gamma cos(eta) = K - 2 sigma c`, whose squares add up
//! to the forcing of an amplitude; solved for `sigma` it is the frequency response. The Jacobian of the flow in
//! `c` and `eta` has there the rows `-(lambda + S')/2`, `(K - 2 sigma c)/2` and `(2 sigma - K')/(2 c)`,
//! `-(lambda c + S)/(2 c)`, the prime being `d/dc` along a branch. Valid at first order in the mass ratio, near
//! 1:1 resonance, where averages settle faster than amplitudes change.

use std::f64::consts::PI;

use crate::symbolic::{cube, equations, sqrt, square};

const DERIVED: &str = "derived here from (18) with averages; first order in epsilon, any regime";

equations! {
    /// In reading order.
    GROUPS =
    "Force of the absorber in 1:1 resonance", "its part that takes energy and its part in phase with the displacement",
    "derived here from (14), (15); on the stable branch" => {
        RESISTANCE(rho, beta, c): [S] = 16.0 / cube(PI) * rho * square(beta) / c;
        REACTANCE(beta, u, c): [K] = -(8.0 / square(PI)) * beta * u / c;
    }
    "Slow flow in any regime", "rates of z_c + i z_s = c exp(i eta), and of the amplitude without excitation, over the clearance", DERIVED => {
        COSINE_RATE(lambda, sigma, S, K, c, z_c, z_s): [D1_z_c]
            = -(lambda * z_c + (S * z_c - K * z_s) / c) / 2.0 - sigma * z_s;
        SINE_RATE(lambda, sigma, gamma, S, K, c, z_c, z_s): [D1_z_s]
            = (gamma - lambda * z_s - (S * z_s + K * z_c) / c) / 2.0 + sigma * z_c;
        DECAY(lambda, S, c): [D1_c] = -(lambda * c + S) / 2.0;
    }
    "Steady amplitude in any regime", "the forcing that holds an amplitude", DERIVED => {
        FORCING_SQUARED(lambda, sigma, S, K, c): [square(gamma)]
            = square(lambda * c + S) + square(2.0 * sigma * c - K);
    }
    "Frequency response in any regime", "the two detunings at which a forcing holds an amplitude", DERIVED => {
        RESPONSE_ROOT(lambda, gamma, S, c): [h_r] = sqrt((gamma - lambda * c - S) * (gamma + lambda * c + S));
        LOWER_DETUNING(K, c, h_r): [sigma_1] = (K - h_r) / (2.0 * c);
        UPPER_DETUNING(K, c, h_r): [sigma_2] = (K + h_r) / (2.0 * c);
    }
    "Stability of a steady amplitude in any regime", "trace and determinant of the slow flow's Jacobian", DERIVED => {
        TRACE(lambda, S, S_prime, c): [tr_J] = -(lambda + S_prime) / 2.0 - (lambda * c + S) / (2.0 * c);
        DETERMINANT(lambda, sigma, S, K, S_prime, K_prime, c): [det_J]
            = ((lambda + S_prime) * (lambda * c + S) + (2.0 * sigma - K_prime) * (2.0 * sigma * c - K)) / (4.0 * c);
    }
}
