//! Boundaries of the 1:1 response in (frequency, clearance) and in (sigma, gamma).
//!
//! On a boundary the reduced forcing per clearance has a value that depends on the detuning alone:
//! `gamma_H` where a fixed point reaches the fold (Hopf, Fig. 6b), `gamma_c` where it reaches
//! symmetry breaking, `gamma_SN` where two fixed points collide (saddle-node, Fig. 6a). At a fixed
//! forcing amplitude the clearance of a boundary is `b = G / gamma`.

use serde::Serialize;

use super::manifold::{Branch, Manifold};
use super::{AnalysisError, values_of};
use crate::equations::equations;
use crate::numerics::bracket::brent;
use crate::numerics::polynomial::roots_above;
use crate::symbolic::{Symbol, Values};
use crate::system::System;

/// The three boundaries of the theory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum BoundaryKind {
    /// Two symmetric impacts turn asymmetric.
    SymmetryBreaking,
    /// A fixed point reaches the fold.
    Hopf,
    /// Two fixed points collide.
    SaddleNode,
}

impl BoundaryKind {
    /// The name in a report.
    pub fn words(self) -> &'static str {
        match self {
            Self::SymmetryBreaking => "symmetry breaking",
            Self::Hopf => "Hopf",
            Self::SaddleNode => "saddle-node",
        }
    }
}

/// A collision of two fixed points at the system's detuning.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SaddleNode {
    /// `gamma` at the collision.
    pub forcing_over_clearance: f64,
    /// `B/b` at the collision.
    #[serde(rename = "B")]
    pub absorber: f64,
    /// The branch on which it happens.
    pub branch: Branch,
}

/// Where saddle-node and Hopf boundary meet: P1 of Fig. 6c.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CodimensionTwo {
    /// `sigma` at P1.
    pub detuning: f64,
    /// `gamma` at P1.
    pub forcing_over_clearance: f64,
}

/// The boundaries at the system's detuning, as values of `gamma`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Boundaries {
    /// `gamma_c`.
    pub symmetry_breaking: f64,
    /// `gamma_H`.
    pub hopf: f64,
    /// Every collision, by ascending `B`.
    pub saddle_nodes: Vec<SaddleNode>,
    /// P1, which does not depend on the detuning.
    pub codimension_two: CodimensionTwo,
}

impl Boundaries {
    /// Boundaries at the system's detuning.
    ///
    /// # Errors
    /// [`AnalysisError::Condition`] when coefficients overflow.
    pub fn of(system: &System, manifold: &Manifold) -> Result<Self, AnalysisError> {
        let values = values_of(system, manifold);
        let sigma = system.detuning();
        let roots = roots_above(&equations().saddle_node_coefficients(&values), -1.0)?;
        let saddle_nodes = roots.iter().map(|root| SaddleNode {
            forcing_over_clearance: forcing_at(&values, root.at).max(0.0).sqrt(),
            absorber: 1.0 + root.at,
            branch: manifold.branch(root.at),
        });
        let [p1_detuning, p1_square] = equations().codimension_two(&values);
        Ok(Self {
            symmetry_breaking: quadratic(equations().breaking(&values), sigma).sqrt(),
            hopf: quadratic(equations().hopf(&values), sigma).sqrt(),
            saddle_nodes: saddle_nodes.collect(),
            codimension_two: CodimensionTwo {
                detuning: p1_detuning,
                forcing_over_clearance: p1_square.sqrt(),
            },
        })
    }

    /// All boundaries as `(kind, gamma)`.
    pub fn all(&self) -> impl Iterator<Item = (BoundaryKind, f64)> {
        [
            (BoundaryKind::SymmetryBreaking, self.symmetry_breaking),
            (BoundaryKind::Hopf, self.hopf),
        ]
        .into_iter()
        .chain(
            self.saddle_nodes
                .iter()
                .map(|node| (BoundaryKind::SaddleNode, node.forcing_over_clearance)),
        )
    }
}

/// `gamma^2` of a fixed point with `B = b (1 + shift)`.
fn forcing_at(values: &Values, shift: f64) -> f64 {
    let square = equations().square(&values.clone().with(Symbol::Shift, shift));
    let values = values
        .clone()
        .with(Symbol::Shift, shift)
        .with(Symbol::AmplitudeRatio, 1.0 + shift)
        .with(Symbol::ManifoldSquare, square);
    equations().forcing_squared(&values)
}

fn quadratic([constant, linear, square]: [f64; 3], at: f64) -> f64 {
    constant + at * (linear + at * square)
}

/// Real roots of `constant + linear x + square x^2`, ascending, by the formula that does not
/// cancel.
pub(super) fn quadratic_roots([constant, linear, square]: [f64; 3]) -> Vec<f64> {
    if square == 0.0 {
        return if linear == 0.0 { Vec::new() } else { vec![-constant / linear] };
    }
    let discriminant = linear * linear - 4.0 * square * constant;
    if discriminant.is_nan() || discriminant < 0.0 {
        return Vec::new();
    }
    let q = -0.5 * (linear + discriminant.sqrt().copysign(linear));
    let mut roots = if q == 0.0 { vec![0.0] } else { vec![q / square, constant / q] };
    roots.sort_by(f64::total_cmp);
    roots
}

/// A point of a boundary in the plane of the reduced parameters.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BoundaryPoint {
    /// `sigma`.
    pub detuning: f64,
    /// `gamma`.
    pub forcing_over_clearance: f64,
    /// The branch on which it happens.
    pub branch: Branch,
}

/// `gamma_c` and `gamma_H` over detuning.
pub fn explicit_boundary(
    kind: BoundaryKind,
    system: &System,
    manifold: &Manifold,
    detunings: impl Iterator<Item = f64>,
) -> Vec<BoundaryPoint> {
    let values = values_of(system, manifold);
    let coefficients = match kind {
        BoundaryKind::Hopf => equations().hopf(&values),
        _ => equations().breaking(&values),
    };
    detunings
        .map(|detuning| BoundaryPoint {
            detuning,
            forcing_over_clearance: quadratic(coefficients, detuning).max(0.0).sqrt(),
            branch: Branch::Stable,
        })
        .collect()
}

/// One arc of the saddle-node boundary, over the amplitude at which the collision happens.
///
/// At a given `beta` the saddle-node condition is a quadratic in `sigma`, so that the boundary is
/// two explicit curves, and needs no continuation.
pub fn saddle_node_arcs(system: &System, manifold: &Manifold) -> [Vec<BoundaryPoint>; 2] {
    let values = values_of(system, manifold);
    let mut arcs = [Vec::new(), Vec::new()];
    for shift in saddle_node_shifts(manifold) {
        for (arc, point) in arcs.iter_mut().zip(saddle_node_pair(&values, manifold, shift)) {
            arc.extend(point);
        }
    }
    arcs
}

/// Amplitudes that resolve the boundary on both sides of the fold, where it turns quickly.
fn saddle_node_shifts(manifold: &Manifold) -> impl Iterator<Item = f64> {
    const HALF: i32 = 400;
    let fold = manifold.fold_shift;
    (-HALF..=HALF).map(move |k| {
        let t = f64::from(k) / f64::from(HALF);
        let reach = if k < 0 { 0.98 + fold } else { 2.0 };
        fold + reach * t * t * t.abs()
    })
}

fn saddle_node_pair(
    values: &Values,
    manifold: &Manifold,
    shift: f64,
) -> [Option<BoundaryPoint>; 2] {
    let at = values.clone().with(Symbol::Shift, shift);
    let roots = quadratic_roots(equations().saddle_node_by_detuning(&at));
    let point = |detuning: f64| {
        let squared = forcing_at(&values.clone().with(Symbol::Detuning, detuning), shift);
        (squared > 0.0).then(|| BoundaryPoint {
            detuning,
            forcing_over_clearance: squared.sqrt(),
            branch: manifold.branch(shift),
        })
    };
    match roots.as_slice() {
        [lower, upper] => [point(*lower), point(*upper)],
        _ => [None, None],
    }
}

/// Detunings at which a boundary passes through the system's `gamma`, ascending.
pub fn crossings(kind: BoundaryKind, system: &System, manifold: &Manifold) -> Vec<f64> {
    let values = values_of(system, manifold);
    let gamma = system.forcing_per_clearance();
    let [constant, linear, square] = match kind {
        BoundaryKind::Hopf => equations().hopf(&values),
        BoundaryKind::SymmetryBreaking => equations().breaking(&values),
        BoundaryKind::SaddleNode => return saddle_node_crossings(&values, manifold, gamma),
    };
    quadratic_roots([constant - gamma * gamma, linear, square])
}

fn saddle_node_crossings(values: &Values, manifold: &Manifold, gamma: f64) -> Vec<f64> {
    let mut found = Vec::new();
    let shifts: Vec<f64> = saddle_node_shifts(manifold).collect();
    for arc in 0..2 {
        let excess = |shift: f64| {
            saddle_node_pair(values, manifold, shift)[arc]
                .map_or(f64::NAN, |point| point.forcing_over_clearance - gamma)
        };
        for pair in shifts.windows(2) {
            let (from, to) = (excess(pair[0]), excess(pair[1]));
            if (from < 0.0) == (to < 0.0) || from.is_nan() || to.is_nan() {
                continue;
            }
            // Amplitudes are of order one; the crossing is a derived figure, not a certified root.
            if let Ok(root) = brent(pair[0], pair[1], 1e-13, excess)
                && let Some(point) = saddle_node_pair(values, manifold, root.at)[arc]
            {
                found.push(point.detuning);
            }
        }
    }
    found.sort_by(f64::total_cmp);
    found
}
