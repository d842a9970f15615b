//! What turns dimensionless numbers into those of a design and back.
//!
//! Lengths are divided by the clearance `b`, time by `1/omega0` with `omega0 = sqrt(k1/m1)`, velocities by `b omega0`,
//! accelerations by `b omega0^2`, energies by `m1 omega0^2 b^2`. With `eps = m2/m1` the frequency ratio is
//! `Omega = 2 pi f/omega0`.

use std::f64::consts::TAU;

/// What turns dimensionless results back into the design's units: SI, or for a reduced design those of an
/// oscillator with m1 = k1 = 1, lengths in the unit of its own clearance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scales {
    /// Whether the units are those of SI.
    pub physical: bool,
    /// `b`.
    pub clearance: f64,
    /// `omega0 = sqrt(k1/m1)` in rad/s; 1 for a reduced design.
    pub natural_frequency: f64,
    /// `m1` in kg; 1 for a reduced design.
    pub oscillator_mass: f64,
}

impl Scales {
    /// Those of a reduced design whose clearance is 1.
    pub const REDUCED: Self =
        Self { physical: false, clearance: 1.0, natural_frequency: 1.0, oscillator_mass: 1.0 };

    /// A length given over the clearance.
    pub fn length(&self, over_clearance: f64) -> f64 {
        over_clearance * self.clearance
    }

    /// A length, over the clearance.
    pub fn over_clearance(&self, length: f64) -> f64 {
        length / self.clearance
    }

    /// The frequency of a frequency ratio `Omega`: in Hz, or the ratio itself for a reduced design.
    pub fn frequency(&self, ratio: f64) -> f64 {
        ratio * self.natural_frequency / self.turn()
    }

    /// The frequency ratio `Omega` of a frequency.
    pub fn frequency_ratio(&self, frequency: f64) -> f64 {
        self.turn() * frequency / self.natural_frequency
    }

    /// What frequencies are counted in, rad: turns, or those of the natural frequency.
    fn turn(&self) -> f64 {
        if self.physical { TAU } else { 1.0 }
    }

    /// The time of a fast time `tau`.
    pub fn time(&self, tau: f64) -> f64 {
        tau / self.natural_frequency
    }

    /// The velocity of one in clearances per fast time.
    pub fn velocity(&self, dimensionless: f64) -> f64 {
        dimensionless * (self.clearance * self.natural_frequency)
    }

    /// The acceleration of one in clearances per fast time squared.
    pub fn acceleration(&self, dimensionless: f64) -> f64 {
        self.velocity(dimensionless) * self.natural_frequency
    }

    /// The energy of one per unit `m1` with lengths over the clearance and fast time, so the factor is
    /// `m1 omega0^2 b^2`.
    pub fn energy(&self, dimensionless: f64) -> f64 {
        let speed = self.clearance * self.natural_frequency;
        dimensionless * self.oscillator_mass * speed * speed
    }
}
