//! Bifurcation diagrams: a parameter swept up and down by simulation, the exact orbits over the same
//! range, how well both agree, and where the way up and the way down end in different motions.

use serde::Serialize;

use crate::motions::{DiagramPoint, Effort, SweepDirection, sweep};
use crate::orbits::Peaks;
use crate::orbits::newton::solve;
use crate::orbits::{
    Bifurcation, Closure, FullSystem, ImpactMap, Origin, StableStretch, symmetric_orbits,
};
use crate::regimes::Regime;
use crate::system::{Parameter, State, System};

use super::StudyError;
use super::exact_branches::ExactBranches;

/// Values of the parameter: six pixels apart in a figure, and a second or so of simulation.
pub const STEPS: u32 = 120;
/// Each value: a modulation returns several times in 100 periods. More than ten impacts per period are given
/// up: that regime is recognised, and its cost has to end somewhere.
pub const PERIODS: u64 = 100;
const MOST_IMPACTS: u64 = 10;
/// An absorber that crosses its cavity: where the first value begins; all others begin where the last one
/// ended.
pub(super) const START: State = State { y_velocity: 1.0, ..State::AT_REST };

/// The range in clearance: from this part of the smallest exact limit to this many times the largest.
const AROUND_LIMITS: [f64; 2] = [0.6, 1.25];
/// A saddle-node up to so many times the last limit of stability belongs to what is shown.
const NEAR_LIMIT: f64 = 1.5;
/// The case has so much room to either side in its parameter's logarithm ...
const ROOM: f64 = 1.15;
/// ... unless it lies further outside the range than this factor.
const FAR: f64 = 4.0;
/// Frequencies, over the case's, among which those with an attracting orbit are looked for, and how
/// many per unit of their logarithm.
const FREQUENCIES: [f64; 2] = [0.8, 1.25];
const PER_E_FOLD: f64 = 1000.0;
/// Part of the stretch of frequencies with 1:1 resonance that is shown beside it.
const BESIDE: f64 = 0.4;

/// Difference of a mean peak, over the larger, below which two motions are one if either repeats: what
/// a slow transient leaves, and no difference to a designer.
const SAME_PERIODIC: f64 = 0.02;
/// Difference of a root mean square, over the larger, below which they are one if neither repeats, unless it scatters more.
const SAME_MODULATED: f64 = 0.2;
/// Difference in impacts per period below which they may be the same motions if either repeats: a
/// transient with one impact more in twenty periods.
const SAME_IMPACTS: f64 = 0.05;
/// Shortest hysteresis in values: one may be a transient that outlasts its periods.
const SHORTEST: usize = 2;

/// A diagram of one parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagram {
    /// What is swept; clearance and forcing are over the base system's.
    pub parameter: Parameter,
    /// First and last value.
    pub range: [f64; 2],
    /// What simulation became, upwards first.
    pub points: Vec<DiagramPoint>,
    /// Every exact branch in the range.
    pub exact: ExactBranches,
    /// Simulation against the attracting orbits; `None` where no motion could be compared.
    pub agreement: Option<Agreement>,
    /// Where both ways end in different motions.
    pub hysteresis: Vec<Hysteresis>,
}

/// How far simulated motions of one period lie from the attracting exact orbits with as many impacts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Agreement {
    /// Motions compared.
    pub compared: usize,
    /// Motions of one period next to which no branch has an attracting orbit.
    pub without_orbit: usize,
    /// Largest difference of the peaks, over the exact one.
    pub largest: f64,
    /// The parameter there.
    pub at: f64,
}

/// Neighbouring values at which both ways end in different motions.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Hysteresis {
    /// First and last of them.
    pub values: [f64; 2],
    /// The regime on the way up and on the way down, in the middle.
    pub regimes: [Regime; 2],
    /// The largest displacements there, over the base system's clearance.
    pub peaks: [f64; 2],
}

impl Diagram {
    /// Of `parameter` around the system that `full` knows, in [`STEPS`] values; `None` where no symmetric
    /// orbit attracts, so that there is nothing to lose and to find again.
    ///
    /// # Errors
    /// [`StudyError`] where the range has values without a system.
    pub fn around(full: &FullSystem, parameter: Parameter) -> Result<Option<Self>, StudyError> {
        let Some(range) = range(full, parameter) else { return Ok(None) };
        let base = &full.system;
        let exact = ExactBranches::over(base, parameter, range);
        if exact.attracting_stretches().is_empty() {
            return Ok(None);
        }
        let values: Vec<f64> = (0..STEPS)
            .map(|k| parameter.between(range, f64::from(k) / f64::from(STEPS - 1)))
            .collect();
        let effort = Effort { most_impacts: MOST_IMPACTS, ..Effort::over(PERIODS) };
        let points = sweep(base, parameter, &values, START, &effort, &mut |_| {})?;
        let agreement = agreement(base, parameter, &points, &exact);
        let mut diagram =
            Self { parameter, range, points, exact, agreement, hysteresis: Vec::new() };
        diagram.hysteresis = diagram.hysteresis();
        Ok(Some(diagram))
    }

    /// The points of one way, by ascending value.
    pub fn way(&self, way: SweepDirection) -> Vec<&DiagramPoint> {
        let of_way = self.points.iter().filter(|point| point.way == way);
        let mut chosen: Vec<&DiagramPoint> = of_way.collect();
        chosen.sort_by(|a, b| a.value.total_cmp(&b.value));
        chosen
    }

    fn hysteresis(&self) -> Vec<Hysteresis> {
        let [up, down] = [SweepDirection::Up, SweepDirection::Down].map(|way| self.way(way));
        let pairs: Vec<[&DiagramPoint; 2]> =
            up.into_iter().zip(down).map(|(a, b)| [a, b]).collect();
        let runs = pairs.chunk_by(|a, b| differ(*a) == differ(*b));
        let runs = runs.filter(|run| differ(run[0]) && run.len() >= SHORTEST);
        let told = runs.map(|run| {
            let middle = run[run.len() / 2];
            Hysteresis {
                values: [run[0][0].value, run[run.len() - 1][0].value],
                regimes: middle.map(|point| point.motion.regime()),
                peaks: middle.map(|point| point.peak),
            }
        });
        told.collect()
    }
}

/// The values of `parameter` in which 1:1 resonance comes and goes around a system; `None` where it has
/// no attracting symmetric orbit.
fn range(exact: &FullSystem, parameter: Parameter) -> Option<[f64; 2]> {
    match parameter {
        Parameter::Clearance => clearances(exact),
        Parameter::Amplitude => clearances(exact).map(|[low, high]| [1.0 / high, 1.0 / low]),
        Parameter::Frequency => frequencies(&exact.system),
        _ => None,
    }
}

/// From below the smallest limit, of asymmetric orbits as well, to above the largest.
fn clearances(exact: &FullSystem) -> Option<[f64; 2]> {
    let boundaries = exact.boundaries.as_ref()?;
    let away = |stretch: &&StableStretch| {
        let [low, high] = stretch.clearance;
        libm::log(low).max(-libm::log(high)).max(0.0)
    };
    let nearest = boundaries.symmetric.stable.iter().min_by(|a, b| away(a).total_cmp(&away(b)))?;
    let [low, last] = nearest.clearance;
    let first = boundaries.grazing().map_or(low, |grazing| grazing.min(low));
    let limits = boundaries.symmetric.limits.iter();
    let vanishing = limits
        .filter(|limit| limit.kind == Bifurcation::SaddleNode)
        .map(|limit| limit.clearance)
        .filter(|clearance| (last..NEAR_LIMIT * last).contains(clearance));
    let last = vanishing.fold(last, f64::max);
    Some(with_case([AROUND_LIMITS[0] * first, AROUND_LIMITS[1] * last], 1.0))
}

fn with_case([low, high]: [f64; 2], own: f64) -> [f64; 2] {
    if (low / FAR..FAR * high).contains(&own) {
        [low.min(own / ROOM), high.max(own * ROOM)]
    } else {
        [low, high]
    }
}

/// From below the lowest to above the highest frequency with an attracting symmetric orbit.
fn frequencies(system: &System) -> Option<[f64; 2]> {
    let own = system.frequency_ratio();
    let attracts = |ratio: f64| {
        let orbits = system.with_frequency_ratio(ratio).ok().map(|there| symmetric_orbits(&there));
        orbits.and_then(Result::ok).is_some_and(|all| all.iter().any(|one| one.orbit.attracts()))
    };
    let ends = FREQUENCIES.map(|factor| libm::log(factor) * PER_E_FOLD);
    let tried: Vec<(f64, bool)> = (ends[0] as i32..=ends[1] as i32)
        .map(|k| own * libm::exp(f64::from(k) / PER_E_FOLD))
        .map(|ratio| (ratio, attracts(ratio)))
        .collect();
    // In between, the orbits may be asymmetric.
    let low = tried.iter().find(|one| one.1)?.0;
    let high = tried.iter().rfind(|one| one.1)?.0;
    let beside = BESIDE * (high - low).max(1.0 / PER_E_FOLD);
    let room = 0.25 * beside;
    Some([(low - beside).min(own - room), (high + beside).max(own + room)])
}

/// Compares the peaks of simulated motions of one period with those of the attracting orbits with as
/// many impacts, which Newton's method solves at each value.
fn agreement(
    base: &System,
    parameter: Parameter,
    points: &[DiagramPoint],
    exact: &ExactBranches,
) -> Option<Agreement> {
    let mut found = Agreement { compared: 0, without_orbit: 0, largest: 0.0, at: f64::NAN };
    for point in points {
        let motion = &point.motion;
        if motion.repeats_after() != Some(1) || motion.rest().is_some() {
            continue;
        }
        let Ok(there) = parameter.applied(base, point.value) else { continue };
        let Ok(map) = ImpactMap::of(&there) else { continue };
        let unit = parameter.unit(point.value);
        // What repeats is the end of the window; its beginning may be the last of a transient.
        let Some(simulated) = point.period_peaks.last() else { continue };
        let of_kind = exact.attracting(point.value).map(|near| &near.cycle).filter(|cycle| {
            let (Closure::Mirrors { periods } | Closure::Repeats { periods }) = cycle.closure;
            periods == 1 && cycle.impact_count() as f64 == motion.facts().impacts_per_period.value
        });
        let solved = of_kind.filter_map(|cycle| solve(&there, cycle, Origin::Continuation).ok());
        let peaks = solved.filter(|orbit| orbit.attracts()).map(|orbit| {
            let peak = unit * Peaks::of(&map, &orbit.cycle).displacement;
            (simulated / peak - 1.0).abs()
        });
        match peaks.min_by(f64::total_cmp) {
            None => found.without_orbit += 1,
            Some(distance) => {
                found.compared += 1;
                if distance >= found.largest {
                    (found.largest, found.at) = (distance, point.value);
                }
            }
        }
    }
    (found.compared > 0).then_some(found)
}

/// Whether two motions at one value are not the same.
fn differ([up, down]: [&DiagramPoint; 2]) -> bool {
    let repeats = |point: &DiagramPoint| point.motion.repeats_after().is_some();
    let facts = [up, down].map(|point| point.motion.facts());
    if !repeats(up) && !repeats(down) {
        // Of all that was measured: the last periods alone may hold a burst, or none.
        let [a, b] = facts.map(|one| one.rms);
        let scatter = (a.error + b.error).max(SAME_MODULATED * a.value.max(b.value));
        return (a.value - b.value).abs() > scatter;
    }
    let [a, b] = [up, down].map(|point| {
        let peaks = &point.period_peaks;
        let mean = peaks.iter().sum::<f64>() / peaks.len().max(1) as f64;
        let wide = peaks.iter().map(|peak| (peak - mean).abs()).fold(0.0, f64::max);
        [mean, wide]
    });
    let larger = a[0].max(b[0]);
    let impacts = facts.map(|one| one.impacts_per_period.value);
    let impacts = (impacts[0] - impacts[1]).abs();
    (a[0] - b[0]).abs() > SAME_PERIODIC * larger
        // A repeating motion is no modulated one of the same mean ...
        || (a[1] - b[1]).abs() > 2.0 * SAME_PERIODIC * larger
        // ... and not one with other impacts either.
        || impacts > SAME_IMPACTS
}
