//! Boundaries of the 1:1 response in (frequency, clearance) and in (sigma, gamma).
//!
//! On a boundary the reduced forcing per clearance has a value that depends on the detuning alone:
//! `gamma_H` where a fixed point reaches the fold (Hopf, Fig. 6b), `gamma_c` where it reaches
//! symmetry breaking, `gamma_SN` where two fixed points collide (saddle-node, Fig. 6a). At a fixed
//! forcing amplitude the clearance of a boundary is `b = G / gamma`.

use serde::Serialize;

use super::AnalysisError;
use super::manifold::{Branch, Manifold};
use crate::equations::equations;
use crate::numerics::bracket::brent;
use crate::numerics::polynomial::roots_above;
use crate::symbolic::{MissingValue, Symbol, Values};
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
        let programs = &equations().programs;
        let values = programs.values(system);
        let roots = roots_above(&programs.saddle_node_coefficients(&values)?, -1.0)?;
        let collisions = roots.iter().filter(|root| manifold.point(root.at).oscillator > 0.0);
        let saddle_nodes = collisions.map(|root| {
            Ok(SaddleNode {
                forcing_over_clearance: forcing_squared(&values, root.at)?.max(0.0).sqrt(),
                absorber: 1.0 + root.at,
                branch: manifold.branch(root.at),
            })
        });
        let meeting = programs.meeting_point(&values)?;
        Ok(Self {
            symmetry_breaking: programs.breaking_forcing(&values)?,
            hopf: programs.hopf_forcing(&values)?,
            saddle_nodes: saddle_nodes.collect::<Result<_, MissingValue>>()?,
            codimension_two: CodimensionTwo {
                detuning: meeting.detuning,
                forcing_over_clearance: meeting.forcing_per_clearance,
            },
        })
    }

    /// The collision beyond which no fixed point is left: the one at the smallest forcing, if it lies
    /// below the Hopf boundary. Others lie where fixed points remain, and bound no area.
    pub fn outermost_collision(&self) -> Option<&SaddleNode> {
        // At P1 the two boundaries are one to rounding.
        let below = self.hopf * (1.0 + 1e-9);
        self.saddle_nodes
            .iter()
            .filter(|node| node.forcing_over_clearance > 0.0)
            .filter(|node| node.forcing_over_clearance <= below)
            .min_by(|a, b| a.forcing_over_clearance.total_cmp(&b.forcing_over_clearance))
    }

    /// All boundaries as `(kind, gamma)`.
    pub fn all(&self) -> impl Iterator<Item = (BoundaryKind, f64)> {
        [(BoundaryKind::SymmetryBreaking, self.symmetry_breaking), (BoundaryKind::Hopf, self.hopf)]
            .into_iter()
            .chain(
                self.saddle_nodes
                    .iter()
                    .map(|node| (BoundaryKind::SaddleNode, node.forcing_over_clearance)),
            )
    }
}

/// `gamma^2` of a fixed point with `B = b (1 + shift)`.
fn forcing_squared(values: &Values, shift: f64) -> Result<f64, MissingValue> {
    let programs = &equations().programs;
    programs.forcing_squared(&programs.at_shift(values, shift)?)
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

/// `gamma_c` or `gamma_H` over detuning.
///
/// # Errors
/// [`AnalysisError::Missing`] never, for a system.
pub fn explicit_boundary(
    kind: BoundaryKind,
    system: &System,
    detunings: impl Iterator<Item = f64>,
) -> Result<Vec<BoundaryPoint>, AnalysisError> {
    let coefficients = explicit_coefficients(kind, system)?;
    let point = |detuning| BoundaryPoint {
        detuning,
        forcing_over_clearance: quadratic(coefficients, detuning).max(0.0).sqrt(),
        branch: Branch::Stable,
    };
    Ok(detunings.map(point).collect())
}

/// Coefficients of `gamma^2` by powers of `sigma`, for Hopf and symmetry breaking.
fn explicit_coefficients(kind: BoundaryKind, system: &System) -> Result<[f64; 3], MissingValue> {
    let programs = &equations().programs;
    let values = programs.values(system);
    match kind {
        BoundaryKind::Hopf => programs.hopf_coefficients(&values),
        _ => programs.breaking_coefficients(&values),
    }
}

/// Amplitudes that resolve the boundary on both sides of the fold, where it turns quickly.
fn saddle_node_shifts(manifold: &Manifold) -> impl Iterator<Item = f64> {
    const HALF: i32 = 400;
    let fold = manifold.fold_shift;
    (-HALF..=HALF).map(move |k| {
        let t = f64::from(k) / f64::from(HALF);
        let reach = if k < 0 { 0.98 + fold } else { 2.0 };
        fold + reach * t * t * t
    })
}

/// The two detunings at which fixed points collide at a given amplitude: the saddle-node condition is
/// a quadratic in `sigma` there, so that the boundary is explicit and needs no continuation.
fn saddle_node_pair(
    values: &Values,
    manifold: &Manifold,
    shift: f64,
) -> Result<[Option<BoundaryPoint>; 2], MissingValue> {
    let at = values.clone().with(Symbol::Shift, shift);
    let roots = quadratic_roots(equations().programs.saddle_node_detunings(&at)?);
    let point = |detuning: f64| {
        let squared = forcing_squared(&values.clone().with(Symbol::Detuning, detuning), shift)?;
        Ok((squared > 0.0).then(|| BoundaryPoint {
            detuning,
            forcing_over_clearance: squared.sqrt(),
            branch: manifold.branch(shift),
        }))
    };
    match roots.as_slice() {
        [lower, upper] => Ok([point(*lower)?, point(*upper)?]),
        _ => Ok([None, None]),
    }
}

/// Detunings at which a boundary passes through the system's `gamma`, ascending.
///
/// # Errors
/// [`AnalysisError::Missing`] never, for a system.
pub fn crossings(
    kind: BoundaryKind,
    system: &System,
    manifold: &Manifold,
) -> Result<Vec<f64>, AnalysisError> {
    if kind == BoundaryKind::SaddleNode {
        return saddle_node_crossings(system, manifold);
    }
    let gamma = system.forcing_per_clearance();
    let [constant, linear, square] = explicit_coefficients(kind, system)?;
    Ok(quadratic_roots([constant - gamma * gamma, linear, square]))
}

fn saddle_node_crossings(system: &System, manifold: &Manifold) -> Result<Vec<f64>, AnalysisError> {
    let values = equations().programs.values(system);
    let gamma = system.forcing_per_clearance();
    let shifts: Vec<f64> = saddle_node_shifts(manifold).collect();
    let mut found = Vec::new();
    for arc in 0..2 {
        let at = |shift: f64| saddle_node_pair(&values, manifold, shift).ok()?[arc];
        let excess =
            |shift: f64| at(shift).map_or(f64::NAN, |point| point.forcing_over_clearance - gamma);
        for pair in shifts.windows(2) {
            // Amplitudes are of order one; the crossing is a derived figure, not a certified root.
            let crossing = brent(pair[0], pair[1], 1e-13, excess).ok();
            found.extend(crossing.and_then(|root| at(root.at)).map(|point| point.detuning));
        }
    }
    found.sort_by(f64::total_cmp);
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn amplitudes_reach_from_almost_none_through_the_fold() {
        let manifold = Manifold::of(0.6).expect("has all values");
        let shifts: Vec<f64> = saddle_node_shifts(&manifold).collect();
        assert!((shifts[0] + 0.98).abs() < 1e-12, "{}", shifts[0]);
        assert!(shifts.contains(&manifold.fold_shift));
        assert!(shifts.windows(2).all(|pair| pair[0] < pair[1]));
    }
}
