//! Antiperiodic orbits of several modes and absorbers over one number of the system, and every bifurcation on the way.
//!
//! Unknown are the phase of each absorber's impact and its speed, over that of the first orbit; how the conditions depend on the
//! number comes from a difference, as it only sets the direction of a step: each point solves the conditions themselves.

use std::cell::OnceCell;

use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use super::walk::Walk;
use super::{CONVERGED, ModalOrbit, Train};
use crate::bifurcation::Bifurcation;
use crate::orbits::OrbitError;
use crate::orbits::branch::{BranchDirection, BranchEnd, Settings};
use crate::orbits::continuation::{
    BranchTrace, COINCIDES, Family, SignChange, Traced, sign_change, trace,
};
use crate::orbits::multipliers::has_pair_on_circle;
use crate::orbits::tracer::SMALLEST_SCALE;
use crate::system::{ModalParameter, ModalSystem};

/// Steps of Newton's method before it is given up, as for one mode.
const LARGEST_STEPS: u32 = 12;
/// Half the difference, over the parameter's scale, from which the derivative comes.
const DIFFERENCE: f64 = 1e-6;
/// An orbit of a [`ModalBranch`].
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ModalBranchPoint {
    /// Value of the parameter.
    pub value: f64,
    /// The orbit.
    pub orbit: ModalOrbit,
    /// How many of the branch's bifurcations lie before it.
    pub passed: usize,
}

/// A located bifurcation on a [`ModalBranch`].
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ModalSpecialPoint {
    /// Which.
    pub kind: Bifurcation,
    /// Value of the parameter.
    pub value: f64,
    /// Values between which it was located.
    pub bracket: [f64; 2],
    /// The orbit there.
    pub orbit: ModalOrbit,
}

/// Antiperiodic orbits in order along a branch.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ModalBranch {
    /// What varies.
    pub parameter: ModalParameter,
    /// The orbits.
    pub points: Vec<ModalBranchPoint>,
    /// The bifurcations, in order.
    pub specials: Vec<ModalSpecialPoint>,
    /// Why it ends.
    pub end: BranchEnd,
}

impl ModalBranch {
    /// Follows the branch through `start`, an orbit of `base`, in one direction.
    ///
    /// One absorber on two modes, its clearance made larger until the motion is modulated:
    ///
    /// ```
    /// use vinesink_core::bifurcation::Bifurcation;
    /// use vinesink_core::orbits::branch::{BranchDirection, Settings};
    /// use vinesink_core::orbits::{ModalBranch, antiperiodic_orbits};
    /// use vinesink_core::system::{ModalAbsorber, ModalParameter, ModalParameters, ModalSystem, Mode};
    ///
    /// let mode = |frequency, damping_ratio, value| Mode {
    ///     frequency, damping_ratio, mass: 1.0, forcing: 0.25, shape: vec![value], ..Mode::default()
    /// };
    /// let system = ModalSystem::new(ModalParameters {
    ///     modes: vec![mode(1.0, 0.0069, 1.0), mode(6.267, 0.01, -1.0)],
    ///     absorbers: vec![ModalAbsorber { mass: 0.0077, clearance: 20.0, restitution: 0.6 }],
    ///     frequency_ratio: 1.018,
    ///     ..ModalParameters::default()
    /// })?;
    /// let orbits = antiperiodic_orbits(&system);
    /// let start = orbits.iter().find(|orbit| orbit.stable()).expect("one attracts");
    /// let (clearance, settings) = (ModalParameter::Clearance(0), Settings::within([10.0, 40.0]));
    /// let branch = ModalBranch::follow(&system, start, clearance, BranchDirection::Up, &settings)?;
    /// let first = &branch.specials[0];
    /// assert_eq!(first.kind, Bifurcation::NeimarkSacker);
    /// // A pair of multipliers passes the unit circle.
    /// assert!((first.orbit.spectral_radius() - 1.0).abs() < 1e-6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`OrbitError`] where `start` is no orbit of `base`.
    pub fn follow(
        base: &ModalSystem,
        start: &ModalOrbit,
        parameter: ModalParameter,
        direction: BranchDirection,
        settings: &Settings,
    ) -> Result<Self, OrbitError> {
        let own = parameter.of(base);
        let (family, first) = Orbits::through((base, parameter), own, start, direction)?;
        let point = |point: &Point, passed| {
            let orbit = point.orbit().ok_or(OrbitError::Singular)?.clone();
            Ok(ModalBranchPoint { value: family.value(point), orbit, passed })
        };
        let mut points = vec![point(&first, 0)?];
        let BranchTrace { specials, end } = trace(&family, first, settings, |there, passed| {
            points.push(point(there, passed)?);
            Ok(())
        });
        let specials = specials.into_iter().map(|(_, special)| special).collect();
        Ok(Self { parameter, points, specials, end })
    }
}

/// A point of a branch.
#[derive(Debug, Clone)]
pub(super) struct Point {
    place: DVector<f64>,
    tangent: DVector<f64>,
    iterations: u32,
    system: ModalSystem,
    /// Times and speeds.
    at: DVector<f64>,
    orbit: OnceCell<Option<ModalOrbit>>,
}

impl Point {
    /// None where its multipliers are not found.
    pub(super) fn orbit(&self) -> Option<&ModalOrbit> {
        self.orbit.get_or_init(|| Train::of(&self.system).described(&self.at)).as_ref()
    }

    /// A function of its multipliers; not a number where there are none.
    fn of_multipliers(&self, of: fn(&[[f64; 2]]) -> f64) -> f64 {
        self.orbit().map_or(f64::NAN, |orbit| of(&orbit.multipliers))
    }
}

impl Traced for Point {
    type Place = Vec<f64>;
    fn place(&self) -> Vec<f64> {
        self.place.as_slice().to_vec()
    }
    fn tangent(&self) -> &[f64] {
        self.tangent.as_slice()
    }
    fn iterations(&self) -> u32 {
        self.iterations
    }
}

/// Orbits over a parameter.
pub(super) struct Orbits<'a> {
    base: &'a ModalSystem,
    parameter: ModalParameter,
    scale: f64,
    /// What each speed is over.
    speeds: Vec<f64>,
}

impl<'a> Orbits<'a> {
    /// Those through an orbit that exists with a value of the parameter, and the point that it is.
    pub(super) fn through(
        (base, parameter): (&'a ModalSystem, ModalParameter),
        own: f64,
        start: &ModalOrbit,
        direction: BranchDirection,
    ) -> Result<(Self, Point), OrbitError> {
        let count = base.absorbers().len();
        let scale = match parameter {
            ModalParameter::Restitution(_) => own.max(SMALLEST_SCALE),
            _ => own,
        };
        let family = Self { base, parameter, scale, speeds: start.impact_speeds.clone() };
        let there = parameter.applied(base, own).map_err(|_| OrbitError::Singular)?;
        let omega = there.frequency_ratio();
        let mut place = DVector::from_element(2 * count + 1, 1.0);
        for j in 0..count {
            let half = if start.sides[j] > 0.0 { 0.0 } else { 0.5 * there.period() };
            place[j] = omega * (start.impact_times[j] + half);
        }
        place[2 * count] = own / scale;
        let mut along = DVector::zeros(2 * count + 1);
        along[2 * count] = if direction == BranchDirection::Up { 1.0 } else { -1.0 };
        let first = family.correct(place, &along, &along)?;
        Ok((family, first))
    }

    fn system(&self, scaled: f64) -> Option<ModalSystem> {
        self.parameter.applied(self.base, scaled * self.scale).ok()
    }

    /// Times and speeds of a place.
    fn at(&self, system: &ModalSystem, place: &DVector<f64>) -> DVector<f64> {
        let count = self.speeds.len();
        DVector::from_fn(2 * count, |n, _| match n {
            _ if n < count => place[n] / system.frequency_ratio(),
            _ => place[n] * self.speeds[n - count],
        })
    }

    /// What is left of the conditions, and their derivative by the parameter.
    fn by_parameter(&self, place: &DVector<f64>) -> Option<DVector<f64>> {
        let scaled = place[place.len() - 1];
        let left = |scaled: f64| {
            let system = self.system(scaled)?;
            Some((scaled, Train::of(&system).equations(&self.at(&system, place)).0))
        };
        let here = || left(scaled);
        let (low, before) = left(scaled - DIFFERENCE).or_else(here)?;
        let (high, after) = left(scaled + DIFFERENCE).or_else(here)?;
        (low < high).then(|| (after - before) / (high - low))
    }

    /// Corrects a place across `normal`, and finds the tangent there, pointing along `along`.
    fn correct(
        &self,
        mut place: DVector<f64>,
        normal: &DVector<f64>,
        along: &DVector<f64>,
    ) -> Result<Point, OrbitError> {
        let (count, size) = (self.speeds.len(), place.len());
        let mut residual = f64::INFINITY;
        for iterations in 0..LARGEST_STEPS {
            let system = self.system(place[size - 1]).ok_or(OrbitError::Singular)?;
            let train = Train::of(&system);
            let at = self.at(&system, &place);
            let (left, sizes, jacobian) = train.equations(&at);
            residual = Train::residual(&left, &sizes);
            if !residual.is_finite() {
                break;
            }
            let mut matrix = DMatrix::zeros(size, size);
            for n in 0..2 * count {
                let unit =
                    if n < count { 1.0 / system.frequency_ratio() } else { self.speeds[n - count] };
                matrix.view_mut((0, n), (2 * count, 1)).copy_from(&(jacobian.column(n) * unit));
            }
            let slope = self.by_parameter(&place).ok_or(OrbitError::Singular)?;
            matrix.view_mut((0, size - 1), (2 * count, 1)).copy_from(&slope);
            let solved = |last: &DVector<f64>, right: DVector<f64>| {
                let mut matrix = matrix.clone();
                matrix.set_row(size - 1, &last.transpose());
                matrix.lu().solve(&right).ok_or(OrbitError::Singular)
            };
            let update = solved(normal, left.push(0.0))?;
            place -= update;
            if residual < CONVERGED {
                let mut up = DVector::zeros(size);
                up[size - 1] = 1.0;
                let tangent = solved(along, up)?;
                let tangent = &tangent / tangent.norm();
                let system = self.system(place[size - 1]).ok_or(OrbitError::Singular)?;
                let at = self.at(&system, &place);
                let orbit = OnceCell::new();
                return Ok(Point { place, tangent, iterations, system, at, orbit });
            }
        }
        Err(OrbitError::NotConverged { iterations: LARGEST_STEPS, residual })
    }
}

impl Family for Orbits<'_> {
    type Point = Point;
    type Special = (f64, ModalSpecialPoint);
    fn scale(&self) -> f64 {
        self.scale
    }
    fn radians(&self, point: &Point) -> f64 {
        let omega = point.system.frequency_ratio();
        let fastest = point.system.modes().iter().map(|mode| mode.frequency).fold(omega, f64::max);
        0.5 * fastest * point.system.period()
    }
    fn advance(&self, from: &Point, step: f64) -> Result<Point, OrbitError> {
        self.correct(&from.place + &from.tangent * step, &from.tangent, &from.tangent)
    }
    fn at_parameter(&self, from: &Point, step: f64, scaled: f64) -> Result<Point, OrbitError> {
        let mut place = &from.place + &from.tangent * step;
        let last = place.len() - 1;
        place[last] = scaled;
        let mut pinned = DVector::zeros(place.len());
        pinned[last] = 1.0;
        self.correct(place, &pinned, &from.tangent)
    }
    fn between(&self, here: &Point, there: &Point, step: f64) -> Vec<Self::Special> {
        let mut found: Vec<Self::Special> = Vec::new();
        for (kind, test) in TESTS {
            let change = sign_change(self, [here, there], step, test);
            found.extend(change.and_then(|change| self.special(kind, change)));
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let turns = found.iter().filter(|one| one.1.kind == Bifurcation::SaddleNode);
        let turns: Vec<f64> = turns.map(|one| one.0).collect();
        // Where the branch turns back a multiplier is 1 as well.
        let apart = |at: f64| turns.iter().all(|one| (one - at).abs() > COINCIDES * step);
        found.retain(|(at, one)| one.kind != Bifurcation::BranchPoint || apart(*at));
        found
    }
    fn bifurcation((_, special): &Self::Special) -> (Bifurcation, f64) {
        (special.kind, special.value)
    }
}

type Test = fn(&Point) -> f64;

/// Test functions: the bifurcation that each shows, and its value at a point. That of the last says whether it is a motion.
const TESTS: [(Bifurcation, Test); 5] = [
    (Bifurcation::SaddleNode, |point| point.rise()),
    (Bifurcation::BranchPoint, |point| point.of_multipliers(|all| product_with(all, -1.0))),
    (Bifurcation::SymmetryBreaking, |point| point.of_multipliers(|all| product_with(all, 1.0))),
    (Bifurcation::NeimarkSacker, |point| point.of_multipliers(product_of_pairs)),
    (Bifurcation::Grazing, |point| {
        point.orbit().map_or(f64::NAN, |orbit| if orbit.admissible { 1.0 } else { -1.0 })
    }),
];

impl Orbits<'_> {
    fn special(
        &self,
        kind: Bifurcation,
        change: SignChange<Point>,
    ) -> Option<(f64, ModalSpecialPoint)> {
        let SignChange { at, point, value, bracket, converged, .. } = change;
        let orbit = point.orbit()?.clone();
        let kind = match kind {
            // Two real reciprocal multipliers are no bifurcation.
            Bifurcation::NeimarkSacker if !has_pair_on_circle(&orbit.multipliers) => return None,
            Bifurcation::Grazing => self.ends(&point, bracket)?,
            _ if !converged => return None,
            other => other,
        };
        Some((at, ModalSpecialPoint { kind, value, bracket, orbit }))
    }

    /// What ends the motion next to a point.
    fn ends(&self, point: &Point, bracket: [f64; 2]) -> Option<Bifurcation> {
        let beside = |value: f64| self.at_parameter(point, 0.0, value / self.scale).ok();
        let around = [Some(point.clone()), beside(bracket[0]), beside(bracket[1])];
        around.iter().flatten().find_map(|one| {
            let orbit = one.orbit()?;
            let ends = Walk::along(&one.system, orbit).ends;
            let stops = orbit.impact_speeds.iter().any(|u| *u <= 0.0);
            ends.or(stops.then_some(Bifurcation::VanishingImpact))
        })
    }
}

/// `prod (m + sign)` over the multipliers: 0 where one is `-sign`.
fn product_with(multipliers: &[[f64; 2]], sign: f64) -> f64 {
    multipliers.iter().fold([1.0, 0.0], |of, [re, im]| times(of, [re + sign, *im]))[0]
}

/// `prod (m n - 1)` over pairs of different multipliers: 0 where a complex pair has the modulus 1.
fn product_of_pairs(multipliers: &[[f64; 2]]) -> f64 {
    let mut product = [1.0, 0.0];
    for (k, one) in multipliers.iter().enumerate() {
        for other in &multipliers[..k] {
            let [re, im] = times(*one, *other);
            product = times(product, [re - 1.0, im]);
        }
    }
    product[0]
}

fn times([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    [a * c - b * d, a * d + b * c]
}
