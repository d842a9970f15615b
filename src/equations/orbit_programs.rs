//! Numbers of exact symmetric orbits from the derived expressions.
//!
//! The expressions build on one another through named quantities; a program here evaluates them in
//! order and sets the symbol of each.

use super::{SteadyMotion, SymmetricOrbits};
use crate::symbolic::{Compiled, Expr, MissingValue, Symbol, Values};
use crate::system::Excitation;

/// The saddle-node of the symmetric orbits, where two of them meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turning {
    /// `beta`, amplitude of the absorber over the clearance.
    pub ratio: f64,
    /// `gamma`, the least forcing per clearance that has a symmetric orbit.
    pub forcing_per_clearance: f64,
}

/// The expressions of [`SymmetricOrbits`], compiled.
#[derive(Debug, Clone)]
pub struct OrbitPrograms {
    curve: Chain,
    gain_of_base: Compiled<1>,
    gain_by_force: Compiled<1>,
    coefficients: Compiled<3>,
    discriminant: Compiled<1>,
    ratios: Compiled<2>,
    forcing_squared: Compiled<1>,
    turning: Compiled<2>,
    point: Chain,
    steady_of_base: Compiled<2>,
    steady_by_force: Compiled<2>,
    phase: Compiled<2>,
}

/// Quantities in an order in which each needs only those before it.
#[derive(Debug, Clone)]
struct Chain(Vec<(Symbol, Compiled<1>)>);

impl Chain {
    fn new<const N: usize>(quantities: [(Symbol, &Expr); N]) -> Self {
        Self(quantities.map(|(symbol, by)| (symbol, Compiled::new([by]))).to_vec())
    }

    fn set(&self, values: &mut Values) -> Result<(), MissingValue> {
        for (symbol, program) in &self.0 {
            let [value] = program.evaluate(values)?;
            values.set(*symbol, value);
        }
        Ok(())
    }
}

impl OrbitPrograms {
    pub(super) fn new(orbits: &SymmetricOrbits) -> Self {
        let conditions = &orbits.conditions;
        let steady = |motion: &SteadyMotion| Compiled::new([&motion.sine, &motion.cosine]);
        let position = Symbol::Clearance - Symbol::AbsorberAmplitude;
        let absorber = Symbol::ImpactDisplacement - Symbol::Clearance;
        let amplitude = Symbol::AmplitudeRatio * Symbol::Clearance;
        let after = Symbol::VelocityRatioAfter * Symbol::YDotAfter;
        let before = Symbol::VelocityRatioBefore * Symbol::YDotAfter;
        Self {
            curve: Chain::new([
                (Symbol::Period, &conditions.period.right),
                (Symbol::Stiffness, &conditions.stiffness.right),
                (Symbol::Loss, &conditions.loss.right),
                (Symbol::RepeatedVelocity, &orbits.repeated_velocity),
                (Symbol::RepeatedDisplacement, &orbits.repeated_displacement),
                (Symbol::VelocityRatioAfter, &orbits.velocity_after),
                (Symbol::VelocityRatioBefore, &orbits.velocity_before),
                (Symbol::DisplacementCoefficient, &orbits.displacement_coefficient),
                (Symbol::VelocityCoefficient, &orbits.velocity_coefficient),
            ]),
            gain_of_base: Compiled::new([&orbits.steady_of_base.gain]),
            gain_by_force: Compiled::new([&orbits.steady_by_force.gain]),
            coefficients: Compiled::new(orbits.by_ratio.each_ref()),
            discriminant: Compiled::new([&orbits.discriminant]),
            ratios: Compiled::new(orbits.ratios.each_ref()),
            forcing_squared: Compiled::new([&orbits.forcing_squared]),
            turning: Compiled::new([&orbits.turning_ratio, &orbits.turning_forcing]),
            point: Chain::new([
                (Symbol::AbsorberAmplitude, &amplitude),
                (Symbol::ImpactDisplacement, &position),
                (Symbol::ImpactAbsorber, &absorber),
                (Symbol::YDotAfter, &orbits.speed),
                (Symbol::YDotBefore, &conditions.arrival.right),
                (Symbol::XDotAfter, &after),
                (Symbol::XDotBefore, &before),
                (Symbol::WDotBefore, &orbits.impact_speed),
                (Symbol::SteadyDisplacement, &orbits.displacement),
                (Symbol::SteadyVelocity, &orbits.velocity),
            ]),
            steady_of_base: steady(&orbits.steady_of_base),
            steady_by_force: steady(&orbits.steady_by_force),
            phase: Compiled::new([&orbits.phase_sine, &orbits.phase_cosine]),
        }
    }

    /// The same values with all that the orbits of a system share: `T`, `kappa`, `delta`, `q_1`,
    /// `q_2`, `v_+`, `v_-`, `A`, `D`, `chi`, and `X_s`, `X_c` if `G` is set. Needs `epsilon`,
    /// `lambda`, `r`, `Omega`, and `g`, `g'` of the free oscillator at `T/2`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn curve(&self, values: &Values, excitation: Excitation) -> Result<Values, MissingValue> {
        let mut values = values.clone();
        self.curve.set(&mut values)?;
        let (gain, steady) = match excitation {
            Excitation::BaseDisplacement => (&self.gain_of_base, &self.steady_of_base),
            Excitation::Force => (&self.gain_by_force, &self.steady_by_force),
        };
        let [gain] = gain.evaluate(&values)?;
        values.set(Symbol::LinearGain, gain);
        if let Ok([sine, cosine]) = steady.evaluate(&values) {
            values.set(Symbol::SteadySine, sine);
            values.set(Symbol::SteadyCosine, cosine);
        }
        Ok(values)
    }

    /// Coefficients, by ascending powers of `beta`, of the quadratic of the orbits. Needs a curve
    /// (see [`OrbitPrograms::curve`]) and `gamma`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn coefficients(&self, curve: &Values) -> Result<[f64; 3], MissingValue> {
        self.coefficients.evaluate(curve)
    }

    /// Roots of that quadratic, the smaller first; `None` if they are not real. Roots that are not
    /// above 0 are no orbits, and the one nearer to 0 has lost digits to the difference. Needs a curve and `gamma`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn ratios(&self, curve: &Values) -> Result<Option<[f64; 2]>, MissingValue> {
        let [discriminant] = self.discriminant.evaluate(curve)?;
        if discriminant.is_nan() || discriminant < 0.0 {
            return Ok(None);
        }
        let curve = curve.clone().with(Symbol::Discriminant, discriminant);
        self.ratios.evaluate(&curve).map(Some)
    }

    /// `gamma^2` at which the orbit with `beta` exists. Needs a curve and `beta`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn forcing_squared(&self, curve: &Values) -> Result<f64, MissingValue> {
        self.forcing_squared.evaluate(curve).map(|[value]| value)
    }

    /// Where the two orbits meet. Needs a curve.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn turning(&self, curve: &Values) -> Result<Turning, MissingValue> {
        let [ratio, forcing_per_clearance] = self.turning.evaluate(curve)?;
        Ok(Turning { ratio, forcing_per_clearance })
    }

    /// The same values on the orbit with `beta`: `beta`, `B`, `x_0`, `y_0`, all velocities at an
    /// impact, `X`, `X'`, `Delta`, and the phase `phi` (from -pi to pi) if `X_s`, `X_c` are set.
    /// Needs a curve, `gamma` and `b`.
    ///
    /// # Errors
    /// If a value is missing.
    pub fn at_ratio(&self, curve: &Values, ratio: f64) -> Result<Values, MissingValue> {
        let mut values = curve.clone().with(Symbol::AmplitudeRatio, ratio);
        self.point.set(&mut values)?;
        let [discriminant] = self.discriminant.evaluate(&values)?;
        // The orbit exists: only rounding takes the discriminant below 0.
        values.set(Symbol::Discriminant, discriminant.max(0.0));
        if let Ok([sine, cosine]) = self.phase.evaluate(&values) {
            values.set(Symbol::ImpactPhase, libm::atan2(sine, cosine));
        }
        Ok(values)
    }
}
