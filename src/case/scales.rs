//! The only conversion between a design's units and the dimensionless system.
//!
//! Lengths are divided by the clearance `b`, time by `1/omega0` with `omega0 = sqrt(k1/m1)`,
//! energies by `m1 omega0^2 b^2`. With `eps = m2/m1`:
//! `lambda = c1/(m2 omega0)`, `Omega = 2 pi f/omega0`, and the reduced forcing `G = F/eps` for a
//! base displacement `F` (equation (7) of Li, Seguy, Berlioz 2016) or `G = P/(k1 eps)` for a force
//! `P`; `gamma = G/b`.

use std::f64::consts::TAU;

use super::Design;
use super::physical::{Physical, PhysicalExcitation};
use super::reduced::{Reduced, Tuning};
use crate::system::{Excitation, InvalidParameter, Parameters, System};

/// What turns dimensionless results back into the design's units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scales {
    /// `b`, in metres for a physical design, in its own unit for a reduced one.
    pub clearance: f64,
    /// `omega0 = sqrt(k1/m1)`; `None` for a reduced design.
    pub natural_frequency_rad_per_s: Option<f64>,
    /// `m1`; `None` for a reduced design.
    pub oscillator_mass_kg: Option<f64>,
    /// `G`, the reduced forcing, in the unit of [`Scales::clearance`].
    pub forcing: f64,
}

/// The unit a design's lengths are in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LengthUnit {
    /// Metres, for a physical design.
    Metre,
    /// The unit in which a reduced design gives its clearance, whatever it is.
    Own,
}

impl LengthUnit {
    /// "m", or "1" for a reduced design's own unit.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Metre => "m",
            Self::Own => "1",
        }
    }
}

impl Scales {
    /// The unit of [`Scales::clearance`], [`Scales::forcing`] and [`Scales::length`].
    pub fn length_unit(&self) -> LengthUnit {
        match self.natural_frequency_rad_per_s {
            Some(_) => LengthUnit::Metre,
            None => LengthUnit::Own,
        }
    }

    /// A length given over the clearance, in [`Scales::length_unit`].
    pub fn length(&self, over_clearance: f64) -> f64 {
        over_clearance * self.clearance
    }

    /// A length in [`Scales::length_unit`], over the clearance.
    pub fn over_clearance(&self, length: f64) -> f64 {
        length / self.clearance
    }

    /// The frequency in Hz of a frequency ratio `Omega`; `None` for a reduced design.
    pub fn frequency_hz(&self, frequency_ratio: f64) -> Option<f64> {
        Some(frequency_ratio * self.natural_frequency_rad_per_s? / TAU)
    }

    /// The frequency ratio `Omega` of a frequency in Hz; `None` for a reduced design.
    pub fn frequency_ratio(&self, frequency_hz: f64) -> Option<f64> {
        Some(TAU * frequency_hz / self.natural_frequency_rad_per_s?)
    }

    /// The time in seconds of a fast time `tau`; `None` for a reduced design.
    pub fn time_s(&self, tau: f64) -> Option<f64> {
        Some(tau / self.natural_frequency_rad_per_s?)
    }

    /// The velocity in m/s of one in clearances per fast time; `None` for a reduced design.
    pub fn velocity_m_per_s(&self, dimensionless: f64) -> Option<f64> {
        Some(dimensionless * self.clearance * self.natural_frequency_rad_per_s?)
    }

    /// The acceleration in m/s^2 of one in clearances per fast time squared; `None` for a reduced
    /// design.
    pub fn acceleration_m_per_s2(&self, dimensionless: f64) -> Option<f64> {
        Some(self.velocity_m_per_s(dimensionless)? * self.natural_frequency_rad_per_s?)
    }

    /// The energy in joules of one per unit `m1` with lengths over the clearance and fast time,
    /// so the factor is `m1 omega0^2 b^2`; `None` for a reduced design.
    pub fn energy_j(&self, dimensionless: f64) -> Option<f64> {
        let speed = self.clearance * self.natural_frequency_rad_per_s?;
        Some(dimensionless * self.oscillator_mass_kg? * speed * speed)
    }

    /// The design of a system at these scales of mass, time and length: the inverse of
    /// [`Design::system`]. The forcing is the system's, not [`Scales::forcing`].
    pub fn restore(&self, system: &System) -> Design {
        match (self.oscillator_mass_kg, self.natural_frequency_rad_per_s) {
            (Some(mass), Some(omega0)) => {
                Design::Physical(self.restore_physical(system, mass, omega0))
            }
            _ => Design::Reduced(self.restore_reduced(system)),
        }
    }

    fn restore_physical(&self, system: &System, mass_kg: f64, omega0: f64) -> Physical {
        let stiffness_n_per_m = mass_kg * omega0 * omega0;
        let absorber_mass_kg = system.mass_ratio() * mass_kg;
        let displacement = self.length(system.forcing_per_clearance()) * system.mass_ratio();
        let excitation = match system.excitation() {
            Excitation::BaseDisplacement => {
                PhysicalExcitation::BaseDisplacement { amplitude_m: displacement }
            }
            Excitation::Force => {
                PhysicalExcitation::Force { amplitude_n: displacement * stiffness_n_per_m }
            }
        };
        Physical {
            mass_kg,
            stiffness_n_per_m,
            damping_n_s_per_m: system.damping() * absorber_mass_kg * omega0,
            absorber_mass_kg,
            clearance_m: self.clearance,
            restitution: system.restitution(),
            excitation,
            frequency_hz: system.frequency_ratio() * omega0 / TAU,
        }
    }

    fn restore_reduced(&self, system: &System) -> Reduced {
        Reduced {
            mass_ratio: system.mass_ratio(),
            damping: system.damping(),
            restitution: system.restitution(),
            clearance: self.clearance,
            forcing: self.length(system.forcing_per_clearance()),
            excitation: system.excitation(),
            tuning: Tuning::Detuning(system.detuning()),
        }
    }
}

impl Design {
    /// The dimensionless system.
    ///
    /// # Errors
    /// [`InvalidParameter`] when values, each valid by itself, combine to a number that a double
    /// cannot hold, or when the design did not come from [`Case::parse`](super::Case::parse).
    pub fn system(&self) -> Result<System, InvalidParameter> {
        match self {
            Self::Physical(physical) => physical_system(physical),
            Self::Reduced(reduced) => reduced_system(reduced),
        }
    }

    /// What turns the system's results back into this design's units.
    pub fn scales(&self) -> Scales {
        match self {
            Self::Physical(p) => Scales {
                clearance: p.clearance_m,
                natural_frequency_rad_per_s: Some(p.natural_frequency_rad_per_s()),
                oscillator_mass_kg: Some(p.mass_kg),
                forcing: physical_forcing(p),
            },
            Self::Reduced(r) => Scales {
                clearance: r.clearance,
                natural_frequency_rad_per_s: None,
                oscillator_mass_kg: None,
                forcing: r.forcing,
            },
        }
    }
}

/// `G` in metres.
fn physical_forcing(p: &Physical) -> f64 {
    let displacement = match p.excitation {
        PhysicalExcitation::BaseDisplacement { amplitude_m } => amplitude_m,
        PhysicalExcitation::Force { amplitude_n } => amplitude_n / p.stiffness_n_per_m,
    };
    displacement / (p.absorber_mass_kg / p.mass_kg)
}

fn physical_system(p: &Physical) -> Result<System, InvalidParameter> {
    let omega0 = p.natural_frequency_rad_per_s();
    System::new(Parameters {
        mass_ratio: p.absorber_mass_kg / p.mass_kg,
        damping: p.damping_n_s_per_m / (p.absorber_mass_kg * omega0),
        restitution: p.restitution,
        frequency_ratio: TAU * p.frequency_hz / omega0,
        forcing_per_clearance: physical_forcing(p) / p.clearance_m,
        excitation: p.excitation.kind(),
    })
}

fn reduced_system(r: &Reduced) -> Result<System, InvalidParameter> {
    let frequency_ratio = match r.tuning {
        Tuning::FrequencyRatio(frequency_ratio) => frequency_ratio,
        Tuning::Detuning(_) => 1.0,
    };
    let system = System::new(Parameters {
        mass_ratio: r.mass_ratio,
        damping: r.damping,
        restitution: r.restitution,
        frequency_ratio,
        forcing_per_clearance: r.forcing / r.clearance,
        excitation: r.excitation,
    })?;
    match r.tuning {
        Tuning::FrequencyRatio(_) => Ok(system),
        Tuning::Detuning(detuning) => system.with_detuning(detuning),
    }
}
