//! Claims about the boundaries nearest to the case: the regime must change across them.

use super::tolerance::{asymptotic_error, outcome};
use super::{Claim, Finding, Verdict};
use crate::analysis::motion::state_of;
use crate::analysis::{Analysis, BoundaryKind, Branch, FixedPoint};
use crate::regimes::attractor::Effort;
use crate::regimes::{Attractor, Regime};
use crate::simulation::StartError;
use crate::system::System;

/// Boundaries further than this factor in clearance are not this case's business.
const FAR: f64 = 3.0;

/// A boundary as a clearance, over the case's own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundaryAt {
    /// Which one.
    pub kind: BoundaryKind,
    /// For a saddle-node: the branch on which two fixed points collide.
    pub branch: Branch,
    /// Its clearance over the case's.
    pub clearance: f64,
}

/// All boundaries at the case's frequency and forcing, by ascending clearance.
pub fn clearances(analysis: &Analysis) -> Vec<BoundaryAt> {
    let gamma = analysis.system.forcing_per_clearance();
    let explicit = [
        (BoundaryKind::SymmetryBreaking, analysis.boundaries.symmetry_breaking),
        (BoundaryKind::Hopf, analysis.boundaries.hopf),
    ];
    let explicit = explicit.map(|(kind, at)| (kind, Branch::Stable, at));
    let nodes = analysis.boundaries.saddle_nodes.iter();
    let nodes =
        nodes.map(|node| (BoundaryKind::SaddleNode, node.branch, node.forcing_over_clearance));
    let mut all: Vec<BoundaryAt> = explicit
        .into_iter()
        .chain(nodes)
        .map(|(kind, branch, at)| BoundaryAt { kind, branch, clearance: gamma / at })
        .filter(|boundary| boundary.clearance.is_finite() && boundary.clearance > 0.0)
        .collect();
    all.sort_by(|a, b| a.clearance.total_cmp(&b.clearance));
    all
}

/// One claim for the nearest boundary below the case's clearance and one for the nearest above, of
/// those that a single trajectory can decide: where steady 1:1 resonance begins or ends.
pub fn either_side(analysis: &Analysis, effort: &Effort) -> Result<Vec<Claim>, StartError> {
    let decidable: Vec<BoundaryAt> = clearances(analysis)
        .into_iter()
        .filter(|at| (1.0 / FAR..FAR).contains(&at.clearance))
        .filter(|at| ends_steady_resonance(&analysis.system, at.clearance))
        .collect();
    let below = decidable.iter().rfind(|at| at.clearance <= 1.0);
    let above = decidable.iter().find(|at| at.clearance > 1.0);
    below
        .into_iter()
        .chain(above)
        .filter_map(|at| across(analysis, at, effort).transpose())
        .collect()
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

/// Simulates a little below and a little above a boundary, from the motion that the theory predicts
/// there, or from the last one that it predicts.
fn across(
    analysis: &Analysis,
    at: &BoundaryAt,
    effort: &Effort,
) -> Result<Option<Claim>, StartError> {
    // The boundary itself may be off by the theory's error; twice that must be past it.
    let margin = (2.0 * asymptotic_error(&analysis.system)).min(0.5);
    let sides = [1.0 - margin, 1.0 + margin]
        .map(|factor| analysis.system.with_clearance_scaled(at.clearance * factor).ok())
        .map(|system| system.and_then(|system| Analysis::of(&system).ok()));
    let [Some(before), Some(beyond)] = &sides else { return Ok(None) };
    let (Some(below), Some(above)) =
        (reached_regime(before, beyond, effort)?, reached_regime(beyond, before, effort)?)
    else {
        return Ok(None);
    };
    let steady_above = beyond.stable_points().next().is_some();
    let words = |regime: Regime| regime.short().to_owned();
    let name = |steady: bool| if steady { "steady 1:1" } else { "not steady 1:1" };
    let holds = (below == Regime::TwoSymmetric) != steady_above
        && (above == Regime::TwoSymmetric) == steady_above;
    Ok(Some(Claim {
        id: format!("boundary-{}", at.kind.words().replace(' ', "-")),
        statement: format!(
            "{} boundary: what the predicted motion becomes on either side",
            at.kind.words()
        ),
        source: "boundaries of the slow flow",
        predicted: Finding::Words(format!(
            "{} below, {} above",
            name(!steady_above),
            name(steady_above)
        )),
        observed: Finding::Words(format!("{} below, {} above", words(below), words(above))),
        difference: None,
        tolerance: outcome(format!(
            "started on the predicted motion, {:.1} % to either side: twice ε (2 + |σ| + λ)",
            100.0 * margin
        )),
        verdict: Verdict::of(holds),
    }))
}

/// What a start on the predicted steady motion becomes; where theory predicts none, on the one that
/// it predicts at the other side of the boundary.
fn reached_regime(
    here: &Analysis,
    other_side: &Analysis,
    effort: &Effort,
) -> Result<Option<Regime>, StartError> {
    let Some(start) = most_nearly_stable(here).or_else(|| most_nearly_stable(other_side)) else {
        return Ok(None);
    };
    let reached = Attractor::reach(&here.system, state_of(start, &here.system), effort)?;
    Ok(Some(reached.classification.regime))
}

/// A stable fixed point, else the one with the largest amplitude.
fn most_nearly_stable(analysis: &Analysis) -> Option<&FixedPoint> {
    analysis.stable_points().last().or_else(|| analysis.fixed_points.last())
}
