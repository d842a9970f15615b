//! The absorber between captures: what it does after it has left 1:1 resonance at the fold, and how likely it is
//! captured again.
//!
//! Below the fold nothing captures it. Above, the symmetric motion attracts it sooner or later: its irregular motion is
//! a transient there, which ends at random, in each period with the same probability. Averages and that probability
//! are measured on the impact pair, at prescribed amplitudes, from many states in which the absorber leaves.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

use super::curve::MOST_ELASTIC;
use super::pair::{averages, pair_state, simulation};
use crate::analysis::Manifold;
use crate::numerics::scatter::twice_standard_error;
use crate::operation_count;
use crate::regimes::modulation::captured;
use crate::simulation::{Measurement, PeriodRecord};

/// Ratio of successive amplitudes; their number below the fold, from a third of it.
const RATIO: f64 = 1.06;
const BELOW_FOLD: i32 = 20;
/// Starts; how far below the fold they leave its motion, over the fold; after how many periods they count.
const STARTS: usize = 64;
const BELOW: [f64; 2] = [0.02, 0.12];
const FREE: [u64; 2] = [10, 40];
/// Periods of a start that is never captured.
const PERIODS: u64 = 60;
/// Periods of two alternating impacts that are a capture: the irregular motion has three or four by chance.
const CAPTURE: usize = 6;
/// Impacts per period from which on a start is given up.
const MOST_IMPACTS: u64 = 1000;
/// Groups of starts whose scatter is the error of the averages.
pub(super) const GROUPS: usize = 4;

/// What the absorber does at one amplitude while it is not captured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Uncaptured {
    /// `C/b`.
    pub amplitude: f64,
    /// `S` and `K`.
    pub forces: [f64; 2],
    /// Variance that a period adds to the sums of `S` and `K` over many, as starts differ.
    pub scatter: f64,
    /// Captures per period of the oscillator.
    pub rate: f64,
    /// Impacts per period.
    pub impacts: f64,
}

/// What it does over amplitudes from a third of the fold's to one clearance, for one restitution.
#[derive(Debug, Clone, PartialEq)]
pub struct Recapture {
    pub(super) manifold: Manifold,
    /// Largest amplitude of the motion that captures it.
    pub(super) largest_captured: f64,
    /// By ascending amplitude, of all starts.
    pub(super) places: Vec<Uncaptured>,
    /// Of a part of the starts each.
    pub(super) groups: Vec<Vec<Uncaptured>>,
}

/// What several starts did before they were captured.
#[derive(Debug, Clone, Copy, Default)]
struct StartSums {
    forces: [f64; 2],
    /// Of the squares of each start's means, times its periods; and of starts.
    squares: f64,
    starts: f64,
    periods: f64,
    captures: f64,
    impacts: f64,
}

impl Recapture {
    /// For a restitution; none above 0.995, where impacts forget their start too slowly.
    pub fn of(restitution: f64) -> Option<Self> {
        let manifold = Manifold::of(restitution);
        let fold = manifold.fold.oscillator_amplitude;
        if restitution > MOST_ELASTIC {
            return None;
        }
        let starts = starts(restitution, &manifold)?;
        let amplitude = |k: i32| fold * libm::pow(RATIO, f64::from(k));
        let amplitudes = (-BELOW_FOLD..).map(amplitude).take_while(|amplitude| *amplitude < RATIO);
        let mut places = Vec::new();
        let mut groups = vec![Vec::new(); GROUPS];
        for amplitude in amplitudes {
            let mut sums = [StartSums::default(); GROUPS];
            for (k, [w, speed]) in starts.iter().enumerate() {
                let start = [*w, speed * amplitude / fold];
                sums[k % GROUPS].add(&records(restitution, amplitude, start)?, amplitude > fold);
            }
            groups
                .iter_mut()
                .zip(&sums)
                .for_each(|(group, sums)| group.push(sums.place(amplitude)));
            places.push(StartSums::total(&sums).place(amplitude));
        }
        let largest_captured = manifold.largest_stable_motion();
        Some(Self { manifold, largest_captured, places, groups })
    }

    /// At a table's amplitude or between, linear; below the smallest as there. None above the largest.
    pub(super) fn at(places: &[Uncaptured], amplitude: f64) -> Option<Uncaptured> {
        let after = places.partition_point(|place| place.amplitude < amplitude);
        let to = places.get(after)?;
        let Some(from) = after.checked_sub(1).map(|before| &places[before]) else {
            return Some(*to);
        };
        let part = (amplitude - from.amplitude) / (to.amplitude - from.amplitude);
        let between = |from: f64, to: f64| from * (1.0 - part) + to * part;
        Some(Uncaptured {
            amplitude,
            forces: [0, 1].map(|k| between(from.forces[k], to.forces[k])),
            scatter: between(from.scatter, to.scatter),
            rate: between(from.rate, to.rate),
            impacts: between(from.impacts, to.impacts),
        })
    }

    /// Captures per period of the oscillator at an amplitude `C/b`, and twice the standard error of that; none above one
    /// clearance.
    pub fn rate(&self, amplitude: f64) -> Option<[f64; 2]> {
        let rate = |places: &[Uncaptured]| Self::at(places, amplitude).map(|place| place.rate);
        let of_groups = self.groups.iter().map(|places| rate(places));
        let of_groups: Option<Vec<f64>> = of_groups.collect();
        Some([rate(&self.places)?, twice_standard_error(&of_groups?)])
    }
}

impl StartSums {
    /// Adds what a start did until it was captured, if anything captures it.
    fn add(&mut self, records: &[PeriodRecord], captures: bool) {
        let free = if captures {
            let all = captured(records, CAPTURE);
            let end = all.iter().position(|captured| *captured);
            self.captures += f64::from(end.is_some());
            &records[..end.unwrap_or(records.len())]
        } else {
            records
        };
        let (count, means) = (free.len() as f64, averages(free));
        (0..2).for_each(|k| self.forces[k] += count * means[k]);
        self.squares += count * (means[0] * means[0] + means[1] * means[1]);
        self.starts += f64::from(u8::from(count > 0.0));
        self.periods += count;
        self.impacts +=
            free.iter().map(|record| f64::from(record.impacts.iter().sum::<u32>())).sum::<f64>();
    }

    fn total(all: &[Self]) -> Self {
        all.iter().fold(Self::default(), |sum, one| Self {
            forces: [0, 1].map(|k| sum.forces[k] + one.forces[k]),
            squares: sum.squares + one.squares,
            starts: sum.starts + one.starts,
            periods: sum.periods + one.periods,
            captures: sum.captures + one.captures,
            impacts: sum.impacts + one.impacts,
        })
    }

    fn place(&self, amplitude: f64) -> Uncaptured {
        // Where all are captured at once there is nothing to average.
        let periods = self.periods.max(1.0);
        let [s, k] = self.forces;
        let between = self.squares - (s * s + k * k) / periods;
        Uncaptured {
            scatter: between.max(0.0) / (self.starts - 1.0).max(1.0),
            amplitude,
            forces: self.forces.map(|sum| sum / periods),
            rate: self.captures / periods,
            impacts: self.impacts / periods,
        }
    }
}

/// Every period of the pair from a start.
fn records(restitution: f64, amplitude: f64, start: [f64; 2]) -> Option<Vec<PeriodRecord>> {
    let mut pair = simulation(restitution, amplitude, start)?;
    let mut measured = Measurement::begin(pair.system(), pair.state());
    pair.run(PERIODS, PERIODS * MOST_IMPACTS, &mut measured);
    operation_count::note(pair.operations());
    Some(measured.statistics().records().to_vec())
}

/// States of the absorber some tens of periods after it has left the fold's motion, at amplitudes a little below.
fn starts(restitution: f64, manifold: &Manifold) -> Option<Vec<[f64; 2]>> {
    let fold = manifold.fold;
    let ratio = fold.absorber_amplitude;
    // The sawtooth where the oscillator is at its lowest place.
    let phase = manifold.absorber_phase(ratio, manifold.fold_shift) - FRAC_PI_2;
    let displacement = FRAC_2_PI * ratio * libm::asin(libm::sin(phase)) - fold.oscillator_amplitude;
    let speed = FRAC_2_PI * ratio * libm::cos(phase).signum();
    let left = |k: usize| {
        let part = (k as f64 + 0.5) / STARTS as f64;
        let amplitude = fold.oscillator_amplitude * (1.0 - BELOW[0] - part * (BELOW[1] - BELOW[0]));
        let mut pair = simulation(restitution, amplitude, [displacement, -speed])?;
        let periods = FREE[0] + k as u64 % (FREE[1] - FREE[0]);
        pair.run(periods, periods * MOST_IMPACTS, &mut ());
        operation_count::note(pair.operations());
        Some(pair_state(&pair.state()))
    };
    (0..STARTS).map(left).collect()
}
