//! The motions that starts lead to in the long run, many trajectories side by side: the one search for
//! reports, checks, bands, sweeps, diagrams and basins.
//!
//! A transient is left out by the rule of [`super::transient`]. A motion that is seen to repeat by then is measured
//! over its last repetition, any other over a window or until it repeats; one that is still settling is followed on.

use super::Motion;
use super::motion::distinct;
use super::periodicity::Periodicity;
use super::transient::{self, Transient};
use super::watch::Watch;
use crate::operation_count;
use crate::simulation::batch::{self, Extent};
use crate::simulation::{Observer, Simulation, StartError, Stop};
use crate::system::{State, System};

/// Periods at the end of those left out in which it is watched whether a motion repeats after up to four; one
/// that takes longer is seen to in a window. More of them are time lost for the many that repeat after one.
const WATCHED: u64 = 20;
/// Flights of the absorber from wall to wall in a window in which it is slow: enough for extremes.
const FLIGHTS: u32 = 16;
/// How often a transient is left out, the first time included, of a motion that is still settling; each
/// time the window after it is longer.
const ROUNDS: u64 = 3;
/// Trajectories up to which each flies alone: most lanes of a batch would be empty.
const FEW: usize = 3;

/// How each start is followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// Excitation periods left out; none for as many as [`Transient`] says.
    pub discard: Option<u64>,
    /// Excitation periods measured where a motion is not seen to repeat.
    pub periods: u64,
    /// Impacts per natural or excitation period, whichever is shorter, from which on a trajectory is given
    /// up: many impacts are a regime already.
    pub most_impacts: u64,
}

impl Effort {
    /// After the usual transient, with as many impacts as any motion worth looking at has.
    pub const fn over(periods: u64) -> Self {
        Self { discard: None, periods, most_impacts: 1000 }
    }

    pub(super) fn left_out(&self, system: &System) -> u64 {
        self.discard.unwrap_or_else(|| Transient::of(system).periods)
    }

    pub(super) fn extent(&self, system: &System, periods: u64) -> Extent {
        // A slow excitation has many natural periods in each of its own.
        let natural = (1.0 / system.frequency_ratio()).max(1.0);
        Extent { periods, impacts: (periods as f64 * natural) as u64 * self.most_impacts }
    }
}

impl Default for Effort {
    fn default() -> Self {
        Self::over(250)
    }
}

/// The distinct motions that the starts of each system lead to, in the order in which starts led to them.
///
/// What eight starts of the system of the crate page lead to, the one from rest first:
///
/// ```
/// # use vinesink::system::{Cavity, Excitation, Parameters, System};
/// # let system = System::new(Parameters {
/// #     mass_ratio: 0.032 / 4.168, damping: 1.799, restitution: 0.6, frequency_ratio: 8.0 / 8.349,
/// #     forcing_per_clearance: 4.3417, excitation: Excitation::BaseDisplacement,
/// #     cavity: Cavity::IDEAL,
/// # })?;
/// use vinesink::regimes::{Effort, Regime, motions, starts};
///
/// let places = [(system, starts::of(&system, 8).collect())];
/// let found = &motions(&places, &Effort::over(100))?[0];
/// let steady = found.iter().max_by_key(|motion| motion.starts).expect("at least one");
/// assert_eq!((steady.regime, steady.repeats_after), (Regime::TwoSymmetric, Some(1)));
/// assert!((steady.peak - 0.475).abs() < 1e-3); // over the clearance
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`StartError`] where a start is outside the cavity or not finite.
pub fn motions(
    places: &[(System, Vec<State>)],
    effort: &Effort,
) -> Result<Vec<Vec<Motion>>, StartError> {
    let of = |(system, starts): &(System, Vec<State>)| {
        let system = *system;
        starts.clone().into_iter().map(move |start| (system, start))
    };
    let starts: Vec<(System, State)> = places.iter().flat_map(of).collect();
    let mut ended = long_term(&starts, effort)?.into_iter();
    let of = |(_, starts): &(_, Vec<_>)| {
        distinct(&ended.by_ref().take(starts.len()).collect::<Vec<_>>())
    };
    Ok(places.iter().map(of).collect())
}

/// The motion that each start of a system leads to, all of them side by side, each as if it were alone;
/// none where it could not be followed.
///
/// # Errors
/// [`StartError`] where a start is outside the cavity or not finite.
pub fn long_term(
    starts: &[(System, State)],
    effort: &Effort,
) -> Result<Vec<Option<Motion>>, StartError> {
    let mut all = Group::default();
    let mut motions: Vec<Option<Motion>> = vec![None; starts.len()];
    let mut transients: Vec<u64> = Vec::with_capacity(starts.len());
    for (index, (system, start)) in starts.iter().enumerate() {
        let simulation = Simulation::new(system, *start, 0.0)?;
        // Starts of one system follow each other.
        let before = index.checked_sub(1).filter(|before| starts[*before].0 == *system);
        transients
            .push(before.map_or_else(|| effort.left_out(system), |before| transients[before]));
        match transient::inactive(system, start) {
            Some(state) => motions[index] = Some(Motion::inactive(system, state, 0)),
            None => all.add(index, simulation),
        }
    }
    for round in 1..=ROUNDS {
        let mut again = Group::default();
        let effort = Effort { periods: effort.periods * round, ..*effort };
        for (one, motion) in measured(all, &transients, &effort) {
            let settling = |motion: Motion| one.stop == Stop::EndTime && motion.is_settling();
            motions[one.index] = motion;
            if round < ROUNDS && motion.is_some_and(settling) {
                again.add(one.index, one.simulation);
            } else {
                operation_count::note(one.simulation.operations());
            }
        }
        all = again;
    }
    Ok(motions)
}

/// Trajectories that go on together, and which starts they come from.
#[derive(Default)]
struct Group {
    indices: Vec<usize>,
    simulations: Vec<Simulation>,
}

/// A trajectory that has been measured.
struct Ended {
    index: usize,
    simulation: Simulation,
    stop: Stop,
}

impl Group {
    fn add(&mut self, index: usize, simulation: Simulation) {
        self.indices.push(index);
        self.simulations.push(simulation);
    }

    fn extents(&self, effort: &Effort, periods: impl Fn(usize, &System) -> u64) -> Vec<Extent> {
        let each = self.indices.iter().zip(&self.simulations);
        each.map(|(index, one)| effort.extent(one.system(), periods(*index, one.system())))
            .collect()
    }

    fn run<O: Observer>(&mut self, extents: &[Extent], observers: &mut [O]) -> Vec<Stop> {
        if self.simulations.len() > FEW {
            return batch::run_each(&mut self.simulations, extents, observers);
        }
        let each = self.simulations.iter_mut().zip(extents).zip(observers);
        each.map(|((one, far), observer)| one.run(far.periods, far.impacts, observer)).collect()
    }

    /// Goes on with its watches.
    fn watched(mut self, extents: &[Extent], mut watches: Vec<Watch>) -> Vec<(Ended, Watch)> {
        let mut told: Vec<_> = watches.iter_mut().map(|one| &mut one.observers).collect();
        let stops = self.run(extents, &mut told);
        let simulations = self.indices.into_iter().zip(self.simulations).zip(stops);
        let ended = |((index, simulation), stop)| Ended { index, simulation, stop };
        simulations.map(ended).zip(watches).collect()
    }

    /// Measures each over a window of so many periods, in stretches that grow: what has settled at the end of one
    /// needs no more.
    fn measured(mut self, mut windows: Vec<u64>, effort: &Effort) -> Vec<(Ended, Watch)> {
        let mut watches: Vec<Watch> = self.simulations.iter().map(Watch::begin).collect();
        let mut done = Vec::new();
        let mut stretch = 2 * WATCHED;
        while !self.indices.is_empty() {
            let each = self.simulations.iter().zip(&windows);
            let extents: Vec<Extent> =
                each.map(|(one, left)| effort.extent(one.system(), stretch.min(*left))).collect();
            let ended = self.watched(&extents, watches);
            (self, watches) = (Self::default(), Vec::new());
            let mut further = Vec::new();
            for ((one, mut watch), left) in ended.into_iter().zip(windows) {
                let settled = watch.repetition().is_some_and(Periodicity::has_settled);
                if left <= stretch || one.stop != Stop::EndTime || settled {
                    done.push((one, watch));
                } else {
                    self.add(one.index, one.simulation);
                    watches.push(watch);
                    further.push(left - stretch);
                }
            }
            windows = further;
            stretch *= 2;
        }
        done
    }
}

/// Leaves out a transient of so many periods for each start, watches its last periods, and measures what has
/// not repeated by then over a window, or until it repeats.
fn measured(mut all: Group, transients: &[u64], effort: &Effort) -> Vec<(Ended, Option<Motion>)> {
    let last = |system: &System| transient::window(system, WATCHED);
    let watched = all.extents(effort, |_, system| last(system));
    let faded = all.extents(effort, |index, system| transients[index].saturating_sub(last(system)));
    let mut nobody: Vec<()> = vec![(); all.simulations.len()];
    all.run(&faded, &mut nobody);
    let mut done = Vec::with_capacity(all.indices.len());
    let (mut going, mut windows) = (Group::default(), Vec::new());
    let each = all.simulations.iter().zip(&watched);
    let watches = each.map(|(one, far)| Watch::of_repetition(one, far.periods)).collect();
    for (one, mut watch) in all.watched(&watched, watches) {
        let simulation = &one.simulation;
        if let Some(state) = transient::inactive(simulation.system(), &simulation.state()) {
            let followed = simulation.periods();
            let motion = Motion::inactive(simulation.system(), state, followed);
            done.push((one, Some(motion)));
        } else if one.stop != Stop::ImpactLimit
            && (one.stop != Stop::EndTime || watch.repetition().is_some())
        {
            let motion = watch.motion(simulation, one.stop);
            done.push((one, motion));
        } else {
            // Without an impact yet a window holds some flights, but is no longer than the transient.
            let silent = watch.statistics().impacts() == 0;
            let flown = if silent { periods_of_flights(simulation) } else { 0 };
            let periods = match one.stop {
                // Many impacts are a regime already.
                Stop::ImpactLimit => WATCHED,
                _ => effort.periods.max(flown.min(transients[one.index])),
            };
            windows.push(transient::window(simulation.system(), periods));
            going.add(one.index, one.simulation);
        }
    }
    done.extend(going.measured(windows, effort).into_iter().map(|(one, mut watch)| {
        let motion = watch.motion(&one.simulation, one.stop);
        (one, motion)
    }));
    done
}

/// Excitation periods of [`FLIGHTS`] flights of an absorber from wall to wall.
fn periods_of_flights(simulation: &Simulation) -> u64 {
    let speed = simulation.state().y_velocity.abs();
    let duration = f64::from(FLIGHTS) * 2.0 / speed;
    if speed > 0.0 { (duration / simulation.system().period()) as u64 } else { 0 }
}
