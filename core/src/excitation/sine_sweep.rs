//! A structure whose excitation goes through a range of frequencies, flight by flight.
//!
//! An excitation `sin(phi(t))` with `phi' = 2 pi f(t)`: `f = f1 + k t` (hertz in a second) or `f = f1 2^(k t)`
//! (octaves in a time). It is cut into stretches, a period of `phi` each or a whole fraction of it, and each flown
//! exactly at the constant frequency that it has on average, so that phase and state are continuous and the phase is exact
//! at every cut. Between two cuts it is off by `2 pi d/(8 m^2)` at the most, always to the same side, with `d` the relative
//! change of the frequency in a period and `m` the stretches of the period: there are as many as keep that below
//! [`SineSweep::PHASE_ERROR`]. What it leaves of the force is a constant and a second harmonic, each at most that large
//! against the force. The velocity of a base displacement, which acts through the structure's damper only, jumps by `d/m`
//! at a cut.

use std::f64::consts::TAU;

use libm::{exp, log1p};

use crate::system::{InvalidParameter, Scales, System};

/// A range of frequencies and how fast it is gone through.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SineSweep {
    /// Frequency at the start, in Hz; a frequency ratio in a reduced case, whose time is `tau`.
    pub from: f64,
    /// Frequency at the end.
    pub to: f64,
    /// How fast it changes, above 0.
    pub rate: SweepRate,
    /// Frequency times time of a period: 1 of Hz and s, `2 pi` of a reduced case.
    pub turn: f64,
}

/// How fast a frequency changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SweepRate {
    /// Hz/s; frequency ratio in a fast time.
    Linear(f64),
    /// Octaves in a minute.
    Octaves(f64),
}

impl SineSweep {
    /// Largest relative change of the frequency in a period: in a faster sweep no period is like another.
    pub const LARGEST_CHANGE: f64 = 0.05;
    /// Largest error of the phase within a stretch, in radians.
    pub const PHASE_ERROR: f64 = 2e-4;
    /// Periods that a sweep has at least.
    pub const FEWEST: u64 = 10;

    /// The same range in the other direction.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self { from: self.to, to: self.from, ..*self }
    }

    /// The same, so many times as fast.
    #[must_use]
    pub fn faster(&self, factor: f64) -> Self {
        let rate = match self.rate {
            SweepRate::Linear(rate) => SweepRate::Linear(factor * rate),
            SweepRate::Octaves(rate) => SweepRate::Octaves(factor * rate),
        };
        Self { rate, ..*self }
    }

    /// The rate with its sign: in Hz/s, or as the growth rate `f'/f` in 1/s.
    fn signed(&self) -> SweepRate {
        let sign = if self.from > self.to { -1.0 } else { 1.0 };
        match self.rate {
            SweepRate::Linear(rate) => SweepRate::Linear(sign * rate),
            SweepRate::Octaves(rate) => {
                SweepRate::Octaves(sign * rate * std::f64::consts::LN_2 / 60.0)
            }
        }
    }

    /// The time after which so many periods of the excitation are over.
    pub fn time(&self, periods: f64) -> f64 {
        let n = self.turn * periods;
        match self.signed() {
            // f1 t + k t^2/2 = n
            SweepRate::Linear(k) => {
                2.0 * n / (self.from + (self.from * self.from + 2.0 * k * n).sqrt())
            }
            // f1 (exp(a t) - 1)/a = n
            SweepRate::Octaves(a) => log1p(a * n / self.from) / a,
        }
    }

    /// Phase over `2 pi` of the excitation at a time.
    pub fn turns(&self, time: f64) -> f64 {
        match self.signed() {
            SweepRate::Linear(k) => time * (self.from + 0.5 * k * time) / self.turn,
            SweepRate::Octaves(a) => self.from * (exp(a * time) - 1.0) / a / self.turn,
        }
    }

    /// Whole periods of the excitation.
    pub fn count(&self) -> u64 {
        let [from, to] = [self.from, self.to];
        let turns = match self.signed() {
            SweepRate::Linear(k) => (to - from) * (to + from) / (2.0 * k),
            SweepRate::Octaves(a) => (to - from) / a,
        };
        // Rounding takes no period away.
        (turns / self.turn * (1.0 + 1e-12)) as u64
    }

    /// Largest relative change of the frequency in a period: where it is lowest.
    pub fn fastest_change(&self) -> f64 {
        self.change(self.from.min(self.to))
    }

    /// Relative change of a frequency in a period.
    fn change(&self, frequency: f64) -> f64 {
        match self.signed() {
            SweepRate::Linear(k) => self.turn * k.abs() / (frequency * frequency),
            SweepRate::Octaves(a) => self.turn * a.abs() / frequency,
        }
    }

    /// The stretches in which it is flown, in order.
    pub fn stretches(&self, scales: &Scales) -> impl Iterator<Item = SweepStretch> + use<> {
        let (sweep, scales) = (*self, *scales);
        let frequency = move |begin: f64, end: f64| {
            let [from, to] = [begin, end].map(|periods| sweep.time(periods));
            sweep.turn * (end - begin) / (to - from)
        };
        (0..self.count()).flat_map(move |n| {
            let n = n as f64;
            let of_period = frequency(n, n + 1.0);
            let error = TAU * sweep.change(of_period) / 8.0;
            let parts = libm::ceil((error / Self::PHASE_ERROR).sqrt()).max(1.0);
            (0..parts as u32).map(move |k| {
                let [begin, end] = [k, k + 1].map(|k| f64::from(k) / parts);
                SweepStretch {
                    ratio: scales.frequency_ratio(frequency(n + begin, n + end)),
                    of_period: scales.frequency_ratio(of_period),
                    first: k == 0,
                    begins: TAU * (1.0 - 1.0 / parts),
                    lead: TAU * (end - 1.0),
                }
            })
        })
    }
}

/// A stretch of a sweep, at one frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SweepStretch {
    /// Its frequency ratio: that which it has on average.
    pub ratio: f64,
    /// That of the period that it belongs to.
    pub of_period: f64,
    /// Whether its period begins with it.
    pub first: bool,
    /// Phase of the system of [`Self::system`] at its beginning; at its end it is `2 pi`.
    pub begins: f64,
    /// What its phase at the end is ahead of a whole period.
    pub lead: f64,
}

impl SweepStretch {
    /// Fast time from its beginning to its end, a pure number.
    pub fn duration(&self) -> f64 {
        (TAU - self.begins) / self.ratio
    }

    /// The system that is flown in it.
    ///
    /// # Errors
    /// As [`System::new`].
    pub fn system(&self, system: &System) -> Result<System, InvalidParameter> {
        Ok(system.with_frequency_ratio(self.ratio)?.with_lead(self.lead))
    }
}
