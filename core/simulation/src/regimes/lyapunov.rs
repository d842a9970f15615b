//! The largest Lyapunov exponent, from exact tangent dynamics, with its uncertainty.
//!
//! It is the mean rate at which a small change of state grows along a motion (Benettin, Galgani,
//! Giorgilli, Strelcyn 1980): below zero where neighbours come together, zero where they drift apart
//! no faster than linearly, above zero where they part exponentially. A mean over a window of a
//! chaotic motion scatters; its standard error comes from the means of successive blocks (batch
//! means: Law, Simulation Modeling and Analysis, section 9.5.3), once blocks are so long that they
//! are independent.

use serde::Serialize;

use crate::numerics::scatter::twice_standard_error;
use crate::simulation::{Impact, Observer, Reversal, Segment, Tangent};
use crate::system::{State, System};

/// Periods in which a change turns into the direction that grows fastest; they are not counted.
/// The directions that vanish with impacts do so by `r^2` per impact, others within the transient.
const ALIGNMENT: u64 = 20;
/// Blocks are merged in pairs when there are this many, so that half of it to all of it remain:
/// enough for a standard error that is itself good to 20 %.
const MOST_BLOCKS: usize = 32;
/// Fewer blocks give no standard error.
const FEWEST_BLOCKS: usize = 8;
/// Two-sided 97.5 % quantile of Student's t for 7 degrees of freedom, the fewest; for more blocks it
/// is smaller (2.13 for 15), so that intervals err on the wide side.
const STUDENT: f64 = 2.365;
/// Autocorrelation of successive block means above which blocks are not independent: its standard
/// error is `1/sqrt(blocks)`, 0.25 for 16 blocks, of which this is twice.
const DEPENDENT: f64 = 0.5;
/// Standard errors by which the halves of a window may differ: four are no chance even where many
/// motions are looked at, and a chaotic transient that gives way to another motion differs by more.
const AGREEMENT: f64 = 4.0;
/// Means of blocks that all lie within this (nats per period) need not be independent: growth by a
/// factor of e in 200 periods is nothing against the transients that are waited for.
const RESOLUTION: f64 = 5e-3;

/// The largest Lyapunov exponent over a window.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Exponent {
    /// Mean growth of a small change's logarithm per excitation period.
    pub per_period: f64,
    /// Standard error of that mean, from independent blocks.
    pub standard_error: f64,
    /// 95 % confidence interval; the range of the block means where blocks are not independent.
    pub interval: [f64; 2],
    /// Excitation periods that entered.
    pub periods: u64,
    /// Excitation periods in one block.
    pub block: u64,
    /// Correlation of successive block means: above 0.5 they are not independent, the blocks being
    /// too short or the growth swinging regularly.
    pub block_correlation: f64,
    /// Whether blocks are independent and both halves of the window agree within their errors, or
    /// all blocks agree anyway.
    pub converged: bool,
}

impl Exponent {
    /// Whether the interval lies above zero: neighbours part exponentially.
    pub fn is_positive(&self) -> bool {
        self.interval[0] > 0.0
    }

    /// Whether the interval lies below zero: neighbours come together.
    pub fn is_negative(&self) -> bool {
        self.interval[1] < 0.0
    }
}

/// An [`Observer`] that measures the largest Lyapunov exponent; one more evaluation of the closed
/// form per stretch of motion, constant memory.
#[derive(Debug, Clone)]
pub struct Lyapunov {
    tangent: Tangent,
    waiting: u64,
    /// Logarithm of the growth up to the end of the last complete period.
    logarithm: f64,
    blocks: Vec<f64>,
    length: u64,
    open: f64,
    open_periods: u64,
    lost: bool,
}

impl Lyapunov {
    /// Begins to measure at the beginning of an excitation period.
    pub fn begin(system: &System) -> Self {
        // Any direction will do that is not one which vanishes at once; no coordinate is left out.
        let change = State { x: 0.5, x_velocity: -0.3, y: 0.2, y_velocity: 0.7 };
        Self {
            tangent: Tangent::begin(system, change),
            waiting: ALIGNMENT,
            logarithm: 0.0,
            blocks: Vec::with_capacity(MOST_BLOCKS),
            length: 1,
            open: 0.0,
            open_periods: 0,
            lost: false,
        }
    }

    fn record(&mut self, growth: f64) {
        self.open += growth;
        self.open_periods += 1;
        if self.open_periods < self.length {
            return;
        }
        self.blocks.push(self.open);
        (self.open, self.open_periods) = (0.0, 0);
        if self.blocks.len() == MOST_BLOCKS {
            self.blocks = self.blocks.chunks(2).map(|pair| pair.iter().sum()).collect();
            self.length *= 2;
        }
    }

    /// The exponent over the periods so far; `None` if they are too few or the change was lost.
    pub fn exponent(&self) -> Option<Exponent> {
        let count = self.blocks.len();
        if self.lost || count < FEWEST_BLOCKS {
            return None;
        }
        let means: Vec<f64> = self.blocks.iter().map(|sum| sum / self.length as f64).collect();
        let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
        let error = |part: &[f64]| 0.5 * twice_standard_error(part);
        let (per_period, standard_error) = (mean(&means), error(&means));
        let (first, second) = means.split_at(count / 2);
        let apart = (mean(first) - mean(second)).abs();
        let agree = apart <= AGREEMENT * libm::hypot(error(first), error(second));
        let block_correlation = correlation(&means, per_period);
        let independent = block_correlation < DEPENDENT;
        let low = means.iter().copied().fold(f64::INFINITY, f64::min);
        let high = means.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let margin = STUDENT * standard_error;
        let interval =
            if independent { [per_period - margin, per_period + margin] } else { [low, high] };
        Some(Exponent {
            per_period,
            standard_error,
            interval,
            periods: count as u64 * self.length,
            block: self.length,
            block_correlation,
            converged: (agree && independent) || high - low <= RESOLUTION,
        })
    }
}

impl Observer for Lyapunov {
    fn segment(&mut self, segment: &Segment) {
        self.tangent.segment(segment);
    }

    fn impact(&mut self, impact: &Impact) {
        self.tangent.impact(impact);
    }

    fn sticks(&mut self, loss: f64) {
        self.tangent.sticks(loss);
    }

    fn reversal(&mut self, reversal: &Reversal) {
        self.tangent.reversal(reversal);
    }

    fn period(&mut self, _state: &State) {
        self.lost |= !self.tangent.normalize();
        let growth = self.tangent.logarithm() - self.logarithm;
        self.logarithm = self.tangent.logarithm();
        if self.waiting > 0 {
            self.waiting -= 1;
        } else {
            self.record(growth);
        }
    }
}

/// Correlation of each number with its successor; 0 if all are equal.
fn correlation(numbers: &[f64], mean: f64) -> f64 {
    let spread: f64 = numbers.iter().map(|number| (number - mean) * (number - mean)).sum();
    let joint: f64 = numbers.windows(2).map(|pair| (pair[0] - mean) * (pair[1] - mean)).sum();
    if spread > 0.0 { joint / spread } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{Cavity, Excitation, Parameters};

    fn fed(growth: impl Fn(u32) -> f64, count: u32) -> Exponent {
        let system = System::new(Parameters {
            mass_ratio: 0.01,
            damping: 0.0,
            restitution: 1.0,
            frequency_ratio: 1.0,
            forcing_per_clearance: 0.0,
            excitation: Excitation::Force,
            cavity: Cavity::IDEAL,
        });
        let mut lyapunov = Lyapunov::begin(&system.expect("valid"));
        (0..count).for_each(|k| lyapunov.record(growth(k)));
        lyapunov.exponent().expect("long enough")
    }

    #[test]
    fn blocks_grow_and_nothing_is_forgotten() {
        let found = fed(f64::from, 64);
        assert_eq!((found.periods, found.block), (64, 4));
        assert!((found.per_period - 31.5).abs() < 1e-12);
        // A drift is no sample of independent numbers.
        assert!(!found.converged && found.block_correlation > DEPENDENT, "{found:?}");
    }

    /// 16 means of 1 and 3 in turn: variance 16/15, standard error sqrt(1/15).
    #[test]
    fn the_standard_error_is_that_of_the_block_means() {
        let found = fed(|k| if k % 2 == 0 { 1.0 } else { 3.0 }, 16);
        assert!((found.standard_error - libm::sqrt(1.0 / 15.0)).abs() < 1e-15, "{found:?}");
        assert!((found.interval[1] - 2.0 - STUDENT * found.standard_error).abs() < 1e-15);
        assert!(found.converged && found.is_positive() && !found.is_negative());
    }

    /// A growth that swings slowly and regularly: each block mean resembles the one before, and only
    /// their range is a safe interval.
    #[test]
    fn blocks_that_depend_on_each_other_widen_the_interval() {
        let found = fed(|k| libm::sin(0.4 * f64::from(k)), 24);
        assert!(found.block == 1 && found.block_correlation > DEPENDENT, "{found:?}");
        let expected = (0..24).map(|k| libm::sin(0.4 * f64::from(k)));
        let low = expected.clone().fold(f64::INFINITY, f64::min);
        let high = expected.fold(f64::NEG_INFINITY, f64::max);
        assert_eq!(found.interval, [low, high]);
        assert!(!found.converged && found.standard_error < 0.5 * (high - low));
    }

    /// Swings that no transient would show are no reason for doubt.
    #[test]
    fn a_narrow_range_is_converged_however_regular() {
        let found = fed(|k| 0.3 + 1e-3 * libm::sin(0.4 * f64::from(k)), 24);
        assert!(found.converged && found.block_correlation > DEPENDENT, "{found:?}");
    }
}
