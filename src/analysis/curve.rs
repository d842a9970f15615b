//! Fixed points and areas without an iteration: `gamma^2` is a quadratic in `beta = B/b`.
//!
//! Eliminating the phase `eta` from the fixed points of (18), with the manifold (14), (15) for `C` and
//! `Theta`, leaves `gamma^2 = (lambda C + h sin Theta)^2 + (2 sigma C - h cos Theta)^2`,
//! `h = 8 beta/pi^2`, and with `C cos Theta = 1 - beta`, `C sin Theta = 2 rho beta/pi`
//!
//! `gamma^2 = 4 s - (8 s + 32 sigma/pi^2) beta + q beta^2`, `s = sigma^2 + lambda^2/4`,
//! `q = 4 s (1 + R) + 32 (sigma/pi^2 + lambda rho/pi^3) + 64/pi^4`.
//!
//! Its smallest value is the saddle-node's, `8 (rho s/pi + lambda/pi^2)/sqrt(q)`: the discriminant is a
//! perfect square. [`super::fixed_points`] certifies its roots and their number; this is for scans of
//! thousands of systems, and a test holds the two together.

use std::f64::consts::PI;

use super::areas::{Area, Strip, Zone};
use super::manifold::Manifold;
use crate::system::System;

/// The quadratic of one detuning, damping and restitution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FixedPointCurve {
    fold: f64,
    breaking: f64,
    linear: f64,
    slope: f64,
    square: f64,
    collision: f64,
}

impl FixedPointCurve {
    /// The curve of a system; its forcing does not matter. `manifold` is that of its restitution.
    pub fn of(system: &System, manifold: &Manifold) -> Self {
        let (sigma, lambda) = (system.detuning(), system.damping());
        let (rho, curvature) = (manifold.restitution_ratio, manifold.curvature);
        let s = sigma * sigma + 0.25 * lambda * lambda;
        let pi2 = PI * PI;
        let square = 4.0 * s * (1.0 + curvature)
            + 32.0 * (sigma / pi2 + lambda * rho / (pi2 * PI))
            + 64.0 / (pi2 * pi2);
        Self {
            fold: 1.0 + manifold.fold_shift,
            breaking: manifold.symmetry_breaking.absorber,
            linear: 4.0 * s,
            slope: 8.0 * s + 32.0 * sigma / pi2,
            square,
            collision: 8.0 * (rho * s / PI + lambda / pi2) / square.sqrt(),
        }
    }

    /// `gamma^2` of the fixed point with `beta = B/b`.
    pub fn forcing_squared(&self, beta: f64) -> f64 {
        self.linear + beta * (self.square * beta - self.slope)
    }

    /// `gamma` at which two fixed points collide, and `beta` there; none where `beta` would not be
    /// positive.
    pub fn collision(&self) -> Option<(f64, f64)> {
        let beta = self.slope / (2.0 * self.square);
        (beta > 0.0).then_some((self.collision, beta))
    }

    /// `gamma_H`, where a fixed point reaches the fold.
    pub fn hopf(&self) -> f64 {
        self.forcing_squared(self.fold).max(0.0).sqrt()
    }

    /// `gamma_c`, where a fixed point reaches symmetry breaking.
    pub fn symmetry_breaking(&self) -> f64 {
        self.forcing_squared(self.breaking).max(0.0).sqrt()
    }

    /// `beta` of the fixed points at a forcing, those above 0, ascending.
    fn fixed_points(&self, gamma: f64) -> impl Iterator<Item = f64> {
        // Distance from the vertex, without cancelling the vertex's own value.
        let excess = (gamma - self.collision) * (gamma + self.collision);
        let middle = self.slope / (2.0 * self.square);
        let reach = (excess / self.square).sqrt();
        [middle - reach, middle + reach].into_iter().filter(|beta| *beta > 0.0)
    }

    /// Area and strip at a forcing, as [`Zone::of`] finds them.
    pub fn zone(&self, gamma: f64) -> Zone {
        let below_hopf = gamma < self.hopf();
        let on =
            |from: f64, to: f64| self.fixed_points(gamma).any(|beta| from <= beta && beta <= to);
        let (area, strip) = if gamma == 0.0 {
            (Some(Area::Z4), None)
        } else if on(self.fold, self.breaking) {
            (Some(Area::Z3), below_hopf.then_some(Strip::A1))
        } else if on(self.breaking, f64::INFINITY) {
            (None, None)
        } else if below_hopf && on(0.0, self.fold) {
            (Some(Area::Z3), Some(Strip::A2))
        } else {
            (Some(Area::Z4), None)
        };
        Zone { area, strip }
    }
}
