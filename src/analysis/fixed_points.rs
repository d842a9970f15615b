//! Fixed points of the slow flow (18) on the manifold, with a certified count.
//!
//! They are the roots `beta = B/b > 0` of a quartic, solved in `u = beta - 1`, which keeps the
//! accuracy of `R` near the fold. The Jacobian of the flow in `(B, eta)` gives their stability
//! within the slow flow; a point is a stable motion when it also lies on the manifold's stable
//! branch.

use serde::Serialize;

use super::AnalysisError;
use super::manifold::{Branch, Manifold};
use crate::equations::{Stability, equations};
use crate::numerics::polynomial::{CertifiedRoot, roots_above};
use crate::symbolic::Symbol;
use crate::system::System;

/// Rounding allowed to a motion that touches the wall between impacts.
const CAVITY_ROUNDING: f64 = 1e-12;

/// What the linearised slow flow does around a fixed point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// Real multipliers of one sign.
    Node,
    /// A complex pair.
    Focus,
    /// Real multipliers of both signs.
    Saddle,
    /// At the fold or at a collision the linearisation says nothing.
    Degenerate,
}

impl Kind {
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
pub struct FixedPoint {
    /// `B/b`.
    #[serde(rename = "B")]
    pub absorber: f64,
    /// `C/b`.
    #[serde(rename = "C")]
    pub oscillator: f64,
    /// Phase of the excitation against the oscillator, in `(-pi, pi]`.
    pub eta: f64,
    /// Phase of the absorber against the oscillator.
    #[serde(rename = "Theta")]
    pub absorber_phase: f64,
    /// Where on the manifold.
    pub branch: Branch,
    /// Trace of the slow flow's Jacobian, per slow time.
    pub trace: f64,
    /// Its determinant.
    pub determinant: f64,
    /// What the slow flow does nearby.
    pub kind: Kind,
    /// Stable in the slow flow and on the stable branch.
    pub stable: bool,
    /// Larger of the two rates of (18) at the point, each over the sum of its terms' absolute
    /// values.
    pub residual: f64,
    /// Largest `abs(w0)/b` between impacts.
    pub largest_relative_displacement: f64,
    /// Whether the absorber stays in its cavity between impacts.
    pub admissible: bool,
    /// Whether the root is a double one: two fixed points are just colliding.
    pub double: bool,
    /// `B/b - 1` to full relative accuracy.
    #[serde(skip)]
    pub shift: f64,
    /// Width of the certified enclosure of `B/b`.
    pub enclosure: f64,
}

/// All fixed points with `B > 0`, by ascending `B`.
///
/// # Errors
/// [`AnalysisError::Condition`] when the quartic's coefficients overflow.
pub fn solve(system: &System, manifold: &Manifold) -> Result<Vec<FixedPoint>, AnalysisError> {
    if system.forcing_per_clearance() == 0.0 {
        // Without forcing nothing keeps a motion going; the quartic is a sum of two squares.
        return Ok(Vec::new());
    }
    let programs = &equations().programs;
    let coefficients = programs.fixed_point_coefficients(&programs.values(system))?;
    roots_above(&coefficients, -1.0)?
        .iter()
        // For elastic impacts the condition, multiplied by C^2, also vanishes where C does: there
        // the oscillator does not move, and (18) does not hold.
        .filter(|root| manifold.point(root.at).oscillator > 0.0)
        .map(|root| point(system, manifold, root))
        .collect()
}

fn point(
    system: &System,
    manifold: &Manifold,
    root: &CertifiedRoot,
) -> Result<FixedPoint, AnalysisError> {
    let programs = &equations().programs;
    let shift = root.at;
    let at = programs.at_shift(&programs.values(system), shift)?;
    let eta = programs.excitation_phase(&at)?;
    let Stability { trace, determinant, .. } =
        programs.stability(&at.with(Symbol::ExcitationPhase, eta))?;
    let branch = manifold.branch(shift);
    let largest = manifold.largest_relative_displacement(shift);
    let attracts = trace < 0.0 && determinant > 0.0;
    Ok(FixedPoint {
        absorber: 1.0 + shift,
        oscillator: manifold.point(shift).oscillator,
        eta,
        absorber_phase: manifold.absorber_phase(shift),
        branch,
        trace,
        determinant,
        kind: Kind::of(trace, determinant),
        stable: attracts && branch == Branch::Stable,
        residual: residual(system, manifold, shift, eta),
        largest_relative_displacement: largest,
        admissible: largest <= 1.0 + CAVITY_ROUNDING,
        double: root.touching,
        shift,
        enclosure: root.upper - root.lower,
    })
}

/// The rates of (18) at a point, written out term by term, over the sizes of their terms. This is
/// on purpose not the derived quartic: it checks it.
fn residual(system: &System, manifold: &Manifold, shift: f64, eta: f64) -> f64 {
    let point = manifold.point(shift);
    let theta = manifold.absorber_phase(shift);
    let harmonic = 8.0 * point.absorber / (std::f64::consts::PI * std::f64::consts::PI);
    let gamma = system.forcing_per_clearance();
    let amplitude_terms = [
        -system.damping() * point.oscillator,
        -harmonic * libm::sin(theta),
        gamma * libm::sin(eta),
    ];
    let phase_terms = [
        2.0 * system.detuning() * point.oscillator,
        gamma * libm::cos(eta),
        -harmonic * libm::cos(theta),
    ];
    [amplitude_terms, phase_terms]
        .map(|terms| {
            let size: f64 = terms.iter().map(|term| term.abs()).sum();
            terms.iter().sum::<f64>().abs() / size.max(f64::MIN_POSITIVE)
        })
        .into_iter()
        .fold(0.0, f64::max)
}
