//! Branches of periodic orbits: which orbits a parameter leads through, every bifurcation on the way,
//! and why each branch ends.
//!
//! The points come from `tracer`, the bifurcations between them from `locate` and `mirror`.

use nalgebra::Vector5;
use serde::Serialize;

use super::OrbitError;
use super::locate::located;
use super::newton::PARAMETER;
use super::orbit::{Orbit, Origin};
use super::special_point::SpecialPoint;
use super::tracer::{TracedPoint, Tracer};
use crate::system::{Parameter, System};

/// How a branch is followed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Settings {
    /// Values of the parameter between which the branch is followed.
    pub range: [f64; 2],
    /// Most points.
    pub most_points: usize,
    /// First step along the branch, in the norm of the first state (over the clearance, radians)
    /// and the parameter over its first value.
    pub first_step: f64,
    /// Largest step: distance between points of a figure that still looks smooth.
    pub largest_step: f64,
}

impl Settings {
    /// The defaults, for a range of the parameter.
    pub fn within(range: [f64; 2]) -> Self {
        Self { range, most_points: MOST_POINTS, first_step: FIRST_STEP, largest_step: LARGEST_STEP }
    }
}

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

/// Why a branch ends, and where.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "why")]
#[non_exhaustive]
pub enum BranchEnd {
    /// The end of the range was reached.
    Range {
        /// Last value of the parameter.
        value: f64,
    },
    /// The orbit stops being a motion: an impact appears or disappears, or the absorber stays on a
    /// wall.
    Grazing {
        /// Value of the parameter.
        value: f64,
    },
    /// The branch came back to where it began.
    Closed {
        /// Value of the parameter there.
        value: f64,
    },
    /// So many points were asked for, or each of them takes so much work.
    PointLimit {
        /// Last value of the parameter.
        value: f64,
    },
    /// Newton's method fails at the smallest step.
    NotConverged {
        /// Value of the parameter from which no further point was found.
        value: f64,
        /// What Newton's method said.
        reason: String,
    },
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

/// Points after which a branch that neither ends nor closes is given up: with the largest step an
/// arclength of a hundred clearances.
const MOST_POINTS: usize = 2000;
/// Radians of all points' flights, in the phase of the faster of structure and excitation, after which a
/// branch is given up, as a point costs in their proportion: more than [`MOST_POINTS`] points of one
/// excitation period near resonance, and a second or two where a period has a thousand oscillations.
const MOST_RADIANS: f64 = 1e5;
/// A fifth of the largest step: a branch may begin next to a bifurcation.
const FIRST_STEP: f64 = 0.01;
/// A twentieth of a clearance or radian: what a figure still shows as smooth, and short enough for
/// two bifurcations of one kind seldom to share a step.
const LARGEST_STEP: f64 = 0.05;
/// Corrector steps with which the branch is as good as straight: the next step may be longer.
const EASY: u32 = 3;
/// Growth of the step after an easy point, and its shrinking after another: slow enough for one
/// curved stretch not to be overrun, fast enough for a straight one to cost little.
const LONGER: f64 = 1.5;
/// See [`LONGER`].
const SHORTER: f64 = 0.8;
/// Points before a branch can have come back to where it began: fewer enclose nothing.
const FEWEST_AROUND: usize = 3;
/// Distance from the first point, over the stretch that may pass it, beyond which it is another part
/// of the branch: either end of a stretch that passes a point is within one stretch of it, and a
/// curved one a little farther.
const BESIDE: f64 = 2.0;

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

/// What lies along a branch, without its points.
pub(super) struct BranchTrace {
    /// The bifurcations, in order.
    pub specials: Vec<SpecialPoint>,
    /// Why it ends.
    pub end: BranchEnd,
}

/// Follows a branch from a point on it, along its tangent; `visit` gets each point after the first, with
/// the number of bifurcations before it.
pub(super) fn trace(
    tracer: &Tracer,
    first: TracedPoint,
    settings: &Settings,
    mut visit: impl FnMut(&TracedPoint, usize) -> Result<(), OrbitError>,
) -> BranchTrace {
    let begin = tracer.value(&first);
    let mut specials = Vec::new();
    let mut here = first.clone();
    let mut step = settings.first_step;
    let (mut radians, mut count) = (0.0, 1);
    while count < settings.most_points && radians < MOST_RADIANS {
        radians += tracer.radians(&here);
        let (there, taken, last) = match tracer.at_edge(&here, step, settings.range) {
            Some((there, edge)) => (there, step, Some(BranchEnd::Range { value: edge })),
            None => match tracer.next(&here, step) {
                Ok((there, taken)) => (there, taken, None),
                Err(reason) => {
                    return BranchTrace { specials, end: failed(tracer, &here, &reason) };
                }
            },
        };
        let met = returns(&first, &here, &there, count);
        let last = last.or(met.then_some(BranchEnd::Closed { value: begin }));
        if let Some(end) = pass(tracer, &here, &there, taken, settings, &mut specials) {
            return BranchTrace { specials, end };
        }
        if let Err(reason) = visit(&there, specials.len()) {
            return BranchTrace { specials, end: failed(tracer, &here, &reason) };
        }
        if let Some(end) = last {
            return BranchTrace { specials, end };
        }
        count += 1;
        let factor = if there.iterations() <= EASY { LONGER } else { SHORTER };
        step = (taken * factor).min(settings.largest_step);
        here = there;
    }
    BranchTrace { specials, end: BranchEnd::PointLimit { value: tracer.value(&here) } }
}

fn failed(tracer: &Tracer, last: &TracedPoint, reason: &OrbitError) -> BranchEnd {
    BranchEnd::NotConverged { value: tracer.value(last), reason: reason.to_string() }
}

/// Whether the stretch from `here` to `there` passes the branch's first point, along its tangent.
fn returns(first: &TracedPoint, here: &TracedPoint, there: &TracedPoint, passed: usize) -> bool {
    let along = |point: &TracedPoint| point.place() - first.place();
    // Phases count whole turns; a closed branch may come back a turn later.
    let stretch = (there.place() - here.place()).norm();
    let near = along(here).norm() <= BESIDE * stretch && along(there).norm() <= BESIDE * stretch;
    let side = |point: &TracedPoint| first.tangent.dot(&along(point));
    passed > FEWEST_AROUND && near && side(here) < 0.0 && side(there) >= 0.0
}

/// Takes the bifurcations before a new point into the branch; says whether it ends at one of them.
fn pass(
    tracer: &Tracer,
    here: &TracedPoint,
    there: &TracedPoint,
    step: f64,
    settings: &Settings,
    specials: &mut Vec<SpecialPoint>,
) -> Option<BranchEnd> {
    let mut found = located(tracer, here, there, step);
    let [low, high] = settings.range;
    found.retain(|special| (low..=high).contains(&special.value));
    let end = found.iter().position(|special| special.kind.ends_motion());
    found.truncate(end.map_or(found.len(), |index| index + 1));
    let stops = end.map(|index| BranchEnd::Grazing { value: found[index].value });
    specials.extend(found);
    stops
}
