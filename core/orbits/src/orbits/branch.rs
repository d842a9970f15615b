//! Branches of periodic orbits: which orbits a parameter leads through, every bifurcation on the way,
//! and why each branch ends.
//!
//! The points come from `tracer`, the bifurcations between them from `locate` and `mirror`.

use nalgebra::Vector5;
use serde::Serialize;

use super::OrbitError;
use super::continuation::{BranchTrace, Family, Traced as _, trace};
use super::locate::located;
use super::newton::PARAMETER;
use super::orbit::{Orbit, Origin};
use super::special_point::SpecialPoint;
use super::tracer::{TracedPoint, Tracer};
use crate::bifurcation::Bifurcation;
use crate::system::{Parameter, System};

pub use super::continuation::{BranchEnd, Settings};

/// Which way along the parameter a branch sets out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum BranchDirection {
    /// Towards larger values.
    Up,
    /// Towards smaller ones.
    Down,
}

/// An orbit of a branch.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct BranchPoint {
    /// Value of the parameter.
    pub value: f64,
    /// The orbit.
    pub orbit: Orbit,
    /// How many of the branch's bifurcations lie before it.
    pub passed: usize,
}

/// Orbits in order along a branch.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Branch {
    /// What varies.
    pub parameter: Parameter,
    /// The orbits.
    pub points: Vec<BranchPoint>,
    /// The bifurcations, in order.
    pub specials: Vec<SpecialPoint>,
    /// Why it ends.
    pub end: BranchEnd,
}

/// Follows the branch through `start`, an orbit of `base`, in one direction.
///
/// From 7.5 mm, the clearance of the crate page, upwards and downwards to the two bifurcations that bound the
/// symmetric orbit at 8 Hz. The theory has them at 4.687 mm and 16.259 mm:
///
/// ```
/// # use vinesink_core::system::{Cavity, Excitation, Parameters, System};
/// # let system = System::new(Parameters {
/// #     mass_ratio: 0.032 / 4.168, damping: 1.799, restitution: 0.6, frequency_ratio: 8.0 / 8.349,
/// #     forcing_per_clearance: 4.3417, excitation: Excitation::BaseDisplacement,
/// #     cavity: Cavity::IDEAL,
/// # })?;
/// use vinesink_core::bifurcation::Bifurcation;
/// use vinesink_core::orbits::attracting_orbit;
/// use vinesink_core::orbits::branch::{BranchDirection, Settings, follow};
/// use vinesink_core::system::Parameter;
///
/// let start = attracting_orbit(&system).expect("one attracts").orbit;
/// let clearance_mm = |direction, wanted| {
///     let settings = Settings::within([0.3, 3.0]); // over the clearance of the start
///     let branch = follow(&system, &start, Parameter::Clearance, direction, &settings)?;
///     let found = branch.specials.iter().find(|special| special.kind == wanted);
///     Ok::<f64, Box<dyn std::error::Error>>(7.5 * found.ok_or("no such bifurcation")?.value)
/// };
/// let breaking = clearance_mm(BranchDirection::Down, Bifurcation::SymmetryBreaking)?;
/// assert!((breaking / 4.687 - 1.0).abs() < 0.04, "{breaking} mm");
/// let collision = clearance_mm(BranchDirection::Up, Bifurcation::SaddleNode)?;
/// assert!((collision / 16.259 - 1.0).abs() < 0.04, "{collision} mm");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`OrbitError`] when `start` itself is not on a branch.
pub fn follow(
    base: &System,
    start: &Orbit,
    parameter: Parameter,
    direction: BranchDirection,
    settings: &Settings,
) -> Result<Branch, OrbitError> {
    let tracer = Tracer::new(base, parameter);
    let along = match direction {
        BranchDirection::Up => Vector5::from(PARAMETER),
        BranchDirection::Down => -Vector5::from(PARAMETER),
    };
    let scaled = parameter.of(base) / tracer.scale;
    // A tilt leaves no orbit its symmetry.
    let cycle = match parameter {
        Parameter::GravityAlong => start.cycle.unfolded(),
        _ => start.cycle.clone(),
    };
    let first = tracer.correct(cycle, scaled, &along, &along)?;
    collected(&tracer, first, start.origin, settings)
}

impl Family for Tracer<'_> {
    type Point = TracedPoint;
    type Special = SpecialPoint;
    fn scale(&self) -> f64 {
        self.scale
    }
    fn radians(&self, point: &TracedPoint) -> f64 {
        let frequency = self.base.frequency_ratio().max(1.0);
        frequency * point.cycle().durations.iter().sum::<f64>()
    }
    fn advance(&self, from: &TracedPoint, step: f64) -> Result<TracedPoint, OrbitError> {
        let ahead = from.parameter() + step * from.rise();
        self.correct(Self::predicted(from, step), ahead, &from.tangent, &from.tangent)
    }
    fn at_parameter(
        &self,
        from: &TracedPoint,
        step: f64,
        scaled: f64,
    ) -> Result<TracedPoint, OrbitError> {
        self.correct(Self::predicted(from, step), scaled, &PARAMETER.into(), &from.tangent)
    }
    fn between(&self, here: &TracedPoint, there: &TracedPoint, step: f64) -> Vec<SpecialPoint> {
        located(self, here, there, step)
    }
    fn bifurcation(special: &SpecialPoint) -> (Bifurcation, f64) {
        (special.kind, special.value)
    }
}

/// The branch from a point on it, whose orbit was found in a way of its own, along its tangent.
///
/// # Errors
/// [`OrbitError::Singular`] where the first point is no orbit.
pub(super) fn collected(
    tracer: &Tracer,
    first: TracedPoint,
    origin: Origin,
    settings: &Settings,
) -> Result<Branch, OrbitError> {
    let (parameter, value) = (tracer.parameter, tracer.value(&first));
    let mut points = vec![BranchPoint { value, orbit: first.orbit(origin)?, passed: 0 }];
    let BranchTrace { specials, end } = trace(tracer, first, settings, |point, passed| {
        let (value, orbit) = (tracer.value(point), point.orbit(Origin::Continuation)?);
        points.push(BranchPoint { value, orbit, passed });
        Ok(())
    });
    Ok(Branch { parameter, points, specials, end })
}
