//! Many trajectories at a time, each until it comes to rest, is on a known orbit, repeats, or has been measured over a
//! window.

use super::identity::KnownMotion;
use super::settling;
use super::watch::{Watch, WindowSample};
use crate::regimes::Periodicity;
use crate::simulation::batch::{self, Extent};
use crate::simulation::{Observer, Simulation, Stop};
use crate::system::{State, System};

/// Periods at the end of those left out in which it is watched whether a motion repeats after up to four; one
/// that takes longer is seen to in a window. More of them are time lost for the many that repeat after one.
const WATCHED: u64 = 20;
/// Flights of the absorber from wall to wall in a window in which it is slow: enough for extremes.
const FLIGHTS: u32 = 16;
/// Trajectories up to which each flies alone: most lanes of a batch would be empty.
const FEW: usize = 3;
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
pub(super) struct StartFlight {
    /// Its number among those of the search.
    pub index: usize,
    pub simulation: Simulation,
    /// Excitation periods that it was flown before the simulation began.
    pub before: u64,
    /// Excitation periods that it flies on before it is looked at.
    pub left_out: u64,
    /// Excitation periods over which it is measured then, where it does not repeat; 0 where it is not.
    pub window: u64,
}

/// What became of one.
pub(super) enum StartOutcome {
    /// It came to rest where no wall reaches it, in a state at phase 0.
    Rests(State),
    /// It is on the orbit with this index.
    On(usize),
    /// It repeats, or was measured over its window.
    Seen(Box<WindowSample>),
    /// Neither.
    Open,
    /// It could not be followed.
    Lost,
}

/// Flies all of them as far as each is to go; `known` are the motions of each one's place.
pub(super) fn flown<'a>(
    flights: Vec<StartFlight>,
    most_impacts: u64,
    known: &dyn Fn(usize) -> &'a [KnownMotion],
) -> Vec<(StartFlight, StartOutcome)> {
    let mut done = Vec::with_capacity(flights.len());
    let faded = faded(flights, most_impacts, known, &mut done);
    let (mut going, mut windows) = (Vec::new(), Vec::new());
    let periods: Vec<u64> = faded.iter().map(watched).collect();
    let watches = faded.iter().zip(&periods);
    let watches = watches.map(|(one, far)| Watch::of_repetition(&one.simulation, *far)).collect();
    for (flight, mut watch, stop) in watched_over(faded, &periods, watches, most_impacts) {
        let simulation = &flight.simulation;
        let repeats = watch.repetition().is_some();
        if let Some(state) = settling::at_rest(simulation.system(), &simulation.state()) {
            done.push((flight, StartOutcome::Rests(state)));
        } else if stop == Stop::EndTime && flight.window == 0 && !repeats {
            done.push((flight, StartOutcome::Open));
        } else if stop != Stop::ImpactLimit && (stop != Stop::EndTime || repeats) {
            let end = seen(&mut watch, &flight, stop);
            done.push((flight, end));
        } else {
            // Without an impact yet a window holds some flights, but is no longer than what was left out.
            let silent = watch.statistics().impacts() == 0;
            let flown = if silent { periods_of_flights(simulation) } else { 0 };
            let no_longer = |periods| settling::window(simulation.system(), periods);
            windows.push(match stop {
                // Many impacts are a regime already.
                Stop::ImpactLimit => no_longer(WATCHED),
                _ => no_longer(flown.min(simulation.periods())).max(flight.window),
            });
            going.push(flight);
        }
    }
    measured(going, windows, most_impacts, &mut done);
    done
}

/// Periods at the end of those that are left out in which it is watched whether it repeats.
fn watched(flight: &StartFlight) -> u64 {
    settling::window(flight.simulation.system(), WATCHED)
}

fn seen(watch: &mut Watch, flight: &StartFlight, stop: Stop) -> StartOutcome {
    let sample = watch.sample(&flight.simulation, stop);
    sample.map_or(StartOutcome::Lost, |sample| StartOutcome::Seen(Box::new(sample)))
}

/// Leaves out what is to be left out, but for its last periods; those that are on a known orbit by then are done.
fn faded<'a>(
    mut flights: Vec<StartFlight>,
    most_impacts: u64,
    known: &dyn Fn(usize) -> &'a [KnownMotion],
    done: &mut Vec<(StartFlight, StartOutcome)>,
) -> Vec<StartFlight> {
    let mut left: Vec<u64> =
        flights.iter().map(|one| one.left_out.saturating_sub(watched(one))).collect();
    let mut distances = vec![f64::INFINITY; flights.len()];
    let (mut over, mut place) = (Vec::new(), (0..flights.len()).collect::<Vec<_>>());
    while !flights.is_empty() {
        let solved = |one: &StartFlight| {
            known(one.index).iter().any(|one| one.distance(&State::AT_REST).is_finite())
        };
        let each = flights.iter().zip(&place);
        let far: Vec<u64> = each
            .map(|(one, at)| if solved(one) { left[*at].min(LOOK) } else { left[*at] })
            .collect();
        let mut nobody: Vec<()> = vec![(); flights.len()];
        let stops = run(&mut flights, &far, &mut nobody, most_impacts);
        let ended = std::mem::take(&mut flights).into_iter().zip(std::mem::take(&mut place));
        for (((flight, at), far), stop) in ended.zip(far).zip(stops) {
            left[at] -= far;
            let state = flight.simulation.state();
            let distance = |one: &KnownMotion| one.distance(&state);
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
fn measured(
    mut flights: Vec<StartFlight>,
    mut windows: Vec<u64>,
    most_impacts: u64,
    done: &mut Vec<(StartFlight, StartOutcome)>,
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
    let mut watches: Vec<Watch> = flights.iter().map(|one| Watch::begin(&one.simulation)).collect();
    let mut stretch = 2 * WATCHED;
    while !flights.is_empty() {
        let far: Vec<u64> = windows.iter().map(|left| stretch.min(*left)).collect();
        let ended = watched_over(flights, &far, watches, most_impacts);
        (flights, watches) = (Vec::new(), Vec::new());
        let mut further = Vec::new();
        for ((flight, mut watch, stop), left) in ended.into_iter().zip(windows) {
            let settled = watch.repetition().is_some_and(Periodicity::has_settled);
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
fn watched_over(
    mut flights: Vec<StartFlight>,
    periods: &[u64],
    mut watches: Vec<Watch>,
    most_impacts: u64,
) -> Vec<(StartFlight, Watch, Stop)> {
    let mut told: Vec<_> = watches.iter_mut().map(|one| &mut one.observers).collect();
    let stops = run(&mut flights, periods, &mut told, most_impacts);
    let all = flights.into_iter().zip(watches).zip(stops);
    all.map(|((flight, watch), stop)| (flight, watch, stop)).collect()
}

fn run<O: Observer>(
    flights: &mut [StartFlight],
    periods: &[u64],
    observers: &mut [O],
    most_impacts: u64,
) -> Vec<Stop> {
    let each = flights.iter().zip(periods);
    let extents: Vec<Extent> = each
        .map(|(one, periods)| extent(one.simulation.system(), *periods, most_impacts))
        .collect();
    if flights.len() <= FEW {
        let each = flights.iter_mut().zip(&extents).zip(observers);
        return each
            .map(|((one, far), observer)| one.simulation.run(far.periods, far.impacts, observer))
            .collect();
    }
    let mut simulations: Vec<&mut Simulation> =
        flights.iter_mut().map(|one| &mut one.simulation).collect();
    batch::run_each(&mut simulations, &extents, observers)
}

fn extent(system: &System, periods: u64, most_impacts: u64) -> Extent {
    // A slow excitation has many natural periods in each of its own.
    let natural = (1.0 / system.frequency_ratio()).max(1.0);
    Extent { periods, impacts: ((periods as f64 * natural) as u64).saturating_mul(most_impacts) }
}

/// Excitation periods of [`FLIGHTS`] flights of an absorber from wall to wall.
fn periods_of_flights(simulation: &Simulation) -> u64 {
    let speed = simulation.state().y_velocity.abs();
    let duration = f64::from(FLIGHTS) * 2.0 / speed;
    if speed > 0.0 { (duration / simulation.system().period()) as u64 } else { 0 }
}
