//! Symmetric 1:1 orbits in closed form: two impacts per excitation period, half a period apart.
//!
//! Half a period `T/2` after an impact at the `+b` wall everything has changed sign. With the
//! displacement `x0 = 1 - beta` at impact (lengths over the clearance, `beta > 0`) the absorber flies
//! with `u = 4 beta / T`, and equation (2) gives `x'+ = a u`, `a = (1 - r - 2 eps r)/(1 + r)`. With
//! `q = (Phi + I)^-1 (0, 1)`, `Phi` the free motion of the oscillator over `T/2`, the steady motion at
//! impact must be
//!
//! `X = 1 - A beta`, `X'/Omega = -D beta`, `A = 1 - 8 eps q1/T`, `D = -4 (a + 2 eps q2)/(Omega T)`,
//!
//! and since `X^2 + (X'/Omega)^2` is the squared linear amplitude,
//!
//! `(A^2 + D^2) beta^2 - 2 A beta + 1 = gamma^2 chi^2`, `chi` the linear amplitude per unit of `gamma`:
//!
//! the slow invariant manifold (16) and its fixed points in one, at any mass ratio. Each `beta` belongs
//! to one forcing; each forcing to at most two orbits.

use serde::Serialize;

use super::OrbitError;
use super::flight::Flight;
use super::impact_map::{AfterImpact, ImpactMap, Wall};
use super::measures::Peaks;
use super::newton::Convergence;
use super::orbit::{Closure, Cycle, Orbit, Origin};
use crate::system::System;

/// The coefficients that all symmetric orbits of a system share; the forcing enters nowhere.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SymmetricCurve {
    /// `A`.
    pub displacement: f64,
    /// `D`.
    pub velocity: f64,
    /// `a`, velocity of the oscillator after impact over the absorber's speed.
    pub rebound: f64,
    /// `chi`, amplitude of the steady motion over the clearance per unit of `gamma`.
    pub gain: f64,
    /// `T/2`, half the excitation period in fast time.
    pub half_period: f64,
}

/// A symmetric 1:1 orbit. Lengths over the clearance, fast time, angles in radians.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SymmetricOrbit {
    /// `beta`, the amplitude of the absorber's sawtooth; the exact counterpart of `B/b`.
    pub absorber_amplitude: f64,
    /// Displacement of the oscillator at the impacts on the `+b` wall, `x0 = 1 - beta`.
    pub impact_displacement: f64,
    /// Phase of the excitation at those impacts.
    pub phase: f64,
    /// Largest displacement and velocity of the oscillator.
    pub peaks: Peaks,
    /// Momentum handed over in each impact, over `m1`.
    pub impulse: f64,
    /// Relative speed `w'` at which the wall is met.
    pub impact_speed: f64,
    /// The orbit as a cycle, with its residual, multipliers of the half-period map and admissibility.
    pub orbit: Orbit,
}

impl SymmetricCurve {
    /// The curve of `system`.
    ///
    /// # Errors
    /// [`OrbitError::NoSteadyMotion`] for an undamped oscillator driven at its natural frequency.
    pub fn of(system: &System) -> Result<Self, OrbitError> {
        Ok(Self::with(system, &Flight::of(system)?))
    }

    pub(super) fn with(system: &System, flight: &Flight) -> Self {
        let (eps, r) = (system.mass_ratio(), system.restitution());
        let omega = system.frequency_ratio();
        let half_period = std::f64::consts::PI / omega;
        let [q1, q2] = flight.repeated_impulse();
        let rebound = (1.0 - r - 2.0 * eps * r) / (1.0 + r);
        let [s, c] = flight.steady();
        Self {
            displacement: 1.0 - 4.0 * eps * q1 / half_period,
            velocity: -2.0 * (rebound + 2.0 * eps * q2) / (omega * half_period),
            rebound,
            gain: libm::hypot(s, c) / system.forcing_per_clearance().max(f64::MIN_POSITIVE),
            half_period,
        }
    }

    /// Squared amplitude of the steady motion that the orbit with `beta` needs, over the clearance.
    pub fn squared_amplitude(&self, beta: f64) -> f64 {
        let x = 1.0 - self.displacement * beta;
        let v = self.velocity * beta;
        x * x + v * v
    }

    /// `gamma` at which the orbit with `beta` exists.
    pub fn forcing(&self, beta: f64) -> f64 {
        self.squared_amplitude(beta).sqrt() / self.gain
    }

    /// `beta` where the two orbits collide: the saddle-node, `A / (A^2 + D^2)`.
    pub fn turning(&self) -> f64 {
        let (a, d) = (self.displacement, self.velocity);
        a / (a * a + d * d)
    }

    /// Acceleration with which the wall leaves the absorber behind after an impact, at `beta`: linear
    /// in it, as the motion at impact and the steady motion both are.
    pub fn departure(&self, flight: &Flight, beta: f64) -> f64 {
        let omega = std::f64::consts::PI / self.half_period;
        omega * omega - self.departure_slope(flight) * beta
    }

    /// `beta` beyond which the wall does not leave the absorber behind after an impact; of
    /// consequence where the impact leaves them no relative velocity.
    pub fn sticking(&self, flight: &Flight) -> Option<f64> {
        let omega = std::f64::consts::PI / self.half_period;
        let beta = omega * omega / self.departure_slope(flight);
        (beta > 0.0 && beta.is_finite()).then_some(beta)
    }

    fn departure_slope(&self, flight: &Flight) -> f64 {
        let omega = std::f64::consts::PI / self.half_period;
        let velocity = 2.0 * self.rebound / self.half_period + omega * self.velocity;
        omega * omega * self.displacement - flight.damping() * velocity + (1.0 - self.displacement)
    }

    /// `beta` of the orbits at the squared linear amplitude `squared`, ascending, positive ones only.
    pub fn absorber_amplitudes(&self, squared: f64) -> Vec<f64> {
        let (a, d) = (self.displacement, self.velocity);
        let leading = a * a + d * d;
        // The discriminant without the cancellation of a^2 against it: a^2 squared - d^2 (1 - squared).
        let discriminant = leading * squared - d * d;
        if !(discriminant >= 0.0 && leading > 0.0) {
            return Vec::new();
        }
        let root = discriminant.sqrt();
        // The sum that does not cancel, and the other root from their product.
        let sum = if a >= 0.0 { a + root } else { a - root };
        let product = 1.0 - squared;
        let mut found = if sum == 0.0 { vec![0.0] } else { vec![sum / leading, product / sum] };
        found.retain(|beta| beta.is_finite() && *beta > 0.0);
        found.sort_by(f64::total_cmp);
        found.dedup();
        found
    }

    /// The state after the impact on the `+b` wall on the orbit with `beta`.
    pub fn after_impact(&self, flight: &Flight, beta: f64) -> AfterImpact {
        let speed = 2.0 * beta / self.half_period;
        let [s, c] = flight.steady();
        let x = 1.0 - self.displacement * beta;
        let v = -self.velocity * beta;
        AfterImpact {
            phase: libm::atan2(s * x - c * v, c * x + s * v),
            x: 1.0 - beta,
            x_velocity: self.rebound * speed,
            y_velocity: speed,
        }
    }

    /// The orbit with `beta`, as half a cycle.
    pub fn cycle(&self, flight: &Flight, beta: f64) -> Cycle {
        Cycle {
            closure: Closure::Mirrors { periods: 1 },
            walls: vec![Wall::Plus],
            impacts: vec![self.after_impact(flight, beta)],
            durations: vec![self.half_period],
        }
    }
}

/// Both symmetric 1:1 orbits of a system, or one, or none; ascending in `beta`.
///
/// # Errors
/// [`OrbitError::NoSteadyMotion`] for an undamped oscillator driven at its natural frequency.
pub fn symmetric_orbits(system: &System) -> Result<Vec<SymmetricOrbit>, OrbitError> {
    let map = ImpactMap::of(system)?;
    let curve = SymmetricCurve::with(system, &map.flight);
    let [s, c] = map.flight.steady();
    let found = curve.absorber_amplitudes(s * s + c * c);
    Ok(found.iter().filter_map(|beta| symmetric_orbit(system, &map, &curve, *beta)).collect())
}

/// The symmetric orbit of a system that attracts; `None` where none does.
pub fn attracting_orbit(system: &System) -> Option<SymmetricOrbit> {
    symmetric_orbits(system).ok()?.into_iter().find(|orbit| orbit.orbit.attracts())
}

/// The orbit with `beta`; `None` where its Jacobian does not exist.
pub(super) fn symmetric_orbit(
    system: &System,
    map: &ImpactMap,
    curve: &SymmetricCurve,
    beta: f64,
) -> Option<SymmetricOrbit> {
    let cycle = curve.cycle(&map.flight, beta);
    let after = cycle.impacts[0];
    let residual = closure_defect(map, &cycle);
    let convergence = Convergence { residual, iterations: 0 };
    let peaks = Peaks::of(map, &cycle);
    let orbit = Orbit::measured(map, cycle, convergence, Origin::ClosedForm).ok()?;
    let (eps, r) = (system.mass_ratio(), system.restitution());
    Some(SymmetricOrbit {
        absorber_amplitude: beta,
        impact_displacement: after.x,
        phase: after.phase,
        peaks,
        impulse: 2.0 * eps * after.y_velocity,
        impact_speed: 2.0 * after.y_velocity * (1.0 + eps) / (1.0 + r),
        orbit,
    })
}

/// How far the half-period map misses the mirror image, over the size of the orbit.
fn closure_defect(map: &ImpactMap, cycle: &Cycle) -> f64 {
    super::newton::Linearised::of(map, cycle, [0.0; 3]).residual / super::newton::size(cycle)
}
