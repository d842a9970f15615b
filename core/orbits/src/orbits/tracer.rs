//! Orbits of one mode with one absorber over one parameter, as [`super::continuation`] follows them.

use std::cell::OnceCell;

use nalgebra::{Matrix4, Vector4, Vector5};

use super::OrbitError;
use super::admissibility::Distances;
use super::continuation::Traced;
use super::cycle::Cycle;
use super::impact_map::ImpactMap;
use super::newton::{Converged, converge, corrected};
use super::orbit::{Orbit, Origin};
use crate::system::{Parameter, System};

/// Scale of a parameter whose first value is smaller: a restitution of 0 is no measure of its own
/// changes.
pub(super) const SMALLEST_SCALE: f64 = 0.1;
/// A point while a branch is followed: a cycle that closes. What it is as an orbit is measured only
/// where somebody asks, as most points serve to locate a bifurcation.
#[derive(Debug, Clone)]
pub(super) struct TracedPoint {
    found: Converged,
    /// Unit tangent of the branch in first state and scaled parameter.
    pub tangent: Vector5<f64>,
    distances: OnceCell<Distances>,
}

impl TracedPoint {
    /// The cycle.
    pub fn cycle(&self) -> &Cycle {
        &self.found.cycle
    }

    /// Jacobian of the map around the cycle.
    pub fn jacobian(&self) -> &Matrix4<f64> {
        &self.found.linear.jacobian
    }

    /// How close it comes to the walls and how slowly to impacts; whether it is a motion is not proven.
    pub fn distances(&self) -> &Distances {
        self.distances.get_or_init(|| Distances::of(&self.found.map, self.cycle()))
    }

    /// The orbit with its evidence.
    ///
    /// # Errors
    /// As [`Orbit::measured`].
    pub fn orbit(&self, origin: Origin) -> Result<Orbit, OrbitError> {
        let Converged { cycle, map, linear, convergence, .. } = &self.found;
        let admissibility = self.distances().proven(map, cycle);
        Orbit::measured(cycle.clone(), &linear.jacobian, *convergence, admissibility, origin)
    }
}

/// What a continuation works on.
pub(super) struct Tracer<'a> {
    /// What everything else is.
    pub base: &'a System,
    /// What varies.
    pub parameter: Parameter,
    /// The parameter's unit in a [`TracedPoint`].
    pub scale: f64,
}

impl<'a> Tracer<'a> {
    /// Over `parameter`, everything else being as in `base`.
    pub fn new(base: &'a System, parameter: Parameter) -> Self {
        let own = parameter.of(base).abs();
        let scale = match parameter {
            // Accelerations that may be none, in units in which the motion's are about 1.
            Parameter::GravityAlong | Parameter::FrictionAcceleration => own.max(1.0),
            _ => own.max(SMALLEST_SCALE),
        };
        Self { base, parameter, scale }
    }

    /// The impact map at a scaled parameter, and [`Parameter::derivatives`] over its scale.
    fn map(&self, scaled: f64) -> Option<(ImpactMap, [f64; 5])> {
        let value = scaled * self.scale;
        let system = self.parameter.applied(self.base, value).ok()?;
        let weights = self.parameter.derivatives(self.base, value).map(|w| w * self.scale);
        Some((ImpactMap::of(&system).ok()?, weights))
    }

    /// The impact map at a scaled parameter.
    pub fn map_at(&self, scaled: f64) -> Option<ImpactMap> {
        self.map(scaled).map(|(map, _)| map)
    }

    /// The orbit near `cycle` at a scaled parameter, if Newton's method finds it.
    pub fn at(&self, cycle: &Cycle, scaled: f64) -> Option<Orbit> {
        converge(&self.map_at(scaled)?, cycle).ok()?.orbit(Origin::Switching).ok()
    }

    /// Corrects `cycle` at `scaled` onto the plane `normal . (dz, dp) = 0` through it, and finds the
    /// tangent there, pointing along `along`.
    ///
    /// # Errors
    /// [`OrbitError`] where there is no system, or Newton's method does not converge.
    pub fn correct(
        &self,
        cycle: Cycle,
        scaled: f64,
        normal: &Vector5<f64>,
        along: &Vector5<f64>,
    ) -> Result<TracedPoint, OrbitError> {
        let found = corrected(|scaled| self.map(scaled), cycle, scaled, normal)?;
        let tangent = found.linear.solve(along, Vector4::zeros(), 1.0)?;
        let tangent = tangent / tangent.norm();
        Ok(TracedPoint { found, tangent, distances: OnceCell::new() })
    }

    /// `point`'s cycle moved along the branch's tangent by `step`.
    pub fn predicted(point: &TracedPoint, step: f64) -> Cycle {
        point.found.linear.moved(point.cycle(), &(point.tangent * step))
    }
}

impl Traced for TracedPoint {
    type Place = [f64; 5];
    fn place(&self) -> [f64; 5] {
        self.cycle().impacts[0].vector().push(self.found.parameter).into()
    }
    fn tangent(&self) -> &[f64] {
        self.tangent.as_slice()
    }
    fn iterations(&self) -> u32 {
        self.found.convergence.iterations
    }
    fn parameter(&self) -> f64 {
        self.found.parameter
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{Cavity, Excitation, Parameters};

    /// Against central differences of the systems themselves.
    #[test]
    fn weights_are_the_derivatives_of_the_applied_parameter() {
        let base = System::new(Parameters {
            mass_ratio: 0.01,
            damping: 1.5,
            restitution: 0.6,
            frequency_ratio: 0.95,
            forcing_per_clearance: 3.0,
            excitation: Excitation::BaseDisplacement,
            cavity: Cavity { gravity_along: 0.03, friction_acceleration: 0.02, ..Cavity::IDEAL },
        })
        .expect("valid");
        for parameter in Parameter::OF_SYSTEM {
            let (value, h) = (0.8, 1e-5);
            let at = |value| {
                let there = parameter.applied(&base, value).expect("valid");
                let Cavity { gravity_along: a, friction_acceleration: f, .. } = there.cavity();
                let [gamma, omega] = [there.forcing_per_clearance(), there.frequency_ratio()];
                [gamma, omega, there.restitution(), a, f]
            };
            let (up, down) = (at(value + h), at(value - h));
            for (k, weight) in parameter.derivatives(&base, value).iter().enumerate() {
                // h^2 times a third derivative of 3 / 0.8^4 and rounding over h.
                let difference = (up[k] - down[k]) / (2.0 * h);
                assert!((difference - weight).abs() < 1e-8, "{parameter:?} {k}: {difference}");
            }
        }
    }
}
