//! The modulated cycle of the slow flow: captured on the manifold's stable branch down to the fold, free of it until it
//! is captured again ([`Recapture`]).
//!
//! The slow motion is the complex number `z = c exp(i eta)`, whose rate is linear but for the absorber's force. The number of
//! captures that are expected before one comes is exponentially distributed: cycles take its quantiles in turn.

use std::f64::consts::TAU;

use serde::Serialize;

use super::curve::symmetric_forces;
use super::recapture::{Recapture, Uncaptured};
use crate::equations::dissipation::{COSINE_RATE, SINE_RATE};
use crate::numerics::scatter::twice_standard_error;
use crate::operation_count;
use crate::system::System;

/// Largest relative change of the slow motion in a step of the midpoint rule: its error, a part of 20,000, is far below
/// the asymptotic one.
const LARGEST_STEP: f64 = 0.05;
/// Largest part of an expected capture in a step.
const LARGEST_PART: f64 = 0.25;
/// Steps of a stretch that does not end: of a flow that has settled.
const SETTLED: u32 = 5000;
/// Captures that are measured.
const CAPTURES: u32 = 60;
/// The golden ratio less 1: its multiples less their integers spread evenly between 0 and 1.
const GOLDEN: f64 = 0.618_033_988_749_895;

/// A strongly modulated response as the slow flow has it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ModulatedCycle {
    /// Smallest and largest amplitude of `v = x + eps y`, `C/b`, with the forces that the absorber has on average.
    pub amplitudes: [f64; 2],
    /// Two standard deviations of the largest amplitude from cycle to cycle, over the clearance: what the irregular motion
    /// between captures makes of it, of the order of the root of the mass ratio.
    pub largest_scatter: f64,
    /// Root mean square displacement of the oscillator over the clearance.
    pub rms: f64,
    /// Twice its standard error from averages between captures; the error of the theory, of first order in the mass
    /// ratio, is not in it.
    pub rms_error: f64,
    /// Impacts per period.
    pub impacts_per_period: f64,
    /// Share of the time in 1:1 resonance.
    pub captured_share: f64,
    /// Length of a capture in excitation periods.
    pub captured_periods: f64,
    /// Length of a cycle in excitation periods.
    pub periods: f64,
    /// Share of captures that last, because they come at a moment from which the flow settles: if there are any, the
    /// modulation ends in steady 1:1 resonance sooner or later.
    pub lasting_share: f64,
}

impl ModulatedCycle {
    /// That of a system; none where the flow settles before it is captured, where every capture lasts, or where it leaves
    /// the range of [`Recapture`].
    pub fn of(system: &System, recapture: &Recapture) -> Option<Self> {
        let cycles = |places: &[Uncaptured]| Walk { system, recapture, places }.cycles();
        let (found, count) = cycles(&recapture.places)?;
        let groups = recapture.groups.iter().filter_map(|places| cycles(places));
        let rms: Vec<f64> = groups.map(|(one, _)| one.rms()).collect();
        let each = f64::from(count) * system.mass_ratio() * system.period();
        Some(Self {
            amplitudes: found.range,
            largest_scatter: 2.0 * found.variance_at_largest.sqrt(),
            rms: found.rms(),
            rms_error: twice_standard_error(&rms),
            impacts_per_period: found.impacts / found.time,
            captured_share: found.captured / found.time,
            captured_periods: found.captured / each,
            periods: found.time / each,
            lasting_share: 1.0 - f64::from(count) / f64::from(CAPTURES),
        })
    }
}

/// The flow of a system with what the absorber does between captures.
struct Walk<'a> {
    system: &'a System,
    recapture: &'a Recapture,
    places: &'a [Uncaptured],
}

/// Sums over slow time.
#[derive(Clone, Copy)]
struct CycleSums {
    range: [f64; 2],
    /// Of the amplitude since the last capture, and where it was largest.
    variance: f64,
    variance_at_largest: f64,
    squares: f64,
    impacts: f64,
    captured: f64,
    time: f64,
}

impl CycleSums {
    const NONE: Self = Self {
        range: [f64::INFINITY, 0.0],
        variance: 0.0,
        variance_at_largest: 0.0,
        squares: 0.0,
        impacts: 0.0,
        captured: 0.0,
        time: 0.0,
    };

    fn rms(&self) -> f64 {
        (0.5 * self.squares / self.time).sqrt()
    }

    /// Adds a step at an amplitude `c` with what the absorber does there.
    fn add(&mut self, step: f64, place: &Uncaptured, c: f64, mass_ratio: f64, captured: bool) {
        let [resistance, reactance] = place.forces;
        // The oscillator's displacement is v - eps y.
        let [sine, cosine] = [c + mass_ratio * reactance, mass_ratio * resistance];
        // A period's force moves the amplitude by half of it times the slow time of a period.
        self.variance += 0.5 * TAU * mass_ratio * 0.5 * step * place.scatter;
        if c > self.range[1] {
            self.variance_at_largest = self.variance;
        }
        self.range = [self.range[0].min(c), self.range[1].max(c)];
        self.squares += step * (sine * sine + cosine * cosine);
        self.impacts += step * place.impacts;
        self.captured += if captured { step } else { 0.0 };
        self.time += step;
    }
}

impl Walk<'_> {
    /// Cycles after cycles, the first left out; and how many of the captures do not last.
    fn cycles(&self) -> Option<(CycleSums, u32)> {
        let fold = self.recapture.manifold.fold.oscillator_amplitude;
        let (mut sums, mut count) = (CycleSums::NONE, 0);
        let mut z = [fold, 0.0];
        for k in 0..=CAPTURES {
            let before = sums;
            sums.variance = 0.0;
            let expected = libm::log1p(-(f64::from(k) + 0.5) * GOLDEN % 1.0);
            z = self.free(z, -expected, &mut sums)?;
            match self.captured(z, &mut sums)? {
                Some(left) => (z, count) = (left, count + 1),
                None => (z, sums) = ([fold, 0.0], before),
            }
            if k == 0 {
                (sums, count) = (CycleSums::NONE, 0);
            }
        }
        (count > 0).then_some((sums, count))
    }

    /// Free of the stable branch until so many captures are expected since it was above the fold.
    fn free(&self, mut z: [f64; 2], expected: f64, sums: &mut CycleSums) -> Option<[f64; 2]> {
        let fold = self.recapture.manifold.fold.oscillator_amplitude;
        let cycle = TAU * self.system.mass_ratio();
        let mut waited = 0.0;
        for _ in 0..SETTLED {
            let c = libm::hypot(z[0], z[1]);
            if waited >= expected && c > fold {
                return Some(z);
            }
            let place = self.place(c, false)?;
            let step = self.step(c, &place).min(LARGEST_PART * cycle / place.rate);
            sums.add(step, &place, c, self.system.mass_ratio(), false);
            waited += place.rate * step / cycle;
            z = self.moved(z, step, false, &place)?;
        }
        None
    }

    /// On the stable branch down to the fold, and where it leaves there; nothing where it stays.
    fn captured(&self, mut z: [f64; 2], sums: &mut CycleSums) -> Option<Option<[f64; 2]>> {
        let fold = self.recapture.manifold.fold.oscillator_amplitude;
        for _ in 0..SETTLED {
            let c = libm::hypot(z[0], z[1]);
            let place = self.place(c, true)?;
            let mut step = self.step(c, &place);
            let next = self.moved(z, step, true, &place)?;
            let beyond = libm::hypot(next[0], next[1]);
            // The last step ends at the fold.
            step *= if beyond < fold { (c - fold) / (c - beyond) } else { 1.0 };
            sums.add(step, &place, c, self.system.mass_ratio(), true);
            if beyond < fold {
                return self.moved(z, step, true, &place).map(Some);
            }
            z = next;
        }
        Some(None)
    }

    /// What the absorber does at an amplitude, on the stable branch or free of it. None where neither is known.
    fn place(&self, amplitude: f64, captured: bool) -> Option<Uncaptured> {
        let manifold = &self.recapture.manifold;
        if !captured {
            return Recapture::at(self.places, amplitude);
        }
        // A step may try an amplitude just below the fold.
        let fold = manifold.fold;
        let ratio = manifold.stable_absorber(amplitude);
        let ratio = ratio.unwrap_or(fold.absorber_amplitude);
        let amplitude = amplitude.max(fold.oscillator_amplitude);
        let known = amplitude <= self.recapture.largest_captured;
        let forces = symmetric_forces(manifold, amplitude, ratio, ratio - 1.0);
        known.then_some(Uncaptured { amplitude, forces, scatter: 0.0, rate: 0.0, impacts: 2.0 })
    }

    /// The step by the rates that are there.
    fn step(&self, c: f64, place: &Uncaptured) -> f64 {
        let [resistance, reactance] = place.forces;
        let forces = self.system.forcing_per_clearance() + resistance.abs() + reactance.abs();
        let own = self.system.damping() + 2.0 * self.system.detuning().abs();
        2.0 * LARGEST_STEP / (own + forces / c.max(f64::MIN_POSITIVE))
    }

    fn rates(&self, [cosine, sine]: [f64; 2], place: &Uncaptured) -> [f64; 2] {
        operation_count::note(4);
        let (lambda, sigma) = (self.system.damping(), self.system.detuning());
        let gamma = self.system.forcing_per_clearance();
        let [resistance, reactance] = place.forces;
        let c = libm::hypot(cosine, sine).max(f64::MIN_POSITIVE);
        [
            COSINE_RATE.at([lambda, sigma, resistance, reactance, c, cosine, sine]),
            SINE_RATE.at([lambda, sigma, gamma, resistance, reactance, c, cosine, sine]),
        ]
    }

    /// A step of the midpoint rule.
    fn moved(
        &self,
        z: [f64; 2],
        step: f64,
        captured: bool,
        place: &Uncaptured,
    ) -> Option<[f64; 2]> {
        let by = |rates: [f64; 2], step: f64| [0, 1].map(|k| z[k] + step * rates[k]);
        let middle = by(self.rates(z, place), 0.5 * step);
        let there = self.place(libm::hypot(middle[0], middle[1]), captured)?;
        Some(by(self.rates(middle, &there), step))
    }
}
