//! What the layers answer about one motion: the root mean square of the oscillator's displacement, the
//! impacts per period, the regime, and how far the first two may be off.

use serde::Serialize;

use super::{Proof, StudyError};
use crate::analysis::motion::root_mean_square;
use crate::analysis::{FixedPoint, Manifold, fixed_points};
use crate::numerics::scatter::twice_standard_error;
use crate::orbits::{Measures, symmetric_orbits};
use crate::regimes::{Regime, classify};
use crate::simulation::{ImpactLog, Simulation, Statistics, Stop};
use crate::system::System;

/// What a layer answers; lengths over the clearance. `None` where it gives no such answer.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Answer {
    /// Root mean square displacement of the oscillator.
    #[serde(skip)]
    pub rms: Option<f64>,
    /// Twice the standard error of `rms`, relative, from the scatter between blocks of the measured
    /// window; for simulations only.
    #[serde(rename = "rms_scatter")]
    pub scatter: Option<f64>,
    /// Whether the blocks approach a value exponentially: a transient makes `scatter`.
    pub settles: bool,
    /// Impacts per excitation period.
    pub impacts_per_period: Option<f64>,
    /// Twice the standard error of that.
    #[serde(rename = "impacts_per_period_scatter")]
    pub impacts_scatter: Option<f64>,
    /// The regime.
    pub regime: Option<Regime>,
    /// Why something is missing.
    pub why_not: Option<&'static str>,
}

impl Answer {
    /// None, and why.
    pub fn none(why: &'static str) -> Self {
        Self { why_not: Some(why), ..Self::default() }
    }

    /// A steady motion with two impacts per period.
    pub fn steady(rms: f64) -> Self {
        Self {
            rms: Some(rms),
            impacts_per_period: Some(2.0),
            regime: Some(Regime::TwoSymmetric),
            ..Self::default()
        }
    }
}

/// Relative error of averages along an exact orbit: closure and quadrature, both to rounding, with
/// room for a few hundred operations.
pub const ORBIT_ROUNDING: f64 = 1e-12;

/// Blocks that a measured window is cut into: enough for a standard error, few enough for each to be
/// longer than what it averages over.
pub const BLOCKS: u64 = 10;
/// Impacts after which a stretch is given up.
pub const IMPACT_LIMIT: u64 = 10_000_000;

/// The answer that a stable fixed point is.
pub fn of_fixed_point(system: &System, point: &FixedPoint) -> Answer {
    Answer::steady(root_mean_square(
        system,
        point.oscillator_amplitude,
        point.absorber_amplitude,
        point.absorber_phase,
    ))
}

/// That of the stable fixed point of the slow flow, at leading order in the mass ratio.
///
/// # Errors
/// [`StudyError::Analysis`] where the theory cannot be evaluated.
pub fn closed_form(system: &System) -> Result<Answer, StudyError> {
    let manifold = Manifold::of(system.restitution());
    let points = fixed_points::solve(system, &manifold)?;
    let stable = points.iter().rfind(|point| point.stable && point.admissible);
    Ok(match stable {
        Some(point) => of_fixed_point(system, point),
        None => Answer::none("no stable fixed point: the theory has no steady amplitude"),
    })
}

/// That of the exact symmetric orbit that attracts, to [`ORBIT_ROUNDING`].
pub fn symmetric_orbit(system: &System) -> Answer {
    let orbits = symmetric_orbits(system).unwrap_or_default();
    let Some(orbit) = orbits.iter().find(|orbit| orbit.orbit.attracts()) else {
        return Answer::none("no symmetric orbit is stable and admissible");
    };
    match Measures::of(system, &orbit.orbit.cycle) {
        Ok(measures) => Answer::steady(measures.rms),
        Err(_) => Answer::none("no steady motion between impacts"),
    }
}

/// Impacts per period of a proven orbit.
pub fn impacts_per_period(proof: &Proof) -> f64 {
    proof.orbit.cycle.impact_count() as f64 / f64::from(proof.orbit.cycle.periods())
}

/// The averages of so many periods from here, with their scatter between blocks.
pub fn measured(simulation: &mut Simulation, periods: u64) -> Option<Answer> {
    let system = *simulation.system();
    let mut statistics = Statistics::begin(&system, simulation.state());
    let mut log = ImpactLog::of_the_last(LAST_IMPACTS);
    let blocks = BLOCKS.min(periods).max(1);
    let mut sums = vec![[0.0; 2]];
    for block in 0..blocks {
        let until = periods * (block + 1) / blocks;
        let length = until - statistics.periods();
        let observer = &mut (&mut statistics, &mut log);
        if simulation.run(length, IMPACT_LIMIT, observer) != Stop::EndTime {
            return None;
        }
        let so_far = statistics.periods() as f64;
        sums.push([statistics.rms() * statistics.rms() * so_far, statistics.impacts() as f64]);
    }
    let lengths = (0..blocks).map(|k| (periods * (k + 1) / blocks - periods * k / blocks) as f64);
    let means: Vec<[f64; 2]> = sums
        .windows(2)
        .zip(lengths)
        .map(|(pair, length)| [0, 1].map(|k| (pair[1][k] - pair[0][k]) / length))
        .collect();
    let rms = statistics.rms();
    let [scatter, impacts_scatter] = scatters(&means, rms);
    let classified = classify(&statistics, &log.impacts, None, system.period());
    Some(Answer {
        rms: Some(rms),
        scatter: Some(scatter),
        settles: settles(&means.iter().map(|block| block[0]).collect::<Vec<_>>()),
        impacts_per_period: Some(statistics.impacts_per_period()),
        impacts_scatter: Some(impacts_scatter),
        regime: Some(classified.regime),
        why_not: None,
    })
}

/// Impacts that are kept of a run: enough to name its regime.
const LAST_IMPACTS: usize = 20_000;

/// Two standard errors of the root mean square, relative, and of the impacts per period, from means
/// of `x^2` and impacts in blocks.
pub fn scatters(means: &[[f64; 2]], rms: f64) -> [f64; 2] {
    // The square varies twice as much as its root.
    let square = (2.0 * rms * rms).max(f64::MIN_POSITIVE);
    let error =
        |k: usize| twice_standard_error(&means.iter().map(|block| block[k]).collect::<Vec<_>>());
    [error(0) / square, error(1)]
}

/// Share of the variance between blocks that an exponential must explain to be taken for one: a
/// modulation, regular or not, comes and goes and leaves it far below.
const EXPLAINED: f64 = 0.95;
/// What three blocks may at least leave of it: what is over within a block is no trend.
const LEAST_LEFT: f64 = 1e-3;

/// Whether averages over successive blocks approach a value exponentially.
fn settles(blocks: &[f64]) -> bool {
    let third = blocks.len() / 3;
    if third < 3 {
        return false;
    }
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let [first, second, last] = [0, 1, 2].map(|k| mean(&blocks[k * third..(k + 1) * third]));
    let left = (second - last) / (first - second);
    if !(LEAST_LEFT..1.0).contains(&left) {
        return false;
    }
    let factor = libm::pow(left, 1.0 / third as f64);
    let shape: Vec<f64> = (0..blocks.len()).map(|k| libm::pow(factor, k as f64)).collect();
    let (middle, level) = (mean(&shape), mean(blocks));
    let product = |a: &[f64], a0: f64, b: &[f64], b0: f64| {
        a.iter().zip(b).map(|(a, b)| (a - a0) * (b - b0)).sum::<f64>()
    };
    let across = product(&shape, middle, blocks, level);
    let explained = across * across / product(&shape, middle, &shape, middle);
    explained > EXPLAINED * product(blocks, level, blocks, level)
}

#[cfg(test)]
mod tests {
    use super::settles;

    #[test]
    fn only_an_exponential_settles() {
        let blocks =
            |of: &dyn Fn(f64) -> f64| (0..10).map(|k| of(f64::from(k))).collect::<Vec<_>>();
        for factor in [0.2, 0.6, 0.97] {
            assert!(settles(&blocks(&|k| 3.0 - libm::pow(factor, k))), "{factor}");
            // Some modulation on top of it changes nothing.
            assert!(settles(&blocks(&|k| libm::pow(factor, k) + 0.01 * libm::sin(2.5 * k))));
        }
        for turn in [0.5, 1.0, 2.0, 2.5, 3.0] {
            assert!(!settles(&blocks(&|k| 1.0 + libm::sin(turn * k + 0.3))), "{turn}");
        }
        // Neither one that grows, nor what does not change, nor a single odd block.
        assert!(!settles(&blocks(&|k| libm::pow(1.5, k))));
        assert!(!settles(&[1.0; 10]));
        assert!(!settles(&blocks(&|k| if k == 0.0 {
            5.0
        } else {
            1.0 + 0.1 * libm::sin(7.0 * k)
        })));
        assert!(!settles(&[2.0, 1.0]));
    }
}
