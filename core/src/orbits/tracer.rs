//! From one orbit of a branch to the next: pseudo-arclength continuation in one parameter (Keller
//! 1977). A predictor along the tangent, Newton's method on the plane across it.

use std::cell::OnceCell;

use nalgebra::{Matrix4, Vector4, Vector5};

use super::OrbitError;
use super::admissibility::Distances;
use super::cycle::Cycle;
use super::impact_map::ImpactMap;
use super::newton::{Converged, PARAMETER, converge, corrected};
use super::orbit::{Orbit, Origin};
use crate::system::{Parameter, System};

/// Smallest step before a branch is given up: the root of the precision of a point, over less the tangent
/// is rounding.
const SMALLEST_STEP: f64 = 1e-7;
/// Scale of a parameter whose first value is smaller: a restitution of 0 is no measure of its own
/// changes.
const SMALLEST_SCALE: f64 = 0.1;
/// Cosine of the angle by which a branch may turn in one step: 26 degrees, well short of taking the
/// far side of a fold for its near one.
const LARGEST_TURN: f64 = 0.9;
/// Distance to the orbit at the edge of a range, over the step, beyond which it is on another branch:
/// along this one it is a step away, and a little more where the branch is curved.
const SAME_BRANCH: f64 = 2.0;

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

    /// The parameter over its scale.
    pub fn parameter(&self) -> f64 {
        self.found.parameter
    }

    /// Jacobian of the map around the cycle.
    pub fn jacobian(&self) -> &Matrix4<f64> {
        &self.found.linear.jacobian
    }

    /// Newton steps that led to it.
    pub fn iterations(&self) -> u32 {
        self.found.convergence.iterations
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

    /// First state and scaled parameter, as the arclength measures them.
    pub fn place(&self) -> Vector5<f64> {
        self.cycle().impacts[0].vector().push(self.parameter())
    }
}

/// What a continuation works on.
pub(super) struct Tracer<'a> {
    base: &'a System,
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

    /// The parameter at a point.
    pub fn value(&self, point: &TracedPoint) -> f64 {
        point.parameter() * self.scale
    }

    /// How long a point's flights take, in radians of the faster of structure and excitation.
    pub fn radians(&self, point: &TracedPoint) -> f64 {
        let frequency = self.base.frequency_ratio().max(1.0);
        frequency * point.cycle().durations.iter().sum::<f64>()
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
    fn predicted(point: &TracedPoint, step: f64) -> Cycle {
        point.found.linear.moved(point.cycle(), &(point.tangent * step))
    }

    /// The point an arclength `step` along the branch from `point`.
    ///
    /// # Errors
    /// As [`Tracer::correct`].
    pub fn advance(&self, point: &TracedPoint, step: f64) -> Result<TracedPoint, OrbitError> {
        let ahead = step * point.tangent[4];
        self.correct(
            Self::predicted(point, step),
            point.parameter() + ahead,
            &point.tangent,
            &point.tangent,
        )
    }

    /// The next point, with the step that reached it: halved until the corrector converges and the
    /// branch turns little.
    ///
    /// # Errors
    /// Why no step down to [`SMALLEST_STEP`] reached one.
    pub fn next(
        &self,
        here: &TracedPoint,
        mut step: f64,
    ) -> Result<(TracedPoint, f64), OrbitError> {
        loop {
            let failure = match self.advance(here, step) {
                Ok(there) if there.tangent.dot(&here.tangent) >= LARGEST_TURN => {
                    return Ok((there, step));
                }
                Ok(_) => OrbitError::Singular,
                Err(failure) => failure,
            };
            step *= 0.5;
            if step < SMALLEST_STEP {
                return Err(failure);
            }
        }
    }

    /// The orbit at the edge of `range` (values of the parameter) and the value there, if the next
    /// step would leave it: parameters need not exist beyond (a restitution above 1).
    pub fn at_edge(
        &self,
        here: &TracedPoint,
        step: f64,
        range: [f64; 2],
    ) -> Option<(TracedPoint, f64)> {
        let [low, high] = range.map(|edge| edge / self.scale);
        let ahead = here.parameter() + step * here.tangent[4];
        let edge = if ahead > high {
            high
        } else if ahead < low {
            low
        } else {
            return None;
        };
        let change = edge - here.parameter();
        let share = change / here.tangent[4];
        let there = self
            .correct(Self::predicted(here, share), edge, &PARAMETER.into(), &here.tangent)
            .ok()?;
        // A branch that turns back before the edge must not be left for another one.
        let distance = (there.place() - here.place()).norm();
        let same = distance <= SAME_BRANCH * step.max(share.abs())
            && there.tangent.dot(&here.tangent) >= LARGEST_TURN;
        same.then_some((there, edge * self.scale))
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
