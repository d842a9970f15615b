//! Long-term motions of a structure of several modes with several absorbers at one excitation.
//!
//! Exact orbits that attract are solved for. Each start is flown until its states at the ends of periods are those of such an
//! orbit, or nearly repeat: Newton's method then solves for the periodic motion ([`ModalCycle`]), which counts if it attracts.
//! Where an absorber rests on a wall, or there are more impacts than that covers, they must repeat. Where they do not, what it
//! does is measured in blocks once the slowest mode has died out.
//!
//! An absorber that rests where no wall reaches it has no part in the motion of the others: such motions are those of the
//! structure without it, as a force that grows slowly leaves them. It may rest within `b - X` of the middle, `X` being the
//! largest displacement of the structure there: in the share `1 - X/b` of its cavity, and several in the product of their
//! shares.

use serde::Serialize;

use super::NEGLIGIBLE;
use super::starts::position;
use crate::linear::ModalAmplitudes;
use crate::numerics::scatter::{
    LONGER, drifts, error_of_largest, error_of_root, twice_error_of_mean,
};
use crate::orbits::{
    CycleImpact, ModalCycle, ModalPeriodicOrbit, antiperiodic_orbits, orbit_state,
};
use crate::simulation::{
    Detail, ModalImpact, ModalMeter, ModalObserver, ModalSimulation, ModalStartError, Reading,
    Sensor, SensorRecord, Side, Stop,
};
use crate::system::{MOST_MODES, ModalAbsorber, ModalState, ModalSystem};

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

/// A long-term motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModalMotion {
    /// What each sensor reads.
    pub sensors: Vec<SensorExtent>,
    /// Impacts of each absorber per excitation period, and twice their standard error.
    pub impacts_per_period: Vec<[f64; 2]>,
    /// Excitation periods after which it repeats; none where that was not seen.
    pub repeats_after: Option<u32>,
    /// Whether it has settled: it repeats, or the slowest mode has died out and no mean square drifts.
    pub settled: bool,
    /// Largest Floquet multiplier of an excitation period, where it was solved for: an exact orbit.
    pub largest_multiplier: Option<f64>,
    /// Starts that led to it; none of an orbit that attracts all the same, or in which absorbers rest.
    pub starts: u32,
    /// Of each absorber that rests in it the share of its cavity within which it may; none of one that impacts.
    pub resting: Vec<Option<f64>>,
    /// Excitation periods of a case's window: largest values are spoken of for ten times as long.
    #[serde(skip)]
    periods: u64,
    /// What was seen of it from each start.
    #[serde(skip)]
    flights: Vec<FlightCourse>,
}

/// What a flight came to in each of its stretches: the largest that each sensor reads, its mean square, and impacts in a period
/// of each absorber.
#[derive(Debug, Clone, PartialEq)]
struct FlightCourse {
    /// Excitation periods of all of them.
    periods: u64,
    peaks: Vec<Vec<f64>>,
    squares: Vec<Vec<f64>>,
    impacts: Vec<Vec<f64>>,
}

/// Times in which the slowest mode decays to `1/e` that are left out before a motion that does not repeat is measured, and fewest
/// and most excitation periods of such a time.
const DECAYS: u32 = 8;
const QUICKEST: f64 = 32.0;
const LONGEST: f64 = 8192.0;
/// Blocks that it is measured for then, as parts of that time, and their shortest length in excitation periods.
const BLOCKS: usize = 8;
/// Stretches of a block whose numbers are kept: largest values are spoken of by how long the motion remembers.
const STRETCHES: u64 = 16;
/// How often so many blocks are flown once more where they drift.
const AGAIN: usize = 2;
const OF_DECAY: f64 = 0.25;
const SHORTEST: f64 = 128.0;
/// Most periods after which a motion is seen to repeat, and the difference of its states, over their size, up to which they
/// are the same.
const MOST_REPEATS: usize = 6;
const SAME_STATE: f64 = 1e-9;
/// The same from which on it is worth to solve for the motion.
const NEARLY: f64 = 1e-4;
/// The same up to which a state is that of an orbit that attracts; of one that was solved for from a start, beside which others
/// may lie that belong to it, as after a period doubling.
const NEAR_ORBIT: f64 = 1e-3;
const NEAR_PROVEN: f64 = 1e-6;
/// Most impacts in a period, of all absorbers: more are of chatter that does not end.
const MOST_IMPACTS: u64 = 2000;
/// Most impacts of a start until its slowest mode has died out: one that chatters on is given up, and measured for so many
/// periods.
const MOST_OF_START: u64 = 400_000;
const GIVEN_UP: u64 = 16;
/// Relative difference up to which root mean squares and impacts of two motions that do not repeat are the same, beside their
/// errors.
const SAME: f64 = 0.02;
/// The same of those that do.
const SAME_REPEATING: f64 = 1e-6;

/// The long-term motions that these sensors read, from so many starts, that from rest among them; the most common first, then
/// those in which some absorbers rest, and where every one can rest that. What does not repeat is measured for at least so many
/// excitation periods.
///
/// # Errors
/// [`ModalStartError`] where the structure's own motion is not finite.
pub fn modal_motions(
    system: &ModalSystem,
    sensors: &[Sensor],
    starts: u32,
    periods: u64,
) -> Result<Vec<ModalMotion>, ModalStartError> {
    // How far the structure moves at each absorber says which of them may rest.
    let search = Search { system, sensors: with_absorbers(system, sensors), periods };
    let (mut found, at_rest) = search.moving(&[], starts)?;
    let mut tried: Vec<Vec<usize>> = Vec::new();
    let mut next = 0;
    while let Some(motion) = found.get(next) {
        next += 1;
        for rest in search.may_rest(motion) {
            if tried.contains(&rest) {
                continue;
            }
            let (further, _) = search.moving(&rest, starts.div_ceil(2))?;
            let known = |one: &ModalMotion| found.iter().any(|known| known.is_same(one));
            let further = further.into_iter().filter(|one| !known(one));
            let further: Vec<ModalMotion> = further.collect();
            found.extend(further);
            tried.push(rest);
        }
    }
    found.sort_by_key(|one| std::cmp::Reverse(one.starts));
    found.extend(at_rest);
    for motion in &mut found {
        motion.sensors.truncate(sensors.len());
        for flight in &mut motion.flights {
            flight.peaks.truncate(sensors.len());
            flight.squares.truncate(sensors.len());
        }
    }
    Ok(found)
}

/// Sensors, and the displacement of the structure at each absorber behind them.
fn with_absorbers(system: &ModalSystem, sensors: &[Sensor]) -> Vec<Sensor> {
    let at = |j: usize| system.modes().iter().map(|mode| mode.shape[j]).collect();
    let own = (0..system.absorbers().len()).map(|j| Sensor::displacement(at(j)));
    sensors.iter().cloned().chain(own).collect()
}

/// A search of motions of a structure.
struct Search<'a> {
    system: &'a ModalSystem,
    /// The last ones are those of its absorbers.
    sensors: Vec<Sensor>,
    periods: u64,
}

impl Search<'_> {
    /// Those in which these absorbers rest and another one impacts, and every absorber at rest. Starts are counted where none is
    /// held at rest.
    fn moving(
        &self,
        rest: &[usize],
        starts: u32,
    ) -> Result<(Vec<ModalMotion>, Option<ModalMotion>), ModalStartError> {
        let Some(system) = self.system.without(rest) else { return Ok((Vec::new(), None)) };
        let sensors = self.without(rest);
        let mut orbits = attracting(&system, &sensors)?;
        let mut found: Vec<ModalMotion> = orbits.iter().map(|one| one.motion.clone()).collect();
        let mut at_rest = modal_at_rest(&system, &sensors);
        for k in 0..starts {
            let motion =
                from_start(&system, &sensors, &start(&system, k), self.periods, &mut orbits)?;
            // What is left of a transient then is no other motion.
            if let Some(at_rest) = at_rest.as_mut().filter(|_| motion.rests()) {
                at_rest.starts += 1;
                continue;
            }
            match found.iter_mut().find(|known| known.is_same(&motion)) {
                Some(known) => known.join(&motion),
                None => found.push(motion),
            }
        }
        let found = found.into_iter().filter_map(|one| self.with_resting(one, rest)).collect();
        Ok((found, at_rest))
    }

    /// The sensors for a structure without these absorbers.
    fn without(&self, rest: &[usize]) -> Vec<Sensor> {
        let of = |sensor: &Sensor| match sensor.reads {
            // Nothing is what one reads that has no impacts.
            Reading::Jump { absorber } if rest.contains(&absorber) => {
                Sensor { reads: Reading::Displacement, scale: 0.0, ..sensor.clone() }
            }
            Reading::Jump { absorber } => {
                let before = rest.iter().filter(|j| **j < absorber).count();
                Sensor { reads: Reading::Jump { absorber: absorber - before }, ..sensor.clone() }
            }
            _ => sensor.clone(),
        };
        self.sensors.iter().map(of).collect()
    }

    /// A motion of the structure without these absorbers as one of all; none where a wall would reach one of them.
    fn with_resting(&self, motion: ModalMotion, rest: &[usize]) -> Option<ModalMotion> {
        let mut motion = motion;
        for (extent, sensor) in motion.sensors.iter_mut().zip(&self.sensors) {
            extent.reads = sensor.reads;
        }
        for j in rest {
            motion.impacts_per_period.insert(*j, [0.0; 2]);
            for flight in &mut motion.flights {
                let stretches = flight.squares.first().map_or(0, Vec::len);
                flight.impacts.insert(*j, vec![0.0; stretches]);
            }
        }
        let rests = |j: usize| motion.impacts_per_period[j][0] == 0.0;
        let share = |j: usize| rests(j).then(|| self.share(&motion, j));
        motion.resting = (0..self.system.absorbers().len()).map(share).collect();
        if !rest.is_empty() {
            motion.starts = 0;
        }
        let stay = rest.iter().all(|j| motion.resting[*j].is_some_and(|share| share > 0.0));
        (stay && (rest.is_empty() || !motion.rests())).then_some(motion)
    }

    /// The share of its cavity within which no wall reaches an absorber at rest in a motion; 0 or less where one does everywhere.
    fn share(&self, motion: &ModalMotion, j: usize) -> f64 {
        let own = self.sensors.len() - self.system.absorbers().len();
        1.0 - motion.sensors[own + j].peak / self.system.absorbers()[j].clearance
    }

    /// Sets of absorbers that may rest, of which one more does than in a motion, and another one impacts.
    fn may_rest(&self, motion: &ModalMotion) -> Vec<Vec<usize>> {
        let count = self.system.absorbers().len();
        let rest: Vec<usize> = (0..count).filter(|j| motion.resting[*j].is_some()).collect();
        let more = (0..count).filter(|j| !rest.contains(j) && self.share(motion, *j) > 0.0);
        let with = |j: usize| {
            let mut set: Vec<usize> = rest.iter().copied().chain([j]).collect();
            set.sort_unstable();
            set
        };
        more.map(with).filter(|set| set.len() < count).collect()
    }
}

/// An exact orbit that attracts, by a state at the end of one of its periods.
struct Attracting {
    state: ModalState,
    /// Distance up to which another state is taken for one on it.
    reach: f64,
    motion: ModalMotion,
}

impl Attracting {
    /// The periodic motion that a state nearly is on, if it attracts, by each of its states; none where there is none, or an
    /// absorber rests on a wall in it.
    fn near(
        system: &ModalSystem,
        sensors: &[Sensor],
        state: &ModalState,
        periods: u32,
    ) -> Option<Vec<Self>> {
        let mut simulation = ModalSimulation::new(system, state, 0.0).ok()?;
        let mut seen = Sequence::default();
        simulation.run(periods.into(), u64::from(periods) * MOST_IMPACTS, &mut seen);
        // One that hits nothing and moves is on its way to a wall.
        let drifts = |(j, one): (usize, &[f64; 2])| {
            one[1] != 0.0 && seen.impacts.iter().all(|impact| impact.absorber != j)
        };
        let carried = &state.absorbers[..system.absorbers().len()];
        if seen.sticks || carried.iter().enumerate().any(drifts) {
            return None;
        }
        let cycle = ModalCycle { state: *state, periods, impacts: seen.impacts };
        let orbit = cycle.solve(system).ok().filter(ModalPeriodicOrbit::attracts)?;
        let begin = orbit.cycle.state;
        if distance(&begin, state) > NEAR_ORBIT {
            return None;
        }
        // Its states, until it is there again: that may be so earlier.
        let mut on = ModalSimulation::new(system, &begin, 0.0).ok()?;
        let mut states = vec![begin];
        for _ in 1..periods {
            on.run(1, MOST_IMPACTS, &mut ());
            if distance(&begin, &on.state()) <= SAME_STATE {
                break;
            }
            states.push(on.state());
        }
        let periods = states.len() as u32;
        let mut simulation = ModalSimulation::new(system, &begin, 0.0).ok()?;
        let whole = Stretch::fly(&mut simulation, system, sensors, periods.into());
        let motion = ModalMotion {
            largest_multiplier: Some(orbit.radius_per_period()),
            ..ModalMotion::of(sensors, &[whole], Some(periods), true, 1)
        };
        let on = |state| Self { state, reach: NEAR_PROVEN, motion: motion.clone() };
        Some(states.into_iter().map(on).collect())
    }
}

/// Impacts in their order, and whether an absorber came to rest on a wall.
#[derive(Default)]
struct Sequence {
    impacts: Vec<CycleImpact>,
    sticks: bool,
}

impl ModalObserver for Sequence {
    fn detail(&self) -> Detail {
        Detail::Events
    }
    fn impact(&mut self, impact: &ModalImpact) {
        let side = if impact.side == Side::Plus { 1.0 } else { -1.0 };
        let ModalImpact { tau: time, absorber, .. } = *impact;
        self.impacts.push(CycleImpact { time, absorber, side });
    }
    fn sticks(&mut self, _absorber: usize, _loss: f64) {
        self.sticks = true;
    }
}

/// The exact orbits that attract, each measured over a period of its own.
fn attracting(
    system: &ModalSystem,
    sensors: &[Sensor],
) -> Result<Vec<Attracting>, ModalStartError> {
    let stable = antiperiodic_orbits(system).into_iter().filter(|orbit| orbit.stable());
    let each = stable.map(|orbit| {
        let state = orbit_state(system, &orbit);
        let mut simulation = ModalSimulation::new(system, &state, 0.0)?;
        let block = Stretch::fly(&mut simulation, system, sensors, 1);
        let radius = orbit.spectral_radius();
        let multiplier = Some(radius * radius);
        let motion = ModalMotion {
            largest_multiplier: multiplier,
            starts: 0,
            ..ModalMotion::of(sensors, &[block], Some(1), true, 1)
        };
        Ok(Attracting { state, reach: NEAR_ORBIT, motion })
    });
    each.collect()
}

/// Every absorber at rest where no wall reaches it, as these sensors read it: in closed form. None where a wall reaches one.
pub fn modal_at_rest(system: &ModalSystem, sensors: &[Sensor]) -> Option<ModalMotion> {
    let share = |(j, one): (usize, &ModalAbsorber)| {
        1.0 - system.steady_motion_at(j).amplitude() / one.clearance
    };
    let shares: Vec<f64> = system.absorbers().iter().enumerate().map(share).collect();
    if shares.iter().any(|share| *share <= 0.0) {
        return None;
    }
    let shapes: Vec<Vec<f64>> = sensors.iter().map(|one| one.shape.clone()).collect();
    let amplitudes = ModalAmplitudes::of(system, &[], &shapes).places;
    let extent = |(sensor, amplitude): (&Sensor, f64)| {
        let peak = sensor.of_sine(amplitude, system.frequency_ratio());
        let rms = [peak * std::f64::consts::FRAC_1_SQRT_2, 0.0];
        SensorExtent { reads: sensor.reads, peak, error: 0.0, rms }
    };
    Some(ModalMotion {
        sensors: sensors.iter().zip(amplitudes).map(extent).collect(),
        impacts_per_period: vec![[0.0; 2]; system.absorbers().len()],
        repeats_after: Some(1),
        settled: true,
        largest_multiplier: None,
        starts: 0,
        resting: shares.into_iter().map(Some).collect(),
        periods: 0,
        flights: Vec::new(),
    })
}

/// One prime for the share of the steady motion, and for the place of each absorber.
const PRIMES: [f64; MOST_MODES + 1] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0];

/// The `k`-th start: from rest, each absorber half way to a wall; then with a share of the structure's own steady motion and
/// the absorbers anywhere in their cavities, evenly spread.
fn start(system: &ModalSystem, k: u32) -> ModalState {
    let mut start = ModalState::AT_REST;
    let part = |axis: usize| position(PRIMES[axis], k.saturating_sub(1));
    let share = if k == 0 { 0.0 } else { 1.2 * part(0) };
    for mode in 0..system.modes().len() {
        let steady = system.steady_motion(mode);
        let velocity = system.frequency_ratio() * steady.sine;
        start.modes[mode] = [share * steady.cosine, share * velocity];
    }
    for (j, absorber) in system.absorbers().iter().enumerate() {
        let each = system.modes().iter().zip(&start.modes);
        let [x, v] = each.fold([0.0, 0.0], |[x, v], (mode, [q, p])| {
            [x + mode.shape[j] * q, v + mode.shape[j] * p]
        });
        let place = if k == 0 { 0.5 } else { 1.98 * part(1 + j) - 0.99 };
        start.absorbers[j] = [x - place * absorber.clearance, v];
    }
    start
}

/// States at the ends of the last periods, and impacts.
#[derive(Default)]
struct Seen {
    states: Vec<ModalState>,
    impacts: [u64; MOST_MODES],
}

impl ModalObserver for Seen {
    fn detail(&self) -> Detail {
        Detail::Events
    }
    fn impact(&mut self, impact: &ModalImpact) {
        self.impacts[impact.absorber] += 1;
    }
    fn period(&mut self, _turns: u64, state: &ModalState) {
        if self.states.len() > MOST_REPEATS {
            self.states.remove(0);
        }
        self.states.push(*state);
    }
}

impl Seen {
    /// After how many periods the last state was there before, and those after which it nearly was.
    fn repeats_after(&self) -> Repeats {
        let Some((last, before)) = self.states.split_last() else { return Repeats::default() };
        let each =
            before.iter().rev().zip(1..).map(|(other, after)| (after, distance(last, other)));
        let each: Vec<(u32, f64)> = each.collect();
        let within = |most: f64| each.iter().filter(move |one| one.1 <= most).map(|one| one.0);
        Repeats { exactly: within(SAME_STATE).next(), nearly: within(NEARLY).collect() }
    }
}

/// Excitation periods after which a state was there before.
#[derive(Default)]
struct Repeats {
    exactly: Option<u32>,
    /// Ascending.
    nearly: Vec<u32>,
}

/// Largest difference of two states, over the largest number of the first.
fn distance(of: &ModalState, other: &ModalState) -> f64 {
    let numbers = |state: &ModalState| -> Vec<f64> {
        state.modes.iter().chain(&state.absorbers).flatten().copied().collect()
    };
    let (of, other) = (numbers(of), numbers(other));
    let size = of.iter().fold(0.0, |most: f64, one| most.max(one.abs()));
    let off = of.iter().zip(&other).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
    off / size
}

/// What a stretch of periods came to.
struct Stretch {
    periods: u64,
    sensors: Vec<SensorRecord>,
    impacts: Vec<f64>,
    repeats_after: Repeats,
}

impl Stretch {
    /// Flies so many periods.
    fn fly(
        simulation: &mut ModalSimulation,
        system: &ModalSystem,
        sensors: &[Sensor],
        periods: u64,
    ) -> Self {
        let mut observer = (ModalMeter::new(system, sensors), Seen::default());
        simulation.run(periods, periods * MOST_IMPACTS, &mut observer);
        let (meter, seen) = observer;
        let counts = &seen.impacts[..system.absorbers().len()];
        let impacts = counts.iter().map(|all| *all as f64 / periods as f64).collect();
        Self { periods, sensors: meter.records(), impacts, repeats_after: seen.repeats_after() }
    }
}

/// Excitation periods in which the slowest mode decays to `1/e`.
fn decay_periods(system: &ModalSystem) -> f64 {
    let decays = system.modes().iter().map(|mode| mode.damping_ratio * mode.frequency);
    let slowest = decays.fold(f64::INFINITY, f64::min);
    system.frequency_ratio() / (std::f64::consts::TAU * slowest)
}

/// Excitation periods of a time in which the slowest mode decays, and of a stretch of at least so many `periods` in all.
fn lengths(system: &ModalSystem, periods: u64) -> [u64; 2] {
    let decay = decay_periods(system).min(LONGEST);
    let block = (OF_DECAY * decay).max(SHORTEST).ceil() as u64;
    let block = block.max(periods.div_ceil(BLOCKS as u64));
    [decay.max(QUICKEST).ceil() as u64, block.div_ceil(STRETCHES)]
}

/// Excitation periods that a start is flown for at most, where at least so many are measured.
pub fn longest_flight(system: &ModalSystem, periods: u64) -> f64 {
    let [decay, stretch] = lengths(system, periods);
    let block = (STRETCHES * stretch) as f64;
    f64::from(DECAYS) * decay as f64 + (BLOCKS * (1 + AGAIN)) as f64 * block
}

/// The motion that a start leads to.
fn from_start(
    system: &ModalSystem,
    sensors: &[Sensor],
    start: &ModalState,
    periods: u64,
    orbits: &mut Vec<Attracting>,
) -> Result<ModalMotion, ModalStartError> {
    let mut simulation = ModalSimulation::new(system, start, 0.0)?;
    let [decay, stretch] = lengths(system, periods);
    // What a known orbit attracts, what is solved for, or what repeats.
    let mut known = |simulation: &mut ModalSimulation, repeats: &Repeats| {
        let state = simulation.state();
        if let Some(near) = orbits.iter().find(|one| distance(&one.state, &state) < one.reach) {
            return Some(ModalMotion { starts: 1, ..near.motion.clone() });
        }
        let solve = |after: &u32| Attracting::near(system, sensors, &state, *after);
        if let Some(solved) = repeats.nearly.iter().find_map(solve) {
            let motion = solved[0].motion.clone();
            orbits.extend(solved);
            return Some(motion);
        }
        let after = repeats.exactly?;
        let period = Stretch::fly(simulation, system, sensors, after.into());
        Some(ModalMotion::of(sensors, &[period], Some(after), true, periods))
    };
    for _ in 0..DECAYS {
        let mut seen = Seen::default();
        let left = MOST_OF_START.saturating_sub(simulation.impacts());
        if simulation.run(decay, left, &mut seen) != Stop::EndTime {
            let seen = Stretch::fly(&mut simulation, system, sensors, GIVEN_UP);
            return Ok(ModalMotion::of(sensors, &[seen], None, false, periods));
        }
        if let Some(known) = known(&mut simulation, &seen.repeats_after()) {
            return Ok(known);
        }
    }
    let (mut stretches, mut drifting) = (Vec::new(), true);
    // Of many motions one in a thousand seems to drift by chance; what drifts is left out as a transient.
    for _ in 0..=AGAIN {
        if !drifting {
            break;
        }
        stretches.clear();
        for _ in 0..BLOCKS {
            for _ in 0..STRETCHES {
                stretches.push(Stretch::fly(&mut simulation, system, sensors, stretch));
            }
            let last = stretches.last().map(|one| &one.repeats_after);
            if let Some(known) = last.and_then(|last| known(&mut simulation, last)) {
                return Ok(known);
            }
        }
        let rms = |block: &[Stretch], n: usize| {
            let squares = block.iter().map(|one| one.sensors[n].mean_square);
            (squares.sum::<f64>() / block.len() as f64).sqrt()
        };
        let blocks = || stretches.chunks(STRETCHES as usize);
        drifting = (0..sensors.len())
            .filter(|n| sensors[*n].reads == Reading::Displacement)
            .any(|n| drifts(&blocks().map(|one| rms(one, n)).collect::<Vec<_>>()));
    }
    let settled = !drifting && decay_periods(system) <= LONGEST;
    Ok(ModalMotion::of(sensors, &stretches, None, settled, periods))
}

impl ModalMotion {
    /// From what stretches of equal length came to, in a case with a window of so many periods.
    fn of(
        sensors: &[Sensor],
        stretches: &[Stretch],
        repeats_after: Option<u32>,
        settled: bool,
        periods: u64,
    ) -> Self {
        let of_sensors = |of: fn(&SensorRecord) -> f64| {
            let each = |n: usize| stretches.iter().map(|one| of(&one.sensors[n])).collect();
            (0..sensors.len()).map(each).collect()
        };
        let impacts = |j: usize| stretches.iter().map(|one| one.impacts[j]).collect();
        let flight = FlightCourse {
            periods: stretches.iter().map(|one| one.periods).sum(),
            peaks: of_sensors(|one| one.peak),
            squares: of_sensors(|one| one.mean_square),
            impacts: (0..stretches[0].impacts.len()).map(impacts).collect(),
        };
        let unknown =
            |one: &Sensor| SensorExtent { reads: one.reads, peak: 0.0, error: 0.0, rms: [0.0; 2] };
        let mut found = Self {
            sensors: sensors.iter().map(unknown).collect(),
            impacts_per_period: vec![[0.0; 2]; flight.impacts.len()],
            repeats_after,
            settled,
            largest_multiplier: None,
            starts: 1,
            resting: vec![None; flight.impacts.len()],
            periods,
            flights: vec![flight],
        };
        found.measure();
        found
    }

    /// Its numbers by all that was seen of it.
    fn measure(&mut self) {
        let Self { sensors, impacts_per_period, flights, .. } = self;
        let seen = flights.iter().map(|one| one.periods).sum::<u64>().max(1);
        let longer = LONGER * self.periods as f64 / seen as f64;
        let known = |windows: &[&[f64]]| {
            let all = windows.concat();
            let mean = all.iter().sum::<f64>() / all.len() as f64;
            [mean, if all.len() > 1 { twice_error_of_mean(windows) } else { 0.0 }]
        };
        for (n, sensor) in sensors.iter_mut().enumerate() {
            let peaks: Vec<&[f64]> = flights.iter().map(|one| one.peaks[n].as_slice()).collect();
            let squares: Vec<&[f64]> =
                flights.iter().map(|one| one.squares[n].as_slice()).collect();
            let [square, error] = known(&squares);
            let rms = square.sqrt();
            sensor.peak = peaks.iter().copied().flatten().copied().fold(0.0, f64::max);
            sensor.error = error_of_largest(&peaks, longer);
            sensor.rms = [rms, error_of_root(rms, error)];
        }
        for (j, impacts) in impacts_per_period.iter_mut().enumerate() {
            let counts: Vec<&[f64]> = flights.iter().map(|one| one.impacts[j].as_slice()).collect();
            *impacts = known(&counts);
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

    /// Whether it is one that may be met: a start led to it, or absorbers that rest do so in a share of their places that is not
    /// negligible; none in which one rests where these do not count.
    pub fn counts(&self, count_rest: bool) -> bool {
        self.rest_share().is_none_or(|share| count_rest && (self.starts > 0 || share >= NEGLIGIBLE))
    }

    /// What sensors of a kind read, in their order.
    pub fn read(&self, reads: Reading) -> impl Iterator<Item = &SensorExtent> {
        self.sensors.iter().filter(move |one| one.reads == reads)
    }

    /// Whether it is another flight of the same motion, by its displacements, whatever else is read.
    fn is_same(&self, other: &Self) -> bool {
        let repeats = self.repeats_after.is_some();
        let share = if repeats { SAME_REPEATING } else { SAME };
        let near = |[a, of_a]: [f64; 2], [b, of_b]: [f64; 2]| {
            (a - b).abs() <= share * a.max(b) + of_a + of_b
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

    /// Adds another flight of it; what repeats is known from one.
    fn join(&mut self, other: &Self) {
        self.starts += other.starts;
        self.settled &= other.settled;
        if self.repeats_after.is_none() {
            self.flights.extend(other.flights.iter().cloned());
            self.measure();
        }
    }
}
