//! What the layers answer about one motion: the root mean square of the oscillator's displacement, the
//! impacts per period, the regime, and how far the first two may be off.

use std::f64::consts::FRAC_1_SQRT_2;

use serde::Serialize;

use super::{Averages, StudyError};
use crate::analysis::motion::root_mean_square;
use crate::analysis::{FixedPoint, Manifold, fixed_points};
use crate::cavity::CavityAnalysis;
use crate::dissipation::SteadyState;
use crate::motions::{Facts, Motion};
use crate::numerics::scatter::twice_error_of_mean;
use crate::orbits::{Closure, Measures, steady_orbit};
use crate::regimes::{Regime, classify};
use crate::simulation::{ImpactLog, Measurement, Simulation, Stop};
use crate::system::System;

/// What a layer answers; lengths over the clearance. `None` where it gives no such answer.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Estimate {
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
    pub why_not: Option<WhyNoAnswer>,
}

/// Why a layer has no answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum WhyNoAnswer {
    /// The theory has no stable fixed point, so no steady amplitude.
    NoStablePoint,
    /// No orbit with two impacts per period is stable and admissible.
    NoStableOrbit,
    /// The averaged flow has no stable amplitude with impacts, or none that is followed.
    NoStableAmplitude,
    /// The averaged flow is that of an ideal cavity.
    RealCavity,
    /// The slow flow has no stable branch to begin on.
    NoMiddle,
    /// The slow flow settles beyond symmetry breaking, where the branch is unstable.
    BeyondSymmetryBreaking,
    /// The slow flow leaves the manifold at the fold.
    LeavesAtFold,
    /// The simulated motion does not repeat yet, so there is no orbit to solve for.
    NotRepeating,
    /// The run was ended by its limit on impacts.
    ImpactLimit,
    /// A number overflowed.
    Overflow,
    /// The motion is so large that rounding hides the walls.
    WallsUnresolved,
    /// A fixed step has impacts in nearly every step.
    ImpactsInEveryStep,
}

impl Estimate {
    /// None, and why.
    pub fn none(why: WhyNoAnswer) -> Self {
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

    /// What is known of a motion that was found.
    pub fn of_motion(motion: &Motion) -> Self {
        let Facts { rms, impacts_per_period, .. } = motion.facts();
        Self {
            rms: Some(rms.value),
            scatter: Some(rms.error / rms.value.max(f64::MIN_POSITIVE)),
            impacts_per_period: Some(impacts_per_period.value),
            impacts_scatter: Some(impacts_per_period.error),
            regime: Some(motion.regime()),
            ..Self::default()
        }
    }

    /// Averages over a window, with their scatter from the means of `x^2` and impacts in its blocks.
    pub fn averaged(rms: f64, impacts_per_period: f64, blocks: &[[f64; 2]]) -> Self {
        let [squares, impacts] =
            [0, 1].map(|k| blocks.iter().map(|block| block[k]).collect::<Vec<_>>());
        // The square varies twice as much as its root.
        let square = (2.0 * rms * rms).max(f64::MIN_POSITIVE);
        Self {
            rms: Some(rms),
            scatter: Some(twice_error_of_mean(&[&squares]) / square),
            settles: settles(&squares),
            impacts_per_period: Some(impacts_per_period),
            impacts_scatter: Some(twice_error_of_mean(&[&impacts])),
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

/// That of the stable fixed point of the slow flow, at leading order in the mass ratio.
///
/// # Errors
/// [`StudyError::Analysis`] where the theory cannot be evaluated.
pub fn closed_form(system: &System) -> Result<Estimate, StudyError> {
    if let Some(cavity) = CavityAnalysis::of(system) {
        return Ok(closed_form_of_cavity(system, &cavity));
    }
    let manifold = Manifold::of(system.restitution());
    let points = fixed_points(system, &manifold)?;
    let stable = points.iter().rfind(|point| point.stable && point.admissible);
    let rms = |point: &FixedPoint| {
        let [c, b] = [point.oscillator_amplitude, point.absorber_amplitude];
        root_mean_square(system, c, b, point.absorber_phase)
    };
    Ok(stable.map_or_else(
        || Estimate::none(WhyNoAnswer::NoStablePoint),
        |point| Estimate::steady(rms(point)),
    ))
}

/// The same by the theory of a cavity that is not ideal: the first harmonic of `v - eps y`.
fn closed_form_of_cavity(system: &System, cavity: &CavityAnalysis) -> Estimate {
    let Some(point) = cavity.stable_point() else {
        return Estimate::none(WhyNoAnswer::NoStablePoint);
    };
    let (eps, motion) = (system.mass_ratio(), &point.motion);
    let sine = motion.oscillator_amplitude + eps * motion.reactance;
    let regime = match cavity.theory.is_symmetric() && motion.deviation == 0.0 {
        true => Regime::TwoSymmetric,
        false => Regime::TwoAsymmetric,
    };
    let rms = libm::hypot(sine, eps * motion.resistance) * FRAC_1_SQRT_2;
    Estimate { regime: Some(regime), ..Estimate::steady(rms) }
}

/// That of the averaged flow's largest stable amplitude with impacts, in any regime: the first harmonic of `v - eps y`; or
/// else of its modulated cycle, whose scatter is what is not known of the averages between captures.
///
/// # Errors
/// [`StudyError::Analysis`] where the theory cannot be evaluated.
pub fn averaged_flow(system: &System) -> Result<Estimate, StudyError> {
    // The curve is that of an ideal cavity.
    if !system.cavity().is_ideal() {
        return Ok(Estimate::none(WhyNoAnswer::RealCavity));
    }
    let averages = Averages::of(system)?;
    let Averages { curve, states, .. } = &averages;
    let moving = |state: &&SteadyState| state.stable && state.regime != Regime::AtRest;
    let answer = states.iter().rfind(moving).and_then(|state| {
        let ([resistance, reactance], _) = curve.branches[state.branch].forces(state.amplitude)?;
        let eps = system.mass_ratio();
        let [sine, cosine] = [state.amplitude + eps * reactance, eps * resistance];
        Some(Estimate {
            rms: Some(libm::hypot(sine, cosine) * FRAC_1_SQRT_2),
            impacts_per_period: Some(state.impacts_per_period),
            regime: Some(state.regime),
            ..Estimate::default()
        })
    });
    if let Some(answer) = answer {
        return Ok(answer);
    }
    // A capture that lasts ends the modulation.
    let cycle =
        averages.with_cycle(system).cycle.filter(|cycle| cycle.lasting_share == 0.0).map(|cycle| {
            Estimate {
                rms: Some(cycle.rms),
                scatter: Some(cycle.rms_error / cycle.rms),
                impacts_per_period: Some(cycle.impacts_per_period),
                regime: Some(Regime::StronglyModulated),
                ..Estimate::default()
            }
        });
    Ok(cycle.unwrap_or_else(|| Estimate::none(WhyNoAnswer::NoStableAmplitude)))
}

/// That of the exact orbit with two impacts per period that attracts, to [`ORBIT_ROUNDING`].
pub fn symmetric_orbit(system: &System) -> Estimate {
    let answer = || {
        let cycle = steady_orbit(system)?.orbit.cycle;
        let answer = Estimate::steady(Measures::of(system, &cycle).ok()?.rms);
        let symmetric = matches!(cycle.closure, Closure::Mirrors { .. });
        let regime = if symmetric { Regime::TwoSymmetric } else { Regime::TwoAsymmetric };
        Some(Estimate { regime: Some(regime), ..answer })
    };
    answer().unwrap_or_else(|| Estimate::none(WhyNoAnswer::NoStableOrbit))
}

/// The averages of so many periods from here, with their scatter between blocks.
pub fn measured(simulation: &mut Simulation, periods: u64) -> Option<Estimate> {
    let system = *simulation.system();
    let mut measurement = Measurement::begin(&system, simulation.state());
    let mut log = ImpactLog::of_the_last(LAST_IMPACTS);
    let blocks = BLOCKS.min(periods).max(1);
    let (mut means, mut before) = (Vec::new(), [0.0; 2]);
    for block in 1..=blocks {
        let length = periods * block / blocks - measurement.statistics().periods();
        let observer = &mut (&mut measurement, &mut log);
        if simulation.run(length, IMPACT_LIMIT, observer) != Stop::EndTime {
            return None;
        }
        let statistics = measurement.statistics();
        let so_far = statistics.periods() as f64;
        let sums = [statistics.rms() * statistics.rms() * so_far, statistics.impacts() as f64];
        means.push([0, 1].map(|k| (sums[k] - before[k]) / length as f64));
        before = sums;
    }
    let statistics = measurement.statistics();
    let regime = classify(statistics, &log.impacts, None, system.period()).regime;
    let averages = Estimate::averaged(statistics.rms(), statistics.impacts_per_period(), &means);
    Some(Estimate { regime: Some(regime), ..averages })
}

/// Impacts that are kept of a run: enough to name its regime.
const LAST_IMPACTS: usize = 20_000;

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
