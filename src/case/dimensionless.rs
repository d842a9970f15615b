//! The dimensionless system of a design, and the units that lead back.

use std::f64::consts::FRAC_PI_2;

use super::Design;
use crate::excitation::{Release, Scene, SineSweep, Transient};
use crate::quantity::Units;
use crate::system::{InvalidParameter, Parameters, Scales, System};

impl Design {
    /// The dimensionless system.
    ///
    /// # Errors
    /// [`InvalidParameter`] when values, each valid by itself, combine to a number that a double
    /// cannot hold, or when the design did not come from [`Case::parse`](super::Case::parse).
    pub fn system(&self) -> Result<System, InvalidParameter> {
        match self {
            Self::Physical(p) => {
                let found = System::physical(&p.structure(), &p.absorber(), &p.harmonic());
                found.map(|(system, _)| system)
            }
            Self::Reduced(r) => {
                let system = System::new(Parameters {
                    mass_ratio: r.mass_ratio,
                    damping: r.damping,
                    restitution: r.restitution,
                    frequency_ratio: r.frequency_ratio.unwrap_or(1.0),
                    forcing_per_clearance: r.forcing / r.clearance,
                    excitation: r.excitation,
                    cavity: r.cavity,
                })?;
                // A small detuning would be lost in a ratio near 1.
                match (r.frequency_ratio, r.detuning) {
                    (None, Some(detuning)) => system.with_detuning(detuning),
                    _ => Ok(system),
                }
            }
        }
    }

    /// How the oscillator is set in motion, where nothing drives it.
    pub fn release(&self) -> Option<Release> {
        match self.transient()? {
            Transient::Release(release) => Some(release),
            _ => None,
        }
    }

    /// The sweep of its excitation's frequency.
    pub fn sine_sweep(&self) -> Option<SineSweep> {
        match self.transient()? {
            Transient::Sweep(sweep) => Some(sweep),
            _ => None,
        }
    }

    /// Whether the cavity is level, does not rub, and its ends are alike.
    pub fn has_ideal_cavity(&self) -> bool {
        self.system().is_ok_and(|system| system.cavity().is_ideal())
    }

    /// What the structure is subjected to.
    pub fn scene(&self) -> Scene {
        match self.transient() {
            None => Scene::Steady,
            Some(Transient::Release(_)) => Scene::Release,
            Some(Transient::Sweep(_)) => Scene::Sweep,
            Some(Transient::Record(_)) => Scene::Record,
        }
    }

    /// The units of its results.
    pub fn units(&self) -> Units {
        let scales: Scales = match self {
            Self::Physical(p) => Scales::of(&p.structure(), &p.absorber()),
            Self::Reduced(r) => Scales { clearance: r.clearance, ..Scales::REDUCED },
        };
        Units::from(scales).with_pulse(self.pulse())
    }

    /// Acceleration of the oscillator at the top of the half-sine pulse of an impact, over the relative speed of the impact,
    /// in 1/s: its integral over the contact is the change of the velocity. None where impacts take no time.
    fn pulse(&self) -> Option<f64> {
        let Self::Physical(p) = self else { return None };
        let ratio = p.absorber_mass_kg / p.structure().mass_kg;
        let restitution = p.restitution + 0.5 * p.restitution_difference.abs();
        let change = ratio / (1.0 + ratio) * (1.0 + restitution);
        Some(FRAC_PI_2 * change / p.contact_time_s?)
    }

    /// `G`, the reduced forcing, in metres or the design's own unit.
    pub fn forcing(&self) -> f64 {
        match self {
            Self::Physical(p) => p.harmonic().reduced_forcing_m(&p.structure(), &p.absorber()),
            Self::Reduced(r) => r.forcing,
        }
    }
}
