//! What simulation finds along a band, from several starts at each place: many trajectories side by
//! side.

use serde::Serialize;

use super::{Band, Stretch, exact};
use crate::case::BandOver;
use crate::orbits::SymmetricOrbit;
use crate::regimes::starts::StartBox;
use crate::regimes::{Captures, Periodicity, Regime, Signs, Thresholds, periodicity};
use crate::simulation::batch::{self, Extent};
use crate::simulation::{
    Gauge, Impact, ImpactLog, Nobody, Observer, Segment, Simulation, StartError, Stop,
};
use crate::system::{State, System};

/// The start from rest: the absorber lies halfway between the middle of its cavity and a wall, as it does
/// on average if it may lie anywhere. Exactly in the middle the slightest push would wake it.
pub const FROM_REST: State = State { y: 0.5, ..State::AT_REST };
/// Even places of a band that are simulated, its ends among them.
pub const PLACES: u32 = 33;
/// How often it is looked closer around the place with the largest amplitude, and at how many places on
/// either side: the second time to a sixteenth of the distance of even ones.
const REFINEMENTS: u32 = 2;
const CLOSER: u32 = 3;

/// E-folds of the damped free motion that are left out: what a start leaves is then below 1e-5.
const FADED: f64 = 12.0;
/// Fewest and most periods left out: a motion needs some to be captured, and hardly damped ones fade
/// by impacts or not at all.
const LEFT_OUT: [f64; 2] = [150.0, 2000.0];
/// Relative difference of root mean squares up to which two motions that hardly scatter are one.
const ALIKE: f64 = 0.01;
/// Impacts in one stretch, per period asked for, at which a trajectory is given up.
const MOST_IMPACTS: u64 = 1000;

/// Periods at the end of those left out in which it is watched whether a motion repeats, which then is
/// measured over one repetition. One that is not seen to repeat by then is looked at once more after as
/// many periods measured, which repetitions that divide it fill whole.
const WATCHED: u64 = 48;
/// Relative difference of peaks up to which a simulated motion is that of an exact orbit, and
/// difference of impacts per period: what is left of a transient, and of a window's largest peak.
const AS_EXACT: f64 = 0.01;
/// Impacts per excitation period of a symmetric 1:1 orbit.
const TWO: f64 = 2.0;

/// How often a transient is left out, the first time included, of a motion that is still settling; each
/// time the window after it is longer.
const ROUNDS: u64 = 3;

/// Impacts that are kept to tell a regime by: their intervals are averaged.
const KEPT_IMPACTS: usize = 1000;

/// How thoroughly each place is simulated.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Effort {
    /// Starts at each place: one from rest, the absorber halfway to a wall, the others evenly spread.
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
    /// Largest absolute displacement of the oscillator.
    pub peak: f64,
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

/// A place of a band, and the motions that starts led to there.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Place {
    /// `Omega`, or the amplitude over the base system's.
    pub at: f64,
    /// In the order in which starts led to them.
    pub motions: Vec<Motion>,
}

impl Place {
    /// The motion with the largest amplitude.
    pub fn largest(&self) -> Option<&Motion> {
        self.motions.iter().max_by(|a, b| a.peak.total_cmp(&b.peak))
    }

    /// Whether the absorber stays asleep in one of the motions: from rest it is only woken by a wall that
    /// reaches it.
    pub fn sleeps(&self) -> bool {
        self.motions.iter().any(Motion::is_asleep)
    }

    /// Whether there are several motions with impacts.
    pub fn has_several(&self) -> bool {
        self.motions.iter().filter(|motion| !motion.is_asleep()).count() > 1
    }
}

impl Motion {
    /// Whether the absorber takes no part: there is no impact.
    pub fn is_asleep(&self) -> bool {
        self.impacts_per_period == 0.0
    }

    /// Whether it is the motion of an exact orbit.
    pub fn is(&self, orbit: &SymmetricOrbit) -> bool {
        let exact = orbit.peaks.displacement;
        (self.peak - exact).abs() <= AS_EXACT * exact
            && (self.impacts_per_period - TWO).abs() <= AS_EXACT
    }

    /// Whether it is of a kind that repeats, and was not seen to: an absorber that has come to rest, or was
    /// captured, only late, or that drifts from one wall to the other for longer than the window.
    fn is_settling(&self) -> bool {
        let repeating =
            matches!(self.regime, Regime::AtRest | Regime::TwoSymmetric | Regime::TwoAsymmetric);
        repeating && self.repeats_after.is_none()
    }

    /// Whether two starts ended in one motion, as far as root mean square and impacts tell. The errors of a
    /// chaotic motion are so wide that it might else be any other: one that repeats, or is without impacts.
    fn is_same(&self, other: &Self) -> bool {
        let chaotic = self.repeats_after.is_none() && other.repeats_after.is_none();
        let near = |a: f64, b: f64, errors: f64| {
            (a - b).abs() <= (ALIKE * a.max(b)).max(if chaotic { 2.0 * errors } else { 0.0 })
        };
        self.is_asleep() == other.is_asleep()
            && near(self.rms, other.rms, self.rms_error + other.rms_error)
            && near(
                self.impacts_per_period,
                other.impacts_per_period,
                self.impacts_error + other.impacts_error,
            )
    }
}

/// Measures one trajectory.
struct Watch {
    gauge: Gauge,
    log: ImpactLog,
    fastest: f64,
}

impl Observer for Watch {
    fn flights(&self) -> bool {
        self.gauge.flights()
    }
    fn segment(&mut self, segment: &Segment) {
        self.gauge.segment(segment);
    }
    fn impact(&mut self, impact: &Impact) {
        let speed = (impact.x_velocity_before - impact.y_velocity_before).abs();
        self.fastest = self.fastest.max(speed);
        self.log.impact(impact);
        self.gauge.impact(impact);
    }
    fn sticks(&mut self, loss: f64) {
        self.gauge.sticks(loss);
    }
    fn period(&mut self, state: &State) {
        self.gauge.period(state);
    }
}

/// The motions along a band: at even places, in the middle of each stretch without an attracting
/// symmetric orbit, which may lie between two of them, at the resonances, whose peaks may, and closer
/// around the place with the largest amplitude.
///
/// # Errors
/// [`StartError`] where a start is not finite.
pub fn along(
    band: &Band,
    stability: &[Stretch<bool>],
    effort: &Effort,
) -> Result<Vec<Place>, StartError> {
    let mut places: Vec<f64> = band.places(PLACES).collect();
    places.extend(exact::unstable_middles(stability));
    places.extend(resonances(band));
    let mut found = simulated_at(band, places, effort)?;
    for _ in 0..REFINEMENTS {
        let closer = around_largest(&found);
        found.extend(simulated_at(band, closer, effort)?);
        found.sort_by(|a, b| a.at.total_cmp(&b.at));
    }
    Ok(found)
}

/// The places of a band at which the oscillator alone, or with the absorber's mass on it, resonates.
fn resonances(band: &Band) -> impl Iterator<Item = f64> {
    let [from, to] = band.range;
    let carrying = 1.0 / (1.0 + band.base.mass_ratio()).sqrt();
    let over_frequency = band.over == BandOver::Frequency;
    [1.0, carrying].into_iter().filter(move |at| over_frequency && from < *at && *at < to)
}

/// Places on both sides of the one with the largest amplitude, up to its neighbours.
fn around_largest(found: &[Place]) -> Vec<f64> {
    let largest = |place: &Place| place.largest().map_or(0.0, |motion| motion.peak);
    let of = (0..found.len()).max_by(|a, b| largest(&found[*a]).total_cmp(&largest(&found[*b])));
    let Some(middle) = of else { return Vec::new() };
    let neighbours = [middle.checked_sub(1), Some(middle + 1)];
    let sides = neighbours.into_iter().flatten().filter_map(|side| found.get(side));
    let parts = (1..=CLOSER).map(|k| f64::from(k) / f64::from(CLOSER + 1));
    let at = found[middle].at;
    sides.flat_map(|side| parts.clone().map(move |part| at + (side.at - at) * part)).collect()
}

/// The motions at places, in ascending order, each once.
fn simulated_at(
    band: &Band,
    mut places: Vec<f64>,
    effort: &Effort,
) -> Result<Vec<Place>, StartError> {
    places.sort_by(f64::total_cmp);
    places.dedup();
    let there = |at: f64| Some((at, band.system(at).ok()?));
    let (places, systems): (Vec<f64>, Vec<System>) = places.into_iter().filter_map(there).unzip();
    let found = places.into_iter().zip(motions(&systems, effort)?);
    Ok(found.map(|(at, motions)| Place { at, motions }).collect())
}

/// The distinct motions of each system, in the order in which starts led to them; the first start is
/// that from rest.
///
/// # Errors
/// [`StartError`] where a start is not finite.
pub fn motions(systems: &[System], effort: &Effort) -> Result<Vec<Vec<Motion>>, StartError> {
    let mut starts = Vec::with_capacity(systems.len() * effort.starts as usize);
    for system in systems {
        let sample = StartBox::around(system);
        let others = (1..effort.starts).map(|index| sample.start(index - 1));
        starts.extend([FROM_REST].into_iter().chain(others).map(|start| (*system, start)));
    }
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
    for (index, (system, start)) in starts.iter().enumerate() {
        all.add(index, Simulation::new(system, *start, 0.0)?);
    }
    let mut motions: Vec<Option<Motion>> = vec![None; starts.len()];
    for round in 0..ROUNDS {
        let mut again = Group::default();
        for (one, motion) in measured_after_transient(all, periods * (1 + round)) {
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
fn measured_after_transient(mut all: Group, periods: u64) -> Vec<(Ended, Option<Motion>)> {
    let mut nobody: Vec<Nobody> = all.simulations.iter().map(|_| Nobody).collect();
    let faded = |one: &Simulation| extent(left_out(one.system()) - WATCHED);
    let transients: Vec<Extent> = all.simulations.iter().map(faded).collect();
    batch::run_each(&mut all.simulations, &transients, &mut nobody);
    let mut watches: Vec<Strobes> = all.simulations.iter().map(|_| Strobes::new()).collect();
    let watched = extent(WATCHED);
    let stops = batch::run(&mut all.simulations, watched.periods, watched.impacts, &mut watches);
    let (mut repeating, mut other) = (Group::default(), Group::default());
    let mut known = Vec::new();
    let trajectories = all.indices.into_iter().zip(all.simulations);
    for (((index, one), watch), stop) in trajectories.zip(watches).zip(stops) {
        match periodicity::find(&watch.periods).filter(|_| stop == Stop::EndTime) {
            Some(found) => {
                known.push(Repetition::of(found, &watch.log, one.system()));
                repeating.add(index, one);
            }
            None => other.add(index, one),
        }
    }
    let once: Vec<Extent> = known.iter().map(|one| extent(u64::from(one.found.periods))).collect();
    let watches = repeating.watched();
    let mut ended = Vec::with_capacity(repeating.indices.len() + other.indices.len());
    for ((one, watch), repetition) in repeating.go_on(watches, &once).into_iter().zip(known) {
        let motion = watch.motion(&one, Some(repetition));
        ended.push((one, motion));
    }
    for (one, watch) in measured(other, periods) {
        let motion = watch.motion(&one, None);
        ended.push((one, motion));
    }
    ended
}

/// So many periods, or as many impacts as no motion worth looking at has in them.
fn extent(periods: u64) -> Extent {
    Extent { periods, impacts: periods * MOST_IMPACTS }
}

/// Watches whether a trajectory repeats, which costs next to nothing.
struct Strobes {
    periods: Vec<Strobe>,
    log: ImpactLog,
    impacts: u32,
}

/// An excitation period, seen at its end.
struct Strobe {
    end: State,
    impacts: u32,
}

impl periodicity::Strobed for Strobe {
    fn end(&self) -> &State {
        &self.end
    }
    fn impacts(&self) -> u32 {
        self.impacts
    }
}

impl Strobes {
    fn new() -> Self {
        Self {
            periods: Vec::with_capacity(WATCHED as usize),
            log: ImpactLog::of_the_last(KEPT_IMPACTS),
            impacts: 0,
        }
    }
}

impl Observer for Strobes {
    const SEGMENTS: bool = false;
    fn impact(&mut self, impact: &Impact) {
        self.impacts += 1;
        self.log.impact(impact);
    }
    fn period(&mut self, state: &State) {
        let impacts = std::mem::take(&mut self.impacts);
        self.periods.push(Strobe { end: *state, impacts });
    }
}

/// What is known of a motion that repeats before it is measured.
struct Repetition {
    found: Periodicity,
    asymmetry: f64,
}

impl Repetition {
    fn of(found: Periodicity, log: &ImpactLog, system: &System) -> Self {
        Self { found, asymmetry: periodicity::asymmetry(&log.impacts, system.period()) }
    }
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

    fn watched(&self) -> Vec<Watch> {
        self.simulations.iter().map(Watch::begin).collect()
    }

    fn go_on(mut self, mut watches: Vec<Watch>, extents: &[Extent]) -> Vec<(Ended, Watch)> {
        let stops = batch::run_each(&mut self.simulations, extents, &mut watches);
        let simulations = self.indices.into_iter().zip(self.simulations).zip(stops);
        let ended = |((index, simulation), stop)| Ended { index, simulation, stop };
        simulations.map(ended).zip(watches).collect()
    }
}

/// Measures trajectories that were not seen to repeat: those that then do over a short window, the
/// others over `periods`.
fn measured(group: Group, periods: u64) -> Vec<(Ended, Watch)> {
    let first = periods.min(WATCHED);
    let (watches, count) = (group.watched(), group.simulations.len());
    let (mut done, mut going, mut watches_on) = (Vec::new(), Group::default(), Vec::new());
    for (one, mut watch) in group.go_on(watches, &vec![extent(first); count]) {
        let repeats = periodicity::find(watch.gauge.records())
            .is_some_and(|found| WATCHED.is_multiple_of(u64::from(found.periods)));
        if repeats || one.stop != Stop::EndTime || periods == first {
            done.push((one, watch));
        } else {
            going.add(one.index, one.simulation);
            watches_on.push(watch);
        }
    }
    let rest = vec![extent(periods - first); watches_on.len()];
    done.extend(going.go_on(watches_on, &rest));
    done
}

impl Watch {
    fn begin(simulation: &Simulation) -> Self {
        Self {
            gauge: Gauge::begin(simulation.system(), simulation.state()),
            log: ImpactLog::of_the_last(KEPT_IMPACTS),
            fastest: 0.0,
        }
    }

    /// The motion measured; none where the trajectory came to a bad end.
    fn motion(mut self, ended: &Ended, repetition: Option<Repetition>) -> Option<Motion> {
        let Ended { simulation, stop, .. } = ended;
        if !matches!(stop, Stop::EndTime | Stop::ImpactLimit) {
            return None;
        }
        let gauge = &mut self.gauge;
        let thresholds = Thresholds::default();
        let period = simulation.system().period();
        let (signs, errors, repeats_after) = match repetition {
            Some(Repetition { found, asymmetry }) => {
                let signs = Signs {
                    impacts_per_period: gauge.impacts_per_period(),
                    visits_per_period: gauge.visits_per_period(),
                    repeats: true,
                    asymmetry,
                    captures: Captures::default(),
                    modulation_depth: 0.0,
                };
                (signs, [0.0; 2], Some(found.periods))
            }
            None => {
                let found = periodicity::find(gauge.records());
                let signs = Signs::measured(gauge, &self.log.impacts, period, &thresholds);
                (signs, gauge.errors(), found.map(|found| found.periods))
            }
        };
        Some(Motion {
            peak: gauge.peak(),
            rms: gauge.rms(),
            rms_error: errors[0],
            impacts_per_period: gauge.impacts_per_period(),
            impacts_error: errors[1],
            impact_speed: self.fastest,
            regime: signs.regime(&thresholds),
            starts: 1,
            efficiency: gauge.efficiency(),
            repeats_after,
            state: simulation.state(),
        })
    }
}

/// Periods after which what a start leaves has faded.
pub fn left_out(system: &System) -> u64 {
    let decay = 0.5 * system.mass_ratio() * system.damping() * system.period();
    (FADED / decay).clamp(LEFT_OUT[0], LEFT_OUT[1]) as u64
}

/// The motions of one system that trajectories have ended in.
fn distinct(ended: &[Option<Motion>]) -> Vec<Motion> {
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
    /// Takes over another start's measurement of the same motion: the larger extremes.
    fn join(&mut self, other: &Self) {
        self.peak = self.peak.max(other.peak);
        self.impact_speed = self.impact_speed.max(other.impact_speed);
        self.starts += other.starts;
    }
}
