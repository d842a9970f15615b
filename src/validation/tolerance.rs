//! How wrong the leading-order theory may be.

use crate::analysis::neglected_at_leading_order;
use crate::regimes::Regime;
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
    neglected_at_leading_order(system.mass_ratio(), system.detuning(), system.damping())
}

/// Errors of the asymptotics that the averaged flow may have: the terms that any slow flow neglects; averages that take
/// some periods to settle, in which the amplitude moves by as much; and the next harmonics of a motion that does
/// not repeat after one period. Twenty systems stay within (test `forced_amplitudes_of_twenty_systems`).
const AVERAGES: f64 = 3.0;
/// Relative error of a modulated cycle beyond that: when the absorber is captured again depends on how it left, of which
/// the flow knows the average (test `modulated_cycles_are_the_simulated_ones`).
const RECAPTURE: f64 = 0.05;

/// Expected size of the averaged flow's error in a regime: `3 eps (2 + abs(sigma) + lambda)`, and 5 % where captures
/// come at random.
pub fn averages_error(system: &System, regime: Option<Regime>) -> f64 {
    let modulated = regime == Some(Regime::StronglyModulated);
    AVERAGES * asymptotic_error(system) + if modulated { RECAPTURE } else { 0.0 }
}
