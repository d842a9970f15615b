//! A motion that repeats and that no solver of orbits covers, as an absorber rests on a wall in it or it has more than 64 impacts: by
//! Newton's method on the simulated map over its periods.
//!
//! From a state `x` at phase 0 the simulation leads to `P(x)`; Newton's step is `(DP - I)^-1 (x - P(x))`, with `DP` by central
//! differences, whose eigenvalues are the multipliers. An absorber that rests on a wall at phase 0 goes with the structure, one without
//! impacts stays where it is: neither has a part in the equations.

use nalgebra::{DMatrix, DVector};

use super::watch::MOST_IMPACTS;
use crate::orbits::spectral_radius;
use crate::simulation::{ModalSimulation, Stop};
use crate::system::{ModalState, ModalSystem};

/// Difference of a number of the state, over the largest of them: the square of it is left of the derivative.
const DIFFERENCE: f64 = 1e-5;
/// What is left of a period, over the largest number, at which it ends: what a few hundred impacts leave of rounding. Below the other
/// one it ends as well where it comes no closer, by less than this part.
const CLOSED: f64 = 1e-12;
pub(super) const ROUGH: f64 = 1e-9;
const STALLED: f64 = 0.5;
/// Steps of Newton's method.
const STEPS: usize = 8;
/// Distance from a wall, over the clearance, and relative speed, over the largest number, below which an absorber rests on it.
const ON_WALL: f64 = 1e-9;

/// A state at phase 0 on such a motion, and its largest multiplier of an excitation period.
pub(super) struct Polished {
    pub state: ModalState,
    pub multiplier: f64,
}

impl Polished {
    /// The motion that a state nearly is on, which repeats after so many periods; `moves` are the absorbers that have impacts. None where
    /// Newton's method does not find it.
    pub fn of(
        system: &ModalSystem,
        from: &ModalState,
        periods: u32,
        moves: &[usize],
    ) -> Option<Self> {
        let map = Map::of(system, from, periods, moves);
        let (mut state, mut last) = (*from, f64::INFINITY);
        for _ in 0..STEPS {
            let end = map.after(&state)?;
            let closure = state.distance(&end);
            let stalled = closure >= STALLED * last;
            if stalled && closure > ROUGH {
                return None;
            }
            let end = map.numbers(&end);
            let derivative = map.derivative(&state, &end)?;
            let left = map.numbers(&state) - end;
            if stalled || closure <= CLOSED {
                let radius = spectral_radius(&derivative)?;
                let multiplier = libm::pow(radius, 1.0 / f64::from(periods));
                return Some(Self { state, multiplier });
            }
            last = closure;
            let identity = DMatrix::identity(left.len(), left.len());
            let step = (derivative - identity).lu().solve(&left)?;
            state = map.with(&state, &(map.numbers(&state) + step));
        }
        None
    }
}

/// Where a state at phase 0 is after some periods.
struct Map<'a> {
    system: &'a ModalSystem,
    periods: u32,
    /// Absorbers that have a part in the equations, and those that rest on a wall, with its side.
    moves: Vec<usize>,
    held: Vec<(usize, f64)>,
}

impl<'a> Map<'a> {
    fn of(system: &'a ModalSystem, state: &ModalState, periods: u32, moves: &[usize]) -> Self {
        let most = state.size();
        let side = |j: usize| {
            let [place, velocity] = system.displaced(j, state);
            let [gap, slope] = [place - state.absorbers[j][0], velocity - state.absorbers[j][1]];
            let off = gap.abs() / system.absorbers()[j].clearance - 1.0;
            (off.abs() <= ON_WALL && slope.abs() <= ON_WALL * most).then_some((j, gap.signum()))
        };
        let held: Vec<(usize, f64)> = moves.iter().filter_map(|j| side(*j)).collect();
        let is_held = |j: &usize| held.iter().any(|one| one.0 == *j);
        let moves = moves.iter().copied().filter(|j| !is_held(j)).collect();
        Self { system, periods, moves, held }
    }

    fn numbers(&self, state: &ModalState) -> DVector<f64> {
        let modes = &state.modes[..self.system.modes().len()];
        let absorbers = self.moves.iter().map(|j| &state.absorbers[*j]);
        DVector::from_vec(modes.iter().chain(absorbers).flatten().copied().collect())
    }

    /// A state with these numbers.
    fn with(&self, state: &ModalState, numbers: &DVector<f64>) -> ModalState {
        let mut state = *state;
        let (modes, absorbers) = numbers.as_slice().split_at(2 * self.system.modes().len());
        for (mode, own) in state.modes.iter_mut().zip(modes.chunks_exact(2)) {
            *mode = [own[0], own[1]];
        }
        for (j, own) in self.moves.iter().zip(absorbers.chunks_exact(2)) {
            state.absorbers[*j] = [own[0], own[1]];
        }
        for (j, side) in &self.held {
            let [place, velocity] = self.system.displaced(*j, &state);
            let clearance = self.system.absorbers()[*j].clearance;
            state.absorbers[*j] = [place - side * clearance, velocity];
        }
        state
    }

    fn after(&self, state: &ModalState) -> Option<ModalState> {
        let mut simulation = ModalSimulation::new(self.system, state, 0.0).ok()?;
        let periods = u64::from(self.periods);
        let stop = simulation.run(periods, periods * MOST_IMPACTS, &mut ());
        (stop == Stop::EndTime).then(|| simulation.state())
    }

    /// From a state, and where it leads: to one side alone where a wall is too near to the other.
    fn derivative(&self, state: &ModalState, end: &DVector<f64>) -> Option<DMatrix<f64>> {
        let own = self.numbers(state);
        let step = DIFFERENCE * state.size();
        let column = |k: usize| {
            let [up, down] = [step, -step].map(|by| {
                let mut beside = own.clone();
                beside[k] += by;
                Some(self.numbers(&self.after(&self.with(state, &beside))?))
            });
            match (up, down) {
                (Some(up), Some(down)) => Some((up - down) / (2.0 * step)),
                (Some(up), None) => Some((up - end) / step),
                (None, Some(down)) => Some((end - down) / step),
                (None, None) => None,
            }
        };
        let columns: Option<Vec<DVector<f64>>> = (0..own.len()).map(column).collect();
        Some(DMatrix::from_columns(&columns?))
    }
}
