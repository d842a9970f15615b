//! Where a branch of asymmetric orbits meets its own mirror image, on the branch of symmetric ones.
//!
//! Two branches cross there, so that the corrector that follows either is singular. The symmetric
//! orbits alone are not: the crossing is where their half-period map has the multiplier -1, a simple
//! root in the parameter, looked for near the place where the asymmetry changes its sign.

use super::continuation::{Traced as _, distance};
use super::cycle::{Closure, Cycle};
use super::impact_map::AfterImpact;
use super::multipliers::minus_one;
use super::orbit::Orbit;
use super::special_point::SpecialPoint;
use super::tracer::{TracedPoint, Tracer};
use crate::bifurcation::Bifurcation;
use crate::numerics::bracket::brent;

/// Relative width to which the parameter is located: some units in the last place.
const LOCATED: f64 = 1e-14;
/// How often the bracket around the first guess is doubled: from a thousandth of the step between two
/// points to several steps, further than the branch can turn in one.
const DOUBLINGS: u32 = 12;

/// The place between two neighbouring points at which the branch is its own mirror image, as a part
/// of the way, and the symmetry breaking there; `None` if the asymmetry does not change its sign.
pub(super) fn met(
    tracer: &Tracer,
    here: &TracedPoint,
    there: &TracedPoint,
) -> Option<(f64, SpecialPoint)> {
    let (before, after) = (asymmetry(here.cycle())?, asymmetry(there.cycle())?);
    if before * after >= 0.0 {
        return None;
    }
    let share = before / (before - after);
    let half = symmetrised(&between(here.cycle(), there.cycle(), share));
    let guess = here.parameter() + share * (there.parameter() - here.parameter());
    let test = |scaled: f64| {
        let found = tracer.at(&half, scaled);
        found.and_then(|orbit| minus_one_of(tracer, scaled, &orbit)).unwrap_or(f64::NAN)
    };
    let step = distance(there, here);
    let (low, high) = (0..DOUBLINGS).find_map(|k| {
        let reach = 1e-3 * step * f64::from(1 << k);
        let (low, high) = (guess - reach, guess + reach);
        (test(low) * test(high) < 0.0).then_some((low, high))
    })?;
    let root = brent(low, high, LOCATED * guess.abs(), test).ok()?;
    let orbit = tracer.at(&half, root.at)?;
    let scale = tracer.scale;
    let value = root.at * scale;
    let width = LOCATED * value.abs();
    Some((
        share,
        SpecialPoint {
            kind: Bifurcation::SymmetryBreaking,
            value,
            bracket: [value - width, value + width],
            precision: 2.0 * LOCATED,
            test: [test(low), root.residual, test(high)],
            converged: true,
            sequence_beyond: None,
            orbit,
        },
    ))
}

fn minus_one_of(tracer: &Tracer, scaled: f64, orbit: &Orbit) -> Option<f64> {
    Some(minus_one(&orbit.cycle.jacobian(&tracer.map_at(scaled)?)))
}

/// How much longer the first half of a cycle lasts than the second; `None` where no mirror image can
/// be the cycle itself.
fn asymmetry(cycle: &Cycle) -> Option<f64> {
    let Closure::Repeats { periods } = cycle.closure else { return None };
    let (first, second) = cycle.impacts.split_at(cycle.impacts.len() / 2);
    let opposite = first.len() == second.len()
        && first.iter().zip(second).all(|(one, other)| other.wall == one.wall.opposite());
    (periods % 2 == 1 && opposite).then(|| {
        let (first, second) = cycle.durations.split_at(first.len());
        first.iter().sum::<f64>() - second.iter().sum::<f64>()
    })
}

/// The cycle at a part of the way from one to another with the same walls.
fn between(from: &Cycle, to: &Cycle, share: f64) -> Cycle {
    let mix = |a: f64, b: f64| a + share * (b - a);
    let impacts = from.impacts.iter().zip(&to.impacts);
    let durations = from.durations.iter().zip(&to.durations);
    Cycle {
        impacts: impacts.map(|(a, b)| middle(a, b, share)).collect(),
        durations: durations.map(|(a, b)| mix(*a, *b)).collect(),
        ..from.clone()
    }
}

/// Half of the cycle that is its own mirror image and halfway between a cycle and its mirror image.
fn symmetrised(cycle: &Cycle) -> Cycle {
    let half = cycle.impacts.len() / 2;
    let periods = cycle.periods();
    // The second half lasts as many half periods as there are periods.
    let image = |after: &AfterImpact| after.mirrored(-f64::from(periods));
    let pairs = cycle.impacts[..half].iter().zip(&cycle.impacts[half..]);
    let durations = cycle.durations[..half].iter().zip(&cycle.durations[half..]);
    Cycle {
        closure: Closure::Mirrors { periods },
        impacts: pairs.map(|(first, second)| middle(first, &image(second), 0.5)).collect(),
        durations: durations.map(|(first, second)| 0.5 * (first + second)).collect(),
    }
}

fn middle(a: &AfterImpact, b: &AfterImpact, share: f64) -> AfterImpact {
    a.moved_to(&(a.vector() + (b.vector() - a.vector()) * share))
}
