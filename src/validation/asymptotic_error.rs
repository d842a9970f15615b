//! The error of the asymptotics: how far the theory's boundaries lie from those of the full system.

use serde::Serialize;

use super::boundaries::{BoundaryAt, clearances, clearances_of};
use crate::analysis::{self, Analysis, Manifold};
use crate::orbits::{self, Bifurcation, FullSystem, Limit};
use crate::system::System;

/// A boundary of the theory beside its exact counterpart; clearances over the case's own.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AsymptoticError {
    /// The bifurcation of the full system.
    pub kind: Bifurcation,
    /// Where the theory puts it; `None` where it has none.
    pub theory: Option<f64>,
    /// Where it is; `None` where the full system has none.
    pub exact: Option<f64>,
    /// `theory / exact - 1`.
    pub difference: Option<f64>,
    /// Whether an attracting symmetric orbit begins or ends there, in the full system.
    pub bounds_stability: bool,
}

/// Every boundary of the case's frequency and forcing, by theory and exactly, by ascending clearance.
pub fn asymptotic_errors(analysis: &Analysis, exact: &FullSystem) -> Vec<AsymptoticError> {
    let limits = exact.boundaries.as_ref().map_or(&[][..], |found| &found.symmetric.limits);
    between(&clearances(analysis), limits)
}

/// The same at each frequency at which the exact boundaries are known, with its `Omega`; the forcing
/// is that of `system`.
pub fn errors_over_frequency(
    system: &System,
    manifold: &Manifold,
    exact: &[orbits::Boundaries],
) -> Vec<(f64, Vec<AsymptoticError>)> {
    let at_frequency = |at: &orbits::Boundaries| {
        let there = system.with_frequency_ratio(at.frequency_ratio).ok()?;
        let theory = analysis::Boundaries::of(&there, manifold);
        let theory = clearances_of(&theory, there.forcing_per_clearance());
        Some((at.frequency_ratio, between(&theory, &at.symmetric.limits)))
    };
    exact.iter().filter_map(at_frequency).collect()
}

fn between(theory: &[BoundaryAt], limits: &[Limit]) -> Vec<AsymptoticError> {
    let compared =
        |limit: &&Limit| theory.iter().any(|at| at.kind == limit.kind) || limit.bounds_stability;
    let mut errors: Vec<AsymptoticError> = limits
        .iter()
        .filter(compared)
        .map(|limit| {
            let theory = nearest(theory, limit);
            AsymptoticError {
                kind: limit.kind,
                theory,
                exact: Some(limit.clearance),
                difference: theory.map(|at| at / limit.clearance - 1.0),
                bounds_stability: limit.bounds_stability,
            }
        })
        .collect();
    for BoundaryAt { kind, clearance } in theory {
        if errors.iter().all(|error| error.theory != Some(*clearance)) {
            errors.push(AsymptoticError {
                kind: *kind,
                theory: Some(*clearance),
                exact: None,
                difference: None,
                bounds_stability: false,
            });
        }
    }
    let place = |error: &AsymptoticError| error.exact.or(error.theory).unwrap_or(0.0);
    errors.sort_by(|a, b| place(a).total_cmp(&place(b)));
    errors
}

/// Relative distance in clearance beyond which two boundaries of one kind are not counterparts.
const LARGEST_DISTANCE: f64 = 0.5;

fn nearest(theory: &[BoundaryAt], limit: &Limit) -> Option<f64> {
    let distance = |clearance: f64| libm::log(clearance / limit.clearance).abs();
    let same = theory.iter().filter(|at| at.kind == limit.kind).map(|at| at.clearance);
    let near = same.filter(|at| distance(*at) < LARGEST_DISTANCE);
    near.min_by(|a, b| distance(*a).total_cmp(&distance(*b)))
}
