//! The error of the asymptotics: how far the theory's boundaries lie from those of the full system.

use serde::Serialize;

use super::clearances::{BoundaryAt, clearances, clearances_of};
use super::tolerance::asymptotic_error;
use crate::analysis::{self, Analysis, AsymmetricLimits, Manifold};
use crate::orbits::{self, Bifurcation, FullSystem, Limit, SymmetricFamily};
use crate::system::{Parameters, System};

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
    between(&analysis.system, &clearances(analysis), exact.boundaries.as_ref())
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
        Some((at.frequency_ratio, between(&there, &theory, Some(at))))
    };
    exact.iter().filter_map(at_frequency).collect()
}

fn between(
    system: &System,
    theory: &[BoundaryAt],
    exact: Option<&orbits::ExactBoundaries>,
) -> Vec<AsymptoticError> {
    let limits = exact.map_or(&[][..], |found| &found.symmetric.limits);
    let partners = partners(system, theory, limits);
    let symmetric = limits.iter().zip(partners).map(|(limit, partner)| {
        (limit.kind, false, limit.clearance, limit.bounds_stability, partner)
    });
    let asymmetric = exact.and_then(|found| found.asymmetric.as_ref());
    let ends = asymmetric.into_iter().flat_map(|found| {
        let doubling = (Bifurcation::PeriodDoubling, found.period_doubling);
        [doubling, (Bifurcation::Grazing, found.grazing)]
    });
    // Of each of these there is one at most, on either side.
    let ends = ends.filter_map(|(kind, at)| {
        let same = |one: &&BoundaryAt| one.kind == kind && one.of_asymmetric;
        let partner = theory.iter().find(same).map(|one| one.clearance);
        Some((kind, true, at?, false, partner))
    });
    let mut errors = Vec::new();
    for (kind, of_asymmetric, clearance, bounds_stability, partner) in symmetric.chain(ends) {
        let same = |at: &BoundaryAt| at.kind == kind && at.of_asymmetric == of_asymmetric;
        if !theory.iter().any(same) && !bounds_stability && !of_asymmetric {
            continue;
        }
        errors.push(AsymptoticError {
            kind,
            of_asymmetric,
            theory: partner,
            exact: Some(clearance),
            difference: partner.map(|at| at / clearance - 1.0),
            bounds_stability,
        });
    }
    for BoundaryAt { kind, of_asymmetric, clearance } in theory {
        let is_it = |error: &AsymptoticError| {
            (error.kind, error.of_asymmetric, error.theory)
                == (*kind, *of_asymmetric, Some(*clearance))
        };
        if !errors.iter().any(is_it) {
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

/// Mass ratio of a step towards lighter absorbers, over that before, and the largest such ratio where limits change fast.
const LIGHTER: f64 = 0.8;
const FINEST: f64 = 0.98;
/// Change of the absorber's amplitude at a limit that is small enough for a step to tell limits apart.
const APART: f64 = 0.05;
/// Error of the theory at which the absorber is light enough: each of its boundaries is where the limit is that it is about.
const LIGHT: f64 = 2e-3;

/// The boundary of the theory that each exact limit comes from, one to one: limits are followed as the absorber becomes lighter,
/// all else of the reduced system as it is, to where theory and full system are one. None of a limit that ends on that way, or
/// that leads to no boundary.
fn partners(system: &System, theory: &[BoundaryAt], limits: &[Limit]) -> Vec<Option<f64>> {
    let mut found = vec![None; limits.len()];
    let light = lightened(system, limits);
    for one in theory.iter().filter(|one| !one.of_asymmetric) {
        let distance = |limit: &Limit| libm::log(limit.clearance / one.clearance).abs();
        let same = light.iter().filter(|(limit, _)| limit.kind == one.kind);
        let nearest = same.min_by(|a, b| distance(&a.0).total_cmp(&distance(&b.0)));
        // Some times the error that is left; others are elsewhere.
        if let Some((_, from)) = nearest.filter(|(limit, _)| distance(limit) < 20.0 * LIGHT) {
            found[*from] = Some(one.clearance);
        }
    }
    found
}

/// The limits of the same system with an absorber as light as that, each with the number of that among the first from which it
/// came; those of which nothing is left are not there.
fn lightened(system: &System, limits: &[Limit]) -> Vec<(Limit, usize)> {
    let all = limits.iter().cloned().enumerate();
    let mut known: Vec<(Limit, Option<usize>)> = all.map(|(k, limit)| (limit, Some(k))).collect();
    let (mut scale, mut step) = (1.0, LIGHTER);
    let mut here = *system;
    while asymptotic_error(&here) > LIGHT && known.iter().any(|one| one.1.is_some()) {
        let lighter = with_mass_scaled(system, scale * step);
        let Some((there, family)) =
            lighter.and_then(|there| Some((there, SymmetricFamily::of(&there).ok()?)))
        else {
            return Vec::new();
        };
        let (next, smooth) = carried_on(&known, &family.limits);
        if !smooth && step < FINEST {
            step = step.sqrt();
            continue;
        }
        (known, here, scale) = (next, there, scale * step);
        step = (step * step).max(LIGHTER);
    }
    known.into_iter().filter_map(|(limit, from)| Some((limit, from?))).collect()
}

/// The limits of the next system with where each came from, and whether none of them is new, gone or far from where it was.
fn carried_on(
    known: &[(Limit, Option<usize>)],
    next: &[Limit],
) -> (Vec<(Limit, Option<usize>)>, bool) {
    let change =
        |a: &Limit, b: &Limit| libm::log(a.absorber_amplitude / b.absorber_amplitude).abs();
    let mut pairs: Vec<(usize, usize, f64)> = Vec::new();
    for (k, (old, _)) in known.iter().enumerate() {
        let same = next.iter().enumerate().filter(|(_, new)| new.kind == old.kind);
        pairs.extend(same.map(|(n, new)| (k, n, change(old, new))));
    }
    // The nearest first, each once.
    pairs.sort_by(|a, b| a.2.total_cmp(&b.2));
    let mut from: Vec<Option<usize>> = vec![None; next.len()];
    let mut taken = vec![false; known.len()];
    let mut smooth = known.len() == next.len();
    for (k, n, change) in pairs {
        if from[n].is_none() && !taken[k] {
            (from[n], taken[k]) = (Some(k), true);
            smooth &= change < APART;
        }
    }
    let carried = next.iter().cloned().zip(from);
    (carried.map(|(limit, from)| (limit, from.and_then(|k| known[k].1))).collect(), smooth)
}

/// The system with so many times its mass ratio, its detuning, damping and forcing in the theory's numbers as they are.
fn with_mass_scaled(system: &System, scale: f64) -> Option<System> {
    let mass_ratio = scale * system.mass_ratio();
    let scaled = System::new(Parameters { mass_ratio, ..system.parameters() }).ok()?;
    scaled.with_detuning(system.detuning()).ok()
}
