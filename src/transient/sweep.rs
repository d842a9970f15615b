//! A structure whose excitation goes through a range of frequencies, flight by flight.
//!
//! An excitation `sin(phi(t))` with `phi' = 2 pi f(t)`: `f = f1 + k t` (hertz in a second) or `f = f1 2^(k t)`
//! (octaves in a time). It is cut into its periods, `phi` from `2 pi n` to `2 pi (n + 1)`, and each flown exactly at the
//! constant frequency that it has on average, so that phase and state are continuous and the phase is exact at every
//! cut. Between two cuts it is off by `2 pi d/8` at the most, with `d` the relative change of the frequency in a
//! period, always to the same side: the amplitude of its first harmonic by the square of that, below 1e-3 at
//! `d` = 5 %. The velocity of a base displacement, which acts through the structure's damper only, jumps by `d` at
//! a cut.

use libm::{exp, log1p};

use crate::case::Scales;
use crate::simulation::{Measurement, Simulation, StartError, Stop};
use crate::system::{State, System};

/// A range of frequencies and how fast it is gone through.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SineSweep {
    /// Frequency at the start, in Hz.
    pub from: f64,
    /// Frequency at the end, in Hz.
    pub to: f64,
    /// How fast it changes, above 0.
    pub rate: SweepRate,
}

/// How fast a frequency changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SweepRate {
    /// Hz/s.
    Linear(f64),
    /// Octaves in a minute.
    Octaves(f64),
}

impl SineSweep {
    /// Largest relative change of the frequency in a period: see the head of this file.
    pub const LARGEST_CHANGE: f64 = 0.05;
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

    /// The time in s after which so many periods of the excitation are over.
    pub fn time(&self, periods: f64) -> f64 {
        match self.signed() {
            // f1 t + k t^2/2 = n
            SweepRate::Linear(k) => {
                2.0 * periods / (self.from + (self.from * self.from + 2.0 * k * periods).sqrt())
            }
            // f1 (exp(a t) - 1)/a = n
            SweepRate::Octaves(a) => log1p(a * periods / self.from) / a,
        }
    }

    /// Phase over `2 pi` of the excitation at a time in s.
    pub fn turns(&self, time: f64) -> f64 {
        match self.signed() {
            SweepRate::Linear(k) => time * (self.from + 0.5 * k * time),
            SweepRate::Octaves(a) => self.from * (exp(a * time) - 1.0) / a,
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
        (turns * (1.0 + 1e-12)) as u64
    }

    /// Largest relative change of the frequency in a period: where it is lowest.
    pub fn fastest_change(&self) -> f64 {
        let lowest = self.from.min(self.to);
        match self.signed() {
            SweepRate::Linear(k) => k.abs() / (lowest * lowest),
            SweepRate::Octaves(a) => a.abs() / lowest,
        }
    }

    /// The frequency ratio of each period: that which it has on average.
    pub fn frequencies(&self, scales: &Scales) -> impl Iterator<Item = f64> + use<> {
        let (sweep, scales) = (*self, *scales);
        (0..self.count()).map(move |n| {
            let [begin, end] = [n as f64, (n + 1) as f64].map(|periods| sweep.time(periods));
            scales.frequency_ratio(1.0 / (end - begin))
        })
    }
}

/// What a structure did on its way through a range of frequencies.
#[derive(Debug, Clone, PartialEq)]
pub struct Passage {
    /// Of each period of the excitation its frequency ratio and the structure's largest displacement in it.
    pub envelope: Vec<[f64; 2]>,
    /// Impacts.
    pub impacts: u64,
    /// Largest relative speed of one of them, over the clearance in fast time.
    pub impact_speed: f64,
    /// Largest part of a period's energy that its balance leaves open: rounding.
    pub residual: f64,
    /// Largest displacement of absorber or damper against the structure.
    pub stroke: f64,
}

impl Passage {
    pub(super) fn new(count: u64, stroke: f64) -> Self {
        let envelope = Vec::with_capacity(count as usize);
        Self { envelope, impacts: 0, impact_speed: 0.0, residual: 0.0, stroke }
    }

    /// Frequency ratio and size of the largest displacement.
    pub fn peak(&self) -> [f64; 2] {
        let larger = |a: [f64; 2], b: &[f64; 2]| if b[1] > a[1] { *b } else { a };
        self.envelope.iter().fold([f64::NAN, 0.0], larger)
    }

    /// Follows a start through a sweep; the frequency of the system does not matter.
    ///
    /// # Errors
    /// [`StartError`] for a start outside of the cavity, or where a motion becomes so large that rounding hides the
    /// walls.
    pub fn follow(
        system: &System,
        scales: &Scales,
        sweep: &SineSweep,
        start: State,
    ) -> Result<Self, StartError> {
        let mut found = Self::new(sweep.count(), 1.0);
        let mut state = start;
        for ratio in sweep.frequencies(scales) {
            let refused = StartError::NotFinite { state };
            let piece = system.with_frequency_ratio(ratio).map_err(|_| refused)?;
            let mut simulation = Simulation::new(&piece, state, 0.0)?;
            let mut measured = Measurement::begin(&piece, state);
            if simulation.run(1, u64::MAX, &mut measured) != Stop::EndTime {
                return Err(refused);
            }
            state = simulation.state();
            let period = measured.statistics();
            found.envelope.push([ratio, period.peak()]);
            found.impacts += period.impacts();
            found.impact_speed = found.impact_speed.max(period.impact_speed());
            found.residual = found.residual.max(period.energy().relative_residual);
        }
        Ok(found)
    }
}
