//! Where on a branch a bifurcation lies: test functions that vanish there, and the root of each
//! between two neighbouring points.

use super::cycle::Closure;
use super::grazing;
use super::mirror;
use super::multipliers::{minus_one, plus_one, unit_product};
use super::orbit::Origin;
use super::special_point::SpecialPoint;
use super::tracer::{TracedPoint, Tracer};
use crate::bifurcation::Bifurcation;
use crate::numerics::bracket::brent;

/// Width over the step to which a bifurcation is located: with steps of some hundredths the rounding
/// of the points themselves.
const LOCATED: f64 = 1e-12;
/// Value of a test function at its root, over its values on either side, above which it jumps there
/// instead of vanishing. Roots leave 1e-12, the pole of a determinant where an impact vanishes 1e11.
const VANISHES: f64 = 1e-6;
/// Distance over the step within which a zero of `det(J - I)` is a saddle-node's own: two roots for
/// one point differ by 1e-13, and a thousandth of a step is no distance between two bifurcations.
const COINCIDES: f64 = 1e-3;

/// A test function: the bifurcation that it shows, and its value at a point.
struct Test {
    kind: Bifurcation,
    value: fn(&TracedPoint) -> f64,
}

fn tests(closure: Closure) -> [Test; 8] {
    let minus = match closure {
        Closure::Repeats { .. } => Bifurcation::PeriodDoubling,
        Closure::Mirrors { .. } => Bifurcation::SymmetryBreaking,
    };
    [
        Test { kind: Bifurcation::SaddleNode, value: |point| point.tangent[4] },
        Test { kind: Bifurcation::BranchPoint, value: |point| plus_one(point.jacobian()) },
        Test { kind: minus, value: |point| minus_one(point.jacobian()) },
        Test { kind: Bifurcation::NeimarkSacker, value: |point| unit_product(point.jacobian()) },
        Test { kind: Bifurcation::Grazing, value: |point| point.distances().min_wall_distance },
        Test {
            kind: Bifurcation::Sticking,
            value: |point| point.distances().slowest_departure.unwrap_or(f64::NAN),
        },
        Test {
            kind: Bifurcation::VanishingImpact,
            value: |point| point.distances().slowest_impact,
        },
        Test {
            kind: Bifurcation::Reversal,
            value: |point| point.distances().slowest_slip.unwrap_or(f64::NAN),
        },
    ]
}

/// Every bifurcation between two neighbouring points, in order along the branch.
pub(super) fn located(
    tracer: &Tracer,
    here: &TracedPoint,
    there: &TracedPoint,
    step: f64,
) -> Vec<SpecialPoint> {
    let mut found: Vec<(f64, SpecialPoint)> = Vec::new();
    for test in tests(here.cycle().closure) {
        let (before, after) = ((test.value)(here), (test.value)(there));
        let changes = before.is_finite() && after.is_finite() && before * after < 0.0;
        if !changes {
            continue;
        }
        found.extend(locate(tracer, here, step, &test, [before, after]));
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    // Where the branch turns back det(J - I) vanishes as well; that is the saddle-node's own. Where
    // the absorber begins to stay on the wall the distance jumps; that is the sticking's own. An impact
    // that loses its speed ends the slip as well.
    let places = |kind: Bifurcation| -> Vec<f64> {
        found.iter().filter(|one| one.1.kind == kind).map(|one| one.0).collect()
    };
    let (turns, sticking) = (places(Bifurcation::SaddleNode), places(Bifurcation::Sticking));
    let vanishing = places(Bifurcation::VanishingImpact);
    let apart = |own: &[f64], at: f64| own.iter().all(|one| (one - at).abs() > COINCIDES * step);
    found.retain(|(at, special)| {
        // A determinant passes through a pole where an impact vanishes.
        if !(special.converged || special.kind.ends_motion()) {
            return false;
        }
        match special.kind {
            Bifurcation::BranchPoint => apart(&turns, *at),
            Bifurcation::Grazing => apart(&sticking, *at),
            Bifurcation::Reversal => apart(&vanishing, *at),
            _ => true,
        }
    });
    if let Some((share, crossing)) = mirror::met(tracer, here, there) {
        // The branch turns back there, and the symmetric one passes: both are the crossing's own.
        found.retain(|(_, special)| {
            !matches!(special.kind, Bifurcation::SaddleNode | Bifurcation::BranchPoint)
        });
        let place = found.iter().take_while(|(at, _)| *at < share * step).count();
        found.insert(place, (share * step, crossing));
    }
    found.into_iter().map(|(_, special)| special).collect()
}

fn locate(
    tracer: &Tracer,
    here: &TracedPoint,
    step: f64,
    test: &Test,
    [before, after]: [f64; 2],
) -> Option<(f64, SpecialPoint)> {
    let at = |s: f64| {
        if s == 0.0 { Ok(here.clone()) } else { tracer.advance(here, s) }
    };
    let value = |s: f64| at(s).map_or(f64::NAN, |point| (test.value)(&point));
    let root = brent(0.0, step, LOCATED * step, value)?;
    let point = at(root.at).ok()?;
    let value = tracer.value(&point);
    let orbit = point.orbit(Origin::Continuation).ok()?;
    // Two real reciprocal multipliers are no bifurcation.
    let kind = test.kind;
    if kind == Bifurcation::NeimarkSacker && !orbit.multipliers.has_pair_on_circle() {
        return None;
    }
    let width = LOCATED * step;
    let near = |s: f64| at(s).map_or(f64::NAN, |point| tracer.value(&point));
    let (left, right) = (near((root.at - width).max(0.0)), near((root.at + width).min(step)));
    let grazes = kind == Bifurcation::Grazing && orbit.admissibility.narrowest.is_some();
    let sequence_beyond =
        if grazes { grazing::beyond_grazing(tracer, point.parameter(), &orbit) } else { None };
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
