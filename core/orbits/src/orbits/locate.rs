//! Where on a branch a bifurcation lies: test functions that vanish there, and the root of each
//! between two neighbouring points.

use super::continuation::{COINCIDES, SignChange, Traced as _, sign_change};
use super::cycle::Closure;
use super::grazing;
use super::mirror;
use super::multipliers::{minus_one, plus_one, unit_product};
use super::orbit::Origin;
use super::special_point::SpecialPoint;
use super::tracer::{TracedPoint, Tracer};
use crate::bifurcation::Bifurcation;

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
        let change = sign_change(tracer, [here, there], step, test.value);
        found.extend(change.and_then(|change| special(tracer, test.kind, change)));
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

fn special(
    tracer: &Tracer,
    kind: Bifurcation,
    change: SignChange<TracedPoint>,
) -> Option<(f64, SpecialPoint)> {
    let SignChange { at, point, value, bracket, test, converged } = change;
    let orbit = point.orbit(Origin::Continuation).ok()?;
    // Two real reciprocal multipliers are no bifurcation.
    if kind == Bifurcation::NeimarkSacker && !orbit.multipliers.has_pair_on_circle() {
        return None;
    }
    let grazes = kind == Bifurcation::Grazing && orbit.admissibility.narrowest.is_some();
    let sequence_beyond =
        if grazes { grazing::beyond_grazing(tracer, point.parameter(), &orbit) } else { None };
    let precision = (bracket[1] - bracket[0]) / value.abs().max(f64::MIN_POSITIVE);
    let found =
        SpecialPoint { kind, value, bracket, precision, test, converged, sequence_beyond, orbit };
    Some((at, found))
}
