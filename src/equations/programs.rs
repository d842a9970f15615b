//! Numbers from the derived expressions.
//!
//! Every function here evaluates a compiled expression and does nothing else. Which symbols must
//! have values is said at each; [`Programs::values`] and [`Programs::at_shift`] set them.

use super::{Boundaries, FixedPoints, Manifold, OrbitPrograms, SlowFlow, Stated, SymmetricOrbits};
use crate::symbolic::{Compiled, MissingValue, Symbol, Values};
use crate::system::System;

/// A point of the manifold; lengths are over the clearance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ManifoldPoint {
    /// `u = beta - 1`.
    pub shift: f64,
    /// `beta = B/b`.
    pub ratio: f64,
    /// `c_2 = C^2/b^2`.
    pub square: f64,
}

/// `gamma^2 = p_0 + p_1 beta + p_2 beta^2` of the fixed points, and `gamma` where they change.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quadratic {
    /// `p_0`, `p_1`, `p_2`.
    pub coefficients: [f64; 3],
    /// `gamma` of the saddle-node.
    pub collision: f64,
    /// `gamma` of the Hopf boundary.
    pub hopf: f64,
    /// `gamma` of the symmetry-breaking boundary.
    pub breaking: f64,
}

/// The derived expressions, compiled.
#[derive(Debug, Clone)]
pub struct Programs {
    short_hands: Compiled<1>,
    curvature: Compiled<1>,
    square: Compiled<1>,
    special_points: Compiled<6>,
    quadratic: Compiled<6>,
    by_detuning: Compiled<3>,
    collision_by_detuning: Compiled<5>,
    sides: Compiled<2>,
    meeting_detuning: Compiled<1>,
    rates: Compiled<2>,
    stability: Compiled<2>,
    /// Exact symmetric orbits.
    pub orbits: OrbitPrograms,
}

impl Programs {
    pub(super) fn new(
        stated: &Stated,
        manifold: &Manifold,
        fixed_points: &FixedPoints,
        boundaries: &Boundaries,
        slow_flow: &SlowFlow,
        orbits: &SymmetricOrbits,
    ) -> Self {
        let [constant, linear, square] = &fixed_points.quadratic;
        let collision = fixed_points.collision_forcing.substitute(Symbol::ForcingSquare, square);
        Self {
            short_hands: Compiled::new([&stated.restitution_ratio.right]),
            curvature: Compiled::new([&stated.curvature.right]),
            square: Compiled::new([&manifold.shifted_square]),
            special_points: Compiled::new([
                &manifold.fold_shift,
                &manifold.fold_ratio,
                &manifold.fold_square,
                &manifold.breaking_shift,
                &manifold.breaking_ratio,
                &manifold.breaking_square,
            ]),
            quadratic: Compiled::new([
                constant,
                linear,
                square,
                &collision,
                &boundaries.hopf_squared,
                &boundaries.breaking_squared,
            ]),
            by_detuning: Compiled::new(fixed_points.by_detuning.each_ref()),
            collision_by_detuning: Compiled::new(fixed_points.collision_by_detuning.each_ref()),
            sides: Compiled::new([&fixed_points.sine, &fixed_points.cosine]),
            meeting_detuning: Compiled::new([&boundaries.meeting_detuning]),
            rates: Compiled::new([&slow_flow.ratio_rate, &slow_flow.phase_rate]),
            stability: Compiled::new([&slow_flow.trace, &slow_flow.determinant]),
            orbits: OrbitPrograms::new(orbits),
        }
    }

    /// Values of `epsilon`, `lambda`, `r`, `rho`, `R`, `Omega`, `sigma`, `gamma` for a system.
    pub fn values(&self, system: &System) -> Values {
        self.values_of(system.restitution())
            .with(Symbol::MassRatio, system.mass_ratio())
            .with(Symbol::Damping, system.damping())
            .with(Symbol::FrequencyRatio, system.frequency_ratio())
            .with(Symbol::Detuning, system.detuning())
            .with(Symbol::ForcingPerClearance, system.forcing_per_clearance())
    }

    /// Values of `r`, `rho`, `R` for a coefficient of restitution.
    pub fn values_of(&self, restitution: f64) -> Values {
        let mut values = Values::new().with(Symbol::Restitution, restitution);
        if let Ok([ratio]) = self.short_hands.evaluate(&values) {
            values.set(Symbol::RestitutionRatio, ratio);
        }
        if let Ok([curvature]) = self.curvature.evaluate(&values) {
            values.set(Symbol::ManifoldCurvature, curvature);
        }
        values
    }

    /// The same values at a point of the manifold: `u`, `beta`, `c_2` are set. Needs `R`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn at_shift(&self, values: &Values, shift: f64) -> Result<Values, MissingValue> {
        let mut values = values.clone();
        values.set(Symbol::Shift, shift);
        values.set(Symbol::AmplitudeRatio, 1.0 + shift);
        let [square] = self.square.evaluate(&values)?;
        values.set(Symbol::ManifoldSquare, square);
        Ok(values)
    }

    /// `c_2` at `u`. Needs `R`, `u`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn manifold_square(&self, values: &Values) -> Result<f64, MissingValue> {
        self.square.evaluate(values).map(|[square]| square)
    }

    /// The fold of the manifold. Needs `R`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn fold(&self, values: &Values) -> Result<ManifoldPoint, MissingValue> {
        let [shift, ratio, square, ..] = self.special_points.evaluate(values)?;
        Ok(ManifoldPoint { shift, ratio, square })
    }

    /// Where symmetric impacts become asymmetric. Needs `R`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn symmetry_breaking(&self, values: &Values) -> Result<ManifoldPoint, MissingValue> {
        let [_, _, _, shift, ratio, square] = self.special_points.evaluate(values)?;
        Ok(ManifoldPoint { shift, ratio, square })
    }

    /// The quadratic of the fixed points and the forcings at which they change. Needs `lambda`, `rho`,
    /// `R`, `sigma`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn quadratic(&self, values: &Values) -> Result<Quadratic, MissingValue> {
        let [constant, linear, square, collision, hopf, breaking] =
            self.quadratic.evaluate(values)?;
        Ok(Quadratic {
            coefficients: [constant, linear, square],
            collision,
            hopf: hopf.sqrt(),
            breaking: breaking.sqrt(),
        })
    }

    /// Coefficients, by ascending powers of `sigma`, of the condition that a point of the manifold
    /// is a fixed point: the frequency response. Needs a point, `lambda`, `rho`, `gamma`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn detuning_coefficients(&self, point: &Values) -> Result<[f64; 3], MissingValue> {
        self.by_detuning.evaluate(point)
    }

    /// Coefficients, by ascending powers of `sigma`, of the condition that two fixed points meet. Needs
    /// `lambda`, `rho`, `gamma`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn collision_detunings(&self, values: &Values) -> Result<[f64; 5], MissingValue> {
        self.collision_by_detuning.evaluate(values)
    }

    /// `gamma sqrt(c_2) sin(eta)` and `gamma sqrt(c_2) cos(eta)` of a fixed point. Needs a point,
    /// `lambda`, `rho`, `sigma`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn sides(&self, point: &Values) -> Result<[f64; 2], MissingValue> {
        self.sides.evaluate(point)
    }

    /// `sigma` of P1. Needs `lambda`, `rho`, `R`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn meeting_detuning(&self, values: &Values) -> Result<f64, MissingValue> {
        self.meeting_detuning.evaluate(values).map(|[value]| value)
    }

    /// Rates of `u` and `eta` in slow time. Needs a point, `eta`, `lambda`, `rho`, `R`, `sigma`,
    /// `gamma`; infinite at the fold.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn slow_flow(&self, point: &Values) -> Result<[f64; 2], MissingValue> {
        self.rates.evaluate(point)
    }

    /// Trace of the slow flow's Jacobian at a fixed point, and its determinant at the larger one. Needs
    /// a point, `Delta`, `lambda`, `rho`, `R`; not finite at the fold.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn stability(&self, point: &Values) -> Result<[f64; 2], MissingValue> {
        self.stability.evaluate(point)
    }
}
