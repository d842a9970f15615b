//! Any periodic motion of several modes with several absorbers, by Newton's method on its state at phase 0 of the excitation.
//!
//! The sequence of impacts is kept. From a state `x` each impact takes place where its absorber meets its wall, near the time of
//! the step before, so that nothing is searched for; after `p` periods the state is `P(x)`, and its derivative `DP` is the product
//! of the propagators of free motion and of the saltation of each impact (Leine and Nijmeijer, Dynamics and Bifurcations of
//! Non-Smooth Mechanical Systems, 2004, chapter 7). Newton's step is `(DP - I)^-1 (x - P(x))`; the eigenvalues of `DP` are the
//! multipliers of `p` periods. An absorber without impacts rests anywhere within reach of no wall: it keeps its place and has no
//! part in the equations.

use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use super::super::OrbitError;
use super::super::cycle::Convergence;
use super::super::multipliers::eigenvalues;
use super::walk::{CycleImpact, Walk};
use crate::system::{ModalState, ModalSystem};

/// Most impacts of a cycle.
const MOST_IMPACTS: usize = 64;
/// Steps before the iteration is given up.
const LARGEST_STEPS: u32 = 12;
/// Step over the size of the state below which it has converged, and above which one that no longer shrinks has failed.
const CONVERGED: f64 = 1e-13;
const ACCEPTED: f64 = 1e-9;
/// Step over the one before it above which it has stalled.
const STALLED: f64 = 0.5;

/// A motion that closes after some excitation periods, or nearly so.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModalCycle {
    /// The state at phase 0 of the excitation.
    pub state: ModalState,
    /// Excitation periods after which it is there again.
    pub periods: u32,
    /// Its impacts in their order, from that state on.
    pub impacts: Vec<CycleImpact>,
}

/// A periodic motion with its evidence.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ModalPeriodicOrbit {
    /// The motion.
    pub cycle: ModalCycle,
    /// How well it closes, over the largest number of its state, and in how many steps that was reached.
    pub convergence: Convergence,
    /// Multipliers of all its periods, `[re, im]`, the largest first, of the modes and the absorbers that impact; without
    /// dimension.
    pub multipliers: Vec<[f64; 2]>,
    /// Whether every impact is met from inside, in its order, and no absorber meets a wall in between.
    pub admissible: bool,
}

impl ModalPeriodicOrbit {
    /// Largest modulus of the multipliers of an excitation period.
    pub fn radius_per_period(&self) -> f64 {
        let radius = self.multipliers.first().map_or(f64::NAN, |[re, im]| libm::hypot(*re, *im));
        libm::pow(radius, 1.0 / f64::from(self.cycle.periods))
    }

    /// Whether it is a motion that nearby motions approach.
    pub fn attracts(&self) -> bool {
        self.admissible && self.radius_per_period() < 1.0
    }
}

impl ModalCycle {
    /// Solves for the periodic motion near this one that has its sequence of impacts, up to 64.
    ///
    /// # Errors
    /// [`OrbitError`] where it is no cycle, an absorber no longer meets its wall, or Newton's method does not converge.
    pub fn solve(&self, system: &ModalSystem) -> Result<ModalPeriodicOrbit, OrbitError> {
        self.check(system)?;
        let length = f64::from(self.periods) * system.period();
        let mut cycle = self.clone();
        let unknowns = Unknowns::of(system, &self.impacts);
        unknowns.rest(&mut cycle.state);
        let mut last = f64::INFINITY;
        for iterations in 1..=LARGEST_STEPS {
            let walk = Walk::meeting(system, &cycle.state, &mut cycle.impacts, length)
                .ok_or(OrbitError::Singular)?;
            let derivative = unknowns.within(&walk.derivative);
            let [from, to] = [&cycle.state, &walk.end].map(|state| unknowns.numbers(state));
            let size = from.amax();
            let left = &from - &to;
            let residual = left.amax() / size;
            let identity = DMatrix::identity(left.len(), left.len());
            let step = (&derivative - identity).lu().solve(&left);
            let step = step.filter(|step| step.iter().all(|one| one.is_finite()));
            let step = step.ok_or(OrbitError::Singular)?;
            let moved = step.amax() / size;
            let stalled = moved > STALLED * last;
            if stalled && moved > ACCEPTED {
                return Err(OrbitError::NotConverged { iterations, residual });
            }
            // What no longer shrinks is rounding.
            if stalled || moved <= CONVERGED {
                let convergence = Convergence { residual, iterations };
                return cycle.orbit(system, &derivative, convergence);
            }
            unknowns.add(&mut cycle.state, &step);
            last = moved;
        }
        Err(OrbitError::NotConverged { iterations: LARGEST_STEPS, residual: last })
    }

    fn orbit(
        self,
        system: &ModalSystem,
        derivative: &DMatrix<f64>,
        convergence: Convergence,
    ) -> Result<ModalPeriodicOrbit, OrbitError> {
        let multipliers = eigenvalues(derivative).ok_or(OrbitError::Singular)?;
        let length = f64::from(self.periods) * system.period();
        let times = || self.impacts.iter().map(|one| one.time);
        let follow = times().zip(times().skip(1)).all(|(one, next)| one <= next);
        let within = times().all(|time| (0.0..=length).contains(&time));
        let clear = || Walk::of(system, &self.state, &self.impacts, length).ends.is_none();
        let admissible = follow && within && clear();
        Ok(ModalPeriodicOrbit { cycle: self, convergence, multipliers, admissible })
    }

    fn check(&self, system: &ModalSystem) -> Result<(), OrbitError> {
        let refuse = |reason| Err(OrbitError::NotACycle { reason });
        if self.impacts.is_empty() || self.periods == 0 {
            return refuse("it has no impact or no period");
        }
        if self.impacts.len() > MOST_IMPACTS {
            return refuse("it has more than 64 impacts");
        }
        let is_one = |one: &CycleImpact| {
            one.absorber < system.absorbers().len() && one.side.abs() == 1.0 && one.time.is_finite()
        };
        if !self.impacts.iter().all(is_one) {
            return refuse("an impact is of no absorber, at no wall, or at no time");
        }
        Ok(())
    }
}

/// Which numbers of a state are solved for: displacements and velocities of the modes, then of the absorbers that impact.
struct Unknowns {
    modes: usize,
    /// Ascending.
    absorbers: Vec<usize>,
}

impl Unknowns {
    fn of(system: &ModalSystem, impacts: &[CycleImpact]) -> Self {
        let impacts_of = |j: &usize| impacts.iter().any(|one| one.absorber == *j);
        let absorbers = (0..system.absorbers().len()).filter(impacts_of).collect();
        Self { modes: system.modes().len(), absorbers }
    }

    /// The others rest.
    fn rest(&self, state: &mut ModalState) {
        let others = state.absorbers.iter_mut().enumerate();
        others.filter(|(j, _)| !self.absorbers.contains(j)).for_each(|(_, other)| other[1] = 0.0);
    }

    fn numbers(&self, state: &ModalState) -> DVector<f64> {
        let absorbers = self.absorbers.iter().map(|j| &state.absorbers[*j]);
        let all = state.modes[..self.modes].iter().chain(absorbers).flatten().copied();
        DVector::from_vec(all.collect())
    }

    fn add(&self, state: &mut ModalState, step: &DVector<f64>) {
        for (n, pair) in step.as_slice().chunks_exact(2).enumerate() {
            let body = match n.checked_sub(self.modes) {
                None => &mut state.modes[n],
                Some(k) => &mut state.absorbers[self.absorbers[k]],
            };
            (body[0], body[1]) = (body[0] + pair[0], body[1] + pair[1]);
        }
    }

    /// Their part of a derivative of a state by a state.
    fn within(&self, derivative: &DMatrix<f64>) -> DMatrix<f64> {
        let bodies = (0..self.modes).chain(self.absorbers.iter().map(|j| self.modes + j));
        let entries: Vec<usize> = bodies.flat_map(|n| [2 * n, 2 * n + 1]).collect();
        derivative.select_rows(&entries).select_columns(&entries)
    }
}
