//! Fixed points of the slow flow (18) on the manifold, with a certified count.
//!
//! They are the roots `beta = B/b > 0` of a quartic, solved in `u = beta - 1`, which keeps the
//! accuracy of `R` near the fold; small ones in `beta` itself, which keeps that of a tiny forcing. The Jacobian of the flow in `(B, eta)` gives their stability
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
    amplitudes(system)?
        .iter()
        // For elastic impacts the condition, multiplied by C^2, also vanishes where C does: there
        // the oscillator does not move, and (18) does not hold.
        .filter(|amplitude| manifold.point(amplitude.shift).oscillator > 0.0)
        .map(|amplitude| point(system, manifold, amplitude))
        .collect()
}

/// A root of the condition: `beta` and `u = beta - 1`, each to full relative accuracy where it is
/// the small one.
#[derive(Debug, Clone, Copy)]
struct Amplitude {
    ratio: f64,
    shift: f64,
    enclosure: f64,
    double: bool,
}

/// Where roots in `beta` hand over to roots in `u`. Four roots cannot crowd out five seams.
const SEAMS: [f64; 5] = [0.5, 0.4, 0.6, 0.45, 0.55];
/// Distance of every root from the seam, far above rounding, so that none is lost or counted twice.
const SEAM_MARGIN: f64 = 1e-3;

fn amplitudes(system: &System) -> Result<Vec<Amplitude>, AnalysisError> {
    let programs = &equations().programs;
    let values = programs.values(system);
    let of = |root: &CertifiedRoot, ratio, shift| {
        let enclosure = root.upper - root.lower;
        Amplitude { ratio, shift, enclosure, double: root.touching }
    };
    let by_ratio = roots_above(&programs.fixed_point_coefficients_by_ratio(&values)?, 0.0)?;
    let by_shift = roots_above(&programs.fixed_point_coefficients(&values)?, -1.0)?;
    let small: Vec<Amplitude> = by_ratio.iter().map(|r| of(r, r.at, r.at - 1.0)).collect();
    let large: Vec<Amplitude> = by_shift.iter().map(|r| of(r, 1.0 + r.at, r.at)).collect();
    let clear = |seam: &f64| {
        small.iter().chain(&large).all(|amplitude| (amplitude.ratio - seam).abs() > SEAM_MARGIN)
    };
    let seam = SEAMS.into_iter().find(clear).unwrap_or(SEAMS[0]);
    let below = small.iter().filter(|amplitude| amplitude.ratio < seam);
    Ok(below.chain(large.iter().filter(|amplitude| amplitude.ratio >= seam)).copied().collect())
}

/// Newton steps on `gamma^2(beta)` as a sum of squares, not expanded into powers: near a collision
/// with little forcing the expanded quartic loses digits that this form keeps.
fn polished(system: &System, amplitude: Amplitude) -> Result<Amplitude, AnalysisError> {
    let programs = &equations().programs;
    let values = programs.values(system);
    let gamma = system.forcing_per_clearance();
    let excess = |change: f64| -> Result<f64, AnalysisError> {
        let at = programs.at_shift(&values, amplitude.shift + change)?;
        let at = at.with(Symbol::AmplitudeRatio, amplitude.ratio + change);
        Ok(programs.forcing_squared(&at)? - gamma * gamma)
    };
    // Wide enough for a difference, small beside the distance of any two roots that were isolated.
    let width = 1e-7 * amplitude.ratio.min(1.0);
    let slope = (excess(width)? - excess(-width)?) / (2.0 * width);
    let mut best = (0.0, excess(0.0)?);
    for _ in 0..2 {
        let change = best.0 - best.1 / slope;
        // At a double root the slope vanishes, and the isolated root is all there is.
        if change.is_nan() || change.abs() > width {
            break;
        }
        let value = excess(change)?;
        if value.abs() < best.1.abs() {
            best = (change, value);
        }
    }
    let (ratio, shift) = (amplitude.ratio + best.0, amplitude.shift + best.0);
    Ok(Amplitude { ratio, shift, ..amplitude })
}

fn point(
    system: &System,
    manifold: &Manifold,
    amplitude: &Amplitude,
) -> Result<FixedPoint, AnalysisError> {
    let programs = &equations().programs;
    let amplitude = &polished(system, *amplitude)?;
    let Amplitude { ratio, shift, enclosure, double } = *amplitude;
    let at = programs.at_shift(&programs.values(system), shift)?;
    let at = at.with(Symbol::AmplitudeRatio, ratio);
    let eta = programs.excitation_phase(&at)?;
    let Stability { trace, determinant, .. } =
        programs.stability(&at.with(Symbol::ExcitationPhase, eta))?;
    let branch = manifold.branch(shift);
    let largest = manifold.largest_relative_displacement(shift);
    let attracts = trace < 0.0 && determinant > 0.0;
    Ok(FixedPoint {
        absorber: ratio,
        oscillator: manifold.point(shift).oscillator,
        eta,
        absorber_phase: manifold.absorber_phase(ratio, shift),
        branch,
        trace,
        determinant,
        kind: Kind::of(trace, determinant),
        stable: attracts && branch == Branch::Stable,
        residual: residual(system, manifold, amplitude, eta),
        largest_relative_displacement: largest,
        admissible: largest <= 1.0 + CAVITY_ROUNDING,
        double,
        shift,
        enclosure,
    })
}

/// The rates of (18) at a point, written out term by term, over the sizes of their terms. This is
/// on purpose not the derived quartic: it checks it.
fn residual(system: &System, manifold: &Manifold, amplitude: &Amplitude, eta: f64) -> f64 {
    let Amplitude { ratio, shift, .. } = *amplitude;
    let point = manifold.point(shift);
    let theta = manifold.absorber_phase(ratio, shift);
    let harmonic = 8.0 * ratio / (std::f64::consts::PI * std::f64::consts::PI);
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
