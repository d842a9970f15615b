//! How far an attracting antiperiodic orbit reaches along a number of the system, and every stretch on which there is one.

use serde::Serialize;

use super::branch::{Orbits, Point};
use super::{ModalOrbit, antiperiodic_orbits};
use crate::bifurcation::Bifurcation;
use crate::orbits::OrbitError;
use crate::orbits::branch::{BranchDirection, Settings};
use crate::orbits::continuation::{Family as _, trace};
use crate::system::{ModalParameter, ModalSystem};

/// Points of a branch on either side of an orbit: with the largest step ten clearances or radians.
const MOST_POINTS: usize = 400;
/// Bifurcations on either side of an orbit after which a branch is left.
const MOST_BIFURCATIONS: usize = 8;
/// Distance of the ends of two stretches, over the range, up to which they are one.
const SAME_END: f64 = 1e-6;

/// Where an attracting orbit ends on one side.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ReachEnd {
    /// Value of the parameter.
    pub value: f64,
    /// What ends it there; none where no more was looked at, or found.
    pub kind: Option<Bifurcation>,
}

/// How far an attracting orbit of a system reaches along a parameter, downwards and upwards within a range: up to its first
/// bifurcation on either side.
///
/// # Errors
/// [`OrbitError`] where it is no orbit of the system.
pub fn stable_reach(
    system: &ModalSystem,
    orbit: &ModalOrbit,
    parameter: ModalParameter,
    range: [f64; 2],
) -> Result<[ReachEnd; 2], OrbitError> {
    reach((system, parameter), parameter.of(system), orbit, range)
}

fn reach(
    of: (&ModalSystem, ModalParameter),
    own: f64,
    orbit: &ModalOrbit,
    range: [f64; 2],
) -> Result<[ReachEnd; 2], OrbitError> {
    let end = |direction| Ok(side(of, own, orbit, direction, range, 0)?[0].end);
    Ok([end(BranchDirection::Down)?, end(BranchDirection::Up)?])
}

/// A part of a branch between two bifurcations.
struct Part {
    attracts: bool,
    /// Where it ends.
    end: ReachEnd,
}

/// The parts of a branch on one side of an orbit, up to so many bifurcations further than the first.
fn side(
    of: (&ModalSystem, ModalParameter),
    own: f64,
    orbit: &ModalOrbit,
    direction: BranchDirection,
    range: [f64; 2],
    further: usize,
) -> Result<Vec<Part>, OrbitError> {
    let settings = Settings { most_points: MOST_POINTS, ..Settings::within(range) };
    let (family, first) = Orbits::through(of, own, orbit, direction)?;
    let stable = |point: &Point| point.orbit().is_some_and(ModalOrbit::stable);
    let mut last = family.value(&first);
    // As its first point does; one that no point lies on is too short to be known.
    let mut attracts = vec![stable(&first)];
    let found = trace(&family, first, &settings, |point, passed| {
        if passed > further {
            // Nobody asks what lies beyond.
            return Err(OrbitError::Singular);
        }
        last = family.value(point);
        if attracts.len() <= passed {
            attracts.resize(passed, false);
            attracts.push(stable(point));
        }
        Ok(())
    });
    let specials = found.specials.iter().take(further + 1).map(|(_, special)| special);
    let mut ends: Vec<ReachEnd> = specials
        .map(|special| ReachEnd { value: special.value, kind: Some(special.kind) })
        .collect();
    if ends.len() <= further {
        ends.push(ReachEnd { value: last, kind: None });
    }
    attracts.resize(ends.len(), false);
    Ok(attracts.into_iter().zip(ends).map(|(attracts, end)| Part { attracts, end }).collect())
}

/// The stretches on which a branch through an orbit attracts.
fn along_branch(
    of: (&ModalSystem, ModalParameter),
    own: f64,
    orbit: &ModalOrbit,
    range: [f64; 2],
) -> Result<Vec<[ReachEnd; 2]>, OrbitError> {
    let parts = |direction| side(of, own, orbit, direction, range, MOST_BIFURCATIONS);
    let [down, up] = [parts(BranchDirection::Down)?, parts(BranchDirection::Up)?];
    let mut found = Vec::new();
    if down[0].attracts {
        found.push([down[0].end, up[0].end]);
    }
    for parts in [down, up] {
        let stable = parts.windows(2).filter(|pair| pair[1].attracts);
        found.extend(stable.map(|pair| [pair[0].end, pair[1].end]));
    }
    for ends in &mut found {
        ends.sort_by(|a, b| a.value.total_cmp(&b.value));
    }
    Ok(found)
}

/// Values over a range at which [`stable_stretches`] looks for orbits, evenly or, above 0, in equal ratios: fewer where
/// there are more than two absorbers, whose orbits take more starts to find.
pub fn values_looked_at(system: &ModalSystem) -> u32 {
    if system.absorbers().len() > 2 { 5 } else { 17 }
}

/// Stretches of a parameter within a range on which an antiperiodic orbit attracts, ascending: along the branches through all
/// orbits at the system's own value, and of those that attract at [`values_looked_at`].
pub fn stable_stretches(
    system: &ModalSystem,
    parameter: ModalParameter,
    range: [f64; 2],
) -> Vec<[ReachEnd; 2]> {
    let ([low, high], of) = (range, (system, parameter));
    let count = values_looked_at(system);
    let value = |n: u32| {
        let share = f64::from(n) / f64::from(count - 1);
        if low > 0.0 { low * libm::pow(high / low, share) } else { low + share * (high - low) }
    };
    let mut found: Vec<[ReachEnd; 2]> = Vec::new();
    let own = parameter.of(system);
    for at in std::iter::once(own).chain((0..count).map(value)) {
        // One absorber has no two orbits that attract.
        let single = system.absorbers().len() == 1;
        if single && found.iter().any(|[from, to]| from.value <= at && at <= to.value) {
            continue;
        }
        let Ok(there) = parameter.applied(system, at) else { continue };
        for orbit in antiperiodic_orbits(&there) {
            let stretches = match (at == own, orbit.stable()) {
                (true, _) => along_branch(of, at, &orbit, range),
                (false, true) => reach(of, at, &orbit, range).map(|ends| vec![ends]),
                (false, false) => continue,
            };
            for ends in stretches.unwrap_or_default() {
                let same = |other: &[ReachEnd; 2]| {
                    let off = |k: usize| (other[k].value - ends[k].value).abs();
                    off(0).max(off(1)) <= SAME_END * (high - low)
                };
                if !found.iter().any(same) {
                    found.push(ends);
                }
            }
        }
    }
    found.sort_by(|a, b| a[0].value.total_cmp(&b[0].value).then(a[1].value.total_cmp(&b[1].value)));
    found
}
