//! Symmetric 1:1 orbits in closed form: two impacts per excitation period, half a period apart.
//!
//! [`equations`](super::equations) states and derives what is evaluated here: the steady motion at an impact
//! is linear in the absorber's amplitude `beta` (lengths over the clearance), so that its squared amplitude,
//!
//! `(1 - A beta)^2 + (D beta)^2 = gamma^2 chi^2`, `chi` the linear amplitude per unit of `gamma`,
//!
//! is the slow invariant manifold (16) and its fixed points in one, at any mass ratio. Each `beta` belongs
//! to one forcing; each forcing to at most two orbits.
//!
//! Friction alone leaves a cavity its mirror image, and adds constants. With `w = 4 beta/T` the absorber leaves the wall
//! `+b` with `w + f T/4` and arrives with `-w + f T/4`; `o = eps f` is where the oscillator rests meanwhile. With
//! `(p_1, p_2) = (Phi + I)^-1 (1, 0)` the steady motion is `X = 1 - o (1 - 2 p_1) - A beta`,
//! `Omega V = f T/4 + 2 o p_2 - Omega D beta`: the same quadratic with other constants. An inclined cavity, and one
//! whose ends differ, have no symmetric orbits.

use nalgebra::Vector2;
use serde::Serialize;

use super::admissibility::Admissibility;
use super::cycle::{Closure, Convergence, Cycle};
use super::equations as formulas;
use super::flight::OrbitFlight;
use super::impact_map::{AfterImpact, ImpactMap, Wall};
use super::measures::Peaks;
use super::newton::Linearised;
use super::orbit::{Orbit, Origin};
use super::{MOST_HIDDEN, OrbitError};
use crate::numerics::bracket::bisected;
use crate::numerics::scan::sign_changes;
use crate::system::{Excitation, System};

/// Share of a flight before its end that is not searched for a grazing: there `k` is a difference of numbers near 1.
const BEFORE_IMPACT: f64 = 1e-4;
/// After an impact it is a series while angles and decay are below this, of so many terms: the next is below rounding.
const EARLY: f64 = 0.1;
const TERMS: usize = 12;
/// E-folds after which nothing is left of the free oscillation.
const FADED: f64 = 40.0;
/// Share of a flight within which a grazing is no other event than that the absorber stays on the wall.
const AT_IMPACT: f64 = 1e-12;
/// Pieces per radian of the faster of oscillator and excitation in which a grazing is looked for: too
/// short for more than two turning points, and two are found.
const PIECES_PER_RADIAN: f64 = 8.0;

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
    /// `a - 1`, which for almost plastic impacts is almost nothing.
    #[serde(skip)]
    parting: f64,
    /// What friction adds to the steady motion at an impact, displacement and velocity over `Omega`.
    #[serde(skip)]
    shift: [f64; 2],
    /// What it adds to both velocities after an impact.
    #[serde(skip)]
    kick: f64,
}

/// A symmetric 1:1 orbit. Lengths over the clearance, fast time, angles in radians.
///
/// With the system of the crate page:
///
/// ```
/// # use vinesink_core::system::{Cavity, Excitation, Parameters, System};
/// # let system = System::new(Parameters {
/// #     mass_ratio: 0.032 / 4.168, damping: 1.799, restitution: 0.6, frequency_ratio: 8.0 / 8.349,
/// #     forcing_per_clearance: 4.3417, excitation: Excitation::BaseDisplacement,
/// #     cavity: Cavity::IDEAL,
/// # })?;
/// use vinesink_core::analysis::Analysis;
/// use vinesink_core::orbits::{Measures, symmetric_orbits};
///
/// let orbits = symmetric_orbits(&system)?;
/// assert_eq!(orbits.len(), 2);
/// let steady = orbits.iter().find(|one| one.orbit.attracts()).expect("one attracts");
/// assert_eq!(steady.orbit.cycle.sequence(), "+-");
/// assert!((steady.impact_displacement - (1.0 - steady.absorber_amplitude)).abs() < 1e-12);
/// // Work, damper and impacts balance over a period.
/// let energy = Measures::of(&system, &steady.orbit.cycle)?.energy;
/// assert!(energy.relative_residual < 1e-12);
/// // The theory has the same motion to first order in the mass ratio of 0.77 %.
/// let theory = Analysis::of(&system)?.stable_points().next().expect("one").absorber_amplitude;
/// assert!((theory / steady.absorber_amplitude - 1.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
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
    /// [`OrbitError::NoSteadyMotion`] for an undamped oscillator driven at its natural frequency,
    /// [`OrbitError::RealCavity`] for one that is inclined or whose ends differ.
    pub fn of(system: &System) -> Result<Self, OrbitError> {
        let symmetric = system.cavity().is_symmetric();
        let flight = OrbitFlight::of(system)?;
        if symmetric { Ok(Self::with(system, &flight)) } else { Err(OrbitError::RealCavity) }
    }

    pub(super) fn with(system: &System, flight: &OrbitFlight) -> Self {
        let (eps, r) = (system.mass_ratio(), system.restitution());
        let omega = system.frequency_ratio();
        let period = formulas::PERIOD.at([omega]);
        let [q1, q2] = flight.repeated_impulse();
        let friction = system.cavity().friction_acceleration;
        let (rest, kick) = (eps * friction, 0.25 * friction * period);
        let [p1, p2] = flight.repeated_displacement();
        let shift = [-rest * (1.0 - 2.0 * p1), (kick + 2.0 * rest * p2) / omega];
        let rebound = formulas::VELOCITY_RATIO_AFTER.at([eps, r]);
        let stiffness = formulas::STIFFNESS.at([omega]);
        let loss = formulas::LOSS.at([eps, system.damping(), omega]);
        let gain = match system.excitation() {
            Excitation::BaseDisplacement => &formulas::BASE_GAIN,
            Excitation::Force => &formulas::FORCE_GAIN,
        };
        Self {
            displacement: formulas::DISPLACEMENT_LOSS.at([eps, period, q1]),
            velocity: formulas::VELOCITY_LOSS.at([eps, omega, period, q2, rebound]),
            rebound,
            parting: -2.0 * r * (1.0 + eps) / (1.0 + r),
            gain: gain.at([eps, stiffness, loss]),
            half_period: 0.5 * period,
            shift,
            kick,
        }
    }

    /// `gamma`, forcing over the clearance, at which the orbit with `beta` exists.
    pub fn forcing(&self, beta: f64) -> f64 {
        if self.kick == 0.0 {
            return formulas::FORCING.at([beta, self.gain, self.displacement, self.velocity]);
        }
        let [x, v] = self.steady(beta);
        libm::hypot(x, v) / self.gain
    }

    /// `X` and `V` of the orbit with `beta`.
    fn steady(&self, beta: f64) -> [f64; 2] {
        [
            formulas::DISPLACEMENT.at([1.0, beta, self.displacement]) + self.shift[0],
            formulas::VELOCITY.at([beta, self.velocity]) + self.shift[1],
        ]
    }

    /// `beta`, over the clearance, where the two orbits collide: the saddle-node.
    pub fn turning(&self) -> f64 {
        let (a, d) = (self.displacement, self.velocity);
        if self.kick == 0.0 {
            return formulas::TURNING_RATIO.at([a, d]);
        }
        (a * (1.0 + self.shift[0]) + d * self.shift[1]) / (a * a + d * d)
    }

    /// Acceleration with which the wall of an ideal cavity leaves the absorber behind after an impact, at `beta`: linear
    /// in it, as the motion at impact and the steady motion both are.
    pub(super) fn departure(&self, flight: &OrbitFlight, beta: f64) -> f64 {
        let omega = flight.frequency();
        omega * omega - self.departure_slope(flight) * beta
    }

    /// `beta` beyond which the wall does not leave the absorber behind after an impact; of
    /// consequence where the impact leaves them no relative velocity.
    pub(super) fn sticking(&self, flight: &OrbitFlight) -> Option<f64> {
        let omega = flight.frequency();
        let beta = omega * omega / self.departure_slope(flight);
        (beta > 0.0 && beta.is_finite()).then_some(beta)
    }

    fn departure_slope(&self, flight: &OrbitFlight) -> f64 {
        let omega = flight.frequency();
        let [x, v] = self.deviation(omega);
        omega * omega * self.displacement - flight.damping() * v - x
    }

    /// Deviation from the steady motion after the impact on the `+b` wall, displacement and velocity, per
    /// `beta`.
    fn deviation(&self, omega: f64) -> [f64; 2] {
        let velocity = 2.0 * self.rebound / self.half_period + omega * self.velocity;
        [self.displacement - 1.0, velocity]
    }

    /// `k` and its rate in an ideal cavity a time `s` after the impact on the `+b` wall: the relative displacement of the
    /// orbit with `beta` is `w = cos(Omega s) + beta k(s)`. Both vanish with the impacts' own wall
    /// distance: `k = 0` at either end of the flight.
    pub(super) fn sway(&self, flight: &OrbitFlight, s: f64) -> [f64; 2] {
        let omega = flight.frequency();
        let (sin, cos) = libm::sincos(omega * s);
        let free = flight.free(s) * Vector2::from(self.deviation(omega));
        let (a, d) = (self.displacement, self.velocity);
        let speed = 2.0 / self.half_period;
        [
            free.x - a * cos - d * sin + (1.0 - speed * s),
            free.y + omega * (a * sin - d * cos) - speed,
        ]
    }

    /// The same right after the impact, by its series: sums that do not cancel.
    fn early_sway(&self, flight: &OrbitFlight, s: f64) -> [f64; 2] {
        let (omega, damping) = (flight.frequency(), flight.damping());
        let [mut free, mut free_rate] = self.deviation(omega);
        let (mut steady, mut steady_rate) = (-self.displacement, -self.velocity * omega);
        let first = self.parting * 2.0 / self.half_period;
        let (mut k, mut rate) = (first * s, first);
        let mut factor = s;
        for order in 2..=TERMS {
            (free, free_rate) = (free_rate, -damping * free_rate - free);
            (steady, steady_rate) = (steady_rate, -omega * omega * steady);
            let derivative = free_rate + steady_rate;
            rate += derivative * factor;
            factor *= s / order as f64;
            k += derivative * factor;
        }
        [k, rate]
    }

    /// `beta` above which the absorber passes a wall between impacts: the smallest at which
    /// `w = cos(Omega s) + beta k(s)` is 1 or -1 at some `s`, so that it turns there.
    pub(super) fn grazing(&self, flight: &OrbitFlight) -> Option<f64> {
        let omega = flight.frequency();
        let ranges = self.ranges(flight);
        let largest = |wall: f64| {
            // `1/beta` with `w = wall` at `s`, and the sign of its rate.
            let inverse = |s: f64| {
                let ([k, rate], (sin, cos)) = (self.sway(flight, s), libm::sincos(omega * s));
                let room = 1.0 - wall * cos;
                (wall * k / room, wall * rate * room - k * omega * sin)
            };
            let turns = ranges
                .iter()
                .flat_map(|(range, pieces)| sign_changes(*range, *pieces, |s| inverse(s).1));
            turns.map(|s| inverse(s).0).fold(0.0, f64::max)
        };
        let largest = largest(1.0).max(largest(-1.0)).max(self.early_grazing(flight));
        (largest > 0.0).then(|| 1.0 / largest)
    }

    /// Until when the series holds.
    fn early(&self, flight: &OrbitFlight) -> f64 {
        EARLY * self.half_period.min(1.0 / flight.frequency().max(flight.damping()).max(1.0))
    }

    /// Where a grazing is looked for after that, in pieces too short for more than two turning points: longer and longer ones
    /// while a fast decay ends, those of the oscillator until it has faded, then those of the excitation.
    fn ranges(&self, flight: &OrbitFlight) -> Vec<([f64; 2], u32)> {
        let (omega, half_damping) = (flight.frequency(), 0.5 * flight.damping());
        let end = (1.0 - BEFORE_IMPACT) * self.half_period;
        let step = 1.0 / (PIECES_PER_RADIAN * omega.max(1.0));
        let mut from = self.early(flight);
        let mut ranges = Vec::new();
        while from < step.min(end) {
            let to = (2.0 * from).min(end);
            ranges.push(([from, to], 2));
            from = to;
        }
        let slowest = if half_damping > 1.0 { 0.5 / half_damping } else { half_damping };
        let rung = (FADED / slowest).clamp(from, end);
        for (to, fastest) in [(rung, omega.max(1.0)), (end, omega)] {
            let pieces = ((to - from) * fastest * PIECES_PER_RADIAN).ceil();
            if to > from {
                ranges.push(([from, to], (pieces as u32).max(2)));
            }
            from = to;
        }
        ranges
    }

    /// `1/beta` of a grazing right after the impact, on the wall that the absorber leaves; 0 where there is none.
    fn early_grazing(&self, flight: &OrbitFlight) -> f64 {
        let range = [AT_IMPACT * self.half_period, self.early(flight)];
        let inverse = |s: f64| {
            let ([k, rate], half) = (self.early_sway(flight, s), 0.5 * flight.frequency() * s);
            let (sin, cos) = libm::sincos(half);
            let room = 2.0 * sin * sin;
            (k / room, rate * room - k * flight.frequency() * 2.0 * sin * cos)
        };
        // Where nothing parts the two this is the sticking.
        let turns = bisected(range, |s| inverse(s).1).filter(|_| self.parting < 0.0);
        turns.map_or(0.0, |s| inverse(s).0)
    }

    /// `beta` of the orbits at the squared linear amplitude `squared`, ascending, positive ones only.
    pub fn absorber_amplitudes(&self, squared: f64) -> Vec<f64> {
        let (a, d) = (self.displacement, self.velocity);
        if self.kick != 0.0 {
            return self.rubbed_amplitudes(squared);
        }
        let discriminant = formulas::DISCRIMINANT.at([squared, a, d]);
        if discriminant.is_nan() || discriminant < 0.0 {
            return Vec::new();
        }
        let far = if a >= 0.0 { &formulas::LARGER_RATIO } else { &formulas::SMALLER_RATIO };
        let far = far.at([discriminant, a, d]);
        let mut found = vec![far];
        if far != 0.0 {
            found.push(formulas::RATIO_PRODUCT.at([squared, a, d]) / far);
        }
        found.retain(|beta| beta.is_finite() && *beta > 0.0);
        found.sort_by(f64::total_cmp);
        found.dedup();
        found
    }

    /// The same where friction adds constants.
    fn rubbed_amplitudes(&self, squared: f64) -> Vec<f64> {
        let (a, d, [x, v]) = (self.displacement, self.velocity, self.steady(0.0));
        let (square, mixed, cross) = (a * a + d * d, a * x + d * v, a * v - d * x);
        let discriminant = square * squared - cross * cross;
        if discriminant.is_nan() || discriminant < 0.0 {
            return Vec::new();
        }
        let far = (mixed + discriminant.sqrt().copysign(mixed)) / square;
        let mut found = vec![far, (x * x + v * v - squared) / (square * far)];
        found.retain(|beta| beta.is_finite() && *beta > 0.0);
        found.sort_by(f64::total_cmp);
        found.dedup();
        found
    }

    /// The state after the impact on the `+b` wall on the orbit with `beta`.
    pub fn after_impact(&self, flight: &OrbitFlight, beta: f64) -> AfterImpact {
        let speed = formulas::SPEED.at([2.0 * self.half_period, beta]);
        let [s, c] = flight.steady();
        let [x, v] = self.steady(beta);
        AfterImpact {
            wall: Wall::Plus,
            phase: formulas::PHASE.at([s, c, x, v]),
            x: 1.0 - beta,
            x_velocity: formulas::VELOCITY_AFTER.at([self.rebound, speed]) + self.kick,
            y_velocity: speed + self.kick,
        }
    }

    /// The orbit with `beta`, as half a cycle.
    pub fn cycle(&self, flight: &OrbitFlight, beta: f64) -> Cycle {
        Cycle {
            closure: Closure::Mirrors { periods: 1 },
            impacts: vec![self.after_impact(flight, beta)],
            durations: vec![self.half_period],
        }
    }
}

/// Both symmetric 1:1 orbits of a system, or one, or none; ascending in `beta`. A cavity that is inclined, or whose ends
/// differ, has none: [`two_impact_orbits`](super::two_impact_orbits) are what becomes of them.
///
/// # Errors
/// [`OrbitError::NoSteadyMotion`] for an undamped oscillator driven at its natural frequency, [`OrbitError::Hidden`] so close
/// to that that rounding hides the orbits.
pub fn symmetric_orbits(system: &System) -> Result<Vec<SymmetricOrbit>, OrbitError> {
    let map = ImpactMap::of(system)?;
    if !system.cavity().is_symmetric() {
        return Ok(Vec::new());
    }
    let curve = SymmetricCurve::with(system, &map.flight);
    let [s, c] = map.flight.steady();
    let square = formulas::STEADY_SQUARE.at([1.0, s, c]);
    let found = curve.absorber_amplitudes(square);
    for beta in &found {
        let times = square.sqrt() / curve.cycle(&map.flight, *beta).size();
        if times > MOST_HIDDEN {
            return Err(OrbitError::Hidden { times });
        }
    }
    Ok(found.iter().filter_map(|beta| symmetric_orbit(system, &map, &curve, *beta)).collect())
}

/// The symmetric orbit of a system that attracts; `None` where none does.
pub fn attracting_orbit(system: &System) -> Option<SymmetricOrbit> {
    symmetric_orbits(system).ok()?.into_iter().find(|orbit| orbit.orbit.attracts())
}

/// The orbit with `beta`; `None` where its Jacobian does not exist.
fn symmetric_orbit(
    system: &System,
    map: &ImpactMap,
    curve: &SymmetricCurve,
    beta: f64,
) -> Option<SymmetricOrbit> {
    let cycle = curve.cycle(&map.flight, beta);
    let after = cycle.impacts[0];
    let linear = Linearised::of(map, &cycle, [0.0; 5]);
    let convergence = Convergence { residual: linear.residual / cycle.size(), iterations: 0 };
    let peaks = Peaks::of(map, &cycle);
    let origin = Origin::ClosedForm;
    let admissibility = Admissibility::of(map, &cycle);
    let orbit =
        Orbit::measured(cycle, &linear.jacobian, convergence, admissibility, origin).ok()?;
    let (eps, r) = (system.mass_ratio(), system.restitution());
    let speed = formulas::SPEED.at([2.0 * curve.half_period, beta]);
    Some(SymmetricOrbit {
        absorber_amplitude: beta,
        impact_displacement: after.x,
        phase: after.phase,
        peaks,
        impulse: 2.0 * eps * speed,
        impact_speed: formulas::IMPACT_SPEED.at([eps, r, speed]),
        orbit,
    })
}
