//! When the numbers of a simulation may be believed: what is measured while it runs, against limits
//! with reasons. Whatever is outside is flagged, not returned as if nothing had happened.

use serde::Serialize;

use super::run::Stop;
use super::statistics::{Energy, Statistics};

/// Largest relative residual of the energy balance. A sound run closes it to `1e-13`, or to `1e-11`
/// after a million periods; `1e-9` still leaves more digits than any report prints.
pub const ENERGY_RESIDUAL: f64 = 1e-9;
/// Largest penetration of a wall over the clearance, and largest spacing of floating-point numbers at
/// the largest displacement: the cavity is then known to nine digits. Chattering needs them: of two
/// numbers that agree in all the digits they have, no wall can be told from an opening gap.
pub const RESOLUTION: f64 = 1e-9;

/// A reason not to trust a simulation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Doubt {
    /// The run ended before its end time, so averages are those of a part.
    Unfinished {
        /// Why.
        stop: Stop,
    },
    /// The energy balance does not close.
    Energy {
        /// Its relative residual.
        value: f64,
        /// The largest that is trusted.
        limit: f64,
    },
    /// The absorber was found outside of its cavity.
    Penetration {
        /// How far, over the clearance.
        value: f64,
        /// The largest that is trusted.
        limit: f64,
    },
    /// The oscillator moves so far that floating-point numbers there are too far apart to say where
    /// the walls are.
    Resolution {
        /// Spacing of numbers at the largest displacement, over the clearance.
        value: f64,
        /// The largest that is trusted.
        limit: f64,
    },
}

impl Doubt {
    /// What is wrong, in words and with its numbers.
    pub fn words(&self) -> String {
        match self {
            Self::Unfinished { stop } => format!("the run was ended by {}", stop.words()),
            Self::Energy { value, .. } if !value.is_finite() => {
                "the energies are too small or too large for a balance".to_owned()
            }
            Self::Energy { value, limit } => {
                format!("the energy balance closes only to {value:.1e}, not to {limit:.0e}")
            }
            Self::Penetration { value, limit } => {
                format!(
                    "a wall is penetrated by {value:.1e} of the clearance, more than {limit:.0e}"
                )
            }
            Self::Resolution { value, limit } => format!(
                "the walls are known only to {value:.1e} of the clearance, not to {limit:.0e}: the \
                 oscillator moves that many clearances"
            ),
        }
    }

    /// What to do about it.
    pub fn advice(&self) -> &'static str {
        match self {
            Self::Unfinished { stop: Stop::ImpactLimit } => {
                "ask for fewer periods, or lower the restitution: elastic chattering costs an impact each time"
            }
            Self::Unfinished { .. } => {
                "check the units: one value is many orders of magnitude away from the others"
            }
            Self::Energy { .. } => "report the case: the simulation is not to be used",
            Self::Penetration { .. } | Self::Resolution { .. } => {
                "the clearance is negligible beside the motion: treat the absorber as fixed to the oscillator, or check the units"
            }
        }
    }
}

/// `abs(input - damper - impact - friction - stored)` over the largest energy of the run, that at the largest
/// displacement included: [`Energy::relative_residual`] knows only the energies at the ends of
/// periods, where a slowly driven oscillator passes its middle.
pub fn energy_residual(energy: &Energy, peak: f64) -> f64 {
    let gap = energy.input - energy.damper - energy.impact - energy.friction - energy.stored;
    let losses = energy.damper.max(energy.impact).max(energy.friction);
    let largest = [energy.input.abs(), losses, 0.5 * peak * peak];
    gap.abs() / largest.into_iter().fold(f64::MIN_POSITIVE, f64::max)
}

/// Every reason not to trust a run that stopped for `stop`; none, and it can be trusted.
pub fn doubts(stop: Stop, energy: &Energy, penetration: f64, peak: f64) -> Vec<Doubt> {
    let mut doubts = Vec::new();
    if stop != Stop::EndTime {
        doubts.push(Doubt::Unfinished { stop });
    }
    // Not a number is not within a limit either.
    let exceeds = |value: f64, limit: f64| value.is_nan() || value > limit;
    let residual = energy_residual(energy, peak);
    // A run that was ended within a period has not measured its end.
    if stop == Stop::EndTime && exceeds(residual, ENERGY_RESIDUAL) {
        doubts.push(Doubt::Energy { value: residual, limit: ENERGY_RESIDUAL });
    }
    if exceeds(penetration, RESOLUTION) {
        doubts.push(Doubt::Penetration { value: penetration, limit: RESOLUTION });
    }
    let spacing = f64::EPSILON * (1.0 + peak);
    if exceeds(spacing, RESOLUTION) {
        doubts.push(Doubt::Resolution { value: spacing, limit: RESOLUTION });
    }
    doubts
}

impl Statistics {
    /// Every reason not to trust the run that was measured, which stopped for `stop`.
    pub fn doubts(&self, stop: Stop) -> Vec<Doubt> {
        doubts(stop, &self.energy(), self.penetration(), self.peak())
    }
}
