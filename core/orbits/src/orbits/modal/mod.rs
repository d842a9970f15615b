//! Exact antiperiodic orbits of several modes with several absorbers: two impacts of each absorber per excitation period, half a
//! period apart, at opposite walls.
//!
//! With the antiperiodic response `g_k` of mode `k` to a unit impulse, `(g_k, g_k')(s) = Phi_k(s) (I + Phi_k(T/2))^-1 (0, 1)^T`
//! for `0 <= s < T/2` and a change of sign from one half period to the next, absorbers that leave the wall `+b_j` at the times
//! `t_j` with the velocities `u_j` make the structure move by
//!
//! `X_i(t) = steady_i(t) - 2 sum_j sum_k (m_j phi_ki phi_kj/M_k) u_j g_k(t - t_j)`.
//!
//! The absorber's straight line between opposite walls, and the law of impact, leave two conditions for each of them,
//!
//! `X_i(t_i) = b_i - u_i T/4`, `X_i'(t_i+) = u_i (1 - r_i - 2 e_i r_i)/(1 + r_i)`,
//!
//! which one absorber meets in closed form, for any number of modes: the excitation's sine and cosine at the impact are linear
//! in `u`, and their squares add up to 1. More absorbers need Newton's iteration, from every start on a grid of amplitudes and
//! phases of the mode nearest to the excitation; starts are no part of the solution.

mod branch;
mod cycle;
mod stretches;
mod walk;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use self::walk::Walk;
use super::multipliers::eigenvalues;
use crate::numerics::polynomial::quadratic_roots;
use crate::system::{ModalState, ModalSystem};

pub use branch::{ModalBranch, ModalBranchPoint, ModalSpecialPoint};
pub use cycle::{ModalCycle, ModalPeriodicOrbit};
pub use stretches::{ReachEnd, stable_reach, stable_stretches, values_looked_at};
pub use walk::CycleImpact;

/// Amplitudes and phases of the starts of Newton's iteration.
const AMPLITUDES: u32 = 24;
const PHASES: u32 = 16;
const NEWTON_STEPS: usize = 40;
/// What is left of the equations, over the lengths and speeds in them.
const CONVERGED: f64 = 1e-12;
/// Part of a period within which two orbits are one.
const SAME: f64 = 1e-8;
/// An antiperiodic orbit: what happens in half a period happens on the other side in the next.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ModalOrbit {
    /// Time of each absorber's impact in the first half period, from phase 0 of the excitation.
    pub impact_times: Vec<f64>,
    /// Its wall there, +1 or -1.
    pub sides: Vec<f64>,
    /// `u_j`, the absorber's speed between impacts.
    pub impact_speeds: Vec<f64>,
    /// Amplitude of the first harmonic of each `q_k`.
    pub harmonics: Vec<f64>,
    /// Amplitude of the first harmonic of the structure at each absorber.
    pub harmonics_at_absorbers: Vec<f64>,
    /// Multipliers of half a period followed by the change of sign, `[re, im]`, the largest first: +1 at a saddle-node, -1 where
    /// the symmetry breaks.
    pub multipliers: Vec<[f64; 2]>,
    /// Whether speeds are positive, walls are met from inside, and no absorber meets a wall in between.
    pub admissible: bool,
    /// What is left of the equations, over the lengths and speeds in them.
    pub residual: f64,
}

impl ModalOrbit {
    /// Largest modulus of a multiplier of half a period; its square is that of a whole one.
    pub fn spectral_radius(&self) -> f64 {
        self.multipliers.first().map_or(f64::NAN, |[re, im]| libm::hypot(*re, *im))
    }

    /// Whether it attracts.
    pub fn stable(&self) -> bool {
        self.admissible && self.spectral_radius() < 1.0
    }
}

/// All antiperiodic orbits with two impacts of each absorber per period that are found: of one absorber all that there are, at
/// most two; of more those that the starts lead to. Also those that are not admissible.
pub fn antiperiodic_orbits(system: &ModalSystem) -> Vec<ModalOrbit> {
    let train = Train::of(system);
    let mut found: Vec<DVector<f64>> = Vec::new();
    if system.absorbers().len() == 1 {
        found.extend(train.single());
    } else {
        for start in train.starts() {
            let Some(mut orbit) = train.newton(start) else { continue };
            let period = system.period();
            let count = system.absorbers().len();
            orbit.rows_mut(0, count).apply(|t| *t = t.rem_euclid(period));
            let same = |other: &DVector<f64>| {
                (0..count).all(|j| {
                    let off = (orbit[j] - other[j]).abs();
                    off.min(period - off) < SAME * period
                })
            };
            if !found.iter().any(same) {
                found.push(orbit);
            }
        }
    }
    let mut orbits: Vec<ModalOrbit> = found.iter().filter_map(|one| train.described(one)).collect();
    orbits.sort_by(|a, b| a.harmonics_at_absorbers[0].total_cmp(&b.harmonics_at_absorbers[0]));
    orbits
}

/// A mode's propagator `Phi` after a time.
fn propagator([w, zeta]: [f64; 2], s: f64) -> [[f64; 2]; 2] {
    let decay = zeta * w;
    let ringing = w * ((1.0 - zeta) * (1.0 + zeta)).sqrt();
    let (sin, cos) = libm::sincos(ringing * s);
    let envelope = libm::exp(-decay * s);
    let impulse = envelope * sin / ringing;
    let step = envelope * cos;
    [[step + decay * impulse, impulse], [-(w * w * impulse), step - decay * impulse]]
}

fn applied([a, b]: [[f64; 2]; 2], [x, v]: [f64; 2]) -> [f64; 2] {
    [a[0] * x + a[1] * v, b[0] * x + b[1] * v]
}

/// A train of impulses on a structure.
struct Train<'a> {
    system: &'a ModalSystem,
    half: f64,
    /// Frequency and damping ratio of each mode.
    rates: Vec<[f64; 2]>,
    /// Displacement and velocity of each mode right after a unit impulse of an antiperiodic train.
    impulse: Vec<[f64; 2]>,
}

impl<'a> Train<'a> {
    fn of(system: &'a ModalSystem) -> Self {
        let half = 0.5 * system.period();
        let rates: Vec<[f64; 2]> =
            system.modes().iter().map(|mode| [mode.frequency, mode.damping_ratio]).collect();
        let impulse = rates.iter().map(|one| {
            let [[a, b], [c, d]] = propagator(*one, half);
            let (a, d) = (1.0 + a, 1.0 + d);
            let determinant = a * d - b * c;
            [-b / determinant, a / determinant]
        });
        Self { system, half, impulse: impulse.collect(), rates }
    }

    fn count(&self) -> usize {
        self.system.absorbers().len()
    }

    /// `g_k` of a time and its first two derivatives; at 0 those right after the impulse.
    fn response(&self, k: usize, s: f64) -> [f64; 3] {
        let halves = (s / self.half).floor();
        let sign = if halves.rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 };
        let from = s - halves * self.half;
        let [x, v] = applied(propagator(self.rates[k], from), self.impulse[k]);
        let [w, zeta] = self.rates[k];
        [x, v, -(2.0 * zeta * w * v) - w * w * x].map(|one| sign * one)
    }

    /// `2 sum_k (m_j phi_ki phi_kj/M_k) g_k` and its derivatives.
    fn at_from(&self, i: usize, j: usize, s: f64) -> [f64; 3] {
        let mass = self.system.absorbers()[j].mass;
        let modes = self.system.modes().iter().enumerate();
        modes.fold([0.0; 3], |sum, (k, mode)| {
            let factor = 2.0 * mass * mode.shape[i] * mode.shape[j] / mode.mass;
            let response = self.response(k, s);
            std::array::from_fn(|n| sum[n] + factor * response[n])
        })
    }

    /// The steady motion at an absorber and its derivatives.
    fn steady(&self, i: usize, t: f64) -> [f64; 3] {
        let (omega, steady) = (self.system.frequency_ratio(), self.system.steady_motion_at(i));
        let (sin, cos) = libm::sincos(omega * t);
        let x = steady.sine * sin + steady.cosine * cos;
        [x, omega * (steady.sine * cos - steady.cosine * sin), -(omega * omega * x)]
    }

    /// `X_i'(t_i+)/u_i`.
    fn rebound(&self, i: usize) -> f64 {
        let r = self.system.absorbers()[i].restitution;
        (1.0 - r - 2.0 * self.system.mass_ratio(i) * r) / (1.0 + r)
    }

    /// One absorber: the conditions give the steady motion at the impact, linear in `u`.
    fn single(&self) -> Vec<DVector<f64>> {
        let (omega, steady) = (self.system.frequency_ratio(), self.system.steady_motion_at(0));
        let [g, slope, _] = self.at_from(0, 0, 0.0);
        let b = self.system.absorbers()[0].clearance;
        // X = b + p u, X'/Omega = q u; their squares add up to the amplitude's.
        let p = g - 0.5 * self.half;
        let q = (self.rebound(0) + slope) / omega;
        let size = steady.amplitude();
        let constant = (b - size) * (b + size);
        let speeds = quadratic_roots([constant, 2.0 * b * p, p * p + q * q]);
        let orbit = |u: f64| {
            let phase = libm::atan2(b + p * u, q * u) - libm::atan2(steady.cosine, steady.sine);
            let t = phase.rem_euclid(TAU) / omega;
            DVector::from_vec(vec![t, u])
        };
        speeds.into_iter().filter(|u| *u > 0.0).map(orbit).collect()
    }

    /// Starts of Newton's iteration: the mode nearest to the excitation moves by `C sin(Omega t + theta)`, and each absorber as
    /// on a wall that is not slowed by it.
    fn starts(&self) -> Vec<DVector<f64>> {
        let (omega, modes) = (self.system.frequency_ratio(), self.system.modes());
        let off = |k: &usize| libm::log(modes[*k].frequency / omega).abs();
        let nearest = (0..modes.len()).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(0);
        let seen = |j: usize| {
            self.system.absorbers()[j].clearance / modes[nearest].shape[j].abs().max(1e-6)
        };
        let clearances: Vec<f64> = (0..self.count()).map(seen).collect();
        let least = clearances.iter().copied().fold(f64::INFINITY, f64::min);
        let most = clearances.iter().copied().fold(0.0, f64::max);
        let mut starts = Vec::new();
        for n in 0..AMPLITUDES {
            let part = f64::from(n) / f64::from(AMPLITUDES - 1);
            let amplitude = 0.05 * least * libm::pow(40.0 * most / least, part);
            for m in 0..PHASES {
                let theta = TAU * f64::from(m) / f64::from(PHASES);
                let mut start = DVector::zeros(2 * self.count());
                for j in 0..self.count() {
                    let phi = modes[nearest].shape[j];
                    let b = self.system.absorbers()[j].clearance;
                    let (c, r) = (phi.abs() * amplitude, self.system.absorbers()[j].restitution);
                    let rho = 2.0 * (1.0 - r) / ((1.0 + r) * PI);
                    // c^2 = (1 + rho^2) B^2 - 2 b B + b^2, the larger root, or the fold.
                    let square = 1.0 + rho * rho;
                    let root = (square * c * c - rho * rho * b * b).max(0.0).sqrt();
                    let absorber = (b + root) / square;
                    let behind = libm::atan2(rho * absorber, b - absorber);
                    let turned = if phi < 0.0 { PI } else { 0.0 };
                    start[j] = (FRAC_PI_2 - behind + turned - theta).rem_euclid(TAU) / omega;
                    start[self.count() + j] = 2.0 * absorber / self.half;
                }
                starts.push(start);
            }
        }
        starts
    }

    /// The conditions, their sizes, and their Jacobian by times and speeds.
    fn equations(&self, at: &DVector<f64>) -> (DVector<f64>, DVector<f64>, DMatrix<f64>) {
        let count = self.count();
        let mut left = DVector::zeros(2 * count);
        let mut sizes = DVector::zeros(2 * count);
        let mut jacobian = DMatrix::zeros(2 * count, 2 * count);
        for i in 0..count {
            let (t, u) = (at[i], at[count + i]);
            let [x, v, a] = self.steady(i, t);
            let b = self.system.absorbers()[i].clearance;
            let rebound = self.rebound(i);
            left[i] = x - b + 0.5 * self.half * u;
            left[count + i] = v - rebound * u;
            sizes[i] = x.abs() + b + 0.5 * self.half * u.abs();
            sizes[count + i] = v.abs() + u.abs();
            jacobian[(i, i)] = v;
            jacobian[(count + i, i)] = a;
            for j in 0..count {
                let by = at[count + j];
                let [g, slope, bend] = self.at_from(i, j, if i == j { 0.0 } else { t - at[j] });
                left[i] -= by * g;
                left[count + i] -= by * slope;
                jacobian[(i, count + j)] -= g;
                jacobian[(count + i, count + j)] -= slope;
                if i != j {
                    jacobian[(i, i)] -= by * slope;
                    jacobian[(i, j)] += by * slope;
                    jacobian[(count + i, i)] -= by * bend;
                    jacobian[(count + i, j)] += by * bend;
                }
            }
            jacobian[(i, count + i)] += 0.5 * self.half;
            jacobian[(count + i, count + i)] -= rebound;
        }
        (left, sizes, jacobian)
    }

    fn residual(left: &DVector<f64>, sizes: &DVector<f64>) -> f64 {
        left.iter().zip(sizes).map(|(left, size)| left.abs() / size).fold(0.0, f64::max)
    }

    fn newton(&self, mut at: DVector<f64>) -> Option<DVector<f64>> {
        let count = self.count();
        let longest = 0.3 / self.system.frequency_ratio();
        for _ in 0..NEWTON_STEPS {
            let (left, sizes, jacobian) = self.equations(&at);
            let residual = Self::residual(&left, &sizes);
            let step = jacobian.lu().solve(&left)?;
            if !(residual.is_finite() && step.iter().all(|one| one.is_finite())) {
                return None;
            }
            if residual < CONVERGED {
                at -= step;
                return at.rows(count, count).iter().all(|u| *u > 0.0).then_some(at);
            }
            let largest = step.rows(0, count).amax();
            at -= step * (longest / largest).min(1.0);
        }
        None
    }

    /// Everything else about an orbit; `None` where its multipliers are not found.
    fn described(&self, at: &DVector<f64>) -> Option<ModalOrbit> {
        let count = self.count();
        let (left, sizes, _) = self.equations(at);
        let (times, speeds) = (at.rows(0, count), at.rows(count, count));
        let folded = |t: &f64| {
            let halves = (t / self.half).floor();
            let side = if halves.rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 };
            (t - halves * self.half, side)
        };
        let (impact_times, sides): (Vec<f64>, Vec<f64>) = times.iter().map(folded).unzip();
        let complex: Vec<[f64; 2]> = (0..self.rates.len()).map(|k| self.harmonic(at, k)).collect();
        let at_absorber = |j: usize| {
            let base = [self.system.base_amplitude(), 0.0];
            let modes = self.system.modes().iter().zip(&complex);
            let [re, im] = modes.fold(base, |[re, im], (mode, one)| {
                [re + mode.shape[j] * one[0], im + mode.shape[j] * one[1]]
            });
            libm::hypot(re, im)
        };
        let mut orbit = ModalOrbit {
            impact_times,
            sides,
            impact_speeds: speeds.iter().copied().collect(),
            harmonics: complex.iter().map(|[re, im]| libm::hypot(*re, *im)).collect(),
            harmonics_at_absorbers: (0..count).map(at_absorber).collect(),
            multipliers: Vec::new(),
            admissible: false,
            residual: Self::residual(&left, &sizes),
        };
        let walk = Walk::along(self.system, &orbit);
        orbit.admissible = walk.ends.is_none() && speeds.iter().all(|u| *u > 0.0);
        orbit.multipliers = eigenvalues(&-walk.derivative)?;
        Some(orbit)
    }

    /// First harmonic of a mode's coordinate: of `sin` and of `cos`.
    fn harmonic(&self, at: &DVector<f64>, k: usize) -> [f64; 2] {
        let (omega, mode) = (self.system.frequency_ratio(), &self.system.modes()[k]);
        let steady = self.system.steady_motion(k);
        let mut sum = [steady.sine, steady.cosine];
        let reactance = (mode.frequency - omega) * (mode.frequency + omega);
        let loss = 2.0 * mode.damping_ratio * mode.frequency * omega;
        let scale = reactance * reactance + loss * loss;
        for (j, absorber) in self.system.absorbers().iter().enumerate() {
            let impulse = -2.0 * absorber.mass * mode.shape[j] / mode.mass * at[self.count() + j];
            // Impulses of alternating sign have the force's harmonic 2/(T/2) at their own phase.
            let force = 2.0 * impulse / self.half;
            let (sin, cos) = libm::sincos(omega * at[j]);
            let [s, c] = [force * sin, force * cos];
            sum[0] += (s * reactance + c * loss) / scale;
            sum[1] += (c * reactance - s * loss) / scale;
        }
        sum
    }
}

/// The state of an orbit at phase 0 of the excitation, to start a simulation from.
pub fn orbit_state(system: &ModalSystem, orbit: &ModalOrbit) -> ModalState {
    let train = Train::of(system);
    let mut state = ModalState::AT_REST;
    let omega = system.frequency_ratio();
    for (k, mode) in system.modes().iter().enumerate() {
        let steady = system.steady_motion(k);
        state.modes[k] = [steady.cosine, omega * steady.sine];
        for (j, absorber) in system.absorbers().iter().enumerate() {
            let impulse =
                orbit.sides[j] * orbit.impact_speeds[j] * 2.0 * absorber.mass * mode.shape[j]
                    / mode.mass;
            let [x, v, _] = train.response(k, -orbit.impact_times[j]);
            state.modes[k][0] -= impulse * x;
            state.modes[k][1] -= impulse * v;
        }
    }
    for j in 0..system.absorbers().len() {
        // Before its first impact it comes from the other wall.
        let u = orbit.sides[j] * orbit.impact_speeds[j];
        state.absorbers[j] = [u * (orbit.impact_times[j] - 0.5 * train.half), -u];
    }
    state
}
