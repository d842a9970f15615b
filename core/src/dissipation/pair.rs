//! The impact pair: an absorber between walls that move as prescribed, `x = C sin psi`.
//!
//! The event engine flies it: an oscillator so much heavier that impacts do not move it by a unit in the last
//! place, on its steady motion, which is as far behind the force as a resonance is: `psi` is the excitation's
//! phase less `pi/2`.

use std::f64::consts::TAU;

use serde::Serialize;

use crate::numerics::scatter::twice_standard_error;
use crate::operation_count;
use crate::regimes::{Regime, classify};
use crate::simulation::{ImpactLog, Measurement, PeriodRecord, Simulation, Statistics, Stop};
use crate::system::{Cavity, Excitation, Parameters, State, System};

/// Mass ratio, and the reciprocal of its `lambda`: powers of two, whose product is exactly 1.
const MASS_RATIO: f64 = 1.0 / (1_u64 << 60) as f64;
/// Periods left out before a motion is measured, and in each of the rounds in which it is.
const ROUND: u64 = 60;
/// Fewest and most rounds of a motion that does not repeat.
const ROUNDS: [u32; 2] = [8, 40];
/// Impacts after which it is known well enough: with few per period there is a long memory between them.
const IMPACTS: u64 = 1000;
/// Distance between states that should be equal at which a motion repeats to rounding.
const REPEATED: f64 = 1e-12;
/// Impacts per period from which on a motion is given up: chattering ends in contact before.
const MOST_IMPACTS: u64 = 1000;
/// Impacts that are kept to tell a regime by.
const KEPT: usize = 1000;
/// Blocks whose averages tell how well a motion that does not repeat is known.
const BLOCKS: usize = 10;
/// Difference of `S` and of `K` up to which two motions are one: what is left of a transient near a bifurcation.
const ALIKE: f64 = 2e-3;

/// Part of a disturbance that is left of a start that is scouted, if it shrinks by `r` in a flight, and the fewest and most
/// periods that are waited for it.
const LEFT: f64 = 1e-4;
const WAITED: [f64; 2] = [20.0, 120.0];
/// Most periods after which it is seen to repeat, the distance between states at which it does, and that to a state which is
/// known.
const REPEATS: usize = 6;
const RETURNS: f64 = 2e-3;
const NEAR: f64 = 0.01;
/// Periods after which it must repeat still: chaos comes back once by chance.
const AGAIN: usize = 12;

/// The pair's long-term motion at one amplitude.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct PairPoint {
    /// Amplitude of the oscillator, `C/b`.
    #[serde(rename = "C")]
    pub amplitude: f64,
    /// `S`: the force that takes energy off the oscillator, as dry friction does, over `eps b` in fast time.
    #[serde(rename = "S")]
    pub resistance: f64,
    /// `K`: the force in phase with the displacement, which moves the resonance.
    #[serde(rename = "K")]
    pub reactance: f64,
    /// Of the two averages: rounding in closed form, what still changes of a motion that repeats, two standard
    /// errors between blocks of one that does not.
    pub errors: [f64; 2],
    /// Impacts per period of the oscillator.
    pub impacts_per_period: f64,
    /// What its impacts do.
    pub regime: Regime,
    /// Periods after which the motion repeats, if it was seen to.
    pub repeats_after: Option<u32>,
    /// Relative displacement and absorber velocity at the oscillator's lowest place.
    #[serde(skip)]
    pub(super) state: [f64; 2],
}

impl PairPoint {
    /// The motion that the pair comes to at an amplitude, above 0, from a relative displacement `w` and an absorber
    /// velocity at the oscillator's lowest place. None where a number is out of range, or impacts crowd without end.
    pub fn measured(restitution: f64, amplitude: f64, state: [f64; 2]) -> Option<Self> {
        let mut simulation = simulation(restitution, amplitude, state)?;
        let system = *simulation.system();
        simulation.run(ROUND, ROUND * MOST_IMPACTS, &mut ());
        let mut measured = Measurement::begin(&system, simulation.state());
        let mut log = ImpactLog::of_the_last(KEPT);
        for round in 1.. {
            let stop = simulation.run(ROUND, ROUND * MOST_IMPACTS, &mut (&mut measured, &mut log));
            if stop != Stop::EndTime {
                operation_count::note(simulation.operations());
                return None;
            }
            let found =
                classify(measured.statistics(), &log.impacts, None, TAU).evidence.periodicity;
            let enough = match found {
                Some(found) => found.closure <= REPEATED,
                None => round >= ROUNDS[0] && measured.statistics().impacts() >= IMPACTS,
            };
            if enough || round == ROUNDS[1] {
                break;
            }
        }
        operation_count::note(simulation.operations());
        let state = pair_state(&simulation.state());
        Some(Self { state, ..Self::of(amplitude, measured.statistics(), &log) })
    }

    fn of(amplitude: f64, statistics: &Statistics, log: &ImpactLog) -> Self {
        let records = statistics.records();
        let named = classify(statistics, &log.impacts, None, TAU);
        let periodicity = named.evidence.periodicity;
        let (averages, errors) = match periodicity {
            Some(found) => {
                // What a transient has left is seen from some repetitions back, where any is left.
                let ended = found.closure <= REPEATED;
                let back = if ended { 0 } else { records.len() / 2 };
                let back =
                    back.next_multiple_of(found.periods as usize).max(found.periods as usize);
                let earlier = &records[..records.len().saturating_sub(back)];
                let averages = averages(found.last(records));
                let before = self::averages(found.last(earlier));
                (averages, [0, 1].map(|k| (averages[k] - before[k]).abs() + f64::EPSILON))
            }
            None => {
                let blocks: Vec<[f64; 2]> =
                    records.chunks_exact((records.len() / BLOCKS).max(1)).map(averages).collect();
                let error = |k| {
                    twice_standard_error(
                        &blocks.iter().map(|one: &[f64; 2]| one[k]).collect::<Vec<_>>(),
                    )
                };
                (averages(records), [0, 1].map(error))
            }
        };
        Self {
            amplitude,
            resistance: averages[0],
            reactance: averages[1],
            errors,
            impacts_per_period: named.evidence.impacts_per_period,
            regime: named.regime,
            repeats_after: periodicity.map(|found| found.periods),
            state: [0.0; 2],
        }
    }

    /// The symmetric motion in closed form.
    pub(super) fn symmetric(amplitude: f64, [resistance, reactance]: [f64; 2]) -> Self {
        Self {
            amplitude,
            resistance,
            reactance,
            errors: [resistance, reactance].map(|force| 4.0 * f64::EPSILON * force.abs()),
            impacts_per_period: 2.0,
            regime: Regime::TwoSymmetric,
            repeats_after: Some(1),
            state: [0.0; 2],
        }
    }

    /// The absorber at rest.
    pub(super) fn still(amplitude: f64) -> Self {
        let (impacts_per_period, regime) = (0.0, Regime::AtRest);
        Self { impacts_per_period, regime, ..Self::symmetric(amplitude, [0.0; 2]) }
    }

    /// `S` and `K`.
    pub fn forces(&self) -> [f64; 2] {
        [self.resistance, self.reactance]
    }

    /// By how much the forces of two motions differ beyond what is not known of them.
    pub(super) fn distance(&self, other: &Self) -> f64 {
        let beyond = |k: usize| {
            (self.forces()[k] - other.forces()[k]).abs() - self.errors[k] - other.errors[k]
        };
        beyond(0).max(beyond(1))
    }

    /// Whether two motions at one amplitude are one.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        self.distance(other) <= ALIKE && !self.is_another_kind(other)
    }

    /// Whether both repeat, with another number of impacts per period or another symmetry.
    pub(super) fn is_another_kind(&self, other: &Self) -> bool {
        let repeat = self.repeats_after.is_some() && other.repeats_after.is_some();
        repeat
            && (self.regime != other.regime || self.impacts_per_period != other.impacts_per_period)
    }
}

/// Where a start is after some tens of periods, if it repeats then and is near none of the states that are known; as
/// [`PairPoint::measured`], and a fraction of its cost.
pub(super) fn scouted(
    restitution: f64,
    amplitude: f64,
    start: [f64; 2],
    known: &[[f64; 2]],
) -> Option<[f64; 2]> {
    let mut pair = simulation(restitution, amplitude, start)?;
    let [least, most] = WAITED;
    let needed = 0.5 * libm::log(LEFT) / libm::log(restitution.max(LEFT));
    pair.run(needed.clamp(least, most) as u64, ROUND * MOST_IMPACTS, &mut ());
    let mut states = vec![pair_state(&pair.state())];
    let size = |at: [f64; 2]| at[0].abs().max(at[1].abs() / amplitude);
    let apart = |a: &[f64; 2], b: &[f64; 2]| size([a[0] - b[0], a[1] - b[1]]);
    let mut repeats = false;
    while !repeats && states.len() <= REPEATS {
        pair.run(1, MOST_IMPACTS, &mut ());
        states.push(pair_state(&pair.state()));
        repeats = apart(&states[0], &states[states.len() - 1]) < RETURNS;
    }
    let is_known = || states.iter().any(|a| known.iter().any(|b| apart(a, b) < NEAR));
    let mut is_new = repeats && !is_known();
    if is_new {
        let each = states.len() - 1;
        pair.run(AGAIN.next_multiple_of(each) as u64, ROUND * MOST_IMPACTS, &mut ());
        is_new = apart(&states[0], &pair_state(&pair.state())) < NEAR;
    }
    operation_count::note(pair.operations());
    is_new.then_some(states[0])
}

/// The pair at an amplitude, above 0, from a relative displacement and an absorber velocity at the oscillator's lowest
/// place. None where a number is out of range.
pub(super) fn simulation(restitution: f64, amplitude: f64, state: [f64; 2]) -> Option<Simulation> {
    let system = System::new(Parameters {
        mass_ratio: MASS_RATIO,
        damping: 1.0 / MASS_RATIO,
        restitution,
        frequency_ratio: 1.0,
        forcing_per_clearance: amplitude / MASS_RATIO,
        excitation: Excitation::Force,
        cavity: Cavity::IDEAL,
    });
    let [w, y_velocity] = state;
    let lowest = -amplitude;
    let start = State { x: lowest, x_velocity: 0.0, y: lowest - w, y_velocity };
    Simulation::new(&system.ok()?, start, 0.0).ok()
}

/// Relative displacement and absorber velocity.
pub(super) fn pair_state(state: &State) -> [f64; 2] {
    [(state.x - state.y).clamp(-1.0, 1.0), state.y_velocity]
}

/// Means of `S` and `K`: `y = a sin + b cos` of the excitation's phase is `-b sin(psi) + a cos(psi)`.
pub(super) fn averages(records: &[PeriodRecord]) -> [f64; 2] {
    let count = records.len().max(1) as f64;
    let mean = |k: usize| records.iter().map(|one| one.absorber_harmonic[k]).sum::<f64>() / count;
    [-mean(0), mean(1)]
}
