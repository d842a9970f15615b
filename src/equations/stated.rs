//! The equations as they are given, each exactly once.
//!
//! Numbers are those of Li, Seguy, Berlioz, "On the dynamics around targeted energy transfer for
//! vibro-impact nonlinear energy sink", Nonlinear Dynamics (2016). An equation without a number is
//! a definition, or derived beyond the paper and then says so in its source. The sawtooth's phase,
//! which the paper also calls `eta`, is `zeta` here, as in (17).

use crate::symbolic::Symbol::{
    self, AbsorberAmplitude as B, AbsorberPhase as Theta, AmplitudeRate, AmplitudeRatio as beta,
    BaseAmplitude as F, Clearance as b, CosineLength as s, Damping as lambda, Determinant,
    Detuning as sigma, ExcitationPhase as eta, FastTime as tau, FirstHarmonic as E,
    ForcingPerClearance as gamma, FrequencyRatio as Omega, ImpactFactor as k,
    ManifoldCurvature as R, MassRatio as epsilon, OscillatorAmplitude as C,
    OscillatorPhase as theta, PhaseRate, Pi as pi, ReducedForcing as G, Restitution as r,
    RestitutionRatio as rho, SawtoothPhase as zeta, Shift as u, SineLength as c, Trace, WDotAfter,
    WDotBefore, X as x, XDot, XDotDot, YDotDot,
};
use crate::symbolic::{Equation, Expr, cos, fraction, sin};

const FIRST_ORDER: &str = "first order in epsilon, 1:1 resonance, two symmetric impacts per cycle";

/// Every equation that the program starts from.
#[derive(Debug, Clone)]
pub struct Stated {
    /// (1) for motion of the base.
    pub motion_of_base: Equation,
    /// (1) for a force on the oscillator.
    pub motion_by_force: Equation,
    /// (1), second line.
    pub absorber_motion: Equation,
    /// (2) in the relative displacement.
    pub restitution: Equation,
    /// The reduced forcing.
    pub reduced_forcing: Equation,
    /// (7).
    pub detuning: Equation,
    /// (14).
    pub impact_position: Equation,
    /// (15).
    pub impact_velocity: Equation,
    /// `rho`.
    pub restitution_ratio: Equation,
    /// `R`.
    pub curvature: Equation,
    /// (16) as the paper prints it; what the program uses is derived from (14) and (15).
    pub manifold: Equation,
    /// `E`, derived beyond the paper.
    pub first_harmonic: Equation,
    /// (18), first line.
    pub amplitude_rate: Equation,
    /// (18), second line.
    pub phase_rate: Equation,
    /// (19), first line.
    pub absorber_phase: Equation,
    /// `gamma`.
    pub forcing_per_clearance: Equation,
    /// `beta`.
    pub amplitude_ratio: Equation,
    /// `u`.
    pub shift: Equation,
    /// `s`, used by the trace.
    pub cosine_length: Equation,
    /// `c`, used by the trace.
    pub sine_length: Equation,
    /// `k`, used by the trace.
    pub impact_factor: Equation,
    /// Trace of the half-period map, derived beyond the paper.
    pub trace: Equation,
    /// Determinant of the half-period map, derived beyond the paper.
    pub determinant: Equation,
}

pub(super) fn equation(
    number: Option<&'static str>,
    name: &'static str,
    left: impl Into<Expr>,
    right: impl Into<Expr>,
    source: &'static str,
) -> Equation {
    Equation { number, name, left: left.into(), right: right.into(), source }
}

pub(super) fn definition(name: &'static str, symbol: Symbol, right: impl Into<Expr>) -> Equation {
    equation(None, name, symbol, right, "definition")
}

impl Stated {
    /// States them.
    pub fn new() -> Self {
        let oscillator = XDotDot + epsilon * lambda * XDot + x;
        let spring_force = epsilon * G * sin(Omega * tau);
        let damper_force = epsilon.squared() * lambda * G * Omega * cos(Omega * tau);
        Self {
            motion_of_base: equation(
                Some("(1)"),
                "Motion between impacts, the base moving",
                oscillator.clone(),
                &spring_force + damper_force,
                "paper (1); exact while |w| < b",
            ),
            motion_by_force: equation(
                None,
                "Motion between impacts, a force acting on the oscillator",
                oscillator,
                spring_force,
                "paper (1) without the damper's share of the excitation; exact while |w| < b",
            ),
            absorber_motion: equation(
                Some("(1)"),
                "Motion of the absorber between impacts",
                YDotDot,
                0,
                "paper (1); exact while |w| < b",
            ),
            restitution: equation(
                Some("(2)"),
                "Restitution at an impact",
                WDotAfter,
                -r * WDotBefore,
                "paper (2), (5); where |w| = b, with the momentum conserved",
            ),
            reduced_forcing: definition("Reduced forcing", G, F / epsilon),
            detuning: equation(Some("(7)"), "Detuning", Omega, 1 + epsilon * sigma, "paper (7)"),
            impact_position: equation(
                Some("(14)"),
                "Position at an impact",
                C * cos(Theta),
                b - B,
                FIRST_ORDER,
            ),
            impact_velocity: equation(
                Some("(15)"),
                "Velocities at an impact",
                C * (1 + r) * sin(Theta),
                2 / Expr::from(pi) * B * (1 - r),
                FIRST_ORDER,
            ),
            restitution_ratio: definition("Restitution ratio", rho, (1 - r) / (1 + r)),
            curvature: definition("Curvature of the manifold", R, 4 * rho.squared() / pi.squared()),
            manifold: equation(
                Some("(16)"),
                "Slow invariant manifold",
                C.squared(),
                (1 + 4 * (1 - r).squared() / (pi.squared() * (1 + r).squared())) * B.squared()
                    - 2 * b * B
                    + b.squared(),
                "paper (16), to compare with what (14) and (15) give",
            ),
            first_harmonic: equation(
                None,
                "First harmonic of the sawtooth",
                E,
                8 * B / pi.squared(),
                "Fourier series of (2/pi) B Pi, derived here; exact for two symmetric impacts per cycle",
            ),
            amplitude_rate: equation(
                Some("(18)"),
                "Slow rate of the oscillator's amplitude",
                AmplitudeRate,
                fraction(-1, 2) * lambda * C - fraction(1, 2) * E * sin(Theta)
                    + fraction(1, 2) * G * sin(eta),
                "paper (18); first order in epsilon, near 1:1 resonance",
            ),
            phase_rate: equation(
                Some("(18)"),
                "Slow rate of the excitation's phase",
                PhaseRate,
                fraction(1, 2) * G * cos(eta) / C - fraction(1, 2) * E * cos(Theta) / C + sigma,
                "paper (18); first order in epsilon, near 1:1 resonance",
            ),
            absorber_phase: equation(
                Some("(19)"),
                "Phase of the absorber",
                Theta,
                zeta - theta,
                "paper (19)",
            ),
            forcing_per_clearance: definition("Forcing per clearance", gamma, G / b),
            amplitude_ratio: definition("Absorber amplitude per clearance", beta, B / b),
            shift: definition("Amplitude beyond the clearance", u, beta - 1),
            cosine_length: definition("Cosine length", s, C * cos(Theta)),
            sine_length: definition("Sine length", c, C * sin(Theta)),
            impact_factor: definition("Impact factor", k, pi * (1 - r) / (2 * c)),
            trace: equation(
                None,
                "Trace of the half-period map",
                Trace,
                2 * r + (1 + r) * s * k,
                "impact pair at order 0, derived here; two symmetric impacts per cycle",
            ),
            determinant: equation(
                None,
                "Determinant of the half-period map",
                Determinant,
                r.squared(),
                "impact pair at order 0, derived here; two symmetric impacts per cycle",
            ),
        }
    }
}

impl Default for Stated {
    fn default() -> Self {
        Self::new()
    }
}
