//! Fixed points of the slow flow (18) on the manifold: `gamma^2` is a quadratic in `beta`.
//!
//! At rest (18) says `gamma sin(eta) = lambda C + E sin(Theta)`, `gamma cos(eta) = E cos(Theta) - 2 sigma C`
//! (lengths over the clearance); times `C`, with (14), (15) and `E`, these are the first two below. Turned by
//! the absorber's phase they are
//! `gamma cos(eta - Theta) = E - 2 sigma C cos(Theta) + lambda C sin(Theta)` and
//! `gamma sin(eta - Theta) = lambda C cos(Theta) + 2 sigma C sin(Theta)`, in which (14), (15) and `E` are
//! linear in `beta`. Their squares add up to `gamma^2 = p_0 + p_1 beta + p_2 beta^2`, whose smallest value
//! is the saddle-node's: two lines `a + a' beta` and `c + c' beta` come closest to the origin at the
//! distance `(a c' - c a')/sqrt(a'^2 + c'^2)`, here `(n_0 + n_2 sigma^2)/sqrt(p_2)`.
//!
//! A fixed point at the fold is the Hopf boundary (paper, Fig. 6b), one where a multiplier of the impact
//! pair is -1 the symmetry-breaking boundary; two meeting at the fold are P1 (Fig. 6c), where
//! `beta_SN = 1/(1 + R)`, in which the squares of `sigma` cancel. By powers of `sigma` the condition is the
//! frequency response, and that of the saddle-node a quartic. Valid where (18) and (16) are.

use std::f64::consts::PI;

use crate::symbolic::{cube, equations, sqrt, square};

const DERIVED: &str = "derived here";

equations! {
    /// In reading order.
    GROUPS =
    "Fixed point", "the phase of a fixed point", DERIVED => {
        SINE_SIDE(lambda, rho, beta, c_2): [gamma * sqrt(c_2) * sin(eta)]
            = lambda * c_2 + 16.0 / cube(PI) * rho * square(beta);
        COSINE_SIDE(sigma, beta, u, c_2): [gamma * sqrt(c_2) * cos(eta)]
            = -(8.0 / square(PI)) * beta * u - 2.0 * sigma * c_2;
    }
    "Fixed point, in the absorber's phase", "linear in the amplitude", DERIVED => {
        ALONG(lambda, rho, sigma, beta, u): [gamma * cos(eta - Theta)]
            = 2.0 / PI * lambda * rho * beta + 8.0 / square(PI) * beta + 2.0 * sigma * u;
        ACROSS(lambda, rho, sigma, beta, u): [gamma * sin(eta - Theta)]
            = 4.0 / PI * rho * sigma * beta - lambda * u;
    }
    "Forcing of a fixed point", "which excitation holds an amplitude",
    "derived here: the sum of the squares of the two conditions before" => {
        FORCING_SQUARED(p_0, p_1, p_2, beta): [square(gamma)] = p_0 + p_1 * beta + p_2 * square(beta);
    }
    "Quadratic of the fixed points", "coefficients of powers of the amplitude in the squared forcing", DERIVED => {
        CONSTANT(lambda, sigma): [p_0] = square(lambda) + 4.0 * square(sigma);
        LINEAR(lambda, sigma): [p_1] = -2.0 * square(lambda) - 8.0 * square(sigma) - 32.0 / square(PI) * sigma;
        SQUARE(lambda, rho, sigma): [p_2]
            = square(2.0 / PI * lambda * rho + 8.0 / square(PI) + 2.0 * sigma) + square(4.0 / PI * rho * sigma - lambda);
    }
    "Saddle-node", "the forcing per clearance below which there is no fixed point, and the amplitude at which two meet",
    DERIVED => {
        NODE_CONSTANT(lambda, rho): [n_0] = 8.0 / square(PI) * lambda + 2.0 / PI * square(lambda) * rho;
        NODE_SQUARE(rho): [n_2] = 8.0 / PI * rho;
        NODE_FORCING(sigma, p_2, n_0, n_2): [gamma_SN] = (n_0 + n_2 * square(sigma)) / sqrt(p_2);
        NODE_RATIO(p_1, p_2): [beta_SN] = -p_1 / (2.0 * p_2);
        FORCING_FROM_NODE(p_2, beta_SN, gamma_SN, beta): [square(gamma)]
            = square(gamma_SN) + p_2 * square(beta - beta_SN);
    }
    "Number of fixed points", "two where it is above 0, none below: it is the distance from the saddle-node",
    DERIVED => {
        DISCRIMINANT(gamma, p_2, gamma_SN): [Delta] = p_2 * (gamma - gamma_SN) * (gamma + gamma_SN);
    }
    "Fixed points", "the one further from 0 is evaluated as a sum, the other from the product", DERIVED => {
        SMALLER_RATIO(p_1, p_2, Delta): [beta_1] = (-p_1 / 2.0 - sqrt(Delta)) / p_2;
        LARGER_RATIO(p_1, p_2, Delta): [beta_2] = (-p_1 / 2.0 + sqrt(Delta)) / p_2;
        RATIO_PRODUCT(gamma, p_0, p_2): [beta_1 * beta_2] = (p_0 - square(gamma)) / p_2;
    }
    "Saddle-node over the detuning",
    "coefficients of powers of the detuning: its roots are where two fixed points meet at this forcing", DERIVED => {
        NODE_DETUNING_0(lambda, rho, gamma, n_0): [s_0]
            = square(n_0) - square(gamma) * (square(2.0 / PI * lambda * rho + 8.0 / square(PI)) + square(lambda));
        NODE_DETUNING_1(gamma): [s_1] = -(32.0 / square(PI)) * square(gamma);
        NODE_DETUNING_2(R, gamma, n_0, n_2): [s_2] = 2.0 * n_0 * n_2 - 4.0 * (1.0 + R) * square(gamma);
        NODE_DETUNING_3(): [s_3] = 0.0;
        NODE_DETUNING_4(n_2): [s_4] = square(n_2);
    }
    "Frequency response", "coefficients of powers of the detuning at a given amplitude", DERIVED => {
        UNTUNED(lambda, rho, beta): [a_1] = 2.0 / PI * lambda * rho * beta + 8.0 / square(PI) * beta;
        DETUNING_0(lambda, gamma, u, a_1): [f_0] = square(a_1) + square(lambda * u) - square(gamma);
        DETUNING_1(beta, u): [f_1] = 32.0 / square(PI) * beta * u;
        DETUNING_2(c_2): [f_2] = 4.0 * c_2;
    }
    "Hopf boundary", "forcing per clearance with which a fixed point reaches the fold", DERIVED => {
        HOPF(lambda, rho, R, sigma): [gamma_H]
            = sqrt(square(2.0 / PI * lambda * rho + 8.0 / square(PI) - 2.0 * sigma * R)
                + square(4.0 / PI * rho * sigma + lambda * R)) / (1.0 + R);
    }
    "Symmetry-breaking boundary", "forcing per clearance with which a fixed point reaches symmetry breaking",
    DERIVED => {
        BREAKING(lambda, rho, sigma): [gamma_c]
            = sqrt(square(2.0 * PI * lambda * rho + 8.0 + 8.0 * sigma)
                + square(4.0 * PI * rho * sigma - 4.0 * lambda)) / (square(PI) - 4.0);
    }
    "Meeting point P1", "the detuning at which the saddle-node boundary reaches the Hopf boundary", DERIVED => {
        MEETING_DETUNING(lambda, rho, R): [sigma_P1] = 2.0 * (2.0 + PI * lambda * rho) / (square(PI) * (R - 1.0));
    }
}
