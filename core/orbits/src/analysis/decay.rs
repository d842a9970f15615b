//! Free decay in closed form: how long, how far, and where the energy goes.
//!
//! Without excitation a captured motion runs down the manifold's stable branch, from symmetry breaking at the
//! most, and leaves it at the fold, `C = b sqrt(R/(1 + R))`: there capture ends, and what is left decays with the
//! oscillator's own damping alone. [`crate::equations::free_decay`] integrates the slow flow (18) between two
//! amplitudes. The error is of first order in the mass ratio; the distance to the fold must exceed rounding.

use serde::Serialize;

use super::Manifold;
use crate::equations::free_decay::{
    ARCTANGENT, ARCTANGENT_UNDAMPED, DECAY_RATE, DECAY_TIME, IMPACT_COEFFICIENT, IMPACT_ENERGY,
    QUOTIENT, RATE_COEFFICIENT, RATE_ROOT,
};
use crate::numerics::bracket::bisected;
use crate::system::System;

/// What became of the energy during a decay, as shares of that at its beginning. They add up to 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct EnergyShares {
    /// Taken by impacts.
    pub impacts: f64,
    /// Taken by the oscillator's damper.
    pub damper: f64,
    /// Left at the end.
    pub residual: f64,
}

/// The free decay of a system in 1:1 resonance; its excitation does not matter.
///
/// Table 1 of Li, Seguy, Berlioz (2016), from 0.7 to 0.2 clearances:
///
/// ```
/// # use vinesink_core::system::{Cavity, Excitation, Parameters, System};
/// # let system = System::new(Parameters {
/// #     mass_ratio: 0.0076775, damping: 1.799, restitution: 0.6, frequency_ratio: 1.0,
/// #     forcing_per_clearance: 0.0, excitation: Excitation::BaseDisplacement,
/// #     cavity: Cavity::IDEAL,
/// # })?;
/// use vinesink_core::analysis::FreeDecay;
///
/// let decay = FreeDecay::of(&system);
/// let slow_time = decay.time(0.7, 0.2).expect("both are on the stable branch");
/// let periods = slow_time / system.mass_ratio() / std::f64::consts::TAU;
/// assert!((periods - 15.19).abs() < 0.005);
/// // Impacts take 39 % of the energy, the damper most of the rest; 5 % is left when capture ends.
/// let shares = decay.shares(0.7, decay.residual_amplitude()).expect("on the stable branch");
/// assert!((shares.impacts - 0.387).abs() < 5e-4 && (shares.residual - 0.050).abs() < 5e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeDecay {
    manifold: Manifold,
    largest: f64,
    damping: f64,
    impact_coefficient: f64,
    rate_coefficient: f64,
    rate_root: f64,
}

/// A stretch of the stable branch, by `beta = B/b` at its ends.
#[derive(Debug, Clone, Copy)]
struct BranchStretch {
    ratios: [f64; 2],
    rates: [f64; 2],
    arctangent: f64,
}

impl FreeDecay {
    /// That of a system.
    pub fn of(system: &System) -> Self {
        let (damping, manifold) = (system.damping(), Manifold::of(system.restitution()));
        let impact_coefficient = IMPACT_COEFFICIENT.at([manifold.restitution_ratio]);
        let given = [damping, manifold.curvature, impact_coefficient];
        Self {
            manifold,
            largest: manifold.largest_stable_motion(),
            damping,
            impact_coefficient,
            rate_coefficient: RATE_COEFFICIENT.at(given),
            rate_root: RATE_ROOT.at(given),
        }
    }

    /// The largest amplitude `C/b` that this holds for: two symmetric impacts per cycle break their symmetry above.
    pub fn largest_amplitude(&self) -> f64 {
        self.largest
    }

    /// The amplitude `C/b`, over the clearance, at which capture ends, the manifold's fold.
    pub fn residual_amplitude(&self) -> f64 {
        self.manifold.fold.oscillator_amplitude
    }

    /// Slow time `tau_1 = eps tau`, fast time times the mass ratio, from one amplitude `C/b` down to another. None where one
    /// of them is not on the stable branch or the first is the smaller; infinite where nothing takes energy.
    pub fn time(&self, from: f64, to: f64) -> Option<f64> {
        let BranchStretch { rates: [before, after], arctangent, .. } = self.stretch(from, to)?;
        let (curvature, impacts) = (self.manifold.curvature, self.impact_coefficient);
        if self.rate_coefficient == 0.0 {
            return Some(if from == to { 0.0 } else { f64::INFINITY });
        }
        Some(DECAY_TIME.at([curvature, impacts, self.rate_coefficient, arctangent, before, after]))
    }

    /// The amplitude `C/b`, over the clearance, a slow time after another. None where the first is not on the stable branch,
    /// and once capture has ended.
    pub fn amplitude(&self, from: f64, slow_time: f64) -> Option<f64> {
        let to = self.residual_amplitude();
        let all = self.time(from, to)?;
        if slow_time.is_nan() || slow_time < 0.0 || slow_time > all {
            return None;
        }
        let late = |to: f64| self.time(from, to).map_or(f64::NAN, |time| time - slow_time);
        if self.rate_coefficient == 0.0 {
            return Some(from);
        }
        Some(bisected([to, from], late).unwrap_or(to))
    }

    /// Where the energy of an amplitude `C/b` has gone at a smaller one; as [`Self::time`].
    pub fn shares(&self, from: f64, to: f64) -> Option<EnergyShares> {
        let stretch = self.stretch(from, to)?;
        let ([begin, end], [before, after]) = (stretch.ratios, stretch.rates);
        let (lambda, curvature) = (self.damping, self.manifold.curvature);
        let (impacts, rate) = (self.impact_coefficient, self.rate_coefficient);
        let quotient = QUOTIENT.at([lambda, curvature, rate]);
        let all = from * from;
        let taken = if impacts == 0.0 {
            0.0
        } else {
            IMPACT_ENERGY.at([
                lambda,
                curvature,
                impacts,
                rate,
                quotient,
                stretch.arctangent,
                begin,
                end,
                before,
                after,
            ])
        };
        let residual = to * to / all;
        let impacts = taken / all;
        Some(EnergyShares { impacts, damper: 1.0 - residual - impacts, residual })
    }

    fn stretch(&self, from: f64, to: f64) -> Option<BranchStretch> {
        let within = to >= self.residual_amplitude() && to <= from;
        let within = within && from <= self.largest_amplitude();
        // Rounding may put the fold below itself.
        let ratio = |amplitude: f64| {
            let lowest = self.manifold.fold.absorber_amplitude;
            self.manifold.stable_absorber(amplitude).map_or(lowest, |ratio| ratio.max(lowest))
        };
        let ratios = [from, to].map(ratio);
        let [lambda, rate, root] = [self.damping, self.rate_coefficient, self.rate_root];
        let arctangent = if self.impact_coefficient == 0.0 {
            0.0 // Elastic impacts take nothing: its factor is 0.
        } else if root == 0.0 {
            ARCTANGENT_UNDAMPED.at([self.impact_coefficient, ratios[0], ratios[1]])
        } else {
            ARCTANGENT.at([lambda, rate, root, ratios[0], ratios[1]])
        };
        let rates = ratios.map(|ratio| DECAY_RATE.at([lambda, rate, ratio]));
        within.then_some(BranchStretch { ratios, rates, arctangent })
    }
}
