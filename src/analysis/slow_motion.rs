//! The slow flow (18) followed in time on the stable branch of the manifold (16), until it settles
//! or leaves the branch.
//!
//! Unknowns are the oscillator's amplitude `C` and the excitation's phase `eta`; on the branch
//!
//! `beta = (1 + sqrt((1 + R) C^2 - R)) / (1 + R)`, `cos Theta = (1 - beta)/C`,
//! `sin Theta = (2/pi) rho beta / C`, `E = 8 beta/pi^2` (lengths over the clearance),
//! `dC/dtau1 = (-lambda C - E sin Theta + gamma sin eta)/2`,
//! `deta/dtau1 = sigma + (gamma cos eta - E cos Theta)/(2 C)`, `tau1 = eps tau`.
//!
//! These are the stated equations, not the derived flow in `B`, whose rates are infinite at the fold.
//! At the fold, `C^2 = R/(1 + R)`, the branch ends: the motion leaves 1:1 resonance in fast time, and
//! the slow flow does not say where it returns.
//!
//! Integrated by the classical Runge-Kutta method with a fixed step. Its fixed points are those of the
//! flow, so a motion that settles has their accuracy whatever the step.

use std::f64::consts::{FRAC_2_PI, PI};

use super::Manifold;
use crate::operation_count::{self, ELEMENTARY};
use crate::system::System;

/// Largest change of phase, or of the logarithm of an amplitude, in a step: the local error of the
/// method is some `0.1^5/120`, far below the asymptotic error.
const LARGEST_STEP: f64 = 0.1;
/// Rate, over the fastest rate of the flow, below which it has settled: what is left of the transient
/// moves no printed digit.
const SETTLED: f64 = 1e-9;

/// A point of the slow motion on the stable branch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlowPoint {
    /// `C/b`.
    pub oscillator_amplitude: f64,
    /// `B/b`.
    pub absorber_amplitude: f64,
    /// `eta`, radians.
    pub eta: f64,
    /// `Theta`, radians.
    pub absorber_phase: f64,
}

/// What the slow motion came to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SlowEnd {
    /// It settled at a point.
    Settles(SlowPoint),
    /// It is still moving when its time is over; this is its average amplitude in the second half.
    Moving(SlowPoint),
    /// It reached the fold, after so many excitation periods, and left the manifold.
    LeavesAtFold {
        /// Excitation periods from the start.
        periods: f64,
    },
}

/// The slow flow of a system on the stable branch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlowFlow {
    damping: f64,
    detuning: f64,
    forcing: f64,
    restitution_ratio: f64,
    curvature: f64,
    /// `tau1` of one excitation period.
    period: f64,
}

impl SlowFlow {
    /// The flow of `system`, whose restitution `manifold` belongs to.
    pub fn of(system: &System, manifold: &Manifold) -> Self {
        Self {
            damping: system.damping(),
            detuning: system.detuning(),
            forcing: system.forcing_per_clearance(),
            restitution_ratio: manifold.restitution_ratio,
            curvature: manifold.curvature,
            period: system.mass_ratio() * system.period(),
        }
    }

    /// The point of the stable branch with amplitude `C/b` and phase `eta`; `None` below the fold.
    pub fn point(&self, oscillator: f64, eta: f64) -> Option<SlowPoint> {
        let grown = 1.0 + self.curvature;
        let root = grown * oscillator * oscillator - self.curvature;
        if root.is_nan() || root < 0.0 {
            return None;
        }
        let absorber = (1.0 + root.sqrt()) / grown;
        let (sine, cosine) = self.absorber_sides(absorber);
        Some(SlowPoint {
            oscillator_amplitude: oscillator,
            absorber_amplitude: absorber,
            eta,
            absorber_phase: libm::atan2(sine, cosine),
        })
    }

    /// `C sin Theta` and `C cos Theta`, (15) and (14).
    fn absorber_sides(&self, absorber: f64) -> (f64, f64) {
        (FRAC_2_PI * self.restitution_ratio * absorber, 1.0 - absorber)
    }

    /// Rates of `C` and `eta` in `tau1`, (18); `None` below the fold.
    pub fn rates(&self, [oscillator, eta]: [f64; 2]) -> Option<[f64; 2]> {
        operation_count::note(2 * ELEMENTARY + 28);
        let grown = 1.0 + self.curvature;
        let root = grown * oscillator * oscillator - self.curvature;
        if root.is_nan() || root < 0.0 {
            return None;
        }
        let absorber = (1.0 + root.sqrt()) / grown;
        let harmonic = 8.0 * absorber / (PI * PI);
        let (sine, cosine) = self.absorber_sides(absorber);
        let (sin, cos) = libm::sincos(eta);
        let [pull, turn] = [harmonic * sine / oscillator, harmonic * cosine / oscillator];
        Some([
            0.5 * (-self.damping * oscillator - pull + self.forcing * sin),
            self.detuning + 0.5 * (self.forcing * cos - turn) / oscillator,
        ])
    }

    /// The fastest rate that the flow can have at amplitude 1.
    fn fastest(&self) -> f64 {
        1.0 + self.damping + self.detuning.abs() + self.forcing
    }

    /// Follows the flow for so many excitation periods from `start`, and stops early where it has
    /// settled.
    pub fn follow(&self, start: SlowPoint, periods: u64) -> SlowEnd {
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
