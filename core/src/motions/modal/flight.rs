//! A start, flown until it is on an exact orbit, repeats, or has been measured.

use super::motion::ModalMotion;
use super::proven::{Attracting, NEAR_BY, Near};
use super::stretch::{MOST_IMPACTS, Repeats, SAME_STATE, Seen, Stretch, distance};
use crate::numerics::scatter::drifts;
use crate::simulation::{ModalSimulation, ModalStartError, Reading, Sensor, Stop};
use crate::system::{ModalState, ModalSystem};

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
/// Push off an orbit that does not attract, over the size of the motion: far above what a repetition leaves open.
const PUSH: f64 = 1e-3;
/// Excitation periods over which a start is measured at least, several times the slowest modulation.
const RECOGNITION: u64 = 200;
/// Most impacts of a start until its slowest mode has died out: one that chatters on is given up, and measured for so many
/// periods.
const MOST_OF_START: u64 = 400_000;
const GIVEN_UP: u64 = 16;

/// Excitation periods in which the slowest mode decays to `1/e`.
fn decay_periods(system: &ModalSystem) -> f64 {
    let decays = system.modes().iter().map(|mode| mode.damping_ratio * mode.frequency);
    let slowest = decays.fold(f64::INFINITY, f64::min);
    system.frequency_ratio() / (std::f64::consts::TAU * slowest)
}

/// Excitation periods of a time in which the slowest mode decays.
fn decay(system: &ModalSystem) -> u64 {
    decay_periods(system).clamp(QUICKEST, LONGEST).ceil() as u64
}

/// Excitation periods of a stretch, where so many starts of a place are measured together for at least so many `periods`: as long that
/// a block knows whether its numbers drift, and one start is recognised.
fn stretch(system: &ModalSystem, periods: u64, starts: u64) -> u64 {
    let block = (SHORTEST as u64).max(periods.div_ceil(BLOCKS as u64));
    let shared = block.div_ceil(starts.max(1)).max(RECOGNITION.div_ceil(BLOCKS as u64));
    let of_decay = (OF_DECAY * decay_periods(system).min(LONGEST)).ceil() as u64;
    shared.max(of_decay).div_ceil(STRETCHES)
}

/// Excitation periods over which a motion that does not repeat is measured at first.
pub(super) fn window(system: &ModalSystem, periods: u64) -> u64 {
    BLOCKS as u64 * STRETCHES * stretch(system, periods, 1)
}

/// Excitation periods that a start is flown for at most, where at least so many are measured and no other of its place settles.
pub fn longest_flight(system: &ModalSystem, periods: u64) -> f64 {
    f64::from(DECAYS) * decay(system) as f64 + (1 + AGAIN) as f64 * window(system, periods) as f64
}

/// A trajectory beside a state on an orbit that does not attract, in no direction that a symmetry has; absorbers are pushed inwards, as
/// one may be at a wall.
fn pushed(system: &ModalSystem, state: &ModalState) -> Option<ModalSimulation> {
    let numbers = state.modes.iter().chain(&state.absorbers).flatten();
    let push = PUSH * numbers.fold(0.0, |most: f64, one| most.max(one.abs()));
    let mut beside = *state;
    beside.modes[0][1] += push;
    for (j, own) in beside.absorbers.iter_mut().take(system.absorbers().len()).enumerate() {
        let each = system.modes().iter().zip(&state.modes);
        let x: f64 = each.map(|(mode, [q, _])| mode.shape[j] * q).sum();
        own[0] +=
            push.min(0.1 * system.absorbers()[j].clearance) * if x > own[0] { 1.0 } else { -1.0 };
    }
    ModalSimulation::new(system, &beside, 0.0).ok()
}

/// What became of a start.
pub(super) enum End {
    /// A motion that it is on.
    On(Box<ModalMotion>),
    /// It has not settled.
    Open(Box<Flight>),
}

/// Distance from an orbit that attracts, over that of the look before, up to which a start comes closer to it by no chance: a part of
/// the slowest decay lies between them.
const CLOSER: f64 = 0.75;

/// A start on its way.
pub(super) struct Flight {
    simulation: ModalSimulation,
    /// The orbit that attracts to which it was nearest when it was looked at last, and how far away that was.
    nearest: Option<(usize, f64)>,
    decay: u64,
    /// Impacts per excitation period, of all absorbers, where it was flown last.
    pub busy: f64,
    /// 1, or 0 of a start that is not counted.
    starts: u32,
}

impl Flight {
    /// Most impacts until it has flown on for so many periods.
    pub fn most_impacts(&self, periods: u64) -> u64 {
        self.simulation.impacts() + MOST_IMPACTS * periods
    }

    /// The same as a start that is not counted.
    pub fn uncounted(self) -> Self {
        Self { starts: 0, ..self }
    }
}

/// A search that it belongs to.
pub(super) struct Of<'a> {
    pub system: &'a ModalSystem,
    pub sensors: &'a [Sensor],
    /// Excitation periods that are measured at least.
    pub periods: u64,
    /// The exact orbits that attract, as far as they are known.
    pub orbits: Vec<Attracting>,
}

impl Of<'_> {
    /// The orbit that attracts to which a state is nearest, and how far away that is.
    fn nearest(&self, state: &ModalState) -> Option<(usize, f64)> {
        let each = self.orbits.iter().map(|one| distance(&one.state, state)).enumerate();
        each.min_by(|a, b| a.1.total_cmp(&b.1)).filter(|one| one.1 <= NEAR_BY)
    }

    /// What a known orbit attracts, what is solved for, or what repeats.
    fn known(&mut self, flight: &mut Flight, repeats: &Repeats) -> Option<ModalMotion> {
        let state = flight.simulation.state();
        let before = flight.nearest;
        flight.nearest = self.nearest(&state);
        if let Some((k, off)) = flight.nearest {
            let near = &self.orbits[k];
            let of_one = |k: usize| self.orbits[k].motion.state == near.motion.state;
            let closer = before.is_some_and(|(k, before)| of_one(k) && off <= CLOSER * before);
            if off < near.reach || closer {
                return Some(ModalMotion { starts: 1, ..near.motion.clone() });
            }
        }
        // One that nearly repeats may be on its way to an orbit, if it is not known yet to which.
        let roughly = repeats.roughly.filter(|_| flight.nearest.is_none());
        let solve = |after: &u32| Attracting::near(self.system, self.sensors, &state, *after);
        match repeats.nearly.iter().chain(&roughly).find_map(solve) {
            Some(Near::Attracts { solved, is_on }) => {
                let motion = is_on.then(|| solved[0].motion.clone());
                self.orbits.extend(solved);
                flight.nearest = self.nearest(&state);
                return motion;
            }
            Some(Near::Leaves) => {
                if let Some(beside) = pushed(self.system, &state) {
                    flight.simulation = beside;
                    flight.nearest = None;
                }
                return None;
            }
            None => {}
        }
        let after = repeats.exactly?;
        let period = Stretch::fly(&mut flight.simulation, self.system, self.sensors, after.into());
        let motion = ModalMotion::of(self.sensors, &[period], Some(after), true, self.periods);
        // What still changes in a period adds up until the slowest mode has died out.
        let left = SAME_STATE * decay(self.system) as f64;
        Some(ModalMotion { state: Some(state), ..motion.within(left) })
    }

    /// Flies a start until the slowest mode has died out.
    pub fn begin(&mut self, start: &ModalState) -> Result<End, ModalStartError> {
        let simulation = ModalSimulation::new(self.system, start, 0.0)?;
        let decay = decay(self.system);
        let flight = Flight { simulation, nearest: None, decay, busy: 0.0, starts: 1 };
        Ok(self.fly_on(flight, u64::from(DECAYS) * decay, MOST_OF_START))
    }

    /// Flies a start on for so many periods, with at most so many impacts since it began: one that has more is given up.
    pub fn fly_on(&mut self, mut flight: Flight, periods: u64, most: u64) -> End {
        let (before, mut left) = (flight.simulation.impacts(), periods);
        while left > 0 {
            let mut seen = Seen::default();
            let far = left.min(flight.decay);
            let impacts = most.saturating_sub(flight.simulation.impacts());
            if flight.simulation.run(far, impacts, &mut seen) != Stop::EndTime {
                let seen =
                    Stretch::fly(&mut flight.simulation, self.system, self.sensors, GIVEN_UP);
                let motion = ModalMotion::of(self.sensors, &[seen], None, false, self.periods);
                return End::On(Box::new(ModalMotion { starts: flight.starts, ..motion }));
            }
            if let Some(known) = self.known(&mut flight, &seen.repeats_after()) {
                return End::On(Box::new(ModalMotion { starts: flight.starts, ..known }));
            }
            left -= far;
        }
        flight.busy =
            flight.simulation.impacts().saturating_sub(before) as f64 / periods.max(1) as f64;
        End::Open(Box::new(flight))
    }

    /// Measures what has not settled, beside so many other starts, over so many times the usual window: in blocks, once more where they
    /// drift. Of many motions one in a thousand seems to drift by chance;
    /// what drifts is left out as a transient.
    pub fn measured(&mut self, flight: &mut Flight, starts: usize, times: u64) -> ModalMotion {
        let (mut stretches, mut drifting) = (Vec::new(), true);
        let stretch = times * stretch(self.system, self.periods, starts as u64);
        for _ in 0..=AGAIN {
            if !drifting {
                break;
            }
            stretches.clear();
            for _ in 0..BLOCKS {
                for _ in 0..STRETCHES {
                    let (system, sensors) = (self.system, self.sensors);
                    stretches.push(Stretch::fly(&mut flight.simulation, system, sensors, stretch));
                }
                let last = stretches.last().map(|one| &one.repeats_after);
                let known = last.and_then(|last| self.known(flight, last));
                if let Some(known) = known {
                    return ModalMotion { starts: flight.starts, ..known };
                }
            }
            let rms = |block: &[Stretch], n: usize| {
                let squares = block.iter().map(|one| one.sensors[n].mean_square);
                (squares.sum::<f64>() / block.len() as f64).sqrt()
            };
            let blocks = || stretches.chunks(STRETCHES as usize);
            drifting = (0..self.sensors.len())
                .filter(|n| self.sensors[*n].reads == Reading::Displacement)
                .any(|n| drifts(&blocks().map(|one| rms(one, n)).collect::<Vec<_>>()));
        }
        let settled = !drifting && decay_periods(self.system) <= LONGEST;
        let motion = ModalMotion::of(self.sensors, &stretches, None, settled, self.periods);
        let state = Some(flight.simulation.state());
        ModalMotion { state, starts: flight.starts, ..motion }
    }
}
