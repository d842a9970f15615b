//! Boundaries of the 1:1 response in (frequency, clearance) and in (sigma, gamma).
//!
//! On a boundary the reduced forcing per clearance has a value that depends on the detuning alone:
//! `gamma_H` where a fixed point reaches the fold (Hopf, Fig. 6b), `gamma_c` where it reaches
//! symmetry breaking, `gamma_SN` where two fixed points collide (saddle-node, Fig. 6a). At a fixed
//! forcing amplitude the clearance of a boundary is `b = G / gamma`.

use serde::Serialize;

use super::AnalysisError;
use super::curve::FixedPointCurve;
use super::frequency_response::detunings;
use super::manifold::{Branch, Manifold};
use crate::bifurcation::Bifurcation;
use crate::equations::equations;
use crate::numerics::polynomial::real_roots;
use crate::system::System;

/// A collision of two fixed points at the system's detuning.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SaddleNode {
    /// `gamma` at the collision.
    pub forcing_over_clearance: f64,
    /// `B/b` at the collision.
    #[serde(rename = "B")]
    pub absorber_amplitude: f64,
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
    /// The collision beyond which no fixed point is left. There is none where it would need `B < 0` or
    /// no forcing at all.
    pub saddle_node: Option<SaddleNode>,
    /// P1, which does not depend on the detuning.
    pub codimension_two: CodimensionTwo,
}

impl Boundaries {
    /// Boundaries at the system's detuning.
    ///
    /// # Errors
    /// [`AnalysisError::Missing`] never, for a system.
    pub fn of(system: &System, manifold: &Manifold) -> Result<Self, AnalysisError> {
        let curve = FixedPointCurve::of(system, manifold);
        let programs = &equations().programs;
        let meeting = programs.meeting_detuning(&programs.values(system))?;
        let at_meeting = FixedPointCurve::at_detuning(system, manifold, meeting);
        Ok(Self {
            symmetry_breaking: curve.symmetry_breaking(),
            hopf: curve.hopf(),
            saddle_node: curve.collision().map(|(forcing_over_clearance, absorber)| SaddleNode {
                forcing_over_clearance,
                absorber_amplitude: absorber,
                branch: manifold.branch(absorber - 1.0),
            }),
            codimension_two: CodimensionTwo {
                detuning: meeting,
                forcing_over_clearance: at_meeting.hopf(),
            },
        })
    }

    /// All boundaries as `(kind, gamma)`.
    pub fn all(&self) -> impl Iterator<Item = (Bifurcation, f64)> {
        let node = self.saddle_node.map(|node| node.forcing_over_clearance);
        [
            (Bifurcation::SymmetryBreaking, Some(self.symmetry_breaking)),
            (Bifurcation::NeimarkSacker, Some(self.hopf)),
            (Bifurcation::SaddleNode, node),
        ]
        .into_iter()
        .filter_map(|(kind, gamma)| Some((kind, gamma?)))
    }
}

/// Detunings at which a boundary passes through the system's `gamma`, ascending; none of a bifurcation that
/// the slow flow does not have.
///
/// # Errors
/// [`AnalysisError::Missing`] never, for a system.
pub fn crossings(
    kind: Bifurcation,
    system: &System,
    manifold: &Manifold,
) -> Result<Vec<f64>, AnalysisError> {
    let shift = match kind {
        Bifurcation::NeimarkSacker => manifold.fold_shift,
        Bifurcation::SymmetryBreaking => manifold.symmetry_breaking.absorber_amplitude - 1.0,
        Bifurcation::SaddleNode => {
            let programs = &equations().programs;
            let mut found = real_roots(&programs.collision_detunings(&programs.values(system))?);
            let curve = |detuning| FixedPointCurve::at_detuning(system, manifold, detuning);
            found.retain(|detuning| curve(*detuning).collision().is_some());
            return Ok(found);
        }
        _ => return Ok(Vec::new()),
    };
    detunings(system, shift)
}
