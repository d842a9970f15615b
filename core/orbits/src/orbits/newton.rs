//! Newton's method on the impact map: any cycle of impacts, of any length, at once.
//!
//! Unknown are the state after every impact and the time to the next (multiple shooting), so that no
//! impact is searched for and no long unstable flight is shot through. The defects are carried round
//! the cycle by the exact Jacobians, which leaves a system of four equations (five with a parameter
//! and the arclength) whatever the number of impacts.

use nalgebra::{Matrix4, Matrix5, Vector4, Vector5};

use super::OrbitError;
use super::admissibility::{Admissibility, Distances, is_motion};
use super::cycle::{Closure, Convergence, Cycle};
use super::impact_map::{ImpactMap, Step};
use super::multipliers::Multipliers;
use super::orbit::{Orbit, Origin};
use crate::system::System;

/// Steps before the iteration is given up: from a good start five are enough, and one that needs
/// more than twice as many, or a predictor of a branch that does, was too far out.
const LARGEST_STEPS: u32 = 12;
/// Update over the orbit's size below which a step that no longer improves has converged: a hundred
/// units in the last place.
const CONVERGED: f64 = 2e-14;
/// Residual over the orbit's size above which a stalled iteration has failed: rounding grows with
/// the multipliers, and no orbit worth naming has larger ones than 1e5.
const ACCEPTED: f64 = 1e-10;
/// Update over the one before it above which the iteration has stalled: quadratic convergence
/// shrinks it far more, rounding does not shrink it at all.
const STALLED: f64 = 0.5;
/// Update over the orbit's size above which a stalled iteration has failed: [`ACCEPTED`] over the
/// distance of the nearest multiplier from +1, which is 1e-3 next to a saddle-node.
const ROUNDING: f64 = 1e-7;

/// The defects of a cycle and its linearisation, condensed to its first state.
#[derive(Debug, Clone)]
pub(super) struct Linearised {
    steps: Vec<Step>,
    defects: Vec<Vector4<f64>>,
    /// Largest defect, absolute.
    pub residual: f64,
    /// `C` times the product of the Jacobians.
    pub jacobian: Matrix4<f64>,
    /// The defects carried to the cycle's end, times `C`.
    pub carried: Vector4<f64>,
    /// The same for a parameter's influence.
    by_parameter: Vector4<f64>,
    /// As [`crate::system::Parameter::derivatives`] has them.
    weights: [f64; 5],
}

impl Linearised {
    /// Linearises `cycle`; `weights` are those of [`crate::system::Parameter::derivatives`].
    pub fn of(map: &ImpactMap, cycle: &Cycle, weights: [f64; 5]) -> Self {
        let steps = cycle.steps(map);
        let close = cycle.closure.matrix();
        let mut product = Matrix4::identity();
        let (mut carried, mut by_parameter) = (Vector4::zeros(), Vector4::zeros());
        let mut defects = Vec::with_capacity(steps.len());
        let mut residual: f64 = 0.0;
        for (k, step) in steps.iter().enumerate() {
            let defect = step.next.vector() - target(cycle, k);
            residual = residual.max(defect.amax()).max(step.gap.abs());
            let jacobian = step.jacobian();
            let per_gap = step.next_by_duration / step.approach;
            carried = jacobian * carried + defect - per_gap * step.gap;
            by_parameter = jacobian * by_parameter + parameter_influence(step, weights);
            product = jacobian * product;
            defects.push(defect);
        }
        Self {
            steps,
            defects,
            residual,
            jacobian: close * product,
            carried: close * carried,
            by_parameter: close * by_parameter,
            weights,
        }
    }

    /// The cycle moved by `change` in its first state and the parameter, everything else following.
    pub fn moved(&self, cycle: &Cycle, change: &Vector5<f64>) -> Cycle {
        let mut moved = cycle.clone();
        let parameter = change[4];
        let mut change: Vector4<f64> = change.fixed_rows::<4>(0).into();
        for (k, step) in self.steps.iter().enumerate() {
            let here = &cycle.impacts[k];
            moved.impacts[k] = here.moved_to(&(here.vector() + change));
            let gap_by_parameter = weighted(step.gap_by_parameter, self.weights);
            let gap = step.gap + step.gap_by_state.dot(&change) + gap_by_parameter * parameter;
            moved.durations[k] -= gap / step.approach;
            change = step.jacobian() * change + self.defects[k]
                - step.next_by_duration * (step.gap / step.approach)
                + parameter_influence(step, self.weights) * parameter;
        }
        moved
    }

    /// The bordered system of pseudo-arclength continuation: `(I - J) dz - q dp = right`,
    /// `normal . (dz, dp) = along`.
    pub fn solve(
        &self,
        normal: &Vector5<f64>,
        right: Vector4<f64>,
        along: f64,
    ) -> Result<Vector5<f64>, OrbitError> {
        let mut matrix = Matrix5::zeros();
        matrix.fixed_view_mut::<4, 4>(0, 0).copy_from(&(Matrix4::identity() - self.jacobian));
        matrix.fixed_view_mut::<4, 1>(0, 4).copy_from(&(-self.by_parameter));
        matrix.fixed_view_mut::<1, 5>(4, 0).copy_from(&normal.transpose());
        let solution = matrix.lu().solve(&right.push(along)).ok_or(OrbitError::Singular)?;
        let finite = solution.iter().all(|value| value.is_finite());
        if finite { Ok(solution) } else { Err(OrbitError::Singular) }
    }
}

/// Where the flight `k` must lead: to the next state, or, through the closure, to the first.
fn target(cycle: &Cycle, k: usize) -> Vector4<f64> {
    match cycle.impacts.get(k + 1) {
        Some(next) => next.vector(),
        None => {
            let turn = Vector4::new(cycle.closure.turn(), 0.0, 0.0, 0.0);
            cycle.closure.matrix() * cycle.impacts[0].vector() + turn
        }
    }
}

fn weighted(values: [f64; 5], weights: [f64; 5]) -> f64 {
    values.iter().zip(weights).map(|(value, weight)| value * weight).sum()
}

fn parameter_influence(step: &Step, weights: [f64; 5]) -> Vector4<f64> {
    let next: Vector4<f64> =
        (0..5).map(|k| step.next_by_parameter[k] * weights[k]).sum::<Vector4<f64>>();
    next - step.next_by_duration * (weighted(step.gap_by_parameter, weights) / step.approach)
}

/// Solves for the cycle near `start`; half of one that equals its mirror image is written out in a cavity where no motion
/// does.
///
/// # Errors
/// [`OrbitError`] when `start` is no cycle, or Newton's method does not converge.
pub fn solve(system: &System, start: &Cycle, origin: Origin) -> Result<Orbit, OrbitError> {
    let map = ImpactMap::of(system)?;
    let whole = (!map.cavity().is_symmetric()).then(|| start.unfolded());
    converge(&map, whole.as_ref().unwrap_or(start))?.orbit(origin)
}

/// Newton's iteration at fixed parameters.
pub(super) fn converge(map: &ImpactMap, start: &Cycle) -> Result<Converged, OrbitError> {
    corrected(|_| Some((*map, [0.0; 5])), start.clone(), 0.0, &PARAMETER.into())
}

/// The direction of the parameter, beside the four of the first state.
pub(super) const PARAMETER: [f64; 5] = [0.0, 0.0, 0.0, 0.0, 1.0];

/// A cycle that closes, with what it was last linearised to.
#[derive(Debug, Clone)]
pub(super) struct Converged {
    pub cycle: Cycle,
    pub parameter: f64,
    pub map: ImpactMap,
    pub linear: Linearised,
    pub convergence: Convergence,
}

impl Converged {
    /// The orbit with its evidence.
    ///
    /// # Errors
    /// As [`Orbit::measured`].
    pub fn orbit(self, origin: Origin) -> Result<Orbit, OrbitError> {
        let admissibility = Admissibility::of(&self.map, &self.cycle);
        let jacobian = &self.linear.jacobian;
        Orbit::measured(self.cycle, jacobian, self.convergence, admissibility, origin)
    }

    /// The same if it attracts. Most of the thousands of cycles of a slow excitation do not, and are not measured.
    pub fn attracting_orbit(self, origin: Origin) -> Option<Orbit> {
        let multipliers = Multipliers::of(&self.linear.jacobian)?;
        if !multipliers.stable() || !is_motion(&self.map, &self.cycle) {
            return None;
        }
        let admissibility = Distances::of(&self.map, &self.cycle).with(true);
        let Self { cycle, convergence, .. } = self;
        Some(Orbit { cycle, convergence, multipliers, admissibility, origin })
    }
}

/// Newton's iteration from `cycle` at `parameter` on the plane `normal . (dz, dp) = 0` through them, until
/// the change is rounding, or no longer shrinks with a residual that is. `map_at` is the map at a value of
/// the parameter, with those of [`crate::system::Parameter::derivatives`].
///
/// # Errors
/// [`OrbitError::NotACycle`] if `cycle` is none, [`OrbitError::Singular`] where the equations or the system
/// do not exist, [`OrbitError::NotConverged`] after [`LARGEST_STEPS`], where numbers are no longer finite,
/// and where a later cycle is none.
pub(super) fn corrected(
    map_at: impl Fn(f64) -> Option<(ImpactMap, [f64; 5])>,
    mut cycle: Cycle,
    mut parameter: f64,
    normal: &Vector5<f64>,
) -> Result<Converged, OrbitError> {
    let (mut residual, mut last) = (f64::INFINITY, f64::INFINITY);
    for iterations in 0..LARGEST_STEPS {
        let left = OrbitError::NotConverged { iterations, residual };
        cycle.check().map_err(|none| if iterations == 0 { none } else { left })?;
        let (map, weights) = map_at(parameter).ok_or(OrbitError::Singular)?;
        if matches!(cycle.closure, Closure::Mirrors { .. }) && !map.cavity().is_symmetric() {
            let reason = "the mirror image of a motion is none in a cavity that is inclined or whose ends differ";
            return Err(OrbitError::NotACycle { reason });
        }
        let linear = Linearised::of(&map, &cycle, weights);
        let update = linear.solve(normal, linear.carried, 0.0)?;
        residual = linear.residual / cycle.size();
        let change = update.amax() / cycle.size();
        if !(residual.is_finite() && change.is_finite()) {
            return Err(OrbitError::NotConverged { iterations, residual });
        }
        let stalled = change >= STALLED * last && residual < ACCEPTED && change < ROUNDING;
        if change < CONVERGED || stalled {
            let convergence = Convergence { residual, iterations };
            return Ok(Converged { cycle, parameter, map, linear, convergence });
        }
        last = change;
        cycle = linear.moved(&cycle, &update);
        parameter += update[4];
    }
    Err(OrbitError::NotConverged { iterations: LARGEST_STEPS, residual })
}
