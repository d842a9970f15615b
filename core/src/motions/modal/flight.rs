//! A start, flown until it is on an exact orbit, repeats, or has been measured.

use super::motion::ModalMotion;
use super::proven::Attracting;
use super::stretch::{Repeats, Seen, Stretch, distance};
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
pub(super) fn from_start(
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
