//! A periodic orbit: a cycle of impacts, and the evidence that it exists and is or is not stable.

use std::f64::consts::TAU;

use nalgebra::Matrix4;
use serde::Serialize;

use super::OrbitError;
use super::admissibility::Admissibility;
use super::cycle::{Convergence, Cycle};
use super::multipliers::Multipliers;

/// How an orbit was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Origin {
    /// From the quadratic of the symmetric orbits.
    ClosedForm,
    /// Newton's method started from states of a simulated motion.
    Simulation,
    /// By continuation from another parameter value.
    Continuation,
    /// By stepping off another orbit's bifurcation.
    Switching,
}

/// A periodic orbit with its evidence.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Orbit {
    /// The impacts.
    pub cycle: Cycle,
    /// How well it closes, and in how many steps that was reached.
    pub convergence: Convergence,
    /// Multipliers of the map around [`Orbit::cycle`]: of half the orbit for
    /// [`Closure::Mirrors`](super::Closure::Mirrors).
    pub multipliers: Multipliers,
    /// Whether it is a motion.
    pub admissibility: Admissibility,
    /// How it was found.
    pub origin: Origin,
}

impl Orbit {
    /// Measures a converged cycle, whose map has this Jacobian.
    ///
    /// # Errors
    /// [`OrbitError::Singular`] where its multipliers do not exist: at a grazing impact.
    pub(super) fn measured(
        cycle: Cycle,
        jacobian: &Matrix4<f64>,
        convergence: Convergence,
        admissibility: Admissibility,
        origin: Origin,
    ) -> Result<Self, OrbitError> {
        let multipliers = Multipliers::of(jacobian).ok_or(OrbitError::Singular)?;
        Ok(Self { cycle, convergence, multipliers, admissibility, origin })
    }

    /// A motion that nearby motions approach.
    pub fn attracts(&self) -> bool {
        self.admissibility.admissible && self.multipliers.stable()
    }

    /// Largest modulus of the multipliers over one excitation period.
    pub fn radius_per_period(&self) -> f64 {
        let computed = self.cycle.closure.turn() / TAU;
        libm::pow(self.multipliers.spectral_radius(), 1.0 / computed)
    }
}
