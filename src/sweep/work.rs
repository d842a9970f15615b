//! Points worked out: every layer that something is recorded of, many trajectories side by side.

use std::ops::Range;

use super::columns::{self, Column, SECTION};
use super::facts::{PointFacts, PointMotions};
use super::follow;
use super::{GridPoint, Plan};
use crate::case::{Recorded, SweepSettings};
use crate::executor::Serial;
use crate::motions::{Effort, Motion, Place, Section, motions, sections};
use crate::simulation::StartError;
use crate::system::System;

/// Trajectories side by side: many times the lanes of a batch, so that they are filled, and few enough
/// for their records to stay in a processor's cache and out of the way.
const TRAJECTORIES: u64 = 256;

/// The results of some points, in their order. Where a motion is followed, these are whole lines.
///
/// # Errors
/// [`StartError`] where a start is not finite.
pub fn points(plan: &Plan, numbers: Range<u64>) -> Result<Vec<Column>, StartError> {
    let mut results = columns::empty(plan);
    if let Some(unsteady) = &plan.unsteady {
        for point in numbers.map(|number| plan.point(number)) {
            columns::push(
                &mut results,
                point.number,
                &point.coordinates,
                unsteady.cells(plan, &point),
            );
        }
        return Ok(results);
    }
    let at_once = match plan.settings.follow {
        true => numbers.end.saturating_sub(numbers.start).max(1),
        false => (TRAJECTORIES / u64::from(plan.settings.starts.max(1))).max(1),
    };
    let mut begin = numbers.start;
    while begin < numbers.end {
        let end = numbers.end.min(begin + at_once);
        let some: Vec<GridPoint> = (begin..end).map(|number| plan.point(number)).collect();
        let found = match plan.needs_simulation() {
            true => simulated(plan, &some)?,
            false => vec![Vec::new(); some.len()],
        };
        for (point, found) in some.iter().zip(found) {
            let cells = columns::cells(plan, &PointFacts::of(point, found));
            columns::push(&mut results, point.number, &point.coordinates, cells);
        }
        begin = end;
    }
    Ok(results)
}

/// What simulation finds at points, for each from several starts or in two directions.
fn simulated(plan: &Plan, points: &[GridPoint]) -> Result<Vec<Vec<PointMotions>>, StartError> {
    let mut found = match plan.settings.follow {
        true => follow::along(plan, points)?,
        false => from_starts(plan, points)?,
    };
    let wants = |recorded| plan.settings.record.contains(&recorded);
    if wants(Recorded::Lyapunov) || wants(Recorded::Section) {
        look_closer(plan, points, &mut found)?;
    }
    Ok(found)
}

fn from_starts(plan: &Plan, points: &[GridPoint]) -> Result<Vec<Vec<PointMotions>>, StartError> {
    let places: Vec<Option<Place>> = points.iter().map(|point| place(plan, point)).collect();
    let there: Vec<Place> = places.iter().flatten().cloned().collect();
    let mut all = motions(&there, &effort(plan), &Serial)?.into_iter();
    let found = places.iter().map(|place| {
        let motions = place.as_ref().and_then(|_| all.next()).unwrap_or_default();
        vec![PointMotions { motions, ..PointMotions::default() }]
    });
    Ok(found.collect())
}

/// How thoroughly motions of a point are searched: as of a case, with as many starts and periods as the sweep asks for.
fn effort(plan: &Plan) -> Effort {
    let SweepSettings { starts, periods, .. } = plan.settings;
    Effort { starts, periods, shaking: plan.asks_for_shaking(), ..Effort::default() }
}

/// The system of a point and its starts: the one that axes say, if it is possible, or the usual ones.
fn place(plan: &Plan, point: &GridPoint) -> Option<Place> {
    let system = point.system?;
    Some(match point.start {
        Some(start) if start.relative_displacement().abs() > 1.0 => return None,
        Some(start) => Place::with(&system, vec![start]),
        None => Place::new(&system, plan.settings.starts),
    })
}

/// Adds what only a second look at the main motions tells: exponents and sections.
fn look_closer(
    plan: &Plan,
    points: &[GridPoint],
    found: &mut [Vec<PointMotions>],
) -> Result<(), StartError> {
    let ways = points.iter().zip(&*found).flat_map(|(point, ways)| {
        ways.iter().map(|one| Some((point.system?, one.motions.main()?)))
    });
    let main: Vec<Option<(System, &Motion)>> = ways.collect();
    let there: Vec<(System, &Motion)> = main.iter().flatten().copied().collect();
    let exponent = plan.settings.record.contains(&Recorded::Lyapunov);
    let periods = exponent.then_some(plan.settings.periods);
    let mut sections = sections(&there, SECTION as u64, periods)?.into_iter();
    let seen: Vec<Option<Section>> =
        main.iter().map(|one| one.and_then(|_| sections.next())).collect();
    for (one, section) in found.iter_mut().flatten().zip(seen) {
        one.section = section.unwrap_or_default();
    }
    Ok(())
}
