//! Fixed points of the slow flow on the motions of a cavity.

use serde::Serialize;

use super::{CavityMotion, CavityTheory};
use crate::equations::dissipation::{DETERMINANT, FORCING_SQUARED, TRACE};
use crate::system::System;

/// What the slow flow depends on besides the cavity.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Forcing {
    /// `lambda = c1/(m2 omega0)`.
    pub damping: f64,
    /// `sigma`, so that the frequency ratio is `1 + eps sigma`.
    pub detuning: f64,
    /// `gamma = G/b`.
    pub forcing_per_clearance: f64,
}

impl Forcing {
    /// That of a system.
    pub fn of(system: &System) -> Self {
        Self {
            damping: system.damping(),
            detuning: system.detuning(),
            forcing_per_clearance: system.forcing_per_clearance(),
        }
    }
}

/// A steady 1:1 motion with two impacts per cycle, as the theory sees it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CavityFixedPoint {
    /// The motion of the absorber.
    pub motion: CavityMotion,
    /// Phase of the excitation against the oscillator, in `(-pi, pi]`.
    pub eta: f64,
    /// Trace of the slow flow's Jacobian, per slow time.
    pub trace: f64,
    /// Its determinant.
    pub determinant: f64,
    /// Stable in the slow flow, the motion being stable and admissible.
    pub stable: bool,
}

impl CavityTheory {
    /// All fixed points of the slow flow, by ascending absorber amplitude, inadmissible ones included: the roots of
    /// `gamma^2 = (lambda c + S)^2 + (2 sigma c - K)^2` along the motions.
    pub fn fixed_points(&self, forcing: &Forcing) -> Vec<CavityFixedPoint> {
        let Forcing { damping, detuning, forcing_per_clearance: gamma } = *forcing;
        let held = |[s, k]: [f64; 2], c: f64| FORCING_SQUARED.at([damping, detuning, s, k, c]);
        let motions = self.motions_where(|at| held(at.forces, at.amplitude) - gamma * gamma);
        motions.into_iter().map(|motion| fixed_point(forcing, motion)).collect()
    }
}

fn fixed_point(forcing: &Forcing, motion: CavityMotion) -> CavityFixedPoint {
    let Forcing { damping, detuning, .. } = *forcing;
    let CavityMotion { resistance: s, reactance: k, oscillator_amplitude: c, slopes, .. } = motion;
    let trace = TRACE.at([damping, s, slopes[0], c]);
    let determinant = DETERMINANT.at([damping, detuning, s, k, slopes[0], slopes[1], c]);
    let attracts = trace < 0.0 && determinant > 0.0;
    CavityFixedPoint {
        motion,
        eta: libm::atan2(damping * c + s, k - 2.0 * detuning * c),
        trace,
        determinant,
        stable: attracts && motion.stable && motion.admissible,
    }
}
