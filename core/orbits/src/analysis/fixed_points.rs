//! Fixed points of the slow flow (18) on the manifold, in closed form: at most two.
//!
//! [`FixedPointCurve`] has their amplitudes. Trace and determinant of the flow's Jacobian give their
//! stability within the slow flow; a point is a stable motion when it also lies on the manifold's
//! stable branch.

use std::f64::consts::FRAC_2_PI;

use serde::Serialize;

use super::AnalysisError;
use super::ManifoldPoint;
use super::curve::{Amplitude, FixedPointCurve};
use super::manifold::{CAVITY_ROUNDING, Manifold, ManifoldBranch};
use crate::equations::fixed_points::{COSINE_SIDE, SINE_SIDE};
use crate::equations::manifold::MANIFOLD_SQUARE;
use crate::equations::slow_flow::{DETERMINANT, TRACE};
use crate::equations::stated::FIRST_HARMONIC;
use crate::operation_count;
use crate::system::System;

/// What the linearised slow flow does around a fixed point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FixedPointKind {
    /// Real multipliers of one sign.
    Node,
    /// A complex pair.
    Focus,
    /// Real multipliers of both signs.
    Saddle,
    /// At the fold or at a collision the linearisation says nothing.
    Degenerate,
}

impl FixedPointKind {
    /// The name in a report.
    pub fn words(self) -> &'static str {
        match self {
            Self::Node => "node",
            Self::Focus => "focus",
            Self::Saddle => "saddle",
            Self::Degenerate => "degenerate",
        }
    }

    fn of(trace: f64, determinant: f64) -> Self {
        let discriminant = trace * trace - 4.0 * determinant;
        if !discriminant.is_finite() || determinant == 0.0 {
            Self::Degenerate
        } else if determinant < 0.0 {
            Self::Saddle
        } else if discriminant < 0.0 {
            Self::Focus
        } else {
            Self::Node
        }
    }
}

/// A fixed point: a steady 1:1 motion as the theory sees it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct FixedPoint {
    /// `B/b`.
    #[serde(rename = "B")]
    pub absorber_amplitude: f64,
    /// `C/b`.
    #[serde(rename = "C")]
    pub oscillator_amplitude: f64,
    /// Phase of the excitation against the oscillator, in `(-pi, pi]`.
    pub eta: f64,
    /// Phase of the absorber against the oscillator.
    #[serde(rename = "Theta")]
    pub absorber_phase: f64,
    /// Where on the manifold.
    pub branch: ManifoldBranch,
    /// Trace of the slow flow's Jacobian, per slow time.
    pub trace: f64,
    /// Its determinant.
    pub determinant: f64,
    /// What the slow flow does nearby.
    pub kind: FixedPointKind,
    /// Stable in the slow flow and on the stable branch.
    pub stable: bool,
    /// Larger of the two rates of (18) at the point, each over the sum of its terms' absolute
    /// values.
    pub residual: f64,
    /// Largest `abs(w0)/b` between impacts.
    pub largest_relative_displacement: f64,
    /// Whether the absorber stays in its cavity between impacts.
    pub admissible: bool,
    /// `gamma / gamma_SN - 1`, how far the forcing is above the collision of the two fixed points: where
    /// it is small, nothing else about them is known as well. `None` without a collision.
    pub above_collision: Option<f64>,
    /// `B/b - 1`.
    #[serde(skip)]
    pub shift: f64,
}

/// All fixed points with `B > 0`, by ascending `B`.
///
/// # Errors
/// [`AnalysisError`] when a coefficient of the quadratic overflows.
pub fn solve(system: &System, manifold: &Manifold) -> Result<Vec<FixedPoint>, AnalysisError> {
    let curve = FixedPointCurve::of(system, manifold);
    let gamma = system.forcing_per_clearance();
    if !curve.coefficients.iter().chain([&(gamma * gamma)]).all(|one| one.is_finite()) {
        return Err(AnalysisError);
    }
    let above = curve.collision().map(|(collision, _)| (gamma - collision) / collision);
    let point = |at| FixedPoint { above_collision: above, ..point(system, manifold, at) };
    Ok(curve.fixed_points(gamma).map(point).collect())
}

fn point(
    system: &System,
    manifold: &Manifold,
    Amplitude { ratio, half_slope }: Amplitude,
) -> FixedPoint {
    operation_count::note(operation_count::ELEMENTARY + 4);
    let (lambda, sigma) = (system.damping(), system.detuning());
    let (rho, curvature) = (manifold.restitution_ratio, manifold.curvature);
    let shift = ratio - 1.0;
    let square = MANIFOLD_SQUARE.at([curvature, shift]);
    let sides =
        [SINE_SIDE.at([lambda, rho, ratio, square]), COSINE_SIDE.at([sigma, ratio, shift, square])];
    let trace = TRACE.at([lambda, rho, curvature, ratio, shift]);
    let larger = DETERMINANT.at([curvature, ratio, shift, half_slope * half_slope]);
    let determinant = larger.copysign(larger * half_slope);
    let oscillator = square.sqrt();
    let eta = libm::atan2(sides[0], sides[1]);
    let absorber_phase = manifold.absorber_phase(ratio, shift);
    let branch = manifold.branch(shift);
    let largest = Manifold::largest_relative_displacement(
        ManifoldPoint { absorber_amplitude: ratio, oscillator_amplitude: oscillator },
        absorber_phase,
    );
    let attracts = trace < 0.0 && determinant > 0.0;
    FixedPoint {
        absorber_amplitude: ratio,
        oscillator_amplitude: oscillator,
        eta,
        absorber_phase,
        branch,
        trace,
        determinant,
        kind: FixedPointKind::of(trace, determinant),
        stable: attracts && branch == ManifoldBranch::Stable,
        residual: residual(system, manifold, [ratio, oscillator], sides),
        largest_relative_displacement: largest,
        admissible: largest <= 1.0 + CAVITY_ROUNDING,
        above_collision: None,
        shift,
    }
}

/// The rates of (18) at a point, written out term by term, over the sizes of their terms; the sine and cosine
/// of `Theta` are those of (14) and (15), that of `eta` follows from its `sides`. This is on purpose not the
/// derived quadratic: it checks it.
fn residual(
    system: &System,
    manifold: &Manifold,
    [ratio, oscillator]: [f64; 2],
    [sine, cosine]: [f64; 2],
) -> f64 {
    operation_count::note(30);
    let harmonic = FIRST_HARMONIC.at([ratio]) / oscillator;
    let gamma = system.forcing_per_clearance() / libm::hypot(sine, cosine);
    let amplitude = [
        -system.damping() * oscillator,
        -harmonic * FRAC_2_PI * manifold.restitution_ratio * ratio,
        gamma * sine,
    ];
    let phase = [2.0 * system.detuning() * oscillator, gamma * cosine, -harmonic * (1.0 - ratio)];
    let relative = |terms: [f64; 3]| {
        let size: f64 = terms.iter().map(|term| term.abs()).sum();
        terms.iter().sum::<f64>().abs() / size.max(f64::MIN_POSITIVE)
    };
    relative(amplitude).max(relative(phase))
}
