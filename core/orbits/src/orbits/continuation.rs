//! Pseudo-arclength continuation in one parameter (Keller 1977), whatever the orbits are of: a step along the tangent,
//! Newton's method on the plane across it, and what lies between two points.

use serde::Serialize;

use super::OrbitError;
use crate::bifurcation::Bifurcation;
use crate::numerics::bracket::brent;

/// Smallest step before a branch is given up: the root of the precision of a point, over less the tangent
/// is rounding.
const SMALLEST_STEP: f64 = 1e-7;
/// Cosine of the angle by which a branch may turn in one step: 26 degrees, well short of taking the
/// far side of a fold for its near one.
const LARGEST_TURN: f64 = 0.9;
/// Distance to the orbit at the edge of a range, over the step, beyond which it is on another branch:
/// along this one it is a step away, and a little more where the branch is curved.
const SAME_BRANCH: f64 = 2.0;
/// Radians of all points' flights, in the phase of the faster of structure and excitation, after which a
/// branch is given up, as a point costs in their proportion: more than [`Settings::most_points`] points of one
/// excitation period near resonance, and a second or two where a period has a thousand oscillations.
const MOST_RADIANS: f64 = 1e5;
/// Corrector steps with which the branch is as good as straight: the next step may be longer.
const EASY: u32 = 3;
/// Growth of the step after an easy point, and its shrinking after another: slow enough for one
/// curved stretch not to be overrun, fast enough for a straight one to cost little.
const LONGER: f64 = 1.5;
/// See [`LONGER`].
const SHORTER: f64 = 0.8;
/// Width over the step to which a bifurcation is located: with steps of some hundredths the rounding
/// of the points themselves.
const LOCATED: f64 = 1e-12;
/// Value of a test function at its root, over its values on either side, above which it jumps there
/// instead of vanishing. Roots leave 1e-12, the pole of a determinant where an impact vanishes 1e11.
const VANISHES: f64 = 1e-6;
/// Distance over the step within which a zero of `det(J - I)` is a saddle-node's own: two roots for
/// one point differ by 1e-13, and a thousandth of a step is no distance between two bifurcations.
pub(super) const COINCIDES: f64 = 1e-3;
/// Points before a branch can have come back to where it began: fewer enclose nothing.
const FEWEST_AROUND: usize = 3;
/// Distance from the first point, over the stretch that may pass it, beyond which it is another part
/// of the branch: either end of a stretch that passes a point is within one stretch of it, and a
/// curved one a little farther.
const BESIDE: f64 = 2.0;

/// Points after which a branch that neither ends nor closes is given up: with the largest step an
/// arclength of a hundred clearances.
const MOST_POINTS: usize = 2000;
/// A fifth of the largest step: a branch may begin next to a bifurcation.
const FIRST_STEP: f64 = 0.01;
/// A twentieth of a clearance or radian: what a figure still shows as smooth, and short enough for
/// two bifurcations of one kind seldom to share a step.
const LARGEST_STEP: f64 = 0.05;
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

/// A point while a branch is followed.
pub(super) trait Traced: Clone {
    /// The unknowns and the parameter over its scale, which is the last.
    type Place: AsRef<[f64]>;
    /// Where it is, as the arclength measures it.
    fn place(&self) -> Self::Place;
    /// Unit tangent of the branch.
    fn tangent(&self) -> &[f64];
    /// Newton steps that led to it.
    fn iterations(&self) -> u32;

    /// The parameter over its scale.
    fn parameter(&self) -> f64 {
        last(self.place().as_ref())
    }

    /// By how much that grows along the tangent.
    fn rise(&self) -> f64 {
        last(self.tangent())
    }
}

/// Orbits over one parameter.
pub(super) trait Family {
    type Point: Traced;
    type Special;
    /// The parameter's unit in a [`Traced`].
    fn scale(&self) -> f64;
    /// How long a point's flights take, in radians of the faster of structure and excitation.
    fn radians(&self, point: &Self::Point) -> f64;
    /// The point an arclength `step` along the branch from another.
    ///
    /// # Errors
    /// [`OrbitError`] where there is no system, or Newton's method does not converge.
    fn advance(&self, from: &Self::Point, step: f64) -> Result<Self::Point, OrbitError>;
    /// The point at a value of the scaled parameter, about an arclength `step` from another.
    ///
    /// # Errors
    /// As [`Self::advance`].
    fn at_parameter(
        &self,
        from: &Self::Point,
        step: f64,
        scaled: f64,
    ) -> Result<Self::Point, OrbitError>;
    /// Every bifurcation between two neighbouring points, in order along the branch.
    fn between(&self, here: &Self::Point, there: &Self::Point, step: f64) -> Vec<Self::Special>;
    /// Which it is, and the parameter there.
    fn bifurcation(special: &Self::Special) -> (Bifurcation, f64);

    /// The parameter at a point.
    fn value(&self, point: &Self::Point) -> f64 {
        point.parameter() * self.scale()
    }
}

/// What lies along a branch, without its points.
pub(super) struct BranchTrace<S> {
    /// The bifurcations, in order.
    pub specials: Vec<S>,
    /// Why it ends.
    pub end: BranchEnd,
}

fn last(of: &[f64]) -> f64 {
    of.last().copied().unwrap_or(f64::NAN)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |sum, (a, b)| sum + a * b)
}

fn difference(there: &impl Traced, here: &impl Traced) -> Vec<f64> {
    there.place().as_ref().iter().zip(here.place().as_ref()).map(|(a, b)| a - b).collect()
}

pub(super) fn distance(there: &impl Traced, here: &impl Traced) -> f64 {
    let off = difference(there, here);
    dot(&off, &off).sqrt()
}

/// Whether a branch turns little from one point to another.
fn straight(here: &impl Traced, there: &impl Traced) -> bool {
    dot(there.tangent(), here.tangent()) >= LARGEST_TURN
}

/// The next point, with the step that reached it: halved until the corrector converges and the
/// branch turns little.
///
/// # Errors
/// Why no step down to [`SMALLEST_STEP`] reached one.
fn next<F: Family>(
    family: &F,
    here: &F::Point,
    mut step: f64,
) -> Result<(F::Point, f64), OrbitError> {
    loop {
        let failure = match family.advance(here, step) {
            Ok(there) if straight(here, &there) => return Ok((there, step)),
            Ok(_) => OrbitError::Singular,
            Err(failure) => failure,
        };
        step *= 0.5;
        if step < SMALLEST_STEP {
            return Err(failure);
        }
    }
}

/// The orbit at the edge of `range` (values of the parameter), the step to it and the value there, if the next
/// step would leave it: parameters need not exist beyond (a restitution above 1).
fn at_edge<F: Family>(
    family: &F,
    here: &F::Point,
    step: f64,
    range: [f64; 2],
) -> Option<(F::Point, f64, f64)> {
    let [low, high] = range.map(|edge| edge / family.scale());
    let ahead = here.parameter() + step * here.rise();
    let edge = if ahead > high {
        high
    } else if ahead < low {
        low
    } else {
        return None;
    };
    let share = (edge - here.parameter()) / here.rise();
    let there = family.at_parameter(here, share, edge).ok()?;
    // A branch that turns back before the edge must not be left for another one.
    let same =
        distance(&there, here) <= SAME_BRANCH * step.max(share.abs()) && straight(here, &there);
    same.then_some((there, share, edge * family.scale()))
}

/// Follows a branch from a point on it, along its tangent; `visit` gets each point after the first, with
/// the number of bifurcations before it.
pub(super) fn trace<F: Family>(
    family: &F,
    first: F::Point,
    settings: &Settings,
    mut visit: impl FnMut(&F::Point, usize) -> Result<(), OrbitError>,
) -> BranchTrace<F::Special> {
    let begin = family.value(&first);
    let mut specials = Vec::new();
    let mut here = first.clone();
    let mut step = settings.first_step;
    let (mut radians, mut count) = (0.0, 1);
    let failed = |last: &F::Point, reason: &OrbitError| BranchEnd::NotConverged {
        value: family.value(last),
        reason: reason.to_string(),
    };
    while count < settings.most_points && radians < MOST_RADIANS {
        radians += family.radians(&here);
        let (there, taken, last) = match at_edge(family, &here, step, settings.range) {
            Some((there, share, edge)) => (there, share, Some(BranchEnd::Range { value: edge })),
            None => match next(family, &here, step) {
                Ok((there, taken)) => (there, taken, None),
                Err(reason) => return BranchTrace { specials, end: failed(&here, &reason) },
            },
        };
        let met = returns(&first, &here, &there, count);
        let last = last.or(met.then_some(BranchEnd::Closed { value: begin }));
        if let Some(end) = pass(family, [&here, &there], taken, settings, &mut specials) {
            return BranchTrace { specials, end };
        }
        if let Err(reason) = visit(&there, specials.len()) {
            return BranchTrace { specials, end: failed(&here, &reason) };
        }
        if let Some(end) = last {
            return BranchTrace { specials, end };
        }
        count += 1;
        let factor = if there.iterations() <= EASY { LONGER } else { SHORTER };
        step = (taken * factor).min(settings.largest_step);
        here = there;
    }
    BranchTrace { specials, end: BranchEnd::PointLimit { value: family.value(&here) } }
}

/// Whether the stretch from `here` to `there` passes the branch's first point, along its tangent.
fn returns<P: Traced>(first: &P, here: &P, there: &P, passed: usize) -> bool {
    // Phases count whole turns; a closed branch may come back a turn later.
    let stretch = distance(there, here);
    let near =
        distance(here, first) <= BESIDE * stretch && distance(there, first) <= BESIDE * stretch;
    let side = |point: &P| dot(first.tangent(), &difference(point, first));
    passed > FEWEST_AROUND && near && side(here) < 0.0 && side(there) >= 0.0
}

/// Takes the bifurcations before a new point into the branch; says whether it ends at one of them.
fn pass<F: Family>(
    family: &F,
    [here, there]: [&F::Point; 2],
    step: f64,
    settings: &Settings,
    specials: &mut Vec<F::Special>,
) -> Option<BranchEnd> {
    let mut found = family.between(here, there, step);
    let [low, high] = settings.range;
    found.retain(|special| (low..=high).contains(&F::bifurcation(special).1));
    let end = found.iter().position(|special| F::bifurcation(special).0.ends_motion());
    found.truncate(end.map_or(found.len(), |index| index + 1));
    let stops = end.map(|index| BranchEnd::Grazing { value: F::bifurcation(&found[index]).1 });
    specials.extend(found);
    stops
}

/// Where a test function changes its sign between two points.
pub(super) struct SignChange<P> {
    /// Arclength from the first of them.
    pub at: f64,
    pub point: P,
    /// The parameter there, and between which values the change was located.
    pub value: f64,
    pub bracket: [f64; 2],
    /// The test function before, at and after it.
    pub test: [f64; 3],
    /// Whether it really vanishes there, rather than jump.
    pub converged: bool,
}

/// The root of a test function between two points, a `step` from one another; none where its sign does not change, or the root
/// is not found.
pub(super) fn sign_change<F: Family>(
    family: &F,
    [here, there]: [&F::Point; 2],
    step: f64,
    test: impl Fn(&F::Point) -> f64,
) -> Option<SignChange<F::Point>> {
    let (before, after) = (test(here), test(there));
    let changes = before.is_finite() && after.is_finite() && before * after < 0.0;
    if !changes {
        return None;
    }
    let at = |s: f64| match s {
        0.0 => Ok(here.clone()),
        _ if s == step => Ok(there.clone()),
        _ => family.advance(here, s),
    };
    let value = |s: f64| at(s).map_or(f64::NAN, |point| test(&point));
    let root = brent(0.0, step, LOCATED * step, value).ok()?;
    let point = at(root.at).ok()?;
    let value = family.value(&point);
    let width = LOCATED * step;
    let near = |s: f64| at(s).map_or(f64::NAN, |point| family.value(&point));
    let (left, right) = (near((root.at - width).max(0.0)), near((root.at + width).min(step)));
    Some(SignChange {
        at: root.at,
        point,
        value,
        bracket: [left.min(right).min(value), left.max(right).max(value)],
        test: [before, root.residual, after],
        converged: root.residual.abs() <= VANISHES * before.abs().max(after.abs()),
    })
}
