//! The error of the asymptotics: how far the theory's boundaries lie from those of the full system.

use serde::Serialize;

use super::clearances::{BoundaryAt, clearances, clearances_of};
use crate::analysis::{self, Analysis, AsymmetricLimits, Manifold};
use crate::orbits::{self, Bifurcation, FullSystem};
use crate::system::System;

/// A boundary of the theory beside its exact counterpart; clearances over the case's own.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AsymptoticError {
    /// The bifurcation of the full system.
    pub kind: Bifurcation,
    /// Whether it ends the two asymmetric impacts, not the symmetric ones.
    pub of_asymmetric: bool,
    /// Where the theory puts it; `None` where it has none.
    pub theory: Option<f64>,
    /// Where it is; `None` where the full system has none.
    pub exact: Option<f64>,
    /// `theory / exact - 1`.
    pub difference: Option<f64>,
    /// Whether an attracting symmetric orbit begins or ends there, in the full system.
    pub bounds_stability: bool,
}

impl AsymptoticError {
    /// Its clearance, the exact one where it is known.
    pub fn place(&self) -> f64 {
        self.exact.or(self.theory).unwrap_or(0.0)
    }
}

/// Every boundary of the case's frequency and forcing, by theory and exactly, by ascending clearance.
pub fn asymptotic_errors(analysis: &Analysis, exact: &FullSystem) -> Vec<AsymptoticError> {
    between(&clearances(analysis), exact.boundaries.as_ref())
}

/// The same at each frequency at which the exact boundaries are known, with its `Omega`; the forcing
/// is that of `system`.
pub fn errors_over_frequency(
    system: &System,
    manifold: &Manifold,
    exact: &[orbits::ExactBoundaries],
) -> Vec<(f64, Vec<AsymptoticError>)> {
    let asymmetric = AsymmetricLimits::of(manifold.restitution);
    let at_frequency = |at: &orbits::ExactBoundaries| {
        let there = system.with_frequency_ratio(at.frequency_ratio).ok()?;
        let theory = analysis::Boundaries::with(&there, manifold, &asymmetric);
        let theory = clearances_of(&theory, there.forcing_per_clearance());
        Some((at.frequency_ratio, between(&theory, Some(at))))
    };
    exact.iter().filter_map(at_frequency).collect()
}

fn between(theory: &[BoundaryAt], exact: Option<&orbits::ExactBoundaries>) -> Vec<AsymptoticError> {
    let limits = exact.into_iter().flat_map(|found| &found.symmetric.limits);
    let symmetric =
        limits.map(|limit| (limit.kind, false, limit.clearance, limit.bounds_stability));
    let asymmetric = exact.and_then(|found| found.asymmetric.as_ref());
    let ends = asymmetric.into_iter().flat_map(|found| {
        let doubling = (Bifurcation::PeriodDoubling, found.period_doubling);
        [doubling, (Bifurcation::Grazing, found.grazing)]
    });
    let ends = ends.filter_map(|(kind, at)| Some((kind, true, at?, false)));
    let mut errors = Vec::new();
    for (kind, of_asymmetric, clearance, bounds_stability) in symmetric.chain(ends) {
        let same = |at: &&BoundaryAt| at.kind == kind && at.of_asymmetric == of_asymmetric;
        let same: Vec<f64> = theory.iter().filter(same).map(|at| at.clearance).collect();
        if same.is_empty() && !bounds_stability && !of_asymmetric {
            continue;
        }
        let theory = nearest(&same, clearance);
        errors.push(AsymptoticError {
            kind,
            of_asymmetric,
            theory,
            exact: Some(clearance),
            difference: theory.map(|at| at / clearance - 1.0),
            bounds_stability,
        });
    }
    for BoundaryAt { kind, of_asymmetric, clearance } in theory {
        if errors.iter().all(|error| error.theory != Some(*clearance)) {
            errors.push(AsymptoticError {
                kind: *kind,
                of_asymmetric: *of_asymmetric,
                theory: Some(*clearance),
                exact: None,
                difference: None,
                bounds_stability: false,
            });
        }
    }
    errors.sort_by(|a, b| a.place().total_cmp(&b.place()));
    errors
}

/// Relative distance in clearance beyond which two boundaries of one kind are not counterparts.
const LARGEST_DISTANCE: f64 = 0.5;

fn nearest(theory: &[f64], exact: f64) -> Option<f64> {
    let distance = |clearance: f64| libm::log(clearance / exact).abs();
    let near = theory.iter().copied().filter(|at| distance(*at) < LARGEST_DISTANCE);
    near.min_by(|a, b| distance(*a).total_cmp(&distance(*b)))
}
