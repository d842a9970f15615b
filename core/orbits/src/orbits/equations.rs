//! Symmetric 1:1 orbits of the full system at any mass ratio, as they are evaluated and printed: two impacts
//! per excitation period, half a period apart, each the mirror image of the other.
//!
//! The conditions are those at an impact on the wall `+b`. The absorber flies with `4 B/T` from `x_0 - b` to
//! its mirror image; momentum and restitution give the oscillator's velocities `v_+`, `v_-` over that speed.
//! Half a period later everything has changed its sign: with the free propagator `Phi` over `T/2` the
//! deviation from the steady motion is `(x_0 - X, x'+ - Omega V) = (Phi + I)^-1 (0, x'+ - x'-)`, and
//! `x'+ - x'- = -2 eps y'+`, so that with `q = (Phi + I)^-1 (0, 1)` the steady motion is linear in the
//! absorber's amplitude, `X = b - A B`, `V = -D B`, and its squared amplitude a quadratic. Exact; nothing is
//! expanded in the mass ratio. Valid where a steady motion exists, and a motion only if the absorber stays
//! between the walls from impact to impact. `tests/physics/orbit_equations.rs` proves what is derived against what is
//! stated.
//!
//! For the program itself: this module may change at any time.

#![allow(non_snake_case)]

use std::f64::consts::PI;

use crate::symbolic::{Group, atan2, equations, sqrt, square};
use crate::system::Excitation;

const MIRRORED: &str = "exact for motions that repeat with opposite sign after T/2";
const DERIVED: &str = "derived here";

equations! {
    /// What an orbit has to satisfy.
    CONDITIONS =
    "Period of the excitation", "half of it lies between the impacts of an exact symmetric orbit", "definition" => {
        PERIOD(Omega): [T] = 2.0 * PI / Omega;
    }
    "Absorber amplitude of an orbit", "the exact counterpart of the slow amplitude", "definition, as in (14)" => {
        AMPLITUDE(b, x_0): [B] = b - x_0;
        RATIO(b, B): [beta] = B / b;
    }
    "Contact at an impact", "where the absorber is at an impact on the wall +b", "paper (2)" => {
        CONTACT(b, x_0): [y_0] = x_0 - b;
    }
    "Flight of the absorber over half a period", "the absorber's speed", MIRRORED => {
        ABSORBER_FLIGHT(y_0): [y_0 + T / 2.0 * y_dot_after] = -y_0;
    }
    "Arrival of the absorber", "the velocity with which the absorber reaches the wall +b", MIRRORED => {
        ARRIVAL(y_dot_after): [y_dot_before] = -y_dot_after;
    }
    "Momentum at an impact", "one relation of the velocities at an impact", "paper (2)" => {
        MOMENTUM(eps, x_dot_before, y_dot_before): [x_dot_after + eps * y_dot_after] = x_dot_before + eps * y_dot_before;
    }
    "Restitution in the two velocities", "the other relation of the velocities at an impact", "paper (2)" => {
        RESTITUTION(r, x_dot_before, y_dot_before): [x_dot_after - y_dot_after] = -r * (x_dot_before - y_dot_before);
    }
    "Oscillator over half a period",
    "the oscillator half a period later, less the steady motion; after a unit of velocity the free oscillator has displacement g and velocity g' there",
    MIRRORED => {
        DECAY(eps, lambda): [d] = eps * lambda / 2.0;
        FREE_RATE(h): [g_dot] = h - 1.0;
        DISPLACEMENT_LATER(X, x_0): [(g_dot + 2.0 * d * g) * (x_0 - X) + g * (x_dot_after - Omega * V)] = -(x_0 - X);
        VELOCITY_LATER(Omega, V, x_dot_before): [g_dot * (x_dot_after - Omega * V) - g * (x_0 - X)]
            = -(x_dot_before - Omega * V);
    }
}

equations! {
    /// What follows at any forcing.
    CURVE =
    "Repeated impulse", "what the oscillator keeps of impulses that repeat with opposite sign",
    "free oscillator of (1) over T/2, exact" => {
        REPEATED_FIRST(): [(h + 2.0 * d * g) * q_1 + g * q_2] = 0.0;
        REPEATED_SECOND(): [h * q_2 - g * q_1] = 1.0;
        REPEATED_DISPLACEMENT(d, g, h): [q_1] = -g / ((h + 2.0 * d * g) * h + square(g));
        REPEATED_VELOCITY(d, g, h): [q_2] = (h + 2.0 * d * g) / ((h + 2.0 * d * g) * h + square(g));
    }
    "Speed of the absorber", "its flight takes half a period", DERIVED => {
        SPEED(T, B): [y_dot_after] = 4.0 * B / T;
    }
    "Velocities at an impact", "velocity of the oscillator after and before an impact over the absorber's speed",
    DERIVED => {
        VELOCITY_RATIO_AFTER(eps, r): [v_after] = (1.0 - r - 2.0 * eps * r) / (1.0 + r);
        VELOCITY_RATIO_BEFORE(eps, r): [v_before] = (1.0 - r + 2.0 * eps) / (1.0 + r);
        VELOCITY_AFTER(v_after, y_dot_after): [x_dot_after] = v_after * y_dot_after;
        VELOCITY_BEFORE(v_before, y_dot_after): [x_dot_before] = v_before * y_dot_after;
    }
    "Impact speed", "the relative speed at which the wall is met", DERIVED => {
        IMPACT_SPEED(eps, r, y_dot_after): [w_dot_before] = 2.0 * y_dot_after * (1.0 + eps) / (1.0 + r);
    }
    "Coefficients of the exact orbits", "what all symmetric orbits of the system share, at any forcing", DERIVED => {
        DISPLACEMENT_LOSS(eps, T, q_1): [A] = 1.0 - 8.0 * eps * q_1 / T;
        VELOCITY_LOSS(eps, Omega, T, q_2, v_after): [D] = -(4.0 * (v_after + 2.0 * eps * q_2) / (Omega * T));
    }
    "Steady motion at an impact", "the steady motion that an orbit with amplitude B needs", DERIVED => {
        DISPLACEMENT(b, B, A): [X] = b - A * B;
        VELOCITY(B, D): [V] = -D * B;
    }
    "Dynamic stiffness and damping force", "the oscillator's answer to the excitation", "definition" => {
        STIFFNESS(Omega): [kappa] = (1.0 - Omega) * (1.0 + Omega);
        LOSS(eps, lambda, Omega): [delta] = eps * lambda * Omega;
    }
}

equations! {
    /// The excitation of (1) if the base moves.
    BASE =
    "Excitation and gain", "coefficients of sin and cos in the excitation, and the steady amplitude over gamma b",
    "paper (1)" => {
        BASE_SINE(eps, G): [P_s] = eps * G;
        BASE_COSINE(delta, P_s): [P_c] = delta * P_s;
        BASE_GAIN(eps, kappa, delta): [chi] = eps * sqrt((1.0 + square(delta)) / (square(kappa) + square(delta)));
    }
}

equations! {
    /// The excitation of (1) if a force acts.
    FORCE =
    "Excitation and gain", "coefficients of sin and cos in the excitation, and the steady amplitude over gamma b",
    "paper (1) without the damper's share of the excitation" => {
        FORCE_SINE(eps, G): [P_s] = eps * G;
        FORCE_COSINE(): [P_c] = 0.0;
        FORCE_GAIN(eps, kappa, delta): [chi] = eps / sqrt(square(kappa) + square(delta));
    }
}

equations! {
    /// The orbits of one forcing.
    ORBITS =
    "Steady motion without impacts", "coefficients of sin and cos of the excitation's phase, and the squared amplitude over b^2",
    DERIVED => {
        STEADY_SINE(kappa, delta, P_s, P_c): [X_s] = (P_s * kappa + P_c * delta) / (square(kappa) + square(delta));
        STEADY_COSINE(kappa, delta, P_s, P_c): [X_c] = (P_c * kappa - P_s * delta) / (square(kappa) + square(delta));
        STEADY_SQUARE(b, X_s, X_c): [L_2] = (square(X_s) + square(X_c)) / square(b);
    }
    "Exact symmetric orbits", "its roots above 0 are the exact symmetric orbits; the one further from 0 is evaluated as a sum, the other from the product",
    DERIVED => {
        CONDITION(L_2): [square(1.0 - A * beta) + square(D * beta)] = L_2;
        DISCRIMINANT(L_2, A, D): [Delta] = (square(A) + square(D)) * L_2 - square(D);
        SMALLER_RATIO(Delta, A, D): [beta_1] = (A - sqrt(Delta)) / (square(A) + square(D));
        LARGER_RATIO(Delta, A, D): [beta_2] = (A + sqrt(Delta)) / (square(A) + square(D));
        RATIO_PRODUCT(L_2, A, D): [beta_1 * beta_2] = (1.0 - L_2) / (square(A) + square(D));
    }
    "Forcing of an exact orbit", "which excitation holds an amplitude", DERIVED => {
        FORCING(beta, chi, A, D): [gamma] = sqrt(square(1.0 - A * beta) + square(D * beta)) / chi;
    }
    "Exact saddle-node", "two orbits meet and less forcing has none, if this amplitude is above 0", DERIVED => {
        TURNING_RATIO(A, D): [beta_SN] = A / (square(A) + square(D));
        TURNING_FORCING(beta_SN, chi, A, D): [gamma_SN] = sqrt(square(1.0 - A * beta_SN) + square(D * beta_SN)) / chi;
    }
    "Phase of an impact", "the phase of the excitation at an impact on the wall +b",
    "derived here: X = X_s sin(phi) + X_c cos(phi), V = X_s cos(phi) - X_c sin(phi)" => {
        PHASE(X_s, X_c, X, V): [phi] = atan2(X_s * X - X_c * V, X_c * X + X_s * V);
    }
    "Length of a flight", "how a gap dw at the end of a flight changes its length: part of every multiplier",
    "derived here; first order in a change of the state before the flight" => {
        FLIGHT_CHANGE(w_dot_before, dw): [dtau] = -dw / w_dot_before;
    }
    "Determinant of the exact half-period map", "the product of the multipliers of half a period",
    "free flight and impact, derived here; it is r^2 exp(-eps lambda T/2)" => {
        DETERMINANT(d, r, g, g_dot): [det] = square(r) * (g_dot * (g_dot + 2.0 * d * g) + square(g));
    }
}

/// All of them in reading order.
pub fn groups(excitation: Excitation) -> impl Iterator<Item = &'static Group> + Clone {
    let steady = match excitation {
        Excitation::BaseDisplacement => BASE,
        Excitation::Force => FORCE,
    };
    [CONDITIONS, CURVE, steady, ORBITS].into_iter().flatten()
}
