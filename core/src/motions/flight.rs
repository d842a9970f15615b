//! Many trajectories at a time, each until it comes to rest, is on a known orbit, repeats, or has been measured over a
//! window.

use super::model::{KnownMotion, Model};
use crate::simulation::Stop;
use crate::simulation::batch::Extent;

/// Periods at the end of those left out in which it is watched whether a motion repeats after up to four; one
/// that takes longer is seen to in a window. More of them are time lost for the many that repeat after one.
const WATCHED: u64 = 20;
/// Periods after which a trajectory is held against the known orbits: a fraction of any transient, and long enough for a
/// batch to be filled.
const LOOK: u64 = 48;

/// Periods whose records are in memory at a time, 128 bytes each: an excitation that is thousands of times faster than
/// the structure takes a hundred thousand until a transient has faded.
const MOST_RECORDS: u64 = 1_000_000;
/// Those that stay in a processor's cache, unless fewer trajectories than fill a batch would be measured together.
const CACHED_RECORDS: u64 = 16_000;
/// See [`CACHED_RECORDS`].
const FILLS_A_BATCH: u64 = 64;

/// A start on its way.
#[derive(Debug)]
pub(super) struct StartFlight<M: Model> {
    /// Its number among those of the search.
    pub index: usize,
    pub flight: M::Flight,
    /// Excitation periods that it was flown before the flight began.
    pub before: u64,
    /// Excitation periods that it flies on before it is looked at.
    pub left_out: u64,
    /// Excitation periods over which it is measured then, where it does not repeat; 0 where it is not.
    pub window: u64,
    /// Whether it is measured over all of them, whether it seems to repeat or not.
    pub whole: bool,
}

/// What became of one.
pub(super) enum StartOutcome<M: Model> {
    /// It came to rest where no wall reaches it, in a state at phase 0.
    Rests(M::State),
    /// It is on the motion with this index.
    On(usize),
    /// It repeats, or was measured over its window.
    Seen(Box<M::Sample>),
    /// Neither.
    Open,
    /// It could not be followed.
    Lost,
}

/// Starts with what became of them.
type Ended<M> = Vec<(StartFlight<M>, StartOutcome<M>)>;

/// Flies all of them as far as each is to go; `known` are the motions of each one's place.
pub(super) fn flown<'a, M: Model + 'a>(
    flights: Vec<StartFlight<M>>,
    most_impacts: u64,
    known: &dyn Fn(usize) -> &'a [KnownMotion<M>],
) -> Ended<M> {
    let mut done = Vec::with_capacity(flights.len());
    let faded = faded(flights, most_impacts, known, &mut done);
    let (mut going, mut windows) = (Vec::new(), Vec::new());
    let periods: Vec<u64> = faded.iter().map(watched).collect();
    let watches = faded.iter().zip(&periods);
    let watches = watches.map(|(one, far)| M::watch_of_repetition(&one.flight, *far)).collect();
    for (flight, mut watch, stop) in watched_over(faded, &periods, watches, most_impacts) {
        let trajectory = &flight.flight;
        let repeats = !flight.whole && M::repeats(&mut watch).is_some();
        if let Some(state) = M::at_rest(trajectory) {
            done.push((flight, StartOutcome::Rests(state)));
        } else if stop == Stop::EndTime && flight.window == 0 && !repeats {
            done.push((flight, StartOutcome::Open));
        } else if stop != Stop::ImpactLimit && (stop != Stop::EndTime || repeats) {
            let end = seen(&mut watch, &flight, stop);
            done.push((flight, end));
        } else {
            // Without an impact yet a window holds some flights, but is no longer than what was left out.
            let silent = M::is_silent(&mut watch);
            let flown = if silent { M::periods_of_flights(trajectory) } else { 0 };
            let no_longer = |periods| M::of(trajectory).window(periods);
            windows.push(match stop {
                // Many impacts are a regime already.
                Stop::ImpactLimit => no_longer(WATCHED),
                _ => no_longer(flown.min(M::periods(trajectory))).max(flight.window),
            });
            going.push(flight);
        }
    }
    measured(going, windows, most_impacts, &mut done);
    done
}

/// Periods at the end of those that are left out in which it is watched whether it repeats.
fn watched<M: Model>(flight: &StartFlight<M>) -> u64 {
    M::of(&flight.flight).window(WATCHED)
}

fn seen<M: Model>(watch: &mut M::Watch, flight: &StartFlight<M>, stop: Stop) -> StartOutcome<M> {
    let sample = M::sample(watch, &flight.flight, stop);
    sample.map_or(StartOutcome::Lost, |sample| StartOutcome::Seen(Box::new(sample)))
}

/// Leaves out what is to be left out, but for its last periods; those that are on a known orbit by then are done.
fn faded<'a, M: Model + 'a>(
    mut flights: Vec<StartFlight<M>>,
    most_impacts: u64,
    known: &dyn Fn(usize) -> &'a [KnownMotion<M>],
    done: &mut Ended<M>,
) -> Vec<StartFlight<M>> {
    let mut left: Vec<u64> =
        flights.iter().map(|one| one.left_out.saturating_sub(watched(one))).collect();
    let mut distances = vec![f64::INFINITY; flights.len()];
    let (mut over, mut place) = (Vec::new(), (0..flights.len()).collect::<Vec<_>>());
    while !flights.is_empty() {
        let solved = |one: &StartFlight<M>| known(one.index).iter().any(KnownMotion::attracts);
        let each = flights.iter().zip(&place);
        let far: Vec<u64> = each
            .map(|(one, at)| if solved(one) { left[*at].min(LOOK) } else { left[*at] })
            .collect();
        let stops = run(&mut flights, &far, None, most_impacts);
        let ended = std::mem::take(&mut flights).into_iter().zip(std::mem::take(&mut place));
        for (((flight, at), far), stop) in ended.zip(far).zip(stops) {
            left[at] -= far;
            let state = M::state(&flight.flight);
            let distance = |one: &KnownMotion<M>| one.distance(&state);
            let nearest = known(flight.index).iter().map(distance).enumerate();
            let nearest = nearest.min_by(|a, b| a.1.total_cmp(&b.1));
            let before = distances[at];
            let on = nearest.filter(|(_, near)| *near < 1.0 && *near < before);
            distances[at] = nearest.map_or(f64::INFINITY, |(_, near)| near);
            match on {
                Some((index, _)) if before.is_finite() => {
                    done.push((flight, StartOutcome::On(index)))
                }
                _ if left[at] == 0 || stop != Stop::EndTime => over.push((at, flight)),
                _ => {
                    flights.push(flight);
                    place.push(at);
                }
            }
        }
    }
    over.sort_by_key(|(at, _)| *at);
    over.into_iter().map(|(_, flight)| flight).collect()
}

/// Measures each over a window, in stretches that grow: what has settled at the end of one needs no more.
fn measured<M: Model>(
    mut flights: Vec<StartFlight<M>>,
    mut windows: Vec<u64>,
    most_impacts: u64,
    done: &mut Ended<M>,
) {
    // Every period of every window is kept until it is over.
    let longest = windows.iter().copied().max().unwrap_or(0).max(1);
    let together = (CACHED_RECORDS / longest).max(FILLS_A_BATCH).min(MOST_RECORDS / longest).max(1);
    let together = usize::try_from(together).unwrap_or(usize::MAX);
    if flights.len() > together {
        let (others, left) = (flights.split_off(together), windows.split_off(together));
        measured(flights, windows, most_impacts, done);
        return measured(others, left, most_impacts, done);
    }
    let each = flights.iter().zip(&windows);
    let mut watches: Vec<M::Watch> =
        each.map(|(one, window)| M::watch(&one.flight, *window)).collect();
    let mut stretch = 2 * WATCHED;
    while !flights.is_empty() {
        let far: Vec<u64> = windows.iter().map(|left| stretch.min(*left)).collect();
        let ended = watched_over(flights, &far, watches, most_impacts);
        (flights, watches) = (Vec::new(), Vec::new());
        let mut further = Vec::new();
        for ((flight, mut watch, stop), left) in ended.into_iter().zip(windows) {
            let settled = !flight.whole && M::repeats(&mut watch).is_some_and(|settled| settled);
            if left <= stretch || stop != Stop::EndTime || settled {
                let end = seen(&mut watch, &flight, stop);
                done.push((flight, end));
            } else {
                flights.push(flight);
                watches.push(watch);
                further.push(left - stretch);
            }
        }
        windows = further;
        stretch *= 2;
    }
}

/// Goes on with watches.
fn watched_over<M: Model>(
    mut flights: Vec<StartFlight<M>>,
    periods: &[u64],
    mut watches: Vec<M::Watch>,
    most_impacts: u64,
) -> Vec<(StartFlight<M>, M::Watch, Stop)> {
    let stops = run(&mut flights, periods, Some(&mut watches), most_impacts);
    let all = flights.into_iter().zip(watches).zip(stops);
    all.map(|((flight, watch), stop)| (flight, watch, stop)).collect()
}

fn run<M: Model>(
    flights: &mut [StartFlight<M>],
    periods: &[u64],
    watches: Option<&mut [M::Watch]>,
    most_impacts: u64,
) -> Vec<Stop> {
    let each = flights.iter().zip(periods);
    let extents: Vec<Extent> =
        each.map(|(one, periods)| M::extent(&one.flight, *periods, most_impacts)).collect();
    let mut flights: Vec<&mut M::Flight> = flights.iter_mut().map(|one| &mut one.flight).collect();
    M::run(&mut flights, &extents, watches)
}
