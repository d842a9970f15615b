//! The motions that starts lead to in the long run, many trajectories side by side.
//!
//! A transient is left out by the rule of [`super::transient`]. A motion that is seen to repeat is measured over
//! one repetition, any other over a window.

mod watch;

use serde::Serialize;

use self::watch::{Repetition, Strobes, Watch};
use super::transient::{self, Transient};
use super::{Regime, periodicity, starts};
use crate::numerics::scatter::error_of_largest_of;
use crate::simulation::batch::{self, Extent};
use crate::simulation::{Simulation, StartError, Stop};
use crate::system::{State, System};

/// Relative difference of root mean squares up to which two motions that hardly scatter are one.
const ALIKE: f64 = 0.01;
/// Impacts in one stretch, per period asked for, at which a trajectory is given up.
const MOST_IMPACTS: u64 = 1000;

/// Periods at the end of those left out in which it is watched whether a motion repeats, which then is
/// measured over one repetition. One that is not seen to repeat by then is looked at once more after as
/// many periods measured, which repetitions that divide it fill whole.
const WATCHED: u64 = 48;
/// Flights of the absorber from wall to wall in a window in which it is slow: enough for extremes.
const FLIGHTS: u32 = 16;
/// Relative difference of peaks up to which a simulated motion is that of an exact orbit, and
/// difference of impacts per period: what is left of a transient, and of a window's largest peak.
const AS_EXACT: f64 = 0.01;
/// Impacts per excitation period of a symmetric 1:1 orbit.
const TWO: f64 = 2.0;

/// How often a transient is left out, the first time included, of a motion that is still settling; each
/// time the window after it is longer.
const ROUNDS: u64 = 3;

/// How thoroughly each place is simulated.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Effort {
    /// Starts at each place, as [`starts::of`] orders them.
    pub starts: u32,
    /// Excitation periods measured where a motion is not seen to repeat, after a transient that follows
    /// from the damping.
    pub periods: u64,
}

impl Default for Effort {
    fn default() -> Self {
        Self { starts: 8, periods: 250 }
    }
}

/// A long-term motion that was simulated. Lengths over the clearance, fast time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Motion {
    /// Largest absolute displacement of the oscillator that was seen.
    pub peak: f64,
    /// By how much a window ten times as long may exceed that, at odds of 19 to 1, from the largest values
    /// of blocks of the window; 0 for a motion that repeats.
    pub peak_error: f64,
    /// Root mean square displacement of the oscillator.
    pub rms: f64,
    /// Two standard errors of that, between blocks of the window.
    pub rms_error: f64,
    /// Impacts per excitation period.
    pub impacts_per_period: f64,
    /// Two standard errors of that.
    pub impacts_error: f64,
    /// Largest relative speed of an impact.
    pub impact_speed: f64,
    /// As `peak_error`.
    pub impact_speed_error: f64,
    /// Whether its transient is over: it repeats, or its averages do not drift.
    pub settled: bool,
    /// What its impacts do.
    pub regime: Regime,
    /// How many of the starts led to it.
    pub starts: u32,
    /// Share of the excitation's work that impacts dissipate; none where it does no work.
    #[serde(skip)]
    pub efficiency: Option<f64>,
    /// Excitation periods after which it repeats, if it was seen to.
    #[serde(skip)]
    pub repeats_after: Option<u32>,
    /// A state on it, at excitation phase 0.
    #[serde(skip)]
    pub state: State,
}

impl Motion {
    /// Whether the absorber takes no part: there is no impact.
    pub fn is_inactive(&self) -> bool {
        self.impacts_per_period == 0.0
    }

    /// Whether it is the symmetric 1:1 orbit with a peak that is known exactly.
    pub fn is_orbit_with_peak(&self, exact: f64) -> bool {
        (self.peak - exact).abs() <= AS_EXACT * exact
            && (self.impacts_per_period - TWO).abs() <= AS_EXACT
    }

    /// Whether it drifts, or is of a kind that repeats and was not seen to: an absorber that has come to rest, or was
    /// captured, only late, or that drifts from one wall to the other for longer than the window.
    fn is_settling(&self) -> bool {
        let repeating =
            matches!(self.regime, Regime::AtRest | Regime::TwoSymmetric | Regime::TwoAsymmetric);
        !self.settled || (repeating && self.repeats_after.is_none())
    }

    /// Whether two starts ended in one motion, as far as root mean square and impacts tell. The errors of a
    /// chaotic motion are so wide that it might else be any other: one that repeats, or is without impacts.
    fn is_same(&self, other: &Self) -> bool {
        let chaotic = self.repeats_after.is_none() && other.repeats_after.is_none();
        let near = |a: f64, b: f64, errors: f64| {
            (a - b).abs() <= (ALIKE * a.max(b)).max(if chaotic { 2.0 * errors } else { 0.0 })
        };
        self.is_inactive() == other.is_inactive()
            && near(self.rms, other.rms, self.rms_error + other.rms_error)
            && near(
                self.impacts_per_period,
                other.impacts_per_period,
                self.impacts_error + other.impacts_error,
            )
    }
}

/// The distinct motions of each system, in the order in which starts led to them; the first start is
/// that from rest.
///
/// # Errors
/// [`StartError`] where a start is not finite.
pub fn motions(systems: &[System], effort: &Effort) -> Result<Vec<Vec<Motion>>, StartError> {
    let of = |system: &System| {
        let system = *system;
        starts::of(&system, effort.starts).map(move |start| (system, start))
    };
    let starts: Vec<(System, State)> = systems.iter().flat_map(of).collect();
    let ended = long_term(&starts, effort.periods)?;
    Ok(ended.chunks(effort.starts.max(1) as usize).map(distinct).collect())
}

/// The motion that each start of a system leads to, all of them side by side, each as if it were alone;
/// none where it could not be followed. `periods` as in [`Effort`].
///
/// # Errors
/// [`StartError`] where a start is not finite.
pub fn long_term(
    starts: &[(System, State)],
    periods: u64,
) -> Result<Vec<Option<Motion>>, StartError> {
    let mut all = Group::default();
    let mut motions: Vec<Option<Motion>> = vec![None; starts.len()];
    let mut transients: Vec<Transient> = Vec::with_capacity(starts.len());
    for (index, (system, start)) in starts.iter().enumerate() {
        let simulation = Simulation::new(system, *start, 0.0)?;
        // Starts of one system follow each other.
        let before = index.checked_sub(1).filter(|before| starts[*before].0 == *system);
        transients.push(before.map_or_else(|| Transient::of(system), |before| transients[before]));
        match transient::inactive(system, start) {
            Some(state) => motions[index] = Some(Motion::inactive(system, state)),
            None => all.add(index, simulation),
        }
    }
    for round in 0..ROUNDS {
        let mut again = Group::default();
        for (one, motion) in measured_after_transient(all, &transients, periods * (1 + round)) {
            if motion.is_some_and(|motion| motion.is_settling()) {
                again.add(one.index, one.simulation);
            }
            motions[one.index] = motion;
        }
        all = again;
    }
    Ok(motions)
}

/// Leaves out a transient and measures what follows.
fn measured_after_transient(
    mut all: Group,
    transients: &[Transient],
    periods: u64,
) -> Vec<(Ended, Option<Motion>)> {
    let mut nobody: Vec<()> = vec![(); all.simulations.len()];
    let watched = all.extents(|_, system| transient::window(system, WATCHED));
    let faded = all.extents(|index, system| {
        transients[index].periods.saturating_sub(transient::window(system, WATCHED))
    });
    batch::run_each(&mut all.simulations, &faded, &mut nobody);
    let mut watches: Vec<Strobes> = all.simulations.iter().map(|_| Strobes::new()).collect();
    let stops = batch::run_each(&mut all.simulations, &watched, &mut watches);
    let (mut repeating, mut other) = (Group::default(), Group::default());
    let (mut known, mut ended) = (Vec::new(), Vec::with_capacity(all.indices.len()));
    let trajectories = all.indices.into_iter().zip(all.simulations);
    for (((index, one), watch), stop) in trajectories.zip(watches).zip(stops) {
        if let Some(state) = transient::inactive(one.system(), &one.state()) {
            let motion = Motion::inactive(one.system(), state);
            ended.push((Ended { index, simulation: one, stop }, Some(motion)));
            continue;
        }
        match periodicity::find(&watch.periods).filter(|_| stop == Stop::EndTime) {
            Some(found) => {
                known.push(Repetition::of(found, &watch.log, one.system()));
                repeating.add(index, one);
            }
            None => other.add(index, one),
        }
    }
    let once: Vec<Extent> = repeating
        .simulations
        .iter()
        .zip(&known)
        .map(|(one, known)| extent(one.system(), u64::from(known.found.periods)))
        .collect();
    let watches = repeating.watched();
    for ((one, watch), repetition) in repeating.step(watches, &once).into_iter().zip(known) {
        let motion = watch.motion(&one, Some(repetition));
        ended.push((one, motion));
    }
    for (one, watch) in measured(other, transients, periods) {
        let motion = watch.motion(&one, None);
        ended.push((one, motion));
    }
    ended
}

/// So many periods, or as many impacts as no motion worth looking at has in them.
fn extent(system: &System, periods: u64) -> Extent {
    // A slow excitation has many natural periods in each of its own.
    let natural = (1.0 / system.frequency_ratio()).max(1.0);
    Extent { periods, impacts: (periods as f64 * natural) as u64 * MOST_IMPACTS }
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

    fn extents(&self, periods: impl Fn(usize, &System) -> u64) -> Vec<Extent> {
        let each = self.indices.iter().zip(&self.simulations);
        each.map(|(index, one)| extent(one.system(), periods(*index, one.system()))).collect()
    }

    fn watched(&self) -> Vec<Watch> {
        self.simulations.iter().map(Watch::begin).collect()
    }

    fn step(mut self, mut watches: Vec<Watch>, extents: &[Extent]) -> Vec<(Ended, Watch)> {
        let stops = batch::run_each(&mut self.simulations, extents, &mut watches);
        let simulations = self.indices.into_iter().zip(self.simulations).zip(stops);
        let ended = |((index, simulation), stop)| Ended { index, simulation, stop };
        simulations.map(ended).zip(watches).collect()
    }
}

/// Measures trajectories that were not seen to repeat: those that then do over a short window, those
/// without an impact in it over some flights of the absorber, but no longer than a transient, the others
/// over `periods`.
fn measured(group: Group, transients: &[Transient], periods: u64) -> Vec<(Ended, Watch)> {
    let first = |system: &System| transient::window(system, periods.min(WATCHED));
    let (watches, short) = (group.watched(), group.extents(|_, system| first(system)));
    let (mut done, mut going, mut watches_on) = (Vec::new(), Group::default(), Vec::new());
    for (one, mut watch) in group.step(watches, &short) {
        let window = first(one.simulation.system());
        let repeats = periodicity::find(watch.impact_statistics.records())
            .is_some_and(|found| window.is_multiple_of(u64::from(found.periods)));
        if repeats || one.stop != Stop::EndTime || periods == window {
            done.push((one, watch));
        } else {
            going.add(one.index, one.simulation);
            watches_on.push(watch);
        }
    }
    let rest: Vec<Extent> = going
        .indices
        .iter()
        .zip(going.simulations.iter().zip(&watches_on))
        .map(|(index, (one, watch))| {
            let system = one.system();
            let flights = if watch.impact_statistics.impacts() == 0 { flights(one) } else { 0 };
            let longer = flights.min(transients[*index].periods);
            let wanted = transient::window(system, periods.max(longer));
            extent(system, wanted.saturating_sub(first(system)))
        })
        .collect();
    done.extend(going.step(watches_on, &rest));
    done
}

/// Excitation periods of [`FLIGHTS`] flights of an absorber from wall to wall.
fn flights(simulation: &Simulation) -> u64 {
    let speed = simulation.state().y_velocity.abs();
    let duration = f64::from(FLIGHTS) * 2.0 / speed;
    if speed > 0.0 { (duration / simulation.system().period()) as u64 } else { 0 }
}

/// The motions of one system that trajectories have ended in.
pub fn distinct(ended: &[Option<Motion>]) -> Vec<Motion> {
    let mut distinct: Vec<Motion> = Vec::new();
    for motion in ended.iter().flatten() {
        match distinct.iter_mut().find(|known| known.is_same(motion)) {
            Some(known) => known.join(motion),
            None => distinct.push(*motion),
        }
    }
    distinct
}

impl Motion {
    /// The motion without impacts, in closed form; `state` is on it.
    fn inactive(system: &System, state: State) -> Self {
        let peak = system.linear_response().map_or(0.0, |response| response.amplitude());
        Self {
            peak,
            peak_error: 0.0,
            rms: peak * std::f64::consts::FRAC_1_SQRT_2,
            rms_error: 0.0,
            impacts_per_period: 0.0,
            impacts_error: 0.0,
            impact_speed: 0.0,
            impact_speed_error: 0.0,
            settled: true,
            regime: Regime::AtRest,
            starts: 1,
            efficiency: (peak > 0.0).then_some(0.0),
            repeats_after: Some(1),
            state,
        }
    }

    /// Takes over another start's measurement of the same motion: the larger extremes, and errors
    /// of what has been seen from so many starts, by their mean scatter.
    fn join(&mut self, other: &Self) {
        self.peak = self.peak.max(other.peak);
        let starts = self.starts + other.starts;
        let joined = |a: f64, b: f64| {
            let sum = |error: f64, starts: u32| {
                let alone = error / error_of_largest_of(starts);
                f64::from(starts) * alone * alone
            };
            let mean = (sum(a, self.starts) + sum(b, other.starts)) / f64::from(starts);
            mean.sqrt() * error_of_largest_of(starts)
        };
        self.peak_error = joined(self.peak_error, other.peak_error);
        self.impact_speed_error = joined(self.impact_speed_error, other.impact_speed_error);
        self.impact_speed = self.impact_speed.max(other.impact_speed);
        self.settled |= other.settled;
        self.starts = starts;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A repeating motion of two impacts per period.
    fn motion() -> Motion {
        Motion {
            peak: 1.5,
            peak_error: 0.0,
            rms: 1.0,
            rms_error: 0.0,
            impacts_per_period: TWO,
            impacts_error: 0.0,
            impact_speed: 3.0,
            impact_speed_error: 0.0,
            settled: true,
            regime: Regime::TwoSymmetric,
            starts: 1,
            efficiency: None,
            repeats_after: Some(1),
            state: State::AT_REST,
        }
    }

    #[test]
    fn motions_that_repeat_are_one_within_a_percent() {
        let one = motion();
        for (rms, impacts_per_period, same) in [
            (1.009, 2.0, true),
            (1.02, 2.0, false),
            (0.98, 2.0, false),
            (1.0, 2.01, true),
            (1.0, 2.1, false),
        ] {
            let other = Motion { rms, impacts_per_period, ..one };
            assert_eq!(one.is_same(&other), same, "{rms} {impacts_per_period}");
            assert_eq!(other.is_same(&one), same, "{rms} {impacts_per_period}");
        }
    }

    /// Errors widen what is alike between motions that both scatter, and only there; and no impacts are
    /// never as good as few.
    #[test]
    fn a_motion_that_scatters_is_none_that_repeats() {
        let scattered = Motion {
            rms: 1.1,
            rms_error: 0.1,
            impacts_error: 0.3,
            repeats_after: None,
            ..motion()
        };
        assert!(!scattered.is_same(&motion()) && !motion().is_same(&scattered));
        // Twice the sum of both errors is 0.4.
        let like = |rms: f64| Motion { rms, ..scattered };
        assert!(scattered.is_same(&like(1.45)) && !scattered.is_same(&like(1.55)));
        let fewer = Motion { impacts_per_period: 1.0, ..scattered };
        assert!(scattered.is_same(&fewer), "within 1.2");
        let inactive = Motion { impacts_per_period: 0.0, impacts_error: 3.0, ..scattered };
        assert!(!scattered.is_same(&inactive));
    }

    #[test]
    fn what_starts_agree_on_has_the_larger_extremes() {
        let (smaller, larger) = (motion(), Motion { peak: 1.505, impact_speed: 3.01, ..motion() });
        let other = Motion { rms: 2.0, ..motion() };
        for pair in [[smaller, larger], [larger, smaller]] {
            let ended = [Some(pair[0]), None, Some(other), Some(pair[1])];
            let found = distinct(&ended);
            assert_eq!(found.len(), 2);
            let Motion { peak, impact_speed, starts, .. } = found[0];
            assert_eq!((peak, impact_speed, starts), (1.505, 3.01, 2));
        }
    }

    #[test]
    fn a_motion_of_a_repeating_kind_that_was_not_seen_to_repeat_is_settling() {
        for (regime, settling) in [
            (Regime::AtRest, true),
            (Regime::TwoSymmetric, true),
            (Regime::TwoAsymmetric, true),
            (Regime::StronglyModulated, false),
            (Regime::AboveTwo, false),
            (Regime::BelowTwo, false),
        ] {
            assert!(!Motion { regime, ..motion() }.is_settling());
            let restless = Motion { regime, repeats_after: None, ..motion() };
            assert_eq!(restless.is_settling(), settling, "{regime:?}");
        }
    }

    #[test]
    fn an_orbit_is_known_by_its_peak_and_by_two_impacts() {
        assert!(motion().is_orbit_with_peak(1.51) && !motion().is_orbit_with_peak(1.53));
        let more = Motion { impacts_per_period: 2.02, ..motion() };
        assert!(!more.is_orbit_with_peak(1.5));
    }
}
