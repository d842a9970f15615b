//! Numbers from the derived expressions.
//!
//! Every function here evaluates a compiled expression and does nothing else. Which symbols must
//! have values is said at each; [`Programs::values`] and [`Programs::at_shift`] set them.

use super::fixed_points::with_shift;
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

/// The point P1, where the saddle-node boundary ends on the Hopf boundary.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeetingPoint {
    /// `sigma`.
    pub detuning: f64,
    /// `gamma`.
    pub forcing_per_clearance: f64,
}

/// What decides the stability of a fixed point of the slow flow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stability {
    /// Rows: rates of `u` and `eta`; columns: by `u` and `eta`.
    pub jacobian: [[f64; 2]; 2],
    /// Sum of the eigenvalues.
    pub trace: f64,
    /// Product of the eigenvalues.
    pub determinant: f64,
}

/// The derived expressions, compiled.
#[derive(Debug, Clone)]
pub struct Programs {
    short_hands: Compiled<1>,
    curvature: Compiled<1>,
    square: Compiled<1>,
    special_points: Compiled<6>,
    by_ratio: Compiled<5>,
    by_shift: Compiled<5>,
    by_detuning: Compiled<3>,
    saddle_node: Compiled<6>,
    saddle_node_by_detuning: Compiled<3>,
    forcing_squared: Compiled<1>,
    sides: Compiled<2>,
    hopf: Compiled<3>,
    breaking: Compiled<3>,
    meeting_detuning: Compiled<1>,
    rates: Compiled<2>,
    stability: Compiled<6>,
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
        let [[a, b], [c, d]] = &slow_flow.jacobian;
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
            by_ratio: Compiled::new(fixed_points.by_ratio.each_ref()),
            by_shift: Compiled::new(fixed_points.by_shift.each_ref()),
            by_detuning: Compiled::new(fixed_points.by_detuning.each_ref()),
            saddle_node: Compiled::new(fixed_points.saddle_node_by_shift.each_ref()),
            saddle_node_by_detuning: Compiled::new(fixed_points.saddle_node_by_detuning.each_ref()),
            forcing_squared: Compiled::new([&with_shift(&fixed_points.forcing_squared)]),
            sides: Compiled::new([&fixed_points.sine, &with_shift(&fixed_points.cosine)]),
            hopf: Compiled::new(boundaries.hopf.each_ref()),
            breaking: Compiled::new(boundaries.breaking.each_ref()),
            meeting_detuning: Compiled::new([&boundaries.meeting_detuning]),
            rates: Compiled::new([&slow_flow.ratio_rate, &slow_flow.phase_rate]),
            stability: Compiled::new([a, b, c, d, &slow_flow.trace, &slow_flow.determinant]),
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

    /// Coefficients of the fixed points' quartic by ascending powers of `u`; the ones to solve.
    /// Needs `lambda`, `rho`, `R`, `sigma`, `gamma`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn fixed_point_coefficients(&self, values: &Values) -> Result<[f64; 5], MissingValue> {
        self.by_shift.evaluate(values)
    }

    /// The same by ascending powers of `beta`, to show and to compare.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn fixed_point_coefficients_by_ratio(
        &self,
        values: &Values,
    ) -> Result<[f64; 5], MissingValue> {
        self.by_ratio.evaluate(values)
    }

    /// Coefficients of `c_2^2 d(gamma^2)/du` by ascending powers of `u`, whose roots are double
    /// fixed points. Needs `lambda`, `rho`, `R`, `sigma`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn saddle_node_coefficients(&self, values: &Values) -> Result<[f64; 6], MissingValue> {
        self.saddle_node.evaluate(values)
    }

    /// Coefficients, by ascending powers of `sigma`, of the condition that two fixed points collide
    /// at `u`. Needs `lambda`, `rho`, `R`, `u`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn saddle_node_detunings(&self, values: &Values) -> Result<[f64; 3], MissingValue> {
        self.saddle_node_by_detuning.evaluate(values)
    }

    /// `gamma^2` for which a point of the manifold is a fixed point. Needs a point (see
    /// [`Programs::at_shift`]), `lambda`, `rho`, `sigma`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn forcing_squared(&self, point: &Values) -> Result<f64, MissingValue> {
        self.forcing_squared.evaluate(point).map(|[value]| value)
    }

    /// Coefficients, by ascending powers of `sigma`, of the condition that a point of the manifold
    /// is a fixed point: the frequency response. Needs a point, `lambda`, `rho`, `gamma`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn detuning_coefficients(&self, point: &Values) -> Result<[f64; 3], MissingValue> {
        self.by_detuning.evaluate(point)
    }

    /// `eta` of a fixed point, in radians from -pi to pi. Needs a point, `lambda`, `rho`, `sigma`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn excitation_phase(&self, point: &Values) -> Result<f64, MissingValue> {
        let [sine, cosine] = self.sides.evaluate(point)?;
        Ok(libm::atan2(sine, cosine))
    }

    /// `gamma^2` of the Hopf boundary by ascending powers of `sigma`. Take `gamma^2` off the first
    /// one to solve for the detuning. Needs `lambda`, `rho`, `R`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn hopf_coefficients(&self, values: &Values) -> Result<[f64; 3], MissingValue> {
        self.hopf.evaluate(values)
    }

    /// `gamma^2` of the symmetry-breaking boundary by ascending powers of `sigma`. Needs
    /// `lambda`, `rho`, `R`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn breaking_coefficients(&self, values: &Values) -> Result<[f64; 3], MissingValue> {
        self.breaking.evaluate(values)
    }

    /// `gamma` of the Hopf boundary at `sigma`. Needs `lambda`, `rho`, `R`, `sigma`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn hopf_forcing(&self, values: &Values) -> Result<f64, MissingValue> {
        let detuning = values.require(Symbol::Detuning)?;
        Ok(root_of_quadratic(self.hopf_coefficients(values)?, detuning))
    }

    /// `gamma` of the symmetry-breaking boundary at `sigma`. Needs `lambda`, `rho`, `R`, `sigma`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn breaking_forcing(&self, values: &Values) -> Result<f64, MissingValue> {
        let detuning = values.require(Symbol::Detuning)?;
        Ok(root_of_quadratic(self.breaking_coefficients(values)?, detuning))
    }

    /// P1. Needs `lambda`, `rho`, `R`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn meeting_point(&self, values: &Values) -> Result<MeetingPoint, MissingValue> {
        let [detuning] = self.meeting_detuning.evaluate(values)?;
        let forcing_per_clearance = root_of_quadratic(self.hopf_coefficients(values)?, detuning);
        Ok(MeetingPoint { detuning, forcing_per_clearance })
    }

    /// Rates of `u` and `eta` in slow time. Needs a point, `eta`, `lambda`, `rho`, `R`, `sigma`,
    /// `gamma`; infinite at the fold.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn slow_flow(&self, point: &Values) -> Result<[f64; 2], MissingValue> {
        self.rates.evaluate(point)
    }

    /// Jacobian of the slow flow, its trace and determinant. Needs what [`Programs::slow_flow`]
    /// needs.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn stability(&self, point: &Values) -> Result<Stability, MissingValue> {
        let [a, b, c, d, trace, determinant] = self.stability.evaluate(point)?;
        Ok(Stability { jacobian: [[a, b], [c, d]], trace, determinant })
    }
}

/// Square root of a quadratic that is a sum of squares, so that only rounding takes it below 0.
fn root_of_quadratic([constant, linear, quadratic]: [f64; 3], variable: f64) -> f64 {
    libm::sqrt((constant + variable * (linear + variable * quadratic)).max(0.0))
}
