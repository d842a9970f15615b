//! Claims about the boundaries around the case: where they lie.

use super::asymptotic_error::{AsymptoticError, asymptotic_errors};
use super::tolerance::{Tolerance, asymptotic_error, beyond};
use super::{Claim, Measure};
use crate::analysis::{Analysis, Boundaries, Branch};
use crate::method::Method;
use crate::orbits::{Bifurcation, FullSystem};
use crate::system::System;

/// Boundaries further than this factor in clearance are not this case's business.
const FAR: f64 = 3.0;

/// A boundary as a clearance, over the case's own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundaryAt {
    /// Which one.
    pub kind: Bifurcation,
    /// For a saddle-node: the branch on which two fixed points collide.
    pub branch: Branch,
    /// Its clearance over the case's.
    pub clearance: f64,
}

/// All boundaries at the case's frequency and forcing, by ascending clearance.
pub fn clearances(analysis: &Analysis) -> Vec<BoundaryAt> {
    clearances_of(&analysis.boundaries, analysis.system.forcing_per_clearance())
}

/// The same of boundaries at any frequency, for the forcing per clearance `gamma`.
pub fn clearances_of(boundaries: &Boundaries, gamma: f64) -> Vec<BoundaryAt> {
    let explicit = [
        (Bifurcation::SymmetryBreaking, boundaries.symmetry_breaking),
        (Bifurcation::NeimarkSacker, boundaries.hopf),
    ];
    let explicit = explicit.map(|(kind, at)| (kind, Branch::Stable, at));
    let nodes = boundaries.saddle_node.iter();
    let nodes =
        nodes.map(|node| (Bifurcation::SaddleNode, node.branch, node.forcing_over_clearance));
    let mut all: Vec<BoundaryAt> = explicit
        .into_iter()
        .chain(nodes)
        .map(|(kind, branch, at)| BoundaryAt { kind, branch, clearance: gamma / at })
        .filter(|boundary| boundary.clearance.is_finite() && boundary.clearance > 0.0)
        .collect();
    all.sort_by(|a, b| a.clearance.total_cmp(&b.clearance));
    all
}

/// Where each boundary of steady 1:1 resonance lies, against the exact one.
pub fn positions(analysis: &Analysis, exact: &FullSystem) -> Vec<Claim> {
    let error = asymptotic_error(&analysis.system);
    let tolerance = Tolerance {
        value: 2.0 * error,
        reason: format!(
            "twice ε (2 + |σ| + λ): at a boundary two conditions meet, each with that error{}",
            beyond(2.0 * error)
        ),
    };
    let near = |boundary: &AsymptoticError| {
        boundary.exact.or(boundary.theory).is_some_and(|at| (1.0 / FAR..FAR).contains(&at))
    };
    asymptotic_errors(analysis, exact)
        .into_iter()
        .filter(|boundary| boundary.bounds_stability && near(boundary))
        .filter_map(|boundary| {
            let id = format!("boundary-{}", boundary.kind.words().replace([' ', '–'], "-"));
            Some(Claim::of_number(
                [id, format!("clearance of the {} boundary", name(boundary.kind))],
                "boundaries of the slow flow",
                [boundary.theory?, boundary.exact?],
                Measure::LengthOverClearance,
                Method::ExactOrbit,
                tolerance.clone(),
            ))
        })
        .collect()
}

/// Both names where theory and full system differ in theirs.
fn name(kind: Bifurcation) -> &'static str {
    match kind {
        Bifurcation::NeimarkSacker => "Hopf (Neimark–Sacker)",
        other => other.words(),
    }
}

/// Relative distance to either side of a boundary at which the theory is asked what it separates:
/// close enough that no other boundary lies between, except exactly at P1.
pub const EITHER_SIDE: f64 = 1e-4;

/// Whether theory has a stable 1:1 motion on exactly one side of a clearance.
pub fn ends_steady_resonance(system: &System, clearance: f64) -> bool {
    let steady = |factor: f64| {
        let there = system.with_clearance_scaled(clearance * factor).ok()?;
        Some(Analysis::of(&there).ok()?.stable_points().next().is_some())
    };
    steady(1.0 - EITHER_SIDE) != steady(1.0 + EITHER_SIDE)
}
