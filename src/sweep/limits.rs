//! Where the exact symmetric 1:1 orbit begins and ceases to attract, over the frequencies of a sweep.

use crate::case::Case;
use crate::executor::Executor;
use crate::orbits::Limit;
use crate::orbits::boundaries::over_frequency;
use crate::validation::tolerance::has_resonance;

/// Frequencies at which the limits are solved for.
const FREQUENCIES: u32 = 32;

/// A limit at one frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct StabilityLimit {
    /// Of the excitation to the oscillator's natural one.
    pub frequency_ratio: f64,
    /// What happens there; its clearance is over the case's own.
    pub limit: Limit,
}

/// The limits at some frequencies from the first to the last of an axis, in Hz, or as ratios of a reduced case;
/// none where the oscillator has no resonance.
pub fn stability_limits(
    case: &Case,
    frequencies: &[f64],
    on: &dyn Executor,
) -> Vec<StabilityLimit> {
    let (system, units) = (case.system(), case.units());
    let ([first, .., last], true) = (frequencies, has_resonance(&system)) else {
        return Vec::new();
    };
    let ratio = |k: u32| {
        let frequency = first + (last - first) * (f64::from(k) + 0.5) / f64::from(FREQUENCIES);
        units.frequency_ratio(frequency)
    };
    let found = over_frequency(&system, &(0..FREQUENCIES).map(ratio).collect::<Vec<_>>(), on);
    let limits = found.into_iter().flat_map(|at| {
        let limits = at.symmetric.limits.into_iter().filter(|limit| limit.bounds_stability);
        limits.map(move |limit| StabilityLimit { frequency_ratio: at.frequency_ratio, limit })
    });
    limits.collect()
}
