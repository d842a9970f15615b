//! Fixed points, boundaries and areas without an iteration: `gamma^2` is a quadratic in `beta = B/b`.
//!
//! [`crate::equations::FixedPoints`] derives it: `gamma^2 = p_0 + p_1 beta + p_2 beta^2`, with its smallest
//! value, the saddle-node's, in closed form. The number of fixed points is the sign of
//! `gamma - gamma_SN`, and near the collision the distance from it is what is known of them.

use super::areas::{Area, Strip, Zone};
use super::manifold::{Branch, Manifold};
use crate::equations::{Quadratic, equations};
use crate::operation_count;
use crate::symbolic::{Symbol, Values};
use crate::system::System;

/// The quadratic of one detuning, damping and restitution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FixedPointCurve {
    manifold: Manifold,
    quadratic: Quadratic,
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
        let values = Values::new()
            .with(Symbol::Damping, system.damping())
            .with(Symbol::RestitutionRatio, manifold.restitution_ratio)
            .with(Symbol::ManifoldCurvature, manifold.curvature)
            .with(Symbol::Detuning, detuning);
        // All symbols of the formulas have values; a test would see the NaN.
        let quadratic = equations().programs.quadratic(&values).unwrap_or(Quadratic {
            coefficients: [f64::NAN; 3],
            collision: f64::NAN,
            hopf: f64::NAN,
            breaking: f64::NAN,
        });
        Self { manifold: *manifold, quadratic }
    }

    /// `p_0`, `p_1`, `p_2`.
    pub fn coefficients(&self) -> [f64; 3] {
        self.quadratic.coefficients
    }

    /// `gamma_SN`, also where its `beta` is not positive.
    pub fn collision_forcing(&self) -> f64 {
        self.quadratic.collision
    }

    /// `gamma^2` of the fixed point with `beta = B/b`: no difference of large numbers, since the
    /// smallest value is known.
    pub fn forcing_squared(&self, beta: f64) -> f64 {
        let [_, _, square] = self.quadratic.coefficients;
        let distance = beta - self.collision_ratio();
        self.quadratic.collision * self.quadratic.collision + square * distance * distance
    }

    fn collision_ratio(&self) -> f64 {
        let [_, linear, square] = self.quadratic.coefficients;
        -linear / (2.0 * square)
    }

    /// `gamma` at which two fixed points collide, and `beta` there; none where one of them would not be
    /// positive.
    pub fn collision(&self) -> Option<(f64, f64)> {
        operation_count::note(2);
        let beta = self.collision_ratio();
        let gamma = self.quadratic.collision;
        (beta > 0.0 && beta.is_finite() && gamma > 0.0).then_some((gamma, beta))
    }

    /// `gamma_H`, where a fixed point reaches the fold.
    pub fn hopf(&self) -> f64 {
        self.quadratic.hopf
    }

    /// `gamma_c`, where a fixed point reaches symmetry breaking.
    pub fn symmetry_breaking(&self) -> f64 {
        self.quadratic.breaking
    }

    /// The fixed points at a forcing, at most two, ascending; those with `B > 0` and `C > 0`.
    pub fn fixed_points(&self, gamma: f64) -> impl Iterator<Item = Amplitude> {
        operation_count::note(15);
        let [constant, linear, square] = self.quadratic.coefficients;
        let collision = self.quadratic.collision;
        // The distance from the collision, not the difference of two squares that are almost equal.
        let discriminant = square * ((gamma - collision) * (gamma + collision));
        let root = discriminant.sqrt();
        // The root further from 0 first, which is a sum; the other from their product.
        let middle = -0.5 * linear;
        let far = middle + root.copysign(middle);
        let (far, near) = (far / square, (constant - gamma * gamma) / far);
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

    /// Area and strip at a forcing. The line between Z2 and Z1 has no closed form.
    pub fn zone(&self, gamma: f64) -> Zone {
        let below_hopf = gamma < self.hopf();
        let on = |branch| {
            self.fixed_points(gamma).any(|at| self.manifold.branch(at.ratio - 1.0) == branch)
        };
        let (area, strip) = if on(Branch::Stable) {
            (Some(Area::Z3), below_hopf.then_some(Strip::A1))
        } else if on(Branch::Right) {
            (None, None)
        } else if on(Branch::Left) && below_hopf {
            (Some(Area::Z3), Some(Strip::A2))
        } else {
            (Some(Area::Z4), None)
        };
        Zone { area, strip }
    }
}
