//! Fixed points, boundaries and areas without an iteration: `gamma^2` is a quadratic in `beta = B/b`.
//!
//! [`crate::equations::fixed_points`] derives it: `gamma^2 = p_0 + p_1 beta + p_2 beta^2`, with its smallest
//! value, the saddle-node's, in closed form. The number of fixed points is the sign of
//! `gamma - gamma_SN`, and near the collision the distance from it is what is known of them.

use super::areas::{Area, Strip, Zone};
use super::manifold::{Manifold, ManifoldBranch};
use crate::cavity::{AsymmetricLimits, CavityMotion};
use crate::equations::dissipation::FORCING_SQUARED;
use crate::equations::fixed_points as formulas;
use crate::operation_count;
use crate::system::System;

/// The quadratic of one detuning, damping and restitution, and the forcings `gamma` where its roots change.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FixedPointCurve {
    manifold: Manifold,
    damping: f64,
    detuning: f64,
    /// `p_0`, `p_1`, `p_2`.
    pub(super) coefficients: [f64; 3],
    collision_ratio: f64,
    collision_forcing: f64,
    hopf: f64,
    symmetry_breaking: f64,
}

/// Amplitude of a fixed point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Amplitude {
    /// `beta = B/b`.
    pub ratio: f64,
    /// Half of `d(gamma^2)/d(beta)`: the root of the discriminant, negative at the smaller amplitude.
    pub half_slope: f64,
}

impl FixedPointCurve {
    /// The curve of a system; its forcing does not matter. `manifold` is that of its restitution.
    pub fn of(system: &System, manifold: &Manifold) -> Self {
        Self::at_detuning(system, manifold, system.detuning())
    }

    /// The same at another detuning.
    pub fn at_detuning(system: &System, manifold: &Manifold, detuning: f64) -> Self {
        let (lambda, rho) = (system.damping(), manifold.restitution_ratio);
        let constant = formulas::CONSTANT.at([lambda, detuning]);
        let linear = formulas::LINEAR.at([lambda, detuning]);
        let square = formulas::SQUARE.at([lambda, rho, detuning]);
        let node = [formulas::NODE_CONSTANT.at([lambda, rho]), formulas::NODE_SQUARE.at([rho])];
        Self {
            manifold: *manifold,
            damping: lambda,
            detuning,
            coefficients: [constant, linear, square],
            collision_ratio: formulas::NODE_RATIO.at([linear, square]),
            collision_forcing: formulas::NODE_FORCING.at([detuning, square, node[0], node[1]]),
            hopf: formulas::HOPF.at([lambda, rho, manifold.curvature, detuning]),
            symmetry_breaking: formulas::BREAKING.at([lambda, rho, detuning]),
        }
    }

    /// `gamma^2`, forcing over the clearance squared, of the fixed point with `beta = B/b`: no difference of large numbers,
    /// since the smallest value is known.
    pub fn forcing_squared(&self, beta: f64) -> f64 {
        let [_, _, square] = self.coefficients;
        let node = [self.collision_ratio, self.collision_forcing];
        formulas::FORCING_FROM_NODE.at([square, node[0], node[1], beta])
    }

    /// `gamma` at which two fixed points collide, and `beta` there; none where one of them would not be
    /// positive.
    pub fn collision(&self) -> Option<(f64, f64)> {
        let (gamma, beta) = (self.collision_forcing, self.collision_ratio);
        (beta > 0.0 && beta.is_finite() && gamma > 0.0).then_some((gamma, beta))
    }

    /// `gamma_H`, forcing over the clearance, where a fixed point reaches the fold.
    pub fn hopf(&self) -> f64 {
        self.hopf
    }

    /// `gamma_c`, forcing over the clearance, where a fixed point reaches symmetry breaking.
    pub fn symmetry_breaking(&self) -> f64 {
        self.symmetry_breaking
    }

    /// `gamma`, forcing over the clearance, at which a fixed point of the left branch reaches `B = 0` and is lost.
    pub fn vanishing(&self) -> f64 {
        self.coefficients[0].sqrt()
    }

    /// `gamma`, forcing over the clearance, at which a motion of an ideal cavity is a fixed point.
    pub fn forcing_of(&self, motion: &CavityMotion) -> f64 {
        let CavityMotion { resistance, reactance, oscillator_amplitude, .. } = *motion;
        let given = [self.damping, self.detuning, resistance, reactance, oscillator_amplitude];
        FORCING_SQUARED.at(given).sqrt()
    }

    /// The fixed points at a forcing, at most two, ascending; those with `B > 0` and `C > 0`.
    pub fn fixed_points(&self, gamma: f64) -> impl Iterator<Item = Amplitude> {
        operation_count::note(1);
        let [constant, linear, square] = self.coefficients;
        // The distance from the collision, not the difference of two squares that are almost equal.
        let discriminant = formulas::DISCRIMINANT.at([gamma, square, self.collision_forcing]);
        let root = discriminant.sqrt();
        // The root further from 0 first, which is a sum; the other from their product.
        let far = if linear.is_sign_negative() {
            &formulas::LARGER_RATIO
        } else {
            &formulas::SMALLER_RATIO
        };
        let far = far.at([linear, square, discriminant]);
        let near = formulas::RATIO_PRODUCT.at([gamma, constant, square]) / far;
        let lower = Amplitude { ratio: far.min(near), half_slope: -root };
        let upper = Amplitude { ratio: far.max(near), half_slope: root };
        let both = if root > 0.0 { [Some(lower), Some(upper)] } else { [None, Some(upper)] };
        // Without forcing nothing keeps a motion going; for elastic impacts the oscillator stands still
        // at B = b, and (18) does not hold.
        let moves = move |at: &Amplitude| {
            let stands = at.ratio == 1.0 && self.manifold.curvature == 0.0;
            gamma > 0.0 && root >= 0.0 && at.ratio > 0.0 && at.ratio.is_finite() && !stands
        };
        both.into_iter().flatten().filter(moves)
    }

    /// Area and strip at a forcing. Z2 ends where the asymmetric motion grazes a wall.
    pub fn zone(&self, gamma: f64) -> Zone {
        self.zone_within(gamma, || AsymmetricLimits::of(self.manifold.restitution).grazing)
    }

    /// The same where it is known, or does not matter, which asymmetric motion grazes.
    pub fn zone_within(&self, gamma: f64, grazing: impl FnOnce() -> Option<CavityMotion>) -> Zone {
        let below_hopf = gamma < self.hopf();
        let on = |branch| {
            self.fixed_points(gamma).any(|at| self.manifold.branch(at.ratio - 1.0) == branch)
        };
        let (area, strip) = if on(ManifoldBranch::Stable) {
            (Area::Z3, below_hopf.then_some(Strip::A1))
        } else if on(ManifoldBranch::Right) {
            let within = grazing().is_some_and(|end| gamma <= self.forcing_of(&end));
            (if within { Area::Z2 } else { Area::Z1 }, None)
        } else if on(ManifoldBranch::Left) && below_hopf {
            (Area::Z3, Some(Strip::A2))
        } else {
            (Area::Z4, None)
        };
        Zone { area, strip }
    }
}
