//! A motion with two impacts per cycle, from the times between its impacts.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use serde::Serialize;

use super::CavityTheory;
use super::linear_map::trace_and_determinant;
use super::shape::{MotionShape, ShapeChange};
use crate::equations::cavity::{
    ABSORBER, AMPLITUDE, CONTACT, DRIFT, FACTOR, IMPULSE, IN_PHASE, QUADRATURE, REACTANCE,
    RESISTANCE, SIDE, TIME_1, TIME_2, VELOCITY_1, VELOCITY_2,
};
use crate::numerics::bracket::bisected;
use crate::operation_count;

/// Rounding allowed to an absorber that touches a wall, or rests relative to the oscillator, between impacts.
const ROUNDING: f64 = 1e-12;

/// A motion of the absorber with two impacts per cycle, the oscillator being `x = C sin(phi)`; lengths over the clearance,
/// times in radians of `phi`. The first impact is at `w = b`, the second at `w = -b`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CavityMotion {
    /// `nu`, a quarter of the difference of the two times.
    pub deviation: f64,
    /// Phases from the first impact to the second, and back.
    pub times: [f64; 2],
    /// Amplitude of the oscillator, `C/b`.
    #[serde(rename = "C")]
    pub oscillator_amplitude: f64,
    /// Half of the distance that the absorber goes between impacts, `B/b`.
    #[serde(rename = "B")]
    pub absorber_amplitude: f64,
    /// The oscillator's phase at the first impact, in `(-2 pi, pi)`.
    pub impact_phase: f64,
    /// Velocities of the absorber after the two impacts.
    pub velocities: [f64; 2],
    /// `S`, the force that takes energy: less the coefficient of `cos(phi)` in `y`.
    #[serde(rename = "S")]
    pub resistance: f64,
    /// `K`, the force in phase with the displacement: less the coefficient of `sin(phi)` in `y`.
    #[serde(rename = "K")]
    pub reactance: f64,
    /// Derivatives of `S` and `K` by `C` along the manifold; not finite at a fold.
    pub slopes: [f64; 2],
    /// Trace of the impact pair's map over a cycle at a prescribed oscillator.
    pub trace: f64,
    /// Its determinant, `r_1^2 r_2^2`.
    pub determinant: f64,
    /// Both multipliers of that map are inside the unit circle.
    pub stable: bool,
    /// The absorber stays between the walls between impacts, hits both from inside, and, where it rubs, never turns
    /// against the oscillator in flight.
    pub admissible: bool,
}

impl CavityTheory {
    /// The motion whose flight from `w = b` to `w = -b` takes the phase `pi + 2 deviation`, by its closed form. In a
    /// symmetric cavity it is the asymmetric one, which ends at symmetry breaking, where `deviation` is 0. `None` beyond
    /// `pi/2` either way, where the equation has no solution, and where the absorber would not go from wall to wall.
    pub fn motion(&self, deviation: f64) -> Option<CavityMotion> {
        let inside = deviation.abs() < FRAC_PI_2;
        let shape = match self.equation(deviation) {
            [0.0, 0.0] => self.shape(deviation, self.symmetry_breaking()?.absorber_amplitude - 1.0),
            _ => self.asymmetric(deviation),
        };
        (inside && shape.is_motion()).then(|| self.complete(&shape))
    }

    /// What a motion is made of whose flights differ.
    pub(super) fn asymmetric(&self, nu: f64) -> MotionShape {
        self.shape(nu, IN_PHASE.at(self.equation(nu)))
    }

    /// The motion of a symmetric cavity with impacts half a cycle apart and the absorber amplitude `B/b`; `None` where the
    /// cavity is another, or the amplitude is not above 0.
    pub fn symmetric_motion(&self, absorber: f64) -> Option<CavityMotion> {
        let shape = self.shape(0.0, absorber - 1.0);
        (self.is_symmetric() && shape.is_motion()).then(|| self.complete(&shape))
    }

    /// `n_c` and `d_c`, the two sides of the equation of `c_c`.
    pub(super) fn equation(&self, nu: f64) -> [f64; 2] {
        let [mean, difference] = self.ratios;
        let times = [TIME_1.at([nu]), TIME_2.at([nu])];
        let (a, f) = (self.acceleration, self.friction);
        [
            SIDE.at([a, f, mean, difference, nu, times[0], times[1]]),
            FACTOR.at([difference, nu, times[0], times[1]]),
        ]
    }

    /// The motion with `nu` and `c_c`, which satisfy the equation of `c_c`.
    pub(super) fn shape(&self, nu: f64, in_phase: f64) -> MotionShape {
        let (a, f, [mean, difference]) = (self.acceleration, self.friction, self.ratios);
        let [t1, t2] = [TIME_1.at([nu]), TIME_2.at([nu])];
        let absorber = ABSORBER.at([nu, in_phase]);
        let drift = DRIFT.at([a, f, nu]);
        let quadrature = QUADRATURE.at([a, f, mean, difference, nu, t1, t2, absorber, drift]);
        let amplitude = AMPLITUDE.at([in_phase, quadrature]);
        let impulse = IMPULSE.at([nu, t1, t2, absorber]);
        let contact = CONTACT.at([f, nu, drift]);
        let given = [in_phase, quadrature, amplitude, impulse, contact];
        MotionShape {
            nu,
            times: [t1, t2],
            drift,
            absorber,
            parts: [in_phase, quadrature],
            amplitude,
            impulse,
            contact,
            forces: [RESISTANCE.at(given), REACTANCE.at(given)],
        }
    }

    /// Velocities of the absorber after the two impacts.
    pub(super) fn velocities(&self, shape: &MotionShape) -> [f64; 2] {
        let (a, f, [t1, t2]) = (self.acceleration, self.friction, shape.times);
        [VELOCITY_1.at([a, f, t1, shape.absorber]), VELOCITY_2.at([a, f, t2, shape.absorber])]
    }

    pub(super) fn complete(&self, shape: &MotionShape) -> CavityMotion {
        operation_count::note(50 + 2 * operation_count::ELEMENTARY);
        let velocities = self.velocities(shape);
        let [trace, determinant] = trace_and_determinant(self, shape, velocities);
        let [in_phase, quadrature] = shape.parts;
        CavityMotion {
            deviation: shape.nu,
            times: shape.times,
            oscillator_amplitude: shape.amplitude,
            absorber_amplitude: shape.absorber,
            impact_phase: libm::atan2(quadrature, in_phase) - 0.5 * shape.times[0],
            velocities,
            resistance: shape.forces[0],
            reactance: shape.forces[1],
            slopes: self.slopes(shape),
            trace,
            determinant,
            stable: trace.abs() < 1.0 + determinant && determinant < 1.0,
            admissible: self.is_admissible(shape, velocities),
        }
    }

    /// The direction of the manifold `d_c(nu) c_c = n_c(nu)`: `d nu = d_c`, `d c_c = n_c' - c_c d_c'`.
    pub(super) fn direction(&self, shape: &MotionShape) -> ShapeChange {
        operation_count::note(60 + operation_count::ELEMENTARY);
        let (a, f, [mean, difference]) = (self.acceleration, self.friction, self.ratios);
        let MotionShape { nu, times: [t1, t2], absorber, parts: [p, q], .. } = *shape;
        let (sine, cosine) = libm::sincos(nu);
        let product = t1 * t2;
        let side = 4.0 - mean * f * product - 8.0 * nu * mean * (0.5 * PI * a - f * nu);
        let factor = cosine * (product - 4.0) - (4.0 * nu + PI * difference) * sine;
        let [_, d_nu] = self.equation(nu);
        let dp = side - p * factor;
        let d_absorber = cosine * dp - p * sine * d_nu;
        let d_ratio = (d_absorber + 8.0 * nu * absorber * d_nu / product) / product;
        let dq = (4.0 * PI * mean * d_ratio + (difference * f - 2.0 * a + 2.0 * q * sine) * d_nu)
            / (2.0 * cosine);
        let d_impulse = 8.0 * PI * (d_ratio * cosine - absorber * sine * d_nu / product);
        let d_contact = -shape.drift * cosine * d_nu;
        let d_amplitude = (p * dp + q * dq) / shape.amplitude;
        ShapeChange {
            parts: [dp, dq],
            impulse: d_impulse,
            contact: d_contact,
            amplitude: d_amplitude,
        }
    }

    /// Derivatives of `S` and `K` by `C` along the manifold.
    fn slopes(&self, shape: &MotionShape) -> [f64; 2] {
        let (d, c) = (self.direction(shape), shape.amplitude);
        let ([p, q], [dp, dq]) = (shape.parts, d.parts);
        let (m, n) = (shape.impulse, shape.contact);
        let d_resistance = dq * m + q * d.impulse - dp * n - p * d.contact;
        let d_reactance = -(dp * m + p * d.impulse + dq * n + q * d.contact);
        let slope = |k: usize, by: f64| (by / (PI * d.amplitude) - shape.forces[k]) / c;
        [slope(0, d_resistance), slope(1, d_reactance)]
    }

    fn is_admissible(&self, shape: &MotionShape, [u1, u2]: [f64; 2]) -> bool {
        let (a, f, [t1, t2]) = (self.acceleration, self.friction, shape.times);
        let hits = u1 > u2 + (a + f) * t2 && u2 < u1 + (a - f) * t1;
        let first = WallToWall { velocity: u1, acceleration: a - f, time: t1, from: 1.0 };
        let second = WallToWall { velocity: u2, acceleration: a + f, time: t2, from: -1.0 };
        let stays = |flight: &WallToWall| {
            let [slowest, largest] = flight.extremes(shape);
            largest <= 1.0 + ROUNDING && (f == 0.0 || slowest >= -ROUNDING)
        };
        hits && stays(&first) && stays(&second)
    }
}

/// A flight from the wall `w = from` to the other one.
struct WallToWall {
    velocity: f64,
    acceleration: f64,
    time: f64,
    from: f64,
}

impl WallToWall {
    /// Smallest relative velocity towards the other wall, and largest `abs(w)`.
    fn extremes(&self, shape: &MotionShape) -> [f64; 2] {
        let start = shape.at_impacts()[usize::from(self.from < 0.0)];
        let relative = |t: f64| {
            operation_count::note(20 + 2 * operation_count::ELEMENTARY);
            let (sine, cosine) = libm::sincos(t);
            let [x, v] = [start[0] * cosine + start[1] * sine, start[1] * cosine - start[0] * sine];
            let y = start[0] - self.from + (self.velocity + 0.5 * self.acceleration * t) * t;
            [x - y, -self.from * (v - self.velocity - self.acceleration * t)]
        };
        // Where the relative velocity is extreme, `C sin(phi) = -y''`; between them it is monotone.
        let mut places = vec![0.0, self.time];
        let level = -self.acceleration / shape.amplitude;
        if level.abs() < 1.0 {
            let phase = libm::atan2(start[0], start[1]);
            let angle = libm::asin(level);
            let turns = [angle, PI - angle].map(|at| (at - phase).rem_euclid(TAU));
            places.extend(turns.into_iter().filter(|at| *at < self.time));
        }
        places.sort_by(f64::total_cmp);
        let velocities = places.iter().map(|at| relative(*at)[1]);
        let slowest = velocities.fold(f64::INFINITY, f64::min);
        let turns =
            places.windows(2).filter_map(|ends| bisected([ends[0], ends[1]], |at| relative(at)[1]));
        [slowest, turns.map(|at| relative(at)[0].abs()).fold(1.0, f64::max)]
    }
}
