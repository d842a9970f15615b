//! The slow flow (18) followed in time on the stable branch of the manifold (16), until it settles
//! or leaves the branch.
//!
//! Unknowns are the oscillator's amplitude `C` and the excitation's phase `eta`; their rates are those of
//! [`crate::equations::slow_flow`] in `c_2 = C^2/b^2`, which stay finite at the fold, where that of `B` does not.
//! At the fold, `C^2 = R/(1 + R)`, the branch ends: the motion leaves 1:1 resonance in fast time, and
//! the slow flow does not say where it returns.
//!
//! Integrated by the classical Runge-Kutta method with a fixed step. Its fixed points are those of the
//! flow, so a motion that settles has their accuracy whatever the step.

use super::Manifold;
use super::motion::SlowVariables;
use crate::equations::slow_flow::{PHASE_RATE, SQUARE_RATE};
use crate::operation_count;
use crate::system::System;

/// Largest change of phase, or of the logarithm of an amplitude, in a step: the local error of the
/// method is some `0.1^5/120`, far below the asymptotic error.
const LARGEST_STEP: f64 = 0.1;
/// Rate, over the fastest rate of the flow, below which it has settled: what is left of the transient
/// moves no printed digit.
const SETTLED: f64 = 1e-9;

/// What the slow motion came to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SlowEnd {
    /// It settled at a point.
    Settles(SlowVariables),
    /// It is still moving when its time is over; this is its average amplitude in the second half.
    Moving(SlowVariables),
    /// It reached the fold, after so many excitation periods, and left the manifold.
    LeavesAtFold {
        /// Excitation periods from the start.
        periods: f64,
    },
}

/// The slow flow of a system on the stable branch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlowFlow {
    system: System,
    manifold: Manifold,
    /// `tau1` of one excitation period.
    period: f64,
}

impl SlowFlow {
    /// The flow of `system`, whose restitution `manifold` belongs to.
    pub fn of(system: &System, manifold: &Manifold) -> Self {
        let period = system.mass_ratio() * system.period();
        Self { system: *system, manifold: *manifold, period }
    }

    /// The point of the stable branch with amplitude `C/b` and phase `eta`; `None` below the fold.
    pub fn point(&self, oscillator: f64, eta: f64) -> Option<SlowVariables> {
        let absorber = self.manifold.stable_absorber(oscillator)?;
        Some(SlowVariables {
            oscillator_amplitude: oscillator,
            absorber_amplitude: absorber,
            eta,
            absorber_phase: self.manifold.absorber_phase(absorber, absorber - 1.0),
        })
    }

    /// Rates of `C/b` and `eta` in `tau1`; `None` below the fold.
    pub fn rates(&self, [oscillator, eta]: [f64; 2]) -> Option<[f64; 2]> {
        operation_count::note(4);
        let square = oscillator * oscillator;
        let absorber = self.manifold.stable_absorber(oscillator)?;
        let (lambda, sigma) = (self.system.damping(), self.system.detuning());
        let gamma = self.system.forcing_per_clearance();
        let rho = self.manifold.restitution_ratio;
        Some([
            SQUARE_RATE.at([lambda, rho, gamma, absorber, square, eta]) / (2.0 * oscillator),
            PHASE_RATE.at([sigma, gamma, absorber, absorber - 1.0, square, eta]),
        ])
    }

    /// The fastest rate that the flow can have at amplitude 1.
    fn fastest(&self) -> f64 {
        let forcing = self.system.forcing_per_clearance();
        1.0 + self.system.damping() + self.system.detuning().abs() + forcing
    }

    /// Follows the flow for so many excitation periods from `start`, and stops early where it has
    /// settled.
    pub fn follow(&self, start: SlowVariables, periods: u64) -> SlowEnd {
        let steps = (self.period * self.fastest() / LARGEST_STEP).ceil().max(1.0);
        let step = self.period / steps;
        let all = periods * steps as u64;
        let mut at = [start.oscillator_amplitude, start.eta];
        let mut sum = 0.0;
        for done in 0..all {
            let left = SlowEnd::LeavesAtFold { periods: done as f64 / steps };
            let Some(rates) = self.rates(at) else { return left };
            if rates.iter().all(|rate| rate.abs() < SETTLED * self.fastest()) {
                return self.point(at[0], at[1]).map_or(left, SlowEnd::Settles);
            }
            let Some(next) = self.step(at, rates, step) else { return left };
            at = next;
            sum += if 2 * done >= all { at[0] } else { 0.0 };
        }
        let mean = sum / all.div_ceil(2).max(1) as f64;
        self.point(mean, at[1])
            .map_or(SlowEnd::LeavesAtFold { periods: periods as f64 }, SlowEnd::Moving)
    }

    fn step(&self, at: [f64; 2], first: [f64; 2], step: f64) -> Option<[f64; 2]> {
        operation_count::note(26);
        let moved = |rates: [f64; 2], by: f64| [at[0] + by * rates[0], at[1] + by * rates[1]];
        let second = self.rates(moved(first, 0.5 * step))?;
        let third = self.rates(moved(second, 0.5 * step))?;
        let fourth = self.rates(moved(third, step))?;
        let mean = |k: usize| (first[k] + 2.0 * (second[k] + third[k]) + fourth[k]) / 6.0;
        Some(moved([mean(0), mean(1)], step))
    }
}
