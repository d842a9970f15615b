//! A long-term motion of a structure of several modes with several absorbers, and when two are one.

use std::sync::OnceLock;

use serde::Serialize;

use super::sensed::Sensed;
use crate::motions::cluster::{ERRORS, NO_DIFFERENCE};
use crate::motions::{WhyNot, listed};
use crate::numerics::scatter::{LONGER, error_of_largest, error_of_root, twice_error_of_mean};
use crate::regimes::{ModalRecords, ModalRegimes, Regime};
use crate::simulation::{ModalObserver, ModalSimulation, ModalTrace, Reading, SensorRecord, Stop};
use crate::system::{MOST_MODES, ModalState};

/// What a sensor reads in a long-term motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SensorExtent {
    /// What it reads.
    pub reads: Reading,
    /// The largest without its sign that was seen.
    pub peak: f64,
    /// By how much a run ten times as long may exceed it, at odds of 19 to 1; 0 of what repeats.
    pub error: f64,
    /// Root mean square, and twice its standard error by the scatter between blocks.
    pub rms: [f64; 2],
}

/// A state on a motion, and the structure.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SeenFrom {
    /// Without absorbers that rest.
    model: Sensed,
    state: ModalState,
    most_impacts: u64,
    /// Those, each by its place in the list that the ones before make.
    at_rest: Vec<usize>,
}

impl SeenFrom {
    /// Flies it again over so many periods; none where it cannot be followed for so long.
    fn flown(&self, periods: u64, observer: &mut dyn ModalObserver) -> Option<()> {
        let mut simulation = ModalSimulation::new(self.model.system(), &self.state, 0.0).ok()?;
        let most = periods.saturating_mul(self.most_impacts);
        (simulation.run(periods, most, observer) == Stop::EndTime).then_some(())
    }

    fn regimes(&self, motion: &ModalMotion) -> Option<ModalRegimes> {
        let mut records = ModalRecords::new(self.model.system());
        let periods = match motion.repeats_after {
            Some(after) => u64::from(after * REPETITIONS),
            None => WINDOW.max(motion.periods / PART),
        };
        self.flown(periods, &mut records)?;
        let mut regimes = records.found(motion.repeats_after);
        self.at_rest.iter().for_each(|j| regimes.insert_at_rest(*j));
        // One that impacts so seldom that it did not while it was watched does not rest.
        let impacts = motion.impacts_per_period.iter().zip(&motion.resting);
        for (regime, (impacts, resting)) in regimes.regimes.iter_mut().zip(impacts) {
            if *regime == Regime::AtRest && resting.is_none() && impacts[0] > 0.0 {
                *regime = Regime::BelowTwo;
            }
        }
        Some(regimes)
    }

    fn trace(
        &self,
        motion: &ModalMotion,
        periods: u64,
        samples_per_period: f64,
    ) -> Option<ModalTrace> {
        let sensors = self.model.sensors();
        let displaced = motion.sensors.iter().zip(sensors);
        let displaced = displaced.filter(|(extent, _)| extent.reads == Reading::Displacement);
        let places = displaced.map(|(_, sensor)| sensor.shape.clone());
        // Behind what was asked for stands the displacement at each absorber, those that rest among them.
        let at_absorbers = sensors.iter().skip(motion.sensors.len());
        let shapes: Vec<_> = places.chain(at_absorbers.map(|one| one.shape.clone())).collect();
        let mut trace = ModalTrace::new(self.model.system(), &shapes, samples_per_period);
        self.flown(periods, &mut trace)?;
        let at_absorbers = trace.places.split_off(shapes.len() - motion.resting.len());
        for j in &self.at_rest {
            trace.gaps.insert(*j, at_absorbers[*j].clone());
            let behind = trace.impacts.iter_mut().filter(|one| one.absorber >= *j);
            behind.for_each(|one| one.absorber += 1);
        }
        Some(trace)
    }
}

/// A long-term motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModalMotion {
    /// What each sensor reads.
    pub sensors: Vec<SensorExtent>,
    /// Impacts of each absorber per excitation period, and twice their standard error.
    pub impacts_per_period: Vec<[f64; 2]>,
    /// Largest relative speed of an impact of each absorber, in lengths of the structure and fast time, and by how much a run ten
    /// times as long may exceed it, at odds of 19 to 1; 0 of one without impacts.
    pub impact_speed: Vec<[f64; 2]>,
    /// Excitation periods after which it repeats; none where that was not seen.
    pub repeats_after: Option<u32>,
    /// Whether it has settled: it repeats, or the slowest mode has died out and no mean square drifts.
    pub settled: bool,
    /// Largest Floquet multiplier of an excitation period, where it was solved for.
    pub largest_multiplier: Option<f64>,
    /// Whether it is an exact orbit; one in which an absorber rests on a wall, or with more than 64 impacts, is solved for on the
    /// simulated map.
    pub is_orbit: bool,
    /// Starts that led to it; none of an orbit that attracts all the same, or in which absorbers rest.
    pub starts: u32,
    /// Of each absorber that rests in it the share of its cavity within which it may; none of one that impacts.
    pub resting: Vec<Option<f64>>,
    /// Of every absorber at rest the share of their places, together, in which they stay where the excitation begins at once; none of
    /// another motion, and where a search only ranks designs.
    pub sudden: Option<f64>,
    /// Excitation periods until the last start had come to it; of one that still settles those that it was followed.
    pub followed: u64,
    /// A state on it at excitation phase 0; none at rest, and where an absorber rests.
    #[serde(skip)]
    pub state: Option<ModalState>,
    /// From where on it is seen what its absorbers do, and what that is once somebody asked.
    #[serde(skip)]
    pub(super) seen_from: Option<SeenFrom>,
    #[serde(skip)]
    pub(super) regimes: OnceLock<Option<ModalRegimes>>,
    /// Excitation periods of a case's window: largest values are spoken of for ten times as long.
    #[serde(skip)]
    pub(super) periods: u64,
    /// What was seen of it from each start.
    #[serde(skip)]
    pub(super) flights: Vec<FlightCourse>,
}

/// What a flight came to in each of its stretches: the largest that each sensor reads, its mean square, and impacts in a period
/// of each absorber with the largest of their speeds.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::motions) struct FlightCourse {
    /// Excitation periods of all of them.
    pub periods: u64,
    pub peaks: Vec<Vec<f64>>,
    pub squares: Vec<Vec<f64>>,
    pub impacts: Vec<Vec<f64>>,
    speeds: Vec<Vec<f64>>,
}

impl FlightCourse {
    /// Of so many sensors and absorbers, without a stretch.
    pub fn new(sensors: usize, absorbers: usize) -> Self {
        let [read, hit] = [sensors, absorbers].map(|count| vec![Vec::new(); count]);
        Self { periods: 0, peaks: read.clone(), squares: read, impacts: hit.clone(), speeds: hit }
    }

    /// Adds a stretch of so many periods, with the impacts of each absorber in it.
    pub fn add(
        &mut self,
        periods: u64,
        read: &[SensorRecord],
        impacts: &[u64; MOST_MODES],
        speeds: &[f64; MOST_MODES],
    ) {
        self.periods += periods;
        for (n, record) in read.iter().enumerate() {
            self.peaks[n].push(record.peak);
            self.squares[n].push(record.mean_square);
        }
        for (j, of) in self.impacts.iter_mut().enumerate() {
            of.push(impacts[j] as f64 / periods as f64);
            self.speeds[j].push(speeds[j]);
        }
    }

    /// Whether no absorber impacts in it.
    pub fn is_silent(&self) -> bool {
        self.impacts.iter().flatten().all(|count| *count == 0.0)
    }
}

/// Periods in which it is seen what absorbers do: of what repeats so many repetitions, as two impacts more than one has say how far
/// intervals differ; else at least so many, which strongly modulated responses need to be captured and to escape some times, or a part
/// of the window.
const REPETITIONS: u32 = 3;
const WINDOW: u64 = 512;
const PART: u64 = 4;
/// Relative difference up to which peaks, root mean squares and impacts of two motions that repeat are the same.
const SAME_REPEATING: f64 = 1e-6;

impl ModalMotion {
    /// From what was seen of it by sensors, in a case with a window of so many periods.
    pub(super) fn of(
        reads: &[Reading],
        flights: Vec<FlightCourse>,
        repeats_after: Option<u32>,
        settled: bool,
        periods: u64,
    ) -> Self {
        let absorbers = flights[0].impacts.len();
        let unknown =
            |reads: &Reading| SensorExtent { reads: *reads, peak: 0.0, error: 0.0, rms: [0.0; 2] };
        let mut found = Self {
            sensors: reads.iter().map(unknown).collect(),
            impacts_per_period: vec![[0.0; 2]; absorbers],
            impact_speed: vec![[0.0; 2]; absorbers],
            repeats_after,
            settled,
            largest_multiplier: None,
            is_orbit: false,
            starts: 0,
            resting: vec![None; absorbers],
            seen_from: None,
            regimes: OnceLock::new(),
            sudden: None,
            followed: 0,
            state: None,
            periods,
            flights,
        };
        found.measure();
        found
    }

    /// The same where so much of each number is left open.
    pub(super) fn within(mut self, part: f64) -> Self {
        for sensor in &mut self.sensors {
            sensor.error = part * sensor.peak;
            sensor.rms[1] = part * sensor.rms[0];
        }
        self.impact_speed.iter_mut().for_each(|speed| speed[1] = part * speed[0]);
        self
    }

    /// Forgets what all but so many sensors read.
    pub(super) fn read_by_first(&mut self, count: usize) {
        self.sensors.truncate(count);
        for flight in &mut self.flights {
            flight.peaks.truncate(count);
            flight.squares.truncate(count);
        }
    }

    /// Adds an absorber that has no impact, at a place in their list.
    pub(super) fn insert_at_rest(&mut self, j: usize) {
        self.impacts_per_period.insert(j, [0.0; 2]);
        self.impact_speed.insert(j, [0.0; 2]);
        if let Some(from) = &mut self.seen_from {
            from.at_rest.push(j);
        }
        for flight in &mut self.flights {
            let stretches = flight.squares.first().map_or(0, Vec::len);
            flight.impacts.insert(j, vec![0.0; stretches]);
            flight.speeds.insert(j, vec![0.0; stretches]);
        }
    }

    /// The same of this structure, with at most so many impacts in a period: what its absorbers do can be seen from its own state on.
    pub(super) fn of_structure(self, model: &Sensed, most_impacts: u64) -> Self {
        let (model, at_rest) = (model.clone(), Vec::new());
        let from = |state| SeenFrom { model, state, most_impacts, at_rest };
        Self { seen_from: self.state.map(from), ..self }
    }

    /// Sees what its absorbers do, once; nothing where a search only ranks designs.
    pub fn observe(&self) {
        self.regimes.get_or_init(|| self.seen_from.as_ref()?.regimes(self));
    }

    /// The motion itself over so many excitation periods from phase 0 on, flown once more: with so many samples in a period, or with its
    /// impacts alone where that is 0. An absorber that rests in it stands at one of its places. None where every absorber rests,
    /// where a search only ranks designs, and where the motion has more impacts than can be followed.
    pub fn trace(&self, periods: u64, samples_per_period: f64) -> Option<ModalTrace> {
        self.seen_from.as_ref()?.trace(self, periods, samples_per_period)
    }

    /// What its absorbers do in words, and where its energy goes; none where nobody has [observed](Self::observe) it.
    pub fn regimes(&self) -> Option<&ModalRegimes> {
        self.regimes.get()?.as_ref()
    }

    /// Its numbers by all that was seen of it.
    fn measure(&mut self) {
        let Self { sensors, impacts_per_period, impact_speed, flights, .. } = self;
        let seen = flights.iter().map(|one| one.periods).sum::<u64>().max(1);
        let longer = LONGER * self.periods as f64 / seen as f64;
        let known = |windows: &[&[f64]]| {
            let all = windows.concat();
            let mean = all.iter().sum::<f64>() / all.len() as f64;
            [mean, if all.len() > 1 { twice_error_of_mean(windows) } else { 0.0 }]
        };
        let largest = |windows: &[&[f64]]| {
            let most = windows.iter().copied().flatten().copied().fold(0.0, f64::max);
            [most, error_of_largest(windows, longer)]
        };
        for (n, sensor) in sensors.iter_mut().enumerate() {
            let peaks: Vec<&[f64]> = flights.iter().map(|one| one.peaks[n].as_slice()).collect();
            let squares: Vec<&[f64]> =
                flights.iter().map(|one| one.squares[n].as_slice()).collect();
            let [square, error] = known(&squares);
            let rms = square.sqrt();
            [sensor.peak, sensor.error] = largest(&peaks);
            sensor.rms = [rms, error_of_root(rms, error)];
        }
        for (j, impacts) in impacts_per_period.iter_mut().enumerate() {
            let counts: Vec<&[f64]> = flights.iter().map(|one| one.impacts[j].as_slice()).collect();
            let speeds: Vec<&[f64]> = flights.iter().map(|one| one.speeds[j].as_slice()).collect();
            *impacts = known(&counts);
            impact_speed[j] = largest(&speeds);
        }
    }

    /// Whether no absorber impacts.
    pub fn rests(&self) -> bool {
        self.impacts_per_period.iter().all(|[count, _]| *count == 0.0)
    }

    /// The share of the resting places of all absorbers that rest in it, together; none where none does.
    pub fn rest_share(&self) -> Option<f64> {
        self.resting.iter().flatten().copied().reduce(|all, share| all * share)
    }

    /// Why it does not count; none of one that may be met: a start led to it, or absorbers that rest do so in a share of their places
    /// that is not negligible.
    pub fn why_not(&self, count_rest: bool) -> Option<WhyNot> {
        WhyNot::of(self.rest_share(), self.starts, count_rest)
    }

    /// Whether it is one that may be met.
    pub fn counts(&self, count_rest: bool) -> bool {
        self.why_not(count_rest).is_none()
    }

    /// Its share of so many starts, or of the resting places of absorbers that rest in it.
    pub fn share(&self, of_starts: u32) -> f64 {
        self.rest_share().unwrap_or_else(|| listed::share_of_starts(self.starts, of_starts))
    }

    /// Puts motions of one place in the order of lists: by their shares, then by the largest displacement of any place.
    pub fn sort(motions: &mut [Self]) {
        let of_starts = motions.iter().map(|one| one.starts).sum();
        let largest = |one: &Self| {
            one.read(Reading::Displacement).map(|extent| extent.peak).fold(0.0, f64::max)
        };
        let order = |one: &Self| (one.share(of_starts), largest(one));
        motions.sort_by(|a, b| listed::order(order(a), order(b)));
    }

    /// The one of some that stands for them: the moving one that most starts lead to, else that at rest, else the first.
    pub fn main(motions: &[Self]) -> Option<&Self> {
        motions.get(listed::main(motions)?)
    }

    /// What it is, as results name it.
    pub fn kind_name(&self) -> &'static str {
        match () {
            () if self.rests() => "rest",
            () if self.is_orbit => "orbit",
            () if self.repeats_after.is_some() => "repeats",
            () => "wanders",
        }
    }

    /// What its absorbers do, as the worst word for them; none where nobody has [observed](Self::observe) it.
    pub fn regime(&self) -> Option<Regime> {
        Regime::worst(self.regimes()?.regimes.iter().copied())
    }

    /// What sensors of a kind read, in their order.
    pub fn read(&self, reads: Reading) -> impl Iterator<Item = &SensorExtent> {
        self.sensors.iter().filter(move |one| one.reads == reads)
    }

    /// Whether it is another flight of the same motion, by its displacements, whatever else is read: what wanders as with one mode.
    pub fn is_same(&self, other: &Self) -> bool {
        let repeats = self.repeats_after.is_some();
        let near = |[a, of_a]: [f64; 2], [b, of_b]: [f64; 2]| {
            (a - b).abs()
                <= match repeats {
                    true => SAME_REPEATING * a.max(b) + of_a + of_b,
                    false => (ERRORS * (of_a + of_b)).max(NO_DIFFERENCE * a.max(b)),
                }
        };
        let peaks =
            |a: &SensorExtent, b: &SensorExtent| !repeats || near([a.peak, 0.0], [b.peak, 0.0]);
        let displaced =
            |one: &'_ Self| one.read(Reading::Displacement).copied().collect::<Vec<_>>();
        let (own, of) = (displaced(self), displaced(other));
        let impacts = self.impacts_per_period.iter().zip(&other.impacts_per_period);
        repeats == other.repeats_after.is_some()
            && own.iter().zip(&of).all(|(a, b)| peaks(a, b) && near(a.rms, b.rms))
            && impacts.into_iter().all(|(a, b)| near(*a, *b))
    }
}
