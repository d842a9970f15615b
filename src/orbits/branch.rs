//! Branches of periodic orbits: pseudo-arclength continuation in one parameter (Keller 1977), with
//! every bifurcation on the way located by its own test function.

use nalgebra::{Matrix4, Vector4, Vector5};
use serde::Serialize;

use super::OrbitError;
use super::admissibility::Admissibility;
use super::impact_map::ImpactMap;
use super::multipliers::{Multipliers, minus_one, plus_one, unit_product};
use super::newton::{Convergence, Linearised, bordered, converge, size};
use super::orbit::{Closure, Cycle, Orbit, Origin};
use super::special::{Bifurcation, SpecialPoint};
use super::switching;
use crate::numerics::bracket::brent;
use crate::system::{Parameters, System};

/// What is varied along a branch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Parameter {
    /// Clearance over the clearance of the system that the branch begins with.
    Clearance,
    /// Frequency ratio `Omega`.
    Frequency,
    /// Forcing over the forcing of the system that the branch begins with.
    Forcing,
    /// Restitution `r`.
    Restitution,
}

impl Parameter {
    /// The parameter's value in the system that a branch begins with.
    pub fn of(self, base: &System) -> f64 {
        match self {
            Self::Clearance | Self::Forcing => 1.0,
            Self::Frequency => base.frequency_ratio(),
            Self::Restitution => base.restitution(),
        }
    }

    /// `base` with the parameter set to `value`; `None` where there is no such system.
    pub fn applied(self, base: &System, value: f64) -> Option<System> {
        let parameters = base.parameters();
        match self {
            Self::Clearance => base.with_clearance_scaled(value).ok(),
            Self::Frequency => base.with_frequency_ratio(value).ok(),
            Self::Forcing => base.with_clearance_scaled(1.0 / value).ok(),
            Self::Restitution => System::new(Parameters { restitution: value, ..parameters }).ok(),
        }
    }

    /// Derivatives of forcing `gamma`, frequency and restitution by the parameter's value.
    pub(super) fn weights(self, base: &System, value: f64) -> [f64; 3] {
        let gamma = base.forcing_per_clearance();
        match self {
            Self::Clearance => [-gamma / (value * value), 0.0, 0.0],
            Self::Frequency => [0.0, 1.0, 0.0],
            Self::Forcing => [gamma, 0.0, 0.0],
            Self::Restitution => [0.0, 0.0, 1.0],
        }
    }
}

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
    /// Smallest step before the branch is given up.
    pub smallest_step: f64,
    /// Go on where the orbit is no longer a motion.
    pub beyond_grazing: bool,
}

impl Settings {
    /// The defaults, for a range of the parameter.
    pub fn within(range: [f64; 2]) -> Self {
        Self {
            range,
            most_points: 2000,
            first_step: 0.01,
            largest_step: 0.05,
            smallest_step: 1e-7,
            beyond_grazing: false,
        }
    }
}

/// Which way along the parameter a branch sets out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Direction {
    /// Towards larger values.
    Up,
    /// Towards smaller ones.
    Down,
}

/// An orbit of a branch.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BranchPoint {
    /// Value of the parameter.
    pub value: f64,
    /// The orbit.
    pub orbit: Orbit,
}

/// Why a branch ends, and where.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "why")]
pub enum BranchEnd {
    /// The end of the range was reached.
    Range {
        /// Last value of the parameter.
        value: f64,
    },
    /// The orbit stops being a motion: an impact appears or disappears.
    Grazing {
        /// Value of the parameter.
        value: f64,
    },
    /// The branch came back to where it began.
    Closed {
        /// Value of the parameter there.
        value: f64,
    },
    /// So many points were asked for.
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

/// A point while the branch is followed: cycle, parameter over its scale, tangent and tests.
#[derive(Debug, Clone)]
pub(super) struct Point {
    pub cycle: Cycle,
    pub parameter: f64,
    pub tangent: Vector5<f64>,
    jacobian: Matrix4<f64>,
    admissibility: Admissibility,
    convergence: Convergence,
    steps: u32,
}

/// Corrector steps; a predictor that needs more was too far out.
const LARGEST_STEPS: u32 = 12;
/// Relative size of an update that is rounding.
const CONVERGED: f64 = 1e-13;
/// Residual over the orbit's size that a stalled corrector may leave.
const ACCEPTED: f64 = 1e-10;
/// Cosine of the angle by which a branch may turn in one step.
const LARGEST_TURN: f64 = 0.9;
/// Width over the step to which a bifurcation is located.
const LOCATED: f64 = 1e-12;
/// Value of a test function, over its values on either side, above which it jumps.
const VANISHES: f64 = 1e-3;

/// What a continuation works on.
pub(super) struct Tracer<'a> {
    base: &'a System,
    parameter: Parameter,
    scale: f64,
}

impl<'a> Tracer<'a> {
    pub fn new(base: &'a System, parameter: Parameter) -> Self {
        let scale = parameter.of(base).abs().max(0.1);
        Self { base, parameter, scale }
    }

    pub fn scale(&self) -> f64 {
        self.scale
    }

    fn map(&self, scaled: f64) -> Option<(ImpactMap, [f64; 3])> {
        let value = scaled * self.scale;
        let system = self.parameter.applied(self.base, value)?;
        let weights = self.parameter.weights(self.base, value).map(|w| w * self.scale);
        Some((ImpactMap::of(&system).ok()?, weights))
    }

    /// The impact map at a scaled parameter.
    pub fn map_at(&self, scaled: f64) -> Option<ImpactMap> {
        self.map(scaled).map(|(map, _)| map)
    }

    /// The orbit near `cycle` at a scaled parameter, if Newton's method finds it.
    pub fn at(&self, cycle: &Cycle, scaled: f64) -> Option<Orbit> {
        let map = self.map_at(scaled)?;
        let (cycle, convergence) = converge(&map, cycle).ok()?;
        Orbit::measured(&map, cycle, convergence, Origin::Switching).ok()
    }

    /// Corrects `cycle` at `scaled` onto the plane `normal . (dz, dp) = 0` through it, and finds the
    /// tangent there, pointing along `along`.
    pub fn correct(
        &self,
        mut cycle: Cycle,
        mut scaled: f64,
        normal: &Vector5<f64>,
        along: &Vector5<f64>,
    ) -> Result<Point, OrbitError> {
        let mut last = f64::INFINITY;
        for steps in 0..LARGEST_STEPS {
            let (map, weights) = self.map(scaled).ok_or(OrbitError::Singular)?;
            cycle.check()?;
            let linear = Linearised::of(&map, &cycle, weights);
            let residual = linear.residual / size(&cycle);
            let mut right = Vector5::zeros();
            right.fixed_rows_mut::<4>(0).copy_from(&linear.carried);
            let change = bordered(&linear, normal, &right).ok_or(OrbitError::Singular)?;
            let update = change.amax() / size(&cycle);
            if !(update.is_finite() && residual.is_finite()) {
                return Err(OrbitError::NotConverged { iterations: steps, residual });
            }
            let stalled = update >= 0.5 * last && residual < ACCEPTED && update < 1e-7;
            if update < CONVERGED || stalled {
                let mut unit = Vector5::zeros();
                unit[4] = 1.0;
                let tangent = bordered(&linear, along, &unit).ok_or(OrbitError::Singular)?;
                let admissibility = Admissibility::of(&map, &cycle.flights());
                return Ok(Point {
                    tangent: tangent / tangent.norm(),
                    jacobian: linear.jacobian,
                    convergence: Convergence { residual, iterations: steps },
                    cycle,
                    parameter: scaled,
                    admissibility,
                    steps,
                });
            }
            last = update;
            let first: Vector4<f64> = change.fixed_rows::<4>(0).into();
            cycle = linear.moved(&cycle, first, change[4], weights);
            scaled += change[4];
        }
        Err(OrbitError::NotConverged { iterations: LARGEST_STEPS, residual: last })
    }

    /// The point an arclength `step` along the branch from `point`.
    fn advance(&self, point: &Point, step: f64) -> Result<Point, OrbitError> {
        let (map, weights) = self.map(point.parameter).ok_or(OrbitError::Singular)?;
        let linear = Linearised::of(&map, &point.cycle, weights);
        let first: Vector4<f64> = point.tangent.fixed_rows::<4>(0).into();
        let ahead = step * point.tangent[4];
        let cycle = linear.moved(&point.cycle, first * step, ahead, weights);
        self.correct(cycle, point.parameter + ahead, &point.tangent, &point.tangent)
    }

    pub fn orbit(&self, point: &Point, origin: Origin) -> Option<Orbit> {
        Some(Orbit {
            cycle: point.cycle.clone(),
            convergence: point.convergence,
            multipliers: Multipliers::of(&point.jacobian)?,
            admissibility: point.admissibility,
            origin,
        })
    }
}

/// Follows the branch through `start`, an orbit of `base`, in one direction.
///
/// # Errors
/// [`OrbitError`] when `start` itself is not on a branch.
pub fn follow(
    base: &System,
    start: &Orbit,
    parameter: Parameter,
    direction: Direction,
    settings: &Settings,
) -> Result<Branch, OrbitError> {
    let tracer = Tracer::new(base, parameter);
    let mut upwards = Vector5::zeros();
    upwards[4] = match direction {
        Direction::Up => 1.0,
        Direction::Down => -1.0,
    };
    let scaled = parameter.of(base) / tracer.scale;
    let first = tracer.correct(start.cycle.clone(), scaled, &upwards, &upwards)?;
    Ok(trace(&tracer, first, start.origin, settings))
}

/// Follows a branch from a point on it, along its tangent.
pub(super) fn trace(tracer: &Tracer, first: Point, origin: Origin, settings: &Settings) -> Branch {
    let begin = first.parameter * tracer.scale;
    let mut branch = Branch {
        parameter: tracer.parameter,
        points: Vec::new(),
        specials: Vec::new(),
        end: BranchEnd::PointLimit { value: begin },
    };
    let orbit = tracer.orbit(&first, origin);
    branch.points.extend(orbit.map(|orbit| BranchPoint { value: begin, orbit }));
    let mut here = first.clone();
    let mut step = settings.first_step;
    while branch.points.len() < settings.most_points {
        let stepped = match at_edge(tracer, &here, step, settings) {
            Some((there, edge)) => Ok((there, step, Some(BranchEnd::Range { value: edge }))),
            None => {
                next_point(tracer, &here, step, settings).map(|(there, taken)| (there, taken, None))
            }
        };
        let (there, taken, last) = match stepped {
            Ok(found) => found,
            Err(reason) => {
                let value = here.parameter * tracer.scale;
                branch.end = BranchEnd::NotConverged { value, reason: reason.to_string() };
                return branch;
            }
        };
        let met = returns(&first, &here, &there, branch.points.len());
        let last = last.or(met.then_some(BranchEnd::Closed { value: begin }));
        if let Some(end) = record(tracer, &here, &there, taken, settings, &mut branch).or(last) {
            branch.end = end;
            return branch;
        }
        // Few corrector steps: the branch is straight here.
        let factor = if there.steps <= 3 { 1.5 } else { 0.8 };
        step = (taken * factor).min(settings.largest_step);
        here = there;
    }
    branch.end = BranchEnd::PointLimit { value: here.parameter * tracer.scale };
    branch
}

/// Whether the stretch from `here` to `there` passes the branch's first point, along its tangent.
fn returns(first: &Point, here: &Point, there: &Point, passed: usize) -> bool {
    let along = |point: &Point| place(point) - place(first);
    // Phases count whole turns; a closed branch may come back a turn later.
    let stretch = (place(there) - place(here)).norm();
    let near = along(here).norm() <= 2.0 * stretch && along(there).norm() <= 2.0 * stretch;
    let side = |point: &Point| first.tangent.dot(&along(point));
    passed > 3 && near && side(here) < 0.0 && side(there) >= 0.0
}

/// First state and parameter of a point, as the arclength measures them.
fn place(point: &Point) -> Vector5<f64> {
    let mut place = Vector5::zeros();
    place.fixed_rows_mut::<4>(0).copy_from(&point.cycle.impacts[0].vector());
    place[4] = point.parameter;
    place
}

/// The orbit at the edge of the range, if the next step would leave it: parameters need not exist
/// beyond (a restitution above 1).
fn at_edge(tracer: &Tracer, here: &Point, step: f64, settings: &Settings) -> Option<(Point, f64)> {
    let [low, high] = settings.range.map(|edge| edge / tracer.scale);
    let ahead = here.parameter + step * here.tangent[4];
    let edge = if ahead > high {
        high
    } else if ahead < low {
        low
    } else {
        return None;
    };
    let (map, weights) = tracer.map(here.parameter)?;
    let linear = Linearised::of(&map, &here.cycle, weights);
    let share = (edge - here.parameter) / here.tangent[4];
    let first: Vector4<f64> = here.tangent.fixed_rows::<4>(0).into();
    let change = edge - here.parameter;
    let cycle = linear.moved(&here.cycle, first * share, change, weights);
    let mut upright = Vector5::zeros();
    upright[4] = 1.0;
    let there = tracer.correct(cycle, edge, &upright, &here.tangent).ok()?;
    // A branch that turns back before the edge must not be left for another one.
    let close = (place(&there) - place(here)).norm() <= 2.0 * step.max(share.abs());
    (close && there.tangent.dot(&here.tangent) >= LARGEST_TURN)
        .then_some((there, edge * tracer.scale))
}

/// The next point, with the step that reached it: halved until the corrector converges and the branch
/// turns little.
fn next_point(
    tracer: &Tracer,
    here: &Point,
    step: f64,
    settings: &Settings,
) -> Result<(Point, f64), OrbitError> {
    let mut step = step;
    loop {
        let failure = match tracer.advance(here, step) {
            Ok(there) if there.tangent.dot(&here.tangent) >= LARGEST_TURN => {
                return Ok((there, step));
            }
            Ok(_) => OrbitError::Singular,
            Err(failure) => failure,
        };
        step *= 0.5;
        if step < settings.smallest_step {
            return Err(failure);
        }
    }
}

/// Takes a new point into the branch, with the bifurcations before it; says whether the branch ends.
fn record(
    tracer: &Tracer,
    here: &Point,
    there: &Point,
    step: f64,
    settings: &Settings,
    branch: &mut Branch,
) -> Option<BranchEnd> {
    let mut found = located(tracer, here, there, step);
    let [low, high] = settings.range;
    found.retain(|special| (low..=high).contains(&special.value));
    let leaves = |special: &SpecialPoint| {
        matches!(special.kind, Bifurcation::Grazing | Bifurcation::VanishingImpact)
    };
    let end = found.iter().position(leaves).filter(|_| !settings.beyond_grazing);
    if let Some(index) = end {
        found.truncate(index + 1);
    }
    let stops = end.map(|index| found[index].value);
    branch.specials.extend(found);
    if let Some(value) = stops {
        return Some(BranchEnd::Grazing { value });
    }
    let value = there.parameter * tracer.scale;
    let orbit = tracer.orbit(there, Origin::Continuation);
    branch.points.extend(orbit.map(|orbit| BranchPoint { value, orbit }));
    None
}

/// A test function: the bifurcation that it shows, and its value at a point.
struct Test {
    kind: Bifurcation,
    value: fn(&Point) -> f64,
}

fn tests(closure: Closure) -> [Test; 6] {
    let minus = match closure {
        Closure::Repeats { .. } => Bifurcation::PeriodDoubling,
        Closure::Mirrors { .. } => Bifurcation::SymmetryBreaking,
    };
    [
        Test { kind: Bifurcation::SaddleNode, value: |point| point.tangent[4] },
        Test { kind: Bifurcation::BranchPoint, value: |point| plus_one(&point.jacobian) },
        Test { kind: minus, value: |point| minus_one(&point.jacobian) },
        Test { kind: Bifurcation::NeimarkSacker, value: |point| unit_product(&point.jacobian) },
        Test { kind: Bifurcation::Grazing, value: |point| point.admissibility.room },
        Test {
            kind: Bifurcation::VanishingImpact,
            value: |point| point.admissibility.slowest_impact,
        },
    ]
}

/// Every bifurcation between two neighbouring points, in order along the branch.
fn located(tracer: &Tracer, here: &Point, there: &Point, step: f64) -> Vec<SpecialPoint> {
    let mut found: Vec<(f64, SpecialPoint)> = Vec::new();
    for test in tests(here.cycle.closure) {
        let (before, after) = ((test.value)(here), (test.value)(there));
        let changes = before.is_finite() && after.is_finite() && before * after < 0.0;
        if !changes {
            continue;
        }
        found.extend(locate(tracer, here, step, &test, [before, after]));
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    // Where the branch turns back det(J - I) vanishes as well; that is the saddle-node's own.
    let turns: Vec<f64> =
        found.iter().filter(|one| one.1.kind == Bifurcation::SaddleNode).map(|one| one.0).collect();
    found.retain(|(at, special)| {
        // A determinant passes through a pole where an impact vanishes.
        let measured = matches!(special.kind, Bifurcation::Grazing | Bifurcation::VanishingImpact);
        if !(special.converged || measured) {
            return false;
        }
        special.kind != Bifurcation::BranchPoint
            || turns.iter().all(|turn| (turn - at).abs() > 1e-3 * step)
    });
    found.into_iter().map(|(_, special)| special).collect()
}

fn locate(
    tracer: &Tracer,
    here: &Point,
    step: f64,
    test: &Test,
    [before, after]: [f64; 2],
) -> Option<(f64, SpecialPoint)> {
    let at = |s: f64| {
        if s == 0.0 { Ok(here.clone()) } else { tracer.advance(here, s) }
    };
    let value = |s: f64| at(s).map_or(f64::NAN, |point| (test.value)(&point));
    let root = brent(0.0, step, LOCATED * step, value).ok()?;
    let point = at(root.at).ok()?;
    let orbit = tracer.orbit(&point, Origin::Continuation)?;
    let kind = renamed(test.kind, &orbit)?;
    let width = LOCATED * step;
    let near = |s: f64| at(s).map_or(f64::NAN, |point| point.parameter * tracer.scale);
    let (left, right) = (near((root.at - width).max(0.0)), near((root.at + width).min(step)));
    let value = point.parameter * tracer.scale;
    let grazes = kind == Bifurcation::Grazing && orbit.admissibility.narrowest.is_some();
    let sequence_beyond =
        if grazes { switching::beyond_grazing(tracer, point.parameter, &orbit) } else { None };
    let bracket = [left.min(right).min(value), left.max(right).max(value)];
    Some((
        root.at,
        SpecialPoint {
            kind,
            value,
            bracket,
            precision: (bracket[1] - bracket[0]) / value.abs().max(f64::MIN_POSITIVE),
            test: [before, root.residual, after],
            converged: root.residual.abs() <= VANISHES * before.abs().max(after.abs()),
            sequence_beyond,
            orbit,
        },
    ))
}

/// What a vanishing test function means at this orbit; `None` for two real reciprocal multipliers,
/// which are no bifurcation.
fn renamed(kind: Bifurcation, orbit: &Orbit) -> Option<Bifurcation> {
    match kind {
        Bifurcation::NeimarkSacker => {
            let on_circle =
                |[re, im]: [f64; 2]| im != 0.0 && (libm::hypot(re, im) - 1.0).abs() < 1e-4;
            orbit.multipliers.values.iter().any(|value| on_circle(*value)).then_some(kind)
        }
        // A branch of asymmetric orbits turns back where it meets its own mirror image.
        Bifurcation::SaddleNode if orbit.cycle.folded(1e-5).is_some() => {
            Some(Bifurcation::SymmetryBreaking)
        }
        _ => Some(kind),
    }
}
