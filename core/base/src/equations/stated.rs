//! The equations as they are given.
//!
//! Numbers are those of Li, Seguy, Berlioz, "On the dynamics around targeted energy transfer for
//! vibro-impact nonlinear energy sink", Nonlinear Dynamics (2016). An equation without a number is
//! a definition, or derived beyond the paper and then says so in its source.

use std::f64::consts::PI;

use crate::symbolic::{cos, equations, sin, square};

const DEFINITION: &str = "definition";
const FREE: &str = "paper (1); exact while |w| < b";
const IMPACTS_14: &str =
    "paper (14); first order in epsilon, 1:1 resonance, two symmetric impacts per cycle";
const IMPACTS_15: &str =
    "paper (15); first order in epsilon, 1:1 resonance, two symmetric impacts per cycle";
const SLOW: &str = "paper (18); first order in epsilon, near 1:1 resonance";
const PAIR: &str = "impact pair at order 0, derived here; two symmetric impacts per cycle";

equations! {
    /// (1) if the base moves.
    MOTION_OF_BASE_GROUP =
    "Motion between impacts, the base moving", "the motion that is simulated when the base moves", FREE => {
        MOTION_OF_BASE(eps, lambda, Omega, G, tau): [x_dot_dot + eps * lambda * x_dot + x]
            = eps * G * sin(Omega * tau) + square(eps) * lambda * Omega * G * cos(Omega * tau);
    }
}

equations! {
    /// (1) if a force acts on the oscillator.
    MOTION_BY_FORCE_GROUP =
    "Motion between impacts, a force acting on the oscillator", "the motion that is simulated when a force acts",
    "paper (1) without the damper's share of the excitation; exact while |w| < b" => {
        MOTION_BY_FORCE(eps, Omega, G, tau): [x_dot_dot + eps * lambda * x_dot + x] = eps * G * sin(Omega * tau);
    }
}

equations! {
    /// What holds for either excitation.
    GROUPS =
    "Motion of the absorber between impacts", "a straight line between impacts", FREE => {
        ABSORBER_MOTION(): [y_dot_dot] = 0.0;
    }
    "Restitution at an impact", "the velocity after an impact",
    "paper (2), (5); where |w| = b, with the momentum conserved" => {
        RESTITUTION(r, w_dot_before): [w_dot_after] = -r * w_dot_before;
    }
    "Reduced forcing", "the size of the excitation", DEFINITION => {
        REDUCED_FORCING(eps, F): [G] = F / eps;
    }
    "Forcing per clearance", "the one measure of excitation against clearance", DEFINITION => {
        FORCING_PER_CLEARANCE(G, b): [gamma] = G / b;
    }
    "Detuning", "how far the excitation is from resonance", "paper (7)" => {
        FREQUENCY_RATIO(eps, sigma): [Omega] = 1.0 + eps * sigma;
    }
    "Restitution ratio", "the loss at an impact", DEFINITION => {
        RESTITUTION_RATIO(r): [rho] = (1.0 - r) / (1.0 + r);
    }
    "Curvature of the manifold", "the shape of the manifold", DEFINITION => {
        CURVATURE(rho): [R] = 4.0 * square(rho) / square(PI);
    }
    "Position at an impact", "one relation of the amplitudes at an impact", IMPACTS_14 => {
        IMPACT_POSITION(b, B): [C * cos(Theta)] = b - B;
    }
    "Velocities at an impact", "the other relation of the amplitudes at an impact", IMPACTS_15 => {
        IMPACT_VELOCITIES(r, B): [(1.0 + r) * C * sin(Theta)] = 2.0 / PI * (1.0 - r) * B;
    }
    "First harmonic of the sawtooth", "the absorber's action on the oscillator",
    "Fourier series of (2/pi) B Pi, derived here; exact for two symmetric impacts per cycle" => {
        FIRST_HARMONIC(B): [E] = 8.0 / square(PI) * B;
    }
    "Slow rate of the oscillator's amplitude", "growth or decay of the oscillator's motion", SLOW => {
        AMPLITUDE_RATE(lambda, G, C, E, Theta, eta): [D1_C]
            = -lambda * C / 2.0 - E * sin(Theta) / 2.0 + G * sin(eta) / 2.0;
    }
    "Slow rate of the excitation's phase", "drift of the phase against the excitation", SLOW => {
        PHASE_RATE(sigma, G, C, E, Theta, eta): [D1_eta]
            = G * cos(eta) / (2.0 * C) - E * cos(Theta) / (2.0 * C) + sigma;
    }
    "Half-period map of the impact pair", "stability of the impacts at order 0", PAIR => {
        IMPACT_FACTOR(r, C, Theta): [k] = PI * (1.0 - r) / (2.0 * C * sin(Theta));
        PAIR_TRACE(r, C, k, Theta): [tr] = 2.0 * r + (1.0 + r) * k * C * cos(Theta);
        PAIR_DETERMINANT(r): [det] = square(r);
    }
    "Absorber amplitude per clearance", "the one unknown of a fixed point", DEFINITION => {
        AMPLITUDE_RATIO(b, B): [beta] = B / b;
    }
    "Amplitude beyond the clearance", "a small difference that the formulas keep exact", DEFINITION => {
        SHIFT(beta): [u] = beta - 1.0;
    }
}
