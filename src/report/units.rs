//! Numbers in the units that the case's reader uses.

use super::numbers::{LengthFormat, significant};
use crate::case::{BandOver, Case, Design, PhysicalExcitation, Scales};
use crate::system::System;

/// Turns dimensionless numbers into numbers of displayed units.
pub(super) struct Units {
    scales: Scales,
    lengths: LengthFormat,
    /// The case's excitation in displayed units, their name, and what it is.
    forcing: (f64, &'static str, &'static str),
}

impl Units {
    pub(super) fn of(case: &Case) -> Self {
        let scales = case.scales();
        let lengths = LengthFormat::of(&scales);
        let forcing = match &case.design {
            Design::Physical(physical) => match physical.excitation {
                PhysicalExcitation::BaseDisplacement { amplitude_m } => {
                    (lengths.number(amplitude_m), lengths.unit, "base displacement F")
                }
                PhysicalExcitation::Force { amplitude_n } => (amplitude_n, "N", "force P"),
            },
            Design::Reduced(_) => (scales.forcing, lengths.unit, "reduced forcing G"),
        };
        Self { scales, lengths, forcing }
    }

    /// A frequency ratio in Hz, or as it is for a reduced case.
    pub(super) fn frequency(&self, ratio: f64) -> f64 {
        self.scales.frequency_hz(ratio).unwrap_or(ratio)
    }

    /// The label of a frequency axis.
    pub(super) const fn frequency_axis(&self) -> &'static str {
        match self.scales.natural_frequency_rad_per_s {
            Some(_) => "excitation frequency f (Hz)",
            None => "frequency ratio Ω (1)",
        }
    }

    /// A frequency in words.
    pub(super) fn frequency_text(&self, ratio: f64) -> String {
        let number = trimmed(&significant(self.frequency(ratio), 4));
        match self.scales.natural_frequency_rad_per_s {
            Some(_) => format!("{number} Hz"),
            None => format!("Ω = {number}"),
        }
    }

    /// A length over the clearance in displayed units.
    pub(super) fn length(&self, over_clearance: f64) -> f64 {
        self.lengths.number(self.scales.length(over_clearance))
    }

    /// A length over the clearance in words.
    pub(super) fn length_text(&self, over_clearance: f64) -> String {
        self.lengths.text(self.scales.length(over_clearance))
    }

    /// The label of an axis with a length.
    pub(super) fn length_axis(&self, name: &str) -> String {
        format!("{name} ({})", self.lengths.unit)
    }

    /// A velocity over `omega0 b` in m/s, or as it is for a reduced case.
    pub(super) fn velocity(&self, dimensionless: f64) -> f64 {
        self.scales.velocity_m_per_s(dimensionless).unwrap_or(dimensionless)
    }

    /// The label of an axis with a velocity.
    pub(super) fn velocity_axis(&self, name: &str) -> String {
        match self.scales.natural_frequency_rad_per_s {
            Some(_) => format!("{name} (m/s)"),
            None => format!("{name} over ω₀b (1)"),
        }
    }

    /// A forcing over the case's in displayed units.
    pub(super) fn forcing(&self, over_own: f64) -> f64 {
        over_own * self.forcing.0
    }

    /// The label of a forcing axis.
    pub(super) fn forcing_axis(&self) -> String {
        format!("{} ({})", self.forcing.2, self.forcing.1)
    }

    /// A forcing over the case's in words.
    pub(super) fn forcing_text(&self, over_own: f64) -> String {
        format!("{} {}", significant(self.forcing(over_own), 3), self.forcing.1)
    }

    /// A place of a band in words.
    pub(super) fn band_text(&self, over: BandOver, at: f64) -> String {
        match over {
            BandOver::Frequency => self.frequency_text(at),
            BandOver::Amplitude => self.forcing_text(at),
        }
    }

    /// A number of excitation periods in seconds, or as it is for a reduced case.
    pub(super) fn time(&self, system: &System, periods: f64) -> f64 {
        self.scales.time_s(periods * system.period()).unwrap_or(periods)
    }

    /// An acceleration over `omega0^2 b` in m/s², or as it is for a reduced case.
    pub(super) fn acceleration(&self, dimensionless: f64) -> f64 {
        self.scales.acceleration_m_per_s2(dimensionless).unwrap_or(dimensionless)
    }

    /// The label of an axis with an acceleration.
    pub(super) const fn acceleration_axis(&self) -> &'static str {
        match self.scales.natural_frequency_rad_per_s {
            Some(_) => "acceleration (m/s²)",
            None => "acceleration over ω₀²b (1)",
        }
    }

    /// An impulse over `m1 omega0 b` in mN s, or in thousandths for a reduced case.
    pub(super) fn impulse(&self, dimensionless: f64) -> f64 {
        let physical =
            self.scales.oscillator_mass_kg.zip(self.scales.velocity_m_per_s(dimensionless));
        1e3 * physical.map_or(dimensionless, |(mass, velocity)| mass * velocity)
    }

    /// The unit of [`Self::impulse`].
    pub(super) const fn impulse_unit(&self) -> &'static str {
        match self.scales.natural_frequency_rad_per_s {
            Some(_) => "mN s",
            None => "10⁻³ m₁ω₀b",
        }
    }

    /// The label of a time axis.
    pub(super) const fn time_axis(&self) -> &'static str {
        match self.scales.natural_frequency_rad_per_s {
            Some(_) => "time t (s)",
            None => "time in excitation periods t/T (1)",
        }
    }

    /// Case and operating point in words: `8 Hz, 7.50 mm`.
    pub(super) fn place_text(&self, system: &System) -> String {
        let frequency = self.frequency_text(system.frequency_ratio());
        format!("{frequency}, {}", self.length_text(1.0))
    }
}

/// A decimal number without zeros at its end.
fn trimmed(number: &str) -> String {
    if number.contains('.') && !number.contains('e') {
        number.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        number.to_owned()
    }
}
