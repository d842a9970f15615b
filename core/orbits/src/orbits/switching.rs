//! From one branch to another: off a symmetry breaking, off a period doubling, across a grazing.

use nalgebra::linalg::SVD;
use nalgebra::{Matrix4, Vector4, Vector5};

use super::OrbitError;
use super::branch::{Branch, Settings, collected};
use super::cycle::{Closure, Cycle};
use super::grazing::across;
use super::impact_map::AfterImpact;
use super::multipliers::LARGEST_SWEEPS;
use super::newton::{Linearised, PARAMETER};
use super::orbit::Origin;
use super::special_point::SpecialPoint;
use super::tracer::{TracedPoint, Tracer};
use crate::bifurcation::Bifurcation;
use crate::system::{Parameter, System};

/// How far a new branch is entered, in the norm of the first state: far enough to tell it from the
/// old one, near enough for its linearisation.
const ENTRY: f64 = 1e-3;

/// The branch that leaves another at a symmetry breaking or a period doubling, on the side where it
/// exists; both orbits of a broken symmetry are mirror images, of which one is followed.
///
/// # Errors
/// [`OrbitError`] where the special point is of another kind, or Newton's method does not find the
/// branch.
pub fn branch_off(
    base: &System,
    parameter: Parameter,
    special: &SpecialPoint,
    settings: &Settings,
) -> Result<Branch, OrbitError> {
    let fits = match special.orbit.cycle.closure {
        Closure::Mirrors { .. } => special.kind == Bifurcation::SymmetryBreaking,
        Closure::Repeats { .. } => special.kind == Bifurcation::PeriodDoubling,
    };
    if !fits {
        return Err(OrbitError::NotACycle { reason: "no branch leaves there" });
    }
    let tracer = Tracer::new(base, parameter);
    let first = leave(&tracer, special.value, &special.orbit.cycle)?;
    collected(&tracer, first, Origin::Switching, settings)
}

/// The first point of the branch that leaves the orbit `cycle` at `value` of the parameter, where its map
/// has the multiplier -1.
///
/// # Errors
/// [`OrbitError`] where Newton's method does not find the branch.
pub(super) fn leave(tracer: &Tracer, value: f64, cycle: &Cycle) -> Result<TracedPoint, OrbitError> {
    let doubled = match cycle.closure {
        Closure::Mirrors { .. } => cycle.unfolded(),
        Closure::Repeats { .. } => twice(cycle),
    };
    let scaled = value / tracer.scale;
    let map = tracer.map_at(scaled).ok_or(OrbitError::Singular)?;
    let direction =
        kernel(&(cycle.jacobian(&map) + Matrix4::identity())).ok_or(OrbitError::Singular)?;
    let along = direction.push(0.0);
    let start = Linearised::of(&map, &doubled, [0.0; 5]).moved(&doubled, &(along * ENTRY));
    tracer.correct(start, scaled, &along, &along)
}

/// The cycle traversed twice.
fn twice(cycle: &Cycle) -> Cycle {
    let turn = cycle.closure.turn();
    let later =
        cycle.impacts.iter().map(|impact| AfterImpact { phase: impact.phase + turn, ..*impact });
    Cycle {
        closure: Closure::Repeats { periods: 2 * cycle.periods() },
        impacts: cycle.impacts.iter().copied().chain(later).collect(),
        durations: cycle.durations.repeat(2),
    }
}

/// The unit vector that `matrix` shrinks most.
fn kernel(matrix: &Matrix4<f64>) -> Option<Vector4<f64>> {
    let svd = SVD::try_new(*matrix, false, true, f64::EPSILON, LARGEST_SWEEPS)?;
    let rows = svd.v_t?;
    let smallest = svd.singular_values.imin();
    let vector: Vector4<f64> = rows.row(smallest).transpose();
    // One of the two signs, always the same.
    let sign = vector[vector.iamax()].signum();
    Some(vector * sign)
}

/// The branch that goes on, with one more impact, where another one grazes.
///
/// # Errors
/// [`OrbitError`] where the special point is no grazing, or Newton's method finds no orbit near it.
pub fn continue_beyond(
    base: &System,
    parameter: Parameter,
    special: &SpecialPoint,
    settings: &Settings,
) -> Result<Branch, OrbitError> {
    if special.kind != Bifurcation::Grazing {
        return Err(OrbitError::NotACycle { reason: "no branch goes on there" });
    }
    let tracer = Tracer::new(base, parameter);
    let scaled = special.value / tracer.scale;
    let found = across(&tracer, scaled, &special.orbit).ok_or(OrbitError::Singular)?;
    let (orbit, there) = found;
    let along = Vector5::from(PARAMETER) * (there - scaled).signum();
    let first = tracer.correct(orbit.cycle, there, &along, &along)?;
    collected(&tracer, first, Origin::Switching, settings)
}
