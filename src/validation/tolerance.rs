//! How wrong the leading-order theory may be.

use crate::system::System;

/// Mass ratio above which the expansion in `eps` is out of its depth: neglected terms reach ten
/// percent.
pub const LARGEST_MASS_RATIO: f64 = 0.1;
/// Distance of the frequency ratio from 1 above which "near resonance" no longer holds.
pub const LARGEST_OFFSET: f64 = 0.2;

/// Damping `eps lambda`, twice the damping ratio, above which an oscillator has no resonance that
/// the theory could speak of.
pub const LARGEST_DAMPING: f64 = 0.5;

/// Relative error at which a theory says nothing: a prediction that may be off by half of itself.
pub const SAYS_NOTHING: f64 = 0.5;

/// Whether an oscillator rings enough for boundaries of 1:1 resonance to mean anything.
pub fn has_resonance(system: &System) -> bool {
    system.mass_ratio() * system.damping() <= LARGEST_DAMPING
}

/// Expected size of the theory's error: `eps (2 + abs(sigma) + lambda)`.
///
/// The expansion (6) neglects terms that are `eps` times the kept ones, with coefficients made of 1,
/// `sigma` and `lambda`. Measured against simulation, the errors of `C`, `B` and `eta` fall in
/// proportion to `eps` and stay below this sum (test `asymptotic_error`).
pub fn asymptotic_error(system: &System) -> f64 {
    system.mass_ratio() * (2.0 + system.detuning().abs() + system.damping())
}
