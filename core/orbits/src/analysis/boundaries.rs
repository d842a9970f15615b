//! Boundaries of the 1:1 response in (frequency, clearance) and in (sigma, gamma).
//!
//! On a boundary the reduced forcing per clearance has a value that depends on the detuning alone:
//! `gamma_H` where a fixed point reaches the fold (Hopf, Fig. 6b), `gamma_c` where it reaches
//! symmetry breaking, `gamma_SN` where two fixed points collide (saddle-node, Fig. 6a). At a fixed
//! forcing amplitude the clearance of a boundary is `b = G / gamma`.

use serde::Serialize;

use super::curve::FixedPointCurve;
use super::frequency_response::detunings;
use super::manifold::{Manifold, ManifoldBranch};
use crate::bifurcation::Bifurcation;
use crate::cavity::{AsymmetricLimits, CavityMotion};
use crate::equations::fixed_points as formulas;
use crate::numerics::polynomial::{real_roots, through};
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
    pub branch: ManifoldBranch,
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
    /// Where the two asymmetric impacts beyond symmetry breaking double their period, if they do before they graze.
    pub period_doubling: Option<f64>,
    /// Where they graze a wall, the end of area Z2, if they exist.
    pub grazing: Option<f64>,
    /// P1, which does not depend on the detuning.
    pub codimension_two: CodimensionTwo,
}

impl Boundaries {
    /// Boundaries at the system's detuning.
    pub fn of(system: &System, manifold: &Manifold) -> Self {
        Self::with(system, manifold, &AsymmetricLimits::of(manifold.restitution))
    }

    /// The same with the limits of the asymmetric motion, which depend on the restitution alone.
    pub fn with(system: &System, manifold: &Manifold, asymmetric: &AsymmetricLimits) -> Self {
        let curve = FixedPointCurve::of(system, manifold);
        let Manifold { restitution_ratio, curvature, .. } = *manifold;
        let meeting =
            formulas::MEETING_DETUNING.at([system.damping(), restitution_ratio, curvature]);
        let at_meeting = FixedPointCurve::at_detuning(system, manifold, meeting);
        Self {
            symmetry_breaking: curve.symmetry_breaking(),
            hopf: curve.hopf(),
            saddle_node: curve.collision().map(|(forcing_over_clearance, absorber)| SaddleNode {
                forcing_over_clearance,
                absorber_amplitude: absorber,
                branch: manifold.branch(absorber - 1.0),
            }),
            period_doubling: asymmetric.period_doubling.map(|one| curve.forcing_of(&one)),
            grazing: asymmetric.grazing.map(|one| curve.forcing_of(&one)),
            codimension_two: CodimensionTwo {
                detuning: meeting,
                forcing_over_clearance: at_meeting.hopf(),
            },
        }
    }

    /// `gamma`, forcing over the clearance, at which steady 1:1 resonance ends as the forcing falls: two fixed points collide
    /// on the stable branch, or one reaches the fold.
    pub fn end_of_steady(&self) -> f64 {
        let node = self.saddle_node.filter(|node| node.branch == ManifoldBranch::Stable);
        node.map_or(self.hopf, |node| node.forcing_over_clearance)
    }

    /// Ends of the two asymmetric impacts as `(kind, gamma)`.
    pub fn of_asymmetric(&self) -> impl Iterator<Item = (Bifurcation, f64)> {
        let both = [
            (Bifurcation::PeriodDoubling, self.period_doubling),
            (Bifurcation::Grazing, self.grazing),
        ];
        both.into_iter().filter_map(|(kind, gamma)| Some((kind, gamma?)))
    }

    /// Boundaries of the symmetric motions as `(kind, gamma)`.
    pub fn of_symmetric(&self) -> impl Iterator<Item = (Bifurcation, f64)> {
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

/// Detunings at which a boundary passes through the system's `gamma`, ascending; none of a bifurcation that the
/// slow flow does not have.
pub fn crossings(kind: Bifurcation, system: &System, manifold: &Manifold) -> Vec<f64> {
    let breaking = manifold.symmetry_breaking.absorber_amplitude - 1.0;
    match kind {
        Bifurcation::NeimarkSacker => detunings(system, manifold, manifold.fold_shift),
        Bifurcation::SymmetryBreaking => detunings(system, manifold, breaking),
        Bifurcation::SaddleNode => {
            let curve = |detuning| FixedPointCurve::at_detuning(system, manifold, detuning);
            let mut found = real_roots(&collision_detunings(system, manifold));
            found.retain(|detuning| curve(*detuning).collision().is_some());
            found
        }
        _ => Vec::new(),
    }
}

/// The same where a fixed point of the left branch reaches `B = 0`.
pub fn vanishing(system: &System, manifold: &Manifold) -> Vec<f64> {
    detunings(system, manifold, -1.0)
}

/// The same of a motion of an ideal cavity: detunings at which it is a fixed point.
pub fn crossings_of(motion: &CavityMotion, system: &System, manifold: &Manifold) -> Vec<f64> {
    // The square of the forcing is a quadratic in the detuning.
    let excess = |detuning: f64| {
        let curve = FixedPointCurve::at_detuning(system, manifold, detuning);
        let (gamma, own) = (system.forcing_per_clearance(), curve.forcing_of(motion));
        (own - gamma) * (own + gamma)
    };
    real_roots(&through(&[-1.0, 0.0, 1.0].map(|detuning| (detuning, excess(detuning)))))
}

/// Coefficients, by ascending powers of `sigma`, of the condition that two fixed points meet.
fn collision_detunings(system: &System, manifold: &Manifold) -> [f64; 5] {
    let (lambda, gamma) = (system.damping(), system.forcing_per_clearance());
    let rho = manifold.restitution_ratio;
    let constant = formulas::NODE_CONSTANT.at([lambda, rho]);
    let square = formulas::NODE_SQUARE.at([rho]);
    [
        formulas::NODE_DETUNING_0.at([lambda, rho, gamma, constant]),
        formulas::NODE_DETUNING_1.at([gamma]),
        formulas::NODE_DETUNING_2.at([manifold.curvature, gamma, constant, square]),
        formulas::NODE_DETUNING_3.at([]),
        formulas::NODE_DETUNING_4.at([square]),
    ]
}
