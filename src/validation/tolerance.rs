//! How wrong the leading-order theory may be.

use serde::Serialize;

use super::Verdict;
use crate::system::System;

/// Mass ratio above which the expansion in `eps` is out of its depth: neglected terms reach ten
/// percent.
pub const LARGEST_MASS_RATIO: f64 = 0.1;
/// Distance of the frequency ratio from 1 above which "near resonance" no longer holds.
pub const LARGEST_OFFSET: f64 = 0.2;

/// Damping `eps lambda`, twice the damping ratio, above which an oscillator has no resonance that
/// the theory could speak of.
pub const LARGEST_DAMPING: f64 = 0.5;

/// Whether an oscillator rings enough for boundaries of 1:1 resonance to mean anything.
pub fn has_resonance(system: &System) -> bool {
    system.mass_ratio() * system.damping() <= LARGEST_DAMPING
}

/// A tolerance with its reason.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Tolerance {
    /// Relative for lengths, in radians for angles, 0 for outcomes in words.
    pub value: f64,
    /// Why this much.
    pub reason: String,
}

/// Relative error at which a theory says nothing: a prediction that may be off by half of itself.
pub const SAYS_NOTHING: f64 = 0.5;

impl Tolerance {
    /// The verdict on a difference between prediction and observation; none where the tolerance is so
    /// wide that agreement would mean nothing.
    pub fn judge(&self, difference: f64) -> Verdict {
        if self.value > SAYS_NOTHING {
            return Verdict::Undecided;
        }
        Verdict::of(difference.abs() <= self.value)
    }
}

/// Expected size of the theory's error: `eps (2 + abs(sigma) + lambda)`.
///
/// The expansion (6) neglects terms that are `eps` times the kept ones, with coefficients made of 1,
/// `sigma` and `lambda`. Measured against simulation, the errors of `C`, `B` and `eta` fall in
/// proportion to `eps` and stay below this sum (test `asymptotic_error`).
pub fn asymptotic_error(system: &System) -> f64 {
    system.mass_ratio() * (2.0 + system.detuning().abs() + system.damping())
}

/// What a reason adds where an error is too wide for a verdict.
pub(super) fn beyond(error: f64) -> &'static str {
    if error > SAYS_NOTHING { "; so wide that the theory says nothing" } else { "" }
}

/// The tolerance on amplitudes and phases.
pub fn asymptotic(system: &System) -> Tolerance {
    Tolerance {
        value: asymptotic_error(system),
        reason: format!(
            "terms neglected by the expansion: ε (2 + |σ| + λ){}",
            beyond(asymptotic_error(system))
        ),
    }
}

/// For closed forms of the full system, which only rounding separates from simulation.
pub fn exact() -> Tolerance {
    Tolerance { value: 1e-9, reason: "closed form of the full system, rounding only".into() }
}

/// For outcomes that either happen or do not.
pub fn outcome(reason: impl Into<String>) -> Tolerance {
    Tolerance { value: 0.0, reason: reason.into() }
}
