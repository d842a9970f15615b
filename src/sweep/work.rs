//! Points worked out: every layer that something is recorded of, many trajectories side by side.

use std::ops::Range;

use super::columns::{self, Column, SECTION};
use super::facts::{Facts, Found};
use super::follow;
use super::{Plan, Point};
use crate::case::Recorded;
use crate::regimes::long_term::motions;
use crate::regimes::{Effort, Lyapunov, starts};
use crate::simulation::{Detail, Observer, Simulation, StartError, batch};
use crate::system::{State, System};

/// Trajectories side by side: many times the lanes of a batch, so that they are filled, and few enough
/// for their records to stay in a processor's cache and out of the way.
const TRAJECTORIES: u64 = 256;
/// Impacts per period at which an extra measurement of a motion is given up, as motions are.
const MOST_IMPACTS: u64 = 1000;

/// The results of some points, in their order. Where a motion is followed, these are whole lines.
///
/// # Errors
/// [`StartError`] where a start is not finite.
pub fn points(plan: &Plan, numbers: Range<u64>) -> Result<Vec<Column>, StartError> {
    let mut results = columns::empty(plan);
    if let Some(subject) = &plan.subject {
        for point in numbers.map(|number| plan.point(number)) {
            columns::push(&mut results, &point, subject.cells(plan, &point));
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
        let some: Vec<Point> = (begin..end).map(|number| plan.point(number)).collect();
        let found = match plan.needs_simulation() {
            true => simulated(plan, &some)?,
            false => vec![Vec::new(); some.len()],
        };
        for (point, found) in some.iter().zip(found) {
            columns::push(&mut results, point, columns::cells(plan, &Facts::of(point, found)));
        }
        begin = end;
    }
    Ok(results)
}

/// What simulation finds at points, for each from several starts or in two directions.
fn simulated(plan: &Plan, points: &[Point]) -> Result<Vec<Vec<Found>>, StartError> {
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

fn from_starts(plan: &Plan, points: &[Point]) -> Result<Vec<Vec<Found>>, StartError> {
    let places: Vec<Option<_>> = points.iter().map(|point| startable(plan, point)).collect();
    let there: Vec<(System, Vec<State>)> = places.iter().flatten().cloned().collect();
    let mut all = motions(&there, &Effort::over(plan.settings.periods))?.into_iter();
    let found = places.iter().map(|place| {
        let motions = place.as_ref().and_then(|_| all.next()).unwrap_or_default();
        vec![Found { motions, ..Found::default() }]
    });
    Ok(found.collect())
}

/// The system of a point and its starts: the one that axes say, if it is possible, or the usual ones.
fn startable(plan: &Plan, point: &Point) -> Option<(System, Vec<State>)> {
    let system = point.system?;
    let starts = match point.start {
        Some(start) if start.relative_displacement().abs() > 1.0 => return None,
        Some(start) => vec![start],
        None => starts::of(&system, plan.settings.starts).collect(),
    };
    Some((system, starts))
}

/// Adds what only a second look at the main motions tells: exponents and sections.
fn look_closer(plan: &Plan, points: &[Point], found: &mut [Vec<Found>]) -> Result<(), StartError> {
    let mut all: Vec<(&mut Found, Simulation)> = Vec::new();
    for (point, ways) in points.iter().zip(found) {
        for one in ways {
            let state = one.main().map(|motion| motion.state);
            if let Some((system, state)) = point.system.zip(state) {
                all.push((one, Simulation::new(&system, state, 0.0)?));
            }
        }
    }
    let (mut found, mut simulations): (Vec<&mut Found>, Vec<Simulation>) = all.into_iter().unzip();
    let mut sections: Vec<Section> = simulations.iter().map(|_| Section::default()).collect();
    let periods = SECTION as u64;
    batch::run(&mut simulations, periods, periods * MOST_IMPACTS, &mut sections);
    for (one, section) in found.iter_mut().zip(sections) {
        one.section = section.displacements;
    }
    if plan.settings.record.contains(&Recorded::Lyapunov) {
        let periods = plan.settings.periods;
        let mut exponents: Vec<Lyapunov> =
            simulations.iter().map(|one| Lyapunov::begin(one.system())).collect();
        batch::run(&mut simulations, periods, periods * MOST_IMPACTS, &mut exponents);
        for (one, exponent) in found.iter_mut().zip(exponents) {
            one.lyapunov = exponent.exponent().map(|found| found.per_period);
        }
    }
    Ok(())
}

/// Keeps the oscillator's displacement at the end of each period.
#[derive(Default)]
struct Section {
    displacements: Vec<f64>,
}

impl Observer for Section {
    fn detail(&self) -> Detail {
        Detail::Events
    }
    fn period(&mut self, state: &State) {
        self.displacements.push(state.x);
    }
}
